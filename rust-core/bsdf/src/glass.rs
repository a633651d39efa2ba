//! Rough or smooth dielectric interface: reflection and refraction chosen at the half vector (Walter et al. 2007).
//!
//! No radiance scaling with the squared index: light that enters and leaves keeps its value.

use super::film::Film;
use super::fresnel::{dielectric_share, normal_reflectance, schlick_share};
use super::microfacet::{MIRROR, Widths, beckmann};
use super::switches::Distribution;
use gonio_simd::{F, Lanes, M, Spectrum, Vec3};

/// Relative index differences up to this pass straight through.
const STRAIGHT: f32 = 1e-4;

/// Colours of an interface: what reflects, and what is kept from passing.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Interface<L: Lanes> {
    /// Far over near index.
    pub(crate) eta: F<L>,
    /// Reflection at normal incidence.
    pub(crate) f0: Spectrum<L>,
    /// Reflection at grazing.
    pub(crate) f90: Spectrum<L>,
    /// What is kept from passing at normal incidence; everything at grazing.
    pub(crate) kept: Spectrum<L>,
    /// Tint of what passes.
    pub(crate) passed: Spectrum<L>,
    /// Whether Schlick's curve stands for the exact one.
    pub(crate) schlick: bool,
    /// Whether everything passes but what is totally reflected, and nothing is reflected.
    pub(crate) refracts_only: bool,
    /// A film on it.
    pub(crate) film: Option<Film<L>>,
}

impl<L: Lanes> Interface<L> {
    /// An interface of index `eta` that takes no colour.
    #[inline(always)]
    pub(crate) fn clear(eta: F<L>) -> Self {
        let (normal, white) = (Spectrum::constant(normal_reflectance(eta)), Spectrum::one(eta.lanes()));
        Self { eta, f0: normal, f90: white, kept: normal, passed: white, schlick: false, refracts_only: false, film: None }
    }
    /// Reflected and passed colour at half-angle cosine `c`.
    #[inline(always)]
    pub(crate) fn split(&self, c: F<L>) -> [Spectrum<L>; 2] {
        let l = c.lanes();
        let white = Spectrum::one(l);
        if self.refracts_only {
            let total = (1.0 - c * c).ge(self.eta * self.eta);
            return [Spectrum::zero(l), self.passed.keep_if(!total)];
        }
        let share = if self.schlick {
            // Total internal reflection comes before the approximate curve.
            let total = (1.0 - c * c).ge(self.eta * self.eta);
            total.select(l.f(1.0), schlick_share(c))
        } else {
            dielectric_share(c, self.eta)
        };
        let reflected = self.f0.lerp(self.f90, share);
        let passed = (white - self.kept) * self.passed * (1.0 - share);
        let Some(film) = &self.film else { return [reflected, passed] };
        let [mirrored, kept] = film.over_two(c, self.eta, [[self.f0, self.f90], [self.kept, white]]);
        [reflected.lerp(mirrored, film.weight), passed.lerp((white - kept) * self.passed, film.weight)]
    }
    /// Probability of reflection at half-angle cosine `c`.
    #[inline(always)]
    fn reflects([reflected, passed]: [Spectrum<L>; 2]) -> F<L> {
        let (r, t) = (reflected.mean(), passed.mean());
        r / (r + t).max(1e-20)
    }
}

/// The lobe at one view.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GlassLobe<L: Lanes> {
    widths: Widths<L>,
    distribution: Distribution,
    interface: Interface<L>,
    /// Smooth lanes: evaluated nowhere, sampled exactly.
    pub(crate) delta: M<L>,
    stretch: F<L>,
}

