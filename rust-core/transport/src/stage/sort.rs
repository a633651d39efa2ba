//! Hits in the order of their materials.

use crate::state::workspace::Workspace;
use crate::tables::Tables;
use crate::tables::transport::Transport;
use gonio_accel::NONE;
use gonio_simd::{Execution, Lanes, M, PADDING, dispatch, padded};

/// Looks up the material of every hit, [`NONE`] where there is none.
#[inline(always)]
pub(crate) fn list_materials<L: Lanes>(l: L, tables: &Tables, ws: &mut Workspace) {
    let count = ws.hits.instance.len();
    ws.material_of.resize(padded(count), NONE);
    for at in (0..padded(count)).step_by(L::COUNT) {
        let alive = l.first(count.saturating_sub(at));
        let instance = l.load_integers_to_end(&ws.hits.instance, at);
        let met = alive & instance.ne(NONE);
        let material = tables.geometry.material_lanes(l, instance.keep_if(met), l.load_integers_to_end(&ws.hits.primitive, at));
        met.select(material, l.u(NONE)).store(&mut ws.material_of, at);
    }
}

/// Sorts the paths at surfaces by material, once each has a closure; those of one material stay in their order.
pub(crate) fn sort_by_material(tables: &Tables, transport: &Transport, ws: &mut Workspace) {
    sort(tables.materials.surfaces.len(), transport.execution, ws);
}

fn sort(materials: usize, execution: Execution, ws: &mut Workspace) {
    ws.material_end.clear();
    ws.material_end.resize(materials, 0);
    dispatch!(execution, l => count_materials(l, ws));
    ws.material_start.clear();
    let mut room = 0;
    for end in &mut ws.material_end {
        ws.material_start.push(room);
        // A register's room behind each material's paths: placing writes whole registers.
        let count = std::mem::replace(end, room);
        room += if count > 0 { count + PADDING as u32 } else { 0 };
    }
    ws.order.resize(padded(room as usize) + PADDING, 0);
    dispatch!(execution, l => place_by_material(l, ws));
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
fn count_materials<L: Lanes>(l: L, ws: &mut Workspace) {
    let counts = &mut ws.material_end;
    for_each_material(l, &ws.material_of, |material, _, paths| counts[material] += paths.count_ones());
}

/// Puts the paths of each material from its start on.
#[inline(always)]
fn place_by_material<L: Lanes>(l: L, ws: &mut Workspace) {
    let (ends, order) = (&mut ws.material_end, &mut ws.order);
    for_each_material(
        l,
        &ws.material_of,
        #[inline(always)]
        |material, at, paths| {
            let end = &mut ends[material];
            (l.iota() + at as u32).append(M(l.mask_from_bits(paths)), order, *end as usize);
            *end += paths.count_ones();
        },
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_of_one_material_stay_in_their_order_at_every_level() {
        let runs = (0..100u32).map(|i| if i < 40 { 2 } else { i.wrapping_mul(2_654_435_761) >> 29 });
        let material_of: Vec<u32> = runs.map(|material| if material > 4 { NONE } else { material }).chain([NONE; 12]).collect();
        let mut expected: Vec<u32> = (0..100).filter(|path| material_of[*path as usize] != NONE).collect();
        expected.sort_by_key(|path| material_of[*path as usize]);
        for execution in Execution::all() {
            let mut ws = Workspace { material_of: material_of.clone(), ..Workspace::default() };
            sort(5, execution, &mut ws);
            let ranges = ws.material_start.iter().zip(&ws.material_end).map(|(start, end)| *start as usize..*end as usize);
            let sorted: Vec<u32> = ranges.flat_map(|range| ws.order[range].to_vec()).collect();
            assert_eq!(sorted, expected, "{execution:?}");
            assert!(ws.order.len() >= ws.material_end[4] as usize + PADDING);
        }
    }
}
