//! Fuzz: fibres standing off the surface, as a linearly transformed cosine (Zeltner, Burley, Chiang 2022) or as Charlie
//! (Estevez, Kulla 2017).

use super::diffuse::DiffuseLobe;
use super::energy;
use core::f32::consts::FRAC_1_PI;
use gonio_simd::{F, Lanes, Vec3};

/// The lobe at one view; its colour is the slot's weight.
#[derive(Clone, Copy, Debug)]
pub(crate) enum FuzzLobe<L: Lanes> {
    /// The transformed cosine.
    Zeltner {
        /// Direction of the projected view.
        azimuth: [F<L>; 2],
        /// Inverse transform: x' = a x + b z, y' = a y.
        inverse: [F<L>; 2],
        /// Albedo at the view.
        albedo: F<L>,
    },
    /// Charlie, sampled evenly over the hemisphere: its value has no peak, and at grazing views little of a cosine.
    Charlie {
        /// 1 / alpha.
        power: F<L>,
    },
    /// Velvet (Ashikhmin, Premože, Shirley 2000), sampled evenly over the hemisphere.
    Velvet {
        /// 1 / σ².
        rate: F<L>,
    },
}

impl<L: Lanes> FuzzLobe<L> {
    /// The lobe of roughness `r` seen from `wo`, and its albedo.
    #[inline(always)]
    pub(crate) fn zeltner(wo: Vec3<L>, r: F<L>) -> (Self, F<L>) {
        let l = r.lanes();
        let mu = wo.z.saturate();
        let [albedo, a, b] = energy::fuzz(l, r.max(1e-3), mu);
        let radius2 = wo.x.mul_add(wo.x, wo.y * wo.y);
        let inverse_radius = radius2.max(1e-20).inverse_root();
        let tilted = radius2.gt(1e-12);
        let azimuth = [tilted.select(wo.x * inverse_radius, l.f(1.0)), tilted.select(wo.y * inverse_radius, l.f(0.0))];
        (Self::Zeltner { azimuth, inverse: [a, b], albedo }, albedo)
    }
    /// The lobe of roughness `r` seen from `wo`, and its albedo.
    #[inline(always)]
    pub(crate) fn charlie(wo: Vec3<L>, r: F<L>) -> (Self, F<L>) {
        let albedo = energy::charlie(r.lanes(), r, wo.z.saturate());
        (Self::Charlie { power: (r * r).max(1e-3).recip() }, albedo)
    }
    /// The lobe of width `sigma`, and a guess of its albedo.
    #[inline(always)]
    pub(crate) fn velvet(sigma: F<L>) -> (Self, F<L>) {
        let sigma = sigma.max(0.01);
        (Self::Velvet { rate: (sigma * sigma).recip() }, sigma.lanes().f(0.5))
    }
    /// Value × cosine and pdf.
    #[inline(always)]
    pub(crate) fn eval(&self, wo: Vec3<L>, wi: Vec3<L>) -> (F<L>, F<L>) {
        let cos = wi.z.max(0.0);
        match *self {
            Self::Zeltner { azimuth, inverse: [a, b], albedo } => {
                let along = azimuth[0].mul_add(wi.x, azimuth[1] * wi.y);
                let across = azimuth[0].mul_add(wi.y, -(azimuth[1] * wi.x));
                let (x, y) = (a.mul_add(along, b * wi.z), a * across);
                let length2 = x.mul_add(x, y.mul_add(y, wi.z * wi.z));
                let pdf = cos * FRAC_1_PI * (a / length2.max(1e-20)).squared();
                (pdf * albedo, pdf)
            }
            Self::Charlie { power } => {
                let h = (wo + wi).normalize_or(wo);
                let sin = (1.0 - h.z * h.z).safe_sqrt();
                let density = (power + 2.0) * sin.max(1e-10).pow(power) * (0.5 * FRAC_1_PI);
                let view = wo.z.max(0.0);
                let value = density * cos / ((view + cos - view * cos) * 4.0).max(1e-6);
                let above = wi.z.gt(0.0);
                (value.keep_if(wo.z.gt(0.0) & above), above.select(cos.lanes().f(0.5 * FRAC_1_PI), cos.lanes().f(0.0)))
            }
            Self::Velvet { rate } => {
                let h = (wo + wi).normalize_or(wo);
                let sin2 = (1.0 - h.z * h.z).max(1e-7);
                let density = (-(h.z * h.z / sin2) * rate).exp() * rate * FRAC_1_PI / (sin2 * sin2);
                let groove = h.z / wo.dot(h).abs().max(1e-5) * 2.0;
                let masking = (groove * wo.z.min(cos)).min(1.0);
                let above = wi.z.gt(0.0);
                let value = density * masking * 0.25 / wo.z.max(1e-6);
                (value.keep_if(wo.z.gt(0.0) & above), above.select(cos.lanes().f(0.5 * FRAC_1_PI), cos.lanes().f(0.0)))
            }
        }
    }
    /// A direction with the pdf of [`Self::eval`].
    #[inline(always)]
    pub(crate) fn sample(&self, u: [F<L>; 2]) -> Vec3<L> {
        match *self {
            Self::Zeltner { azimuth, inverse: [a, b], .. } => {
                let cosine = DiffuseLobe::sample(u);
                let v = Vec3::new((cosine.x - cosine.z * b) / a, cosine.y / a, cosine.z).normalize_or(cosine);
                Vec3::new(azimuth[0] * v.x - azimuth[1] * v.y, azimuth[1].mul_add(v.x, azimuth[0] * v.y), v.z)
            }
            Self::Charlie { .. } | Self::Velvet { .. } => {
                let z = 1.0 - u[0];
                let (sin_phi, cos_phi) = u[1].sin_cos_turns();
                let sin = (1.0 - z * z).safe_sqrt();
                Vec3::new(sin * cos_phi, sin * sin_phi, z)
            }
        }
    }
}
