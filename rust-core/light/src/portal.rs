//! Portals: rectangles that a dome emits through. Half of a dome's directions are drawn through those that look at the point, evenly among them and by
//! solid angle in each; the other half by the dome's own brightness, so that what passes no portal is found as well.

use super::emitter::Emitter;
use super::rectangle::Rectangle;
use super::row::{Reader, field};
use super::table::LightTable;
use gonio_simd::{F, Lanes, M, U, Vec3};

/// Share of the directions that go through portals, where there are any.
const SHARE: f32 = 0.5;

/// Which of a dome's directions go through portals.
pub(crate) struct Portals<L: Lanes> {
    /// Portals that look at the point.
    count: F<L>,
    /// Share of the directions that are drawn through them.
    share: F<L>,
}

/// Whether a portal's inner side looks at a point.
#[inline(always)]
fn looks_at<L: Lanes>(portal: &Reader<'_, L>, p: Vec3<L>) -> M<L> {
    portal.vector(field::NORMAL).dot(p - portal.vector(field::ORIGIN)).gt(0.0)
}

impl LightTable {
    /// The portals that look at a point; `None` where the scene has none.
    #[inline(always)]
    pub(crate) fn portals_at<L: Lanes>(&self, l: L, p: Vec3<L>) -> Option<Portals<L>> {
        if self.portals.is_empty() {
            return None;
        }
        let mut count = l.f(0.0);
        for portal in &self.portals {
            count += l.f(1.0).keep_if(looks_at(&self.reader(l, l.u(*portal)), p));
        }
        Some(Portals { count, share: l.f(SHARE).keep_if(count.gt(0.0)) })
    }

    /// Splits the first number: whether the direction goes through a portal, and the number for that portal and for the dome.
    #[inline(always)]
    pub(crate) fn split_by_portal<L: Lanes>(&self, portals: &Portals<L>, u: F<L>) -> (M<L>, F<L>, F<L>) {
        let through = u.lt(portals.share);
        let below_one = 1.0 - f32::EPSILON;
        (through, (u * (1.0 / SHARE)).min(below_one), ((u - portals.share) / (1.0 - portals.share)).max(0.0).min(below_one))
    }

    /// A direction through one of the portals.
    #[inline(always)]
    pub(crate) fn sample_portal<L: Lanes>(&self, l: L, portals: &Portals<L>, p: Vec3<L>, u: [F<L>; 2]) -> Vec3<L> {
        let place = u[0] * portals.count;
        let wanted = place.floor().min(portals.count - 1.0);
        let mut chosen: U<L> = l.u(self.portals[0]);
        let mut before = l.f(0.0);
        for portal in &self.portals {
            let looking = looks_at(&self.reader(l, l.u(*portal)), p);
            chosen = (looking & before.eq(wanted)).select(l.u(*portal), chosen);
            before += l.f(1.0).keep_if(looking);
        }
        Rectangle::sample(l, &self.reader(l, chosen), p, [(place - wanted).saturate(), u[1]]).wi
    }

    /// Density of a direction when some go through portals and the others have density `elsewhere`.
    #[inline(always)]
    pub(crate) fn portal_density<L: Lanes>(&self, l: L, portals: &Portals<L>, p: Vec3<L>, wi: Vec3<L>, elsewhere: F<L>) -> F<L> {
        let mut sum = l.f(0.0);
        for portal in &self.portals {
            let portal = self.reader(l, l.u(*portal));
            let (origin, normal) = (portal.vector(field::ORIGIN), portal.vector(field::NORMAL));
            let (height, descent) = (normal.dot(p - origin), -normal.dot(wi));
            let hit = wi.mul_add(height / descent.max(f32::MIN_POSITIVE), p);
            let local = portal.in_frame(hit - origin);
            let within = local.x.abs().le(portal.value(field::HALF)) & local.y.abs().le(portal.value(field::HALF + 1));
            let met = height.gt(0.0) & descent.gt(0.0) & within;
            if met.any() {
                let (density, _) = Rectangle::density(l, &portal, p, wi, hit);
                sum += density.keep_if(met & density.is_finite());
            }
        }
        let through = sum / portals.count.max(1.0);
        elsewhere.lerp(through, portals.share)
    }
}
