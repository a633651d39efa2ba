//! What rays of an eye meet, and whether it is seen through.

use super::looks::{Looks, Way};
use crate::{
    accel::{Hits, NONE, RayBatch},
    measure::vector::Vector,
    transport::{EmissionPoint, SeenThroughRoom, ray_mask, seen_through},
};
use gonio_simd::{Lanes, One};

/// Share of light that has to pass straight for something to be seen behind a surface.
const CLEAR: f32 = 0.01;

/// What a ray meets.
#[derive(Clone, Copy, Debug)]
pub(super) struct Met {
    pub(super) t: f32,
    /// The instance's and the triangle's number, and the set's.
    pub(super) surface: [u32; 2],
    pub(super) set: u32,
    pub(super) is_clear: bool,
    barycentric: [f32; 2],
}

/// What rays have met, and room for asking.
#[derive(Debug, Default)]
pub(super) struct Meeting {
    hits: Hits,
    room: SeenThroughRoom,
}

impl Looks<'_> {
    /// What rays meet first from where they are on.
    pub(super) fn meet(&self, ways: &[Way], meeting: &mut Meeting) -> Vec<Option<Met>> {
        let count = ways.len();
        let origin = self.rebased(self.eye).map(|x| vec![x; count]);
        let direction = [0, 1, 2].map(|k| ways.iter().map(|way| way.direction[k] as f32).collect::<Vec<_>>());
        let rays = RayBatch {
            origin: origin.each_ref().map(|x| &x[..]),
            direction: direction.each_ref().map(|x| &x[..]),
            t_min: &ways.iter().map(|way| way.from).collect::<Vec<_>>(),
            t_max: &vec![f32::INFINITY; count],
            mask: &vec![ray_mask::CAMERA; count],
            time: &[],
            passed: &[],
        };
        self.scene.tables.bvh.first_hit_in_tree(self.execution, &rays, false, &mut meeting.hits);
        let clear = self.clear(ways, meeting);
        clear.into_iter().enumerate().map(|(at, is_clear)| self.met(&meeting.hits, at, is_clear)).collect()
    }

    /// A place in the space of the trees.
    pub(super) fn rebased(&self, place: Vector) -> [f32; 3] {
        [0, 1, 2].map(|k| (place[k] - self.scene.tables.origin[k]) as f32)
    }

    fn clear(&self, ways: &[Way], Meeting { hits, room }: &mut Meeting) -> Vec<bool> {
        let (materials, geometry) = (&self.scene.tables.materials, &self.scene.tables.geometry);
        let mut clear = vec![false; ways.len()];
        let (mut asked, mut points) = (Vec::new(), Vec::new());
        for (at, way) in ways.iter().enumerate().filter(|(at, _)| hits.instance[*at] != NONE) {
            let (instance, primitive) = (hits.instance[at], hits.primitive[at]);
            let material = geometry.material(instance, primitive);
            clear[at] = materials.is_clear_solid(material);
            if materials.lets_light_pass(material) {
                asked.push(at);
                let toward = way.direction.map(|x| -x as f32);
                points.push(EmissionPoint { instance, primitive, barycentric: [hits.u[at], hits.v[at]], toward });
            }
        }
        let shares = seen_through(&self.scene.tables, self.execution, &points, room);
        asked.into_iter().zip(shares).for_each(|(at, share)| clear[at] |= share >= CLEAR);
        clear
    }

    fn met(&self, hits: &Hits, at: usize, is_clear: bool) -> Option<Met> {
        let surface = [hits.instance[at], hits.primitive[at]];
        if surface[0] == NONE {
            return None;
        }
        let set = self.scene.tables.geometry.instances[surface[0] as usize].set;
        Some(Met { t: hits.t[at], surface, set, is_clear, barycentric: [hits.u[at], hits.v[at]] })
    }

    /// The unit normal of what a ray meets.
    pub(super) fn normal(&self, met: &Met) -> Vector {
        let geometry = &self.scene.tables.geometry;
        let ([instance, primitive], [u, v]) = (met.surface, met.barycentric);
        let hit = geometry.hit_lanes(One, One.u(instance), One.u(primitive), One.f(u), One.f(v));
        let normal = geometry.surface_point(One, &hit).geometric_normal;
        [normal.x, normal.y, normal.z].map(|x| f64::from(x.0))
    }
}
