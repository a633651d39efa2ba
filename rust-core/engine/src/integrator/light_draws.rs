//! The lights that a chunk of hits is lit by, drawn for all of them before the first is lit: draws of one light go together.
//!
//! A register of neighbouring hits draws lights of many kinds, and each kind's sampling would run for the few lanes that drew it.

use super::{
    kernels,
    shade::Stage,
    state::{Columns3, Workspace, columns3, gather3, load3},
    surface::store3,
};
use crate::{
    graph::CHUNK,
    light::{LightSample, LightTable},
    sampler::dimension,
};
use gonio_simd::{Column, Lanes, PADDING};
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
    /// By hit: the light, its probability, and numbers for the place on it.
    light: Column<u32>,
    probability: Column,
    numbers: [Column; 2],
    /// Where each hit's sample is.
    place: Column<u32>,
    /// The hits, group of lights by group; what fills a group's last register repeats a hit.
    order: Column<u32>,
    /// The samples in that order.
    wi: Columns3,
    distance: Column,
    radiance: Columns3,
    pdf: Column,
    bits: Column<u32>,
}

impl Default for LightDraws {
    fn default() -> Self {
        Self {
            made: false,
            light: Column::new(CHUNK),
            probability: Column::new(CHUNK),
            numbers: [Column::new(CHUNK), Column::new(CHUNK)],
            place: Column::new(CHUNK),
            order: Column::new(ROOM),
            wi: columns3(ROOM),
            distance: Column::new(ROOM),
            radiance: columns3(ROOM),
            pdf: Column::new(ROOM),
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
        LightSample {
            wi: gather3(l, &self.wi, place),
            distance: l.gather(&self.distance, place),
            radiance: gather3(l, &self.radiance, place).into(),
            pdf: l.gather(&self.pdf, place),
            delta: (bits & bit::DELTA).ne(0),
            light: l.load_integers(&self.light, at),
            casts_shadow: (bits & bit::CASTS_SHADOW).ne(0),
        }
    }

    #[inline(always)]
    fn store<L: Lanes>(&mut self, l: L, sample: &LightSample<L>, at: usize) {
        store3(sample.wi, &mut self.wi, at);
        sample.distance.store(&mut self.distance, at);
        store3(sample.radiance.into(), &mut self.radiance, at);
        sample.pdf.store(&mut self.pdf, at);
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
    let index = context.index(l, l.gather_integers(&ws.paths.slot, path));
    let base = dimension::FIRST_BOUNCE + context.depth * dimension::BOUNCE;
    let [u_choice, _] = context.sampler.pair(l, index, base + dimension::LIGHT_CHOICE);
    let numbers = context.sampler.pair(l, index, base + dimension::LIGHT);
    let (p, n) = (load3(l, &ws.surface.position, at), load3(l, &ws.surface.shading_normal, at));
    let (light, probability) = tables.lights.choose(l, transport.known.as_deref(), p, n, u_choice);
    let draws = &mut ws.light_draws;
    light.store(&mut draws.light, at);
    probability.store(&mut draws.probability, at);
    numbers[0].store(&mut draws.numbers[0], at);
    numbers[1].store(&mut draws.numbers[1], at);
}

/// Samples the lights of a register of one group.
#[inline(always)]
fn aim<L: Lanes>(stage: &Stage<'_, L>, at: usize, ws: &mut Workspace) {
    let Stage { l, tables, .. } = *stage;
    let draws = &ws.light_draws;
    let hit = l.load_integers(&draws.order, at);
    let chosen = (l.gather_integers(&draws.light, hit), l.gather(&draws.probability, hit));
    let numbers = [l.gather(&draws.numbers[0], hit), l.gather(&draws.numbers[1], hit)];
    let (p, n) = (gather3(l, &ws.surface.position, hit), gather3(l, &ws.surface.shading_normal, hit));
    let sample = tables.lights.sample_chosen(l, chosen, p, n, numbers);
    ws.light_draws.store(l, &sample, at);
}
