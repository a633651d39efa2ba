//! The Sobol sequence's first two dimensions with hashed Owen scrambling, on lanes.

use gonio_simd::{F, Lanes, U};

/// Samples of one tile.
#[derive(Clone, Copy, Debug)]
pub struct Sampler {
    seed: u32,
    /// Logarithm of the samples a pixel has room for.
    log2_samples: u32,
}

/// Bits of a pixel's number in its tile of 64×64.
const TILE_BITS: u32 = 12;
/// Most bits of a sample's number.
const MOST_SAMPLE_BITS: u32 = 32 - TILE_BITS;

impl Sampler {
    /// A tile's samples; `samples` is the number a pixel gets in the whole render, at most 2^20.
    pub fn new(seed: u32, tile: [u32; 2], samples: u32) -> Self {
        let log2_samples = samples.max(1).next_power_of_two().trailing_zeros().min(MOST_SAMPLE_BITS);
        Self { seed: hash(hash(seed ^ 0x9e37_79b9) ^ hash(tile[0].wrapping_mul(0x85eb_ca6b) ^ hash(tile[1]))), log2_samples }
    }

    /// The number in the tile's sequence of a sample of a pixel, the pixel given by its Morton number in the tile.
    #[inline(always)]
    pub fn index<L: Lanes>(&self, pixel: U<L>, sample: U<L>) -> U<L> {
        // Samples beyond the announced number wrap into other scrambles of the same block.
        (pixel << self.log2_samples) | (sample & ((1 << self.log2_samples) - 1))
    }

    /// Two numbers in [0, 1) of a pair of dimensions.
    #[inline(always)]
    pub fn pair<L: Lanes>(&self, l: L, index: U<L>, dimension: u32) -> [F<L>; 2] {
        let seed = hash(self.seed ^ dimension.wrapping_mul(0xc2b2_ae35));
        let shift = MOST_SAMPLE_BITS - self.log2_samples;
        // Shuffling from the top bit down keeps every aligned block of points together, whatever its size.
        let shuffled = nested_scramble(l, index << shift, seed) >> shift;
        let first = permute(l, shuffled, hash(seed ^ 0x1b87_3593)).reverse_bits();
        let second = permute(l, pascal(shuffled), hash(seed ^ 0xe654_6b64)).reverse_bits();
        [to_unit(first), to_unit(second)]
    }

    /// A number in [0, 1) beside a pair: the three of a pixel's samples are spread over a cube together.
    #[inline(always)]
    pub fn third<L: Lanes>(&self, l: L, index: U<L>, dimension: u32) -> F<L> {
        let seed = hash(self.seed ^ dimension.wrapping_mul(0xc2b2_ae35));
        let shift = MOST_SAMPLE_BITS - self.log2_samples;
        let shuffled = nested_scramble(l, index << shift, seed) >> shift;
        to_unit(permute(l, third_generator(l, shuffled), hash(seed ^ 0x7feb_352d)).reverse_bits())
    }
}

/// Columns of the generator of Sobol's third dimension, bits reversed: column `i` is what bit `i` of a number adds.
const THIRD: [u32; 32] = third_columns();

/// The direction numbers of the primitive polynomial x² + x + 1, begun with 1 and 3.
const fn third_columns() -> [u32; 32] {
    let mut m = [0u64; 32];
    let mut columns = [0; 32];
    (m[0], m[1]) = (1, 3);
    let mut i = 0;
    while i < 32 {
        if i >= 2 {
            m[i] = (m[i - 1] << 1) ^ (m[i - 2] << 2) ^ m[i - 2];
        }
        columns[i] = ((m[i] << (31 - i)) as u32).reverse_bits();
        i += 1;
    }
    columns
}

/// Multiplies the bits by the generator of Sobol's third dimension before bit reversal.
#[inline(always)]
fn third_generator<L: Lanes>(l: L, x: U<L>) -> U<L> {
    let mut y = l.u(0);
    for (bit, column) in THIRD.iter().enumerate() {
        y ^= l.u(*column).keep_if(((x >> bit as u32) & 1).ne(0));
    }
    y
}

/// Multiplies the bits by Pascal's triangle modulo two: the generator of Sobol's second dimension before bit reversal.
#[inline(always)]
fn pascal<L: Lanes>(x: U<L>) -> U<L> {
    let x = x ^ (x >> 16);
    let x = x ^ ((x & 0xff00_ff00) >> 8);
    let x = x ^ ((x & 0xf0f0_f0f0) >> 4);
    let x = x ^ ((x & 0xcccc_cccc) >> 2);
    x ^ ((x & 0xaaaa_aaaa) >> 1)
}

/// Laine and Karras' permutation with Vegdahl's constants: each bit is flipped by a hash of the bits below it.
#[inline(always)]
fn permute<L: Lanes>(_: L, x: U<L>, seed: u32) -> U<L> {
    let x = x ^ (x * 0x3d20_adea);
    let x = x + seed;
    let x = x * ((seed >> 16) | 1);
    let x = x ^ (x * 0x0552_6c56);
    x ^ (x * 0x53a2_2864)
}

