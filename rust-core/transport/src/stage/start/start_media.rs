//! What absorbs where paths start: the closed meshes that hold the place of a lamp, a camera or a meter.
//!
//! A ray from the place leaves each mesh that holds it once more than it enters it. Cycles fills its stack of volumes in the same way.

use crate::media::set::{MediaColumns, MediaSet};
use crate::stage::find::closures::{ClosureHits, MaterialHits, each_closure};
use crate::stage::find::sort::for_materials;
use crate::state::rays::Rays;
use crate::state::start_room::StartRoom;
use crate::state::wavelengths::SlotWavelengths;
use crate::tables::Tables;
use crate::tables::bodies::Body;
use crate::tables::material::parameter_values;
use crate::words::ray_mask;
use gonio_accel::{NONE, TransparentHit};
use gonio_camera::Surroundings;
use gonio_simd::{Column, Execution, Lanes, One, PADDING, SpectrumColumns, dispatch, padded};

/// Along no axis and no diagonal, so that it seldom meets an edge.
const DIRECTION: [f32; 3] = [0.233_25, 0.317_56, 0.919_11];
/// Most surfaces of a mesh that are crossed.
const MOST: usize = 4096;

/// What is at a place in rebased world space, as colour; its index is not looked for.
pub(super) fn media_at(tables: &Tables, origin: [f32; 3]) -> Surroundings {
    let table = &tables.materials.media;
    if !tables.bodies.absorbing.iter().any(|body| body.may_hold(origin)) {
        return Surroundings { media: [table.everywhere, 0], ..Surroundings::OPEN };
    }
    let mut rays = Rays::new(PADDING, ray_mask::ALL);
    for axis in 0..3 {
        rays.origin[axis][0] = origin[axis];
        rays.direction[axis][0] = DIRECTION[axis];
    }
    let mut media = MediaColumns::new(PADDING);
    media.store(MediaSet::everywhere(One, table), 0);
    let mut room = StartRoom::default();
    start_media(tables, Execution::Scalar, &tables.bodies.absorbing, (&rays, None), 1, &mut media, &mut room);
    let (names, solid) = media.load(One, 0).parts();
    let tints = room.innermost.first().map_or(0.0, |crossing| room.tints[*crossing]);
    Surroundings { media: names.map(|word| word.0), absorption: solid.to_rgb().into(), tints, ..Surroundings::OPEN }
}

/// Wavelengths of slots, where light has any, and the rays' slots.
type RayWavelengths<'a> = Option<(&'a SlotWavelengths, &'a [u32])>;

