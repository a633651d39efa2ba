//! Matrices over patches of directions on lanes (Klems 1994): evaluation, and exact sampling. The reference is
//! [`gonio_formats::bsdf::Patches`].

use super::angles::sine;
use core::f32::consts::TAU;
use gonio_formats::bsdf::{Band, Basis, Channels, Matrix, Patches};
use gonio_simd::{F, Lanes, M, Rgb, U, Vec3};

/// The matrices for a view at the front and at the back: reflection and transmission, where there are.
#[derive(Clone, Debug)]
pub(super) struct PatchMatrices {
    matrices: [[Option<PatchMatrix>; 2]; 2],
}

/// The BSDF between the patches of two bases.
#[derive(Clone, Debug)]
struct PatchMatrix {
    incident: Rings,
    outgoing: Rings,
    /// Red, green, blue and luminance, 1/sr: one row of incident patches for each outgoing patch.
    values: Vec<f32>,
    /// For each outgoing patch the running sums of luminance × projected solid angle, beginning with 0.
    cumulative: Vec<f32>,
    /// Halvings of the incident patches until one is left.
    steps: u32,
}

/// A basis: rings of patches about the normal.
#[derive(Clone, Debug)]
struct Rings {
    /// Squared sines of the borders between rings.
    inner: Vec<f32>,
    /// Squared sines of all borders, one more than rings.
    borders: Vec<f32>,
    counts: Vec<f32>,
    starts: Vec<u32>,
    /// The ring of each patch.
    ring_of: Vec<u32>,
    /// −1 if patches are found with x and y negated, else 1.
    sense: f32,
}

impl Rings {
    fn new(found: &Basis, turned: bool) -> Self {
        let borders: Vec<f32> = found.borders.iter().map(|border| border.sin().powi(2) as f32).collect();
        let rings = found.counts.iter().enumerate();
        Self {
            inner: borders[1..found.counts.len()].to_vec(),
            borders,
            counts: found.counts.iter().map(|n| *n as f32).collect(),
            starts: found.starts.clone(),
            ring_of: rings.flat_map(|(ring, &n)| core::iter::repeat_n(ring as u32, n as usize)).collect(),
            sense: if turned { -1.0 } else { 1.0 },
        }
    }

    fn count(&self) -> u32 {
        self.ring_of.len() as u32
    }

    /// The patch that a direction at the front lies in.
    #[inline(always)]
    fn patch<L: Lanes>(&self, l: L, d: Vec3<L>) -> U<L> {
        let squared = sine(d).squared();
        let mut ring = l.u(0);
        for border in &self.inner {
            ring += squared.ge(*border).to_integers();
        }
        let count = l.gather(&self.counts, ring);
        let turn = (d.y * self.sense).atan2(d.x * self.sense) * TAU.recip();
        let step = (turn * count).round();
        let step = step.lt(0.0).select(step + count, step);
        l.gather_integers(&self.starts, ring) + step.eq(count).select(l.f(0.0), step).to_i32()
    }

    /// A direction of a patch, uniform in projected solid angle.
    #[inline(always)]
    fn direction<L: Lanes>(&self, l: L, patch: U<L>, u: [F<L>; 2]) -> Vec3<L> {
        let ring = l.gather_integers(&self.ring_of, patch);
        let [low, high] = l.gather_pairs(&self.borders, ring);
        let squared = low.lerp(high, u[0]);
        let step = (patch - l.gather_integers(&self.starts, ring)).i32_to_float();
        let (sin, cos) = ((step + u[1] - 0.5) / l.gather(&self.counts, ring)).sin_cos_turns();
        let radius = squared.sqrt() * self.sense;
        Vec3::new(radius * cos, radius * sin, (1.0 - squared).safe_sqrt())
    }
}

impl PatchMatrices {
    /// The reference's matrices as colours. `None` if one has 2³¹ values or more.
    pub(super) fn new(found: &Patches) -> Option<Self> {
        let mut matrices = [[None, None], [None, None]];
        for (side, pairs) in matrices.iter_mut().zip(super::PAIRS) {
            for (place, pair) in side.iter_mut().zip(pairs) {
                // What the eye does not see says nothing of what it sees.
                if let Some(main) = found.matrix(pair, Band::Visible) {
                    *place = Some(PatchMatrix::new(found, main)?);
                }
            }
        }
        Some(Self { matrices })
    }

    /// BSDF in 1/sr, and the density of [`Self::sample`] over the cosine, for directions at the front.
    #[inline(always)]
    pub(super) fn eval<L: Lanes>(&self, l: L, side: usize, transmitted: bool, wi: Vec3<L>, wo: Vec3<L>) -> (Rgb<L>, F<L>) {
        let both = &self.matrices[side];
        let Some(matrix) = &both[usize::from(transmitted)] else { return (Rgb::zero(l), l.f(0.0)) };
        let row = matrix.outgoing.patch(l, wo);
        let at = row * matrix.incident.count() + matrix.incident.patch(l, wi);
        let [r, g, b, luminance] = l.gather_quads(&matrix.values, at << 2);
        let mut total = matrix.total(l, row);
        if let Some(other) = &both[usize::from(!transmitted)] {
            total += other.total(l, other.outgoing.patch(l, wo));
        }
        (Rgb::new(r, g, b), luminance / total.max(f32::MIN_POSITIVE))
    }

