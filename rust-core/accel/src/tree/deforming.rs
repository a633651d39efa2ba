//! BLASes of meshes whose points move while the shutter is open: boxes around all keys, and triangles between two keys at a ray's time.

use super::blas::{Blas, Care, Triangles, outline, sah_cost, triangle_box};
use super::node::WIDTH;
use crate::build::division::Source;
use crate::build::wide_tree::{WideTree, build};
use crate::cancelled::Cancelled;
use crate::intersect::smooth::Smooth;
use crate::intersect::triangle_block::TriangleBlock;
use crate::ray::NONE;
use gonio_simd::motion::segment_of;
use obvhs::aabb::Aabb;
use std::sync::atomic::AtomicBool;

impl Blas {
    /// [`Blas::build`] of a mesh whose points are given at two or more evenly spaced times over the shutter, as many each time.
    ///
    /// A triangle that [`Blas::build`] would leave out at any of the times is left out.
    pub fn build_deforming(keys: &[&[[f32; 3]]], triangles: &[[u32; 3]], care: Care, cancel: &AtomicBool) -> Result<Blas, Cancelled> {
        let first = Triangles { positions: keys[0], triangles };
        let WideTree { nodes, leaves: blocks, bounds, primitives } = build(&Keys { keys, triangles }, &first, care.effort(), cancel)?;
        let sah_cost = sah_cost(&nodes, &bounds);
        let outline = outline(&nodes, bounds);
        let key_blocks = blocks.iter().flat_map(|block| keys.iter().map(|points| at_key(block, points, triangles))).collect();
        Ok(Blas {
            nodes,
            blocks,
            key_blocks,
            keys: keys.len(),
            smooth: Smooth::Nothing,
            moving_smooth: None,
            outline,
            triangles: primitives,
            sah_cost,
        })
    }

    /// Whether its triangles stand still.
    #[inline(always)]
    pub fn is_still(&self) -> bool {
        self.keys == 0
    }

    /// A block of triangles that move, at a time.
    #[inline(never)]
    pub(crate) fn block_at(&self, block: usize, time: f32) -> TriangleBlock {
        let (number, share) = segment_of(time, self.keys - 1);
        let [from, to] = [0, 1].map(|next| &self.key_blocks[block * self.keys + number + next]);
        let mut between = *from;
        for (corner, rows) in between.vertices.iter_mut().enumerate() {
            for (axis, row) in rows.iter_mut().enumerate() {
                for (lane, x) in row.iter_mut().enumerate() {
                    *x += (to.vertices[corner][axis][lane] - *x) * share;
                }
            }
        }
        between
    }
}

/// The same triangles over other points.
fn at_key(block: &TriangleBlock, points: &[[f32; 3]], triangles: &[[u32; 3]]) -> TriangleBlock {
    let mut moved = TriangleBlock::EMPTY;
    for lane in (0..WIDTH).filter(|lane| block.primitives[*lane] != NONE) {
        let primitive = block.primitives[lane];
        let corners = triangles[primitive as usize].map(|point| points[point as usize]);
        moved.set(lane, corners, primitive);
    }
    moved
}

/// Triangles with the boxes of all keys together.
struct Keys<'a> {
    keys: &'a [&'a [[f32; 3]]],
    triangles: &'a [[u32; 3]],
}

impl Keys<'_> {
    fn at(&self, key: usize) -> Triangles<'_> {
        Triangles { positions: self.keys[key], triangles: self.triangles }
    }
}

impl Source for Keys<'_> {
    fn len(&self) -> usize {
        self.triangles.len()
    }

    fn bounds(&self, number: u32) -> Option<Aabb> {
        let mut all = Aabb::empty();
        for key in 0..self.keys.len() {
            all = all.union(&triangle_box(&self.at(key).corners_of(number)?)?);
        }
        // What lies between two keys is rounded once more.
        let pad = all.min.abs().max(all.max.abs()).max_element() * super::node::ROUNDING_PAD;
        Some(Aabb::new(all.min - pad, all.max + pad))
    }

    fn extent(&self) -> Aabb {
        (0..self.keys.len()).fold(Aabb::empty(), |all, key| all.union(&self.at(key).extent()))
    }
}
