//! The resolved lobe list of a batch of hits: evaluation and sampling see nothing else.
//!
//! Which slots exist is the same for all lanes; weights differ. Every attenuation by layers above is in the weights already, but for the
//! light's way through a coloured coat.

mod sharp;

pub use sharp::{SharpRay, Way};

use super::diffuse::DiffuseLobe;
use super::fuzz::FuzzLobe;
use super::glass::GlassLobe;
use super::measured::MeasuredLobe;
pub(crate) use super::normals::Normal;
use super::normals::Tilts;
use super::reflect::ReflectLobe;
use super::subsurface::{EntryLobe, Medium};
use gonio_simd::{F, Lanes, M, Rgb, Vec3};

/// Slots in a list.
pub const MAXIMUM: usize = 8;

/// The shape of a lobe.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Shape<'s, L: Lanes> {
    /// Diffuse reflection.
    Diffuse(DiffuseLobe<L>),
    /// Glossy or mirror reflection.
    Reflect(ReflectLobe<L>),
    /// Reflection and refraction.
    Glass(GlassLobe<L>),
    /// Fuzz.
    Fuzz(FuzzLobe<L>),
    /// Straight through.
    Straight,
    /// Into a medium.
    Subsurface(EntryLobe<L>),
    /// As measured.
    Measured(MeasuredLobe<'s, L>),
}

/// Where a lobe sends light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    /// Back.
    Reflected,
    /// Through the surface, as the mirror image of a reflection.
    Mirrored,
    /// Back and through.
    Both,
}

/// A lobe in its place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slot<'s, L: Lanes> {
    pub(crate) shape: Shape<'s, L>,
    /// Factor on the lobe's value.
    pub(crate) weight: Rgb<L>,
    /// Share in the choice of lobes, not normalised.
    pub(crate) share: F<L>,
    /// Cosine and sine of the tangent's turn.
    pub(crate) turn: Option<[F<L>; 2]>,
    pub(crate) side: Side,
    pub(crate) normal: Normal,
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
    /// The direction is on the other side of the normal that the chosen lobe is about.
    pub transmitted: M<L>,
    /// Straight through a thin wall: the ray goes on as if nothing were there but the colour.
    pub straight: M<L>,
    /// Into the medium under the surface, which [`Lobes::medium`] tells: `wi` is the first direction of a walk.
    pub entered: M<L>,
    /// The chosen lobe is diffuse, fuzz or subsurface.
    pub diffuse: M<L>,
    /// Roughness r of the chosen lobe, 1 for diffuse ones.
    pub roughness: F<L>,
}

impl<L: Lanes> BsdfSample<L> {
    /// No lobe was chosen yet.
    #[inline(always)]
    fn nothing(l: L) -> Self {
        let nothing = l.m(false);
        Self {
            wi: Vec3::splat(l, [0.0, 0.0, 1.0]),
            value: Rgb::zero(l),
            pdf: l.f(0.0),
            delta: nothing,
            transmitted: nothing,
            straight: nothing,
            entered: nothing,
            diffuse: nothing,
            roughness: l.f(1.0),
        }
    }
}

/// What an evaluation is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Asked {
    /// A direction that a light gave.
    All,
    /// A direction that the lobes gave: bump rules leave more open.
    Sampled,
    /// The part of a light's direction that is not of facets and interfaces.
    Diffuse,
}

