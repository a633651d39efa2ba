//! Intersection: nearest surfaces of all paths by packets or ray streams, the shapes of lights before them, and the paths that meet no surface.

use crate::state::nearest::NearestHits;
use crate::state::paths::Paths;
use crate::tables::Tables;
use crate::tables::transport::Transport;
use gonio_accel::{NONE, Passed};
use gonio_simd::{Lanes, M, PADDING, U, dispatch};

/// Finds the surface that every path hits, and notes the shapes of lights before it.
pub(crate) fn find(tables: &Tables, transport: &Transport, depth: u32, paths: &Paths, nearest: &mut NearestHits) {
    find_first(tables, transport, depth == 0, paths, nearest);
    dispatch!(transport.execution, l => classify(l, tables, nearest));
    nearest.lights.clear();
    while !nearest.at_lights.is_empty() {
        nearest.lights.note(&nearest.at_lights, &nearest.hits);
        pass_through_lights(tables, transport, paths, nearest);
    }
}

/// Finds the surface that every light path hits: lights are passed, and send nothing.
pub(crate) fn find_surfaces(tables: &Tables, transport: &Transport, paths: &Paths, nearest: &mut NearestHits) {
    tables.bvh.first_hit_in_tree(transport.execution, &paths.rays.batch(0..paths.count), false, &mut nearest.hits);
    dispatch!(transport.execution, l => classify(l, tables, nearest));
    // Many lights stand in the tree.
    while !nearest.at_lights.is_empty() {
        pass_through_lights(tables, transport, paths, nearest);
    }
}

/// Finds what every path hits; `coherent` ones in packets.
pub(crate) fn find_first(tables: &Tables, transport: &Transport, coherent: bool, paths: &Paths, nearest: &mut NearestHits) {
    tables.bvh.first_hit(transport.execution, &paths.rays.batch(0..paths.count), coherent, &mut nearest.hits);
}

/// Appends the numbers of some lanes.
#[inline(always)]
fn push<L: Lanes>(numbers: U<L>, chosen: M<L>, list: &mut Vec<u32>) {
    let mut first = [0; PADDING];
    numbers.append(chosen, &mut first, 0);
    list.extend_from_slice(&first[..chosen.count()]);
}

/// Lists the paths that escaped and those that stand before a light's shape.
#[inline(always)]
fn classify<L: Lanes>(l: L, tables: &Tables, nearest: &mut NearestHits) {
    nearest.escaped.clear();
    nearest.at_lights.clear();
    let instances = &nearest.hits.instance;
    for at in (0..instances.len()).step_by(L::COUNT) {
        let instance = l.load_integers_to_end(instances, at);
        let others = !instance.lt(tables.first_light_instance) & l.first(instances.len() - at);
        if others.any() {
            let (path, escaped) = (l.iota() + at as u32, instance.eq(NONE));
            push(path, others & escaped, &mut nearest.escaped);
            push(path, others.and_not(escaped), &mut nearest.at_lights);
        }
    }
}

/// Takes paths on behind the shapes of lights, which block nothing. With loose lights the hit behind was found before; else it is traced.
fn pass_through_lights(tables: &Tables, transport: &Transport, paths: &Paths, nearest: &mut NearestHits) {
    let NearestHits { hits, escaped, at_lights, behind_rays, behind, .. } = nearest;
    behind_rays.select(&paths.rays, at_lights);
    // Lights at the same place are met one after the other, each once.
    let passed = behind_rays.passed.of_first(at_lights.len());
    for ((t_min, passed), path) in behind_rays.t_min.iter_mut().zip(passed).zip(&*at_lights) {
        let i = *path as usize;
        *t_min = hits.t[i].next_down();
        *passed = Passed { t: hits.t[i], instance: hits.instance[i], primitive: hits.primitive[i], on_edge: 0 };
    }
    let rays = behind_rays.batch(0..at_lights.len());
    if tables.bvh.has_loose_lights() {
        tables.bvh.first_hit_before(transport.execution, &rays, &hits.covered, behind);
    } else {
        tables.bvh.first_hit(transport.execution, &rays, false, behind);
    }
    behind_rays.passed.clear();
    std::mem::swap(&mut hits.covered, &mut behind.covered);
    for (from, to) in at_lights.iter().enumerate() {
        let to = *to as usize;
        hits.t[to] = behind.t[from];
        hits.u[to] = behind.u[from];
        hits.v[to] = behind.v[from];
        hits.primitive[to] = behind.primitive[from];
        hits.instance[to] = behind.instance[from];
    }
    escaped.extend(at_lights.iter().filter(|i| hits.instance[**i as usize] == NONE));
    at_lights.retain(|i| {
        let instance = hits.instance[*i as usize];
        instance != NONE && instance >= tables.first_light_instance
    });
}
