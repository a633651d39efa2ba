//! Colours as spectra on lanes, as `gonio_spectrum::Upsampling` has them one by one (Jakob and Hanika 2019).

use super::Spectrum;
use super::wavelengths::{WORDS, WavelengthTable, places};
use crate::{F, Lanes, Rgb, Select, U};

/// Colours whose components differ by less than this share are grey.
const GREY: f32 = 1e-5;

/// Spectra of colours by Jakob and Hanika's polynomials, which go up to `most`; greys are even.
#[inline(always)]
pub(super) fn upsampled<L: Lanes>(table: &WavelengthTable, rotation: U<L>, colour: Rgb<L>, most: f32) -> Spectrum<L> {
    let limit = colour.g.abs() * GREY;
    let coloured = (colour.r - colour.g).abs().gt(limit) | (colour.b - colour.g).abs().gt(limit);
    let grey = Spectrum::constant(colour.g);
    if coloured.any() { Spectrum::select(coloured, by_polynomials(table, rotation, colour, most), grey) } else { grey }
}

#[inline(never)]
fn by_polynomials<L: Lanes>(table: &WavelengthTable, rotation: U<L>, colour: Rgb<L>, most: f32) -> Spectrum<L> {
    rotation.lanes().vectorize(
        #[inline(always)]
        || {
            let places = places(table, rotation);
            let sent = bounded(table, places, colour.max(0.0), most);
            let below = colour.r.lt(0.0) | colour.g.lt(0.0) | colour.b.lt(0.0);
            if !below.any() || most <= 1.0 {
                return sent;
            }
            // What lies below zero is taken away as it would be added.
            let taken = Rgb::new(-colour.r, -colour.g, -colour.b).max(0.0);
            sent - bounded(table, places, taken, most).keep_if(below)
        },
    )
}

/// Spectra of colours without negative components. Reflectances are asked for at their own height, where all else is at half of the range, where the
/// polynomials are smoothest.
#[inline(always)]
fn bounded<L: Lanes>(table: &WavelengthTable, places: Spectrum<L>, colour: Rgb<L>, most: f32) -> Spectrum<L> {
    let largest = colour.r.max(colour.g).max(colour.b);
    let height = if most > 1.0 { (largest * 2.0).max(f32::MIN_POSITIVE) } else { largest.max(1.0) };
    let [c0, c1, c2] = polynomial(table, wide(colour * height.recip()));
    let reflectance = places.map(
        #[inline(always)]
        |t| sigmoid(c0.mul_add(t, c1).mul_add(t, c2)),
    );
    reflectance * height
}

/// Rec.2020 of linear Rec.709.
#[inline(always)]
fn wide<L: Lanes>(c: Rgb<L>) -> Rgb<L> {
    let row = |[r, g, b]: [f32; 3]| c.r.mul_add(r, c.g.mul_add(g, c.b * b)).saturate();
    Rgb::new(
        row([0.627_404, 0.329_283, 0.043_313_1]),
        row([0.069_097_3, 0.919_541, 0.011_362_3]),
        row([0.016_391_4, 0.088_013_3, 0.895_595]),
    )
}

/// ½ + x / (2 √(1 + x²)), in a form that keeps its digits near 0 and 1.
#[inline(always)]
fn sigmoid<L: Lanes>(x: F<L>) -> F<L> {
    let q = x.mul_add(x, x.lanes().f(1.0)).sqrt();
    let end = (q * (q + x.abs())).recip() * 0.5;
    x.lt(0.0).select(end, 1.0 - end)
}

/// The first node along the axis of s, as `gonio_spectrum::Upsampling` has it.
const EDGE: f32 = 1.0 / 1024.0;

/// The polynomial of a Rec.2020 colour within [0, 1], read as `gonio_spectrum::Upsampling` tells.
#[inline(always)]
fn polynomial<L: Lanes>(table: &WavelengthTable, c: Rgb<L>) -> [F<L>; 3] {
    let l = c.r.lanes();
    let (red, green) = (c.r.ge(c.g) & c.r.ge(c.b), c.g.ge(c.b));
    let largest = c.r.max(c.g).max(c.b);
    let (next, after) = (red.select(c.g, green.select(c.b, c.r)), red.select(c.b, green.select(c.r, c.g)));
    let chosen = red.select(l.u(0), green.select(l.u(1), l.u(2)));
    let nodes = table.resolution as f32;
    let (dark, bright) = (largest.safe_sqrt(), (1.0 - largest).safe_sqrt());
    let s = (dark / (dark + bright)).clamp(EDGE, 1.0 - EDGE);
    let over = largest.max(f32::MIN_POSITIVE).recip() * (nodes - 1.0);
    let along = (s - EDGE) * ((nodes - 1.0) / (1.0 - 2.0 * EDGE));
    let axes = [along, (after * over).min(nodes - 1.0), (next * over).min(nodes - 1.0)];
    let mut low = [l.u(0); 3];
    let mut share = [l.f(0.0); 3];
    for ((low, share), place) in low.iter_mut().zip(&mut share).zip(axes) {
        let below = place.floor().min(nodes - 2.0);
        (*low, *share) = (below.to_i32(), place - below);
    }
    let base = ((chosen * table.resolution + low[0]) * table.resolution + low[1]) * table.resolution + low[2];
    let mut sum = [l.f(0.0); 3];
    for corner in 0..8_u32 {
        let [above_s, above_y, above_x] = [corner >> 2 & 1, corner >> 1 & 1, corner & 1];
        let offset = (above_s * table.resolution + above_y) * table.resolution + above_x;
        let mut weight = l.f(1.0);
        for (above, share) in [above_s, above_y, above_x].into_iter().zip(share) {
            weight = if above == 1 { weight * share } else { weight * (1.0 - share) };
        }
        let [a, b, c, _] = l.gather_quads(&table.polynomials, (base + offset) * WORDS);
        for (sum, value) in sum.iter_mut().zip([a, b, c]) {
            *sum = value.mul_add(weight, *sum);
        }
    }
    let scale = (s * (1.0 - s) * 2.0).recip();
    let [a, b, c] = sum;
    [a * scale, b * scale, c * scale]
}
