//! The bottom-level acceleration structure (BLAS): the tree of one triangle mesh, or of curves or points.

use super::moving_smooth::MovingSmooth;
use super::node::{Bounds, ChildRef, Kind, LARGEST_COORDINATE, MAX_INDEX, Node, ROUNDING_PAD, WIDTH};
use crate::build::collapse::{LeafMaker, LeafRule};
use crate::build::division::Source;
use crate::build::effort::Effort;
use crate::build::split::Parts;
use crate::build::wide_tree::{WideTree, build};
use crate::cancelled::Cancelled;
use crate::intersect::smooth::Smooth;
use crate::intersect::triangle_block::TriangleBlock;
use glam::Vec3A;
use obvhs::aabb::Aabb;
use std::sync::atomic::AtomicBool;

/// Most boxes of an outline.
const OUTLINE: usize = 32;

/// Points that a mesh's extent is taken from.
const SAMPLES: usize = 1 << 16;

/// Bottom level (BLAS): the tree over the triangles of one mesh, or over curves or points, in object space. Share it between scenes by `Arc`.
#[derive(Debug)]
pub struct Blas {
    pub(crate) nodes: Vec<Node>,
    pub(crate) blocks: Vec<TriangleBlock>,
    /// Leaves of curves and points; then there are no triangles.
    pub(crate) smooth: Smooth,
    /// Of a mesh that deforms, as many blocks for each of `blocks` as it has keys.
    pub(crate) key_blocks: Vec<TriangleBlock>,
    /// Of curves and points that move, what their leaves are put together from at a ray's time.
    pub(crate) moving_smooth: Option<Box<MovingSmooth>>,
    /// Times at which the points are given, 0 for a mesh that stands still.
    pub(crate) keys: usize,
    /// Boxes that hold all triangles together, tighter than one: turned, they need less room. None for a tree without triangles.
    pub(crate) outline: Vec<Bounds>,
    pub(crate) triangles: usize,
    /// Surface area heuristic cost ([`sah_cost`]), as it was built.
    pub(crate) sah_cost: f32,
}

/// How much time goes into a [`Blas`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Care {
    /// As quick to build as rays through many triangles are worth.
    Quick,
    /// Several times as long, for rays that are about a tenth faster; long triangles that lie askew are put into several leaves each.
    Thorough,
}

/// So many triangles are built with more care in a fraction of a second.
const FEW_TRIANGLES: usize = 1 << 18;

impl Care {
    /// For the meshes of a scene that have so many triangles together.
    pub fn of_scene(triangles: usize) -> Care {
        if triangles <= FEW_TRIANGLES { Care::Thorough } else { Care::Quick }
    }

    pub(crate) fn effort(self) -> Effort {
        match self {
            Care::Quick => Effort::QUICK,
            Care::Thorough => Effort::THOROUGH,
        }
    }
}

/// Bytes held by a [`Blas`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BlasMemory {
    /// Bytes of the nodes.
    pub nodes: usize,
    /// Bytes of the blocks of triangles, pieces of curves or points.
    pub blocks: usize,
    /// Triangles, pieces of curves or points in the tree.
    pub triangles: usize,
}

impl BlasMemory {
    /// All bytes.
    pub fn bytes(&self) -> usize {
        self.nodes + self.blocks
    }
}

impl Blas {
    /// Builds the tree of a mesh: points `positions[n][3]` and triangles `triangles[m][3]` of point numbers.
    ///
    /// A triangle without area, or with a point that is missing, not finite, or beyond 1e12, is left out: no ray hits it. Runs in the current rayon pool.
    /// `cancel` is read between the steps of the build, which ends with [`Cancelled`] when it is set.
    pub fn build(positions: &[[f32; 3]], triangles: &[[u32; 3]], care: Care, cancel: &AtomicBool) -> Result<Blas, Cancelled> {
        assert!(triangles.len() <= MAX_INDEX, "a mesh holds at most {MAX_INDEX} triangles");
        let mesh = Triangles { positions, triangles };
        let parts = if care == Care::Thorough { Parts::of(&mesh) } else { None };
        let tree = match &parts {
            Some(parts) => WideTree { primitives: parts.triangles, ..build(parts, parts, care.effort(), cancel)? },
            None => build(&mesh, &mesh, care.effort(), cancel)?,
        };
        let WideTree { nodes, leaves: blocks, bounds, primitives } = tree;
        let sah_cost = sah_cost(&nodes, &bounds);
        let outline = outline(&nodes, bounds);
        Ok(Blas {
            nodes,
            blocks,
            key_blocks: Vec::new(),
            keys: 0,
            smooth: Smooth::Nothing,
            moving_smooth: None,
            outline,
            triangles: primitives,
            sah_cost,
        })
    }

