//! The resolved lobe list of a batch of hits: evaluation and sampling see nothing else.
//!
//! Which slots exist is the same for all lanes; weights differ. Every attenuation by layers above is in the weights already, but for the
//! light's way through a coloured coat.

use super::diffuse::DiffuseLobe;
use super::fuzz::FuzzLobe;
use super::glass::GlassLobe;
use super::reflect::ReflectLobe;
use gonio_simd::{F, Lanes, M, Rgb, Vec3};

/// Slots in a list.
pub const MAXIMUM: usize = 8;

/// The shape of a lobe.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Shape<L: Lanes> {
    /// Diffuse reflection.
    Diffuse(DiffuseLobe<L>),
    /// Glossy or mirror reflection.
    Reflect(ReflectLobe<L>),
    /// Reflection and refraction.
    Glass(GlassLobe<L>),
    /// Fuzz.
    Fuzz(FuzzLobe<L>),
}

/// A lobe in its place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slot<L: Lanes> {
    pub(crate) shape: Shape<L>,
    /// Factor on the lobe's value.
    pub(crate) weight: Rgb<L>,
    /// Share in the choice of lobes, not normalised.
    pub(crate) share: F<L>,
    /// Cosine and sine of the tangent's turn.
    pub(crate) turn: Option<[F<L>; 2]>,
    /// Whether the lobe sends light through the surface, as the mirror image of a reflection.
    pub(crate) mirrored: bool,
    /// Whether the light's way through the coat tints the lobe.
    pub(crate) coated: bool,
}

/// The coat's colour along the light's way in.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CoatTint<L: Lanes> {
    /// Logarithm of the colour.
    pub(crate) log: Rgb<L>,
    /// Presence of the coat.
    pub(crate) weight: F<L>,
    /// Index of the coat.
    pub(crate) ior: F<L>,
    /// Inverse cosine of the view's refracted direction.
    pub(crate) view: F<L>,
}

/// A sampled direction. `value / pdf` is the throughput factor; `pdf` 0 is a failed sample.
#[derive(Clone, Copy, Debug)]
pub struct BsdfSample<L: Lanes> {
    /// Direction towards the light, unit, in the shading frame.
    pub wi: Vec3<L>,
    /// BSDF × |cos θi|, or the weight of a delta lobe.
    pub value: Rgb<L>,
    /// Density per solid angle over all lobes, or the probability of a delta lobe.
    pub pdf: F<L>,
    /// Perfect mirror or smooth refraction: lights cannot be sampled for this direction.
    pub delta: M<L>,
    /// The direction is on the other side.
    pub transmitted: M<L>,
    /// Straight through a thin wall: the ray goes on as if nothing were there but the colour.
    pub straight: M<L>,
    /// Roughness r of the chosen lobe, 1 for diffuse ones.
    pub roughness: F<L>,
}

/// The lobes of a batch of hits.
#[derive(Clone, Copy, Debug)]
pub struct Lobes<L: Lanes> {
    slots: [Option<Slot<L>>; MAXIMUM],
    count: usize,
    total: F<L>,
    albedo: Rgb<L>,
    pub(crate) coat: Option<CoatTint<L>>,
    pub(crate) emission: Rgb<L>,
    pub(crate) opacity: F<L>,
}

/// A direction in a frame whose tangent is turned by an angle of this cosine and sine.
#[inline(always)]
pub(crate) fn turned<L: Lanes>(v: Vec3<L>, turn: Option<[F<L>; 2]>) -> Vec3<L> {
    match turn {
        Some([cos, sin]) => Vec3::new(cos.mul_add(v.x, sin * v.y), cos.mul_add(v.y, -(sin * v.x)), v.z),
        None => v,
    }
}

/// A direction, usable where it is over the surface.
#[inline(always)]
fn above<L: Lanes>(wi: Vec3<L>) -> (Vec3<L>, M<L>) {
    (wi, wi.z.gt(0.0))
}

