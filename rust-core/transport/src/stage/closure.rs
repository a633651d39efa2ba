//! Closure selection: where a material is a weighted sum of closures, each hit takes one of them at random, by its weight.
//!
//! The throughput is multiplied by the weight over the probability, so every sum comes out right on average. A hit runs one graph and one set
//! of lobes. Closures that are transparent or emit are chosen like all others.

use crate::graph::{CHUNK, OutputColumns};
use crate::kernels;
use crate::stage::surface::{ChunkRays, ChunkSource};
use crate::state::chunk::ChunkColumns;
use crate::state::material_order::MaterialOrder;
use crate::state::paths::Paths;
use crate::state::sample::SampleContext;
use crate::tables::Tables;
use crate::tables::material::{Mix, Shading};
use crate::tables::transport::Transport;
use gonio_accel::{Hits, NONE};
use gonio_bsdf::parameter::spectrum;
use gonio_camera::sampler::dimension;
use gonio_simd::{F, Lanes, PADDING, Rgb, Spectrum, dispatch};

/// Chooses closures for all hits on mixes: material numbers become surface numbers.
pub(crate) fn choose_closures(
    tables: &Tables,
    transport: &Transport,
    context: &SampleContext<'_>,
    paths: &mut Paths,
    hits: &Hits,
    materials: &mut MaterialOrder,
    columns: &mut ChunkColumns,
) {
    if tables.materials.mixes.is_empty() {
        return;
    }
    let MaterialOrder { material_of, mixed, .. } = materials;
    for_mixes(tables, material_of, mixed, |mix, chunk, material_of| {
        dispatch!(transport.execution, l => choose_chunk(l, tables, context, (mix, chunk), paths, hits, material_of, columns));
    });
}

/// The paths at a mix that are looked at together: how many, and their numbers, padded to whole registers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MixChunk {
    pub(crate) count: usize,
    pub(crate) order: [u32; CHUNK + PADDING],
}

/// Does something with the hits on each mix, a chunk at a time: the mix, the paths, and the materials of all paths. `mixed` is scratch.
pub(crate) fn for_mixes(
    tables: &Tables,
    material_of: &mut [u32],
    mixed: &mut Vec<(u32, u32)>,
    mut each: impl FnMut(&Mix, &MixChunk, &mut [u32]),
) {
    mixed.clear();
    for (path, material) in material_of.iter().enumerate() {
        if *material != NONE
            && let Shading::Mix(mix) = tables.materials.shading(*material)
        {
            mixed.push((mix, path as u32));
        }
    }
    mixed.sort_unstable();
    for paths in mixed.chunk_by(|a, b| a.0 == b.0) {
        let mix = &tables.materials.mixes[paths[0].0 as usize];
        for chunk in paths.chunks(CHUNK) {
            let mut order = [chunk[0].1; CHUNK + PADDING];
            order.iter_mut().zip(chunk).for_each(|(place, (_, path))| *place = *path);
            each(mix, &MixChunk { count: chunk.len(), order }, material_of);
        }
    }
}

#[expect(clippy::too_many_arguments, reason = "paths, their hits and their materials")]
#[inline(always)]
fn choose_chunk<L: Lanes>(
    l: L,
    tables: &Tables,
    context: &SampleContext<'_>,
    (mix, chunk): (&Mix, &MixChunk),
    paths: &mut Paths,
    hits: &Hits,
    material_of: &mut [u32],
    columns: &mut ChunkColumns,
) {
    let MixChunk { count, ref order } = *chunk;
    let source = ChunkSource { order, count, rays: ChunkRays::Paths(paths) };
    kernels::run_program(l, tables, &mix.program, hits, &source, columns);
    let outputs = &columns.outputs;
    let dimension = context.dimension(dimension::CLOSURE);
    for at in (0..count).step_by(L::COUNT) {
        let path = l.load_integers(order, at);
        let index = context.index(l, paths.track(l, path).slot);
        let [u, _] = context.sampler.pair(l, index, dimension);
        let mut total = l.f(0.0);
        for closure in 0..mix.count {
            total += likelihood(weight(l, outputs, closure, at));
        }
        let mut point = u * total;
        let (mut chosen, mut factor) = (l.u(0), Spectrum::zero(l));
        let mut found = l.m(false);
        for closure in 0..mix.count {
            let weight = weight(l, outputs, closure, at);
            let own = likelihood(weight);
            let here = point.lt(own).and_not(found) & own.gt(0.0);
            chosen = here.select(l.u(closure as u32), chosen);
            factor = here.select(weight * (total / own.max(1e-20)), factor);
            found |= here;
            point -= own;
        }
        let (chosen, numbers) = (chosen.to_array(), path.to_array());
        let numbers = &numbers[..L::COUNT.min(count - at)];
        paths.carried.multiply(factor, numbers);
        for (path, chosen) in numbers.iter().zip(chosen) {
            material_of[*path as usize] = mix.first + chosen;
        }
    }
}

/// The weight of a closure, not negative.
#[inline(always)]
pub(crate) fn weight<L: Lanes>(l: L, outputs: &OutputColumns, closure: usize, at: usize) -> Spectrum<L> {
    let channel = |c: usize| l.load(outputs.column(closure * 3 + c), at).max(0.0);
    spectrum(Rgb::new(channel(0), channel(1), channel(2)))
}

/// How likely a closure is taken, up to a factor.
#[inline(always)]
pub(crate) fn likelihood<L: Lanes>(weight: Spectrum<L>) -> F<L> {
    weight.sum()
}
