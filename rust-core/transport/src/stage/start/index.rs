//! The index of refraction at places: of the glass, the resin or the water that a lamp, a camera or a meter stands in.
//!
//! A ray from the place leaves each closed mesh that holds it once more than it enters it. It counts the indices of what it leaves over those of what it
//! enters, as they bend it: so meshes within others count by their product, and a hole, whose surface faces inwards, takes the index away.

use crate::graph::CHUNK;
use crate::stage::find::closures::{ClosureHits, MaterialHits, each_closure};
use crate::stage::find::sort::for_materials;
use crate::stage::start::start_media::cross_all;
use crate::state::queue::measure_points::MeasurePoints;
use crate::state::rays::Rays;
use crate::state::start_room::StartRoom;
use crate::tables::Tables;
use crate::tables::bodies::Body;
use crate::tables::material::parameter_values;
use crate::tables::transport::Transport;
use crate::words::ray_mask;
use gonio_bsdf::{Hits, Lobes};
use gonio_camera::sampler::BATCH;
use gonio_simd::{Execution, Lanes, PADDING, Vec3, dispatch};

/// Ways from a place, along no axis and no diagonal. Open surfaces hold nothing: a place is in something where all ways say so.
const DIRECTIONS: [[f32; 3]; 6] = [
    [0.233_25, 0.317_56, 0.919_11],
    [-0.233_25, -0.317_56, -0.919_11],
    [0.952_43, 0.116_44, -0.281_65],
    [-0.952_43, -0.116_44, 0.281_65],
    [-0.196_46, 0.941_09, -0.275_29],
    [0.196_46, -0.941_09, 0.275_29],
];
/// Errors of a position that are well before the surface it lies on.
const BEFORE: f32 = 16.0;
/// Squared indices so near to 1 are those of nothing.
const NOTHING: f32 = 1e-4;

/// Squared indices of what places in rebased world space are in; 1 of air.
pub fn squared_indices_at(tables: &Tables, places: &[[f32; 3]]) -> Vec<f32> {
    let bodies = around(&tables.bodies.refracting, places);
    if bodies.is_empty() {
        return vec![1.0; places.len()];
    }
    let (mut rays, mut room) = (Rays::new(BATCH + PADDING, ray_mask::ALL), StartRoom::default());
    let mut found = Vec::with_capacity(places.len());
    for places in places.chunks(BATCH) {
        let ways = DIRECTIONS.map(|direction| {
            point(&mut rays, places, direction);
            along(tables, &bodies, &rays, places.len(), &mut room)
        });
        found.extend((0..places.len()).map(|place| agreed(ways.each_ref().map(|squares| squares[place]))));
    }
    found
}

/// Multiplies what points bring that paths have found by the squared index of what they lie in, over that of what the camera is in: paths carry radiance
/// over it.
pub(crate) fn weigh_points(tables: &Tables, transport: &Transport, points: &mut MeasurePoints) {
    if points.count == 0 || tables.bodies.refracting.is_empty() {
        return;
    }
    let before = |i: usize| {
        let off = BEFORE * points.error[i].abs();
        [0, 1, 2].map(|axis| points.geometric_normal[axis][i].mul_add(off, points.position[axis][i]))
    };
    let places: Vec<[f32; 3]> = (0..points.count).map(before).collect();
    for (i, square) in squared_indices_at(tables, &places).into_iter().enumerate() {
        points.throughput.scale(i, square / transport.squared_index);
    }
}

/// Bodies whose bounds hold one of some places.
fn around(bodies: &[Body], places: &[[f32; 3]]) -> Vec<Body> {
    let mut places = places.to_vec();
    places.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let holds_one = |body: &&Body| {
        let [min, max] = body.bounds;
        let first = places.partition_point(|place| place[0] < min[0]);
        places[first..].iter().take_while(|place| place[0] <= max[0]).any(|place| body.may_hold(*place))
    };
    bodies.iter().filter(holds_one).copied().collect()
}

