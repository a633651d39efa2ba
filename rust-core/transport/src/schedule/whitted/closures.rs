//! Materials that are sums of closures: all of them are shaded, one after the other, each with its weight.

use crate::graph::CHUNK;
use crate::kernels;
use crate::stage::closure::{for_mixes, share, weight};
use crate::stage::surface::{ChunkRays, ChunkSource};
use crate::state::workspace::Workspace;
use crate::tables::Tables;
use crate::tables::material::{Mix, Shading};
use crate::tables::transport::Transport;
use gonio_accel::NONE;
use gonio_simd::{Lanes, PADDING, Rgb, dispatch};

/// Most closures of a material.
pub(crate) fn most(tables: &Tables) -> usize {
    tables.materials.mixes.iter().map(|mix| mix.count).max().unwrap_or(1).max(1)
}

/// Saves material numbers and throughputs, which [`select`] overwrites.
pub(crate) fn keep(tables: &Tables, ws: &mut Workspace) {
    if tables.materials.mixes.is_empty() {
        return;
    }
    let undivided = &mut ws.branches.undivided;
    undivided.material_of.clone_from(&ws.material_of);
    undivided.carried.clone_from(&ws.paths.carried);
}

/// Puts each hit on a mix onto its closure of this number. Other hits are on their surface for closure 0, and nowhere after.
pub(crate) fn select(tables: &Tables, transport: &Transport, closure: usize, ws: &mut Workspace) {
    if tables.materials.mixes.is_empty() {
        return;
    }
    ws.material_of.clone_from(&ws.branches.undivided.material_of);
    for_mixes(tables, ws, |mix, order, count, ws| {
        dispatch!(transport.execution, l => select_chunk(l, tables, closure, mix, order, count, ws));
    });
    if closure > 0 {
        for (material, whole) in ws.material_of.iter_mut().zip(&ws.branches.undivided.material_of) {
            if *whole != NONE && matches!(tables.materials.shading(*whole), Shading::Surface(_)) {
                *material = NONE;
            }
        }
    }
}

#[inline(always)]
fn select_chunk<L: Lanes>(
    l: L,
    tables: &Tables,
    closure: usize,
    mix: &Mix,
    order: &[u32; CHUNK + PADDING],
    count: usize,
    ws: &mut Workspace,
) {
    let number = |path: usize, ws: &mut Workspace, number: u32| ws.material_of[path] = number;
    if closure >= mix.count {
        order[..count].iter().for_each(|path| number(*path as usize, ws, NONE));
        return;
    }
    let source = ChunkSource { order, count, rays: ChunkRays::Paths(&ws.paths) };
    kernels::run_program(l, tables, &mix.program, &ws.hits, &source, &mut ws.surface, &mut ws.scratch, &mut ws.outputs);
    for at in (0..count).step_by(L::COUNT) {
        let path = l.load_integers(order, at);
        let mut total = l.f(0.0);
        for one in 0..mix.count {
            total += share(weight(l, &ws.outputs, one, at));
        }
        let own = weight(l, &ws.outputs, closure, at);
        let [r, g, b, whole] = l.gather_quads(&ws.branches.undivided.carried, path << 2);
        let part = (whole * (share(own) / total.max(1e-20))).to_array();
        let (paths, throughput) = (path.to_array(), Rgb::new(r, g, b) * own);
        let throughput = [throughput.r.to_array(), throughput.g.to_array(), throughput.b.to_array()];
        for lane in 0..L::COUNT.min(count - at) {
            let path = paths[lane] as usize;
            number(path, ws, if part[lane] > 0.0 { mix.first + closure as u32 } else { NONE });
            ws.paths.carried_mut(path).copy_from_slice(&[throughput[0][lane], throughput[1][lane], throughput[2][lane], part[lane]]);
        }
    }
}
