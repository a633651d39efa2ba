//! Whole renders: what all stages come to together, where the time goes, and how full registers are.

use crate::scenes::compiled;
use crate::{
    Breakdown, Options,
    kernel::{Case, Kernel, Outcome},
    report::{LanesAlive, LevelBreakdown, Share},
    scenes,
};
use cpu_time::ProcessTime;
use gonio::colour::luminance_of_pixel;
use gonio::compile::CompiledScene;
use gonio::error::Result;
use gonio::film::Image;
use gonio::render::Render;
use gonio::scene::{Aov, Scene, Settings, load_bundle};
use gonio::transport::{LaneCount, LaneStage, Stage, Statistics};
use gonio_simd::Execution;
use std::{
    sync::{Arc, atomic::AtomicBool},
    time::Instant,
};

/// Pixels a side and samples a pixel: batches are as full and neighbours as alike as in large pictures, what a render begins with is no large part of
/// it, and a slot is over soon.
const SIDE: u32 = 256;
const SAMPLES: u32 = 2;

pub(super) struct Whole {
    name: String,
    scene: Arc<CompiledScene>,
    settings: Settings,
    last: Option<Render>,
    totals: Vec<Total>,
}

/// All runs at a level.
struct Total {
    execution: Execution,
    statistics: Statistics,
    /// Seconds by the clock, and of processor time.
    clock: f64,
    processor: f64,
    runs: f64,
}

pub(super) fn cases(options: &Options, cancel: &AtomicBool) -> Result<Vec<Case>> {
    if let Some(path) = &options.scene {
        return Ok(vec![case(&path.file_stem().unwrap_or_default().to_string_lossy(), &load_bundle(path)?, options, cancel)?]);
    }
    let scenes = [
        ("car", scenes::car()),
        ("glass", scenes::glass()),
        ("room", scenes::room()),
        ("room all in GGX", scenes::glossy_room()),
        ("room all in a table", scenes::measured_room()),
    ];
    scenes.iter().map(|(name, scene)| case(name, scene, options, cancel)).collect()
}

/// The render of a scene.
pub(super) fn case(name: &str, scene: &Scene, options: &Options, cancel: &AtomicBool) -> Result<Case> {
    let base = Settings { resolution: [SIDE; 2], samples: SAMPLES, threads: options.workers(), ..scene.settings.clone() };
    let kernel = Whole::new(name, compiled(scene, cancel)?, coloured(base));
    Ok(Case::new(name, "path", (SIDE * SIDE * SAMPLES) as usize, kernel))
}

/// The whole picture's colour, without a limit of time.
pub(super) fn coloured(settings: Settings) -> Settings {
    Settings { aovs: vec![Aov::Color], time_limit_s: 0.0, crop: None, ..settings }
}

impl Whole {
    pub(super) fn new(name: &str, scene: Arc<CompiledScene>, settings: Settings) -> Self {
        Self { name: name.into(), scene, settings, last: None, totals: Vec::new() }
    }

    /// The last picture.
    pub(super) fn image(&self) -> Option<Image> {
        self.last.as_ref().map(|render| render.film().develop())
    }

    fn pixels(&self) -> f64 {
        self.settings.resolution.map(f64::from).iter().product()
    }
}

impl Kernel for Whole {
    fn run(&mut self, execution: Execution) -> Result<()> {
        let (start, processor) = (Instant::now(), ProcessTime::now());
        let mut render = Render::start(self.scene.clone(), &self.settings, execution)?;
        render.finish()?;
        let (clock, processor) = (start.elapsed().as_secs_f64(), processor.elapsed().as_secs_f64());
        let known = self.totals.iter_mut().find(|total| total.execution.name() == execution.name());
        match known {
            Some(total) => {
                total.statistics.add(&render.statistics());
                (total.clock, total.processor, total.runs) = (total.clock + clock, total.processor + processor, total.runs + 1.0);
            }
            None => self.totals.push(Total { execution, statistics: render.statistics(), clock, processor, runs: 1.0 }),
        }
        self.last = Some(render);
        Ok(())
    }

    fn outcome(&self) -> Outcome {
        let image = self.image();
        let layer = image.as_ref().and_then(|image| image.layer(Aov::Color));
        let pixels = layer.map_or(&[][..], |layer| &layer.values);
        let luminance: Vec<f64> = pixels.chunks_exact(4).map(|p| f64::from(luminance_of_pixel([p[0], p[1], p[2]]))).collect();
        let count = luminance.len().max(1) as f64;
        let mean = luminance.iter().sum::<f64>() / count;
        let variance = luminance.iter().map(|y| (y - mean) * (y - mean)).sum::<f64>() / count;
        // Levels draw the same numbers but part where rounding turns a choice; their pictures are then no more apart than two seeds'.
        // The spread of the pixels is no less than their noise.
        Outcome { value: mean, tolerance: 5.0 * (variance / count).sqrt() / mean.max(f64::MIN_POSITIVE) }
    }

    fn breakdown(&self) -> Option<Breakdown> {
        let statistics = self.scene.statistics;
        let level = |total: &Total| LevelBreakdown {
            level: total.execution.name(),
            mrays: (total.statistics.rays + total.statistics.shadow_rays) as f64 * 1e-6 / total.processor,
            camera_rays: total.statistics.camera_rays as f64 / (total.runs * self.pixels()),
            time: shares(&total.statistics, total.clock * f64::from(self.settings.threads)),
            lanes: lanes(&total.statistics),
        };
        let levels = self.totals.iter().map(level).collect();
        Some(Breakdown { scene: self.name.clone(), triangles: statistics.instanced_triangles, lights: statistics.lights, levels })
    }
}

/// Shares of the stages in all workers' time; the rest is films, threads and workspaces.
fn shares(statistics: &Statistics, seconds: f64) -> Vec<Share> {
    let mut shares =
        Stage::ALL.map(|(stage, name)| Share { stage: name, share: statistics.time_ns[stage as usize] as f64 * 1e-9 / seconds }).to_vec();
    let rest = 1.0 - shares.iter().map(|share| share.share).sum::<f64>();
    shares.push(Share { stage: "rest", share: rest });
    shares
}

/// Bounces that any path reached.
fn lanes(statistics: &Statistics) -> Vec<LanesAlive> {
    let shaded = |counts: &[LaneCount]| counts[LaneStage::Shade as usize].run;
    let first = shaded(&statistics.lanes[0]).max(1) as f64;
    let reached = statistics.lanes.iter().enumerate().take_while(|(_, counts)| shaded(*counts) > 0);
    reached
        .map(|(bounce, counts)| LanesAlive {
            bounce,
            work: shaded(counts) as f64 / first,
            alive: LaneStage::ALL
                .map(|(stage, name)| {
                    let count = counts[stage as usize];
                    Share { stage: name, share: count.alive as f64 / count.run.max(1) as f64 }
                })
                .to_vec(),
        })
        .collect()
}
