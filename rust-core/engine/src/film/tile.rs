//! A tile's sums.

use super::{
    ChannelLayout, Film,
    blocks::{self, GROUP, block_at},
    catcher,
    channels::summed_channels,
    deep::{self, Deep},
    is_index,
    matte::{self, Matte},
    noise::{Halves, decides},
    splats::SplatBlock,
    sums::{Place, Rules, Sums},
    zones::{ZONE, ZONES, zone_of},
};
use crate::{
    camera::sampler::{BATCH, tile_code, unpack},
    colour::luminance_of_pixel,
    scene::{Aov, LightPart, Settings},
    transport::{TileSums, code},
};
use std::{borrow::Cow, collections::BTreeMap, ops::Range};

/// Sums over a block of samples, `BATCH` values a channel, by the pixels' Morton numbers.
#[derive(Clone, Debug)]
pub struct Block {
    /// Channel after channel.
    pub sums: Vec<f32>,
    /// A bit for each zone that was sampled.
    pub zones: u64,
    /// Luminance of the colour; empty where nobody looks at the noise.
    pub luminance: Vec<f32>,
    /// What its light paths brought.
    pub(crate) splats: SplatBlock,
    /// Its mattes, by kind.
    pub(crate) mattes: Vec<Matte>,
    /// What it met at which depth, where a deep picture is wanted.
    pub(crate) deep: Option<Deep>,
}

/// Sums over all blocks so far.
#[derive(Clone, Debug)]
pub struct TileFilm {
    /// By zone, samples a pixel has.
    pub samples: [u32; ZONES],
    /// The block that comes next.
    pub(super) next: u32,
    /// Pixels of each zone.
    pixels: [u8; ZONES],
    /// Bits of the zones that go on.
    pub(super) zones: u64,
    pub(super) sums: Sums,
    /// What tells the noise, if zones may have enough samples before the end.
    pub(super) halves: Option<Halves>,
    /// By kind of matte.
    pub(super) mattes: Vec<Matte>,
    /// By depth, where a deep picture is wanted.
    pub(super) deep: Option<Deep>,
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
    /// The tiles that are rendered.
    pub(super) tiles: Range<u32>,
    pub(super) index_channels: Vec<usize>,
    /// Kinds of mattes.
    pub(super) mattes: usize,
    /// Share by which depths of a deep picture that is wanted may differ and be one.
    pub(super) deep: Option<f32>,
    /// Error and least samples at which a zone has enough.
    pub(super) enough: Option<(f32, u32)>,
}

