//! The paper's three scenes by its renderer: trees of rays, its depths and its antialiasing.

use super::render::{Whole, coloured};
use crate::{
    Options,
    kernel::{Case, Kernel, Outcome},
    scenes::{self, compiled},
};
use gonio::error::Result;
use gonio::output::{Look, display, write_picture};
use gonio::render::Render;
use gonio::scene::{Antialiasing, Filter, Integrator, Scene, Settings};
use gonio_simd::Execution;
use std::{
    path::{Path, PathBuf},
    sync::atomic::AtomicBool,
};

/// Pixels of the paper's pictures.
const PICTURE: [u32; 2] = [1024, 768];
/// Pixels of a frame to move about in, and the worker threads that it has.
pub(crate) const FRAME: [u32; 2] = [512, 384];
pub(crate) const FRAME_THREADS: u32 = 2;
/// Pixels of the pictures to be looked at: the scenes' cameras see a square, which the others stretch.
const SQUARE: [u32; 2] = [384; 2];

/// Names, scenes and depths of the trees of rays.
fn known() -> [(&'static str, Scene, u32); 3] {
    [("car", scenes::car(), 3), ("glass", scenes::glass(), 2), ("room", scenes::room(), 2)]
}

fn settings(depth: u32, resolution: [u32; 2], threads: u32, antialiasing: Antialiasing) -> Settings {
    let base = Settings { resolution, threads, max_bounces: depth, ..coloured(Settings::default()) };
    let mut settings = Settings { integrator: Integrator::Whitted, light_samples: 1, filter: Filter::Box, filter_width: 1.0, ..base };
    settings.set_antialiasing(antialiasing);
    settings
}

/// Pictures of the paper's size.
pub(super) fn pictures(options: &Options, cancel: &AtomicBool) -> Result<Vec<Case>> {
    let case = |(name, scene, depth): (&str, Scene, u32)| {
        let settings = settings(depth, PICTURE, options.workers(), Antialiasing::Paper);
        Ok(Case::new(name, "picture", 1, Whole::new(name, compiled(&scene, cancel)?, settings)))
    };
    known().into_iter().map(case).collect()
}

/// A picture up to the bytes that a display takes.
struct Frame {
    whole: Whole,
    bytes: Vec<u8>,
}

/// Frames with one ray a pixel and with antialiasing.
pub(super) fn frames(cancel: &AtomicBool) -> Result<Vec<Case>> {
    let mut cases = Vec::new();
    for (name, scene, depth) in known() {
        let scene = compiled(&scene, cancel)?;
        for (words, antialiasing) in [("a ray a pixel", Antialiasing::Grid(1)), ("antialiased", Antialiasing::Paper)] {
            let name = format!("{name}, {words}");
            let whole = Whole::new(&name, scene.clone(), settings(depth, FRAME, FRAME_THREADS, antialiasing));
            cases.push(Case::new(name, "frame", 1, Frame { whole, bytes: Vec::new() }));
        }
    }
    Ok(cases)
}

impl Kernel for Frame {
    fn run(&mut self, execution: Execution) -> Result<()> {
        self.whole.run(execution)?;
        if let Some(image) = self.whole.image() {
            self.bytes = display(&image, &Look::default(), execution);
        }
        Ok(())
    }

    fn outcome(&self) -> Outcome {
        self.whole.outcome()
    }
}

/// Writes the three scenes into a folder as PNG files, antialiased; their paths.
pub(crate) fn write(folder: &Path, threads: u32, cancel: &AtomicBool) -> Result<Vec<PathBuf>> {
    let execution = Execution::detect();
    let one = |(name, scene, depth): (&str, Scene, u32)| {
        let mut render = Render::start(compiled(&scene, cancel)?, &settings(depth, SQUARE, threads, Antialiasing::Paper), execution)?;
        render.finish()?;
        let path = folder.join(format!("paper-{name}.png"));
        write_picture(&path, &render.film().develop(), &Look::default(), execution)?;
        Ok(path)
    };
    known().into_iter().map(one).collect()
}
