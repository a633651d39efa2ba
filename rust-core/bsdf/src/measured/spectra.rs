//! Spectra over the unit square on lanes: sums of a few, each of which is known at every wavelength.

use super::basis::{Basis, QUAD};
use super::warp::{Blend, Patch, patch};
use gonio_formats::bsdf::Interpolant;
use gonio_simd::{F, Lanes, Spectrum};

/// Where light's wavelengths begin, nm; what was measured beyond is left out.
const FIRST: f64 = 380.0;
/// Steps of a nanometre that they have.
const STEPS: usize = 400;
/// Spectra that a basis is found from.
const MOST_SAMPLES: usize = 1 << 14;

/// Functions on the unit square, bilinear between nodes: slices of rows of columns of shares in a basis, four to a gather.
#[derive(Clone, Debug)]
pub(super) struct SpectralInterpolant {
    columns: usize,
    rows: usize,
    /// Four of the basis at each nanometre, as often as there are four.
    basis: Vec<f32>,
    /// Four shares in these of each node, as often as there are four.
    shares: Vec<f32>,
    quads: usize,
    /// What is left out of a spectrum over the whole of it, rms.
    error: f64,
}

impl SpectralInterpolant {
    /// The reference's slices of bands at these wavelengths. `None` where there are 2³¹ values or more.
    pub(super) fn new(found: &Interpolant, wavelengths_nm: &[f64]) -> Option<Self> {
        let last = wavelengths_nm.len().checked_sub(1)?;
        let first = wavelengths_nm.partition_point(|nm| *nm <= FIRST).saturating_sub(1);
        let kept = first..=wavelengths_nm.partition_point(|nm| *nm < FIRST + STEPS as f64).min(last);
        let seen = &wavelengths_nm[kept.clone()];
        let nodes = found.rows * found.columns;
        let spectrum = |place: usize| {
            let slice = place / nodes * wavelengths_nm.len();
            kept.clone().map(|band| f64::from(found.data[(slice + band) * nodes + place % nodes])).collect::<Vec<f64>>()
        };
        let count = found.data.len() / wavelengths_nm.len();
        let samples: Vec<Vec<f64>> = (0..count).step_by(count.div_ceil(MOST_SAMPLES).max(1)).map(spectrum).collect();
        let basis = Basis::of(&samples, seen.len());
        let quads = basis.components.len() / QUAD;
        i32::try_from(count.checked_mul(basis.components.len())?).ok()?;
        let shares = (0..quads)
            .flat_map(|quad| (0..count).map(move |place| (quad, place)))
            .flat_map(|(quad, place)| basis.shares(quad, &spectrum(place)))
            .collect();
        let at = |nm: f64| weights(seen, nm);
        let of_basis = (0..quads)
            .flat_map(|quad| (0..=STEPS).map(move |step| (quad, FIRST + step as f64)))
            .flat_map(|(quad, nm)| {
                let (below, above, share) = at(nm);
                let value = |band: &Vec<f64>| (band[below] + share * (band[above] - band[below])) as f32;
                basis.components[quad * QUAD..][..QUAD].iter().map(value).collect::<Vec<f32>>()
            })
            .collect();
        Some(Self { columns: found.columns, rows: found.rows, basis: of_basis, shares, quads, error: basis.error })
    }

    /// By how much spectra differ from those that were measured, rms over their own.
    pub(super) fn error(&self) -> f64 {
        self.error
    }

    /// The values at a place and three wavelengths in nanometres; none below zero.
    #[inline(always)]
    pub(super) fn eval<L: Lanes>(&self, l: L, at: [F<L>; 2], blend: &Blend<L>, nanometres: Spectrum<L>) -> Spectrum<L> {
        let Patch { column, row, x, y } = patch(at, self.columns, self.rows);
        let nodes = (self.rows * self.columns) as u32;
        let first = row * self.columns as u32 + column;
        let corners =
            [(0, (1.0 - x) * (1.0 - y)), (1, x * (1.0 - y)), (self.columns as u32, (1.0 - x) * y), (self.columns as u32 + 1, x * y)];
        let mut sum = Spectrum::zero(l);
        for (basis, shares) in self.basis.chunks_exact(QUAD * (STEPS + 1)).zip(self.shares.chunks_exact(self.shares.len() / self.quads)) {
            let mut found = [l.f(0.0); QUAD];
            for (slice, weight) in blend.slice.iter().zip(&blend.weight).take(blend.count) {
                for (offset, share) in corners {
                    let (quad, share) = (l.gather_quads(shares, (*slice * nodes + first + offset) << 2), *weight * share);
                    for (found, value) in found.iter_mut().zip(quad) {
                        *found = value.mul_add(share, *found);
                    }
                }
            }
            sum += nanometres.map(
                #[inline(always)]
                |nm| mixed(l, basis, found, nm),
            );
        }
        sum.map(
            #[inline(always)]
            |value| value.max(0.0),
        )
    }
}

/// Shares of four of the basis at a wavelength.
#[inline(always)]
fn mixed<L: Lanes>(l: L, basis: &[f32], shares: [F<L>; QUAD], nm: F<L>) -> F<L> {
    let place = (nm - FIRST as f32).clamp(0.0, STEPS as f32);
    let step = place.to_i32().min(STEPS as u32 - 1);
    let along = place - step.i32_to_float();
    let (below, above) = (l.gather_quads(basis, step << 2), l.gather_quads(basis, (step + 1) << 2));
    let mut sum = l.f(0.0);
    for part in 0..QUAD {
        sum = below[part].lerp(above[part], along).mul_add(shares[part], sum);
    }
    sum
}

/// The bands around a wavelength, and the share of the one above; the ends hold beyond.
fn weights(wavelengths_nm: &[f64], nm: f64) -> (usize, usize, f64) {
    let last = wavelengths_nm.len() - 1;
    let above = wavelengths_nm.partition_point(|known| *known <= nm).min(last);
    let below = above.saturating_sub(1);
    let width = wavelengths_nm[above] - wavelengths_nm[below];
    (below, above, if width > 0.0 { ((nm - wavelengths_nm[below]) / width).clamp(0.0, 1.0) } else { 0.0 })
}