/// Adds to `media` what is where the first `count` rays start, which look along their own directions for the bodies that hold them.
pub(crate) fn start_media(
    tables: &Tables,
    execution: Execution,
    bodies: &[Body],
    (rays, wavelengths): (&Rays, RayWavelengths<'_>),
    count: usize,
    media: &mut MediaColumns,
    room: &mut StartRoom,
) {
    room.innermost.clear();
    cross_all(tables, execution, bodies, rays, count, room);
    if room.crossings.is_empty() {
        return;
    }
    look_up(tables, execution, (rays, wavelengths), room);
    enter_filled(room, media);
    find_innermost(room);
    for crossing in &room.innermost {
        let (ray, row) = (room.crossings[*crossing].ray, room.solid[*crossing].unwrap_or(0));
        media.set_solid(ray as usize, (&room.absorption, *crossing), row);
    }
}

/// Lists the rays that start within a body's bounds.
#[inline(always)]
fn list_held<L: Lanes>(l: L, body: &Body, rays: &Rays, count: usize, held: &mut Vec<u32>) {
    let [min, max] = body.bounds;
    for at in (0..count).step_by(L::COUNT) {
        let mut inside = l.first(count - at);
        for axis in 0..3 {
            let place = l.load(&rays.origin[axis], at);
            inside &= place.ge(min[axis]) & place.le(max[axis]);
        }
        let bits = inside.bits();
        held.extend((0..L::COUNT as u32).filter(|lane| bits >> lane & 1 != 0).map(|lane| at as u32 + lane));
    }
}

/// Notes every surface of bodies that the first `count` rays cross which start within their bounds.
pub(super) fn cross_all(tables: &Tables, execution: Execution, bodies: &[Body], rays: &Rays, count: usize, room: &mut StartRoom) {
    room.crossings.clear();
    for body in bodies {
        room.pending.clear();
        dispatch!(execution, l => list_held(l, body, rays, count, &mut room.pending));
        cross(tables, execution, body.instance, rays, room);
    }
}

/// Notes every surface of an instance that the pending rays cross.
fn cross(tables: &Tables, execution: Execution, instance: u32, rays: &Rays, room: &mut StartRoom) {
    let StartRoom { pending, from, rays: way, instances, hits, crossings, .. } = room;
    from.clear();
    from.resize(pending.len(), 0.0);
    for _ in 0..MOST {
        let count = pending.len();
        if count == 0 {
            return;
        }
        way.select(rays, pending);
        way.t_min[..count].copy_from_slice(from);
        way.t_max[..count].fill(f32::INFINITY);
        way.mask[..count].fill(ray_mask::ALL);
        instances.clear();
        instances.resize(count, instance);
        tables.bvh.first_hit_within(execution, &way.batch(0..count), instances, hits);
        let mut kept = 0;
        for i in (0..count).filter(|i| hits.instance[*i] != NONE) {
            let (ray, t) = (pending[i], hits.t[i]);
            crossings.push(TransparentHit { ray, instance, primitive: hits.primitive[i], u: hits.u[i], v: hits.v[i], t });
            (pending[kept], from[kept]) = (ray, t.next_up());
            kept += 1;
        }
        pending.truncate(kept);
        from.truncate(kept);
    }
}

/// Finds the sides of all crossings, and what absorbs behind their surfaces.
fn look_up(tables: &Tables, execution: Execution, (rays, wavelengths): (&Rays, RayWavelengths<'_>), room: &mut StartRoom) {
    let mut crossings = std::mem::take(&mut room.crossings);
    room.absorption = SpectrumColumns::new(padded(crossings.len()) + PADDING);
    room.tints.clear();
    room.sides.clear();
    room.solid.clear();
    room.filling.clear();
    for_materials(tables, &mut crossings, |material, chunk| {
        dispatch!(execution, l => look_up_chunk(l, tables, MaterialHits { material, hits: chunk, rays, wavelengths }, room));
        for i in 0..chunk.len() {
            let at = room.sides.len();
            room.absorption.add(at, &room.chunk, i, 1.0);
            room.tints.push(room.chunk_tints[i]);
            room.sides.push(room.columns.surface.side[i]);
        }
        room.solid.resize(room.sides.len(), tables.materials.is_solid(material).then(|| tables.materials.solid_medium(material)));
        room.filling.resize(room.sides.len(), tables.materials.interior(material).unwrap_or(0));
    });
    room.crossings = crossings;
}

#[inline(always)]
fn look_up_chunk<L: Lanes>(l: L, tables: &Tables, chunk: MaterialHits<'_>, room: &mut StartRoom) {
    let StartRoom { chunk: sums, chunk_tints: tints, weights, columns, .. } = room;
    sums.clear();
    tints.fill(0.0);
    each_closure(
        l,
        tables,
        chunk,
        |mix| &mix.program,
        (weights, columns),
        #[inline(always)]
        |closure| add_inside(l, tables, closure, (sums, tints)),
    );
}

/// Adds what a surface encloses, and how often a metre that has its colour, times its weights if it is a closure of several.
#[inline(always)]
fn add_inside<L: Lanes>(l: L, tables: &Tables, mut closure: ClosureHits<'_>, (sums, tints): (&mut SpectrumColumns, &mut Column)) {
    let material = &tables.materials.surfaces[closure.surface];
    closure.run(l, tables, &material.program);
    let values = parameter_values(material, closure.columns.outputs());
    for at in (0..closure.hits.len()).step_by(L::COUNT) {
        if material.solid_medium.is_some() {
            break;
        }
        let (mut inside, mut often) = (material.surface.absorption(l, &values, at), material.surface.tints(l, &values, at));
        if let Some(weights) = closure.weights {
            let weight = weights.load(l, at);
            (inside, often) = (inside * weight, often * weight.mean());
        }
        sums.store(sums.load(l, at) + inside, at);
        (l.load(tints, at) + often).store(tints, at);
    }
}

/// What fills meshes overlaps: rays are in what they leave oftener than they enter.
fn enter_filled(room: &StartRoom, media: &mut MediaColumns) {
    let crossings = room.crossings.iter().zip(&room.filling).zip(&room.sides);
    let mut filled: Vec<(u32, u32, bool)> =
        crossings.filter(|((_, row), _)| **row != 0).map(|((crossing, row), side)| (crossing.ray, *row, *side < 0.0)).collect();
    filled.sort_unstable();
    for body in filled.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        let (ray, row, _) = body[0];
        let leaves = body.iter().filter(|(.., leaves)| *leaves).count();
        for _ in body.len() - leaves..leaves {
            media.store(media.load(One, ray as usize).entered(row, One.m(true)), ray as usize);
        }
    }
}

/// Solids take each other's place: what the nearest surface encloses of those that hold the place. A surface that faces inwards bounds a hole, which takes
/// away the solid about it.
fn find_innermost(room: &mut StartRoom) {
    let StartRoom { crossings, sides, solid, innermost, .. } = room;
    let mut order: Vec<usize> = (0..crossings.len()).filter(|i| solid[*i].is_some()).collect();
    let (body, t) = (|i: &usize| (crossings[*i].ray, crossings[*i].instance), |i: &usize| crossings[*i].t);
    order.sort_unstable_by(|a, b| body(a).cmp(&body(b)).then(t(a).total_cmp(&t(b))));
    // By body: its nearest crossing, how much oftener the ray leaves it than it enters it, and where it leaves it first.
    let bodies = order.chunk_by(|a, b| body(a) == body(b)).map(|of_body| {
        let left: f32 = of_body.iter().map(|i| -sides[*i]).sum();
        (of_body[0], left, of_body.iter().copied().find(|i| sides[*i] < 0.0))
    });
    let mut bodies: Vec<(usize, f32, Option<usize>)> = bodies.collect();
    bodies.sort_by(|(a, ..), (b, ..)| crossings[*a].ray.cmp(&crossings[*b].ray).then(t(a).total_cmp(&t(b))));
    for of_ray in bodies.chunk_by(|(a, ..), (b, ..)| crossings[*a].ray == crossings[*b].ray) {
        let mut holes = 0.0;
        for (_, left, exit) in of_ray {
            holes -= left;
            if let Some(exit) = exit.filter(|_| holes < 0.0) {
                innermost.push(exit);
                break;
            }
        }
    }
}
