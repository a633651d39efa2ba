//! Groups of neighbouring boxes, each small enough for one sequential task.

use super::Bounds;
use rayon::prelude::*;

/// The most boxes of a group: the builder runs sequentially below 4000, and such a tree fits a core's cache.
const LARGEST: usize = 3999;

/// Bits of a cell's number along one axis.
const BITS: u32 = 4;

const CELLS: usize = 1 << (3 * BITS);

/// Cuts `used`, numbers of boxes, into groups: by halving the cells of a grid in Morton order, and again inside of cells that hold too many.
pub(super) fn groups(boxes: &[Bounds], used: &[u32]) -> Vec<Vec<u32>> {
    if used.len() <= LARGEST {
        return vec![used.to_vec()];
    }
    let cells = cells(boxes, used);
    let mut ends = vec![0usize; CELLS + 1];
    for &cell in &cells {
        ends[cell as usize + 1] += 1;
    }
    for cell in 0..CELLS {
        ends[cell + 1] += ends[cell];
    }
    let mut next = ends.clone();
    let mut sorted = vec![0u32; used.len()];
    for (&i, &cell) in used.iter().zip(&cells) {
        sorted[next[cell as usize]] = i;
        next[cell as usize] += 1;
    }
    let mut ranges = Vec::new();
    halve(&ends, 0, CELLS, &mut ranges);
    ranges.into_par_iter().flat_map_iter(|(start, end)| split_if_large(boxes, &sorted[start..end], used.len())).collect()
}

/// Ranges of boxes for the aligned range of cells.
fn halve(ends: &[usize], first: usize, cells: usize, ranges: &mut Vec<(usize, usize)>) {
    let (start, end) = (ends[first], ends[first + cells]);
    if start == end {
        return;
    }
    if end - start <= LARGEST || cells == 1 {
        ranges.push((start, end));
        return;
    }
    halve(ends, first, cells / 2, ranges);
    halve(ends, first + cells / 2, cells / 2, ranges);
}

/// One group, or those of a finer grid; boxes that no grid separates are cut in order of their numbers.
fn split_if_large(boxes: &[Bounds], group: &[u32], all: usize) -> Vec<Vec<u32>> {
    if group.len() < all {
        return groups(boxes, group);
    }
    group.chunks(LARGEST).map(<[u32]>::to_vec).collect()
}

/// Twice the centre.
fn centre(b: &Bounds) -> [f32; 3] {
    [0, 1, 2].map(|axis| b.min[axis] + b.max[axis])
}

/// The Morton number of the cell of every box, in a grid of cubes over the centres.
fn cells(boxes: &[Bounds], used: &[u32]) -> Vec<u16> {
    let room = used
        .par_chunks(1 << 13)
        .map(|chunk| {
            let mut room = Bounds::EMPTY;
            for &i in chunk {
                let centre = centre(&boxes[i as usize]);
                room = room.union(&Bounds { min: centre, max: centre });
            }
            room
        })
        .reduce(|| Bounds::EMPTY, |a, b| a.union(&b));
    let side = (0..3).map(|axis| room.max[axis] - room.min[axis]).fold(0.0, f32::max);
    let cells = (1u32 << BITS) as f32;
    let scale = if side > 0.0 { cells / side } else { 0.0 };
    let cell = |&i: &u32| {
        let centre = centre(&boxes[i as usize]);
        let mut code = 0;
        for (axis, place) in centre.iter().enumerate() {
            // The cast clamps at zero.
            let x = ((place - room.min[axis]) * scale).min(cells - 1.0) as u16;
            for bit in 0..BITS {
                code |= ((x >> bit) & 1) << (3 * bit + axis as u32);
            }
        }
        code
    };
    used.par_iter().with_min_len(1 << 12).map(cell).collect()
}
