//! Table reads with one index per lane, which `fearless_simd` lacks: hardware gathers and lookups in a 32-entry register table.
//!
//! Each index is clamped to the table, so the functions are safe for any argument.

#[cfg(target_arch = "aarch64")]
use crate::neon::{gather_neon, gather_pairs_neon, gather_quads_neon, lookup32_neon};
#[cfg(target_arch = "x86_64")]
use core::arch::x86_64::*;
#[cfg(target_arch = "aarch64")]
use fearless_simd::u32x4;
use fearless_simd::{Level, Simd, prelude::*};
#[cfg(target_arch = "x86_64")]
use fearless_simd::{f32x8, f32x16, kernel, u32x8, u32x16, x86::*};

/// Table reads, implemented once for every level.
pub(crate) trait Lookup: Simd {
    /// `table[min(index, len - 1)]`.
    fn gather(self, table: &[f32], index: Self::u32s) -> Self::f32s;
    /// `table[i]` and `table[i + 1]` with `i = min(index, len - 2)`, in one 64-bit load a lane.
    fn gather_pairs(self, table: &[f32], index: Self::u32s) -> [Self::f32s; 2];
    /// `table[i]` to `table[i + 3]` with `i = min(index, len - 4)`, in one 128-bit load a lane and a transposition.
    fn gather_quads(self, table: &[f32], index: Self::u32s) -> [Self::f32s; 4];
    /// `table[index % 32]`.
    fn lookup32(self, table: &[f32; 32], index: Self::u32s) -> Self::f32s;
}

/// The largest index that leaves room for `tail` values, checked to fit the hardware's signed index.
#[inline(always)]
#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
pub(crate) fn last_index(table: &[f32], tail: usize) -> i32 {
    let last = table.len().checked_sub(tail).expect("a table read from is long enough");
    i32::try_from(last).expect("a table has fewer than 2^31 values")
}

