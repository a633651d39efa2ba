//! Directional albedos of rough interfaces, from tables that `examples/energy_tables.rs` recomputes, and the fuzz lobe's tables.
//!
//! The fuzz tables were measured: for each node, albedo as the emission that a layer of fuzz leaves, and the two coefficients from the
//! lobe's values under five small suns in Cycles 5.0.1 (residuals below 2e-4).
//!
//! Axes are uniform from 0 to 1 with the last one fastest: roughness r (alpha = r²), z = F0^(1/4), cosine mu. Reads are linear between nodes
//! and clamped at the ends. The grids are those of Cycles, since interpolation at grazing angles is part of its look.

use super::fresnel::{Curve, normal_reflectance};
use gonio_simd::{F, Lanes, Spectrum, U};

const FINE: usize = 32;
const COARSE: usize = 16;

static REFLECT: [f32; FINE * FINE] = floats(include_bytes!("tables/reflect.f32"));
static REFLECT_MEAN: [f32; FINE] = floats(include_bytes!("tables/reflect_mean.f32"));
static SCHLICK: [f32; FINE * FINE] = floats(include_bytes!("tables/schlick.f32"));
static CHARLIE: [f32; FINE * FINE] = floats(include_bytes!("tables/charlie.f32"));
static DIELECTRIC: [f32; COARSE * COARSE * COARSE] = floats(include_bytes!("tables/dielectric.f32"));
static GLASS: [f32; COARSE * COARSE * COARSE] = floats(include_bytes!("tables/glass.f32"));
static GLASS_MEAN: [f32; COARSE * COARSE] = floats(include_bytes!("tables/glass_mean.f32"));
static GLASS_INVERSE: [f32; COARSE * COARSE * COARSE] = floats(include_bytes!("tables/glass_inverse.f32"));
static GLASS_INVERSE_MEAN: [f32; COARSE * COARSE] = floats(include_bytes!("tables/glass_inverse_mean.f32"));
/// Albedo and the two transform coefficients, over r and mu.
static FUZZ: [[f32; FINE * FINE]; 3] = [
    floats(include_bytes!("tables/fuzz_albedo.f32")),
    floats(include_bytes!("tables/fuzz_a.f32")),
    floats(include_bytes!("tables/fuzz_b.f32")),
];

/// Little-endian floats, read when the program is compiled.
pub(super) const fn floats<const N: usize>(bytes: &[u8]) -> [f32; N] {
    assert!(bytes.len() == 4 * N, "the file holds the table's values");
    let mut values = [0.0; N];
    let mut i = 0;
    while i < N {
        values[i] = f32::from_le_bytes([bytes[4 * i], bytes[4 * i + 1], bytes[4 * i + 2], bytes[4 * i + 3]]);
        i += 1;
    }
    values
}

/// Node below `x` on an axis of `count` nodes, and the way to the next.
#[inline(always)]
fn place<L: Lanes>(x: F<L>, count: usize) -> (U<L>, F<L>) {
    #[allow(clippy::cast_precision_loss, reason = "axes have few nodes")]
    let last = (count - 1) as f32;
    let x = x.saturate() * last;
    let below = x.floor().min(last - 1.0);
    (below.to_i32(), x - below)
}

/// Linear read of a table with one axis.
#[inline(always)]
fn linear<L: Lanes>(l: L, table: &[f32], x: F<L>) -> F<L> {
    let (i, t) = place(x, table.len());
    let [low, high] = l.gather_pairs(table, i);
    low.lerp(high, t)
}

/// Bilinear read of a table with `count` nodes along both axes.
#[inline(always)]
pub(super) fn bilinear<L: Lanes>(l: L, table: &[f32], count: u32, x: F<L>, y: F<L>) -> F<L> {
    let (i, s) = place(x, count as usize);
    let (j, t) = place(y, count as usize);
    let at = i * count + j;
    let [low, high] = l.gather_pairs(table, at);
    let [next_low, next_high] = l.gather_pairs(table, at + count);
    low.lerp(high, t).lerp(next_low.lerp(next_high, t), s)
}

/// Trilinear read of a coarse table.
#[inline(always)]
fn trilinear<L: Lanes>(l: L, table: &[f32], x: F<L>, y: F<L>, z: F<L>) -> F<L> {
    const COUNT: u32 = COARSE as u32;
    let (i, s) = place(x, COARSE);
    let (j, t) = place(y, COARSE);
    let (k, u) = place(z, COARSE);
    let mut rows = [l.f(0.0); 4];
    for (corner, row) in rows.iter_mut().enumerate() {
        let (di, dj) = ((corner / 2) as u32, (corner % 2) as u32);
        let [low, high] = l.gather_pairs(table, (i + di) * (COUNT * COUNT) + (j + dj) * COUNT + k);
        *row = low.lerp(high, u);
    }
    rows[0].lerp(rows[1], t).lerp(rows[2].lerp(rows[3], t), s)
}

