//! Trees of curves and points: what they are built over and put together from.

use super::blas::{Blas, Care, outline, sah_cost};
use super::node::{ChildRef, Kind, LARGEST_COORDINATE, MAX_INDEX, ROUNDING_PAD, WIDTH};
use crate::build::collapse::{LeafMaker, LeafRule};
use crate::build::division::Source;
use crate::build::wide_tree::{WideTree, build, build_lists};
use crate::cancelled::Cancelled;
use crate::intersect::point_block::PointBlock;
use crate::intersect::segment_block::Segment;
use crate::intersect::segment_leaves::SegmentLeaves;
use crate::intersect::smooth::Smooth;
use glam::Vec3A;
use obvhs::aabb::Aabb;
use std::sync::atomic::AtomicBool;

/// Bit of a piece's entry: it is the first of its curve.
pub const FIRST_PIECE: u32 = 1 << 31;
/// Bit of a piece's entry: it is the last of its curve.
pub const LAST_PIECE: u32 = 1 << 30;

/// Points that an extent is taken from.
const SAMPLES: usize = 1 << 16;

/// What may lie in a leaf of curves.
pub(super) const PIECES: LeafRule = LeafRule { capacity: 8, cost: 2.0 };

/// What is seen of curves or points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Seen {
    /// Tubes and spheres.
    Solid,
    /// Ribbons and discs that face each ray.
    Facing,
}

/// Centres with radii.
#[derive(Clone, Copy, Debug)]
pub enum Spheres<'a> {
    /// Centre and radius of each.
    Together(&'a [[f32; 4]]),
    /// Centres, and as many radii: as tables for shading have them, so that nobody copies millions.
    Apart(&'a [[f32; 3]], &'a [f32]),
}

impl Spheres<'_> {
    fn len(&self) -> usize {
        match self {
            Spheres::Together(spheres) => spheres.len(),
            Spheres::Apart(centres, radii) => centres.len().min(radii.len()),
        }
    }

    #[inline(always)]
    fn get(&self, number: usize) -> Option<[f32; 4]> {
        match self {
            Spheres::Together(spheres) => spheres.get(number).copied(),
            Spheres::Apart(centres, radii) => centres.get(number).zip(radii.get(number)).map(|([x, y, z], radius)| [*x, *y, *z, *radius]),
        }
    }

    /// A box around most of them.
    fn extent(&self) -> Aabb {
        let step = self.len().div_ceil(SAMPLES).max(1);
        let boxes = (0..self.len()).step_by(step).filter_map(|number| ball_box(&self.get(number)?));
        boxes.fold(Aabb::empty(), |all, b| all.union(&b))
    }
}

impl Blas {
    /// Builds the tree of curves: points with their radii, and for each straight piece the number of its first point (the second one follows it) with
    /// [`FIRST_PIECE`] and [`LAST_PIECE`].
    ///
    /// Pieces without a positive radius, or with a point that is missing, not finite or beyond 1e12 are left out. Runs in the current rayon pool.
    pub fn of_curves(points: Spheres<'_>, pieces: &[u32], seen: Seen, care: Care, cancel: &AtomicBool) -> Result<Blas, Cancelled> {
        assert!(pieces.len() <= MAX_INDEX, "a tree holds at most {MAX_INDEX} pieces of curves");
        let curves = Pieces { points, pieces };
        let tree = build_lists(&curves, PIECES, Kind::Smooth, care.effort(), cancel)?;
        Ok(Blas::segments(tree, &curves, seen))
    }

    /// The tree of curves over leaves that are known by their pieces.
    pub(super) fn segments(mut tree: WideTree<[u32; WIDTH]>, curves: &Pieces<'_>, seen: Seen) -> Blas {
        let (leaves, numbers) = SegmentLeaves::pack(&tree.leaves, |piece| curves.segment(piece));
        for child in tree.nodes.iter_mut().flat_map(|node| &mut node.children).filter(|child| child.is(Kind::Smooth)) {
            *child = ChildRef::new(Kind::Smooth, numbers[child.index()] as usize);
        }
        Blas::smooth(tree, |_| if seen == Seen::Solid { Smooth::Tubes(leaves) } else { Smooth::Ribbons(leaves) })
    }

