//! Shadow rays sorted by light: those from one tile to one light are coherent and go in packets.

use crate::state::columns::{Columns3, columns3};
use crate::state::shadow_rays::{SHADOW_ROOM, ShadowRays};
use gonio_accel::{RayBatch, Tlas};
use gonio_light::LightTable;
use gonio_simd::{Column, Execution};

/// With more lights than this, too few rays lead to each.
const MOST_LIGHTS: usize = 256;

/// The rays in another order, and where each came from.
#[derive(Debug)]
pub(crate) struct ShadowOrder {
    order: Vec<u32>,
    starts: Vec<u32>,
    origin: Columns3,
    direction: Columns3,
    t_max: Column,
    mask: Vec<u8>,
    blocked: Vec<u8>,
}

impl Default for ShadowOrder {
    fn default() -> Self {
        Self {
            order: Vec::new(),
            starts: Vec::new(),
            origin: columns3(SHADOW_ROOM),
            direction: columns3(SHADOW_ROOM),
            t_max: Column::new(SHADOW_ROOM),
            mask: vec![0; SHADOW_ROOM],
            blocked: vec![0; SHADOW_ROOM],
        }
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
        self.fill(shadows);
        let n = shadows.count;
        let (towards_places, all_around) = self.blocked[..n].split_at_mut(coherent);
        let part = |first: usize, end: usize| RayBatch {
            origin: [&self.origin[0][first..end], &self.origin[1][first..end], &self.origin[2][first..end]],
            direction: [&self.direction[0][first..end], &self.direction[1][first..end], &self.direction[2][first..end]],
            t_min: &shadows.t_min[first..end],
            t_max: &self.t_max[first..end],
            mask: &self.mask[first..end],
        };
        bvh.occluded(execution, &part(0, coherent), true, towards_places);
        bvh.occluded(execution, &part(coherent, n), false, all_around);
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

    fn fill(&mut self, shadows: &ShadowRays) {
        let columns = [(&shadows.origin, &mut self.origin), (&shadows.direction, &mut self.direction)];
        for (from, to) in columns.into_iter().flat_map(|(from, to)| from.iter().zip(to)) {
            self.order.iter().zip(to.iter_mut()).for_each(|(place, value)| *value = from[*place as usize]);
        }
        for ((place, t_max), mask) in self.order.iter().zip(self.t_max.iter_mut()).zip(&mut self.mask) {
            (*t_max, *mask) = (shadows.t_max[*place as usize], shadows.mask[*place as usize]);
        }
    }
}
