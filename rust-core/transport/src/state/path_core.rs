//! What a path carries from vertex to vertex.
//!
//! The record is embedded whole wherever a path waits: in [`crate::state::paths::PathLanes`], vertices, and points that are measured. What is added to it needs
//! a column there, and somebody who decides its value at scattering ([`crate::state::vertex::Vertex`]'s makers).

use crate::media::set::MediaSet;
use gonio_simd::{F, Lanes, Spectrum, U};

/// One register of what paths carry.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PathCore<L: Lanes> {
    pub(crate) throughput: Spectrum<L>,
    /// Where contributions go: the pixel's Morton number, plus `BATCH` for paths that measure illuminance. [`crate::stage::shade::catcher`] adds more.
    pub(crate) slot: U<L>,
    /// What the path has met, bits of [`crate::words::flag`].
    pub(crate) flags: U<L>,
    /// Bounces so far by kind, a byte each: diffuse, glossy, transmitted, straight through.
    pub(crate) counts: U<L>,
    /// Ray cone (pbrt's ray differentials): width here, metres, and growth a metre.
    pub(crate) width: F<L>,
    pub(crate) spread: F<L>,
    /// What the path is in.
    pub(crate) media: MediaSet<L>,
    /// Throughput as it were without guiding, over throughput: roulette goes by that.
    pub(crate) unguided: F<L>,
}

impl<L: Lanes> PathCore<L> {
    /// That of a path which begins, a line, in the open.
    #[inline(always)]
    pub(crate) fn new(l: L, slot: U<L>, flags: U<L>) -> Self {
        Self {
            throughput: Spectrum::one(l),
            slot,
            flags,
            counts: l.u(0),
            width: l.f(0.0),
            spread: l.f(0.0),
            media: MediaSet::open(l),
            unguided: l.f(1.0),
        }
    }
}
