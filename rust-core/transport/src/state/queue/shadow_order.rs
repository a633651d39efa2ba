//! Shadow rays sorted by light: those from one tile to one light are coherent and go in packets.

use crate::state::queue::shadow_rays::{SHADOW_ROOM, ShadowRays};
use crate::state::rays::Rays;
use crate::words::ray_mask;
use gonio_accel::Tlas;
use gonio_light::LightTable;
use gonio_simd::Execution;

/// With more lights than this, too few rays lead to each.
const MOST_LIGHTS: usize = 256;

/// The rays in another order, and where each came from.
#[derive(Debug)]
pub(crate) struct ShadowOrder {
    order: Vec<u32>,
    starts: Vec<u32>,
    rays: Rays,
    blocked: Vec<u8>,
}

impl Default for ShadowOrder {
    fn default() -> Self {
        Self { order: Vec::new(), starts: Vec::new(), rays: Rays::new(SHADOW_ROOM, ray_mask::SHADOW), blocked: vec![0; SHADOW_ROOM] }
    }
}

impl ShadowOrder {
    /// Whether sorting pays.
    pub(crate) fn pays(lights: &LightTable) -> bool {
        (2..=MOST_LIGHTS).contains(&lights.len())
    }

    /// [`Tlas::occluded`] by way of the sorted rays.
    pub(crate) fn occluded(&mut self, bvh: &Tlas, lights: &LightTable, execution: Execution, shadows: &ShadowRays, blocked: &mut [u8]) {
        let coherent = self.sort(lights, shadows);
        self.rays.select(&shadows.rays, &self.order);
        let n = shadows.count;
        let (towards_places, all_around) = self.blocked[..n].split_at_mut(coherent);
        bvh.occluded(execution, &self.rays.batch(0..coherent), true, towards_places);
        bvh.occluded(execution, &self.rays.batch(coherent..n), false, all_around);
        for (place, is_blocked) in self.order.iter().zip(&self.blocked) {
            blocked[*place as usize] = *is_blocked;
        }
    }

    /// Counting sort: rays to one light keep the order of the tile, those to domes come last. Returns how many are not to domes.
    fn sort(&mut self, lights: &LightTable, shadows: &ShadowRays) -> usize {
        let n = shadows.count;
        let last = lights.len();
        let bucket = |light: u32| if lights.is_dome(light) { last } else { light as usize };
        self.starts.clear();
        self.starts.resize(last + 2, 0);
        for light in &shadows.light[..n] {
            self.starts[bucket(*light) + 1] += 1;
        }
        for at in 1..self.starts.len() {
            self.starts[at] += self.starts[at - 1];
        }
        let coherent = self.starts[last] as usize;
        self.order.clear();
        self.order.resize(n, 0);
        for (ray, light) in shadows.light[..n].iter().enumerate() {
            let place = &mut self.starts[bucket(*light)];
            self.order[*place as usize] = ray as u32;
            *place += 1;
        }
        coherent
    }
}
