//! Making light small enough: steps coarser first, then pixels fewer.

use super::{codes::Steps, pack::packed, picture::Problem};
use rayon::prelude::*;

/// Steps in a power of two: within half of an 8-bit step on the display, and where room is scarce.
const PER_STOP: [u32; 2] = [96, 32];
/// Fewer pixels on the longer side are no picture.
const LEAST_SIDE: usize = 64;
/// Part of the room that is aimed at: how well pixels are foreseen depends on their size.
const AIM: f64 = 0.94;

/// The light of groups, each by its own steps.
#[derive(Debug)]
pub(super) struct Fitted {
    pub(super) size: [usize; 2],
    pub(super) groups: Vec<(Steps, Vec<u8>)>,
}

impl Fitted {
    fn new(groups: &[&[f32]], size: [usize; 2], per_stop: u32) -> Self {
        let pack = |values: &&[f32]| {
            let steps = Steps::of(values, per_stop);
            (steps, packed(values, size[0], steps))
        };
        Self { size, groups: groups.par_iter().map(pack).collect() }
    }

    /// Groups whose light takes no room.
    pub(super) fn bare(groups: &[&[f32]], size: [usize; 2]) -> Self {
        Self { size, groups: groups.iter().map(|values| (Steps::of(values, PER_STOP[0]), Vec::new())).collect() }
    }

    fn bytes(&self) -> usize {
        self.groups.iter().map(|(_, bytes)| bytes.len()).sum()
    }
}

/// Packs the groups into at most so many bytes.
pub(super) fn fitted(groups: &[&[f32]], size: [usize; 2], most: usize) -> Result<Fitted, Problem> {
    let mut last = Fitted::new(groups, size, PER_STOP[0]);
    if last.bytes() > most {
        last = Fitted::new(groups, size, PER_STOP[1]);
    }
    while last.bytes() > most {
        let scale = (AIM * most as f64 / last.bytes() as f64).sqrt();
        let smaller = last.size.map(|side| ((side as f64 * scale) as usize).max(1));
        if smaller[0].max(smaller[1]) < LEAST_SIDE.min(size[0].max(size[1])) {
            return Err(Problem::TooLarge(most));
        }
        let light: Vec<Vec<f32>> = groups.par_iter().map(|values| reduced(values, size, smaller)).collect();
        let light: Vec<&[f32]> = light.iter().map(Vec::as_slice).collect();
        last = Fitted::new(&light, smaller, PER_STOP[1]);
    }
    Ok(last)
}

/// Means of light over the pixels of a smaller picture; three values a pixel, rows from the top.
pub fn reduced(values: &[f32], [width, height]: [usize; 2], [columns, rows]: [usize; 2]) -> Vec<f32> {
    let across: Vec<_> = (0..columns).map(|column| shares(column, columns, width)).collect();
    let mut out = Vec::with_capacity(3 * columns * rows);
    for row in 0..rows {
        let mut line = vec![0.0f64; 3 * width];
        for (y, share) in shares(row, rows, height) {
            let from = &values[3 * y * width..3 * (y + 1) * width];
            line.iter_mut().zip(from).for_each(|(sum, value)| *sum += share * f64::from(*value));
        }
        for shares in &across {
            let sum = |k: usize| shares.iter().map(|(x, share)| share * line[3 * x + k]).sum::<f64>() as f32;
            out.extend([sum(0), sum(1), sum(2)]);
        }
    }
    out
}

/// Which of `from` places one of `to` covers, and by what share.
fn shares(place: usize, to: usize, from: usize) -> Vec<(usize, f64)> {
    let size = from as f64 / to as f64;
    let (start, end) = (place as f64 * size, (place + 1) as f64 * size);
    let last = (end.ceil() as usize).min(from);
    let covered = |at: usize| (end.min(at as f64 + 1.0) - start.max(at as f64)).max(0.0) / size;
    (start as usize..last).map(|at| (at, covered(at))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn noise(count: usize) -> Vec<f32> {
        let mut state = 3u32;
        let mut next = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) as f32 / 16_777_216.0
        };
        (0..count).map(|_| 1.0 + next()).collect()
    }

    #[test]
    fn means_keep_the_light() {
        let (size, smaller) = ([31, 17], [12, 7]);
        let light = noise(3 * size[0] * size[1]);
        let mean = |values: &[f32]| values.iter().map(|x| f64::from(*x)).sum::<f64>() / values.len() as f64;
        let small = reduced(&light, size, smaller);
        assert_eq!(small.len(), 3 * smaller[0] * smaller[1]);
        assert!((mean(&small) / mean(&light) - 1.0).abs() < 1e-6);
        assert_eq!(reduced(&light, size, size), light);
        assert!(reduced(&[2.0; 27], [3, 3], [2, 2]).iter().all(|x| (x - 2.0).abs() < 1e-6));
    }

    #[test]
    fn what_is_too_large_becomes_coarser_and_then_smaller() {
        let size = [200, 120];
        let light = noise(3 * size[0] * size[1]);
        let whole = fitted(&[&light], size, usize::MAX).expect("room enough");
        assert_eq!((whole.size, whole.groups[0].0.per_stop), (size, PER_STOP[0]));
        let coarse = fitted(&[&light], size, whole.bytes() - 1).expect("room for coarser steps");
        assert_eq!((coarse.size, coarse.groups[0].0.per_stop), (size, PER_STOP[1]));
        let most = coarse.bytes() / 2;
        let small = fitted(&[&light], size, most).expect("room for fewer pixels");
        assert!(small.size[0] < size[0] && small.bytes() <= most && small.bytes() > most / 2, "{:?}", small.size);
        assert_eq!(fitted(&[&light], size, 100).expect_err("no room"), Problem::TooLarge(100));
    }
}
