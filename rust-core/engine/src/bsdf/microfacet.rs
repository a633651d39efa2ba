//! The GGX distribution with height-correlated Smith masking, anisotropic, in the shading frame.
//!
//! With t(v) = √(αx² vx² + αy² vy² + vz²), Smith's masking is G1 = 2 vz / (t + vz) and G2 = 2 vz lz / (t(v) lz + t(l) vz): no tangents, no
//! cancellation at grazing angles.

use core::f32::consts::PI;
use gonio_simd::{F, Lanes, Vec3};

/// Product of the widths up to which a lobe counts as a mirror: sampled only, never evaluated.
pub(crate) const MIRROR: f32 = 2e-10;

/// The two widths of a lobe.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Widths<L: Lanes> {
    /// Along the tangent.
    pub(crate) x: F<L>,
    /// Along the bitangent.
    pub(crate) y: F<L>,
}

impl<L: Lanes> Widths<L> {
    /// Equal widths.
    #[inline(always)]
    pub(crate) fn isotropic(alpha: F<L>) -> Self {
        Self { x: alpha, y: alpha }
    }
    /// Widths whose product is α² until the wider one reaches 1.
    #[inline(always)]
    pub(crate) fn with_aspect(alpha: F<L>, aspect: F<L>) -> Self {
        Self { x: (alpha / aspect).min(1.0), y: alpha * aspect }
    }
    /// The roughness r = √α of equal widths with the same product.
    #[inline(always)]
    pub(crate) fn roughness(&self) -> F<L> {
        (self.x * self.y).sqrt().sqrt()
    }
    /// Density of facet normals at `h`, per solid angle of projected area.
    #[inline(always)]
    pub(crate) fn distribution(&self, h: Vec3<L>) -> F<L> {
        let (x, y) = (h.x / self.x, h.y / self.y);
        let q = x.mul_add(x, y.mul_add(y, h.z * h.z));
        (self.x * self.y * q * q * PI).recip()
    }
    /// t(v) of the module's head.
    #[inline(always)]
    pub(crate) fn stretch(&self, v: Vec3<L>) -> F<L> {
        let (x, y) = (v.x * self.x, v.y * self.y);
        x.mul_add(x, y.mul_add(y, v.z * v.z)).sqrt()
    }
    /// A visible facet normal by spherical caps (Dupuy, Benyoub 2023); `bound` × the stretched view's z is the cap's lower end.
    #[inline(always)]
    pub(crate) fn sample(&self, wo: Vec3<L>, bound: F<L>, u: [F<L>; 2]) -> Vec3<L> {
        let l = wo.x.lanes();
        let stretched = Vec3::new(wo.x * self.x, wo.y * self.y, wo.z) * self.stretch(wo).max(1e-20).recip();
        let (sin_phi, cos_phi) = u[0].sin_cos_turns();
        let z = 1.0 - u[1] * (1.0 + bound * stretched.z);
        let sin = (1.0 - z * z).safe_sqrt();
        let cap = Vec3::new(sin * cos_phi, sin * sin_phi, z) + stretched;
        Vec3::new(cap.x * self.x, cap.y * self.y, cap.z).normalize_or(Vec3::splat(l, [0.0, 0.0, 1.0]))
    }
    /// The bound that leaves out most facets mirroring the view under the surface (Tokuyoshi, Eto 2024).
    #[inline(always)]
    pub(crate) fn reflection_bound(&self, wo: Vec3<L>) -> F<L> {
        let alpha2 = self.x.min(self.y).min(1.0).squared();
        let s2 = (wo.x.mul_add(wo.x, wo.y * wo.y).sqrt() + 1.0).squared();
        (1.0 - alpha2) * s2 / (s2 + alpha2 * wo.z * wo.z)
    }
}
