//! A tile's sums.

use super::{
    ChannelLayout,
    blocks::{self, GROUP, block_at},
    catcher, is_index,
    sums::{Place, Rules, Sums},
};
use crate::{
    integrator::{BATCH, FirstHit, TILE, code, tile_code},
    scene::{Aov, LightPart, Settings},
};
use std::{borrow::Cow, collections::BTreeMap, ops::Range};

/// Pixels along the side of a zone: what adaptive sampling goes on with or leaves.
pub const ZONE: usize = 8;
/// Zones of a tile, and pixels of a zone: those whose Morton numbers differ in the last six bits.
pub const ZONES: usize = (TILE / ZONE) * (TILE / ZONE);

/// The zone of a pixel by its Morton number.
#[inline]
pub fn zone_of(code: usize) -> usize {
    code / (ZONE * ZONE)
}

/// Sums over a block of samples, `BATCH` values a channel, by the pixels' Morton numbers.
#[derive(Clone, Debug)]
pub struct Block {
    /// Channel after channel.
    pub sums: Vec<f32>,
    /// A bit for each zone that was sampled.
    pub zones: u64,
}

/// Sums over all blocks so far.
#[derive(Clone, Debug)]
pub struct TileFilm {
    /// By zone, samples a pixel has.
    pub samples: [u32; ZONES],
    /// The block that comes next.
    pub(super) next: u32,
    /// Bits of the zones that have pixels.
    inside: u64,
    /// Bits of the zones that go on.
    pub(super) zones: u64,
    pub(super) sums: Sums,
    waiting: BTreeMap<u32, Block>,
}

/// What of a tile there is, and what comes next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TileState {
    /// The block that comes next.
    pub next: u32,
    /// Samples a pixel, the least of all zones.
    pub samples: u32,
    /// Bits of the zones that go on.
    pub zones: u64,
}

/// What all tiles of a film have in common.
#[derive(Clone, Debug)]
pub(super) struct Plan {
    /// First sample, the one behind the last, and samples of the whole render.
    pub(super) range: Range<u32>,
    pub(super) samples: u32,
    pub(super) index_channels: Vec<usize>,
}

impl Plan {
    pub(super) fn new(settings: &Settings, layout: &ChannelLayout) -> Self {
        Self {
            range: settings.range(),
            samples: settings.samples,
            index_channels: layout.aovs.iter().zip(&layout.offsets).filter(|(aov, _)| is_index(**aov)).map(|(_, at)| *at).collect(),
        }
    }

    pub(super) fn rules(&self) -> Rules<'_> {
        Rules { index_channels: &self.index_channels, from_start: self.range.start == 0 }
    }

    /// The first block.
    pub(super) fn first(&self) -> u32 {
        block_at(self.range.start, self.samples).unwrap_or(0)
    }

    fn place(&self, samples: &Range<u32>) -> Place {
        let group_start = samples.start / GROUP * GROUP;
        match samples.end.is_multiple_of(GROUP) {
            _ if group_start < self.range.start => Place::Leading,
            true => Place::Last,
            false => Place::Open,
        }
    }
}

impl TileFilm {
    /// An empty tile of so many pixels each way.
    pub(super) fn new(plan: &Plan, size: [usize; 2]) -> Self {
        let corners = (0..size[1]).step_by(ZONE).flat_map(|y| (0..size[0]).step_by(ZONE).map(move |x| [x, y]));
        let inside = corners.fold(0, |bits, corner| bits | 1 << zone_of(tile_code(corner)));
        Self { samples: [0; ZONES], next: plan.first(), inside, zones: inside, sums: Sums::default(), waiting: BTreeMap::new() }
    }

    /// Adds block `number`; one that comes early waits.
    pub(super) fn add(&mut self, number: u32, block: Block, plan: &Plan) {
        self.waiting.insert(number, block);
        while let Some(block) = self.waiting.remove(&self.next) {
            self.add_now(block, plan);
        }
    }

    fn add_now(&mut self, block: Block, plan: &Plan) {
        let samples = blocks::block(self.next, plan.samples);
        self.sums.add_block(Cow::Owned(block.sums), plan.place(&samples), plan.rules());
        self.count(samples.end - samples.start, block.zones);
        self.next += 1;
    }

    fn count(&mut self, samples: u32, zones: u64) {
        let sampled = self.samples.iter_mut().enumerate().filter(|(zone, _)| zones >> zone & 1 == 1);
        sampled.for_each(|(_, count)| *count += samples);
    }

    /// Adds what a tile of the run that follows has.
    pub(super) fn join(&mut self, later: Self, plan: &Plan) {
        for (number, block) in (self.next..).zip(later.sums.leading) {
            self.sums.add_block(Cow::Owned(block), plan.place(&blocks::block(number, plan.samples)), plan.rules());
        }
        for group in later.sums.groups {
            self.sums.add_group(group, plan.rules());
        }
        if !later.sums.open.is_empty() {
            self.sums.open = later.sums.open;
        }
        self.samples.iter_mut().zip(later.samples).for_each(|(samples, more)| *samples += more);
        self.next = later.next;
    }

