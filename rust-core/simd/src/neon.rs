//! What NEON has no instruction for, or one of its own: reads with an index a lane, sums of runs, and the order of eight slots.

use crate::{gather::last_index, octets::reach, sort::SLOT};
use core::arch::aarch64::*;
use fearless_simd::{aarch64::Neon, f32x4, f32x8, kernel, prelude::*, u32x4, u32x8};

/// Puts the bytes of 32-bit words in order: `index` times this, and the numbers of the bytes in a word.
const WORDS: u32 = 0x0404_0404;
const BYTES: u32 = 0x0302_0100;

/// The indices of the lanes, none above the table's last.
#[inline]
#[target_feature(enable = "neon")]
fn clamped(index: uint32x4_t, last: i32) -> [usize; 4] {
    let index = vminq_u32(index, vdupq_n_u32(last as u32));
    let (a, b) = (vgetq_lane_u32::<0>(index), vgetq_lane_u32::<1>(index));
    [a as usize, b as usize, vgetq_lane_u32::<2>(index) as usize, vgetq_lane_u32::<3>(index) as usize]
}

/// Rows become columns.
#[inline]
#[target_feature(enable = "neon")]
fn transposed(rows: [float32x4_t; 4]) -> [float32x4_t; 4] {
    let (even, odd) = (vtrn1q_f32(rows[0], rows[1]), vtrn2q_f32(rows[0], rows[1]));
    let (even_too, odd_too) = (vtrn1q_f32(rows[2], rows[3]), vtrn2q_f32(rows[2], rows[3]));
    [lows(even, even_too), lows(odd, odd_too), highs(even, even_too), highs(odd, odd_too)]
}

/// The lower halves of two registers.
#[inline]
#[target_feature(enable = "neon")]
fn lows(a: float32x4_t, b: float32x4_t) -> float32x4_t {
    vreinterpretq_f32_f64(vtrn1q_f64(vreinterpretq_f64_f32(a), vreinterpretq_f64_f32(b)))
}

/// The upper halves of two registers.
#[inline]
#[target_feature(enable = "neon")]
fn highs(a: float32x4_t, b: float32x4_t) -> float32x4_t {
    vreinterpretq_f32_f64(vtrn2q_f64(vreinterpretq_f64_f32(a), vreinterpretq_f64_f32(b)))
}

kernel!(
    #[inline(always)]
    pub(crate) fn gather_neon(simd: Neon, table: &[f32], index: u32x4<Neon>) -> f32x4<Neon> {
        let [a, b, c, d] = clamped(index.into(), last_index(table, 1));
        let first = table.as_ptr();
        // SAFETY: every index was clamped to the table.
        let lanes = unsafe { [*first.add(a), *first.add(b), *first.add(c), *first.add(d)] };
        f32x4::from_slice(simd, &lanes)
    }
);
kernel!(
    #[inline(always)]
    pub(crate) fn gather_pairs_neon(simd: Neon, table: &[f32], index: u32x4<Neon>) -> [f32x4<Neon>; 2] {
        let [a, b, c, d] = clamped(index.into(), last_index(table, 2));
        // SAFETY: every index was clamped so that the pair lies in the table.
        let pair = |i: usize| -> float32x2_t { unsafe { vld1_f32(table.as_ptr().add(i)) } };
        let (low, high) = (vcombine_f32(pair(a), pair(b)), vcombine_f32(pair(c), pair(d)));
        [vuzp1q_f32(low, high).simd_into(simd), vuzp2q_f32(low, high).simd_into(simd)]
    }
);
kernel!(
    #[inline(always)]
    pub(crate) fn gather_quads_neon(simd: Neon, table: &[f32], index: u32x4<Neon>) -> [f32x4<Neon>; 4] {
        let [a, b, c, d] = clamped(index.into(), last_index(table, 4));
        // SAFETY: every index was clamped so that the four lie in the table.
        let quad = |i: usize| -> float32x4_t { unsafe { vld1q_f32(table.as_ptr().add(i)) } };
        let [a, b, c, d] = transposed([quad(a), quad(b), quad(c), quad(d)]);
        [a.simd_into(simd), b.simd_into(simd), c.simd_into(simd), d.simd_into(simd)]
    }
);
kernel!(
    #[inline(always)]
    pub(crate) fn lookup32_neon(simd: Neon, table: &[f32; 32], index: u32x4<Neon>) -> f32x4<Neon> {
        let register = |number: usize| -> uint8x16_t {
            let values: f32x4<Neon> = f32x4::from_slice(simd, &table[4 * number..4 * number + 4]);
            vreinterpretq_u8_f32(values.into())
        };
        let low = uint8x16x4_t(register(0), register(1), register(2), register(3));
        let high = uint8x16x4_t(register(4), register(5), register(6), register(7));
        let index = vandq_u32(index.into(), vdupq_n_u32(31));
        let bytes = vreinterpretq_u8_u32(vmlaq_u32(vdupq_n_u32(BYTES), index, vdupq_n_u32(WORDS)));
        // What lies beyond the first sixteen values stays zero, and is put in by the second look-up.
        let found = vqtbx4q_u8(vqtbl4q_u8(low, bytes), high, vsubq_u8(bytes, vdupq_n_u8(64)));
        vreinterpretq_f32_u8(found).simd_into(simd)
    }
);
kernel!(
    #[inline(always)]
    pub(crate) fn sum_octets_neon(
        simd: Neon,
        table: &[f32],
        index: u32x4<Neon>,
        offsets: &[u32],
        weights: &[f32x4<Neon>],
    ) -> [f32x4<Neon>; 8] {
        let first = clamped(index.into(), last_index(table, reach(offsets)));
        let mut sums = [[vdupq_n_f32(0.0); 4]; 2];
        for (offset, weight) in offsets.iter().zip(weights) {
            for lane in 0..4 {
                // SAFETY: every index was clamped so that the runs of all offsets lie in the table.
                let run = |half: usize| unsafe { vld1q_f32(table.as_ptr().add(first[lane] + *offset as usize + half)) };
                sums[0][lane] = vfmaq_n_f32(sums[0][lane], run(0), weight[lane]);
                sums[1][lane] = vfmaq_n_f32(sums[1][lane], run(4), weight[lane]);
            }
        }
        let [[a, b, c, d], [e, f, g, h]] = [transposed(sums[0]), transposed(sums[1])];
        let [a, b, c, d] = [a.simd_into(simd), b.simd_into(simd), c.simd_into(simd), d.simd_into(simd)];
        [a, b, c, d, e.simd_into(simd), f.simd_into(simd), g.simd_into(simd), h.simd_into(simd)]
    }
);
kernel!(
    #[inline(always)]
    pub(crate) fn sort8_neon(
        simd: Neon,
        near: f32x8<Neon>,
        mask: u32,
        values: u32x8<Neon>,
        distances: &mut [u32; 8],
        sorted: &mut [u32; 8],
    ) {
        let (near_low, near_high) = near.split();
        let keys = descending8(keys(near_low.into(), mask, 0), keys(near_high.into(), mask, 4));
        let (low, high) = values.split();
        let values = uint8x16x2_t(vreinterpretq_u8_u32(low.into()), vreinterpretq_u8_u32(high.into()));
        for (half, keys) in keys.into_iter().enumerate() {
            let slots = vandq_u32(keys, vdupq_n_u32(SLOT));
            let bytes = vmlaq_u32(vdupq_n_u32(BYTES), slots, vdupq_n_u32(WORDS));
            let found = vreinterpretq_u32_u8(vqtbl2q_u8(values, vreinterpretq_u8_u32(bytes)));
            let (keys, found): (u32x4<Neon>, u32x4<Neon>) = (keys.simd_into(simd), found.simd_into(simd));
            keys.store_slice(&mut distances[4 * half..4 * half + 4]);
            found.store_slice(&mut sorted[4 * half..4 * half + 4]);
        }
    }
);

