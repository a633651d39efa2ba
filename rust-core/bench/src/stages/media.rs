//! Whole renders of media: haze with spots, thin smoke about a lamp, a dense cloud.

use super::render::{SAMPLES, SIDE, Whole, coloured};
use crate::scenes::{self, compiled};
use crate::{Options, kernel::Case};
use gonio::error::Result;
use gonio::scene::Settings;
use std::sync::atomic::AtomicBool;

pub(super) fn cases(options: &Options, cancel: &AtomicBool) -> Result<Vec<Case>> {
    let scenes = [("haze", scenes::haze()), ("smoke", scenes::smoke()), ("cloud", scenes::cloud())];
    let case = |(name, scene): (&str, _)| {
        let settings = &scene_settings(&scene, options);
        Ok(Case::new(
            name,
            "path",
            (SIDE * SIDE * SAMPLES) as usize,
            Whole::new(name, compiled(&scene, cancel)?, coloured(settings.clone())),
        ))
    };
    scenes.into_iter().map(case).collect()
}

fn scene_settings(scene: &gonio::scene::Scene, options: &Options) -> Settings {
    Settings { resolution: [SIDE; 2], samples: SAMPLES, threads: options.workers(), ..scene.settings.clone() }
}
