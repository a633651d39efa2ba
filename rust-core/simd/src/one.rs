//! One lane: the scalar level, compiled from the same source and at the same optimisation level as the wide ones.

use crate::{Lanes, octets::sum_of_lane};

/// A single value at a time.
#[derive(Clone, Copy, Debug, Default)]
pub struct One;

impl Lanes for One {
    const COUNT: usize = 1;
    type F32 = f32;
    type U32 = u32;
    type Mask = bool;

    #[inline(always)]
    fn vectorize<R>(self, f: impl FnOnce() -> R) -> R {
        f()
    }
    #[inline(always)]
    fn token(_: f32) -> Self {
        One
    }
    #[inline(always)]
    fn token_u(_: u32) -> Self {
        One
    }
    #[inline(always)]
    fn token_m(_: bool) -> Self {
        One
    }
    #[inline(always)]
    fn splat_f(self, x: f32) -> f32 {
        x
    }
    #[inline(always)]
    fn splat_u(self, x: u32) -> u32 {
        x
    }
    #[inline(always)]
    fn splat_m(self, x: bool) -> bool {
        x
    }
    #[inline(always)]
    fn load_f(self, values: &[f32]) -> f32 {
        values[0]
    }
    #[inline(always)]
    fn load_u(self, values: &[u32]) -> u32 {
        values[0]
    }
    #[inline(always)]
    fn store_f(x: f32, values: &mut [f32]) {
        values[0] = x;
    }
    #[inline(always)]
    fn store_u(x: u32, values: &mut [u32]) {
        values[0] = x;
    }
    #[inline(always)]
    fn compress_f(x: f32, _: bool) -> f32 {
        x
    }
    #[inline(always)]
    fn compress_u(x: u32, _: bool) -> u32 {
        x
    }
    #[inline(always)]
    fn add_f(a: f32, b: f32) -> f32 {
        a + b
    }
    #[inline(always)]
    fn sub_f(a: f32, b: f32) -> f32 {
        a - b
    }
    #[inline(always)]
    fn mul_f(a: f32, b: f32) -> f32 {
        a * b
    }
    #[inline(always)]
    fn div_f(a: f32, b: f32) -> f32 {
        a / b
    }
    #[inline(always)]
    fn neg_f(a: f32) -> f32 {
        -a
    }
    #[inline(always)]
    fn mul_add_f(a: f32, b: f32, c: f32) -> f32 {
        // Unfused: `f32::mul_add` is a library call where the baseline has no such instruction.
        a * b + c
    }
    #[inline(always)]
    fn sqrt_f(a: f32) -> f32 {
        a.sqrt()
    }
    #[inline(always)]
    fn abs_f(a: f32) -> f32 {
        a.abs()
    }
    #[inline(always)]
    fn min_f(a: f32, b: f32) -> f32 {
        if a < b { a } else { b }
    }
    #[inline(always)]
    fn max_f(a: f32, b: f32) -> f32 {
        if a > b { a } else { b }
    }
    #[inline(always)]
    fn floor_f(a: f32) -> f32 {
        a.floor()
    }
    #[inline(always)]
    fn round_f(a: f32) -> f32 {
        a.round_ties_even()
    }
    #[inline(always)]
    fn copysign_f(a: f32, b: f32) -> f32 {
        a.copysign(b)
    }
    #[inline(always)]
    fn lt_f(a: f32, b: f32) -> bool {
        a < b
    }
    #[inline(always)]
    fn le_f(a: f32, b: f32) -> bool {
        a <= b
    }
    #[inline(always)]
    fn eq_f(a: f32, b: f32) -> bool {
        a == b
    }
    #[inline(always)]
    fn bits_f(a: f32) -> u32 {
        a.to_bits()
    }
    #[inline(always)]
    fn from_bits_f(a: u32) -> f32 {
        f32::from_bits(a)
    }
    #[inline(always)]
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the bits are wanted")]
    fn to_i32(a: f32) -> u32 {
        a as i32 as u32
    }
    #[inline(always)]
    #[allow(clippy::cast_possible_wrap, clippy::cast_precision_loss, reason = "the bits of an i32 are given")]
    fn i32_to_f(a: u32) -> f32 {
        a as i32 as f32
    }
    #[inline(always)]
    #[allow(clippy::cast_precision_loss, reason = "rounding is what a conversion to f32 means")]
    fn u32_to_f(a: u32) -> f32 {
        a as f32
    }
    #[inline(always)]
    fn add_u(a: u32, b: u32) -> u32 {
        a.wrapping_add(b)
    }
    #[inline(always)]
    fn sub_u(a: u32, b: u32) -> u32 {
        a.wrapping_sub(b)
    }
    #[inline(always)]
    fn mul_u(a: u32, b: u32) -> u32 {
        a.wrapping_mul(b)
    }
    #[inline(always)]
    fn and_u(a: u32, b: u32) -> u32 {
        a & b
    }
    #[inline(always)]
    fn or_u(a: u32, b: u32) -> u32 {
        a | b
    }
    #[inline(always)]
    fn xor_u(a: u32, b: u32) -> u32 {
        a ^ b
    }
    #[inline(always)]
    fn shl_u(a: u32, by: u32) -> u32 {
        a << by
    }
    #[inline(always)]
    fn shr_u(a: u32, by: u32) -> u32 {
        a >> by
    }
    #[inline(always)]
    #[allow(clippy::cast_possible_wrap, clippy::cast_sign_loss, reason = "the bits of an i32 are given")]
    fn sar_u(a: u32, by: u32) -> u32 {
        ((a as i32) >> by) as u32
    }
    #[inline(always)]
    fn min_u(a: u32, b: u32) -> u32 {
        a.min(b)
    }
    #[inline(always)]
    fn max_u(a: u32, b: u32) -> u32 {
        a.max(b)
    }
    #[inline(always)]
    fn lt_u(a: u32, b: u32) -> bool {
        a < b
    }
    #[inline(always)]
    fn eq_u(a: u32, b: u32) -> bool {
        a == b
    }
    #[inline(always)]
    fn and_m(a: bool, b: bool) -> bool {
        a & b
    }
    #[inline(always)]
    fn or_m(a: bool, b: bool) -> bool {
        a | b
    }
    #[inline(always)]
    fn not_m(a: bool) -> bool {
        !a
    }
    #[inline(always)]
    fn bits_m(a: bool) -> u64 {
        u64::from(a)
    }
    #[inline(always)]
    fn ones_m(a: bool) -> u32 {
        u32::from(a).wrapping_neg()
    }
    #[inline(always)]
    fn mask_from_bits(self, bits: u64) -> bool {
        bits & 1 != 0
    }
    #[inline(always)]
    fn select_f(m: bool, if_true: f32, if_false: f32) -> f32 {
        if m { if_true } else { if_false }
    }
    #[inline(always)]
    fn select_u(m: bool, if_true: u32, if_false: u32) -> u32 {
        if m { if_true } else { if_false }
    }
    #[inline(always)]
    fn gather_f(self, table: &[f32], index: u32) -> f32 {
        table[(index as usize).min(table.len() - 1)]
    }
    #[inline(always)]
    fn gather_u(self, table: &[u32], index: u32) -> u32 {
        table[(index as usize).min(table.len() - 1)]
    }
    #[inline(always)]
    fn gather_pairs_f(self, table: &[f32], index: u32) -> [f32; 2] {
        let i = (index as usize).min(table.len() - 2);
        [table[i], table[i + 1]]
    }
    #[inline(always)]
    fn gather_quads_f(self, table: &[f32], index: u32) -> [f32; 4] {
        let i = (index as usize).min(table.len() - 4);
        [table[i], table[i + 1], table[i + 2], table[i + 3]]
    }
    #[inline(always)]
    fn load_quads_f(self, values: &[f32], at: usize) -> [f32; 4] {
        [values[4 * at], values[4 * at + 1], values[4 * at + 2], values[4 * at + 3]]
    }
    #[inline(always)]
    fn store_quads_f(items: [f32; 4], values: &mut [f32]) {
        values.copy_from_slice(&items);
    }
    #[inline(always)]
    fn sum_octets_f(self, table: &[f32], index: u32, offsets: &[u32], weights: &[f32]) -> [f32; 8] {
        sum_of_lane(
            table,
            index,
            offsets,
            #[inline(always)]
            |term| weights[term],
        )
    }
    #[inline(always)]
    fn lookup32_f(self, table: &[f32; 32], index: u32) -> f32 {
        table[index as usize % 32]
    }
}
