//! Limits of measurements, and who watches them.

use crate::{compile::CompiledScene, render::Progress};
use std::sync::atomic::AtomicBool;

/// Bounces of measurements that no limit was asked for: in white rooms the late ones are many lux together, and roulette ends what does not matter.
pub const MOST_BOUNCES: u32 = 255;

/// What stands around a measurement.
pub struct Watch<'a> {
    /// Lends what did not change.
    pub previous: Option<&'a CompiledScene>,
    /// Ends compiling.
    pub cancel: &'a AtomicBool,
    /// Is told how far it is, now and then; false ends it.
    pub progress: &'a mut dyn FnMut(&Progress) -> bool,
}

impl std::fmt::Debug for Watch<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Watch").field("previous", &self.previous.is_some()).field("cancel", self.cancel).finish_non_exhaustive()
    }
}
