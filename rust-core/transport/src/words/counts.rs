//! Bounces of a path by kind, a byte each.

use super::event;
use gonio_simd::{Lanes, U};

/// One more of a kind of scattering.
pub(crate) const DIFFUSE: u32 = 1 << (8 * event::DIFFUSE);
pub(crate) const GLOSSY: u32 = 1 << (8 * event::GLOSSY);
pub(crate) const TRANSMISSION: u32 = 1 << (8 * event::TRANSMISSION);
/// One more surface that was passed straight.
pub(crate) const STRAIGHT: u32 = 1 << 24;

/// Scatterings of a kind.
#[inline(always)]
pub(crate) fn of<L: Lanes>(counts: U<L>, kind: u32) -> U<L> {
    (counts >> (kind * 8)) & 255
}

/// Surfaces that were passed straight.
#[inline(always)]
pub(crate) fn straight<L: Lanes>(counts: U<L>) -> U<L> {
    counts >> 24
}

/// Scatterings in media: what is left of all `bounces`.
#[inline(always)]
pub(crate) fn in_media<L: Lanes>(counts: U<L>, bounces: U<L>) -> U<L> {
    let on_surfaces = of(counts, event::DIFFUSE) + of(counts, event::GLOSSY) + of(counts, event::TRANSMISSION);
    bounces - on_surfaces
}
