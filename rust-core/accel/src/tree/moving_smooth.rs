//! Trees of curves and points that move while the shutter is open: boxes around all keys, and leaves between two keys at a ray's time.

use super::blas::{Blas, Care};
use super::node::{Kind, MAX_INDEX, ROUNDING_PAD, WIDTH};
use super::smooth_tree::{Balls, PIECES, Pieces, Seen, Spheres};
use crate::build::division::Source;
use crate::build::wide_tree::{build, build_lists};
use crate::cancelled::Cancelled;
use crate::intersect::point_block::PointBlock;
use crate::intersect::segment_block::{Segment, SegmentBlock, Segments};
use crate::intersect::smooth::{Smooth, SmoothLeaf};
use crate::ray::NONE;
use gonio_simd::motion::segment_of;
use obvhs::aabb::Aabb;
use std::sync::atomic::AtomicBool;

/// Points and radii at evenly spaced times over the shutter, and the pieces of curves.
#[derive(Debug)]
pub(crate) struct MovingSmooth {
    keys: Vec<Vec<[f32; 4]>>,
    pieces: Vec<u32>,
}

/// A leaf at a time.
pub(crate) enum MovedLeaf {
    Nothing,
    Tubes(SegmentBlock),
    Ribbons(SegmentBlock),
    Spheres(PointBlock),
    Discs(PointBlock),
}

impl MovedLeaf {
    /// The leaf as rays are tested against it.
    #[inline(always)]
    pub(crate) fn leaf(&self) -> SmoothLeaf<'_> {
        match self {
            MovedLeaf::Nothing => SmoothLeaf::Nothing,
            MovedLeaf::Tubes(block) => SmoothLeaf::Tubes(block.segments()),
            MovedLeaf::Ribbons(block) => SmoothLeaf::Ribbons(block.segments()),
            MovedLeaf::Spheres(block) => SmoothLeaf::Spheres(block),
            MovedLeaf::Discs(block) => SmoothLeaf::Discs(block),
        }
    }
}

impl Blas {
    /// [`Blas::of_curves`] of curves whose points and radii are given at two or more evenly spaced times over the shutter, as many each time.
    ///
    /// A piece that [`Blas::of_curves`] would leave out at any of the times is left out.
    pub fn of_moving_curves(
        keys: Vec<Vec<[f32; 4]>>,
        pieces: &[u32],
        seen: Seen,
        care: Care,
        cancel: &AtomicBool,
    ) -> Result<Blas, Cancelled> {
        assert!(pieces.len() <= MAX_INDEX, "a tree holds at most {MAX_INDEX} pieces of curves");
        let at = |points| Pieces { points: Spheres::Together(points), pieces };
        let (first, all) = (at(&keys[0]), Keys(keys.iter().map(|points| at(points)).collect()));
        let tree = build_lists(&all, PIECES, Kind::Smooth, care.effort(), cancel)?;
        let tree = Blas::segments(tree, &first, seen);
        Ok(tree.moving(MovingSmooth { keys, pieces: pieces.to_vec() }))
    }

    /// [`Blas::of_points`] of points whose places and radii are given at two or more evenly spaced times over the shutter, as many each time.
    pub fn of_moving_points(keys: Vec<Vec<[f32; 4]>>, seen: Seen, care: Care, cancel: &AtomicBool) -> Result<Blas, Cancelled> {
        assert!(keys[0].len() <= MAX_INDEX, "a tree holds at most {MAX_INDEX} points");
        let at = |points| Balls { points: Spheres::Together(points) };
        let tree = build(&Keys(keys.iter().map(|points| at(points)).collect()), &at(&keys[0]), care.effort(), cancel)?;
        let tree = Blas::smooth(tree, |leaves| if seen == Seen::Solid { Smooth::Spheres(leaves) } else { Smooth::Discs(leaves) });
        Ok(tree.moving(MovingSmooth { keys, pieces: Vec::new() }))
    }

