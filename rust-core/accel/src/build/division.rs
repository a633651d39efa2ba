//! Division of what a tree is built over into parts that fit a core's cache, one task each.
//!
//! Parts are runs of grid cells along a Morton curve (Morton 1966). Nothing here depends on the number of threads.

use crate::cancelled::Cancelled;
use crate::tree::node::{Bounds, MAX_INDEX};
use glam::{UVec3, Vec3A};
use obvhs::aabb::Aabb;
use rayon::prelude::*;
use std::ops::Range;
use std::sync::atomic::AtomicBool;

/// What a tree is built over: boxes with numbers from 0.
pub(crate) trait Source: Sync {
    /// Whether the boxes of binary nodes are kept until wide nodes are made. They take three quarters of the memory of a build; without them what is in the
    /// leaves is asked again.
    const KEEPS_BOXES: bool = true;
    /// How many numbers there are, at most [`MAX_INDEX`].
    fn len(&self) -> usize;
    /// The box of a number, or None for what stays out of the tree.
    fn bounds(&self, number: u32) -> Option<Aabb>;
    /// A box around most of what there is: parts are found fastest when it is tight.
    fn extent(&self) -> Aabb;
}

impl Source for Vec<Bounds> {
    fn len(&self) -> usize {
        <[Bounds]>::len(self)
    }

    fn bounds(&self, number: u32) -> Option<Aabb> {
        let Bounds { min, max } = self[number as usize];
        Some(Aabb::new(min.into(), max.into()))
    }

    fn extent(&self) -> Aabb {
        self.iter().fold(Aabb::empty(), |all, b| all.union(&Aabb::new(b.min.into(), b.max.into())))
    }
}

/// One number, or two that follow each other and lie so close that no leaf would part them: the halves of a quad.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Item(pub(crate) u32);

/// Above all numbers.
const PAIR: u32 = (MAX_INDEX as u32 + 1).next_power_of_two();

impl Item {
    pub(crate) fn is_pair(self) -> bool {
        self.0 & PAIR != 0
    }

    /// The number, or the lower one of a pair.
    pub(crate) fn first(self) -> u32 {
        self.0 & !PAIR
    }

    /// How many numbers it stands for.
    pub(crate) fn count(self) -> u32 {
        1 + u32::from(self.is_pair())
    }

    /// The box of an item that was made from this source.
    #[inline(always)]
    pub(crate) fn bounds(self, source: &impl Source) -> Aabb {
        let first = source.bounds(self.first()).unwrap_or(Aabb::empty());
        let second = if self.is_pair() { source.bounds(self.first() + 1) } else { None };
        second.map_or(first, |second| first.union(&second))
    }
}

/// The most items of a part.
pub(crate) const PART: usize = 1 << 14;

/// Numbers or items that are sorted as one task.
const CHUNK: usize = 1 << 14;

/// Two numbers are a pair when the area of their common box is at most this share of the sum of their own.
const PAIR_AREA: f32 = 0.8;

/// Cells of the grid: sixteen on each axis.
const CELLS: usize = 1 << 12;

/// After so many divisions what is left is cut as it comes.
const DIVISIONS: usize = 8;

/// Divides all items of a source into parts; pairs are made if `pairs` are allowed.
pub(crate) fn divide_all<S: Source>(source: &S, pairs: bool, cancel: &AtomicBool) -> Result<Vec<Vec<Item>>, Cancelled> {
    if source.len() <= PART {
        let mut items = Vec::with_capacity(source.len());
        for_each_item(source, 0..source.len(), pairs, |item, _| items.push(item));
        return Ok(if items.is_empty() { Vec::new() } else { vec![items] });
    }
    let grid = Grid::around(&source.extent());
    let chunks = source.len().div_ceil(CHUNK);
    let sorted = (0..chunks).into_par_iter().map(|chunk| {
        Cancelled::check(cancel)?;
        let mut cells = CellSort::with_capacity(CHUNK);
        let range = chunk * CHUNK..((chunk + 1) * CHUNK).min(source.len());
        for_each_item(source, range, pairs, |item, bounds| cells.push(item, grid.cell(bounds)));
        Ok(cells.sorted())
    });
    divide(source, &sorted.collect::<Result<Vec<Sorted>, Cancelled>>()?, 1, cancel)
}

/// Visits the items of some numbers in their order.
fn for_each_item(source: &impl Source, numbers: Range<usize>, pairs: bool, mut visit: impl FnMut(Item, &Aabb)) {
    let mut waiting: Option<(u32, Aabb)> = None;
    for number in numbers.start as u32..numbers.end as u32 {
        let bounds = source.bounds(number);
        if let (Some((first, a)), Some(b), true) = (&waiting, &bounds, pairs) {
            let both = a.union(b);
            if both.half_area() <= PAIR_AREA * (a.half_area() + b.half_area()) {
                visit(Item(first | PAIR), &both);
                waiting = None;
                continue;
            }
        }
        if let Some((first, a)) = &waiting {
            visit(Item(*first), a);
        }
        waiting = bounds.map(|bounds| (number, bounds));
    }
    if let Some((first, a)) = &waiting {
        visit(Item(*first), a);
    }
}

