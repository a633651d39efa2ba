//! Weighted sums of runs of eight neighbours: what interpolation in a table of quadruples reads, two neighbours at a time.
//!
//! A lane's run is one load, and it is weighed before lanes are put side by side: one transposition serves all terms of a sum.

#[cfg(target_arch = "x86_64")]
use crate::gather::last_index;
#[cfg(target_arch = "aarch64")]
use crate::neon::sum_octets_neon;
#[cfg(target_arch = "x86_64")]
use core::arch::x86_64::*;
use fearless_simd::{Level, Simd, prelude::*};
#[cfg(target_arch = "aarch64")]
use fearless_simd::{f32x4, u32x4};
#[cfg(target_arch = "x86_64")]
use fearless_simd::{f32x8, f32x16, kernel, u32x8, u32x16, x86::*};

/// Terms of a sum at most.
pub(crate) const MOST_TERMS: usize = 8;

/// Sums of runs, implemented once for every level.
pub(crate) trait Octets: Simd {
    /// The sum over terms of `weight · table[i + offset..][..8]`, with `i = min(index, len - 8 - largest offset)`, of [`MOST_TERMS`] at most.
    fn sum_octets(self, table: &[f32], index: Self::u32s, offsets: &[u32], weights: &[Self::f32s]) -> [Self::f32s; 8];
}

/// Values behind the first one that a sum reads.
#[inline(always)]
pub(crate) fn reach(offsets: &[u32]) -> usize {
    offsets.iter().fold(0, |most, offset| most.max(*offset)) as usize + 8
}

#[cfg(target_arch = "x86_64")]
kernel!(
    #[inline(always)]
    fn sum_octets_avx512(
        simd: Avx512,
        table: &[f32],
        index: u32x16<Avx512>,
        offsets: &[u32],
        weights: &[f32x16<Avx512>],
    ) -> [f32x16<Avx512>; 8] {
        let i: u32x16<Avx512> = _mm512_min_epu32(index.into(), _mm512_set1_epi32(last_index(table, reach(offsets)))).simd_into(simd);
        let first_half = _mm512_setr_epi32(0, 0, 0, 0, 0, 0, 0, 0, 4, 4, 4, 4, 4, 4, 4, 4);
        let mut sums = [_mm512_setzero_ps(); 8];
        // Two lanes a register, four apart: 0 and 4, 8 and 12, 1 and 5, …
        for (place, sum) in sums.iter_mut().enumerate() {
            let lane = place / 2 + place % 2 * 8;
            let of_lanes = _mm512_add_epi32(first_half, _mm512_set1_epi32(lane as i32));
            for (offset, weight) in offsets.iter().zip(weights) {
                // SAFETY: every index was clamped so that the runs of all offsets lie in the table.
                let run = |lane: usize| -> __m256 { unsafe { _mm256_loadu_ps(table.as_ptr().add(i[lane] as usize + *offset as usize)) } };
                let runs = _mm512_insertf32x8::<1>(_mm512_castps256_ps512(run(lane)), run(lane + 4));
                *sum = _mm512_fmadd_ps(runs, _mm512_permutexvar_ps(of_lanes, (*weight).into()), *sum);
            }
        }
        let mut columns = [f32x16::splat(simd, 0.0); 8];
        for half in 0..2 {
            // The same half of four lanes' runs, four apart, so that transposing within blocks puts all in order.
            let four = |lane: usize| -> __m512 {
                if half == 0 {
                    _mm512_shuffle_f32x4::<0b10_00_10_00>(sums[2 * lane], sums[2 * lane + 1])
                } else {
                    _mm512_shuffle_f32x4::<0b11_01_11_01>(sums[2 * lane], sums[2 * lane + 1])
                }
            };
            let (a, b, c, d) = (four(0), four(1), four(2), four(3));
            let (low, high) = (_mm512_unpacklo_ps(a, b), _mm512_unpackhi_ps(a, b));
            let (low_too, high_too) = (_mm512_unpacklo_ps(c, d), _mm512_unpackhi_ps(c, d));
            columns[4 * half] = _mm512_shuffle_ps::<0b01_00_01_00>(low, low_too).simd_into(simd);
            columns[4 * half + 1] = _mm512_shuffle_ps::<0b11_10_11_10>(low, low_too).simd_into(simd);
            columns[4 * half + 2] = _mm512_shuffle_ps::<0b01_00_01_00>(high, high_too).simd_into(simd);
            columns[4 * half + 3] = _mm512_shuffle_ps::<0b11_10_11_10>(high, high_too).simd_into(simd);
        }
        columns
    }
);
#[cfg(target_arch = "x86_64")]
kernel!(
    #[inline(always)]
    fn sum_octets_avx2(simd: Avx2, table: &[f32], index: u32x8<Avx2>, offsets: &[u32], weights: &[f32x8<Avx2>]) -> [f32x8<Avx2>; 8] {
        let i: u32x8<Avx2> = _mm256_min_epu32(index.into(), _mm256_set1_epi32(last_index(table, reach(offsets)))).simd_into(simd);
        let mut sums = [_mm256_setzero_ps(); 8];
        for (lane, sum) in sums.iter_mut().enumerate() {
            let of_lane = _mm256_set1_epi32(lane as i32);
            for (offset, weight) in offsets.iter().zip(weights) {
                // SAFETY: every index was clamped so that the runs of all offsets lie in the table.
                let run = unsafe { _mm256_loadu_ps(table.as_ptr().add(i[lane] as usize + *offset as usize)) };
                *sum = _mm256_fmadd_ps(run, _mm256_permutevar8x32_ps((*weight).into(), of_lane), *sum);
            }
        }
        let mut columns = [f32x8::splat(simd, 0.0); 8];
        for half in 0..2 {
            let two = |lane: usize| -> __m256 {
                if half == 0 {
                    _mm256_permute2f128_ps::<0x20>(sums[lane], sums[lane + 4])
                } else {
                    _mm256_permute2f128_ps::<0x31>(sums[lane], sums[lane + 4])
                }
            };
            let (a, b, c, d) = (two(0), two(1), two(2), two(3));
            let (low, high) = (_mm256_unpacklo_ps(a, b), _mm256_unpackhi_ps(a, b));
            let (low_too, high_too) = (_mm256_unpacklo_ps(c, d), _mm256_unpackhi_ps(c, d));
            columns[4 * half] = _mm256_shuffle_ps::<0b01_00_01_00>(low, low_too).simd_into(simd);
            columns[4 * half + 1] = _mm256_shuffle_ps::<0b11_10_11_10>(low, low_too).simd_into(simd);
            columns[4 * half + 2] = _mm256_shuffle_ps::<0b01_00_01_00>(high, high_too).simd_into(simd);
            columns[4 * half + 3] = _mm256_shuffle_ps::<0b11_10_11_10>(high, high_too).simd_into(simd);
        }
        columns
    }
);

