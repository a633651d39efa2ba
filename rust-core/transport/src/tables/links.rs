//! Light linking and shadow linking of instances: which lights light them, and whose shadows they cast.

use gonio_accel::Blockers;
use gonio_simd::{Lanes, U};

/// Links of instances and lights; tables are empty where nothing of their kind is linked.
#[derive(Clone, Debug, Default)]
pub struct Links {
    /// By instance, its class as a receiver of light, see [`gonio_light::LightLinks`].
    pub receivers: Vec<u32>,
    /// By instance, the set of lights that what it emits belongs to.
    pub emitters: Vec<u32>,
    /// By light, the row of `blockers` that says what blocks it; 0 for all that casts shadows.
    pub shadows: Vec<u32>,
    /// Which instances block the lights of a row.
    pub blockers: Blockers,
    /// The row for which [`crate::words::ray_mask::LINKED_SHADOW`] tells what blocks; 0 if there is none.
    pub by_mask: u32,
}

impl Links {
    /// Classes of the instances as receivers of light.
    #[inline(always)]
    pub(crate) fn receiver<L: Lanes>(&self, l: L, instance: U<L>) -> U<L> {
        if self.receivers.is_empty() { l.u(0) } else { l.gather_integers(&self.receivers, instance) }
    }
}
