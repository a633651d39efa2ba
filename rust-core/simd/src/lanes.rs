//! The primitive operations that a set of lanes offers; [`F`], [`U`] and [`M`] dress them with operators.

use crate::{F, M, U, octets::MOST_TERMS};
use core::fmt::Debug;

/// A set of lanes: `COUNT` values worked on at once.
///
/// The associated types are the machine's registers; kernels use [`F`], [`U`] and [`M`] instead.
pub trait Lanes: Copy + Debug + Send + Sync + 'static {
    /// Values in a register.
    const COUNT: usize;
    /// A register of `f32`.
    type F32: Copy + Debug;
    /// A register of `u32`.
    type U32: Copy + Debug;
    /// A register of truth values.
    type Mask: Copy;

    /// Runs `f` with the level's instructions enabled, whether or not the caller was inlined.
    fn vectorize<R>(self, f: impl FnOnce() -> R) -> R;

    /// The token of a register.
    fn token(x: Self::F32) -> Self;
    /// The token of a register of integers.
    fn token_u(x: Self::U32) -> Self;
    /// The token of a mask.
    fn token_m(x: Self::Mask) -> Self;

    /// One value in all lanes.
    fn splat_f(self, x: f32) -> Self::F32;
    /// One value in all lanes.
    fn splat_u(self, x: u32) -> Self::U32;
    /// One value in all lanes.
    fn splat_m(self, x: bool) -> Self::Mask;
    /// The first `COUNT` values of a slice.
    fn load_f(self, values: &[f32]) -> Self::F32;
    /// The first `COUNT` values of a slice.
    fn load_u(self, values: &[u32]) -> Self::U32;
    /// Writes the lanes to the first `COUNT` places of a slice.
    fn store_f(x: Self::F32, values: &mut [f32]);
    /// Writes the lanes to the first `COUNT` places of a slice.
    fn store_u(x: Self::U32, values: &mut [u32]);
    /// The chosen lanes moved to the front; what stands behind them is undefined but valid.
    fn compress_f(x: Self::F32, mask: Self::Mask) -> Self::F32;
    /// The chosen lanes moved to the front; what stands behind them is undefined but valid.
    fn compress_u(x: Self::U32, mask: Self::Mask) -> Self::U32;

    /// Sum.
    fn add_f(a: Self::F32, b: Self::F32) -> Self::F32;
    /// Difference.
    fn sub_f(a: Self::F32, b: Self::F32) -> Self::F32;
    /// Product.
    fn mul_f(a: Self::F32, b: Self::F32) -> Self::F32;
    /// Quotient.
    fn div_f(a: Self::F32, b: Self::F32) -> Self::F32;
    /// Negation.
    fn neg_f(a: Self::F32) -> Self::F32;
    /// `a * b + c`, fused where the level has the instruction.
    fn mul_add_f(a: Self::F32, b: Self::F32, c: Self::F32) -> Self::F32;
    /// Square root.
    fn sqrt_f(a: Self::F32) -> Self::F32;
    /// Absolute value.
    fn abs_f(a: Self::F32) -> Self::F32;
    /// Smaller of two; NaN lanes are left to the hardware.
    fn min_f(a: Self::F32, b: Self::F32) -> Self::F32;
    /// Larger of two; NaN lanes are left to the hardware.
    fn max_f(a: Self::F32, b: Self::F32) -> Self::F32;
    /// Largest integer not above.
    fn floor_f(a: Self::F32) -> Self::F32;
    /// Nearest integer, ties to even.
    fn round_f(a: Self::F32) -> Self::F32;
    /// Magnitude of `a`, sign of `b`.
    fn copysign_f(a: Self::F32, b: Self::F32) -> Self::F32;
    /// `a < b`; false for NaN.
    fn lt_f(a: Self::F32, b: Self::F32) -> Self::Mask;
    /// `a <= b`; false for NaN.
    fn le_f(a: Self::F32, b: Self::F32) -> Self::Mask;
    /// `a == b`; false for NaN.
    fn eq_f(a: Self::F32, b: Self::F32) -> Self::Mask;
    /// The bits of the floats.
    fn bits_f(a: Self::F32) -> Self::U32;
    /// Floats from their bits.
    fn from_bits_f(a: Self::U32) -> Self::F32;
    /// Truncates to `i32`, given as its bits; overflow and NaN are left to the hardware.
    fn to_i32(a: Self::F32) -> Self::U32;
    /// Converts `i32` bits to floats.
    fn i32_to_f(a: Self::U32) -> Self::F32;
    /// Converts `u32` to floats.
    fn u32_to_f(a: Self::U32) -> Self::F32;

    /// Wrapping sum.
    fn add_u(a: Self::U32, b: Self::U32) -> Self::U32;
    /// Wrapping difference.
    fn sub_u(a: Self::U32, b: Self::U32) -> Self::U32;
    /// Wrapping product.
    fn mul_u(a: Self::U32, b: Self::U32) -> Self::U32;
    /// Bitwise and.
    fn and_u(a: Self::U32, b: Self::U32) -> Self::U32;
    /// Bitwise or.
    fn or_u(a: Self::U32, b: Self::U32) -> Self::U32;
    /// Bitwise exclusive or.
    fn xor_u(a: Self::U32, b: Self::U32) -> Self::U32;
    /// Shift left by one amount, less than 32.
    fn shl_u(a: Self::U32, by: u32) -> Self::U32;
    /// Logical shift right by one amount, less than 32.
    fn shr_u(a: Self::U32, by: u32) -> Self::U32;
    /// Arithmetic shift right by one amount, less than 32.
    fn sar_u(a: Self::U32, by: u32) -> Self::U32;
    /// Smaller of two.
    fn min_u(a: Self::U32, b: Self::U32) -> Self::U32;
    /// Larger of two.
    fn max_u(a: Self::U32, b: Self::U32) -> Self::U32;
    /// `a < b`.
    fn lt_u(a: Self::U32, b: Self::U32) -> Self::Mask;
    /// `a == b`.
    fn eq_u(a: Self::U32, b: Self::U32) -> Self::Mask;

    /// Lane by lane and.
    fn and_m(a: Self::Mask, b: Self::Mask) -> Self::Mask;
    /// Lane by lane or.
    fn or_m(a: Self::Mask, b: Self::Mask) -> Self::Mask;
    /// Lane by lane not.
    fn not_m(a: Self::Mask) -> Self::Mask;
    /// Bit `i` is lane `i`.
    fn bits_m(a: Self::Mask) -> u64;
    /// All ones where set, zero elsewhere.
    fn ones_m(a: Self::Mask) -> Self::U32;
    /// Lane `i` from bit `i`.
    fn mask_from_bits(self, bits: u64) -> Self::Mask;
    /// `if_true` where the mask is set.
    fn select_f(m: Self::Mask, if_true: Self::F32, if_false: Self::F32) -> Self::F32;
    /// `if_true` where the mask is set.
    fn select_u(m: Self::Mask, if_true: Self::U32, if_false: Self::U32) -> Self::U32;

    /// `table[min(index, len - 1)]` for each lane. The table must not be empty.
    fn gather_f(self, table: &[f32], index: Self::U32) -> Self::F32;
    /// `table[min(index, len - 1)]` for each lane. The table must not be empty.
    fn gather_u(self, table: &[u32], index: Self::U32) -> Self::U32;
    /// `table[i]` and `table[i + 1]` with `i = min(index, len - 2)`: one 64-bit load a lane. The table has two values at least.
    fn gather_pairs_f(self, table: &[f32], index: Self::U32) -> [Self::F32; 2];
    /// `table[i]` to `table[i + 3]` with `i = min(index, len - 4)`: one 128-bit load a lane. The table has four values at least.
    fn gather_quads_f(self, table: &[f32], index: Self::U32) -> [Self::F32; 4];
    /// `values[4 i]` to `values[4 i + 3]` with `i` = `at` + lane; all of them must be there.
    fn load_quads_f(self, values: &[f32], at: usize) -> [Self::F32; 4];
    /// Writes `values[4 i]` to `values[4 i + 3]` with `i` = lane; there must be room for all lanes.
    fn store_quads_f(items: [Self::F32; 4], values: &mut [f32]);
    /// The sum over up to 8 terms of `weight · table[i + offset..][..8]`, with `i = min(index, len - 8 - largest offset)`: one load a lane
    /// and term. The table is long enough for index 0.
    fn sum_octets_f(self, table: &[f32], index: Self::U32, offsets: &[u32], weights: &[Self::F32]) -> [Self::F32; 8];
    /// `table[index % 32]` by register permutes where the machine has them.
    fn lookup32_f(self, table: &[f32; 32], index: Self::U32) -> Self::F32;

    /// One value in all lanes.
    #[inline(always)]
    fn f(self, x: f32) -> F<Self> {
        F(self.splat_f(x))
    }
    /// One integer in all lanes.
    #[inline(always)]
    fn u(self, x: u32) -> U<Self> {
        U(self.splat_u(x))
    }
    /// One truth value in all lanes.
    #[inline(always)]
    fn m(self, x: bool) -> M<Self> {
        M(self.splat_m(x))
    }
    /// Lanes from `values[at..at + COUNT]`.
    #[inline(always)]
    fn load(self, values: &[f32], at: usize) -> F<Self> {
        F(self.load_f(&values[at..at + Self::COUNT]))
    }
    /// Lanes from `values[at..at + COUNT]`.
    #[inline(always)]
    fn load_integers(self, values: &[u32], at: usize) -> U<Self> {
        U(self.load_u(&values[at..at + Self::COUNT]))
    }
    /// Lanes from `values[at..]`; those beyond the end repeat the last value. There is one at least.
    #[inline(always)]
    fn load_to_end(self, values: &[f32], at: usize) -> F<Self> {
        if at + Self::COUNT <= values.len() { self.load(values, at) } else { self.gather(values, self.iota() + at as u32) }
    }
    /// Lanes from `values[at..]`; those beyond the end repeat the last value. There is one at least.
    #[inline(always)]
    fn load_integers_to_end(self, values: &[u32], at: usize) -> U<Self> {
        if at + Self::COUNT <= values.len() {
            self.load_integers(values, at)
        } else {
            self.gather_integers(values, self.iota() + at as u32)
        }
    }
    /// 0, 1, 2 … by lane.
    #[inline(always)]
    fn iota(self) -> U<Self> {
        const COUNTING: [u32; 16] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15];
        U(self.load_u(&COUNTING[..Self::COUNT]))
    }
    /// The first `count` lanes set.
    #[inline(always)]
    fn first(self, count: usize) -> M<Self> {
        M(self.mask_from_bits(if count >= 64 { u64::MAX } else { (1 << count) - 1 }))
    }
    /// `table[min(index, len - 1)]` for each lane.
    #[inline(always)]
    fn gather(self, table: &[f32], index: U<Self>) -> F<Self> {
        F(self.gather_f(table, index.0))
    }
    /// `table[min(index, len - 1)]` for each lane.
    #[inline(always)]
    fn gather_integers(self, table: &[u32], index: U<Self>) -> U<Self> {
        U(self.gather_u(table, index.0))
    }
    /// `table[i]` and `table[i + 1]` with `i = min(index, len - 2)`.
    #[inline(always)]
    fn gather_pairs(self, table: &[f32], index: U<Self>) -> [F<Self>; 2] {
        let [low, high] = self.gather_pairs_f(table, index.0);
        [F(low), F(high)]
    }
    /// `table[i]` to `table[i + 3]` with `i = min(index, len - 4)`.
    #[inline(always)]
    fn gather_quads(self, table: &[f32], index: U<Self>) -> [F<Self>; 4] {
        let [a, b, c, d] = self.gather_quads_f(table, index.0);
        [F(a), F(b), F(c), F(d)]
    }
    /// `table[i]` to `table[i + 3]` with `i = min(index, len - 4)`.
    #[inline(always)]
    fn gather_integer_quads(self, table: &[u32], index: U<Self>) -> [U<Self>; 4] {
        let [a, b, c, d] = self.gather_quads(bytemuck::cast_slice(table), index);
        [a.to_bits(), b.to_bits(), c.to_bits(), d.to_bits()]
    }
    /// Writes items of four values each, one a lane from item `at` on; there must be room for all of them.
    #[inline(always)]
    fn store_quads(self, [a, b, c, d]: [F<Self>; 4], values: &mut [f32], at: usize) {
        Self::store_quads_f([a.0, b.0, c.0, d.0], &mut values[4 * at..4 * (at + Self::COUNT)]);
    }
    /// Appends the chosen lanes' items of four values each behind the first `len` items; `values` must have a register's room.
    #[inline(always)]
    fn append_quads(self, [a, b, c, d]: [F<Self>; 4], mask: M<Self>, values: &mut [f32], len: usize) {
        let items =
            [Self::compress_f(a.0, mask.0), Self::compress_f(b.0, mask.0), Self::compress_f(c.0, mask.0), Self::compress_f(d.0, mask.0)];
        Self::store_quads_f(items, &mut values[4 * len..4 * (len + Self::COUNT)]);
    }
    /// The items of four values each, one item a lane from item `at` on; all of them must be there.
    #[inline(always)]
    fn load_quads(self, values: &[f32], at: usize) -> [F<Self>; 4] {
        let [a, b, c, d] = self.load_quads_f(values, at);
        [F(a), F(b), F(c), F(d)]
    }
    /// The sum over up to 8 terms of `weight · table[i + offset..][..8]`, with `i = min(index, len - 8 - largest offset)`.
    #[inline(always)]
    fn sum_octets(self, table: &[f32], index: U<Self>, offsets: &[u32], weights: &[F<Self>]) -> [F<Self>; 8] {
        let mut registers = [self.splat_f(0.0); MOST_TERMS];
        for (register, weight) in registers.iter_mut().zip(weights) {
            *register = weight.0;
        }
        let [a, b, c, d, e, f, g, h] = self.sum_octets_f(table, index.0, offsets, &registers[..weights.len()]);
        [F(a), F(b), F(c), F(d), F(e), F(f), F(g), F(h)]
    }
    /// `table[index % 32]`.
    #[inline(always)]
    fn lookup32(self, table: &[f32; 32], index: U<Self>) -> F<Self> {
        F(self.lookup32_f(table, index.0))
    }
}
