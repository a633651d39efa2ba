//! Leaf of a tree of curves: up to eight pieces, each a cone with rounded ends or a flat ribbon.
//!
//! A piece is what a sphere sweeps whose centre goes from one end to the other while its radius changes evenly: the envelope is a cone that is
//! tangent to both end spheres. Pieces of a curve share their end spheres, so that the whole has no gaps. Of a shared sphere one piece has what lies
//! beyond both cones; surfaces are met from outside alone.

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
    /// Unit direction of the next piece; zero at the end of a curve.
    pub(crate) next: [[f32; WIDTH]; 3],
    /// Of the second end's sphere this piece has what lies no farther than this along `next`.
    pub(crate) limit: [f32; WIDTH],
    /// 1 for the first piece of a curve, which has the rounding of its first end, else 0.
    pub(crate) first: [f32; WIDTH],
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

/// What a piece has of a shared sphere beyond its share, over the radius and over the coordinates: no ray passes between two pieces for rounding.
pub(super) const OVERLAP: [f32; 2] = [1e-3, 4.0 * f32::EPSILON];

impl SegmentBlock {
    /// A block without pieces.
    pub(crate) const EMPTY: SegmentBlock = SegmentBlock {
        start: [[f32::NAN; WIDTH]; 3],
        axis: [[f32::NAN; WIDTH]; 3],
        radius: [[f32::NAN; WIDTH]; 2],
        next: [[0.0; WIDTH]; 3],
        limit: [0.0; WIDTH],
        first: [0.0; WIDTH],
        primitives: [NONE; WIDTH],
    };

    pub(crate) fn set(&mut self, lane: usize, segment: &Segment, primitive: u32) {
        let [a, b] = segment.ends;
        for k in 0..3 {
            self.start[k][lane] = a[k];
            self.axis[k][lane] = b[k] - a[k];
        }
        (self.radius[0][lane], self.radius[1][lane]) = (a[3], b[3] - a[3]);
        self.first[lane] = f32::from(segment.first);
        if let Some(next) = segment.next {
            let way = [0, 1, 2].map(|k| next[k] - b[k]);
            let length = way.iter().map(|x| x * x).sum::<f32>().sqrt();
            if length > 0.0 {
                let largest = b[..3].iter().fold(0.0f32, |most, x| most.max(x.abs()));
                (0..3).for_each(|k| self.next[k][lane] = way[k] / length);
                // Where the next cone begins to touch the sphere.
                self.limit[lane] = b[3] * ((b[3] - next[3]) / length) + OVERLAP[0] * b[3] + OVERLAP[1] * largest;
            }
        }
        self.primitives[lane] = primitive;
    }

    /// A lane's axis, and its radius at a share of it.
    pub(crate) fn lane(&self, lane: usize, share: f32) -> ([f32; 3], f32) {
        let axis = [self.axis[0][lane], self.axis[1][lane], self.axis[2][lane]];
        (axis, share.mul_add(self.radius[1][lane], self.radius[0][lane]))
    }
}