    /// Builds the tree of points: centres and radii. Those without a positive radius, or not finite or beyond 1e12, are left out.
    pub fn of_points(points: Spheres<'_>, seen: Seen, care: Care, cancel: &AtomicBool) -> Result<Blas, Cancelled> {
        assert!(points.len() <= MAX_INDEX, "a tree holds at most {MAX_INDEX} points");
        let balls = Balls { points };
        let tree = build(&balls, &balls, care.effort(), cancel)?;
        Ok(Blas::smooth(tree, |leaves| if seen == Seen::Solid { Smooth::Spheres(leaves) } else { Smooth::Discs(leaves) }))
    }

    pub(super) fn smooth<L>(tree: WideTree<L>, leaves: impl FnOnce(Vec<L>) -> Smooth) -> Blas {
        let WideTree { nodes, leaves: blocks, bounds, primitives } = tree;
        let sah_cost = sah_cost(&nodes, &bounds);
        let outline = outline(&nodes, bounds);
        Blas {
            nodes,
            blocks: Vec::new(),
            key_blocks: Vec::new(),
            moving_smooth: None,
            keys: 0,
            smooth: leaves(blocks),
            outline,
            triangles: primitives,
            sah_cost,
        }
    }
}

/// The padded box of a sphere, if it has a place and a size that is not negative.
#[inline(always)]
fn ball_box(ball: &[f32; 4]) -> Option<Aabb> {
    let (centre, radius) = (Vec3A::new(ball[0], ball[1], ball[2]), ball[3]);
    let usable = centre.abs().cmple(Vec3A::splat(LARGEST_COORDINATE)).all() && (0.0..=LARGEST_COORDINATE).contains(&radius);
    // Beside the rounding of coordinates that of the radius.
    let pad = (centre.abs().max_element() + radius) * (2.0 * ROUNDING_PAD) + radius * 1e-5;
    usable.then(|| Aabb::new(centre - (radius + pad), centre + (radius + pad)))
}

pub(super) struct Pieces<'a> {
    pub(super) points: Spheres<'a>,
    pub(super) pieces: &'a [u32],
}

impl Pieces<'_> {
    fn first(&self, piece: u32) -> usize {
        (self.pieces[piece as usize] & !(FIRST_PIECE | LAST_PIECE)) as usize
    }

    fn is(&self, piece: u32, bit: u32) -> bool {
        self.pieces[piece as usize] & bit != 0
    }
}

impl Source for Pieces<'_> {
    // There may be millions, in the room of a few numbers each.
    const KEEPS_BOXES: bool = false;

    fn len(&self) -> usize {
        self.pieces.len()
    }

    #[inline(always)]
    fn bounds(&self, number: u32) -> Option<Aabb> {
        let first = self.first(number);
        let (a, b) = (self.points.get(first)?, self.points.get(first + 1)?);
        let bounds = ball_box(&a)?.union(&ball_box(&b)?);
        (a[3].max(b[3]) > 0.0).then_some(bounds)
    }

    fn extent(&self) -> Aabb {
        self.points.extent()
    }
}

impl Pieces<'_> {
    /// A piece's first point, and whether it is the first and the last one of its curve.
    pub(super) fn place(&self, piece: u32) -> (usize, bool, bool) {
        (self.first(piece), self.is(piece, FIRST_PIECE), self.is(piece, LAST_PIECE))
    }

    /// A piece with what its leaf needs of its neighbours.
    fn segment(&self, piece: u32) -> Segment {
        let first = self.first(piece);
        let [start, end, next] = [0, 1, 2].map(|k| self.points.get(first + k));
        // What has no box is in no leaf.
        let ends = [start, end].map(Option::unwrap_or_default);
        Segment { ends, next: next.filter(|_| !self.is(piece, LAST_PIECE)), first: self.is(piece, FIRST_PIECE) }
    }
}

pub(super) struct Balls<'a> {
    pub(super) points: Spheres<'a>,
}

impl Source for Balls<'_> {
    fn len(&self) -> usize {
        self.points.len()
    }

    #[inline(always)]
    fn bounds(&self, number: u32) -> Option<Aabb> {
        let ball = self.points.get(number as usize)?;
        if ball[3] > 0.0 { ball_box(&ball) } else { None }
    }

    fn extent(&self) -> Aabb {
        self.points.extent()
    }
}

impl LeafMaker for Balls<'_> {
    type Leaf = PointBlock;
    const RULE: LeafRule = LeafRule { capacity: 8, cost: 1.0 };
    const KIND: Kind = Kind::Smooth;

    fn leaf(&self, primitives: &[u32]) -> PointBlock {
        let mut block = PointBlock::EMPTY;
        for (lane, &point) in primitives.iter().enumerate() {
            block.set(lane, self.points.get(point as usize).unwrap_or_default(), point);
        }
        block
    }
}
