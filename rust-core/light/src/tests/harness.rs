//! Batches of samples through the kernels at any level.

use crate::{EscapedRay, LightCache, LightKind, LightRecord, LightSample, LightSampleContext, LightTable};
use gonio_simd::{Column, Execution, F, Lanes, M, Rgb, Spectrum, U, Vec3, Wavelengths, dispatch, padded};

/// Samples drawn, column by column.
#[derive(Default)]
pub(super) struct Drawn {
    pub(super) wi: [Column; 3],
    pub(super) distance: Column,
    pub(super) radiance: [Column; 3],
    pub(super) pdf: Column,
    pub(super) light: Column<u32>,
    /// Radiance and density that `eval_hit` gives for the sampled point.
    pub(super) eval_radiance: [Column; 3],
    pub(super) eval_pdf: Column,
}

impl Drawn {
    pub(super) fn direction(&self, i: usize) -> [f64; 3] {
        [0, 1, 2].map(|k| f64::from(self.wi[k][i]))
    }
    pub(super) fn colour(&self, i: usize) -> [f64; 3] {
        [0, 1, 2].map(|k| f64::from(self.radiance[k][i]))
    }
}

/// Uniform numbers in [0, 1): a counter through a 64-bit mixer (SplitMix64).
pub(super) fn uniform(seed: u64, index: u64) -> f32 {
    let mut z = (seed << 40 ^ index).wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 40) as f32 / (1u32 << 24) as f32
}

/// Three columns of random numbers.
pub(super) fn numbers(seed: u64, count: usize) -> [Column; 3] {
    let mut columns = [Column::new(count), Column::new(count), Column::new(count)];
    for i in 0..padded(count) {
        for (k, column) in columns.iter_mut().enumerate() {
            column[i] = uniform(seed, (3 * i + k) as u64);
        }
    }
    columns
}

/// A point that sees all lights.
#[inline(always)]
pub(super) fn seeing_all<L: Lanes>(l: L, [position, normal]: [Vec3<L>; 2]) -> LightSampleContext<L> {
    LightSampleContext { position, normal, receiver: l.u(0) }
}

/// [`LightTable::sample_li`] as a function of its own: all kinds of lights in one function with evaluation compile for minutes.
#[inline(never)]
pub(super) fn sample_li<L: Lanes>(
    l: L,
    table: &LightTable,
    light_cache: Option<&LightCache>,
    from: &LightSampleContext<L>,
    u: &[F<L>; 3],
) -> LightSample<L> {
    l.vectorize(
        #[inline(always)]
        || table.sample_li(l, light_cache, from, u[0], &[u[1], u[2]]),
    )
}

/// [`LightTable::eval_hit`] likewise, of a point that a ray met.
#[inline(never)]
pub(super) fn eval_hit<L: Lanes>(
    l: L,
    table: &LightTable,
    light_cache: Option<&LightCache>,
    from: &LightSampleContext<L>,
    light: U<L>,
    ray: [Vec3<L>; 2],
    mask: M<L>,
) -> (Rgb<L>, F<L>) {
    l.vectorize(
        #[inline(always)]
        || table.eval_hit(l, light_cache, from, light, ray, mask),
    )
}

/// [`LightTable::eval_escaped`] likewise.
#[inline(never)]
pub(super) fn eval_escaped<L: Lanes>(l: L, table: &LightTable, from: &LightSampleContext<L>, ray: &EscapedRay<L>) -> Spectrum<L> {
    l.vectorize(
        #[inline(always)]
        || table.eval_escaped(l, None, from, ray, None, Wavelengths::rgb(l)),
    )
}