impl<L: Lanes> GlassLobe<L> {
    /// Far over near index.
    #[inline(always)]
    pub(crate) fn eta(&self) -> F<L> {
        self.interface.eta
    }
    /// The lobe seen from `wo`.
    #[inline(always)]
    pub(crate) fn new(wo: Vec3<L>, widths: Widths<L>, interface: Interface<L>, distribution: Distribution) -> Self {
        let delta = (widths.x * widths.y).le(MIRROR) | (interface.eta - 1.0).abs().lt(STRAIGHT);
        let widths = Widths { x: widths.x.keep_if(!delta), y: widths.y.keep_if(!delta) };
        Self { widths, distribution: distribution.refracting(), interface, delta, stretch: widths.stretch(wo) }
    }
    /// Roughness r.
    #[inline(always)]
    pub(crate) fn roughness(&self) -> F<L> {
        self.widths.roughness()
    }
    /// Takes reflection or refraction away in chosen lanes.
    #[inline(always)]
    pub(crate) fn dim(&mut self, [reflecting, refracting]: [bool; 2], chosen: M<L>) {
        if reflecting {
            self.interface.f0 = self.interface.f0.keep_if(!chosen);
            self.interface.f90 = self.interface.f90.keep_if(!chosen);
        }
        if refracting {
            self.interface.passed = self.interface.passed.keep_if(!chosen);
        }
    }
    /// Value × cosine and pdf.
    #[inline(always)]
    pub(crate) fn eval(&self, wo: Vec3<L>, wi: Vec3<L>) -> (Spectrum<L>, F<L>) {
        let l = wo.x.lanes();
        let eta = self.interface.eta;
        let passes = wi.z.lt(0.0);
        // One half vector for both: the relative index is 1 in a reflection. It points to the upper side.
        let sum = wi * passes.select(eta, l.f(1.0)) + wo;
        let length2 = sum.length_squared().max(1e-20);
        let h = sum * sum.z.gt(0.0).select(l.f(1.0), l.f(-1.0)) * length2.inverse_root();
        let (c, d) = (wo.dot(h), wi.dot(h));
        let possible = wo.z.gt(0.0) & !self.delta & c.gt(0.0) & passes.select(d.lt(0.0), d.gt(0.0));
        let split = self.interface.split(c.saturate());
        let jacobian = passes.select(eta * eta * c * d.abs() / length2, l.f(0.25));
        let density = self.widths.distribution(h) * jacobian * 2.0;
        let (light, view) = (wi.z.abs(), wo.z);
        let value = if self.distribution == Distribution::Beckmann {
            beckmann(l, &self.widths, wo, wi, h) * jacobian
        } else {
            density * light / self.stretch.mul_add(light, self.widths.stretch(wi) * view)
        };
        let reflects = Interface::reflects(split);
        let pdf = density / (self.stretch + view) * passes.select(1.0 - reflects, reflects);
        ((passes.select(split[1], split[0]) * value).keep_if(possible), pdf.keep_if(possible))
    }
    /// A direction with the pdf of [`Self::eval`], and whether it ended on the side that `u[0]` chose.
    #[inline(always)]
    pub(crate) fn sample(&self, wo: Vec3<L>, u: [F<L>; 3]) -> (Vec3<L>, M<L>) {
        let l = wo.x.lanes();
        let h = self.widths.sample(wo, l.f(1.0), [u[1], u[2]]);
        let c = wo.dot(h);
        let reflects = Interface::reflects(self.interface.split(c.saturate()));
        let (refracted, squared) = refract(wo, h, self.interface.eta);
        let mirrored = u[0].lt(reflects);
        let wi = mirrored.select(wo.reflect(h), refracted);
        (wi, mirrored.select(wi.z.gt(0.0), wi.z.lt(0.0) & squared.gt(0.0)))
    }
    /// Value and probability of the smooth lanes for the side that `wi` lies on.
    #[inline(always)]
    pub(crate) fn smooth(&self, wo: Vec3<L>, wi: Vec3<L>) -> (Spectrum<L>, F<L>) {
        let split = self.interface.split(wo.z.saturate());
        let reflects = Interface::reflects(split);
        let passes = wi.z.lt(0.0);
        let usable = wo.z.gt(0.0);
        (passes.select(split[1], split[0]).keep_if(usable), passes.select(1.0 - reflects, reflects).keep_if(usable))
    }
}

/// Where a facet of normal `h` sends what it lets pass of light seen from `wo`, and the squared cosine there: not above 0 under total reflection.
/// `eta` = far over near index.
#[inline(always)]
pub(crate) fn refract<L: Lanes>(wo: Vec3<L>, h: Vec3<L>, eta: F<L>) -> (Vec3<L>, F<L>) {
    let (c, inverse) = (wo.dot(h), eta.recip());
    let squared = 1.0 - (1.0 - c * c) * inverse * inverse;
    (h * (c * inverse - squared.safe_sqrt()) - wo * inverse, squared)
}
