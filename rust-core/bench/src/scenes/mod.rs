//! Scenes that the benchmark makes itself, sized as those that ratios are commonly given for.

mod build;
mod car;
mod glass;
mod measured;
mod room;
mod shapes;
mod smoke;
mod strands;

pub(super) use build::{aimed, light, place};
pub(super) use car::{car, sky};
pub(super) use glass::glass;
pub(super) use measured::{glossy_room, measured_room, table};
pub(super) use room::room;
pub(super) use smoke::{cloud, haze, smoke};
pub(super) use strands::strands;

use gonio::{
    compile::{CompiledScene, compile},
    error::Result,
    scene::Scene,
};
use std::sync::{Arc, atomic::AtomicBool};

/// A scene laid out.
pub(super) fn compiled(scene: &Scene, cancel: &AtomicBool) -> Result<Arc<CompiledScene>> {
    compile(scene, None, cancel).map(Arc::new)
}
