//! Normals beside the shading normal: the coat's own, and what shading normals far from the triangle's need (the rules of Cycles' bump map
//! correction).

use gonio_simd::{F, Frame, Lanes, M, Vec3};

/// Normals of a batch of hits in the shading frame, unit, all on the viewer's side of the triangle.
#[derive(Clone, Copy, Debug)]
pub struct Normals<L: Lanes> {
    /// The triangle's normal.
    pub geometric: Vec3<L>,
    /// The interpolated normal before any bump or normal map.
    pub smooth: Vec3<L>,
    /// The coat's normal, where it is not the base's.
    pub coat: Option<Vec3<L>>,
}

/// The normal that a lobe is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Normal {
    /// The shading normal.
    Base,
    /// The shading normal turned so that mirror directions leave the surface.
    Specular,
    /// The coat's.
    Coat,
    /// The fuzz's: between base and coat; outside Cycles' models else that of specular lobes, for fibres seen from behind are black.
    Fuzz,
}

/// Frames other than the shading frame, in its coordinates; none where the normal is the base's.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tilts<L: Lanes> {
    pub(crate) specular: Option<Frame<L>>,
    pub(crate) coat: Option<Frame<L>>,
    pub(crate) fuzz: Option<Frame<L>>,
    /// The interpolated normal, where the bump rules are on.
    pub(crate) smooth: Option<Vec3<L>>,
}

impl<L: Lanes> Tilts<L> {
    /// No other frames.
    pub(crate) const NONE: Self = Self { specular: None, coat: None, fuzz: None, smooth: None };

    /// Makes them [`Self::NONE`], one by one: as a whole they would be filled with zeros.
    #[inline(always)]
    pub(crate) fn clear(&mut self) {
        self.specular = None;
        self.coat = None;
        self.fuzz = None;
        self.smooth = None;
    }

    /// The frame about a normal, if it is not the shading frame.
    #[inline(always)]
    pub(crate) fn frame(&self, normal: Normal) -> Option<&Frame<L>> {
        match normal {
            Normal::Base => None,
            Normal::Specular => self.specular.as_ref(),
            Normal::Coat => self.coat.as_ref(),
            Normal::Fuzz => self.fuzz.as_ref(),
        }
    }
    /// A direction in the frame about a normal.
    #[inline(always)]
    pub(crate) fn seen(&self, normal: Normal, v: Vec3<L>) -> Vec3<L> {
        match self.frame(normal) {
            Some(frame) => frame.to_local(v),
            None => v,
        }
    }
    /// Factor for light from `wi` on a lobe about `normal`: nothing from behind the interpolated normal unless `open`, and for diffuse lobes
    /// the masking of bumps as steep as the normal is bent (Conty Estevez, Lecocq, Stein 2019).
    #[inline(always)]
    pub(crate) fn shadow(&self, normal: Normal, wi: Vec3<L>, diffuse: bool, open: bool) -> Option<F<L>> {
        let smooth = self.smooth?;
        let l = wi.x.lanes();
        let n = match self.frame(normal) {
            Some(frame) => frame.z,
            None => Vec3::splat(l, [0.0, 0.0, 1.0]),
        };
        let (light, bend) = (smooth.dot(wi), smooth.dot(n));
        let mut factor = l.f(1.0);
        if diffuse {
            let bend2 = (bend * bend).max(1e-12);
            let alpha2 = ((1.0 - bend2) / bend2 * 0.125).saturate();
            let cos2 = (light * light).max(1e-12);
            factor = 2.0 / ((alpha2 * ((1.0 - cos2) / cos2).max(0.0) + 1.0).sqrt() + 1.0);
        }
        if !open {
            factor = factor.keep_if((light * bend * n.dot(wi)).ge(0.0));
        }
        Some(factor)
    }
}

/// Sine above the surface that mirror directions keep: 0.01, or nine tenths of the view's.
#[inline(always)]
fn least_sine<L: Lanes>(view: F<L>) -> F<L> {
    (view * 0.9).min(0.01)
}

/// Where [`raised`] turns the shading normal: smooth normals stand so far from the triangle's that the mirror image of `wo` falls too low.
#[inline(always)]
pub fn is_raised<L: Lanes>(geometric: Vec3<L>, wo: Vec3<L>) -> M<L> {
    let view = geometric.dot(wo);
    (wo.z * geometric.z * 2.0 - view).lt(least_sine(view))
}

/// `normal` turned towards `geometric` until the mirror image of the view `wo` leaves the surface, by a sine of 0.01 or nine tenths of the view's.
#[inline(always)]
pub fn raised<L: Lanes>(normal: Vec3<L>, geometric: Vec3<L>, wo: Vec3<L>) -> Vec3<L> {
    let view = geometric.dot(wo);
    let least = least_sine(view);
    let fine = geometric.dot(wo.reflect(normal)).ge(least);
    // In the plane of both normals: z along the geometric one, x to the side that the normal leans to.
    let side = (normal - geometric * geometric.dot(normal)).normalize_or(normal);
    let along = side.dot(wo);
    let a = along.mul_add(along, view * view);
    let b = (a + view * least) * 2.0;
    let c = (least + view).squared();
    let root = (b * b - a * c * 4.0).safe_sqrt();
    let z2 = (b + along.lt(0.0).select(root, -root)) * 0.25 / a.max(1e-20);
    let turned = side * (1.0 - z2).safe_sqrt() + geometric * z2.safe_sqrt();
    fine.select(normal, turned)
}

/// The frame about the shading normal where [`is_raised`] says so, else the shading frame to the bit: what a lane gives may not hang on its
/// neighbours.
#[inline(always)]
pub(crate) fn raised_frame<L: Lanes>(geometric: Vec3<L>, wo: Vec3<L>) -> Frame<L> {
    let l = wo.x.lanes();
    let (x, y, z) = (Vec3::splat(l, [1.0, 0.0, 0.0]), Vec3::splat(l, [0.0, 1.0, 0.0]), Vec3::splat(l, [0.0, 0.0, 1.0]));
    let (low, turned) = (is_raised(geometric, wo), tilted(raised(z, geometric, wo)));
    Frame { x: low.select(turned.x, x), y: low.select(turned.y, y), z: low.select(turned.z, z) }
}

/// The frame about `normal` whose tangent is the shading frame's.
#[inline(always)]
pub(crate) fn tilted<L: Lanes>(normal: Vec3<L>) -> Frame<L> {
    Frame::from_tangent(normal, Vec3::splat(normal.x.lanes(), [1.0, 0.0, 0.0]))
}
