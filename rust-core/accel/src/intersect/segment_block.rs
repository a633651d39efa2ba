//! Leaf of a tree of curves: up to eight pieces, each a cone with rounded ends or a flat ribbon; five cache lines.
//!
//! A piece is what a sphere sweeps whose centre goes from one end to the other while its radius changes evenly: the envelope is a cone that is
//! tangent to both end spheres. Pieces of a curve share their end spheres, so that the whole has no gaps. Of a shared sphere one piece has what lies
//! beyond both cones; surfaces are met from outside alone.

use super::joint::Joint;
use crate::ray::NONE;
use crate::tree::node::WIDTH;
use bytemuck::{Pod, Zeroable};

/// Up to eight pieces of curves; unused lanes hold NaN, which no test accepts.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C, align(64))]
pub(crate) struct SegmentBlock {
    /// First end: `start[axis][lane]`.
    pub(crate) start: [[f32; WIDTH]; 3],
    /// From the first end to the second.
    pub(crate) axis: [[f32; WIDTH]; 3],
    /// Radius at the first end, and how much more it is at the second.
    pub(crate) radius: [[f32; WIDTH]; 2],
    /// How pieces are joined to their neighbours: [`Joint`].
    pub(crate) joint: [u32; WIDTH],
    /// Numbers of the pieces, [`NONE`] in unused lanes.
    pub(crate) primitives: [u32; WIDTH],
}

/// A piece of a curve.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Segment {
    /// Ends: x, y, z, radius.
    pub(crate) ends: [[f32; 4]; 2],
    /// The second end of the piece after this one, if the curve goes on.
    pub(crate) next: Option<[f32; 4]>,
    /// Whether the curve begins here.
    pub(crate) first: bool,
}

impl SegmentBlock {
    /// A block without pieces.
    pub(crate) const EMPTY: SegmentBlock = SegmentBlock {
        start: [[f32::NAN; WIDTH]; 3],
        axis: [[f32::NAN; WIDTH]; 3],
        radius: [[f32::NAN; WIDTH]; 2],
        joint: [Joint::ALONE.0; WIDTH],
        primitives: [NONE; WIDTH],
    };

    pub(crate) fn set(&mut self, lane: usize, segment: &Segment, primitive: u32) {
        let [a, b] = segment.ends;
        for k in 0..3 {
            self.start[k][lane] = a[k];
            self.axis[k][lane] = b[k] - a[k];
        }
        (self.radius[0][lane], self.radius[1][lane]) = (a[3], b[3] - a[3]);
        self.joint[lane] = Joint::new(&b, segment.next, segment.first).0;
        self.primitives[lane] = primitive;
    }

    /// A lane's axis, and its radius at a share of it.
    pub(crate) fn lane(&self, lane: usize, share: f32) -> ([f32; 3], f32) {
        let axis = [self.axis[0][lane], self.axis[1][lane], self.axis[2][lane]];
        (axis, share.mul_add(self.radius[1][lane], self.radius[0][lane]))
    }
}
