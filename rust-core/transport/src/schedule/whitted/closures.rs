//! Materials that are sums of closures: all of them are shaded, one after the other, each with its weight.

use crate::kernels;
use crate::stage::find::surface::{ChunkRays, ChunkSource};
use crate::stage::shade::closure::{MixChunk, for_mixes, likelihood};
use crate::state::chunk::ChunkColumns;
use crate::state::material_order::MaterialOrder;
use crate::state::mix_weights::ClosureWeights;
use crate::state::paths::Paths;
use crate::state::queue::branches::Undivided;
use crate::tables::Tables;
use crate::tables::material::{Mix, Shading};
use crate::tables::transport::Transport;
use gonio_accel::{Hits, NONE};
use gonio_simd::{Lanes, dispatch};

/// Most closures of a material.
pub(crate) fn most(tables: &Tables) -> usize {
    tables.materials.mixes.iter().map(|mix| mix.count).max().unwrap_or(1).max(1)
}

/// Saves material numbers and throughputs, which [`select`] overwrites.
pub(crate) fn keep(tables: &Tables, materials: &MaterialOrder, paths: &Paths, undivided: &mut Undivided) {
    if tables.materials.mixes.is_empty() {
        return;
    }
    undivided.material_of.clone_from(&materials.material_of);
    undivided.carried.clone_from(&paths.carried);
}

/// The hits of a batch before their closures are told apart.
pub(crate) struct Whole<'a> {
    pub(crate) undivided: &'a Undivided,
    pub(crate) hits: &'a Hits,
}

/// Puts each hit on a mix onto its closure of this number. Other hits are on their surface for closure 0, and nowhere after.
pub(crate) fn select(
    tables: &Tables,
    transport: &Transport,
    closure: usize,
    whole: &Whole<'_>,
    paths: &mut Paths,
    materials: &mut MaterialOrder,
    columns: &mut ChunkColumns,
) {
    if tables.materials.mixes.is_empty() {
        return;
    }
    let MaterialOrder { material_of, mixed, .. } = materials;
    material_of.clone_from(&whole.undivided.material_of);
    for_mixes(tables, material_of, mixed, |mix, chunk, material_of| {
        dispatch!(transport.execution, l => select_chunk(l, tables, closure, (mix, chunk), whole, paths, material_of, columns));
    });
    if closure > 0 {
        for (material, before) in material_of.iter_mut().zip(&whole.undivided.material_of) {
            if *before != NONE && matches!(tables.materials.shading(*before), Shading::Surface(_)) {
                *material = NONE;
            }
        }
    }
}

#[expect(clippy::too_many_arguments, reason = "paths, their hits and their materials")]
#[inline(always)]
fn select_chunk<L: Lanes>(
    l: L,
    tables: &Tables,
    closure: usize,
    (mix, chunk): (&Mix, &MixChunk),
    whole: &Whole<'_>,
    paths: &mut Paths,
    material_of: &mut [u32],
    columns: &mut ChunkColumns,
) {
    let MixChunk { count, ref order } = *chunk;
    if closure >= mix.count {
        order[..count].iter().for_each(|path| material_of[*path as usize] = NONE);
        return;
    }
    let source = ChunkSource { order, count, rays: ChunkRays::Paths(paths) };
    kernels::run_program(l, tables, &mix.program, whole.hits, &source, columns);
    for at in (0..count).step_by(L::COUNT) {
        let path = l.load_integers(order, at);
        let mut total = l.f(0.0);
        for one in 0..mix.count {
            total += likelihood(ClosureWeights::computed(columns, one).load(l, at));
        }
        let own = ClosureWeights::computed(columns, closure).load(l, at);
        let share = likelihood(own) / total.max(1e-20);
        let (throughput, camera_share) = whole.undivided.carried.gather(l, path);
        let numbers = &path.to_array()[..L::COUNT.min(count - at)];
        paths.carried.scatter(throughput * own, camera_share * share, numbers);
        // What the camera sees directly has nothing to do with which closures there are: behind mirrors and glass its share is 0.
        for (path, share) in numbers.iter().zip(share.to_array()) {
            material_of[*path as usize] = if share > 0.0 { mix.first + closure as u32 } else { NONE };
        }
    }
}