#[inline(always)]
fn nested_scramble<L: Lanes>(l: L, x: U<L>, seed: u32) -> U<L> {
    permute(l, x.reverse_bits(), seed).reverse_bits()
}

/// The upper 24 bits as a number in [0, 1).
#[inline(always)]
pub fn to_unit<L: Lanes>(x: U<L>) -> F<L> {
    (x >> 8).i32_to_float() * (1.0 / 16_777_216.0)
}

/// A well-mixed 32-bit hash (Wellons' lowbias32).
#[inline]
pub const fn hash(mut x: u32) -> u32 {
    x ^= x >> 16;
    x = x.wrapping_mul(0x7feb_352d);
    x ^= x >> 15;
    x = x.wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio_simd::One;

    fn points(sampler: &Sampler, pixel: u32, count: u32, dimension: u32) -> Vec<[f32; 2]> {
        let at = |sample| sampler.pair(One, sampler.index::<One>(U(pixel), U(sample)), dimension);
        (0..count).map(at).map(|[x, y]| [x.0, y.0]).collect()
    }

    #[test]
    fn a_pixels_samples_are_a_net_in_base_two() {
        let sampler = Sampler::new(7, [3, 5], 64);
        for dimension in 0..40 {
            let points = points(&sampler, 1234, 64, dimension);
            for columns_log2 in 0..=6 {
                let (columns, rows) = (1 << columns_log2, 64 >> columns_log2);
                let mut filled = vec![0; 64];
                for [x, y] in &points {
                    filled[(x * columns as f32) as usize * rows + (y * rows as f32) as usize] += 1;
                }
                assert!(filled.iter().all(|n| *n == 1), "dimension {dimension}, {columns} columns");
            }
        }
    }

    #[test]
    fn third_numbers_are_even_and_spread_with_each_of_the_pair() {
        let sampler = Sampler::new(7, [3, 5], 64);
        let index = |sample| sampler.index::<One>(U(1234), U(sample));
        let thirds: Vec<f32> = (0..64).map(|sample| sampler.third(One, index(sample), 0).0).collect();
        let mut parts: Vec<usize> = thirds.iter().map(|z| (z * 64.0) as usize).collect();
        parts.sort_unstable();
        assert_eq!(parts, (0..64).collect::<Vec<_>>());
        for axis in 0..2 {
            for columns_log2 in 0..=5 {
                let (columns, rows) = (1 << columns_log2, 32 >> columns_log2);
                let mut filled = vec![0; 32];
                for (pair, z) in points(&sampler, 1234, 64, 0).iter().zip(&thirds) {
                    filled[(pair[axis] * columns as f32) as usize * rows + (z * rows as f32) as usize] += 1;
                }
                assert!(filled.iter().all(|n| *n == 2), "axis {axis}, {columns} columns: {filled:?}");
            }
        }
    }

    #[test]
    fn neighbouring_pixels_together_are_a_net() {
        let sampler = Sampler::new(1, [0, 0], 4);
        let mut filled = [0; 16];
        for pixel in 8..12 {
            for [x, y] in points(&sampler, pixel, 4, 9) {
                filled[(x * 4.0) as usize * 4 + (y * 4.0) as usize] += 1;
            }
        }
        assert!(filled.iter().all(|n| *n == 1));
    }

    #[test]
    fn the_mean_over_seeds_is_uniform() {
        // 4096 independent seeds: the mean of a uniform number has a standard error of 0.0045; five of them are allowed.
        let mut sum = [0.0; 2];
        for seed in 0..4096 {
            let [x, y] = points(&Sampler::new(seed, [1, 2], 16), 77, 1, 3)[0];
            sum[0] += f64::from(x);
            sum[1] += f64::from(y);
        }
        for s in sum {
            assert!((s / 4096.0 - 0.5).abs() < 5.0 * 0.0045, "{}", s / 4096.0);
        }
    }

    #[test]
    fn pairs_of_dimensions_are_uncorrelated() {
        let n = 4096;
        let sampler = Sampler::new(3, [0, 1], 1);
        let column = |dimension| -> Vec<f64> { (0..n).map(|pixel| f64::from(points(&sampler, pixel, 1, dimension)[0][0])).collect() };
        let columns: Vec<_> = (0..8).map(column).collect();
        for (i, a) in columns.iter().enumerate() {
            for b in &columns[..i] {
                let r: f64 = a.iter().zip(b).map(|(x, y)| (x - 0.5) * (y - 0.5) * 12.0).sum::<f64>() / f64::from(n);
                // Standard error 1/64; 28 pairs, five standard errors.
                assert!(r.abs() < 5.0 / 64.0, "{i}: {r}");
            }
        }
    }
}
