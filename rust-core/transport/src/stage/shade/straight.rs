//! Rays that go straight on through the surface that they have met.

use crate::state::chunk::ChunkContext;
use crate::state::columns::gather3;
use crate::state::passed::PassedLanes;
use crate::state::rays::RayLanes;
use crate::state::vertex::{StraightOn, Vertex};
use gonio_simd::{F, Lanes};

/// The rays of paths beyond what they have met. They stay the rays that they are: started anew off the surface, they would miss what lies on it.
/// From curves and points, which bend, they do start anew.
#[inline(always)]
pub(crate) fn straight_on<L: Lanes>(chunk: &ChunkContext<'_, L>, point: &Vertex<L>) -> StraightOn<L> {
    let ChunkContext { l, paths, hits, columns, .. } = *chunk;
    let at = point.place;
    let surface = &columns.surface;
    let t = l.gather(&hits.t, point.path);
    let passed = PassedLanes {
        t,
        instance: point.instance,
        primitive: l.load_integers(&surface.primitive, at),
        barycentric: [l.load(&surface.barycentric[0], at), l.load(&surface.barycentric[1], at)],
    };
    // The hit's own distance still counts; nothing is less than zero.
    let t_min = F::from_bits(t.max(f32::MIN_POSITIVE).to_bits() - 1);
    let (origin, t_max) = (gather3(l, &paths.rays.origin, point.path), l.gather(&paths.rays.t_max, point.path));
    let ray = RayLanes { origin, direction: -point.wo, t_min, t_max };
    let on = StraightOn { ray, width: paths.cone(l, point.path).width, passed };
    if !chunk.tables.geometry.any_smooth() {
        return on;
    }
    let flat = !surface.hit(l, &chunk.tables.geometry, at).smooth.is_smooth();
    let anew = point.at.spawn_ray(-point.wo);
    StraightOn { ray: anew.or(flat, &on.ray), width: flat.select(on.width, point.core.width), passed: passed.only(flat) }
}