/// The lobes of a batch of hits, with the measurements of the surface that they were resolved from.
#[derive(Clone, Copy, Debug)]
pub struct Lobes<'s, L: Lanes> {
    slots: [Option<Slot<'s, L>>; MAXIMUM],
    count: usize,
    total: F<L>,
    albedo: Rgb<L>,
    /// Albedos by kind: diffuse, glossy, transmitted.
    kinds: [Rgb<L>; 3],
    pub(crate) coat: Option<CoatTint<L>>,
    pub(crate) emission: Rgb<L>,
    pub(crate) opacity: F<L>,
    pub(crate) tilts: Tilts<L>,
    pub(crate) medium: Option<Medium<L>>,
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

impl<L: Lanes> Slot<'_, L> {
    /// A direction in the frame that the shape is defined in.
    #[inline(always)]
    fn in_shape_frame(&self, tilts: &Tilts<L>, v: Vec3<L>) -> Vec3<L> {
        turned(tilts.seen(self.normal, v), self.turn)
    }
    /// A direction back in the shading frame.
    #[inline(always)]
    fn in_shading_frame(&self, tilts: &Tilts<L>, v: Vec3<L>) -> Vec3<L> {
        let z = if self.side == Side::Mirrored { -v.z } else { v.z };
        let v = match self.turn {
            Some([cos, sin]) => Vec3::new(cos.mul_add(v.x, -(sin * v.y)), cos.mul_add(v.y, sin * v.x), z),
            None => Vec3::new(v.x, v.y, z),
        };
        match tilts.frame(self.normal) {
            Some(frame) => frame.to_world(v),
            None => v,
        }
    }
    /// Value × cosine and pdf of the lobe alone, with its weight.
    #[inline(always)]
    fn eval(&self, tilts: &Tilts<L>, wo: Vec3<L>, wi: Vec3<L>) -> (Rgb<L>, F<L>) {
        let wo = self.in_shape_frame(tilts, wo);
        let mut wi = self.in_shape_frame(tilts, wi);
        if self.side == Side::Mirrored {
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
            Shape::Measured(lobe) => lobe.eval(wo, wi),
            Shape::Straight | Shape::Subsurface(_) => return (Rgb::zero(wo.x.lanes()), wo.x.lanes().f(0.0)),
        };
        (value * self.weight, pdf)
    }
    /// A direction of the lobe, whether it is on the side it was meant for, and whether that is the other one; `u[0]` is what the choice of
    /// lobes left over.
    #[inline(always)]
    fn sample(&self, tilts: &Tilts<L>, wo: Vec3<L>, u: [F<L>; 3]) -> (Vec3<L>, [M<L>; 2]) {
        let wo = self.in_shape_frame(tilts, wo);
        let (wi, usable) = match &self.shape {
            Shape::Diffuse(_) => above(DiffuseLobe::sample([u[1], u[2]])),
            Shape::Reflect(lobe) => above(lobe.sample(wo, [u[1], u[2]])),
            Shape::Glass(lobe) => lobe.sample(wo, u),
            Shape::Fuzz(lobe) => above(lobe.sample([u[1], u[2]])),
            Shape::Straight => (Vec3::new(-wo.x, -wo.y, wo.z), wo.x.lanes().m(true)),
            Shape::Subsurface(lobe) => lobe.sample(wo, u),
            Shape::Measured(lobe) => lobe.sample(wo, u),
        };
        let through = match self.side {
            Side::Reflected => wi.x.lanes().m(false),
            Side::Mirrored => wi.x.lanes().m(true),
            Side::Both => wi.z.lt(0.0),
        };
        (self.in_shading_frame(tilts, wi), [usable, through])
    }
    /// Lanes in which the lobe is a mirror or smooth.
    #[inline(always)]
    fn delta(&self, l: L) -> M<L> {
        match &self.shape {
            Shape::Reflect(lobe) => lobe.delta,
            Shape::Glass(lobe) => lobe.delta,
            Shape::Straight => l.m(true),
            Shape::Diffuse(_) | Shape::Fuzz(_) | Shape::Subsurface(_) | Shape::Measured(_) => l.m(false),
        }
    }
    /// Weight and probability of the delta lanes for the direction `wi`.
    #[inline(always)]
    fn delta_eval(&self, l: L, tilts: &Tilts<L>, wo: Vec3<L>, wi: Vec3<L>) -> (Rgb<L>, F<L>) {
        let (wo, wi) = (tilts.seen(self.normal, wo), tilts.seen(self.normal, wi));
        let (value, pdf) = match &self.shape {
            Shape::Reflect(lobe) => (lobe.mirror(wo), l.f(1.0)),
            Shape::Glass(lobe) => lobe.smooth(wo, wi),
            Shape::Straight | Shape::Subsurface(_) => (Rgb::grey(l.f(1.0)), l.f(1.0)),
            Shape::Diffuse(_) | Shape::Fuzz(_) | Shape::Measured(_) => (Rgb::zero(l), l.f(0.0)),
        };
        (value * self.weight, pdf)
    }
    /// Roughness r.
    #[inline(always)]
    fn roughness(&self, l: L) -> F<L> {
        match &self.shape {
            Shape::Reflect(lobe) => lobe.roughness(),
            Shape::Glass(lobe) => lobe.roughness(),
            Shape::Straight => l.f(0.0),
            Shape::Measured(lobe) => l.f(lobe.roughness()),
            Shape::Diffuse(_) | Shape::Fuzz(_) | Shape::Subsurface(_) => l.f(1.0),
        }
    }
    /// Whether the bump rules count the lobe as diffuse.
    #[inline(always)]
    fn is_diffuse(&self) -> bool {
        matches!(self.shape, Shape::Diffuse(_) | Shape::Fuzz(_))
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

impl<'s, L: Lanes> Lobes<'s, L> {
    /// A surface that neither scatters nor emits.
    #[inline(always)]
    pub fn empty(l: L) -> Self {
        Self {
            // One by one: as a whole they would be filled with zeros.
            slots: std::array::from_fn(|_| None),
            count: 0,
            total: l.f(0.0),
            albedo: Rgb::zero(l),
            kinds: [Rgb::zero(l); 3],
            coat: None,
            emission: Rgb::zero(l),
            opacity: l.f(1.0),
            tilts: Tilts::NONE,
            medium: None,
        }
    }
    /// Makes it [`Self::empty`] again; what stands in the slots is not looked at.
    #[inline(always)]
    pub(crate) fn clear(&mut self, l: L) {
        (self.count, self.total, self.albedo, self.kinds) = (0, l.f(0.0), Rgb::zero(l), [Rgb::zero(l); 3]);
        (self.coat, self.emission, self.opacity) = (None, Rgb::zero(l), l.f(1.0));
        self.tilts.clear();
        self.medium = None;
    }
    /// A Lambert lobe alone.
    #[inline(always)]
    pub(crate) fn lambert(l: L, colour: Rgb<L>) -> Self {
        let mut lobes = Self::empty(l);
        let (shape, weight) = (Shape::Diffuse(DiffuseLobe::lambert(colour)), Rgb::grey(l.f(1.0)));
        lobes.push(Slot { shape, weight, share: l.f(0.0), turn: None, side: Side::Reflected, normal: Normal::Base, coated: false }, colour);
        lobes
    }
    /// Adds a lobe whose albedo, weight included, is about `albedo`; its share in the choice is the albedo's mean.
    #[inline(always)]
    pub(crate) fn push(&mut self, mut slot: Slot<'s, L>, albedo: Rgb<L>) {
        slot.share = albedo.mean().max(0.0).keep_if(slot.weight.is_lit());
        self.total += slot.share;
        self.albedo += albedo;
        match slot.shape {
            Shape::Reflect(_) => self.kinds[1] += albedo,
            // Glass does both; its parts are told apart by direction alone.
            Shape::Glass(_) => {
                self.kinds[1] += albedo;
                self.kinds[2] += albedo;
            }
            Shape::Measured(lobe) => {
                self.kinds[1] += albedo;
                if lobe.transmits() {
                    self.kinds[2] += albedo;
                }
            }
            Shape::Straight => self.kinds[2] += albedo,
            Shape::Diffuse(_) | Shape::Fuzz(_) | Shape::Subsurface(_) => self.kinds[0] += albedo,
        }
        self.slots[self.count] = Some(slot);
        self.count += 1;
    }
    /// BSDF × |cos θi| of all lobes but delta ones, and the density with which [`Self::sample`] finds `wi`.
    #[inline(always)]
    pub fn eval(&self, l: L, wo: Vec3<L>, wi: Vec3<L>) -> (Rgb<L>, F<L>) {
        evaluate(l, self, wo, wi, Asked::All)
    }
    /// The same for what is asked for.
    #[inline(always)]
    fn sum(&self, l: L, wo: Vec3<L>, wi: Vec3<L>, asked: Asked) -> (Rgb<L>, F<L>) {
        let mut sum = Rgb::zero(l);
        let mut density = l.f(0.0);
        #[allow(clippy::manual_map, reason = "a closure may stay a call outside the level's instructions")]
        let coat = match &self.coat {
            Some(coat) => Some(coat.colour(wi)),
            None => None,
        };
        for slot in self.slots[..self.count].iter().flatten() {
            if asked == Asked::Diffuse && matches!(slot.shape, Shape::Reflect(_) | Shape::Glass(_) | Shape::Measured(_)) {
                continue;
            }
            let (mut value, pdf) = slot.eval(&self.tilts, wo, wi);
            let open = asked == Asked::Sampled && (!slot.is_diffuse() || slot.side != Side::Reflected);
            if let Some(factor) = self.tilts.shadow(slot.normal, wi, slot.is_diffuse(), open) {
                value = value * factor;
            }
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
        let mut sample = BsdfSample::nothing(l);
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
        let (value, pdf) = evaluate(l, self, wo, sample.wi, Asked::Sampled);
        let alone = sample.delta | sample.entered;
        sample.value = alone.select(sample.value, value).keep_if(found);
        sample.pdf = alone.select(sample.pdf, pdf).keep_if(found);
        sample
    }
    /// Fills the lanes `here` with a direction of `slot`, and with value and pdf where it is a delta lobe; returns where it is usable.
    #[inline(always)]
    fn choose(&self, l: L, wo: Vec3<L>, slot: &Slot<'_, L>, here: M<L>, u: [F<L>; 3], sample: &mut BsdfSample<L>) -> M<L> {
        let (wi, [usable, through]) = slot.sample(&self.tilts, wo, u);
        sample.wi = here.select(wi, sample.wi);
        sample.transmitted |= here & through;
        sample.roughness = here.select(slot.roughness(l), sample.roughness);
        if !matches!(slot.shape, Shape::Reflect(_) | Shape::Glass(_) | Shape::Straight | Shape::Measured(_)) {
            sample.diffuse |= here;
        }
        let enters = matches!(slot.shape, Shape::Subsurface(_));
        let alone = if enters { here } else { here & slot.delta(l) };
        if !alone.any() {
            return usable;
        }
        let (mut value, pdf) = slot.delta_eval(l, &self.tilts, wo, sample.wi);
        if let (true, Some(coat)) = (slot.coated, &self.coat) {
            value = value * coat.colour(sample.wi);
        }
        sample.value = alone.select(value, sample.value);
        sample.pdf = alone.select(pdf * slot.share / self.total.max(1e-20), sample.pdf);
        if enters {
            sample.entered |= alone;
        } else {
            sample.delta |= alone;
        }
        if slot.side == Side::Mirrored {
            sample.straight |= alone;
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
    /// The same by kind: diffuse, glossy, transmitted; interfaces count as both of the latter.
    #[inline(always)]
    pub fn albedo_kinds(&self) -> [Rgb<L>; 3] {
        self.kinds
    }
    /// The diffuse part of [`Self::eval`]: all but facets and interfaces.
    #[inline(always)]
    pub fn eval_diffuse(&self, l: L, wo: Vec3<L>, wi: Vec3<L>) -> Rgb<L> {
        evaluate(l, self, wo, wi, Asked::Diffuse).0
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
        for slot in self.slots[..self.count].iter().flatten().filter(|slot| slot.side == Side::Mirrored) {
            let tint = match (slot.coated, &self.coat) {
                (true, Some(coat)) => coat.along(coat.view),
                _ => Rgb::grey(l.f(1.0)),
            };
            sum += (slot.delta_eval(l, &self.tilts, wo, -wo).0 * tint).keep_if(slot.delta(l));
        }
        sum.lerp(Rgb::grey(l.f(1.0)), 1.0 - self.opacity)
    }
    /// What samples marked as entered go into; none if there are no such samples.
    #[inline(always)]
    pub fn medium(&self) -> Option<&Medium<L>> {
        self.medium.as_ref()
    }
    /// Share of the surface that is there; lobes and emission are those of that share, not multiplied by it.
    #[inline(always)]
    pub fn opacity(&self) -> F<L> {
        self.opacity
    }
}

/// [`Lobes::sum`] as a function of its own, for evaluation and sampling alike.
#[inline(never)]
fn evaluate<L: Lanes>(l: L, lobes: &Lobes<'_, L>, wo: Vec3<L>, wi: Vec3<L>, asked: Asked) -> (Rgb<L>, F<L>) {
    l.vectorize(
        #[inline(always)]
        || lobes.sum(l, wo, wi, asked),
    )
}