    /// A direction at the front for a view at the front, whether it is meant for the other side, and whether there is any.
    #[inline(always)]
    pub(super) fn sample<L: Lanes>(&self, l: L, side: usize, wo: Vec3<L>, u: [F<L>; 3]) -> (Vec3<L>, [M<L>; 2]) {
        let [reflecting, transmitting] = &self.matrices[side];
        let mut sums = [l.f(0.0); 2];
        for (sum, matrix) in sums.iter_mut().zip([reflecting, transmitting]) {
            if let Some(matrix) = matrix {
                *sum = matrix.total(l, matrix.outgoing.patch(l, wo));
            }
        }
        let point = u[0] * (sums[0] + sums[1]);
        let transmitted = point.ge(sums[0]) & sums[1].gt(0.0);
        let mut wi = Vec3::splat(l, [0.0, 0.0, 1.0]);
        let chosen = [l.m(true).and_not(transmitted), transmitted];
        for (number, matrix) in [reflecting, transmitting].into_iter().enumerate() {
            let Some(matrix) = matrix else { continue };
            if chosen[number].any() {
                let rest = if number == 0 { point } else { point - sums[0] };
                wi = chosen[number].select(matrix.sample(l, wo, rest, [u[1], u[2]]), wi);
            }
        }
        (wi, [transmitted, (sums[0] + sums[1]).gt(0.0)])
    }
}

impl PatchMatrix {
    fn new(found: &Patches, main: &Matrix) -> Option<Self> {
        let bases = found.bases();
        let (incident, outgoing) = (Rings::new(&bases[main.incident], main.turned[0]), Rings::new(&bases[main.outgoing], main.turned[1]));
        i32::try_from(main.values.len() * 4).ok()?;
        // Matrices of one material need not share their bases: each is asked for the middle of the main one's patches.
        let colour =
            [Band::CieX, Band::CieZ].map(|band| found.matrix(main.hemispheres, band).filter(|_| *found.channels() == Channels::Xyz));
        let to_rgb = Channels::Xyz.rgb_weights();
        let columns = bases[main.incident].count();
        let value = |matrix: &Matrix, at: usize| {
            if (matrix.incident, matrix.outgoing, matrix.turned) == (main.incident, main.outgoing, main.turned) {
                return f64::from(matrix.values[at]);
            }
            let place = |basis: usize, turned: [bool; 2], other: usize, patch: usize| {
                let middle = bases[basis].direction(patch, [0.5, 0.5]);
                bases[other].patch(if turned[0] == turned[1] { middle } else { [-middle[0], -middle[1], middle[2]] })
            };
            let column = place(main.incident, [main.turned[0], matrix.turned[0]], matrix.incident, at % columns);
            let row = place(main.outgoing, [main.turned[1], matrix.turned[1]], matrix.outgoing, at / columns);
            f64::from(matrix.values[row * bases[matrix.incident].count() + column])
        };
        let mut values = Vec::with_capacity(main.values.len() * 4);
        for (at, &y) in main.values.iter().enumerate() {
            let y = f64::from(y);
            let rgb = match colour {
                [Some(x), Some(z)] => {
                    let xyz = [value(x, at), y, value(z, at)];
                    [0, 1, 2].map(|c| xyz.iter().zip(&to_rgb).map(|(v, w)| v * w[c]).sum())
                }
                _ => [y; 3],
            };
            values.extend(rgb.map(|x: f64| x as f32));
            values.push(y as f32);
        }
        let steps = usize::BITS - columns.leading_zeros();
        Some(Self { incident, outgoing, values, cumulative: main.cumulative.clone(), steps })
    }

    /// The sum of a row.
    #[inline(always)]
    fn total<L: Lanes>(&self, l: L, row: U<L>) -> F<L> {
        let columns = self.incident.count();
        l.gather(&self.cumulative, row * (columns + 1) + columns)
    }

    /// A direction of the patch that the running sum reaches `point` in.
    #[inline(always)]
    fn sample<L: Lanes>(&self, l: L, wo: Vec3<L>, point: F<L>, u: [F<L>; 2]) -> Vec3<L> {
        let columns = self.incident.count();
        let row = self.outgoing.patch(l, wo) * (columns + 1);
        let mut patch = l.u(0);
        for step in (0..self.steps).rev() {
            let next = patch + (1 << step);
            let reached = next.lt(columns) & l.gather(&self.cumulative, row + next).le(point);
            patch = reached.select(next, patch);
        }
        self.incident.direction(l, patch, u)
    }
}