impl<L: Lanes> Slot<L> {
    /// A direction in the frame that the shape is defined in.
    #[inline(always)]
    fn in_shape_frame(&self, v: Vec3<L>) -> Vec3<L> {
        turned(v, self.turn)
    }
    /// A direction back in the shading frame.
    #[inline(always)]
    fn in_shading_frame(&self, v: Vec3<L>) -> Vec3<L> {
        let z = if self.mirrored { -v.z } else { v.z };
        match self.turn {
            Some([cos, sin]) => Vec3::new(cos.mul_add(v.x, -(sin * v.y)), cos.mul_add(v.y, sin * v.x), z),
            None => Vec3::new(v.x, v.y, z),
        }
    }
    /// Value × cosine and pdf of the lobe alone, with its weight.
    #[inline(always)]
    fn eval(&self, wo: Vec3<L>, wi: Vec3<L>) -> (Rgb<L>, F<L>) {
        let wo = self.in_shape_frame(wo);
        let mut wi = self.in_shape_frame(wi);
        if self.mirrored {
            wi.z = -wi.z;
        }
        let (value, pdf) = match &self.shape {
            Shape::Diffuse(lobe) => lobe.eval(wo, wi),
            Shape::Reflect(lobe) => lobe.eval(wo, wi),
            Shape::Glass(lobe) => lobe.eval(wo, wi),
            Shape::Fuzz(lobe) => {
                let (value, pdf) = lobe.eval(wo, wi);
                (Rgb::grey(value), pdf)
            }
        };
        (value * self.weight, pdf)
    }
    /// A direction of the lobe, and whether it is on the side it was meant for; `u[0]` is what the choice of lobes left over.
    #[inline(always)]
    fn sample(&self, wo: Vec3<L>, u: [F<L>; 3]) -> (Vec3<L>, M<L>) {
        let wo = self.in_shape_frame(wo);
        let (wi, usable) = match &self.shape {
            Shape::Diffuse(_) => above(DiffuseLobe::sample([u[1], u[2]])),
            Shape::Reflect(lobe) => above(lobe.sample(wo, [u[1], u[2]])),
            Shape::Glass(lobe) => lobe.sample(wo, u),
            Shape::Fuzz(lobe) => above(lobe.sample([u[1], u[2]])),
        };
        (self.in_shading_frame(wi), usable)
    }
    /// Lanes in which the lobe is a mirror or smooth.
    #[inline(always)]
    fn delta(&self, l: L) -> M<L> {
        match &self.shape {
            Shape::Reflect(lobe) => lobe.delta,
            Shape::Glass(lobe) => lobe.delta,
            Shape::Diffuse(_) | Shape::Fuzz(_) => l.m(false),
        }
    }
    /// Weight and probability of the delta lanes for the direction `wi`.
    #[inline(always)]
    fn delta_eval(&self, l: L, wo: Vec3<L>, wi: Vec3<L>) -> (Rgb<L>, F<L>) {
        let (value, pdf) = match &self.shape {
            Shape::Reflect(lobe) => (lobe.mirror(wo), l.f(1.0)),
            Shape::Glass(lobe) => lobe.smooth(wo, wi),
            Shape::Diffuse(_) | Shape::Fuzz(_) => (Rgb::zero(l), l.f(0.0)),
        };
        (value * self.weight, pdf)
    }
    /// Roughness r.
    #[inline(always)]
    fn roughness(&self, l: L) -> F<L> {
        match &self.shape {
            Shape::Reflect(lobe) => lobe.roughness(),
            Shape::Glass(lobe) => lobe.roughness(),
            Shape::Diffuse(_) | Shape::Fuzz(_) => l.f(1.0),
        }
    }
}

impl<L: Lanes> CoatTint<L> {
    /// Colour of the way in and out for light from `wi`; a transmitted direction counts as the view's.
    #[inline(always)]
    fn colour(&self, wi: Vec3<L>) -> Rgb<L> {
        let cos = (1.0 - (1.0 - wi.z * wi.z) / (self.ior * self.ior)).max(1e-4).sqrt();
        let light = wi.z.gt(0.0).select(cos.recip(), self.view);
        self.along((light + self.view) * 0.5)
    }
    /// Colour over a path of this many normal passages both ways.
    #[inline(always)]
    pub(crate) fn along(&self, path: F<L>) -> Rgb<L> {
        let white = Rgb::grey(path.lanes().f(1.0));
        white.lerp(Rgb::new((self.log.r * path).exp(), (self.log.g * path).exp(), (self.log.b * path).exp()), self.weight)
    }
}

