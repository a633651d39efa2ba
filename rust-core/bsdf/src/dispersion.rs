//! Glass that bends each wavelength its own way.
//!
//! Where an interface disperses one of a path's wavelengths draws the direction, by chances as what the path still carries at each, and all are evaluated
//! there: the density is the sum of theirs by these chances. Vertex after vertex that is the balance heuristic of Wilkie and others (Hero Wavelength
//! Spectral Sampling, 2014) over whole paths, of which nothing needs to be kept. Reflections and rough glass keep all wavelengths, smooth glass those
//! that it bends alike.

use super::fresnel::normal_reflectance;
use gonio_simd::{F, Lanes, Spectrum, Vec3};

/// Square of the sine by which wavelengths may be bent apart and count as bent alike: above what rounding makes of one, far below what is seen.
const ALIKE: f32 = 2e-5 * 2e-5;

/// An interface's index by wavelength.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spread<L: Lanes> {
    /// Far over near index.
    pub(crate) etas: Spectrum<L>,
    /// The chances with which wavelengths draw.
    chances: Spectrum<L>,
}

impl<L: Lanes> Spread<L> {
    /// That of these far over near indices, for paths that carry this.
    #[inline(always)]
    pub(crate) fn new(etas: Spectrum<L>, carried: Spectrum<L>) -> Self {
        Self { etas, chances: carried.abs().shares() }
    }
    /// Reflectance at normal incidence.
    #[inline(always)]
    pub(crate) fn normal_reflectance(&self) -> Spectrum<L> {
        self.etas.map(
            #[inline(always)]
            |eta| normal_reflectance(eta),
        )
    }
    /// By the wavelength that `u` draws: its number of these, its index, and what the choice leaves of `u`.
    #[inline(always)]
    pub(crate) fn draw(&self, u: F<L>, of: Spectrum<L>) -> [F<L>; 3] {
        [self.chances.choose(u, of), self.chances.choose(u, self.etas), self.chances.left_by_choice(u)]
    }
    /// The density of a direction, from each wavelength's.
    #[inline(always)]
    pub(crate) fn density(&self, densities: Spectrum<L>) -> F<L> {
        self.chances.dot(densities)
    }
    /// 1 for wavelengths that a smooth interface bends from `wo` to `wi`, else 0.
    #[inline(always)]
    pub(crate) fn bent(&self, wo: Vec3<L>, wi: Vec3<L>) -> Spectrum<L> {
        self.etas.map(
            #[inline(always)]
            |eta| {
                let (x, y) = (eta.mul_add(wi.x, wo.x), eta.mul_add(wi.y, wo.y));
                eta.lanes().f(1.0).keep_if(x.mul_add(x, y * y).lt(ALIKE))
            },
        )
    }
}
