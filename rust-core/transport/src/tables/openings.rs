//! Openings by which light comes in: each path carries the group of the first that it goes through on its way out, so that daylight is told apart by them.

use crate::tables::transport::Passes;
use crate::words::flag;
use gonio_simd::{Lanes, M, U};

/// Instances in groups of openings.
#[derive(Clone, Debug, Default)]
pub struct Openings {
    /// By instance its group, 1 to [`Openings::MOST`]; 0 is no opening.
    pub of_instance: Vec<u32>,
}

impl Openings {
    /// Most groups.
    pub const MOST: usize = flag::STATES as usize;

    /// The group of an instance.
    pub(crate) fn group(&self, instance: u32) -> u32 {
        self.of_instance.get(instance as usize).copied().unwrap_or_default()
    }
}

impl Passes {
    /// Whether flags carry a state: of expressions, or the group of an opening.
    #[inline(always)]
    pub(crate) fn states_are_followed(&self) -> bool {
        self.expressions.is_some() || self.openings.is_some()
    }

    /// Flags of paths with these flags behind a surface that `through` of them go through: of its group, if it is their first opening.
    #[inline(always)]
    pub(crate) fn behind<L: Lanes>(&self, flags: U<L>, instance: U<L>, through: M<L>) -> U<L> {
        let Some(openings) = &self.openings else { return flags };
        let first = through & Self::opening(flags).eq(0);
        let group = flags.lanes().gather_integers(&openings.of_instance, instance.keep_if(first));
        flags | (group << flag::STATE_SHIFT).keep_if(first)
    }

    /// The bits of flags that say the group of the first opening, where any is followed.
    #[inline(always)]
    pub(crate) fn opening<L: Lanes>(flags: U<L>) -> U<L> {
        flags & (flag::STATES << flag::STATE_SHIFT)
    }
}
