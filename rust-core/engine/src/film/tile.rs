//! A tile's sums.

use super::{ChannelLayout, catcher, is_index};
use crate::{
    integrator::{BATCH, FirstHit, code},
    scene::{Aov, LightPart},
};
use std::collections::BTreeMap;

/// Sums over a block of samples, `BATCH` values a channel, by the pixels' Morton numbers.
#[derive(Clone, Debug)]
pub struct Block {
    /// Channel after channel.
    pub sums: Vec<f32>,
    /// Samples a pixel has in it.
    pub samples: u32,
}

/// Sums over all blocks so far.
#[derive(Clone, Debug)]
pub struct TileFilm {
    /// Channel after channel, `BATCH` values each, by the pixels' Morton numbers; empty before the first block.
    pub sums: Vec<f64>,
    /// Samples a pixel has.
    pub samples: u32,
    /// Blocks added.
    pub blocks: u32,
    waiting: BTreeMap<u32, Block>,
    index_channels: Vec<usize>,
}

impl TileFilm {
    /// An empty tile.
    pub fn new(layout: &ChannelLayout) -> Self {
        Self {
            sums: Vec::new(),
            samples: 0,
            blocks: 0,
            waiting: BTreeMap::new(),
            index_channels: layout.aovs.iter().zip(&layout.offsets).filter(|(aov, _)| is_index(**aov)).map(|(_, at)| *at).collect(),
        }
    }

    /// Adds block `number`; one that comes early waits.
    pub fn add(&mut self, number: u32, block: Block) {
        self.waiting.insert(number, block);
        while let Some(block) = self.waiting.remove(&self.blocks) {
            self.add_now(&block);
            self.blocks += 1;
        }
    }

    fn add_now(&mut self, block: &Block) {
        if self.sums.is_empty() {
            self.sums = block.sums.iter().map(|value| f64::from(*value)).collect();
        } else {
            self.add_sums(block);
        }
        self.samples += block.samples;
    }

    fn add_sums(&mut self, block: &Block) {
        for (channel, sums) in self.sums.chunks_exact_mut(BATCH).enumerate() {
            let values = &block.sums[channel * BATCH..(channel + 1) * BATCH];
            if self.index_channels.contains(&channel) {
                // Indices are not averaged: the first sample that met something names it.
                sums.iter_mut().zip(values).filter(|(sum, _)| **sum == 0.0).for_each(|(sum, value)| *sum = f64::from(*value));
            } else {
                sums.iter_mut().zip(values).for_each(|(sum, value)| *sum += f64::from(*value));
            }
        }
    }
}

impl Block {
    /// A block from what a worker gathered; positions are moved by `origin` back to world space, radiance is multiplied by `exposure`
    /// in the colour pass alone.
    pub fn new(layout: &ChannelLayout, gathered: &FirstHit, samples: u32, exposure: f32, origin: [f64; 3]) -> Self {
        let mut sums = vec![0.0; layout.channels * BATCH];
        for (aov, offset) in layout.aovs.iter().zip(&layout.offsets) {
            let channels = &mut sums[offset * BATCH..(offset + super::channel_names(*aov).len()) * BATCH];
            fill(*aov, channels, layout, gathered, exposure, origin);
        }
        if let Some(first) = layout.catchers {
            catcher::fill(&mut sums[first * BATCH..], gathered);
        }
        Self { sums, samples }
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
        Aov::LightGroup(number) => {
            for (out, column) in channels.chunks_exact_mut(BATCH).zip(gathered.groups.part(u32::from(number))) {
                out.iter_mut().zip(&column[..BATCH]).for_each(|(out, value)| *out = value * exposure);
            }
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
