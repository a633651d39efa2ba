//! As many lanes as the machine's registers hold, through `fearless_simd`.

use crate::{Lanes, gather::Lookup, octets::Octets};
use fearless_simd::{Simd, prelude::*};

/// The native width of a `fearless_simd` level.
#[derive(Clone, Copy, Debug)]
pub struct Wide<S>(pub S);

impl<S: Simd> Lanes for Wide<S> {
    const COUNT: usize = S::f32s::LEN;
    type F32 = S::f32s;
    type U32 = S::u32s;
    type Mask = S::mask32s;

    #[inline(always)]
    fn vectorize<R>(self, f: impl FnOnce() -> R) -> R {
        self.0.vectorize(f)
    }
    #[inline(always)]
    fn token(x: S::f32s) -> Self {
        Wide(x.token())
    }
    #[inline(always)]
    fn token_u(x: S::u32s) -> Self {
        Wide(x.token())
    }
    #[inline(always)]
    fn token_m(x: S::mask32s) -> Self {
        Wide(x.token())
    }
    #[inline(always)]
    fn splat_f(self, x: f32) -> S::f32s {
        x.simd_into(self.0)
    }
    #[inline(always)]
    fn splat_u(self, x: u32) -> S::u32s {
        x.simd_into(self.0)
    }
    #[inline(always)]
    fn splat_m(self, x: bool) -> S::mask32s {
        S::mask32s::splat(self.0, x)
    }
    #[inline(always)]
    fn load_f(self, values: &[f32]) -> S::f32s {
        S::f32s::from_slice(self.0, &values[..S::f32s::LEN])
    }
    #[inline(always)]
    fn load_u(self, values: &[u32]) -> S::u32s {
        S::u32s::from_slice(self.0, &values[..S::f32s::LEN])
    }
    #[inline(always)]
    fn store_f(x: S::f32s, values: &mut [f32]) {
        x.store_slice(&mut values[..S::f32s::LEN]);
    }
    #[inline(always)]
    fn store_u(x: S::u32s, values: &mut [u32]) {
        x.store_slice(&mut values[..S::f32s::LEN]);
    }
    #[inline(always)]
    fn compress_f(x: S::f32s, mask: S::mask32s) -> S::f32s {
        x.compress(mask)
    }
    #[inline(always)]
    fn compress_u(x: S::u32s, mask: S::mask32s) -> S::u32s {
        x.compress(mask)
    }
    #[inline(always)]
    fn add_f(a: S::f32s, b: S::f32s) -> S::f32s {
        a + b
    }
    #[inline(always)]
    fn sub_f(a: S::f32s, b: S::f32s) -> S::f32s {
        a - b
    }
    #[inline(always)]
    fn mul_f(a: S::f32s, b: S::f32s) -> S::f32s {
        a * b
    }
    #[inline(always)]
    fn div_f(a: S::f32s, b: S::f32s) -> S::f32s {
        a / b
    }
    #[inline(always)]
    fn neg_f(a: S::f32s) -> S::f32s {
        -a
    }
    #[inline(always)]
    fn mul_add_f(a: S::f32s, b: S::f32s, c: S::f32s) -> S::f32s {
        a.mul_add(b, c)
    }
    #[inline(always)]
    fn sqrt_f(a: S::f32s) -> S::f32s {
        a.sqrt()
    }
    #[inline(always)]
    fn abs_f(a: S::f32s) -> S::f32s {
        a.abs()
    }
    #[inline(always)]
    fn min_f(a: S::f32s, b: S::f32s) -> S::f32s {
        a.min(b)
    }
    #[inline(always)]
    fn max_f(a: S::f32s, b: S::f32s) -> S::f32s {
        a.max(b)
    }
    #[inline(always)]
    fn floor_f(a: S::f32s) -> S::f32s {
        a.floor()
    }
    #[inline(always)]
    fn round_f(a: S::f32s) -> S::f32s {
        a.round_ties_even()
    }
    #[inline(always)]
    fn copysign_f(a: S::f32s, b: S::f32s) -> S::f32s {
        a.copysign(b)
    }
    #[inline(always)]
    fn lt_f(a: S::f32s, b: S::f32s) -> S::mask32s {
        a.simd_lt(b)
    }
    #[inline(always)]
    fn le_f(a: S::f32s, b: S::f32s) -> S::mask32s {
        a.simd_le(b)
    }
    #[inline(always)]
    fn eq_f(a: S::f32s, b: S::f32s) -> S::mask32s {
        a.simd_eq(b)
    }
    #[inline(always)]
    fn bits_f(a: S::f32s) -> S::u32s {
        a.bitcast()
    }
    #[inline(always)]
    fn from_bits_f(a: S::u32s) -> S::f32s {
        a.bitcast()
    }
    #[inline(always)]
    fn to_i32(a: S::f32s) -> S::u32s {
        a.to_int::<S::i32s>().bitcast()
    }
    #[inline(always)]
    fn i32_to_f(a: S::u32s) -> S::f32s {
        a.bitcast::<S::i32s>().to_float()
    }
    #[inline(always)]
    fn u32_to_f(a: S::u32s) -> S::f32s {
        a.to_float()
    }
    #[inline(always)]
    fn add_u(a: S::u32s, b: S::u32s) -> S::u32s {
        a + b
    }
    #[inline(always)]
    fn sub_u(a: S::u32s, b: S::u32s) -> S::u32s {
        a - b
    }
    #[inline(always)]
    fn mul_u(a: S::u32s, b: S::u32s) -> S::u32s {
        a * b
    }
    #[inline(always)]
    fn and_u(a: S::u32s, b: S::u32s) -> S::u32s {
        a & b
    }
    #[inline(always)]
    fn or_u(a: S::u32s, b: S::u32s) -> S::u32s {
        a | b
    }
    #[inline(always)]
    fn xor_u(a: S::u32s, b: S::u32s) -> S::u32s {
        a ^ b
    }
    #[inline(always)]
    fn shl_u(a: S::u32s, by: u32) -> S::u32s {
        a << by
    }
    #[inline(always)]
    fn shr_u(a: S::u32s, by: u32) -> S::u32s {
        a >> by
    }
    #[inline(always)]
    fn sar_u(a: S::u32s, by: u32) -> S::u32s {
        (a.bitcast::<S::i32s>() >> by).bitcast()
    }
    #[inline(always)]
    fn min_u(a: S::u32s, b: S::u32s) -> S::u32s {
        a.min(b)
    }
    #[inline(always)]
    fn max_u(a: S::u32s, b: S::u32s) -> S::u32s {
        a.max(b)
    }
    #[inline(always)]
    fn lt_u(a: S::u32s, b: S::u32s) -> S::mask32s {
        a.simd_lt(b)
    }
    #[inline(always)]
    fn eq_u(a: S::u32s, b: S::u32s) -> S::mask32s {
        a.simd_eq(b)
    }
    #[inline(always)]
    fn and_m(a: S::mask32s, b: S::mask32s) -> S::mask32s {
        a & b
    }
    #[inline(always)]
    fn or_m(a: S::mask32s, b: S::mask32s) -> S::mask32s {
        a | b
    }
    #[inline(always)]
    fn not_m(a: S::mask32s) -> S::mask32s {
        !a
    }
    #[inline(always)]
    fn bits_m(a: S::mask32s) -> u64 {
        a.to_bitmask()
    }
    #[inline(always)]
    fn ones_m(a: S::mask32s) -> S::u32s {
        a.to_vector().bitcast()
    }
    #[inline(always)]
    fn mask_from_bits(self, bits: u64) -> S::mask32s {
        S::mask32s::from_bitmask(self.0, bits)
    }
    #[inline(always)]
    fn select_f(m: S::mask32s, if_true: S::f32s, if_false: S::f32s) -> S::f32s {
        m.select(if_true, if_false)
    }
    #[inline(always)]
    fn select_u(m: S::mask32s, if_true: S::u32s, if_false: S::u32s) -> S::u32s {
        m.select(if_true, if_false)
    }
    #[inline(always)]
    fn gather_f(self, table: &[f32], index: S::u32s) -> S::f32s {
        self.0.gather(table, index)
    }
    #[inline(always)]
    fn gather_u(self, table: &[u32], index: S::u32s) -> S::u32s {
        // The same bits pass through the float registers: one gather kernel serves both.
        self.0.gather(bytemuck::cast_slice(table), index).bitcast()
    }
    #[inline(always)]
    fn gather_pairs_f(self, table: &[f32], index: S::u32s) -> [S::f32s; 2] {
        self.0.gather_pairs(table, index)
    }
    #[inline(always)]
    fn gather_quads_f(self, table: &[f32], index: S::u32s) -> [S::f32s; 4] {
        self.0.gather_quads(table, index)
    }
    #[inline(always)]
    fn load_quads_f(self, values: &[f32], at: usize) -> [S::f32s; 4] {
        let values = &values[4 * at..4 * (at + Self::COUNT)];
        let register = |number: usize| S::f32s::from_slice(self.0, &values[number * Self::COUNT..(number + 1) * Self::COUNT]);
        let ((even, odd), (even_too, odd_too)) = (register(0).deinterleave(register(1)), register(2).deinterleave(register(3)));
        let ((a, c), (b, d)) = (even.deinterleave(even_too), odd.deinterleave(odd_too));
        [a, b, c, d]
    }
    #[inline(always)]
    fn store_quads_f([a, b, c, d]: [S::f32s; 4], values: &mut [f32]) {
        let ((even, even_too), (odd, odd_too)) = (a.interleave(c), b.interleave(d));
        let (first, last) = (even.interleave(odd), even_too.interleave(odd_too));
        for (register, place) in [first.0, first.1, last.0, last.1].into_iter().zip(values.chunks_exact_mut(Self::COUNT)) {
            register.store_slice(place);
        }
    }
    #[inline(always)]
    fn sum_octets_f(self, table: &[f32], index: S::u32s, offsets: &[u32], weights: &[S::f32s]) -> [S::f32s; 8] {
        self.0.sum_octets(table, index, offsets, weights)
    }
    #[inline(always)]
    fn lookup32_f(self, table: &[f32; 32], index: S::u32s) -> S::f32s {
        self.0.lookup32(table, index)
    }
}
