//! Exit of subsurface random walks: the point is lit (NEE) and scatters as a white Lambertian surface.

use crate::accumulate::deposit::Deposits;
use crate::stage::light::nee::sample_light;
use crate::stage::shade::scatter::scatter;
use crate::state::chunk::ChunkContext;
use crate::state::queue::Queues;
use crate::state::vertex::Vertex;
use gonio_bsdf::subsurface;
use gonio_camera::sampler::dimension;
use gonio_simd::Lanes;

/// Scatters walks that come out, as a white Lambertian surface, and lights them if they are to be `lit`; `base` is the first sampler dimension that it uses.
#[inline(always)]
pub(crate) fn light_and_scatter<L: Lanes>(
    chunk: &ChunkContext<'_, L>,
    point: &Vertex<L>,
    base: u32,
    lit: bool,
    queues: &mut Queues,
    deposits: &mut Deposits,
) {
    let ChunkContext { l, tables, sample, .. } = *chunk;
    let lobes = subsurface::exit(l);
    let index = sample.index(l, point.core.slot);
    let [u_light, u_roulette] = sample.sampler.pair(l, index, base + dimension::LIGHT_CHOICE);
    if lit && !tables.lights.is_empty() {
        let [u, v] = sample.sampler.pair(l, index, base + dimension::LIGHT);
        sample_light(chunk, point, &lobes, [u_light, u, v], point.alive, &mut queues.shadows, deposits);
    }
    let [u, v] = sample.sampler.pair(l, index, base + dimension::BSDF);
    let random = [l.f(0.5), u, v, u_roulette];
    scatter(chunk, point, &lobes, random, [point.alive, l.m(false)], &mut queues.next, &mut queues.walks);
}