    fn moving(self, moving: MovingSmooth) -> Blas {
        Blas { keys: moving.keys.len(), moving_smooth: Some(Box::new(moving)), ..self }
    }

    /// A leaf of curves or points that move, at a time.
    #[inline(never)]
    pub(crate) fn smooth_at(&self, leaf: usize, time: f32) -> MovedLeaf {
        let Some(moving) = &self.moving_smooth else { return MovedLeaf::Nothing };
        match &self.smooth {
            Smooth::Nothing => MovedLeaf::Nothing,
            Smooth::Tubes(leaves) => MovedLeaf::Tubes(moving.segments(leaves.leaf(leaf), time)),
            Smooth::Ribbons(leaves) => MovedLeaf::Ribbons(moving.segments(leaves.leaf(leaf), time)),
            Smooth::Spheres(blocks) => MovedLeaf::Spheres(moving.points(&blocks[leaf], time)),
            Smooth::Discs(blocks) => MovedLeaf::Discs(moving.points(&blocks[leaf], time)),
        }
    }
}

/// Two keys and the share of the way between them.
struct Between<'a> {
    from: &'a [[f32; 4]],
    to: &'a [[f32; 4]],
    share: f32,
}

impl Between<'_> {
    fn point(&self, number: usize) -> Option<[f32; 4]> {
        let (from, to) = (self.from.get(number)?, self.to.get(number)?);
        let mut point = *from;
        for (x, to) in point.iter_mut().zip(to) {
            *x += (to - *x) * self.share;
        }
        Some(point)
    }
}

impl MovingSmooth {
    /// Bytes held.
    pub(crate) fn memory(&self) -> usize {
        self.keys.iter().map(|key| key.capacity() * size_of::<[f32; 4]>()).sum::<usize>() + self.pieces.capacity() * size_of::<u32>()
    }

    fn between(&self, time: f32) -> Between<'_> {
        let (number, share) = segment_of(time, self.keys.len() - 1);
        Between { from: &self.keys[number], to: &self.keys[number + 1], share }
    }

    fn segments(&self, leaf: Segments<'_>, time: f32) -> SegmentBlock {
        let (between, mut moved) = (self.between(time), SegmentBlock::empty());
        let pieces = Pieces { points: Spheres::Together(&[]), pieces: &self.pieces };
        for lane in 0..leaf.count() {
            let piece = leaf.primitive(lane);
            let (first, is_first, is_last) = pieces.place(piece);
            let (Some(start), Some(end)) = (between.point(first), between.point(first + 1)) else { continue };
            let next = if is_last { None } else { between.point(first + 2) };
            moved.set(lane, &Segment { ends: [start, end], next, first: is_first }, piece);
        }
        moved
    }

    fn points(&self, block: &PointBlock, time: f32) -> PointBlock {
        let (between, mut moved) = (self.between(time), PointBlock::EMPTY);
        for lane in (0..WIDTH).filter(|lane| block.primitives[*lane] != NONE) {
            let number = block.primitives[lane];
            if let Some(point) = between.point(number as usize) {
                moved.set(lane, point, number);
            }
        }
        moved
    }
}

/// Pieces or points with the boxes of all keys together.
struct Keys<S>(Vec<S>);

impl<S: Source> Source for Keys<S> {
    const KEEPS_BOXES: bool = S::KEEPS_BOXES;

    fn len(&self) -> usize {
        self.0[0].len()
    }

    fn bounds(&self, number: u32) -> Option<Aabb> {
        let mut all = Aabb::empty();
        for key in &self.0 {
            all = all.union(&key.bounds(number)?);
        }
        // What lies between two keys is rounded once more.
        let pad = all.min.abs().max(all.max.abs()).max_element() * ROUNDING_PAD;
        Some(Aabb::new(all.min - pad, all.max + pad))
    }

    fn extent(&self) -> Aabb {
        self.0.iter().fold(Aabb::empty(), |all, key| all.union(&key.extent()))
    }
}
