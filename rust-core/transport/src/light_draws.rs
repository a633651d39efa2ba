//! The lights that a chunk of hits is lit by, drawn for all of them before the first is lit: draws of one light go together.
//!
//! A register of neighbouring hits draws lights of many kinds, and each kind's sampling would run for the few lanes that drew it.

use super::{columns::load3, kernels, shade::Stage, workspace::Workspace};
use crate::graph::CHUNK;
use gonio_camera::sampler::dimension;
use gonio_light::{LightSample, LightTable};
use gonio_simd::{Column, F, Lanes, PADDING, Rgb, Vec3};
use std::ops::Range;

/// With more lights than this, groups are the kinds.
const MOST_GROUPS: usize = 16;
/// Room for all hits of a chunk, and for the runs of all groups of lights to begin with a register of their own.
const ROOM: usize = CHUNK + MOST_GROUPS * PADDING;

/// Properties of a sampled light, as bits.
mod bit {
    pub(super) const DELTA: u32 = 1;
    pub(super) const CASTS_SHADOW: u32 = 2;
}

/// A light drawn for each hit of a chunk, and the place on it.
#[derive(Debug)]
pub(super) struct LightDraws {
    /// Whether the draws of the chunk have been made: mirrors and glass want none.
    pub(super) made: bool,
    /// By hit: the light.
    light: Column<u32>,
    /// By hit, items of four: the light once more, its probability and numbers for the place on it; the hit's position and its normal.
    draw: Column,
    position: Column,
    normal: Column,
    /// Where each hit's sample is.
    place: Column<u32>,
    /// The hits, group of lights by group; what fills a group's last register repeats a hit.
    order: Column<u32>,
    /// The samples in that order, items of four: directions and distances, radiances and densities.
    way: Column,
    arriving: Column,
    bits: Column<u32>,
}

impl Default for LightDraws {
    fn default() -> Self {
        Self {
            made: false,
            light: Column::new(CHUNK),
            draw: Column::new(4 * CHUNK),
            position: Column::new(4 * CHUNK),
            normal: Column::new(4 * CHUNK),
            place: Column::new(CHUNK),
            order: Column::new(ROOM),
            way: Column::new(4 * ROOM),
            arriving: Column::new(4 * ROOM),
            bits: Column::new(ROOM),
        }
    }
}

impl LightDraws {
    /// Whether hits are worth sorting: lanes would draw lights of several kinds.
    #[inline(always)]
    pub(super) fn pays<L: Lanes>(lights: &LightTable, hits: usize) -> bool {
        L::COUNT > 1 && lights.has_several_kinds() && hits > 2 * PADDING
    }

    /// The samples of a register of hits.
    #[inline(always)]
    fn load<L: Lanes>(&self, l: L, at: usize) -> LightSample<L> {
        let place = l.load_integers(&self.place, at);
        let bits = l.gather_integers(&self.bits, place);
        let ([x, y, z, distance], [r, g, b, pdf]) = (l.gather_quads(&self.way, place << 2), l.gather_quads(&self.arriving, place << 2));
        LightSample {
            wi: Vec3::new(x, y, z),
            distance,
            radiance: Rgb::new(r, g, b),
            pdf,
            delta: (bits & bit::DELTA).ne(0),
            light: l.load_integers(&self.light, at),
            casts_shadow: (bits & bit::CASTS_SHADOW).ne(0),
        }
    }

    #[inline(always)]
    fn store<L: Lanes>(&mut self, l: L, sample: &LightSample<L>, at: usize) {
        let (wi, radiance) = (sample.wi, sample.radiance);
        l.store_quads([wi.x, wi.y, wi.z, sample.distance], &mut self.way, at);
        l.store_quads([radiance.r, radiance.g, radiance.b, sample.pdf], &mut self.arriving, at);
        let bits = l.u(bit::DELTA).keep_if(sample.delta) | l.u(bit::CASTS_SHADOW).keep_if(sample.casts_shadow);
        bits.store(&mut self.bits, at);
    }

    /// Counts and places some hits, each group's first at a register's beginning; gives the places taken.
    fn sort(&mut self, lights: &LightTable, hits: Range<usize>, lanes: usize) -> usize {
        // A group should fill half a register.
        let one_by_one = lights.len() <= MOST_GROUPS.min(2 * hits.len() / lanes);
        let mut places = [0u32; MOST_GROUPS];
        for light in &self.light[hits.clone()] {
            places[lights.group(*light, one_by_one)] += 1;
        }
        let mut total = 0;
        for place in &mut places {
            let count = *place as usize;
            *place = total as u32;
            total += count.next_multiple_of(lanes);
        }
        for hit in hits {
            let place = &mut places[lights.group(self.light[hit], one_by_one)];
            (self.place[hit], self.order[*place as usize]) = (*place, hit as u32);
            *place += 1;
        }
        for next in places.map(|place| place as usize).into_iter().filter(|next| next % lanes != 0) {
            let last = self.order[next - 1];
            self.order[next..next.next_multiple_of(lanes)].fill(last);
        }
        total
    }
}

/// The light drawn for each of a register of hits; with the chunk's first come the draws of all hits behind.
#[inline(always)]
pub(super) fn sample<L: Lanes>(stage: &Stage<'_, L>, at: usize, ws: &mut Workspace) -> LightSample<L> {
    if !ws.light_draws.made {
        kernels::draw_lights(stage.l, stage, at, ws);
    }
    ws.light_draws.load(stage.l, at)
}

/// Draws a light and a place on it for all hits of the chunk from a register's beginning on.
#[inline(always)]
pub(super) fn draw_chunk<L: Lanes>(stage: &Stage<'_, L>, first: usize, ws: &mut Workspace) {
    let end = stage.hits.len();
    for at in (first..end).step_by(L::COUNT) {
        choose(stage, at, ws);
    }
    let total = ws.light_draws.sort(&stage.tables.lights, first..end, L::COUNT);
    for at in (0..total).step_by(L::COUNT) {
        aim(stage, at, ws);
    }
    ws.light_draws.made = true;
}

/// Chooses the lights of a register of hits.
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
    let draws = &mut ws.light_draws;
    light.store(&mut draws.light, at);
    l.store_quads([F::from_bits(light), probability, u, v], &mut draws.draw, at);
    l.store_quads([p.x, p.y, p.z, l.f(0.0)], &mut draws.position, at);
    l.store_quads([n.x, n.y, n.z, l.f(0.0)], &mut draws.normal, at);
}

/// Samples the lights of a register of one group.
#[inline(always)]
fn aim<L: Lanes>(stage: &Stage<'_, L>, at: usize, ws: &mut Workspace) {
    let Stage { l, tables, .. } = *stage;
    let draws = &ws.light_draws;
    let hit = l.load_integers(&draws.order, at);
    let [light, probability, u, v] = l.gather_quads(&draws.draw, hit << 2);
    let (p, n) = (Vec3::gather(l, &draws.position, hit << 2), Vec3::gather(l, &draws.normal, hit << 2));
    let sample = tables.lights.sample_li_of(l, (light.to_bits(), probability), &p, &n, &[u, v]);
    ws.light_draws.store(l, &sample, at);
}