impl Plan {
    pub(super) fn new(settings: &Settings, layout: &ChannelLayout, tiles: u32) -> Self {
        Self {
            range: settings.range(),
            samples: settings.samples,
            tiles: settings.tiles(tiles),
            index_channels: layout.aovs.iter().zip(&layout.offsets).filter(|(aov, _)| is_index(**aov)).map(|(_, at)| *at).collect(),
            mattes: layout.mattes().len(),
            deep: deep::is_asked(&layout.aovs).then_some(settings.deep_tolerance),
            enough: settings.least_samples().map(|least| (settings.noise_threshold, least)),
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
        let mut pixels = [0; ZONES];
        for y in (0..size[1]).step_by(ZONE) {
            for x in (0..size[0]).step_by(ZONE) {
                pixels[zone_of(tile_code([x, y]))] = ((size[0] - x).min(ZONE) * (size[1] - y).min(ZONE)) as u8;
            }
        }
        let zones = (0..ZONES).filter(|zone| pixels[*zone] > 0).fold(0, |bits, zone| bits | 1 << zone);
        let halves = plan.enough.map(|_| Halves::new());
        Self {
            samples: [0; ZONES],
            next: plan.first(),
            pixels,
            zones,
            sums: Sums::default(),
            halves,
            mattes: vec![Matte::default(); plan.mattes],
            deep: plan.deep.map(|_| Deep::default()),
            waiting: BTreeMap::new(),
        }
    }

    /// Adds block `number`; one that comes early waits. `white` is the value that is shown as white. Gives the splats of the blocks that were added.
    pub(super) fn add(&mut self, number: u32, block: Block, plan: &Plan, white: f32) -> Vec<SplatBlock> {
        self.waiting.insert(number, block);
        let mut splats = Vec::new();
        while let Some(mut block) = self.waiting.remove(&self.next) {
            splats.push(std::mem::take(&mut block.splats));
            self.add_now(block, plan, white);
        }
        splats
    }

    fn add_now(&mut self, block: Block, plan: &Plan, white: f32) {
        let samples = blocks::block(self.next, plan.samples);
        if let (Some(halves), Some((threshold, least))) = (&mut self.halves, plan.enough) {
            halves.add(self.next, &block.luminance, samples.end - samples.start, block.zones);
            if decides(samples.end, least) && samples.end < plan.range.end {
                self.zones = halves.noisy(self.zones, &self.pixels, threshold, white);
            }
        }
        self.mattes.iter_mut().zip(&block.mattes).for_each(|(matte, more)| matte.add(more));
        self.deep.iter_mut().zip(&block.deep).for_each(|(deep, more)| deep.add(more));
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
        self.mattes.iter_mut().zip(&later.mattes).for_each(|(matte, more)| matte.add(more));
        self.deep.iter_mut().zip(&later.deep).for_each(|(deep, more)| deep.add(more));
        self.samples.iter_mut().zip(later.samples).for_each(|(samples, more)| *samples += more);
        self.next = later.next;
    }

    /// What there is.
    pub(super) fn state(&self) -> TileState {
        TileState { next: self.next, samples: self.least_samples(), zones: self.zones }
    }

    /// Samples a pixel, the least of all zones.
    pub fn least_samples(&self) -> u32 {
        self.samples.iter().zip(self.pixels).filter(|(_, pixels)| *pixels > 0).map(|(samples, _)| *samples).min().unwrap_or(0)
    }

    /// Samples of all pixels together.
    pub(super) fn total_samples(&self) -> u64 {
        self.samples.iter().zip(self.pixels).map(|(samples, pixels)| u64::from(*samples) * u64::from(pixels)).sum()
    }
}

impl Block {
    /// A block from what a worker gathered in some zones, whose batches were packed as for the zones `packed`; positions are moved by `origin` back
    /// to world space, radiance is multiplied by `exposure` in the colour pass alone.
    pub(crate) fn new(film: &Film, gathered: &TileSums, zones: u64, packed: u64, origin: [f64; 3]) -> Self {
        let (layout, exposure) = (&film.layout, film.exposure);
        let mut sums = vec![0.0; layout.channels * BATCH];
        for (aov, offset) in layout.aovs.iter().zip(&layout.offsets) {
            let channels = &mut sums[offset * BATCH..(offset + summed_channels(*aov)) * BATCH];
            fill(*aov, channels, layout, gathered, exposure, origin);
        }
        if let Some(first) = layout.catchers {
            catcher::fill(&mut sums[first * BATCH..], gathered);
        }
        if let Some(channel) = layout.holes {
            // Without holdouts that are shown nothing was counted.
            sums[channel * BATCH..].iter_mut().zip(&gathered.holes[..]).for_each(|(sum, share)| *sum = *share);
        }
        for (channel, sums) in sums.chunks_exact_mut(BATCH).enumerate() {
            unpack(packed, sums, film.plan.index_channels.contains(&channel));
        }
        let mut luminance = if film.plan.enough.is_some() { shown_luminance(gathered, layout, exposure) } else { Vec::new() };
        unpack(packed, &mut luminance, false);
        let mattes = matte::of_block(&layout.mattes(), &gathered.mattes, packed);
        let deep = film.plan.deep.map(|tolerance| deep::of_block(&gathered.deep, tolerance, packed));
        Self { sums, zones, luminance, splats: SplatBlock::default(), mattes, deep }
    }

