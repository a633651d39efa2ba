//! Light path expressions that part classes of light: an automaton whose state each path carries in its flags.

use crate::words::flag;
use gonio_simd::{Lanes, M, U};

/// Scatterings, in the order of the automaton's steps; those that paths sample and those that light samples show are told apart alike.
pub(crate) mod scattering {
    /// Diffuse reflection.
    pub(crate) const DIFFUSE: u32 = 0;
    /// Reflection off rough facets.
    pub(crate) const GLOSSY: u32 = 1;
    /// Reflection off smooth ones.
    pub(crate) const SHARP: u32 = 2;
    /// From here on: the same, sent through.
    pub(crate) const THROUGH: u32 = 3;
    /// In a medium.
    pub(crate) const VOLUME: u32 = 6;
}

/// Bits of a scattering's number in [`PathExpressions::next`].
const STEP_BITS: u32 = 3;
/// Bits of the number of a kind of light in [`PathExpressions::accepted`].
pub const KIND_BITS: u32 = 6;

/// The expressions that a view's passes show.
#[derive(Clone, Debug, Default)]
pub struct PathExpressions {
    /// By state and scattering (8 entries a state), the state behind it. Paths start in state 0.
    pub next: Vec<u32>,
    /// By state and kind of light (64 entries a state), which expressions ask for the light, as bits.
    pub accepted: Vec<u32>,
    /// Kinds of lights by number.
    pub of_light: Vec<u32>,
    /// Kinds of what instance sets emit.
    pub of_set: Vec<u32>,
    /// The kind of all lights at infinity together; `None` where they are told apart.
    pub infinite: Option<u32>,
    /// Expressions there are.
    pub count: usize,
}

impl PathExpressions {
    /// The state of paths with these flags.
    #[inline(always)]
    pub(crate) fn state<L: Lanes>(flags: U<L>) -> U<L> {
        (flags >> flag::STATE_SHIFT) & flag::STATES
    }

    /// The state behind a scattering.
    #[inline(always)]
    pub(crate) fn after<L: Lanes>(&self, state: U<L>, scattering: U<L>) -> U<L> {
        state.lanes().gather_integers(&self.next, (state << STEP_BITS) | scattering)
    }

    /// The bits of flags that say the state behind a scattering of paths with other flags.
    #[inline(always)]
    pub(crate) fn step<L: Lanes>(&self, flags: U<L>, scattering: U<L>) -> U<L> {
        self.after(Self::state(flags), scattering) << flag::STATE_SHIFT
    }

    /// Which expressions ask for light of some kinds in some states, where chosen.
    #[inline(always)]
    pub(crate) fn accepted<L: Lanes>(&self, state: U<L>, kind: U<L>, chosen: M<L>) -> U<L> {
        let place = ((state << KIND_BITS) | kind).keep_if(chosen);
        state.lanes().gather_integers(&self.accepted, place).keep_if(chosen)
    }
}
