//! Eight slots put into the order of their distances, without a branch on what they hold.

#[cfg(target_arch = "x86_64")]
use core::arch::x86_64::*;
#[cfg(target_arch = "aarch64")]
use fearless_simd::mask32x4;
use fearless_simd::{Level, Simd, f32x8, mask32x8, prelude::*, u32x8};
#[cfg(target_arch = "x86_64")]
use fearless_simd::{kernel, x86::*};

/// Whether [`Sort8`] takes a few instructions at a level, and not a loop.
pub fn sorts_fast(level: Level) -> bool {
    match level {
        #[cfg(target_arch = "x86_64")]
        Level::Avx2(_) | Level::Avx512(_) => true,
        #[cfg(target_arch = "aarch64")]
        Level::Neon(_) => true,
        _ => false,
    }
}

/// What a walk leaves behind at a node, implemented once for every level.
pub trait Sort8: Simd {
    /// Writes the distances and values of the slots of `mask`, farthest first, and anything behind them. Distances must not be negative; the
    /// last three of their bits become the slot's number.
    fn sort8(self, near: f32x8<Self>, mask: u32, values: u32x8<Self>, distances: &mut [u32; 8], sorted: &mut [u32; 8]);

    /// Writes the values of the slots of a mask, first slot first, and anything behind them.
    fn pack8(self, mask: mask32x8<Self>, values: u32x8<Self>, packed: &mut [u32; 8]);
}

/// Bits that a slot's number takes.
pub(crate) const SLOT: u32 = 7;

