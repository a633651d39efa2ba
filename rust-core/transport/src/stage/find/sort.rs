//! Material sort: hits in the order of their materials (pbrt's material queues), so that a chunk runs one program and one set of lobes.

use crate::graph::CHUNK;
use crate::state::material_order::MaterialOrder;
use crate::tables::Tables;
use crate::tables::transport::Transport;
use gonio_accel::{Hits, NONE, TransparentHit};
use gonio_simd::{Execution, Lanes, M, PADDING, dispatch, padded};

/// Looks up the material of every hit, [`NONE`] where there is none.
#[inline(always)]
pub(crate) fn list_materials<L: Lanes>(l: L, tables: &Tables, hits: &Hits, material_of: &mut Vec<u32>) {
    let count = hits.instance.len();
    material_of.resize(padded(count), NONE);
    for at in (0..padded(count)).step_by(L::COUNT) {
        let alive = l.first(count.saturating_sub(at));
        let instance = l.load_integers_to_end(&hits.instance, at);
        let met = alive & instance.ne(NONE);
        let material = tables.geometry.material_lanes(l, instance.keep_if(met), l.load_integers_to_end(&hits.primitive, at));
        met.select(material, l.u(NONE)).store(material_of, at);
    }
}

/// Sorts the paths at surfaces by material, once each has a closure; those of one material stay in their order.
pub(crate) fn sort_by_material(tables: &Tables, transport: &Transport, materials: &mut MaterialOrder) {
    let MaterialOrder { material_of, order, starts, ends, .. } = materials;
    order_by_material(transport.execution, tables.materials.surfaces.len(), material_of, order, starts, ends);
}

/// Does something with points of each material, a chunk at a time; puts them in order.
pub(crate) fn for_materials(tables: &Tables, points: &mut [TransparentHit], mut each: impl FnMut(u32, &[TransparentHit])) {
    let material_of = |hit: &TransparentHit| tables.geometry.material(hit.instance, hit.primitive);
    points.sort_unstable_by_key(|hit| (material_of(hit), hit.ray));
    for of_one in points.chunk_by(|a, b| material_of(a) == material_of(b)) {
        of_one.chunks(CHUNK).for_each(|chunk| each(material_of(&chunk[0]), chunk));
    }
}

/// Lists the paths of each material in their order: `order[starts[m]..ends[m]]`. Paths of material [`NONE`] are left out; `material_of` is padded
/// to whole registers.
pub fn order_by_material(
    execution: Execution,
    materials: usize,
    material_of: &[u32],
    order: &mut Vec<u32>,
    starts: &mut Vec<u32>,
    ends: &mut Vec<u32>,
) {
    ends.clear();
    ends.resize(materials, 0);
    dispatch!(execution, l => count_materials(l, material_of, ends));
    starts.clear();
    let mut room = 0;
    for end in &mut *ends {
        starts.push(room);
        // A register's room behind each material's paths: placing writes whole registers.
        let count = std::mem::replace(end, room);
        room += if count > 0 { count + PADDING as u32 } else { 0 };
    }
    order.resize(padded(room as usize) + PADDING, 0);
    dispatch!(execution, l => place_by_material(l, material_of, order, ends));
}

/// Visits a register's paths of one material at once, as neighbours often share it: the material, the register's place, and a bit for each path.
#[inline(always)]
fn for_each_material<L: Lanes>(l: L, material_of: &[u32], mut visit: impl FnMut(usize, usize, u64)) {
    for at in (0..material_of.len()).step_by(L::COUNT) {
        let all = l.load_integers(material_of, at);
        let mut left = all.ne(NONE);
        while left.any() {
            let material = material_of[at + left.bits().trailing_zeros() as usize];
            let same = all.eq(material);
            visit(material as usize, at, same.bits());
            left = left.and_not(same);
        }
    }
}

/// Counts the paths of each material.
#[inline(always)]
fn count_materials<L: Lanes>(l: L, material_of: &[u32], counts: &mut [u32]) {
    for_each_material(l, material_of, |material, _, paths| counts[material] += paths.count_ones());
}

/// Puts the paths of each material from its start on.
#[inline(always)]
fn place_by_material<L: Lanes>(l: L, material_of: &[u32], order: &mut [u32], ends: &mut [u32]) {
    for_each_material(
        l,
        material_of,
        #[inline(always)]
        |material, at, paths| {
            let end = &mut ends[material];
            (l.iota() + at as u32).append(M(l.mask_from_bits(paths)), order, *end as usize);
            *end += paths.count_ones();
        },
    );
}