impl<L: Lanes> Lobes<L> {
    /// A surface that neither scatters nor emits.
    #[inline(always)]
    pub fn empty(l: L) -> Self {
        Self {
            slots: [None; MAXIMUM],
            count: 0,
            total: l.f(0.0),
            albedo: Rgb::zero(l),
            coat: None,
            emission: Rgb::zero(l),
            opacity: l.f(1.0),
        }
    }
    /// Adds a lobe whose albedo, weight included, is about `albedo`; its share in the choice is the albedo's mean.
    #[inline(always)]
    pub(crate) fn push(&mut self, mut slot: Slot<L>, albedo: Rgb<L>) {
        slot.share = albedo.mean().max(0.0).keep_if(slot.weight.is_lit());
        self.total += slot.share;
        self.albedo += albedo;
        self.slots[self.count] = Some(slot);
        self.count += 1;
    }
    /// BSDF × |cos θi| of all lobes but delta ones, and the density with which [`Self::sample`] finds `wi`.
    #[inline(always)]
    pub fn eval(&self, l: L, wo: Vec3<L>, wi: Vec3<L>) -> (Rgb<L>, F<L>) {
        let mut sum = Rgb::zero(l);
        let mut density = l.f(0.0);
        #[allow(clippy::manual_map, reason = "a closure may stay a call outside the level's instructions")]
        let coat = match &self.coat {
            Some(coat) => Some(coat.colour(wi)),
            None => None,
        };
        for slot in self.slots[..self.count].iter().flatten() {
            let (mut value, pdf) = slot.eval(wo, wi);
            if let (true, Some(tint)) = (slot.coated, coat) {
                value = value * tint;
            }
            sum += value;
            density = slot.share.mul_add(pdf, density);
        }
        (sum, density / self.total.max(1e-20))
    }
    /// Chooses a lobe by its share, samples it and evaluates all of them there (one-sample balance heuristic).
    #[inline(always)]
    pub fn sample(&self, l: L, wo: Vec3<L>, u: [F<L>; 3]) -> BsdfSample<L> {
        let nothing = l.m(false);
        let mut sample = BsdfSample {
            wi: Vec3::splat(l, [0.0, 0.0, 1.0]),
            value: Rgb::zero(l),
            pdf: l.f(0.0),
            delta: nothing,
            transmitted: nothing,
            straight: nothing,
            roughness: l.f(1.0),
        };
        let mut point = u[0] * self.total;
        let (mut passed, mut found) = (nothing, nothing);
        for slot in self.slots[..self.count].iter().flatten() {
            let here = point.lt(slot.share).and_not(passed);
            if here.any() {
                let rest = (point / slot.share.max(1e-20)).clamp(0.0, 0.999_999_94);
                found |= here & self.choose(l, wo, slot, here, [rest, u[1], u[2]], &mut sample);
            }
            passed |= here;
            point -= slot.share;
        }
        let (value, pdf) = self.eval(l, wo, sample.wi);
        sample.value = sample.delta.select(sample.value, value).keep_if(found);
        sample.pdf = sample.delta.select(sample.pdf, pdf).keep_if(found & sample.value.is_lit());
        sample.transmitted = sample.wi.z.lt(0.0);
        sample
    }
    /// Fills the lanes `here` with a direction of `slot`, and with value and pdf where it is a delta lobe; returns where it is usable.
    #[inline(always)]
    fn choose(&self, l: L, wo: Vec3<L>, slot: &Slot<L>, here: M<L>, u: [F<L>; 3], sample: &mut BsdfSample<L>) -> M<L> {
        let (wi, usable) = slot.sample(wo, u);
        sample.wi = here.select(wi, sample.wi);
        sample.roughness = here.select(slot.roughness(l), sample.roughness);
        let delta = here & slot.delta(l);
        if !delta.any() {
            return usable;
        }
        let (mut value, pdf) = slot.delta_eval(l, wo, sample.wi);
        if let (true, Some(coat)) = (slot.coated, &self.coat) {
            value = value * coat.colour(sample.wi);
        }
        sample.value = delta.select(value, sample.value);
        sample.pdf = delta.select(pdf * slot.share / self.total.max(1e-20), sample.pdf);
        sample.delta |= delta;
        if slot.mirrored {
            sample.straight |= delta;
        }
        usable
    }
    /// Where some lobe is not a delta, so that lights can be sampled for it; and where every lobe there is is one, as in mirrors and clear glass.
    #[inline(always)]
    pub fn smoothness(&self, l: L) -> [M<L>; 2] {
        let (mut smooth, mut sharp) = (l.m(false), l.m(false));
        for slot in self.slots[..self.count].iter().flatten() {
            let (present, delta) = (slot.share.gt(0.0), slot.delta(l));
            smooth |= present.and_not(delta);
            sharp |= present & delta;
        }
        [smooth, sharp.and_not(smooth)]
    }
    /// Estimate of the directional albedo of all lobes together, for the albedo pass.
    #[inline(always)]
    pub fn albedo(&self) -> Rgb<L> {
        self.albedo
    }
    /// Emitted radiance towards the view, of the part that opacity leaves.
    #[inline(always)]
    pub fn emission(&self) -> Rgb<L> {
        self.emission
    }
    /// What passes straight through towards a light: what opacity leaves open, and smooth thin walls.
    #[inline(always)]
    pub fn transmittance(&self, l: L, wo: Vec3<L>) -> Rgb<L> {
        let mut sum = Rgb::zero(l);
        for slot in self.slots[..self.count].iter().flatten().filter(|slot| slot.mirrored) {
            let tint = match (slot.coated, &self.coat) {
                (true, Some(coat)) => coat.along(coat.view),
                _ => Rgb::grey(l.f(1.0)),
            };
            sum += (slot.delta_eval(l, wo, -wo).0 * tint).keep_if(slot.delta(l));
        }
        sum.lerp(Rgb::grey(l.f(1.0)), 1.0 - self.opacity)
    }
    /// Share of the surface that is there; lobes and emission are those of that share, not multiplied by it.
    #[inline(always)]
    pub fn opacity(&self) -> F<L> {
        self.opacity
    }
}