/// Albedo of the white single-scattering lobe at cosine `mu`, and its cosine mean.
#[inline(always)]
pub(super) fn reflect<L: Lanes>(l: L, r: F<L>, mu: F<L>) -> [F<L>; 2] {
    [bilinear(l, &REFLECT, FINE as u32, r, mu), linear(l, &REFLECT_MEAN, r)]
}

/// Albedo of white rough glass, reflected and refracted, and its cosine mean; `eta` = far over near index.
#[inline(always)]
pub(super) fn glass<L: Lanes>(l: L, r: F<L>, mu: F<L>, eta: F<L>) -> [F<L>; 2] {
    let z = normal_reflectance(eta).sqrt().sqrt();
    let dense = eta.ge(1.0);
    let mut read = [l.f(1.0); 2];
    if dense.any() {
        read = [trilinear(l, &GLASS, r, z, mu), bilinear(l, &GLASS_MEAN, COARSE as u32, r, z)];
    }
    if !dense.all() {
        read[0] = dense.select(read[0], trilinear(l, &GLASS_INVERSE, r, z, mu));
        read[1] = dense.select(read[1], bilinear(l, &GLASS_INVERSE_MEAN, COARSE as u32, r, z));
    }
    read
}

/// Albedo of the Charlie fuzz lobe.
#[inline(always)]
pub(super) fn charlie<L: Lanes>(l: L, r: F<L>, mu: F<L>) -> F<L> {
    bilinear(l, &CHARLIE, FINE as u32, r, mu)
}

/// The colour between `f0` and `f90` that a lobe with Schlick's curve has of the white lobe's albedo.
#[inline(always)]
fn schlick<L: Lanes>(l: L, f0: Spectrum<L>, f90: Spectrum<L>, r: F<L>, mu: F<L>) -> Spectrum<L> {
    f0.lerp(f90, bilinear(l, &SCHLICK, FINE as u32, r, mu))
}

/// The colour that a lobe with the curve has of the white lobe's albedo; for metals an estimate by Schlick's curve.
#[inline(always)]
pub(super) fn tinted<L: Lanes>(l: L, curve: &Curve<L>, r: F<L>, mu: F<L>) -> Spectrum<L> {
    let bare = match *curve {
        Curve::One => Spectrum::one(l),
        Curve::Dielectric { eta, f0, f90 } | Curve::FilmDielectric { eta, f0, f90, .. } => {
            let z = normal_reflectance(eta).sqrt().sqrt();
            f0.lerp(f90, trilinear(l, &DIELECTRIC, r, z, mu))
        }
        Curve::Schlick { f0, f90 } => schlick(l, f0, f90, r, mu),
        Curve::F82 { f0, .. } | Curve::FilmF82 { f0, .. } => schlick(l, f0, Spectrum::one(l), r, mu),
        Curve::Conductor { .. } | Curve::FilmConductor { .. } => schlick(l, curve.plain(l.f(1.0)), Spectrum::one(l), r, mu),
    };
    match curve.through_film(mu) {
        // No table has films: the value of a smooth one at the view stands for the lobe's.
        Some((weight, filmed)) => bare.lerp(filmed, weight),
        None => bare,
    }
}

/// Factor that makes up for scattering between facets (Turquin's gain with the colour of Kulla, Conty 2017), from a lobe's albedo and its
/// mean, and the colour that one such bounce has.
#[inline(always)]
pub(super) fn compensation<L: Lanes>([albedo, mean]: [F<L>; 2], bounce: Spectrum<L>) -> Spectrum<L> {
    let l = albedo.lanes();
    let white = Spectrum::one(l);
    let rest = (1.0 - albedo).max(0.0) / albedo.max(1e-4);
    let colour = bounce * mean / (white - bounce * (1.0 - mean));
    white + colour * rest
}

/// Albedo and inverse transform (a, b) of the fuzz lobe of roughness `r` at cosine `mu`.
#[inline(always)]
pub(super) fn fuzz<L: Lanes>(l: L, r: F<L>, mu: F<L>) -> [F<L>; 3] {
    let mut values = [l.f(0.0); 3];
    for (value, table) in values.iter_mut().zip(&FUZZ) {
        *value = bilinear(l, table, FINE as u32, r, mu);
    }
    values
}
