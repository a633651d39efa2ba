//! Closure selection: where a material is a weighted sum of closures, each hit takes one of them at random, by its weight.
//!
//! The throughput is multiplied by the weight over the probability, so every sum comes out right on average. A hit runs one graph and one set
//! of lobes. Closures that are transparent are chosen like all others. What closures emit that do nothing else is added at each hit; they are chosen
//! where the others' weights leave something, as the surface covers what is behind it by that, too.

use crate::accumulate::deposit::Deposits;
use crate::graph::CHUNK;
use crate::kernels;
use crate::stage::find::surface::{ChunkRays, ChunkSource};
use crate::stage::shade::shading::add_emission_apart;
use crate::state::chunk::{ChunkColumns, ChunkContext};
use crate::state::material_order::MaterialOrder;
use crate::state::mix_weights::MixWeights;
use crate::state::paths::Paths;
use crate::state::sample::SampleContext;
use crate::tables::Tables;
use crate::tables::material::{Mix, Shading};
use crate::tables::transport::Transport;
use gonio_accel::{Hits, NONE};
use gonio_camera::sampler::dimension;
use gonio_simd::{F, Lanes, PADDING, Spectrum, dispatch};

/// Chooses closures for all hits on mixes: material numbers become surface numbers. Adds the light of those that do nothing but emit, where light is
/// gathered.
#[expect(clippy::too_many_arguments, reason = "paths, their hits, materials and light")]
pub(crate) fn choose_closures(
    tables: &Tables,
    transport: &Transport,
    context: &SampleContext<'_>,
    paths: &mut Paths,
    hits: &Hits,
    materials: &mut MaterialOrder,
    columns: &mut ChunkColumns,
    mut deposits: Option<&mut Deposits>,
) {
    if tables.materials.mixes.is_empty() {
        return;
    }
    let MaterialOrder { material_of, mixed, weights, .. } = materials;
    for_mixes(tables, material_of, mixed, |mix, chunk, material_of| {
        dispatch!(transport.execution, l => {
            weigh(l, tables, context, (mix, chunk), (paths, hits), weights, columns);
            if let Some(deposits) = deposits.as_deref_mut().filter(|_| mix.emits_apart) {
                shine_apart(l, (tables, transport, context), (mix, chunk), paths, hits, weights, columns, deposits);
            }
            choose_chunk(l, tables, context, (mix, chunk), paths, weights, material_of);
        });
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

/// Runs the program of a mix; `weights` become those of its closures over the chunk, three channels each.
#[inline(always)]
fn weigh<L: Lanes>(
    l: L,
    tables: &Tables,
    sample: &SampleContext<'_>,
    (mix, chunk): (&Mix, &MixChunk),
    (paths, hits): (&Paths, &Hits),
    weights: &mut MixWeights,
    columns: &mut ChunkColumns,
) {
    let MixChunk { count, ref order } = *chunk;
    let source = ChunkSource { order, count, rays: ChunkRays::Paths(paths) };
    kernels::run_program(l, tables, &mix.program, hits, &source, columns);
    columns.wavelengths.fill(sample.wavelengths, order[..count].iter().map(|path| paths.slot(*path as usize)));
    weights.keep(mix, columns);
}

/// Adds what closures emit that do nothing else.
#[inline(always)]
#[expect(clippy::too_many_arguments, reason = "a chunk, its paths, hits and light")]
fn shine_apart<L: Lanes>(
    l: L,
    (tables, transport, sample): (&Tables, &Transport, &SampleContext<'_>),
    (mix, chunk): (&Mix, &MixChunk),
    paths: &Paths,
    hits: &Hits,
    weights: &MixWeights,
    columns: &mut ChunkColumns,
    deposits: &mut Deposits,
) {
    let MixChunk { count, ref order } = *chunk;
    let source = ChunkSource { order, count, rays: ChunkRays::Paths(paths) };
    for closure in 0..mix.count {
        let material = &tables.materials.surfaces[mix.first as usize + closure];
        if material.emits_apart {
            kernels::run_program(l, tables, &material.program, hits, &source, columns);
            let straight = material.way_straight();
            let chunk =
                ChunkContext { l, tables, transport, sample, shader: None, count, order, paths, hits, columns: &*columns, straight };
            add_emission_apart(&chunk, material, weights.of(closure), deposits);
        }
    }
}

#[inline(always)]
fn choose_chunk<L: Lanes>(
    l: L,
    tables: &Tables,
    context: &SampleContext<'_>,
    (mix, chunk): (&Mix, &MixChunk),
    paths: &mut Paths,
    weights: &MixWeights,
    material_of: &mut [u32],
) {
    let MixChunk { count, ref order } = *chunk;
    let dimension = context.dimension(dimension::CLOSURE);
    let apart = |closure: usize| tables.materials.surfaces[mix.first as usize + closure].emits_apart;
    for at in (0..count).step_by(L::COUNT) {
        let path = l.load_integers(order, at);
        let index = context.index(l, paths.track(l, path).slot);
        let [u, _] = context.sampler.pair(l, index, dimension);
        let (mut scattering, mut shining) = (l.f(0.0), l.f(0.0));
        for closure in 0..mix.count {
            let sum = if apart(closure) { &mut shining } else { &mut scattering };
            *sum += likelihood(weights.of(closure).load(l, at));
        }
        // White has a weight of 3 channels.
        let left = (3.0 - scattering).max(0.0).min(shining) / shining.max(1e-20);
        let total = left.mul_add(shining, scattering);
        let mut point = u * total;
        let (mut chosen, mut factor) = (l.u(0), Spectrum::zero(l));
        let mut found = l.m(false);
        for closure in 0..mix.count {
            let weight = weights.of(closure).load(l, at);
            let own = likelihood(weight) * if apart(closure) { left } else { l.f(1.0) };
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

/// How likely a closure is taken, up to a factor.
#[inline(always)]
pub(crate) fn likelihood<L: Lanes>(weight: Spectrum<L>) -> F<L> {
    weight.sum()
}
