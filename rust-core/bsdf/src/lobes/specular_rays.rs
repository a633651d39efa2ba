//! All that a surface sends on specularly, instead of one lobe chosen by its share: for trees of rays.

use super::{BsdfSample, Lobes, Normal, Shape, Side, Slot};
use gonio_simd::{Lanes, M, Spectrum, Vec3};

/// Ways that light goes on specularly.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Mirrored by the base.
    Mirrored,
    /// Mirrored by the coat, whose normal may be another one.
    Coat,
    /// Refracted.
    Refracted,
    /// Straight through.
    Straight,
}

impl Way {
    /// All ways, in the order of [`Lobes::specular_rays`].
    pub const ALL: [Self; 4] = [Self::Mirrored, Self::Coat, Self::Refracted, Self::Straight];
}

/// A specular direction.
#[derive(Clone, Copy, Debug)]
pub struct SpecularRay<L: Lanes> {
    /// Unit direction in the shading frame.
    pub wi: Vec3<L>,
    /// Factor on the radiance from there; zero where there is no such way.
    pub weight: Spectrum<L>,
}

impl<L: Lanes> Lobes<'_, L> {
    /// The specular directions of all lobes; lobes that go the same way add up.
    #[inline(always)]
    pub fn specular_rays(&self, l: L, wo: Vec3<L>) -> [SpecularRay<L>; Way::ALL.len()] {
        let nothing = SpecularRay { wi: Vec3::splat(l, [0.0, 0.0, 1.0]), weight: Spectrum::zero(l) };
        let mut rays = [nothing; Way::ALL.len()];
        for slot in self.slots[..self.count].iter().flatten() {
            let here = slot.share.gt(0.0) & slot.delta(l);
            if !here.any() {
                continue;
            }
            let back = if slot.normal == Normal::Coat { Way::Coat } else { Way::Mirrored };
            match slot.shape {
                Shape::Glass(_) => {
                    // The number that chooses the side is 0 for the one and 1 for the other.
                    self.add(l, wo, slot, 0.0, here, back, &mut rays);
                    self.add(l, wo, slot, 1.0, here, Way::Refracted, &mut rays);
                }
                _ if slot.side == Side::Mirrored => self.add(l, wo, slot, 0.0, here, Way::Straight, &mut rays),
                _ => self.add(l, wo, slot, 0.0, here, back, &mut rays),
            }
        }
        rays
    }

    /// Adds what a delta lobe sends one way.
    #[inline(always)]
    #[expect(clippy::too_many_arguments, reason = "a lobe and a way")]
    fn add(&self, l: L, wo: Vec3<L>, slot: &Slot<'_, L>, side: f32, here: M<L>, way: Way, rays: &mut [SpecularRay<L>; Way::ALL.len()]) {
        let mut sample = BsdfSample::nothing(l);
        let usable = self.choose(l, wo, slot, here, [l.f(side), l.f(0.5), l.f(0.5)], &mut sample);
        let through = matches!(way, Way::Refracted | Way::Straight);
        let own_side = if through { sample.transmitted } else { !sample.transmitted };
        let weight = sample.value.keep_if(here & usable & own_side);
        let ray = &mut rays[way as usize];
        ray.wi = weight.is_lit().select(sample.wi, ray.wi);
        ray.weight += weight;
    }
}
