//! Next event estimation (NEE) for a whole chunk: lights are selected for all hits first, then sampled light by light.
//!
//! A register of neighbouring hits selects lights of many kinds, and each kind's sampling would run for the few lanes that selected it.

use crate::state::chunk::ChunkContext;
use crate::state::columns::load3;
use crate::state::queue::light_samples::LightSampleQueue;
use gonio_camera::sampler::dimension;
use gonio_light::{LightSample, LightSampleContext};
use gonio_simd::{F, Lanes, Vec3};

/// The light samples of a register of hits; the chunk's first call samples for all later hits too. `is_fibre` where no side is dark.
#[inline(always)]
pub(crate) fn sample_queued<L: Lanes>(
    chunk: &ChunkContext<'_, L>,
    at: usize,
    is_fibre: bool,
    queue: &mut LightSampleQueue,
) -> LightSample<L> {
    if !queue.made {
        sample_chunk(chunk.l, chunk, at, is_fibre, queue);
    }
    queue.load(chunk.l, at)
}

/// Selects and samples lights for all hits of the chunk from a register's beginning on: a function of its own, as those of `kernels`.
#[inline(never)]
fn sample_chunk<L: Lanes>(l: L, chunk: &ChunkContext<'_, L>, first: usize, is_fibre: bool, queue: &mut LightSampleQueue) {
    l.vectorize(
        #[inline(always)]
        || {
            for at in (first..chunk.count).step_by(L::COUNT) {
                select_lights(chunk, at, is_fibre, queue);
            }
            let total = queue.sort(&chunk.tables.lights, first..chunk.count, L::COUNT);
            for at in (0..total).step_by(L::COUNT) {
                sample_selected(chunk, at, queue);
            }
            queue.made = true;
        },
    );
}

/// Light selection for a register of hits.
#[inline(always)]
fn select_lights<L: Lanes>(chunk: &ChunkContext<'_, L>, at: usize, is_fibre: bool, queue: &mut LightSampleQueue) {
    let ChunkContext { l, tables, transport, sample: context, .. } = *chunk;
    let path = l.load_integers(chunk.order, at);
    let index = context.index(l, chunk.paths.track(l, path).slot);
    let base = context.dimension(0);
    let [u_light, _] = context.sampler.pair(l, index, base + dimension::LIGHT_CHOICE);
    let [u, v] = context.sampler.pair(l, index, base + dimension::LIGHT);
    let surface = &chunk.columns.surface;
    let p = load3(l, &surface.position, at);
    let n = if is_fibre { Vec3::splat(l, [0.0; 3]) } else { load3(l, &surface.shading_normal, at) };
    let receiver = tables.links.receiver(l, l.load_integers(&surface.instance, at));
    let from = LightSampleContext { position: p, normal: n, receiver };
    let (light, probability) = tables.lights.sample_light(l, transport.light_cache.as_deref(), &from, u_light);
    light.store(&mut queue.light, at);
    l.store_quads([F::from_bits(light), probability, u, v], &mut queue.selected, at);
    l.store_quads([p.x, p.y, p.z, l.f(0.0)], &mut queue.position, at);
    l.store_quads([n.x, n.y, n.z, l.f(0.0)], &mut queue.normal, at);
}

/// Samples the lights of a register of one group.
#[inline(always)]
fn sample_selected<L: Lanes>(chunk: &ChunkContext<'_, L>, at: usize, queue: &mut LightSampleQueue) {
    let l = chunk.l;
    let hit = l.load_integers(&queue.order, at);
    let [light, probability, u, v] = l.gather_quads(&queue.selected, hit << 2);
    let (p, n) = (Vec3::gather(l, &queue.position, hit << 2), Vec3::gather(l, &queue.normal, hit << 2));
    let from = LightSampleContext { position: p, normal: n, receiver: l.u(0) };
    let sample = chunk.tables.lights.sample_li_of(l, (light.to_bits(), probability), &from, &[u, v]);
    queue.store(l, &sample, at);
}