#[inline(always)]
fn kernel<L: Lanes>(
    l: L,
    table: &LightTable,
    light_cache: Option<&LightCache>,
    p: [f32; 3],
    n: [f32; 3],
    u: &[Column; 3],
    drawn: &mut Drawn,
) {
    let from = seeing_all(l, [Vec3::splat(l, p), Vec3::splat(l, n)]);
    for at in (0..u[0].len()).step_by(L::COUNT) {
        let numbers: [F<L>; 3] = [l.load(&u[0], at), l.load(&u[1], at), l.load(&u[2], at)];
        let s = sample_li(l, table, light_cache, &from, &numbers);
        let [x, y, z] = &mut drawn.wi;
        s.wi.store([x, y, z], at);
        s.distance.store(&mut drawn.distance, at);
        let [r, g, b] = &mut drawn.radiance;
        s.radiance.store([r, g, b], at);
        s.pdf.store(&mut drawn.pdf, at);
        s.light.store(&mut drawn.light, at);
        let placed = s.distance.lt(f32::MAX) & s.pdf.gt(0.0) & !s.delta;
        let hit = s.wi.mul_add(s.distance, from.position);
        let (radiance, pdf) = eval_hit(l, table, light_cache, &from, s.light, [s.wi, hit], placed);
        let [r, g, b] = &mut drawn.eval_radiance;
        radiance.store([r, g, b], at);
        pdf.store(&mut drawn.eval_pdf, at);
    }
}

/// Samples at one point without a light cache.
pub(super) fn draw(execution: Execution, table: &LightTable, p: [f32; 3], n: [f32; 3], u: &[Column; 3]) -> Drawn {
    draw_with_cache(execution, table, None, p, n, u)
}

/// Samples at one point.
pub(super) fn draw_with_cache(
    execution: Execution,
    table: &LightTable,
    light_cache: Option<&LightCache>,
    p: [f32; 3],
    n: [f32; 3],
    u: &[Column; 3],
) -> Drawn {
    let count = u[0].len();
    let column = || Column::new(count);
    let three = || [column(), column(), column()];
    let mut drawn = Drawn {
        wi: three(),
        distance: column(),
        radiance: three(),
        pdf: column(),
        light: Column::new(count),
        eval_radiance: three(),
        eval_pdf: column(),
    };
    dispatch!(execution, l => kernel(l, table, light_cache, p, n, u, &mut drawn));
    drawn
}

/// Mean and standard error per channel of the illuminance estimate.
pub(super) fn estimate(drawn: &Drawn, n: [f64; 3], count: usize) -> ([f64; 3], [f64; 3]) {
    let (mut sum, mut square) = ([0.0; 3], [0.0; 3]);
    for i in 0..count {
        let pdf = f64::from(drawn.pdf[i]);
        if pdf <= 0.0 {
            continue;
        }
        let wi = drawn.direction(i);
        let cosine = (n[0] * wi[0] + n[1] * wi[1] + n[2] * wi[2]).max(0.0);
        for (k, radiance) in drawn.colour(i).into_iter().enumerate() {
            let x = radiance * cosine / pdf;
            sum[k] += x;
            square[k] += x * x;
        }
    }
    let m = count as f64;
    let mean = sum.map(|s| s / m);
    let error = [0, 1, 2].map(|k| ((square[k] / m - mean[k] * mean[k]).max(0.0) / m).sqrt());
    (mean, error)
}

/// A light of a kind under axes and a place.
pub(super) fn light(kind: LightKind, axes: [[f32; 3]; 3], origin: [f32; 3]) -> LightRecord {
    LightRecord { to_world: [axes[0], axes[1], axes[2], origin], ..LightRecord::new(kind) }
}

/// Axes turned by Euler angles about x, y, z in turn, with lengths.
pub(super) fn turned(lengths: [f32; 3], angles: [f32; 3]) -> [[f32; 3]; 3] {
    let mut axes = [[lengths[0], 0.0, 0.0], [0.0, lengths[1], 0.0], [0.0, 0.0, lengths[2]]];
    for (k, angle) in angles.into_iter().enumerate() {
        let (sine, cosine) = angle.sin_cos();
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        for axis in &mut axes {
            (axis[i], axis[j]) = (cosine * axis[i] - sine * axis[j], sine * axis[i] + cosine * axis[j]);
        }
    }
    axes
}

/// No light has an image.
pub(super) const NO_IMAGES: &[crate::LightTexture] = &[];
