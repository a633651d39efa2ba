//! Whole renders of media: haze with spots, thin smoke about a lamp, a dense cloud.

use super::render::case;
use crate::{Options, kernel::Case, scenes};
use gonio::error::Result;
use std::sync::atomic::AtomicBool;

pub(super) fn cases(options: &Options, cancel: &AtomicBool) -> Result<Vec<Case>> {
    let scenes = [("haze", scenes::haze()), ("smoke", scenes::smoke()), ("cloud", scenes::cloud())];
    scenes.iter().map(|(name, scene)| case(name, scene, options, cancel)).collect()
}
