//! Path flags (Cycles' path flags): what a path has met so far, as bits of one word.

use gonio_simd::{Lanes, U};

/// No scattering yet, at most ways straight through: the next hit is what the camera sees.
pub(crate) const CAMERA: u32 = 1;
/// The last scattering was specular (a delta lobe), so next event estimation has no share and the MIS weight is 1.
pub(crate) const DELTA: u32 = 2;
/// A surface that is neither mirror nor smooth glass has been met.
pub(crate) const NON_SPECULAR_SEEN: u32 = 4;
/// Above this bit, two bits: what the last scattering was, see [`super::event`].
pub(crate) const LAST_SHIFT: u32 = 3;
/// Above this bit, two bits: what the first scattering was; of use only once there was one.
pub(crate) const FIRST_SHIFT: u32 = 5;
/// Of hits, not of paths: a shadow ray is what passes here.
pub(crate) const SHADOW: u32 = 128;
/// Of paths: they start at a place that another surface lies on.
pub(crate) const COVERED: u32 = 128;
/// The path started at a light.
pub(crate) const FROM_LIGHT: u32 = 256;
/// To the last surface that did not scatter specularly light paths bring light: the camera sees it, or photons are taken up there.
pub(crate) const LEFT_TO_LIGHT_PATHS: u32 = 512;
/// Of vertices, not of paths: light came out here from under the surface.
pub(crate) const WALKED: u32 = 1024;
/// The camera sees the path's first surface directly, which did not scatter specularly: light paths can end there.
pub(crate) const SEEN_DIRECTLY: u32 = 2048;
/// The path has scattered by other than mirrors and smooth glass, or went through a portal.
pub(crate) const ROUGH: u32 = 4096;
/// The camera sees the path's next hit through clear glass alone, before which a transparent background stays transparent.
pub(crate) const CLEAR: u32 = 8192;
/// Light paths bring what comes straight from lights to the surface that the path left last.
pub(crate) const DIRECT_LEFT: u32 = 16384;
/// Above this bit: the state of the automaton of light path expressions, or the group of the first opening; 0 where neither is followed.
pub(crate) const STATE_SHIFT: u32 = 15;
/// Bits of a state.
pub(crate) const STATES: u32 = (1 << (BOUNCE_SHIFT - STATE_SHIFT)) - 1;
/// Above this bit: the number of scatterings.
pub(crate) const BOUNCE_SHIFT: u32 = 23;

/// The bits of the last and the first kind of scattering and of their number, for paths with flags `before` that are scattered once more.
#[inline(always)]
pub(crate) fn scattered<L: Lanes>(before: U<L>, kind: U<L>) -> U<L> {
    let bounces = before >> BOUNCE_SHIFT;
    let first = bounces.eq(0).select(kind << FIRST_SHIFT, before & (3 << FIRST_SHIFT));
    (kind << LAST_SHIFT) | first | ((bounces + 1) << BOUNCE_SHIFT)
}
