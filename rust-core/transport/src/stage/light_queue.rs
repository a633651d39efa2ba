//! Next event estimation (NEE) for a whole chunk: lights are selected for all hits first, then sampled light by light.
//!
//! A register of neighbouring hits selects lights of many kinds, and each kind's sampling would run for the few lanes that selected it.

use crate::state::columns::load3;
use crate::state::vertex::Stage;
use crate::state::workspace::Workspace;
use gonio_camera::sampler::dimension;
use gonio_light::LightSample;
use gonio_simd::{F, Lanes, Vec3};

/// The light samples of a register of hits; the chunk's first call samples for all later hits too.
#[inline(always)]
pub(crate) fn sample<L: Lanes>(stage: &Stage<'_, L>, at: usize, ws: &mut Workspace) -> LightSample<L> {
    if !ws.light_queue.made {
        draw_lights(stage.l, stage, at, ws);
    }
    ws.light_queue.load(stage.l, at)
}

/// Selects and samples lights for all hits of the chunk from a register's beginning on.
#[inline(always)]
pub(crate) fn draw_chunk<L: Lanes>(stage: &Stage<'_, L>, first: usize, ws: &mut Workspace) {
    let end = stage.hits.len();
    for at in (first..end).step_by(L::COUNT) {
        choose(stage, at, ws);
    }
    let total = ws.light_queue.sort(&stage.tables.lights, first..end, L::COUNT);
    for at in (0..total).step_by(L::COUNT) {
        aim(stage, at, ws);
    }
    ws.light_queue.made = true;
}

/// Light selection for a register of hits.
#[inline(always)]
fn choose<L: Lanes>(stage: &Stage<'_, L>, at: usize, ws: &mut Workspace) {
    let Stage { l, tables, transport, context, ref hits, .. } = *stage;
    let path = l.load_integers(&ws.order, hits.start + at);
    let index = context.index(l, ws.paths.track(l, path).slot);
    let base = dimension::FIRST_BOUNCE + context.depth * dimension::BOUNCE;
    let [u_light, _] = context.sampler.pair(l, index, base + dimension::LIGHT_CHOICE);
    let [u, v] = context.sampler.pair(l, index, base + dimension::LIGHT);
    let (p, n) = (load3(l, &ws.surface.position, at), load3(l, &ws.surface.shading_normal, at));
    let (light, probability) = tables.lights.sample_light(l, transport.light_cache.as_deref(), &p, &n, u_light);
    let draws = &mut ws.light_queue;
    light.store(&mut draws.light, at);
    l.store_quads([F::from_bits(light), probability, u, v], &mut draws.draw, at);
    l.store_quads([p.x, p.y, p.z, l.f(0.0)], &mut draws.position, at);
    l.store_quads([n.x, n.y, n.z, l.f(0.0)], &mut draws.normal, at);
}

/// Samples the lights of a register of one group.
#[inline(always)]
fn aim<L: Lanes>(stage: &Stage<'_, L>, at: usize, ws: &mut Workspace) {
    let Stage { l, tables, .. } = *stage;
    let draws = &ws.light_queue;
    let hit = l.load_integers(&draws.order, at);
    let [light, probability, u, v] = l.gather_quads(&draws.draw, hit << 2);
    let (p, n) = (Vec3::gather(l, &draws.position, hit << 2), Vec3::gather(l, &draws.normal, hit << 2));
    let sample = tables.lights.sample_li_of(l, (light.to_bits(), probability), &p, &n, &[u, v]);
    ws.light_queue.store(l, &sample, at);
}

/// [`draw_chunk`] as a function of its own, as those of `kernels.rs`.
#[inline(never)]
pub(crate) fn draw_lights<L: Lanes>(l: L, stage: &Stage<'_, L>, first: usize, ws: &mut Workspace) {
    l.vectorize(
        #[inline(always)]
        || draw_chunk(stage, first, ws),
    );
}