/// The sum of one lane.
#[inline(always)]
pub(crate) fn sum_of_lane(table: &[f32], index: u32, offsets: &[u32], weight: impl Fn(usize) -> f32) -> [f32; 8] {
    let first = (index as usize).min(table.len() - reach(offsets));
    let mut sum = [0.0; 8];
    for (term, offset) in offsets.iter().enumerate() {
        let (weight, run) = (weight(term), &table[first + *offset as usize..][..8]);
        for (sum, value) in sum.iter_mut().zip(run) {
            *sum += weight * value;
        }
    }
    sum
}

impl<S: Simd> Octets for S {
    #[inline(always)]
    fn sum_octets(self, table: &[f32], index: S::u32s, offsets: &[u32], weights: &[S::f32s]) -> [S::f32s; 8] {
        let mut columns = [S::f32s::splat(self, 0.0); 8];
        match self.level() {
            #[cfg(target_arch = "x86_64")]
            Level::Avx512(t) => {
                let mut own = [f32x16::splat(t, 0.0); MOST_TERMS];
                for (own, weight) in own.iter_mut().zip(weights) {
                    *own = f32x16::from_slice(t, weight.as_slice());
                }
                let sums = sum_octets_avx512(t, table, u32x16::from_slice(t, index.as_slice()), offsets, &own);
                for (column, sum) in columns.iter_mut().zip(sums) {
                    *column = S::f32s::from_slice(self, sum.as_slice());
                }
            }
            #[cfg(target_arch = "x86_64")]
            Level::Avx2(t) => {
                let mut own = [f32x8::splat(t, 0.0); MOST_TERMS];
                for (own, weight) in own.iter_mut().zip(weights) {
                    *own = f32x8::from_slice(t, weight.as_slice());
                }
                let sums = sum_octets_avx2(t, table, u32x8::from_slice(t, index.as_slice()), offsets, &own);
                for (column, sum) in columns.iter_mut().zip(sums) {
                    *column = S::f32s::from_slice(self, sum.as_slice());
                }
            }
            #[cfg(target_arch = "aarch64")]
            Level::Neon(t) => {
                let mut own = [f32x4::splat(t, 0.0); MOST_TERMS];
                for (own, weight) in own.iter_mut().zip(weights) {
                    *own = f32x4::from_slice(t, weight.as_slice());
                }
                let sums = sum_octets_neon(t, table, u32x4::from_slice(t, index.as_slice()), offsets, &own);
                for (column, sum) in columns.iter_mut().zip(sums) {
                    *column = S::f32s::from_slice(self, sum.as_slice());
                }
            }
            _ => {
                for lane in 0..S::f32s::LEN {
                    let sum = sum_of_lane(
                        table,
                        index[lane],
                        offsets,
                        #[inline(always)]
                        |term| weights[term][lane],
                    );
                    for (column, value) in columns.iter_mut().zip(sum) {
                        column[lane] = value;
                    }
                }
            }
        }
        columns
    }
}