/// Lets a ray start at each place.
fn point(rays: &mut Rays, places: &[[f32; 3]], direction: [f32; 3]) {
    for axis in 0..3 {
        rays.origin[axis].iter_mut().zip(places).for_each(|(origin, place)| *origin = place[axis]);
        rays.direction[axis][..places.len()].fill(direction[axis]);
    }
}

/// What the ways from a place say together.
fn agreed(squares: [f32; DIRECTIONS.len()]) -> f32 {
    let dense = squares.iter().all(|square| *square > 1.0 + NOTHING);
    let thin = squares.iter().all(|square| *square < 1.0 - NOTHING);
    let mean = squares.iter().product::<f32>().powf(1.0 / squares.len() as f32);
    if (dense || thin) && mean.is_finite() && mean > 0.0 { mean } else { 1.0 }
}

/// What each ray says of where it starts.
fn along(tables: &Tables, bodies: &[Body], rays: &Rays, count: usize, room: &mut StartRoom) -> Vec<f32> {
    let execution = Execution::Scalar;
    cross_all(tables, execution, bodies, rays, count, room);
    let mut crossings = std::mem::take(&mut room.crossings);
    let mut squares = vec![1.0; count];
    for_materials(tables, &mut crossings, |material, chunk| {
        let behind = dispatch!(execution, l => squared(l, tables, MaterialHits { material, hits: chunk, rays, wavelengths: None }, room));
        for (i, crossing) in chunk.iter().enumerate() {
            let square = &mut squares[crossing.ray as usize];
            *square = if room.columns.surface.side[i] < 0.0 { *square * behind[i] } else { *square / behind[i] };
        }
    });
    room.crossings = crossings;
    squares
}

/// What closures of a material let pass, weighed by how much, and the weights.
struct Sums {
    squares: [f32; CHUNK],
    weights: [f32; CHUNK],
}

/// Squared indices behind the surface at points of a material: of mixes the mean over the closures that let light pass.
#[inline(always)]
fn squared<L: Lanes>(l: L, tables: &Tables, chunk: MaterialHits<'_>, room: &mut StartRoom) -> [f32; CHUNK] {
    let mut sums = Sums { squares: [0.0; CHUNK], weights: [0.0; CHUNK] };
    let StartRoom { weights, columns, .. } = room;
    each_closure(
        l,
        tables,
        chunk,
        |mix| &mix.program,
        (weights, columns),
        #[inline(always)]
        |closure| add_square(l, tables, closure, &mut sums),
    );
    let mut squares = sums.squares;
    for (square, weight) in squares.iter_mut().zip(sums.weights) {
        *square = if weight > 0.0 { *square / weight } else { 1.0 };
    }
    squares
}

/// Adds a surface that lets light pass, as one of a mix's closures or alone.
#[inline(always)]
fn add_square<L: Lanes>(l: L, tables: &Tables, mut closure: ClosureHits<'_>, sums: &mut Sums) {
    let material = &tables.materials.surfaces[closure.surface];
    let (set, thin_walled) = (&material.surface.lobes, material.surface.switches.thin_walled);
    if !(set.transmission || set.straight) {
        return;
    }
    closure.run(l, tables, &material.program);
    let values = parameter_values(material, closure.columns.outputs());
    let (wo, mut lobes) = (Vec3::splat(l, [0.0, 0.0, 1.0]), Lobes::empty(l));
    for at in (0..closure.hits.len()).step_by(L::COUNT) {
        let mut square = l.f(1.0);
        if set.transmission && !thin_walled {
            let seen = Hits { values: &values, at, wo, entering: l.m(true), normals: None, walks: true, carried: None, numbers: None };
            material.surface.resolve(l, &seen, &mut lobes);
            if let Some(squared) = lobes.squared_index() {
                square = squared.constant_value();
            }
        }
        let weight = match closure.weights {
            Some(weights) => weights.load(l, at).sum(),
            None => l.f(1.0),
        };
        (l.load(&sums.squares, at) + square * weight).store(&mut sums.squares, at);
        (l.load(&sums.weights, at) + weight).store(&mut sums.weights, at);
    }
}
