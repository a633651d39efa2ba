//! One level of a pyramid from the one above: a box filter whose weights are the exact overlaps, so that the mean is kept at odd sizes too.

use rayon::prelude::*;

/// The texels of the finer level that a coarser one covers, with their shares.
struct Taps {
    first: usize,
    weights: [f32; 3],
    count: usize,
}

/// The size of the level below `size`.
pub(crate) fn half_size(size: usize) -> usize {
    (size / 2).max(1)
}

/// Texel `i` of `half_size(fine)` covers `fine / half_size(fine)` texels: one, two, or (odd sizes) two and a fraction spread over three
/// (Guthe and Heckbert, Non-Power-of-Two Mipmapping, 2005).
#[inline]
fn taps(fine: usize, i: usize) -> Taps {
    match (fine, fine % 2) {
        (1, _) => Taps { first: 0, weights: [1.0, 0.0, 0.0], count: 1 },
        (_, 0) => Taps { first: 2 * i, weights: [0.5, 0.5, 0.0], count: 2 },
        _ => {
            let (coarse, total) = (half_size(fine), fine as f32);
            let weights = [(coarse - i) as f32 / total, coarse as f32 / total, (i + 1) as f32 / total];
            Taps { first: 2 * i, weights, count: 3 }
        }
    }
}

/// The next coarser level of an image of linear RGBA texels read by `texel(x, y)`.
pub(crate) fn shrink(size: [usize; 2], texel: impl Fn(usize, usize) -> [f32; 4] + Sync) -> Vec<[f32; 4]> {
    let coarse = size.map(half_size);
    let mut out = vec![[0.0; 4]; coarse[0] * coarse[1]];
    out.par_chunks_mut(coarse[0]).enumerate().for_each(|(y, row)| {
        let vertical = taps(size[1], y);
        let average = |x: usize, counts: [usize; 2]| average(&taps(size[0], x), &vertical, counts, &texel);
        match [taps(size[0], 0).count, vertical.count] {
            // Most are of even sizes: these loops are unrolled.
            [2, 2] => row.iter_mut().enumerate().for_each(|(x, value)| *value = average(x, [2, 2])),
            counts => row.iter_mut().enumerate().for_each(|(x, value)| *value = average(x, counts)),
        }
    });
    out
}

#[inline]
fn average(horizontal: &Taps, vertical: &Taps, [across, down]: [usize; 2], texel: &impl Fn(usize, usize) -> [f32; 4]) -> [f32; 4] {
    let mut sum = [0.0; 4];
    for j in 0..down {
        for i in 0..across {
            let weight = vertical.weights[j] * horizontal.weights[i];
            let value = texel(horizontal.first + i, vertical.first + j);
            for (s, v) in sum.iter_mut().zip(value) {
                *s += weight * v;
            }
        }
    }
    sum
}