#[cfg(target_arch = "x86_64")]
kernel!(
    #[inline(always)]
    fn gather_avx512(simd: Avx512, table: &[f32], index: u32x16<Avx512>) -> f32x16<Avx512> {
        let i = _mm512_min_epu32(index.into(), _mm512_set1_epi32(last_index(table, 1)));
        // SAFETY: every index was clamped to the table.
        unsafe { _mm512_i32gather_ps::<4>(i, table.as_ptr()) }.simd_into(simd)
    }
);
#[cfg(target_arch = "x86_64")]
kernel!(
    #[inline(always)]
    fn gather_avx2(simd: Avx2, table: &[f32], index: u32x8<Avx2>) -> f32x8<Avx2> {
        let i = _mm256_min_epu32(index.into(), _mm256_set1_epi32(last_index(table, 1)));
        // SAFETY: every index was clamped to the table.
        unsafe { _mm256_i32gather_ps::<4>(table.as_ptr(), i) }.simd_into(simd)
    }
);
#[cfg(target_arch = "x86_64")]
kernel!(
    #[inline(always)]
    fn gather_pairs_avx512(simd: Avx512, table: &[f32], index: u32x16<Avx512>) -> [f32x16<Avx512>; 2] {
        let i = _mm512_min_epu32(index.into(), _mm512_set1_epi32(last_index(table, 2)));
        // SAFETY: every index was clamped so that the pair lies in the table.
        let pairs = |i: __m256i| -> __m512 { _mm512_castpd_ps(unsafe { _mm512_i32gather_pd::<4>(i, table.as_ptr().cast()) }) };
        let (low, high) = (pairs(_mm512_castsi512_si256(i)), pairs(_mm512_extracti64x4_epi64::<1>(i)));
        let even = _mm512_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
        let odd = _mm512_add_epi32(even, _mm512_set1_epi32(1));
        [_mm512_permutex2var_ps(low, even, high).simd_into(simd), _mm512_permutex2var_ps(low, odd, high).simd_into(simd)]
    }
);
#[cfg(target_arch = "x86_64")]
kernel!(
    #[inline(always)]
    fn gather_pairs_avx2(simd: Avx2, table: &[f32], index: u32x8<Avx2>) -> [f32x8<Avx2>; 2] {
        let i = _mm256_min_epu32(index.into(), _mm256_set1_epi32(last_index(table, 2)));
        // Lanes 0 1 4 5 and 2 3 6 7, so that the in-block shuffle below puts them in order.
        let i = _mm256_permute4x64_epi64::<0b11_01_10_00>(i);
        // SAFETY: every index was clamped so that the pair lies in the table.
        let pairs = |i: __m128i| -> __m256 { _mm256_castpd_ps(unsafe { _mm256_i32gather_pd::<4>(table.as_ptr().cast(), i) }) };
        let (low, high) = (pairs(_mm256_castsi256_si128(i)), pairs(_mm256_extracti128_si256::<1>(i)));
        [_mm256_shuffle_ps::<0b10_00_10_00>(low, high).simd_into(simd), _mm256_shuffle_ps::<0b11_01_11_01>(low, high).simd_into(simd)]
    }
);
#[cfg(target_arch = "x86_64")]
kernel!(
    #[inline(always)]
    fn gather_quads_avx512(simd: Avx512, table: &[f32], index: u32x16<Avx512>) -> [f32x16<Avx512>; 4] {
        let i: u32x16<Avx512> = _mm512_min_epu32(index.into(), _mm512_set1_epi32(last_index(table, 4))).simd_into(simd);
        // SAFETY: every index was clamped so that the four lie in the table.
        let quad = |lane: usize| -> __m128 { unsafe { _mm_loadu_ps(table.as_ptr().add(i[lane] as usize)) } };
        // Four lanes stand in each register, four apart, so that transposing within blocks puts all in order.
        let four = |lane: usize| -> __m512 {
            let blocks = _mm512_insertf32x4::<1>(_mm512_castps128_ps512(quad(lane)), quad(lane + 4));
            _mm512_insertf32x4::<3>(_mm512_insertf32x4::<2>(blocks, quad(lane + 8)), quad(lane + 12))
        };
        let (a, b, c, d) = (four(0), four(1), four(2), four(3));
        let (low, high) = (_mm512_unpacklo_ps(a, b), _mm512_unpackhi_ps(a, b));
        let (low_too, high_too) = (_mm512_unpacklo_ps(c, d), _mm512_unpackhi_ps(c, d));
        [
            _mm512_shuffle_ps::<0b01_00_01_00>(low, low_too).simd_into(simd),
            _mm512_shuffle_ps::<0b11_10_11_10>(low, low_too).simd_into(simd),
            _mm512_shuffle_ps::<0b01_00_01_00>(high, high_too).simd_into(simd),
            _mm512_shuffle_ps::<0b11_10_11_10>(high, high_too).simd_into(simd),
        ]
    }
);
#[cfg(target_arch = "x86_64")]
kernel!(
    #[inline(always)]
    fn gather_quads_avx2(simd: Avx2, table: &[f32], index: u32x8<Avx2>) -> [f32x8<Avx2>; 4] {
        let i: u32x8<Avx2> = _mm256_min_epu32(index.into(), _mm256_set1_epi32(last_index(table, 4))).simd_into(simd);
        // SAFETY: every index was clamped so that the four lie in the table.
        let quad = |lane: usize| -> __m128 { unsafe { _mm_loadu_ps(table.as_ptr().add(i[lane] as usize)) } };
        let two = |lane: usize| -> __m256 { _mm256_set_m128(quad(lane + 4), quad(lane)) };
        let (a, b, c, d) = (two(0), two(1), two(2), two(3));
        let (low, high) = (_mm256_unpacklo_ps(a, b), _mm256_unpackhi_ps(a, b));
        let (low_too, high_too) = (_mm256_unpacklo_ps(c, d), _mm256_unpackhi_ps(c, d));
        [
            _mm256_shuffle_ps::<0b01_00_01_00>(low, low_too).simd_into(simd),
            _mm256_shuffle_ps::<0b11_10_11_10>(low, low_too).simd_into(simd),
            _mm256_shuffle_ps::<0b01_00_01_00>(high, high_too).simd_into(simd),
            _mm256_shuffle_ps::<0b11_10_11_10>(high, high_too).simd_into(simd),
        ]
    }
);
#[cfg(target_arch = "x86_64")]
kernel!(
    #[inline(always)]
    fn lookup32_avx512(simd: Avx512, table: &[f32; 32], index: u32x16<Avx512>) -> f32x16<Avx512> {
        let low: f32x16<_> = f32x16::from_slice(simd, &table[..16]);
        let high: f32x16<_> = f32x16::from_slice(simd, &table[16..]);
        _mm512_permutex2var_ps(low.into(), index.into(), high.into()).simd_into(simd)
    }
);
#[cfg(target_arch = "x86_64")]
kernel!(
    #[inline(always)]
    fn lookup32_avx2(simd: Avx2, table: &[f32; 32], index: u32x8<Avx2>) -> f32x8<Avx2> {
        let i: __m256i = index.into();
        let part = |k: usize| -> __m256 { _mm256_permutevar8x32_ps(f32x8::from_slice(simd, &table[8 * k..8 * k + 8]).into(), i) };
        let bit3 = _mm256_castsi256_ps(_mm256_slli_epi32::<28>(i));
        let bit4 = _mm256_castsi256_ps(_mm256_slli_epi32::<27>(i));
        let low = _mm256_blendv_ps(part(0), part(1), bit3);
        let high = _mm256_blendv_ps(part(2), part(3), bit3);
        _mm256_blendv_ps(low, high, bit4).simd_into(simd)
    }
);

