//! Adding lanes to sums by slot.

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
