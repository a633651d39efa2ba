//! Sensors' paths, and from their pixels to readings.

use super::{reading::Reading, watch::MOST_BOUNCES};
use crate::{
    compile::CompiledScene,
    error::Result,
    film::Image,
    render::{LightPaths, Progress, Render},
    scene::{Antialiasing, Aov, Background, Settings},
    transport::{Sensor, SensorTable},
};
use gonio_simd::Execution;
use std::{sync::Arc, time::Duration};

/// How often progress is told.
const TELL_EVERY: Duration = Duration::from_millis(50);
/// Makes seeds of rounds that are far apart.
const OTHER_SEED: u32 = 0x9e37_79b9;
/// Parts of a block along its side; each is a net of the sampler's sequence itself.
const PARTS: usize = 4;

/// The seed of a round that is independent of others.
pub(super) fn seed_of_round(seed: u32, round: u32) -> u32 {
    seed ^ round.wrapping_mul(OTHER_SEED)
}

/// The settings of measurements: limits are for pictures' sake.
pub(super) fn unlimited(settings: &Settings) -> Settings {
    Settings {
        crop: None,
        sample_range: None,
        tile_range: None,
        noise_threshold: 0.0,
        antialiasing: Antialiasing::Sampled,
        kind_bounces: [MOST_BOUNCES; 4],
        volume_bounces: MOST_BOUNCES,
        clamp_direct: 0.0,
        clamp_indirect: 0.0,
        caustic_paths: [true; 2],
        time_limit_s: 0.0,
        aovs: vec![Aov::Luminance, Aov::Illuminance],
        shader_passes: Vec::new(),
        background: Background::Seen,
        ..settings.clone()
    }
}

/// What is measured how.
#[derive(Clone, Copy)]
pub(super) struct Sensing<'a> {
    pub(super) scene: &'a Arc<CompiledScene>,
    pub(super) sensors: &'a [Sensor],
    pub(super) settings: &'a Settings,
    pub(super) execution: Execution,
    pub(super) effort: Effort,
}

/// How much is done beside taking samples.
#[derive(Clone, Copy, Debug)]
pub(super) struct Effort {
    /// The most pixels that the samples of a sensor are spread over.
    most_pixels: usize,
    /// Rounds of samples that are independent of each other, where light paths bring light: photons of a round are shared by all its samples.
    pub(super) rounds: u32,
    /// Batches of light paths to meters before their errors are looked at for the first time, and whether there may be more.
    pub(super) first_look: u64,
    goes_on: bool,
}

impl Effort {
    /// For a measurement that tells its own error.
    pub(super) const WHOLE: Self = Self { most_pixels: usize::MAX, rounds: 16, first_look: 64, goes_on: true };

    /// The most batches of light paths of a measurement of so many samples.
    pub(super) fn most_batches(&self, samples: u32) -> u64 {
        if self.goes_on { u64::from(samples).max(self.first_look) } else { self.first_look }
    }

    /// For one of many that do so together, of so many samples.
    pub(super) fn of_part(samples: u32) -> Self {
        Self { most_pixels: samples as usize, rounds: 1, first_look: 4, goes_on: false }
    }
}

impl Sensing<'_> {
    /// What the sensors' own paths find, all samples together.
    pub(super) fn readings(&self, progress: &mut dyn FnMut(&Progress) -> bool) -> Result<Vec<Reading>> {
        let (image, blocks) = self.trace(self.settings.samples, self.effort.most_pixels, None, 0, progress)?;
        Ok(blocks.iter().map(|block| Reading::of_parts(block.parts(&image))).collect())
    }

    /// What they find in a round, without what light paths bring to the sensors themselves.
    pub(super) fn round(
        &self,
        light_paths: (LightPaths, Arc<[u32]>),
        round: u32,
        progress: &mut dyn FnMut(&Progress) -> bool,
    ) -> Result<Vec<f64>> {
        let samples = self.settings.samples.div_ceil(self.effort.rounds);
        let (image, blocks) = self.trace(samples, samples as usize, Some(light_paths), round, progress)?;
        Ok(blocks.iter().map(|block| block.parts(&image).sum::<f64>() / (PARTS * PARTS) as f64).collect())
    }

    /// Traces the sensors' paths, at most so many pixels of each: their picture, and where in it each sensor is. `brought` is what light paths bring in
    /// the round of this number.
    fn trace(
        &self,
        samples: u32,
        most_pixels: usize,
        brought: Option<(LightPaths, Arc<[u32]>)>,
        round: u32,
        progress: &mut dyn FnMut(&Progress) -> bool,
    ) -> Result<(Image, Vec<Block>)> {
        let table = SensorTable::new(self.sensors, most_pixels);
        let side = table.side();
        let block = |(number, sensor): (usize, &Sensor)| Block { corner: table.block(number), side, looks: sensor.looks };
        let blocks: Vec<Block> = self.sensors.iter().enumerate().map(block).collect();
        let settings = Settings {
            resolution: table.resolution(),
            samples: samples.div_ceil((side * side) as u32).max(1),
            seed: seed_of_round(self.settings.seed, round),
            ..self.settings.clone()
        };
        let mut render = Render::sense(self.scene.clone(), table, &settings, self.execution, brought, round)?;
        while !render.is_finished() {
            // Which tile it was does not matter; waiting for one keeps the loop quiet.
            let _ = render.next_tile(TELL_EVERY);
            if !progress(&render.progress()) {
                render.cancel();
            }
        }
        render.finish()?;
        Ok((render.film().develop(), blocks))
    }
}

/// A sensor's pixels.
struct Block {
    /// First column and row.
    corner: [usize; 2],
    side: usize,
    /// Luminance is looked at instead of illuminance.
    looks: bool,
}

impl Block {
    /// Means of its parts.
    fn parts<'a>(&self, image: &'a Image) -> impl Iterator<Item = f64> + Clone + use<'a> {
        let aov = if self.looks { Aov::Luminance } else { Aov::Illuminance };
        let values = image.layer(aov).map_or(&[][..], |layer| &layer.values);
        let (width, part, [left, top]) = (image.size()[0], self.side / PARTS, self.corner);
        let mean = move |number: usize| {
            let [first_x, first_y] = [left + number % PARTS * part, top + number / PARTS * part];
            let rows = (first_y..first_y + part).filter_map(|row| values.get(row * width + first_x..row * width + first_x + part));
            rows.flatten().map(|value| f64::from(*value)).sum::<f64>() / (part * part) as f64
        };
        (0..PARTS * PARTS).map(mean)
    }
}
