//! One interface of a fibre that is rough, met from a known direction: GGX facets about the normal of a scale of the cuticle.

use super::super::energy;
use super::super::fresnel::dielectric;
use super::super::glass::refract;
use super::super::microfacet::Widths;
use gonio_simd::{F, Frame, Lanes, M, Vec3};

/// The interface, met from one side.
#[derive(Clone, Copy, Debug)]
pub(super) struct Facets<L: Lanes> {
    /// The scale's normal, on the side where the light is.
    normal: Vec3<L>,
    /// The direction from which it is met.
    from: Vec3<L>,
}

/// What an interface is made of.
#[derive(Clone, Copy, Debug)]
pub(super) struct Interface<L: Lanes> {
    /// Width of the facets.
    pub(super) alpha: F<L>,
    /// Far over near index.
    pub(super) eta: F<L>,
}

impl<L: Lanes> Interface<L> {
    #[inline(always)]
    fn widths(&self) -> Widths<L> {
        Widths::isotropic(self.alpha)
    }
}

impl<L: Lanes> Facets<L> {
    #[inline(always)]
    pub(super) fn new(from: Vec3<L>, normal: Vec3<L>) -> Self {
        Self { normal, from }
    }
    /// The one of two.
    #[inline(always)]
    pub(super) fn select(mask: M<L>, a: &Self, b: &Self) -> Self {
        Self { normal: mask.select(a.normal, b.normal), from: mask.select(a.from, b.from) }
    }
    /// Cosine of the angle at which it is met.
    #[inline(always)]
    pub(super) fn cosine(&self) -> F<L> {
        self.from.dot(self.normal)
    }
    /// Whether it is met from its side: above the scale and above the round surface.
    #[inline(always)]
    pub(super) fn is_met(&self) -> M<L> {
        self.cosine().gt(0.0) & self.is_above(self.from)
    }
    /// Whether a direction is on the side from which it is met, as far as the surface under the scales tells.
    #[inline(always)]
    fn is_above(&self, v: Vec3<L>) -> M<L> {
        v.y.mul_add(self.normal.y, v.z * self.normal.z).gt(0.0)
    }
    /// The factor that makes up for light which is lost between facets.
    #[inline(always)]
    pub(super) fn gain(&self, interface: &Interface<L>) -> F<L> {
        let [albedo, _] = energy::glass(self.from.x.lanes(), interface.alpha.sqrt(), self.cosine().clamp(1e-4, 1.0), interface.eta);
        albedo.max(1e-3).recip()
    }
    /// A facet that is seen.
    #[inline(always)]
    pub(super) fn sample(&self, interface: &Interface<L>, u: [F<L>; 2]) -> Vec3<L> {
        let frame = Frame::from_normal(self.normal);
        frame.to_world(interface.widths().sample(frame.to_local(self.from), self.from.x.lanes().f(1.0), u))
    }
    /// About what it reflects of the light. Facets that are seen turn towards where they are seen from, the more the wider they are spread.
    #[inline(always)]
    pub(super) fn mostly_reflected(&self, interface: &Interface<L>) -> F<L> {
        dielectric(self.mostly(interface), interface.eta)
    }
    /// About what it lets pass, of light from inside: some even where smooth interfaces reflect totally.
    #[inline(always)]
    pub(super) fn mostly_passed(&self, interface: &Interface<L>) -> F<L> {
        let middle = self.mostly(interface);
        let spread = (1.0 - middle * middle).safe_sqrt() * interface.alpha * 0.9;
        let [below, above] = [(middle - spread).saturate(), (middle + spread).min(1.0)].map(
            #[inline(always)]
            |cosine| dielectric(cosine, interface.eta),
        );
        (1.0 - dielectric(middle, interface.eta).lerp((below + above) * 0.5, 0.5)).max(interface.alpha * 0.2)
    }
    /// The usual cosine with a facet that is seen, fitted at widths about 0.3.
    #[inline(always)]
    fn mostly(&self, interface: &Interface<L>) -> F<L> {
        let squared = self.cosine().saturate().squared();
        (interface.alpha.squared() * 1.3).mul_add(1.0 - squared, squared).min(1.0).sqrt()
    }
    /// What a facet reflects of the light.
    #[inline(always)]
    fn reflectance(&self, interface: &Interface<L>, facet: Vec3<L>) -> F<L> {
        dielectric(self.from.dot(facet).saturate(), interface.eta)
    }
    /// Where light goes that a facet lets pass, and how much of all light that is.
    #[inline(always)]
    pub(super) fn let_in(&self, interface: &Interface<L>, u: [F<L>; 2]) -> (Vec3<L>, F<L>) {
        let facet = self.sample(interface, u);
        let (to, left) = self.refracted(interface, facet);
        (to, left * (1.0 - self.reflectance(interface, facet)))
    }
    /// Where light goes that a facet reflects, how much of all light that is, and what it would be without other facets.
    #[inline(always)]
    pub(super) fn mirror(&self, interface: &Interface<L>, u: [F<L>; 2]) -> (Vec3<L>, [F<L>; 2]) {
        let facet = self.sample(interface, u);
        let (to, left) = self.reflected(interface, facet);
        let reflectance = self.reflectance(interface, facet);
        (to, [left * reflectance, reflectance])
    }
    /// Where a facet sends what it reflects; and the share of it that other facets leave, none where it is sent under the surface.
    #[inline(always)]
    pub(super) fn reflected(&self, interface: &Interface<L>, facet: Vec3<L>) -> (Vec3<L>, F<L>) {
        let to = self.from.reflect(facet);
        let cosine = to.dot(self.normal);
        (to, self.left(interface, cosine).keep_if(cosine.gt(0.0) & self.is_above(to)))
    }
    /// The same of what it lets pass.
    #[inline(always)]
    pub(super) fn refracted(&self, interface: &Interface<L>, facet: Vec3<L>) -> (Vec3<L>, F<L>) {
        let (to, squared) = refract(self.from, facet, interface.eta);
        let cosine = to.dot(self.normal);
        let passes = squared.gt(0.0) & self.from.dot(facet).gt(0.0) & cosine.lt(0.0) & self.is_above(-to);
        (to, self.left(interface, cosine).keep_if(passes))
    }
    /// Masking of the way out, given that the facet was seen on the way in.
    #[inline(always)]
    fn left(&self, interface: &Interface<L>, cosine: F<L>) -> F<L> {
        let (light, view) = (cosine.abs(), self.cosine().max(1e-6));
        let (into, out) = (stretch(interface.alpha, view), stretch(interface.alpha, light));
        light * (into + view) / into.mul_add(light, out * view).max(1e-20)
    }
    /// Value with its cosine and pdf of what facets reflect to a direction, or let pass.
    #[inline(always)]
    pub(super) fn eval(&self, interface: &Interface<L>, to: Vec3<L>, passes: bool) -> [F<L>; 2] {
        let l = to.x.lanes();
        let frame = Frame::from_normal(self.normal);
        let (from, to_local) = (frame.to_local(self.from), frame.to_local(to));
        let eta = if passes { interface.eta } else { l.f(1.0) };
        let sum = to_local * eta + from;
        let length2 = sum.length_squared().max(1e-20);
        let facet = sum * length2.inverse_root().copysign(sum.z);
        let (c, d) = (from.dot(facet), to_local.dot(facet));
        let (jacobian, side) = if passes {
            (eta * eta * c * d.abs() / length2, d.lt(0.0) & to_local.z.lt(0.0) & self.is_above(-to))
        } else {
            (l.f(0.25), d.gt(0.0) & to_local.z.gt(0.0) & self.is_above(to))
        };
        let possible = side & c.gt(0.0) & from.z.gt(0.0);
        let pdf = interface.widths().distribution(facet) * jacobian * 2.0 / (stretch(interface.alpha, from.z) + from.z);
        let reflectance = dielectric(c.saturate(), interface.eta);
        let share = if passes { 1.0 - reflectance } else { reflectance };
        [(share * pdf * self.left(interface, to_local.z)).keep_if(possible), pdf.keep_if(possible)]
    }
}

/// t of `microfacet.rs` for equal widths, of a direction's cosine.
#[inline(always)]
fn stretch<L: Lanes>(alpha: F<L>, cosine: F<L>) -> F<L> {
    let squared = cosine * cosine;
    (alpha * alpha * (1.0 - squared).max(0.0) + squared).sqrt()
}