/// The keys of four slots from the first one on: distance and slot, zero outside the mask.
#[inline]
#[target_feature(enable = "neon")]
fn keys(near: float32x4_t, mask: u32, first: u32) -> uint32x4_t {
    let slots = four([first, first + 1, first + 2, first + 3]);
    let bits = four([1 << first, 2 << first, 4 << first, 8 << first]);
    let keys = vorrq_u32(vbicq_u32(vreinterpretq_u32_f32(near), vdupq_n_u32(SLOT)), slots);
    vandq_u32(keys, vtstq_u32(vdupq_n_u32(mask), bits))
}

#[inline]
#[target_feature(enable = "neon")]
fn four(words: [u32; 4]) -> uint32x4_t {
    vsetq_lane_u32::<3>(words[3], vsetq_lane_u32::<2>(words[2], vsetq_lane_u32::<1>(words[1], vdupq_n_u32(words[0]))))
}

/// The larger ones first, lane by lane.
#[inline]
#[target_feature(enable = "neon")]
fn exchanged(a: uint32x4_t, b: uint32x4_t) -> [uint32x4_t; 2] {
    [vmaxq_u32(a, b), vminq_u32(a, b)]
}

/// Batcher's odd-even mergesort of eight, largest first. Each layer has its pairs lane by lane in two registers; where it has three pairs or
/// two, the lanes left over compare what is in order already. Comments name the places in either register.
#[inline]
#[target_feature(enable = "neon")]
fn descending8(a: uint32x4_t, b: uint32x4_t) -> [uint32x4_t; 2] {
    // 0 1 4 5, 2 3 6 7
    let [p, q] = exchanged(a, b);
    // 0 1 2 3, 4 5 6 7
    let (wide_p, wide_q) = (vreinterpretq_u64_u32(p), vreinterpretq_u64_u32(q));
    let [p, q] = exchanged(vreinterpretq_u32_u64(vtrn1q_u64(wide_p, wide_q)), vreinterpretq_u32_u64(vtrn2q_u64(wide_p, wide_q)));
    // 0 2 4 6, 1 3 5 7
    let [p, q] = exchanged(vuzp1q_u32(p, q), vuzp2q_u32(p, q));
    // 2 3 0 1, 4 5 6 7
    let first = vzip1q_u32(p, q);
    let [p, q] = exchanged(vextq_u32::<2>(first, first), vzip2q_u32(p, q));
    // 1 2 3 0, 4 5 6 7
    let [p, q] = exchanged(vextq_u32::<3>(p, p), q);
    last_layer(vextq_u32::<3>(p, p), q)
}

/// The last layer, of 0 1 2 3 and 4 5 6 7: the pairs 1 2, 3 4 and 5 6.
#[inline]
#[target_feature(enable = "neon")]
fn last_layer(p: uint32x4_t, q: uint32x4_t) -> [uint32x4_t; 2] {
    // 1 2 3 4, 5 6 7 0
    let (p, q) = (vextq_u32::<1>(p, q), vextq_u32::<1>(q, p));
    // 1 3 5 7, 2 4 6 0; the last lane turns round.
    let [larger, smaller] = exchanged(vuzp1q_u32(p, q), vuzp2q_u32(p, q));
    // 1 2 3 4, 5 6 0 7
    let (low, high) = (vzip1q_u32(larger, smaller), vzip2q_u32(larger, smaller));
    let middle = vcombine_u32(vget_high_u32(low), vget_low_u32(high));
    [vextq_u32::<3>(larger, low), vextq_u32::<1>(middle, vdupq_laneq_u32::<3>(smaller))]
}
