//! Portals: light goes on from another place, in another direction.

use super::parameter as p;
use super::resolve::Layers;
use gonio_simd::{Lanes, Spectrum, Vec3};

/// Where a path goes on.
#[derive(Clone, Copy, Debug)]
pub struct Portal<L: Lanes> {
    /// World space, metres.
    pub position: Vec3<L>,
    /// World space, of any length; zero for straight on.
    pub direction: Vec3<L>,
    /// What passes.
    pub colour: Spectrum<L>,
}

impl<L: Lanes> Layers<'_, '_, '_, L> {
    /// Puts the portal in place.
    #[inline(always)]
    pub(super) fn single_portal(&mut self, colour: Spectrum<L>) {
        let [position, direction] = [p::PORTAL_POSITION, p::PORTAL_DIRECTION];
        self.lobes.portal = Some(Portal { position: self.vector(position), direction: self.vector(direction), colour });
    }

    /// A parameter of three places that is no light.
    #[inline(always)]
    fn vector(&self, offset: usize) -> Vec3<L> {
        Vec3::new(self.get(offset), self.get(offset + 1), self.get(offset + 2))
    }
}