impl<S: Simd> Lookup for S {
    #[inline(always)]
    fn gather(self, table: &[f32], index: S::u32s) -> S::f32s {
        // `level` is a constant of `S`: one arm remains, and the trips through slices vanish.
        match self.level() {
            #[cfg(target_arch = "x86_64")]
            Level::Avx512(t) => S::f32s::from_slice(self, gather_avx512(t, table, u32x16::from_slice(t, index.as_slice())).as_slice()),
            #[cfg(target_arch = "x86_64")]
            Level::Avx2(t) => S::f32s::from_slice(self, gather_avx2(t, table, u32x8::from_slice(t, index.as_slice())).as_slice()),
            #[cfg(target_arch = "aarch64")]
            Level::Neon(t) => S::f32s::from_slice(self, gather_neon(t, table, u32x4::from_slice(t, index.as_slice())).as_slice()),
            _ => {
                let last = table.len() - 1;
                S::f32s::from_fn(
                    self,
                    #[inline(always)]
                    |lane| table[(index[lane] as usize).min(last)],
                )
            }
        }
    }
    #[inline(always)]
    fn gather_pairs(self, table: &[f32], index: S::u32s) -> [S::f32s; 2] {
        match self.level() {
            #[cfg(target_arch = "x86_64")]
            Level::Avx512(t) => {
                let [a, b] = gather_pairs_avx512(t, table, u32x16::from_slice(t, index.as_slice()));
                [S::f32s::from_slice(self, a.as_slice()), S::f32s::from_slice(self, b.as_slice())]
            }
            #[cfg(target_arch = "x86_64")]
            Level::Avx2(t) => {
                let [a, b] = gather_pairs_avx2(t, table, u32x8::from_slice(t, index.as_slice()));
                [S::f32s::from_slice(self, a.as_slice()), S::f32s::from_slice(self, b.as_slice())]
            }
            #[cfg(target_arch = "aarch64")]
            Level::Neon(t) => {
                let [a, b] = gather_pairs_neon(t, table, u32x4::from_slice(t, index.as_slice()));
                [S::f32s::from_slice(self, a.as_slice()), S::f32s::from_slice(self, b.as_slice())]
            }
            _ => {
                let last = u32::try_from(table.len() - 2).unwrap_or(u32::MAX);
                let index = index.min(last);
                [self.gather(table, index), self.gather(table, index + 1)]
            }
        }
    }
    #[inline(always)]
    fn gather_quads(self, table: &[f32], index: S::u32s) -> [S::f32s; 4] {
        match self.level() {
            #[cfg(target_arch = "x86_64")]
            Level::Avx512(t) => {
                let [a, b, c, d] = gather_quads_avx512(t, table, u32x16::from_slice(t, index.as_slice()));
                let (a, b) = (S::f32s::from_slice(self, a.as_slice()), S::f32s::from_slice(self, b.as_slice()));
                [a, b, S::f32s::from_slice(self, c.as_slice()), S::f32s::from_slice(self, d.as_slice())]
            }
            #[cfg(target_arch = "x86_64")]
            Level::Avx2(t) => {
                let [a, b, c, d] = gather_quads_avx2(t, table, u32x8::from_slice(t, index.as_slice()));
                let (a, b) = (S::f32s::from_slice(self, a.as_slice()), S::f32s::from_slice(self, b.as_slice()));
                [a, b, S::f32s::from_slice(self, c.as_slice()), S::f32s::from_slice(self, d.as_slice())]
            }
            #[cfg(target_arch = "aarch64")]
            Level::Neon(t) => {
                let [a, b, c, d] = gather_quads_neon(t, table, u32x4::from_slice(t, index.as_slice()));
                let (a, b) = (S::f32s::from_slice(self, a.as_slice()), S::f32s::from_slice(self, b.as_slice()));
                [a, b, S::f32s::from_slice(self, c.as_slice()), S::f32s::from_slice(self, d.as_slice())]
            }
            _ => {
                let last = u32::try_from(table.len() - 4).unwrap_or(u32::MAX);
                let index = index.min(last);
                [self.gather(table, index), self.gather(table, index + 1), self.gather(table, index + 2), self.gather(table, index + 3)]
            }
        }
    }
    #[inline(always)]
    fn lookup32(self, table: &[f32; 32], index: S::u32s) -> S::f32s {
        match self.level() {
            #[cfg(target_arch = "x86_64")]
            Level::Avx512(t) => S::f32s::from_slice(self, lookup32_avx512(t, table, u32x16::from_slice(t, index.as_slice())).as_slice()),
            #[cfg(target_arch = "x86_64")]
            Level::Avx2(t) => S::f32s::from_slice(self, lookup32_avx2(t, table, u32x8::from_slice(t, index.as_slice())).as_slice()),
            #[cfg(target_arch = "aarch64")]
            Level::Neon(t) => S::f32s::from_slice(self, lookup32_neon(t, table, u32x4::from_slice(t, index.as_slice())).as_slice()),
            _ => S::f32s::from_fn(
                self,
                #[inline(always)]
                |lane| table[index[lane] as usize % 32],
            ),
        }
    }
}
