//! One lobe in its place: its shape, its frame and its weight.

use super::super::diffuse::DiffuseLobe;
use super::super::fuzz::FuzzLobe;
use super::super::glass::GlassLobe;
use super::super::hair::{EllipticLobe, FibreLobe, MarschnerLobe};
use super::super::measured::MeasuredLobe;
use super::super::normals::{Normal, Tilts};
use super::super::reflect::ReflectLobe;
use super::super::subsurface::EntryLobe;
use super::super::toon::ToonLobe;
use crate::turn::turned;
use gonio_simd::{F, Lanes, M, Spectrum, Vec3};

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
    /// Toon.
    Toon(ToonLobe<L>),
    /// Straight through.
    Straight,
    /// Into a medium.
    Subsurface(EntryLobe<L>),
    /// As measured.
    Measured(MeasuredLobe<'s, L>),
    /// A fibre.
    Fibre(FibreLobe<L>),
    /// A fibre of elliptic section.
    Elliptic(EllipticLobe<L>),
    /// One of a fibre's lobes.
    Marschner(MarschnerLobe<L>),
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
    pub(crate) weight: Spectrum<L>,
    /// Share in the choice of lobes, not normalised.
    pub(crate) share: F<L>,
    /// Cosine and sine of the tangent's turn.
    pub(crate) turn: Option<[F<L>; 2]>,
    pub(crate) side: Side,
    pub(crate) normal: Normal,
    /// Whether the light's way through the coat tints the lobe.
    pub(crate) coated: bool,
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
    pub(super) fn eval(&self, tilts: &Tilts<L>, wo: Vec3<L>, wi: Vec3<L>) -> (Spectrum<L>, F<L>) {
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
                (Spectrum::constant(value), pdf)
            }
            Shape::Toon(lobe) => {
                let (value, pdf) = lobe.eval(wo, wi);
                (Spectrum::constant(value), pdf)
            }
            Shape::Measured(lobe) => lobe.eval(wo, wi),
            Shape::Fibre(lobe) => lobe.eval(wi),
            Shape::Elliptic(lobe) => lobe.eval(wi),
            Shape::Marschner(lobe) => {
                let value = lobe.eval(wi);
                (Spectrum::constant(value), value)
            }
            Shape::Straight | Shape::Subsurface(_) => return (Spectrum::zero(wo.x.lanes()), wo.x.lanes().f(0.0)),
        };
        (value * self.weight, pdf)
    }
    /// A direction of the lobe, whether it is on the side it was meant for, and whether that is the other one; `u[0]` is what the choice of
    /// lobes left over.
    #[inline(always)]
    pub(super) fn sample(&self, tilts: &Tilts<L>, wo: Vec3<L>, u: [F<L>; 3]) -> (Vec3<L>, [M<L>; 2]) {
        let wo = self.in_shape_frame(tilts, wo);
        let l = wo.x.lanes();
        // Fibres tell by themselves what has passed them.
        let mut passed = None;
        let (wi, usable) = match &self.shape {
            Shape::Diffuse(_) => above(DiffuseLobe::sample([u[1], u[2]])),
            Shape::Reflect(lobe) => above(lobe.sample(wo, [u[1], u[2]])),
            Shape::Glass(lobe) => lobe.sample(wo, u),
            Shape::Fuzz(lobe) => above(lobe.sample([u[1], u[2]])),
            Shape::Toon(lobe) => lobe.sample(wo, [u[1], u[2]]),
            Shape::Straight => (Vec3::new(-wo.x, -wo.y, wo.z), l.m(true)),
            Shape::Subsurface(lobe) => lobe.sample(wo, u),
            Shape::Measured(lobe) => lobe.sample(wo, u),
            Shape::Fibre(lobe) => {
                let (wi, through) = lobe.sample(u);
                passed = Some(through);
                (wi, l.m(true))
            }
            Shape::Elliptic(lobe) => {
                // As in Cycles what has been inside counts as reflected too.
                passed = Some(l.m(false));
                lobe.sample(u)
            }
            Shape::Marschner(lobe) => {
                passed = Some(l.m(lobe.passes()));
                lobe.sample([u[1], u[2]])
            }
        };
        let through = match (passed, self.side) {
            (Some(through), _) => through,
            (None, Side::Reflected) => l.m(false),
            (None, Side::Mirrored) => l.m(true),
            (None, Side::Both) => wi.z.lt(0.0),
        };
        (self.in_shading_frame(tilts, wi), [usable, through])
    }
    /// Lanes in which the lobe is a mirror or smooth.
    #[inline(always)]
    pub(super) fn delta(&self, l: L) -> M<L> {
        match &self.shape {
            Shape::Reflect(lobe) => lobe.delta,
            Shape::Glass(lobe) => lobe.delta,
            Shape::Straight => l.m(true),
            Shape::Diffuse(_) | Shape::Fuzz(_) | Shape::Toon(_) | Shape::Subsurface(_) | Shape::Measured(_) => l.m(false),
            Shape::Fibre(_) | Shape::Elliptic(_) | Shape::Marschner(_) => l.m(false),
        }
    }
    /// Weight and probability of the delta lanes for the direction `wi`.
    #[inline(always)]
    pub(super) fn delta_eval(&self, l: L, tilts: &Tilts<L>, wo: Vec3<L>, wi: Vec3<L>) -> (Spectrum<L>, F<L>) {
        let (wo, wi) = (tilts.seen(self.normal, wo), tilts.seen(self.normal, wi));
        let (value, pdf) = match &self.shape {
            Shape::Reflect(lobe) => (lobe.mirror(wo), l.f(1.0)),
            Shape::Glass(lobe) => lobe.smooth(wo, wi),
            Shape::Straight | Shape::Subsurface(_) => (Spectrum::one(l), l.f(1.0)),
            Shape::Diffuse(_) | Shape::Fuzz(_) | Shape::Toon(_) | Shape::Measured(_) => (Spectrum::zero(l), l.f(0.0)),
            Shape::Fibre(_) | Shape::Elliptic(_) | Shape::Marschner(_) => (Spectrum::zero(l), l.f(0.0)),
        };
        (value * self.weight, pdf)
    }
    /// Roughness r.
    #[inline(always)]
    pub(super) fn roughness(&self, l: L) -> F<L> {
        match &self.shape {
            Shape::Reflect(lobe) => lobe.roughness(),
            Shape::Glass(lobe) => lobe.roughness(),
            Shape::Toon(lobe) => lobe.roughness(),
            Shape::Straight => l.f(0.0),
            Shape::Measured(lobe) => l.f(lobe.roughness()),
            Shape::Fibre(lobe) => lobe.roughness(),
            Shape::Elliptic(lobe) => lobe.roughness(),
            Shape::Marschner(lobe) => lobe.roughness(),
            Shape::Diffuse(_) | Shape::Fuzz(_) | Shape::Subsurface(_) => l.f(1.0),
        }
    }
    /// Whether it is of facets, interfaces, fibres or a measurement: what passes call glossy or transmitted.
    #[inline(always)]
    pub(super) fn is_specular(&self) -> bool {
        match &self.shape {
            Shape::Reflect(_) | Shape::Glass(_) | Shape::Measured(_) => true,
            Shape::Fibre(_) | Shape::Elliptic(_) | Shape::Marschner(_) => true,
            Shape::Toon(lobe) => lobe.is_glossy(),
            _ => false,
        }
    }
    /// Whether it is about a fibre's tangent, so that no side of its normal is dark.
    #[inline(always)]
    pub(crate) fn is_fibre(&self) -> bool {
        matches!(self.shape, Shape::Fibre(_) | Shape::Elliptic(_) | Shape::Marschner(_))
    }
    /// Whether the bump rules count the lobe as diffuse.
    #[inline(always)]
    pub(super) fn is_diffuse(&self) -> bool {
        match &self.shape {
            Shape::Diffuse(_) | Shape::Fuzz(_) => true,
            Shape::Toon(lobe) => !lobe.is_glossy(),
            _ => false,
        }
    }
}
