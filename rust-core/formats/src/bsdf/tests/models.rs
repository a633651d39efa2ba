//! BRDFs with a closed form.

use super::super::direction::{Direction, combination, dot, normalized};

/// A GGX surface with height-correlated Smith shadowing (Heitz 2014), coloured, and a diffuse part.
pub(super) struct Ggx {
    pub(super) alpha: [f64; 2],
    pub(super) colour: [f64; 3],
    pub(super) diffuse: f64,
}

impl Ggx {
    pub(super) const ISOTROPIC: Self = Self { alpha: [0.3, 0.3], colour: [0.9, 0.6, 0.3], diffuse: 0.0 };
    pub(super) const ANISOTROPIC: Self = Self { alpha: [0.25, 0.5], colour: [0.4, 0.7, 0.9], diffuse: 0.0 };

    /// The BRDF in 1/sr.
    pub(super) fn brdf(&self, wi: Direction, wo: Direction) -> [f64; 3] {
        let Some(h) = normalized(combination(1.0, wi, 1.0, wo)) else { return [0.0; 3] };
        if wi[2] <= 0.0 || wo[2] <= 0.0 {
            return [0.0; 3];
        }
        let [ax, ay] = self.alpha;
        let slope = (h[0] / ax).powi(2) + (h[1] / ay).powi(2) + h[2] * h[2];
        let density = 1.0 / (core::f64::consts::PI * ax * ay * slope * slope);
        let lambda = |d: Direction| {
            let squared = ((d[0] * ax).powi(2) + (d[1] * ay).powi(2)) / (d[2] * d[2]);
            0.5 * ((1.0 + squared).sqrt() - 1.0)
        };
        let shadowing = 1.0 / (1.0 + lambda(wi) + lambda(wo));
        let value = density * shadowing / (4.0 * wi[2] * wo[2]);
        let fresnel = |f: f64| f + (1.0 - f) * (1.0 - dot(wi, h)).powi(5);
        self.colour.map(|f| value * fresnel(f) + self.diffuse / core::f64::consts::PI)
    }

    /// BRDF × cosine of `wi`.
    pub(super) fn value(&self, wi: Direction, wo: Direction) -> [f64; 3] {
        self.brdf(wi, wo).map(|v| v * wi[2].max(0.0))
    }
}