/// A grid of cubes over a box, numbered along a Morton curve.
struct Grid {
    /// Twice the lowest corner.
    low: Vec3A,
    /// Cells per twice the length.
    scale: f32,
}

impl Grid {
    fn around(bounds: &Aabb) -> Self {
        let scale = 8.0 / bounds.diagonal().max_element();
        Grid { low: 2.0 * bounds.min, scale: if scale.is_finite() { scale } else { 0.0 } }
    }

    /// The cell of a box's centre; the outermost cells take what lies outside.
    #[inline(always)]
    fn cell(&self, bounds: &Aabb) -> u16 {
        let place = ((bounds.min + bounds.max - self.low) * self.scale).clamp(Vec3A::ZERO, Vec3A::splat(15.0)).as_uvec3();
        // Bit b of each axis goes to bit 3 b.
        let spread = (place | (place << 4u32)) & UVec3::splat(0xc3);
        let spread = (spread | (spread << 2u32)) & UVec3::splat(0x249);
        (spread.x | spread.y << 1 | spread.z << 2) as u16
    }
}

/// Items with their cells, before the sort.
struct CellSort {
    items: Vec<Item>,
    cells: Vec<u16>,
}

impl CellSort {
    fn with_capacity(items: usize) -> Self {
        CellSort { items: Vec::with_capacity(items), cells: Vec::with_capacity(items) }
    }

    fn push(&mut self, item: Item, cell: u16) {
        self.items.push(item);
        self.cells.push(cell);
    }

    fn sorted(self) -> Sorted {
        let mut starts = vec![0u32; CELLS + 1];
        for &cell in &self.cells {
            starts[cell as usize + 1] += 1;
        }
        for cell in 0..CELLS {
            starts[cell + 1] += starts[cell];
        }
        let mut next = starts.clone();
        let mut items = vec![Item(0); self.items.len()];
        for (&item, &cell) in self.items.iter().zip(&self.cells) {
            items[next[cell as usize] as usize] = item;
            next[cell as usize] += 1;
        }
        Sorted { items, starts }
    }
}

/// Items in the order of their cells; those of a cell lie from its start up to the next one's.
struct Sorted {
    items: Vec<Item>,
    starts: Vec<u32>,
}

impl Sorted {
    fn of(&self, cells: &Range<usize>) -> &[Item] {
        &self.items[self.starts[cells.start] as usize..self.starts[cells.end] as usize]
    }
}

/// Puts neighbouring cells together up to the size of a part, and divides again what is too large in one cell.
fn divide<S: Source>(source: &S, sorted: &[Sorted], division: usize, cancel: &AtomicBool) -> Result<Vec<Vec<Item>>, Cancelled> {
    let parts = runs(sorted).into_par_iter().map(|cells| {
        Cancelled::check(cancel)?;
        let mut items = Vec::with_capacity(sorted.iter().map(|chunk| chunk.of(&cells).len()).sum());
        for chunk in sorted {
            items.extend_from_slice(chunk.of(&cells));
        }
        match items.len() {
            0..=PART => Ok(vec![items]),
            _ if division == DIVISIONS => Ok(items.chunks(PART).map(<[Item]>::to_vec).collect()),
            _ => divide(source, &sorted_again(source, &items, cancel)?, division + 1, cancel),
        }
    });
    Ok(parts.collect::<Result<Vec<Vec<Vec<Item>>>, Cancelled>>()?.into_iter().flatten().collect())
}

/// Sorts the items of one cell into a finer grid around them.
fn sorted_again<S: Source>(source: &S, items: &[Item], cancel: &AtomicBool) -> Result<Vec<Sorted>, Cancelled> {
    let with = |all: Aabb, item: &Item| all.union(&Aabb::from_point(item.bounds(source).center()));
    let centres = items.par_iter().fold(Aabb::empty, with).reduce(Aabb::empty, |a, b| a.union(&b));
    let grid = Grid::around(&centres);
    let sorted = items.par_chunks(CHUNK).map(|chunk| {
        Cancelled::check(cancel)?;
        let mut cells = CellSort::with_capacity(chunk.len());
        for &item in chunk {
            cells.push(item, grid.cell(&item.bounds(source)));
        }
        Ok(cells.sorted())
    });
    sorted.collect()
}

/// Runs of cells with something in them, of at most `PART` items unless a cell alone holds more.
fn runs(sorted: &[Sorted]) -> Vec<Range<usize>> {
    let mut runs = Vec::new();
    let (mut start, mut held) = (0, 0);
    for cell in 0..CELLS {
        let count: usize = sorted.iter().map(|chunk| chunk.of(&(cell..cell + 1)).len()).sum();
        if held > 0 && held + count > PART {
            runs.push(start..cell);
            (start, held) = (cell, 0);
        }
        held += count;
    }
    if held > 0 {
        runs.push(start..CELLS);
    }
    runs
}
