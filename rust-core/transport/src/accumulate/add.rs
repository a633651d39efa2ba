//! Adding lanes to sums by slot, and which light pass (direct, indirect, emission) a contribution belongs to.

use crate::accumulate::light_sums::code;
use crate::accumulate::tile_sums::TileSums;
use crate::state::flag;
use gonio_simd::{Column, F, Lanes, M, Rgb, U};

/// Adds a colour to the sums at each chosen lane's slot. Slots of one register differ, since each belongs to another path.
#[inline(always)]
pub(crate) fn add_rgb<L: Lanes>(sums: &mut [Column; 3], slot: U<L>, value: Rgb<L>, chosen: M<L>) {
    let mut bits = chosen.bits();
    if bits == 0 {
        return;
    }
    let slots = slot.to_array();
    let [r, g, b] = [value.r.to_array(), value.g.to_array(), value.b.to_array()];
    let [red, green, blue] = sums;
    while bits != 0 {
        let lane = bits.trailing_zeros() as usize;
        let at = slots[lane] as usize;
        red[at] += r[lane];
        green[at] += g[lane];
        blue[at] += b[lane];
        bits &= bits - 1;
    }
}

/// Adds light that a path found to the radiance and to its light pass, if any is wanted.
#[inline(always)]
pub(crate) fn add_light<L: Lanes>(sums: &mut TileSums, code: U<L>, slot: U<L>, value: Rgb<L>, chosen: M<L>) {
    add_rgb(&mut sums.radiance, slot, value, chosen);
    if sums.lights.wanted() {
        sums.lights.add(code, slot, value, chosen);
    }
}

/// Adds light of next event estimation. Where light passes are wanted, `shares` is the diffuse and the glossy share of what first surfaces
/// scatter; the rest is transmitted.
#[inline(always)]
pub(crate) fn add_sampled<L: Lanes>(sums: &mut TileSums, code: U<L>, slot: U<L>, value: Rgb<L>, shares: Option<[Rgb<L>; 2]>, chosen: M<L>) {
    add_rgb(&mut sums.radiance, slot, value, chosen);
    let Some([diffuse, glossy]) = shares else { return };
    let at_first = code.eq(code::SHARED);
    sums.lights.add(code, slot, value, chosen.and_not(at_first));
    let (diffuse, glossy) = (value * diffuse, value * glossy);
    let transmitted = (value - diffuse - glossy).max(0.0);
    for (kind, part) in [diffuse, glossy, transmitted].into_iter().enumerate() {
        sums.lights.add(slot.lanes().u(kind as u32), slot, part, chosen & at_first & part.is_lit());
    }
}

/// The light pass of light that a path finds: `seen` if the camera sees it, direct after one scattering, indirect after more.
#[inline(always)]
pub(crate) fn code_of<L: Lanes>(flags: U<L>, seen: u32) -> U<L> {
    let bounces = flags >> flag::BOUNCE_SHIFT;
    let first = (flags >> flag::FIRST_SHIFT) & 3;
    let scattered = bounces.eq(1).select(first, first + code::INDIRECT);
    bounces.eq(0).select(first.lanes().u(seen), scattered)
}

/// The light pass of light from next event estimation.
#[inline(always)]
pub(crate) fn code_of_sampled<L: Lanes>(flags: U<L>) -> U<L> {
    let first = (flags >> flag::FIRST_SHIFT) & 3;
    (flags >> flag::BOUNCE_SHIFT).eq(0).select(first.lanes().u(code::SHARED), first + code::INDIRECT)
}

/// Adds a number to the sums at each chosen lane's slot.
#[inline(always)]
pub(crate) fn add<L: Lanes>(sums: &mut Column, slot: U<L>, value: F<L>, chosen: M<L>) {
    let (slots, values) = (slot.to_array(), value.to_array());
    let mut bits = chosen.bits();
    while bits != 0 {
        let lane = bits.trailing_zeros() as usize;
        sums[slots[lane] as usize] += values[lane];
        bits &= bits - 1;
    }
}
