//! Distributions of facet normals, anisotropic, in the shading frame: GGX with height-correlated Smith masking, Beckmann, Ashikhmin and Shirley.
//!
//! For GGX, with t(v) = √(αx² vx² + αy² vy² + vz²), Smith's masking is G1 = 2 vz / (t + vz) and G2 = 2 vz lz / (t(v) lz + t(l) vz): no tangents, no
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

/// Ashikhmin and Shirley's exponents; widths from 10⁻⁴ to 1.
#[inline(always)]
fn exponent<L: Lanes>(width: F<L>) -> F<L> {
    let width = width.clamp(1e-4, 1.0);
    2.0 / (width * width) - 2.0
}

/// Beckmann's distribution.
impl<L: Lanes> Widths<L> {
    /// Density of facet normals at `h`, per solid angle of projected area.
    #[inline(always)]
    fn beckmann(&self, h: Vec3<L>) -> F<L> {
        let (x, y, z2) = (h.x / self.x, h.y / self.y, (h.z * h.z).max(1e-12));
        (-(x.mul_add(x, y * y)) / z2).exp() / (self.x * self.y * z2 * z2 * PI)
    }
    /// Smith's Λ as the rational fit of Walter et al.; 0 where α tan θ is below 0.625.
    #[inline(always)]
    fn beckmann_lambda(&self, v: Vec3<L>) -> F<L> {
        let (x, y) = (v.x * self.x, v.y * self.y);
        let slope2 = x.mul_add(x, y * y) / (v.z * v.z).max(1e-12);
        let a = slope2.max(1e-12).inverse_root();
        let fit = a.mul_add(a.mul_add(0.396, -1.259), 1.0) / (a * a.mul_add(2.181, 3.535));
        fit.keep_if(slope2.ge(0.39))
    }
}

/// Ashikhmin and Shirley's distribution.
impl<L: Lanes> Widths<L> {
    /// Density of half vectors per solid angle.
    #[inline(always)]
    fn phong(&self, h: Vec3<L>) -> F<L> {
        let (nx, ny) = (exponent(self.x), exponent(self.y));
        let (x2, y2) = (h.x * h.x, h.y * h.y);
        let sin2 = (x2 + y2).min(1.0);
        // ln(cos²) / sin², as a series where the quotient would be rounding error.
        let series = -(sin2.mul_add(sin2.mul_add(1.0 / 3.0, 0.5), 1.0));
        let rate = sin2.lt(1e-2).select(series, (1.0 - sin2).max(1e-12).ln() / sin2.max(1e-12));
        (nx.mul_add(x2, ny * y2) * rate * 0.5).exp() * ((nx + 1.0) * (ny + 1.0)).sqrt() * (0.5 / PI)
    }
    /// A half vector with that density.
    #[inline(always)]
    fn sample_phong(&self, u: [F<L>; 2]) -> Vec3<L> {
        let (nx, ny) = (exponent(self.x), exponent(self.y));
        let (sin, cos) = u[0].sin_cos_turns();
        let (x, y) = (cos * (ny + 1.0).sqrt(), sin * (nx + 1.0).sqrt());
        let inverse = x.mul_add(x, y * y).inverse_root();
        let (x, y) = (x * inverse, y * inverse);
        let power = nx.mul_add(x * x, ny * y * y) + 1.0;
        let z = (1.0 - u[1]).max(1e-12).pow(power.recip());
        let sin = (1.0 - z * z).safe_sqrt();
        Vec3::new(x * sin, y * sin, z)
    }
}

/// Beckmann's density at `h` × masking / cosine of `wo`; a function of its own, since few surfaces ask for it.
#[inline(never)]
pub(crate) fn beckmann<L: Lanes>(l: L, widths: &Widths<L>, wo: Vec3<L>, wi: Vec3<L>, h: Vec3<L>) -> F<L> {
    l.vectorize(
        #[inline(always)]
        || widths.beckmann(h) / (wo.z * (widths.beckmann_lambda(wo) + widths.beckmann_lambda(wi) + 1.0)),
    )
}

/// [`Widths::phong`] as a function of its own.
#[inline(never)]
pub(crate) fn phong<L: Lanes>(l: L, widths: &Widths<L>, h: Vec3<L>) -> F<L> {
    l.vectorize(
        #[inline(always)]
        || widths.phong(h),
    )
}

/// [`Widths::sample_phong`] as a function of its own.
#[inline(never)]
pub(crate) fn sample_phong<L: Lanes>(l: L, widths: &Widths<L>, u: [F<L>; 2]) -> Vec3<L> {
    l.vectorize(
        #[inline(always)]
        || widths.sample_phong(u),
    )
}
