//! The queue of next event estimation (NEE): the light samples of a chunk of hits, sorted by light.

use crate::graph::CHUNK;
use gonio_light::{LightSample, LightTable};
use gonio_simd::{Column, Lanes, PADDING, SpectrumItems, Vec3, Wavelengths};
use std::ops::Range;

/// With more lights than this, groups are the kinds.
const MOST_GROUPS: usize = 16;
/// Room for all hits of a chunk, and for the runs of all groups of lights to begin with a register of their own.
const ROOM: usize = CHUNK + MOST_GROUPS * PADDING;

/// Properties of a sampled light, as bits.
mod bit {
    pub(crate) const DELTA: u32 = 1;
    pub(crate) const CASTS_SHADOW: u32 = 2;
}

/// A light selected for each hit of a chunk, and the point sampled on it.
#[derive(Debug)]
pub(crate) struct LightSampleQueue {
    /// Whether the chunk's lights have been sampled; specular surfaces never ask for it.
    pub(crate) made: bool,
    /// By hit: the light.
    pub(crate) light: Column<u32>,
    /// By hit, items of four: the light once more, its probability and two random numbers; the hit's position; its normal.
    pub(crate) selected: Column,
    pub(crate) position: Column,
    pub(crate) normal: Column,
    /// Where each hit's sample stands in `order`.
    pub(crate) place: Column<u32>,
    /// The hits, group of lights by group; what fills a group's last register repeats a hit.
    pub(crate) order: Column<u32>,
    /// The samples in that order, items of four: direction and distance; radiance and pdf.
    pub(crate) direction: Column,
    pub(crate) radiance: SpectrumItems,
    pub(crate) bits: Column<u32>,
}

impl Default for LightSampleQueue {
    fn default() -> Self {
        Self {
            made: false,
            light: Column::new(CHUNK),
            selected: Column::new(4 * CHUNK),
            position: Column::new(4 * CHUNK),
            normal: Column::new(4 * CHUNK),
            place: Column::new(CHUNK),
            order: Column::new(ROOM),
            direction: Column::new(4 * ROOM),
            radiance: SpectrumItems::new(ROOM),
            bits: Column::new(ROOM),
        }
    }
}

impl LightSampleQueue {
    /// Whether sorting hits by light pays: unsorted lanes would sample lights of several kinds.
    #[inline(always)]
    pub(crate) fn pays<L: Lanes>(lights: &LightTable, hits: usize) -> bool {
        L::COUNT > 1 && lights.has_several_kinds() && hits > 2 * PADDING
    }

    /// The samples of a register of hits.
    #[inline(always)]
    pub(crate) fn load<L: Lanes>(&self, l: L, at: usize) -> LightSample<L> {
        let place = l.load_integers(&self.place, at);
        let bits = l.gather_integers(&self.bits, place);
        let [x, y, z, distance] = l.gather_quads(&self.direction, place << 2);
        let (radiance, pdf) = self.radiance.gather(l, place);
        LightSample {
            wi: Vec3::new(x, y, z),
            distance,
            radiance: radiance.to_rgb(),
            pdf,
            delta: (bits & bit::DELTA).ne(0),
            light: l.load_integers(&self.light, at),
            casts_shadow: (bits & bit::CASTS_SHADOW).ne(0),
        }
    }

    #[inline(always)]
    pub(crate) fn store<L: Lanes>(&mut self, l: L, sample: &LightSample<L>, at: usize) {
        let wi = sample.wi;
        l.store_quads([wi.x, wi.y, wi.z, sample.distance], &mut self.direction, at);
        // The same numbers, in whichever type the items have.
        self.radiance.store(Wavelengths::rgb(l).radiance(sample.radiance), sample.pdf, at);
        let bits = l.u(bit::DELTA).keep_if(sample.delta) | l.u(bit::CASTS_SHADOW).keep_if(sample.casts_shadow);
        bits.store(&mut self.bits, at);
    }

    /// Counting sort of some hits by light; each group starts a register. Returns the length of `order`.
    pub(crate) fn sort(&mut self, lights: &LightTable, hits: Range<usize>, lanes: usize) -> usize {
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
