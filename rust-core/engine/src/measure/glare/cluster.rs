//! Gathering pixels that are near each other: single linkage by angles.

use super::view::PixelView;
use std::collections::HashMap;

/// A pixel that glares.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pixel {
    /// Number in the picture.
    pub(super) index: usize,
    pub(super) view: PixelView,
}

/// The cluster of each pixel, named by one of its pixels: what touches, also by a corner, and what lies within a circle of the opening angle `opening` about
/// a pixel. `kind` keeps apart what is of different kinds. `width` is the picture's; the pixels are in order.
pub(super) fn clusters(pixels: &[Pixel], width: usize, opening: f64, kind: impl Fn(usize) -> usize) -> Vec<usize> {
    let mut sets = Sets { parent: (0..pixels.len()).collect() };
    join_touching(&mut sets, pixels, width, &kind);
    if opening > 1e-6 {
        join_near(&mut sets, pixels, 2.0 * (0.25 * opening).sin(), &kind);
    }
    (0..pixels.len()).map(|at| sets.root(at)).collect()
}

/// Joins pixels with those before them in the row and in the row above.
fn join_touching(sets: &mut Sets, pixels: &[Pixel], width: usize, kind: &impl Fn(usize) -> usize) {
    let at: HashMap<usize, usize> = pixels.iter().enumerate().map(|(at, pixel)| (pixel.index, at)).collect();
    for (number, pixel) in pixels.iter().enumerate() {
        let (x, y) = (pixel.index % width, pixel.index / width);
        let left = (x > 0).then(|| pixel.index - 1);
        let above = if y > 0 { x.saturating_sub(1)..(x + 2).min(width) } else { 0..0 };
        for other in left.into_iter().chain(above.map(|x| (y - 1) * width + x)) {
            if let Some(other) = at.get(&other).filter(|other| kind(**other) == kind(number)) {
                sets.join(number, *other);
            }
        }
    }
}

/// Joins pixels whose directions are at most a chord apart. Cells are so small that all in one are of one cluster.
fn join_near(sets: &mut Sets, pixels: &[Pixel], chord: f64, kind: &impl Fn(usize) -> usize) {
    let side = chord / 3f64.sqrt();
    let mut cells: HashMap<([i32; 3], usize), Vec<usize>> = HashMap::new();
    for (number, pixel) in pixels.iter().enumerate() {
        let cell = pixel.view.direction.map(|x| (x / side).floor() as i32);
        cells.entry((cell, kind(number))).or_default().push(number);
    }
    for of_cell in cells.values() {
        of_cell.windows(2).for_each(|pair| sets.join(pair[0], pair[1]));
    }
    // Each pair of cells once.
    let half = (0..125).map(|i| [i % 5 - 2, i / 5 % 5 - 2, i / 25 - 2]).filter(|step| *step > [0, 0, 0]);
    let steps: Vec<[i32; 3]> = half.collect();
    for ((cell, kind), of_cell) in &cells {
        for step in &steps {
            let other = ([0, 1, 2].map(|axis| cell[axis] + step[axis]), *kind);
            let Some(others) = cells.get(&other).filter(|others| sets.root(others[0]) != sets.root(of_cell[0])) else { continue };
            if any_near(pixels, of_cell, others, chord) {
                sets.join(of_cell[0], others[0]);
            }
        }
    }
}

fn any_near(pixels: &[Pixel], some: &[usize], others: &[usize], chord: f64) -> bool {
    let near = |a: [f64; 3], b: [f64; 3]| (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>() <= chord * chord;
    some.iter().any(|a| others.iter().any(|b| near(pixels[*a].view.direction, pixels[*b].view.direction)))
}

/// Disjoint sets.
struct Sets {
    parent: Vec<usize>,
}

impl Sets {
    /// The least member, which stands for the set.
    fn root(&mut self, mut at: usize) -> usize {
        while self.parent[at] != at {
            self.parent[at] = self.parent[self.parent[at]];
            at = self.parent[at];
        }
        at
    }
    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        self.parent[a.max(b)] = a.min(b);
    }
}