    /// What there is.
    pub(super) fn state(&self) -> TileState {
        TileState { next: self.next, samples: self.least_samples(), zones: self.zones }
    }

    /// Samples a pixel, the least of all zones.
    pub fn least_samples(&self) -> u32 {
        let inside = self.samples.iter().enumerate().filter(|(zone, _)| self.inside >> zone & 1 == 1);
        inside.map(|(_, samples)| *samples).min().unwrap_or(0)
    }
}

impl Block {
    /// A block from what a worker gathered; positions are moved by `origin` back to world space, radiance is multiplied by `exposure`
    /// in the colour pass alone.
    pub fn new(layout: &ChannelLayout, gathered: &FirstHit, zones: u64, exposure: f32, origin: [f64; 3]) -> Self {
        let mut sums = vec![0.0; layout.channels * BATCH];
        for (aov, offset) in layout.aovs.iter().zip(&layout.offsets) {
            let channels = &mut sums[offset * BATCH..(offset + super::channel_names(*aov).len()) * BATCH];
            fill(*aov, channels, layout, gathered, exposure, origin);
        }
        if let Some(first) = layout.catchers {
            catcher::fill(&mut sums[first * BATCH..], gathered);
        }
        Self { sums, zones }
    }
}

fn fill(aov: Aov, channels: &mut [f32], layout: &ChannelLayout, gathered: &FirstHit, exposure: f32, origin: [f64; 3]) {
    let radiance = &gathered.radiance;
    let luminance = |i: usize| 0.2126 * radiance[0][i] + 0.7152 * radiance[1][i] + 0.0722 * radiance[2][i];
    match aov {
        Aov::Color => {
            for (c, out) in channels.chunks_exact_mut(BATCH).take(3).enumerate() {
                out.iter_mut().zip(&radiance[c][..BATCH]).for_each(|(out, value)| *out = value * exposure);
            }
            channels[3 * BATCH..].copy_from_slice(&gathered.alpha[..BATCH]);
        }
        Aov::Alpha => channels.copy_from_slice(&gathered.alpha[..BATCH]),
        Aov::Depth => channels.copy_from_slice(&gathered.depth[..BATCH]),
        Aov::Normal | Aov::DenoisingNormal => copy3(channels, &gathered.normal),
        Aov::Albedo | Aov::DenoisingAlbedo => copy3(channels, &gathered.albedo),
        Aov::Uv => copy3(channels, &gathered.uv),
        Aov::Shader(..) => {
            for (out, column) in channels.chunks_exact_mut(BATCH).zip(&gathered.shader.columns[layout.shader_column(aov)..]) {
                out.copy_from_slice(&column[..BATCH]);
            }
        }
        Aov::Mist => channels.copy_from_slice(&gathered.clearness[..BATCH]),
        Aov::Emission => copy3(channels, gathered.lights.part(code::EMISSION)),
        Aov::Environment => copy3(channels, gathered.lights.part(code::ENVIRONMENT)),
        Aov::Light(kind, LightPart::Direct) => copy3(channels, gathered.lights.part(kind as u32)),
        Aov::Light(kind, LightPart::Indirect) => copy3(channels, gathered.lights.part(code::INDIRECT + kind as u32)),
        Aov::Light(kind, LightPart::Color) => copy3(channels, gathered.lights.part(code::COLOUR + kind as u32)),
        Aov::ObjectIndex => channels.iter_mut().zip(&gathered.object_index[..]).for_each(|(out, id)| *out = *id as f32),
        Aov::MaterialIndex => channels.iter_mut().zip(&gathered.material_index[..]).for_each(|(out, id)| *out = *id as f32),
        Aov::SampleCount => {}
        Aov::P => {
            for (c, out) in channels.chunks_exact_mut(BATCH).enumerate() {
                let place = origin[c] as f32;
                for (i, out) in out.iter_mut().enumerate() {
                    *out = gathered.position[c][i] + place * gathered.alpha[i];
                }
            }
        }
        Aov::PrimId => channels.iter_mut().zip(&gathered.prim_id[..]).for_each(|(out, id)| *out = *id as f32),
        Aov::Luminance => channels.iter_mut().enumerate().for_each(|(i, out)| *out = luminance(i)),
        Aov::Illuminance => channels.iter_mut().enumerate().for_each(|(i, out)| *out = luminance(BATCH + i)),
    }
}

fn copy3(channels: &mut [f32], from: &[gonio_simd::Column; 3]) {
    for (out, column) in channels.chunks_exact_mut(BATCH).zip(from) {
        out.copy_from_slice(&column[..BATCH]);
    }
}
