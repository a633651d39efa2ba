//! The resolved lobe list of a batch of hits: evaluation and sampling see nothing else.
//!
//! Which slots exist is the same for all lanes; weights differ. Every attenuation by layers above is in the weights already, but for the
//! light's way through a coloured coat.

mod coat_tint;
mod eval;
mod sample;
mod slot;
mod specular_rays;

pub(crate) use coat_tint::CoatTint;
pub(crate) use eval::{Asked, evaluate};
pub use sample::BsdfSample;
pub(crate) use slot::{Shape, Side, Slot};
pub use specular_rays::{SpecularRay, Way};

use super::diffuse::DiffuseLobe;
pub(crate) use super::normals::Normal;
use super::normals::Tilts;
use super::portal::Portal;
use super::subsurface::WalkMedium;
use gonio_simd::{F, Lanes, M, Spectrum, Vec3};

/// Slots in a list.
pub const MAXIMUM: usize = 8;

/// The lobes of a batch of hits, with the measurements of the surface that they were resolved from.
#[derive(Clone, Copy, Debug)]
pub struct Lobes<'s, L: Lanes> {
    slots: [Option<Slot<'s, L>>; MAXIMUM],
    count: usize,
    total: F<L>,
    albedo: Spectrum<L>,
    /// Albedos by kind: diffuse, glossy, transmitted.
    kinds: [Spectrum<L>; 3],
    pub(crate) coat: Option<CoatTint<L>>,
    pub(crate) emission: Spectrum<L>,
    pub(crate) opacity: F<L>,
    pub(crate) tilts: Tilts<L>,
    pub(crate) medium: Option<WalkMedium<L>>,
    pub(crate) portal: Option<Portal<L>>,
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
            albedo: Spectrum::zero(l),
            kinds: [Spectrum::zero(l); 3],
            coat: None,
            emission: Spectrum::zero(l),
            opacity: l.f(1.0),
            tilts: Tilts::NONE,
            medium: None,
            portal: None,
        }
    }
    /// Makes it [`Self::empty`] again; what stands in the slots is not looked at.
    #[inline(always)]
    pub(crate) fn clear(&mut self, l: L) {
        (self.count, self.total, self.albedo, self.kinds) = (0, l.f(0.0), Spectrum::zero(l), [Spectrum::zero(l); 3]);
        (self.coat, self.emission, self.opacity) = (None, Spectrum::zero(l), l.f(1.0));
        self.tilts.clear();
        self.medium = None;
        self.portal = None;
    }
    /// Takes facets and interfaces away in chosen lanes: what reflects, what refracts, or both. The lobes below stay as dim as they are.
    #[inline(always)]
    pub fn without_facets(&mut self, l: L, [reflecting, refracting]: [bool; 2], chosen: M<L>) {
        if !chosen.any() {
            return;
        }
        self.total = l.f(0.0);
        for slot in self.slots[..self.count].iter_mut().flatten() {
            let gone = match &mut slot.shape {
                Shape::Reflect(_) => reflecting,
                Shape::Toon(lobe) => reflecting && lobe.is_glossy(),
                Shape::Glass(lobe) => {
                    lobe.dim([reflecting, refracting], chosen);
                    reflecting && refracting
                }
                _ => false,
            };
            if gone {
                slot.weight = slot.weight.keep_if(!chosen);
                slot.share = slot.share.keep_if(!chosen);
            }
            self.total += slot.share;
        }
    }
    /// A Lambert lobe alone.
    #[inline(always)]
    pub(crate) fn lambert(l: L, colour: Spectrum<L>) -> Self {
        let mut lobes = Self::empty(l);
        let (shape, weight) = (Shape::Diffuse(DiffuseLobe::lambert(colour)), Spectrum::one(l));
        lobes.push(Slot { shape, weight, share: l.f(0.0), turn: None, side: Side::Reflected, normal: Normal::Base, coated: false }, colour);
        lobes
    }
    /// Adds a lobe whose albedo, weight included, is about `albedo`; its share in the choice is the albedo's mean.
    #[inline(always)]
    pub(crate) fn push(&mut self, mut slot: Slot<'s, L>, albedo: Spectrum<L>) {
        slot.share = albedo.mean().max(0.0).keep_if(slot.weight.is_lit());
        self.total += slot.share;
        self.albedo += albedo;
        match slot.shape {
            Shape::Reflect(_) => self.kinds[1] += albedo,
            Shape::Toon(lobe) => self.kinds[usize::from(lobe.is_glossy())] += albedo,
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
            // Fibres send light both ways, as a measurement may.
            Shape::Elliptic(_) => self.kinds[1] += albedo,
            Shape::Fibre(_) => {
                self.kinds[1] += albedo;
                self.kinds[2] += albedo;
            }
            Shape::Marschner(lobe) => self.kinds[if lobe.passes() { 2 } else { 1 }] += albedo,
            Shape::Straight => self.kinds[2] += albedo,
            Shape::Diffuse(_) | Shape::Fuzz(_) | Shape::Subsurface(_) => self.kinds[0] += albedo,
        }
        self.slots[self.count] = Some(slot);
        self.count += 1;
    }
    /// Where some lobe is not a delta, so that lights can be sampled for it; and where every lobe there is is one, as in mirrors and clear glass.
    #[inline(always)]
    pub fn specularity(&self, l: L) -> [M<L>; 2] {
        let (mut non_specular, mut specular) = (l.m(false), l.m(false));
        for slot in self.slots[..self.count].iter().flatten() {
            let (present, delta) = (slot.share.gt(0.0), slot.delta(l));
            non_specular |= present.and_not(delta);
            specular |= present & delta;
        }
        [non_specular, specular.and_not(non_specular)]
    }
    /// Share of diffuse reflection in the choice of lobes, for path guiding; 0 where lobes are of kinds that are told apart by more than direction.
    #[inline(always)]
    pub fn diffuse_share(&self, l: L) -> F<L> {
        let (mut sum, mut others) = (l.f(0.0), l.f(0.0));
        for slot in self.slots[..self.count].iter().flatten() {
            match slot.shape {
                Shape::Diffuse(_) if slot.side == Side::Reflected => sum += slot.share,
                Shape::Diffuse(_) | Shape::Reflect(_) | Shape::Glass(_) | Shape::Straight => {}
                _ => others += slot.share,
            }
        }
        (sum / self.total.max(1e-20)).keep_if(others.le(0.0))
    }
    /// Estimate of the directional albedo of all lobes together, for the albedo pass.
    #[inline(always)]
    pub fn albedo(&self) -> Spectrum<L> {
        self.albedo
    }
    /// The same by kind: diffuse, glossy, transmitted; interfaces count as both of the latter.
    #[inline(always)]
    pub fn albedo_kinds(&self) -> [Spectrum<L>; 3] {
        self.kinds
    }
    /// Emitted radiance towards the view, of the part that opacity leaves.
    #[inline(always)]
    pub fn emission(&self) -> Spectrum<L> {
        self.emission
    }
    /// What passes straight through towards a light: what opacity leaves open, and smooth thin walls.
    #[inline(always)]
    pub fn transmittance(&self, l: L, wo: Vec3<L>) -> Spectrum<L> {
        let mut sum = Spectrum::zero(l);
        for slot in self.slots[..self.count].iter().flatten().filter(|slot| slot.side == Side::Mirrored) {
            let tint = match (slot.coated, &self.coat) {
                (true, Some(coat)) => coat.along(coat.view),
                _ => Spectrum::one(l),
            };
            sum += (slot.delta_eval(l, &self.tilts, wo, -wo).0 * tint).keep_if(slot.delta(l));
        }
        sum.lerp(Spectrum::one(l), 1.0 - self.opacity)
    }
    /// What samples marked as entered go into; none if there are no such samples.
    #[inline(always)]
    pub fn medium(&self) -> Option<&WalkMedium<L>> {
        self.medium.as_ref()
    }
    /// Whether there is a lobe about a fibre's tangent, which scatters to all sides.
    #[inline(always)]
    pub fn has_fibre(&self) -> bool {
        for slot in self.slots[..self.count].iter().flatten() {
            if slot.is_fibre() {
                return true;
            }
        }
        false
    }
    /// Where light goes on instead of scattering.
    #[inline(always)]
    pub fn portal(&self) -> Option<&Portal<L>> {
        self.portal.as_ref()
    }
    /// Square of the far over the near index of the interface that light passes, where the surface has one.
    #[inline(always)]
    pub fn squared_index(&self) -> Option<Spectrum<L>> {
        for slot in self.slots[..self.count].iter().flatten() {
            if let Shape::Glass(lobe) = &slot.shape {
                return Some(lobe.squared_index());
            }
        }
        None
    }
    /// Share of the surface that is there; lobes and emission are those of that share, not multiplied by it.
    #[inline(always)]
    pub fn opacity(&self) -> F<L> {
        self.opacity
    }
}
