//! Batches of samples and evaluations of one surface from one view, at any level.

use crate::hair::NUMBERS;
use crate::normals::Normals;
use crate::{BsdfSample, Hits, Lobes, ParameterValues, Surface};
use gonio_simd::{Column, Execution, F, Lanes, Rgb, Spectrum, Vec3, WavelengthColumn, WavelengthTable, Wavelengths, dispatch};
use std::sync::LazyLock;

/// A surface seen from one direction.
#[derive(Clone)]
pub(super) struct View {
    pub(super) surface: Surface,
    pub(super) wo: [f32; 3],
    pub(super) entering: bool,
    /// The triangle's normal in the shading frame, where it is another one.
    pub(super) geometric: Option<[f32; 3]>,
    /// What fibres draw their ways inside by.
    pub(super) inside: [f32; NUMBERS],
    /// What paths carry at three wavelengths; without it light is colour.
    pub(super) carried: Option<[f32; 3]>,
}

/// Indices of the glass of the first row at three wavelengths, over the stated one: further apart than those of any glass.
pub(super) const RATIOS: [f32; 3] = [0.95, 1.0, 1.08];

/// One rotation of 660, 540 and 440 nm.
static WAVELENGTHS: LazyLock<WavelengthTable> = LazyLock::new(|| {
    let quad = |[a, b, c]: [f32; 3]| {
        let mut column = Column::new(4);
        column[..4].copy_from_slice(&[a, b, c, 0.0]);
        column
    };
    WavelengthTable { rotations: 1, places: quad([0.7, 0.4, 0.15]), glasses: quad(RATIOS), ..WavelengthTable::default() }
});

/// One sampled direction.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Sample {
    pub(super) wi: [f32; 3],
    pub(super) value: [f32; 3],
    pub(super) pdf: f32,
    pub(super) delta: bool,
    pub(super) entered: bool,
}

/// What the lobes tell without a direction.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Summary {
    pub(super) emission: [f32; 3],
    pub(super) opacity: f32,
    pub(super) transmittance: [f32; 3],
    pub(super) albedo: [f32; 3],
}

/// Direction at `theta` from the normal and azimuth `phi`, in degrees.
pub(super) fn direction(theta: f32, phi: f32) -> [f32; 3] {
    let (theta, phi) = (theta.to_radians(), phi.to_radians());
    [theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos()]
}

/// What to ask of a view's lobes, and the answers; one kernel, since each is compiled for every level.
#[derive(Default)]
struct Job<'a> {
    numbers: &'a [[f32; 3]],
    directions: &'a [[f32; 3]],
    samples: Vec<Sample>,
    values: Vec<([f32; 3], f32)>,
    summary: Summary,
}

/// [`Lobes::sample`], compiled once for a level.
#[inline(never)]
pub(super) fn sample<L: Lanes>(l: L, lobes: &Lobes<'_, L>, wo: Vec3<L>, u: [F<L>; 3]) -> BsdfSample<L> {
    l.vectorize(
        #[inline(always)]
        || lobes.sample(l, wo, u),
    )
}

#[inline(always)]
fn kernel<L: Lanes>(l: L, view: &View, job: &mut Job) {
    let wo = Vec3::splat(l, view.wo);
    let mut values = ParameterValues::constant(&view.surface.constants);
    let mut carried = None;
    if let Some([r, g, b]) = view.carried {
        values.wavelengths = WavelengthColumn::new(Some(&WAVELENGTHS), &[0; 16]);
        carried = Some(Wavelengths::rgb(l).coefficient(Rgb::new(l.f(r), l.f(g), l.f(b))));
    }
    let normals = match view.geometric {
        Some(geometric) => Some(Normals { geometric: Vec3::splat(l, geometric), smooth: Vec3::splat(l, [0.0, 0.0, 1.0]), coat: None }),
        None => None,
    };
    let inside = view.inside.map(|x| l.f(x));
    let hits = Hits {
        values: &values,
        at: 0,
        wo,
        entering: l.m(view.entering),
        normals: normals.as_ref(),
        walks: true,
        carried,
        numbers: Some(&inside),
    };
    let mut lobes = Lobes::empty(l);
    view.surface.resolve(l, &hits, &mut lobes);
    for chunk in job.numbers.chunks(L::COUNT) {
        let s = sample(l, &lobes, wo, lanes(l, chunk));
        let (wi, value) = ([s.wi.x, s.wi.y, s.wi.z].map(|x| x.to_array()), rgb(s.value));
        let (pdf, delta, entered) = (s.pdf.to_array(), s.delta.bits(), s.entered.bits());
        for lane in 0..chunk.len() {
            let value = value.map(|x| x[lane]);
            let set = |bits: u64| bits >> lane & 1 == 1;
            job.samples.push(Sample { wi: wi.map(|x| x[lane]), value, pdf: pdf[lane], delta: set(delta), entered: set(entered) });
        }
    }
    for chunk in job.directions.chunks(L::COUNT) {
        let [x, y, z] = lanes(l, chunk);
        let (value, pdf) = lobes.eval(l, wo, Vec3::new(x, y, z));
        let (value, pdf) = (rgb(value), pdf.to_array());
        job.values.extend((0..chunk.len()).map(|lane| (value.map(|x| x[lane]), pdf[lane])));
    }
    let transmittance = lobes.transmittance(l, wo);
    job.summary = Summary {
        emission: rgb(lobes.emission()).map(|x| x[0]),
        opacity: lobes.opacity().to_array()[0],
        transmittance: rgb(transmittance).map(|x| x[0]),
        albedo: rgb(lobes.albedo()).map(|x| x[0]),
    };
}