#[cfg(target_arch = "x86_64")]
kernel!(
    #[inline(always)]
    fn sort8_avx512(_simd: Avx512, near: f32x8<Avx512>, mask: u32, values: u32x8<Avx512>, distances: &mut [u32; 8], sorted: &mut [u32; 8]) {
        let bits = _mm256_andnot_si256(_mm256_set1_epi32(SLOT as i32), _mm256_castps_si256(near.into()));
        let keys = _mm256_or_si256(bits, _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
        let keys = _mm256_maskz_compress_epi32(mask as u8, keys);
        // More than four are rare, so that the branch is known beforehand.
        let keys =
            if mask.count_ones() <= 4 { _mm256_castsi128_si256(descending4(_mm256_castsi256_si128(keys))) } else { descending8(keys) };
        store(keys, values.into(), distances, sorted);
    }
);
#[cfg(target_arch = "x86_64")]
kernel!(
    #[inline(always)]
    fn sort8_avx2(_simd: Avx2, near: f32x8<Avx2>, mask: u32, values: u32x8<Avx2>, distances: &mut [u32; 8], sorted: &mut [u32; 8]) {
        let slots = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
        let bits = _mm256_andnot_si256(_mm256_set1_epi32(SLOT as i32), _mm256_castps_si256(near.into()));
        let keys = _mm256_and_si256(_mm256_or_si256(bits, slots), lanes_of(mask));
        store(descending8(keys), values.into(), distances, sorted);
    }
);
/// All bits in the lanes of a mask.
#[cfg(target_arch = "x86_64")]
#[inline]
#[target_feature(enable = "avx2")]
fn lanes_of(mask: u32) -> __m256i {
    let bits = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
    _mm256_cmpeq_epi32(_mm256_and_si256(_mm256_set1_epi32(mask as i32), bits), bits)
}

/// Writes keys and the values of the slots that their last bits name. A key of zero, of slot 0 at no distance, stands behind all others, where
/// keys of no meaning, zero as well, name slot 0 too.
#[cfg(target_arch = "x86_64")]
#[inline]
#[target_feature(enable = "avx2")]
fn store(keys: __m256i, values: __m256i, distances: &mut [u32; 8], sorted: &mut [u32; 8]) {
    // SAFETY: both arrays hold eight words.
    unsafe {
        _mm256_storeu_si256(distances.as_mut_ptr().cast(), keys);
        _mm256_storeu_si256(sorted.as_mut_ptr().cast(), _mm256_permutevar8x32_epi32(values, keys));
    }
}

/// Batcher's bitonic sort of four, largest first: each lane and its partner, then the larger here and the smaller there.
#[cfg(target_arch = "x86_64")]
#[inline]
#[target_feature(enable = "avx2")]
fn descending4(x: __m128i) -> __m128i {
    let y = _mm_shuffle_epi32::<0b10_11_00_01>(x);
    let x = _mm_blend_epi32::<0b0110>(_mm_max_epu32(x, y), _mm_min_epu32(x, y));
    let y = _mm_shuffle_epi32::<0b01_00_11_10>(x);
    let x = _mm_blend_epi32::<0b1100>(_mm_max_epu32(x, y), _mm_min_epu32(x, y));
    let y = _mm_shuffle_epi32::<0b10_11_00_01>(x);
    _mm_blend_epi32::<0b1010>(_mm_max_epu32(x, y), _mm_min_epu32(x, y))
}

/// The same of eight.
#[cfg(target_arch = "x86_64")]
#[inline]
#[target_feature(enable = "avx2")]
fn descending8(x: __m256i) -> __m256i {
    let y = _mm256_shuffle_epi32::<0b10_11_00_01>(x);
    let x = _mm256_blend_epi32::<0b0110_0110>(_mm256_max_epu32(x, y), _mm256_min_epu32(x, y));
    let y = _mm256_shuffle_epi32::<0b01_00_11_10>(x);
    let x = _mm256_blend_epi32::<0b0011_1100>(_mm256_max_epu32(x, y), _mm256_min_epu32(x, y));
    let y = _mm256_shuffle_epi32::<0b10_11_00_01>(x);
    let x = _mm256_blend_epi32::<0b0101_1010>(_mm256_max_epu32(x, y), _mm256_min_epu32(x, y));
    let y = _mm256_permute4x64_epi64::<0b01_00_11_10>(x);
    let x = _mm256_blend_epi32::<0b1111_0000>(_mm256_max_epu32(x, y), _mm256_min_epu32(x, y));
    let y = _mm256_shuffle_epi32::<0b01_00_11_10>(x);
    let x = _mm256_blend_epi32::<0b1100_1100>(_mm256_max_epu32(x, y), _mm256_min_epu32(x, y));
    let y = _mm256_shuffle_epi32::<0b10_11_00_01>(x);
    _mm256_blend_epi32::<0b1010_1010>(_mm256_max_epu32(x, y), _mm256_min_epu32(x, y))
}

impl<S: Simd> Sort8 for S {
    #[inline(always)]
    fn sort8(self, near: f32x8<S>, mask: u32, values: u32x8<S>, distances: &mut [u32; 8], sorted: &mut [u32; 8]) {
        match self.level() {
            #[cfg(target_arch = "x86_64")]
            Level::Avx512(t) => {
                sort8_avx512(t, f32x8::from_slice(t, near.as_slice()), mask, u32x8::from_slice(t, values.as_slice()), distances, sorted)
            }
            #[cfg(target_arch = "x86_64")]
            Level::Avx2(t) => {
                sort8_avx2(t, f32x8::from_slice(t, near.as_slice()), mask, u32x8::from_slice(t, values.as_slice()), distances, sorted)
            }
            #[cfg(target_arch = "aarch64")]
            Level::Neon(t) => {
                let (near, values) = (f32x8::from_slice(t, near.as_slice()), u32x8::from_slice(t, values.as_slice()));
                crate::neon::sort8_neon(t, near, mask, values, distances, sorted);
            }
            _ => {
                let mut keys: [u32; 8] = core::array::from_fn(|slot| {
                    let is_in = (mask >> slot) & 1;
                    is_in * ((near[slot].to_bits() & !SLOT) | slot as u32)
                });
                keys.sort_unstable_by(|a, b| b.cmp(a));
                *distances = keys;
                *sorted = keys.map(|key| values[(key & SLOT) as usize]);
            }
        }
    }

    #[inline(always)]
    fn pack8(self, mask: mask32x8<S>, values: u32x8<S>, packed: &mut [u32; 8]) {
        match self.level() {
            // Two registers: the second one's go behind the first one's.
            #[cfg(target_arch = "aarch64")]
            Level::Neon(_) => {
                let ((low, high), bits) = (values.split(), mask.to_bitmask());
                let from = (bits & 15).count_ones() as usize;
                low.compress(mask32x4::from_bitmask(self, bits & 15)).store_slice(&mut packed[..4]);
                high.compress(mask32x4::from_bitmask(self, bits >> 4)).store_slice(&mut packed[from..from + 4]);
            }
            _ => values.compress(mask).store_slice(packed),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fearless_simd::dispatch;

    const VALUES: [u32; 8] = [10, 11, 12, 13, 14, 15, 16, 17];

    #[inline(always)]
    fn sorted<S: Simd>(simd: S, near: &[f32; 8], mask: u32) -> ([u32; 8], [u32; 8]) {
        let (mut distances, mut values) = ([0; 8], [0; 8]);
        simd.sort8(f32x8::from_slice(simd, near), mask, u32x8::from_slice(simd, &VALUES), &mut distances, &mut values);
        (distances, values)
    }

    #[inline(always)]
    fn packed<S: Simd>(simd: S, mask: u32) -> [u32; 8] {
        let mut packed = [0; 8];
        simd.pack8(mask32x8::from_bitmask(simd, mask.into()), u32x8::from_slice(simd, &VALUES), &mut packed);
        packed
    }

    /// Every level that this machine has, and the fallback.
    fn levels() -> Vec<Level> {
        #[cfg(target_arch = "x86_64")]
        let narrower = Level::new().as_avx2().map(Level::Avx2);
        #[cfg(not(target_arch = "x86_64"))]
        let narrower = None;
        [Some(Level::new()), Some(Level::baseline()), narrower].into_iter().flatten().collect()
    }

    #[test]
    fn every_set_of_slots_is_put_in_order_at_every_level() {
        let near = [3.0, 0.0, 7.5, 7.5, 1e-30, f32::INFINITY, 2.0, 0.0];
        for level in levels() {
            for mask in 0..256u32 {
                let (distances, values) = dispatch!(level, simd => sorted(simd, &near, mask));
                let slots: Vec<u32> = (0..8).filter(|slot| mask >> slot & 1 == 1).collect();
                let mut keys: Vec<u32> = slots.iter().map(|&slot| (near[slot as usize].to_bits() & !SLOT) | slot).collect();
                keys.sort_unstable_by(|a, b| b.cmp(a));
                let n = slots.len();
                assert_eq!(distances[..n], keys[..], "{level:?} {mask:b}");
                assert_eq!(values[..n], keys.iter().map(|key| VALUES[(key & SLOT) as usize]).collect::<Vec<_>>()[..], "{level:?} {mask:b}");
                let packed = dispatch!(level, simd => packed(simd, mask));
                assert_eq!(packed[..n], slots.iter().map(|slot| VALUES[*slot as usize]).collect::<Vec<_>>()[..], "{level:?} {mask:b}");
            }
        }
    }
}