    /// The bytes of the tree.
    pub fn memory(&self) -> BlasMemory {
        BlasMemory {
            nodes: self.nodes.capacity() * size_of::<Node>(),
            blocks: (self.blocks.capacity() + self.key_blocks.capacity()) * size_of::<TriangleBlock>()
                + self.smooth.memory()
                + self.moving_smooth.as_ref().map_or(0, |moving| moving.memory()),
            triangles: self.triangles,
        }
    }
}

/// The boxes of some nodes that hold all triangles of a tree in these bounds.
pub(crate) fn outline(nodes: &[Node], bounds: Bounds) -> Vec<Bounds> {
    let mut outline = vec![(bounds, ChildRef::ROOT)];
    let area = |(bounds, _): &(Bounds, ChildRef)| bounds.half_area();
    while outline.len() + WIDTH <= OUTLINE {
        let inner = (0..outline.len()).filter(|i| outline[*i].1.is_inner());
        let Some(opened) = inner.max_by(|a, b| area(&outline[*a]).total_cmp(&area(&outline[*b]))) else { break };
        let node = &nodes[outline.swap_remove(opened).1.index()];
        outline.extend((0..WIDTH).map(|slot| (node.bounds_of(slot), node.children[slot])).filter(|(bounds, _)| !bounds.is_empty()));
    }
    outline.into_iter().map(|(bounds, _)| bounds).filter(|bounds| !bounds.is_empty()).collect()
}

/// Surface area heuristic: the boxes that a ray through the root's box meets on average, from the areas of all boxes over that of the whole.
pub(crate) fn sah_cost(nodes: &[Node], bounds: &Bounds) -> f32 {
    let areas: f32 =
        nodes.iter().flat_map(|node| (0..WIDTH).map(|slot| node.bounds_of(slot))).filter(|b| !b.is_empty()).map(|b| b.half_area()).sum();
    areas / bounds.half_area().max(f32::MIN_POSITIVE)
}

/// A triangle's points, if the mesh has them all.
pub(crate) fn corners(positions: &[[f32; 3]], triangle: &[u32; 3]) -> Option<[[f32; 3]; 3]> {
    let [a, b, c] = triangle.map(|point| positions.get(point as usize));
    Some([*a?, *b?, *c?])
}

/// The padded box of a triangle, if all its coordinates are usable and it is more than a point or a line along an axis.
pub(crate) fn triangle_bounds(corners: &[[f32; 3]; 3]) -> Option<Bounds> {
    triangle_box(corners).map(|b| Bounds { min: b.min.to_array(), max: b.max.to_array() })
}

#[inline(always)]
pub(crate) fn triangle_box(corners: &[[f32; 3]; 3]) -> Option<Aabb> {
    let [a, b, c] = corners.map(Vec3A::from_array);
    let usable = |x: Vec3A| x.abs().cmple(Vec3A::splat(LARGEST_COORDINATE));
    let (min, max) = (a.min(b).min(c), a.max(b).max(c));
    let flat = min.cmpeq(max).bitmask().count_ones();
    let pad = min.abs().max(max.abs()).max_element() * ROUNDING_PAD;
    ((usable(a) & usable(b) & usable(c)).all() && flat < 2).then(|| Aabb::new(min - pad, max + pad))
}

/// What a mesh's tree is built over and put together from.
pub(crate) struct Triangles<'a> {
    pub(crate) positions: &'a [[f32; 3]],
    pub(crate) triangles: &'a [[u32; 3]],
}

impl Triangles<'_> {
    /// The points of a triangle, if there are all three.
    pub(crate) fn corners_of(&self, number: u32) -> Option<[[f32; 3]; 3]> {
        corners(self.positions, &self.triangles[number as usize])
    }
}

impl Source for Triangles<'_> {
    fn len(&self) -> usize {
        self.triangles.len()
    }

    #[inline(always)]
    fn bounds(&self, number: u32) -> Option<Aabb> {
        triangle_box(&corners(self.positions, &self.triangles[number as usize])?)
    }

    fn extent(&self) -> Aabb {
        let step = self.positions.len().div_ceil(SAMPLES).max(1);
        let points = self.positions.iter().step_by(step).map(|&point| Vec3A::from_array(point));
        let usable = points.filter(|point| point.abs().cmple(Vec3A::splat(LARGEST_COORDINATE)).all());
        usable.fold(Aabb::empty(), |all, point| all.union(&Aabb::from_point(point)))
    }
}

/// Makes blocks of up to eight triangles.
impl LeafMaker for Triangles<'_> {
    type Leaf = TriangleBlock;
    const RULE: LeafRule = LeafRule { capacity: 8, cost: 1.2 };
    const KIND: Kind = Kind::Triangles;

    fn leaf(&self, primitives: &[u32]) -> TriangleBlock {
        let mut block = TriangleBlock::EMPTY;
        for (lane, &primitive) in primitives.iter().enumerate() {
            let corners = self.triangles[primitive as usize].map(|i| self.positions[i as usize]);
            block.set(lane, corners, primitive);
        }
        block
    }
}