#[inline(always)]
pub(super) fn lanes<L: Lanes>(l: L, triples: &[[f32; 3]]) -> [F<L>; 3] {
    let mut axes = [[0.5; 16]; 3];
    for (lane, triple) in triples.iter().enumerate() {
        (0..3).for_each(|axis| axes[axis][lane] = triple[axis]);
    }
    [l.load(&axes[0], 0), l.load(&axes[1], 0), l.load(&axes[2], 0)]
}

#[inline(always)]
pub(super) fn rgb<L: Lanes>(light: Spectrum<L>) -> [[f32; 16]; 3] {
    let colour = light.to_rgb();
    [colour.r.to_array(), colour.g.to_array(), colour.b.to_array()]
}

impl View {
    pub(super) fn new(surface: &Surface, theta: f32, entering: bool) -> Self {
        Self::of(surface, direction(theta, 0.0), entering)
    }
    pub(super) fn of(surface: &Surface, wo: [f32; 3], entering: bool) -> Self {
        Self { surface: surface.clone(), wo, entering, geometric: None, inside: [0.5; NUMBERS], carried: None }
    }
    /// Over a triangle whose normal leans from the shading normal towards the view by `lean` degrees.
    pub(super) fn smooth(surface: &Surface, theta: f32, lean: f32, entering: bool) -> Self {
        Self { geometric: Some(direction(lean, 0.0)), ..Self::new(surface, theta, entering) }
    }
    fn run<'a>(&self, execution: Execution, numbers: &'a [[f32; 3]], directions: &'a [[f32; 3]]) -> Job<'a> {
        let mut job = Job { numbers, directions, ..Job::default() };
        dispatch!(execution, l => kernel(l, self, &mut job));
        job
    }
    pub(super) fn sample_at(&self, execution: Execution, numbers: &[[f32; 3]]) -> Vec<Sample> {
        self.run(execution, numbers, &[]).samples
    }
    pub(super) fn sample(&self, numbers: &[[f32; 3]]) -> Vec<Sample> {
        self.sample_at(Execution::best(), numbers)
    }
    pub(super) fn eval_at(&self, execution: Execution, directions: &[[f32; 3]]) -> Vec<([f32; 3], f32)> {
        self.run(execution, &[], directions).values
    }
    pub(super) fn eval(&self, directions: &[[f32; 3]]) -> Vec<([f32; 3], f32)> {
        self.eval_at(Execution::best(), directions)
    }
    pub(super) fn summary(&self) -> Summary {
        self.run(Execution::best(), &[], &[]).summary
    }
    /// Reflected and transmitted albedo from `count` well-spread samples.
    pub(super) fn albedo(&self, count: usize) -> [[f64; 3]; 2] {
        let mut sides = [[0.0; 3]; 2];
        for s in self.sample(&spread(count)).iter().filter(|s| s.pdf > 0.0) {
            let side = &mut sides[usize::from(s.wi[2] < 0.0)];
            for (sum, value) in side.iter_mut().zip(s.value) {
                *sum += f64::from(value / s.pdf);
            }
        }
        sides.map(|side| side.map(|sum| sum / count as f64))
    }
}

/// A fixed, evenly spread set: ordered in the number that chooses lobes, so that each lobe gets an evenly spread set of its own
/// (additive recurrence of the plastic number).
pub(super) fn spread(count: usize) -> Vec<[f32; 3]> {
    const STEP: [f64; 2] = [0.754_877_666_246_692_8, 0.569_840_290_998_053_3];
    let fraction = |i: usize, step: f64| ((0.5 + i as f64 * step).fract() as f32).min(0.999_999_94);
    (0..count).map(|i| [((i as f64 + 0.5) / count as f64) as f32, fraction(i, STEP[0]), fraction(i, STEP[1])]).collect()
}

/// Independent uniform numbers from a fixed seed (PCG).
pub(super) fn random(count: usize, seed: u64) -> Vec<[f32; 3]> {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut next = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let word = (((state >> 18) ^ state) >> 27) as u32;
        (word.rotate_right((state >> 59) as u32) >> 8) as f32 / (1 << 24) as f32
    };
    (0..count).map(|_| [next(), next(), next()]).collect()
}
