//! Rough or smooth dielectric interface: reflection and refraction chosen at the half vector (Walter et al. 2007).
//!
//! No radiance scaling with the squared index: light that enters and leaves keeps its value.

use super::dispersion::Spread;
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
    /// Far over near index; of glass that disperses, the one that is stated.
    pub(crate) eta: F<L>,
    /// The index by wavelength, where wavelengths part ways.
    pub(crate) spread: Option<Spread<L>>,
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
    pub(crate) fn clear(eta: F<L>, spread: Option<Spread<L>>) -> Self {
        let normal = match &spread {
            Some(spread) => spread.normal_reflectance(),
            None => Spectrum::constant(normal_reflectance(eta)),
        };
        let white = Spectrum::one(eta.lanes());
        Self { eta, spread, f0: normal, f90: white, kept: normal, passed: white, schlick: false, refracts_only: false, film: None }
    }
    /// Reflected and passed colour at half-angle cosine `c`.
    #[inline(always)]
    pub(crate) fn split(&self, c: F<L>) -> [Spectrum<L>; 2] {
        match &self.spread {
            Some(spread) => self.split_spread(spread, Spectrum::constant(c)),
            None => self.split_at(c, self.eta),
        }
    }
    /// The same at a cosine for each wavelength.
    #[inline(always)]
    fn split_spread(&self, spread: &Spread<L>, c: Spectrum<L>) -> [Spectrum<L>; 2] {
        c.own(
            spread.etas,
            #[inline(always)]
            |c, eta| self.split_at(c, eta),
        )
    }
    /// The same by an index.
    #[inline(always)]
    fn split_at(&self, c: F<L>, eta: F<L>) -> [Spectrum<L>; 2] {
        let l = c.lanes();
        let white = Spectrum::one(l);
        if self.refracts_only {
            let total = (1.0 - c * c).ge(eta * eta);
            return [Spectrum::zero(l), self.passed.keep_if(!total)];
        }
        let share = if self.schlick {
            // Total internal reflection comes before the approximate curve.
            let total = (1.0 - c * c).ge(eta * eta);
            total.select(l.f(1.0), schlick_share(c))
        } else {
            dielectric_share(c, eta)
        };
        let reflected = self.f0.lerp(self.f90, share);
        let passed = (white - self.kept) * self.passed * (1.0 - share);
        let Some(film) = &self.film else { return [reflected, passed] };
        let [mirrored, kept] = film.over_two(c, eta, [[self.f0, self.f90], [self.kept, white]]);
        [reflected.lerp(mirrored, film.weight), passed.lerp((white - kept) * self.passed, film.weight)]
    }
    /// Probability of reflection at half-angle cosine `c`.
    #[inline(always)]
    fn reflects([reflected, passed]: [Spectrum<L>; 2]) -> F<L> {
        let (r, t) = (reflected.mean(), passed.mean());
        r / (r + t).max(1e-20)
    }
    /// The same of each wavelength by itself.
    #[inline(always)]
    fn reflects_each([reflected, passed]: [Spectrum<L>; 2]) -> Spectrum<L> {
        let [reflects] = reflected.zip(
            passed,
            #[inline(always)]
            |r, t| [r / (r + t).max(1e-20)],
        );
        reflects
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
    /// Square of the far over the near index.
    #[inline(always)]
    pub(crate) fn squared_index(&self) -> Spectrum<L> {
        match &self.interface.spread {
            Some(spread) => spread.etas * spread.etas,
            None => Spectrum::constant(self.interface.eta * self.interface.eta),
        }
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
        let passes = wi.z.lt(0.0);
        let Some(spread) = &self.interface.spread else {
            let (c, [value, density], possible) = self.facets(wo, wi, self.interface.eta);
            let split = self.interface.split(c);
            let reflects = Interface::reflects(split);
            let pdf = density * passes.select(1.0 - reflects, reflects);
            return ((passes.select(split[1], split[0]) * value).keep_if(possible), pdf.keep_if(possible));
        };
        let [c, value, density] = spread.etas.zip(
            spread.etas,
            #[inline(always)]
            |eta, _| {
                let (c, [value, density], possible) = self.facets(wo, wi, eta);
                [c, value.keep_if(possible), density.keep_if(possible)]
            },
        );
        let split = self.interface.split_spread(spread, c);
        let reflects = Interface::reflects_each(split);
        let chosen = passes.select(Spectrum::one(wo.x.lanes()) - reflects, reflects);
        (passes.select(split[1], split[0]) * value, spread.density(density * chosen))
    }
    /// At an index: the cosine of the facets that send light from `wi` to `wo`, value × cosine and pdf but for what the interface makes of them, and where
    /// there are such facets.
    #[inline(always)]
    fn facets(&self, wo: Vec3<L>, wi: Vec3<L>, eta: F<L>) -> (F<L>, [F<L>; 2], M<L>) {
        let l = wo.x.lanes();
        let passes = wi.z.lt(0.0);
        // One half vector for both: the relative index is 1 in a reflection. It points to the upper side.
        let sum = wi * passes.select(eta, l.f(1.0)) + wo;
        let length2 = sum.length_squared().max(1e-20);
        let h = sum * sum.z.gt(0.0).select(l.f(1.0), l.f(-1.0)) * length2.inverse_root();
        let (c, d) = (wo.dot(h), wi.dot(h));
        let possible = wo.z.gt(0.0) & !self.delta & c.gt(0.0) & passes.select(d.lt(0.0), d.gt(0.0));
        let jacobian = passes.select(eta * eta * c * d.abs() / length2, l.f(0.25));
        let density = self.widths.distribution(h) * jacobian * 2.0;
        let (light, view) = (wi.z.abs(), wo.z);
        let value = if self.distribution == Distribution::Beckmann {
            beckmann(l, &self.widths, wo, wi, h) * jacobian
        } else {
            density * light / self.stretch.mul_add(light, self.widths.stretch(wi) * view)
        };
        (c.saturate(), [value, density / (self.stretch + view)], possible)
    }
    /// A direction with the pdf of [`Self::eval`], and whether it ended on the side that `u[0]` chose.
    #[inline(always)]
    pub(crate) fn sample(&self, wo: Vec3<L>, u: [F<L>; 3]) -> (Vec3<L>, M<L>) {
        let l = wo.x.lanes();
        let h = self.widths.sample(wo, l.f(1.0), [u[1], u[2]]);
        let c = wo.dot(h);
        let split = self.interface.split(c.saturate());
        let [reflects, eta, u_side] = match &self.interface.spread {
            Some(spread) => spread.draw(u[0], Interface::reflects_each(split)),
            None => [Interface::reflects(split), self.interface.eta, u[0]],
        };
        let (refracted, squared) = refract(wo, h, eta);
        let mirrored = u_side.lt(reflects);
        let wi = mirrored.select(wo.reflect(h), refracted);
        (wi, mirrored.select(wi.z.gt(0.0), wi.z.lt(0.0) & squared.gt(0.0)))
    }
    /// Value and probability of the smooth lanes for the side that `wi` lies on.
    #[inline(always)]
    pub(crate) fn smooth(&self, wo: Vec3<L>, wi: Vec3<L>) -> (Spectrum<L>, F<L>) {
        let split = self.interface.split(wo.z.saturate());
        let (passes, usable) = (wi.z.lt(0.0), wo.z.gt(0.0));
        if let Some(spread) = &self.interface.spread {
            let (reflects, bent, white) = (Interface::reflects_each(split), spread.bent(wo, wi), Spectrum::one(wo.x.lanes()));
            let chosen = passes.select((white - reflects) * bent, reflects);
            let value = passes.select(split[1] * bent, split[0]);
            return (value.keep_if(usable), spread.density(chosen).keep_if(usable));
        }
        let reflects = Interface::reflects(split);
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