    /// Shares the seconds that the block took out among its pixels, where a pass shows them.
    pub(crate) fn share_out(&mut self, film: &Film, seconds: f64) {
        let Some(offset) = film.layout.offset(Aov::Cost) else { return };
        let rays = &mut self.sums[offset * BATCH..(offset + 1) * BATCH];
        let all: f64 = rays.iter().map(|rays| f64::from(*rays)).sum();
        rays.iter_mut().for_each(|rays| *rays *= (seconds / all.max(1.0)) as f32);
    }
}

/// What a pixel's noise is measured by: the luminance of the colour, and of what shadow catchers send.
fn shown_luminance(gathered: &TileSums, layout: &ChannelLayout, exposure: f32) -> Vec<f32> {
    let luminance = |i: usize| luminance(gathered, i);
    let caught = |i: usize| if layout.catchers.is_some() { luminance(2 * BATCH + i) } else { 0.0 };
    (0..BATCH).map(|i| (luminance(i) + caught(i)) * exposure).collect()
}

fn luminance(gathered: &TileSums, slot: usize) -> f32 {
    let [red, green, blue] = &gathered.radiance;
    luminance_of_pixel([red[slot], green[slot], blue[slot]])
}

fn fill(aov: Aov, channels: &mut [f32], layout: &ChannelLayout, gathered: &TileSums, exposure: f32, origin: [f64; 3]) {
    let radiance = &gathered.radiance;
    let luminance = |i: usize| luminance(gathered, i);
    match aov {
        Aov::Color => {
            expose3(&mut channels[..3 * BATCH], radiance, exposure);
            channels[3 * BATCH..].copy_from_slice(&gathered.alpha[..BATCH]);
        }
        Aov::LightGroup(number) => expose3(channels, gathered.groups.part(u32::from(number)), exposure),
        Aov::DenoisingLight => expose3(channels, &gathered.specular, exposure),
        Aov::Alpha => channels.copy_from_slice(&gathered.alpha[..BATCH]),
        Aov::Depth => channels.copy_from_slice(&gathered.depth[..BATCH]),
        Aov::Normal => copy3(channels, &gathered.normal),
        Aov::Albedo => copy3(channels, &gathered.albedo),
        Aov::DenoisingAlbedo => copy3(channels, &gathered.guides[0]),
        Aov::DenoisingNormal => copy3(channels, &gathered.guides[1]),
        Aov::Uv => copy3(channels, &gathered.uv),
        Aov::Motion => {
            // Columns are empty where things are blurred.
            for (out, column) in channels.chunks_exact_mut(BATCH).zip(&gathered.motion).filter(|(_, column)| !column.is_empty()) {
                out.copy_from_slice(&column[..BATCH]);
            }
        }
        Aov::Shader(..) => {
            for (out, column) in channels.chunks_exact_mut(BATCH).zip(&gathered.shader.columns[layout.shader_column(aov)..]) {
                out.copy_from_slice(&column[..BATCH]);
            }
        }
        // These are kept in other ways.
        Aov::Cryptomatte(..) | Aov::ShadowCatcher | Aov::Deep => {}
        Aov::LightExpression(_) => expose3(channels, gathered.expressions.part(layout.expression(aov)), exposure),
        Aov::LightPaths(classes, _) => fill_light_paths(classes, channels, gathered, exposure),
        // Shares of the block's rays; its seconds come when they are known.
        Aov::Cost => channels.copy_from_slice(&gathered.effort.rays[..BATCH]),
        Aov::Mist => channels.copy_from_slice(&gathered.clearness[..BATCH]),
        Aov::Emission => copy3(channels, gathered.lights.part(code::EMISSION)),
        Aov::Environment => copy3(channels, gathered.lights.part(code::ENVIRONMENT)),
        Aov::Light(kind, LightPart::Direct) => copy3(channels, gathered.lights.part(kind as u32)),
        Aov::Light(kind, LightPart::Indirect) => copy3(channels, gathered.lights.part(code::INDIRECT + kind as u32)),
        Aov::Light(kind, LightPart::Color) => copy3(channels, gathered.lights.part(code::COLOUR + kind as u32)),
        Aov::ObjectIndex => channels.iter_mut().zip(&gathered.object_index[..]).for_each(|(out, id)| *out = *id as f32),
        Aov::MaterialIndex => channels.iter_mut().zip(&gathered.material_index[..]).for_each(|(out, id)| *out = *id as f32),
        Aov::SampleCount => channels.copy_from_slice(&gathered.rays[..BATCH]),
        Aov::P => {
            for (c, out) in channels.chunks_exact_mut(BATCH).enumerate() {
                let place = origin[c] as f32;
                for (i, out) in out.iter_mut().enumerate() {
                    *out = gathered.position[c][i] + place * gathered.alpha[i];
                }
            }
        }
        Aov::InstanceId => channels.iter_mut().zip(&gathered.instance_id[..]).for_each(|(out, id)| *out = *id as f32),
        Aov::ElementId => channels.iter_mut().zip(&gathered.element_id[..]).for_each(|(out, id)| *out = *id as f32),
        Aov::PrimId => channels.iter_mut().zip(&gathered.prim_id[..]).for_each(|(out, id)| *out = *id as f32),
        Aov::Luminance => channels.iter_mut().enumerate().for_each(|(i, out)| *out = luminance(i)),
        Aov::Illuminance => channels.iter_mut().enumerate().for_each(|(i, out)| *out = luminance(BATCH + i)),
    }
}

/// The sum of classes of light; their codes are the bits' numbers.
fn fill_light_paths(classes: u16, channels: &mut [f32], gathered: &TileSums, exposure: f32) {
    for class in (0..10).filter(|class| classes >> class & 1 == 1) {
        for (out, column) in channels.chunks_exact_mut(BATCH).zip(gathered.lights.part(class)) {
            out.iter_mut().zip(&column[..BATCH]).for_each(|(out, value)| *out += value * exposure);
        }
    }
}

fn expose3(channels: &mut [f32], from: &[gonio_simd::Column; 3], exposure: f32) {
    for (out, column) in channels.chunks_exact_mut(BATCH).zip(from) {
        out.iter_mut().zip(&column[..BATCH]).for_each(|(out, value)| *out = value * exposure);
    }
}

fn copy3(channels: &mut [f32], from: &[gonio_simd::Column; 3]) {
    for (out, column) in channels.chunks_exact_mut(BATCH).zip(from) {
        out.copy_from_slice(&column[..BATCH]);
    }
}
