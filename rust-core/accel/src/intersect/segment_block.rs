//! Leaves of trees of curves: up to eight pieces each, every one a cone with rounded ends or a flat ribbon.
//!
//! A piece is what a sphere sweeps whose centre goes from one end to the other while its radius changes evenly: the envelope is a cone that is
//! tangent to both end spheres. Pieces of a curve share their end spheres, so that the whole has no gaps. Of a shared sphere one piece has what lies
//! beyond both cones; surfaces are met from outside alone.
//!
//! A leaf has a row of words for each of the numbers below, as long as it has pieces: few leaves are full, and hair has millions of pieces.

use super::joint::Joint;
use crate::tree::node::WIDTH;

/// Rows of a leaf.
pub(super) mod row {
    /// Numbers of the pieces; in a tree's leaf the first one has the count of pieces in it ([`super::COUNT_SHIFT`]).
    pub(crate) const PRIMITIVE: usize = 0;
    /// How pieces are joined to their neighbours: [`super::Joint`].
    pub(crate) const JOINT: usize = 1;
    /// First end: x, y, z.
    pub(crate) const START: usize = 2;
    /// From the first end to the second: x, y, z.
    pub(crate) const AXIS: usize = 5;
    /// Radius at the first end, and how much more it is at the second.
    pub(crate) const RADIUS: usize = 8;
}

/// Rows of a leaf, all of them.
pub(crate) const ROWS: usize = 10;

/// Where the count of pieces, less one, lies in the first word of a tree's leaf.
pub(crate) const COUNT_SHIFT: u32 = 29;

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

impl Segment {
    /// A word a row.
    pub(crate) fn words(&self, primitive: u32) -> [u32; ROWS] {
        let [a, b] = self.ends;
        let joint = Joint::new(&b, self.next, self.first).0;
        let numbers = [a[0], a[1], a[2], b[0] - a[0], b[1] - a[1], b[2] - a[2], a[3], b[3] - a[3]].map(f32::to_bits);
        let [x, y, z, along_x, along_y, along_z, radius, growth] = numbers;
        [primitive, joint, x, y, z, along_x, along_y, along_z, radius, growth]
    }
}

/// A leaf as it is read: `count` words a row.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Segments<'a> {
    words: &'a [u32],
    count: usize,
}

impl<'a> Segments<'a> {
    /// The leaf of a tree that begins with these words.
    #[inline(always)]
    pub(crate) fn of_tree(words: &'a [u32]) -> Self {
        Segments { words, count: (words[0] >> COUNT_SHIFT) as usize + 1 }
    }

    /// Pieces.
    #[inline(always)]
    pub(crate) fn count(self) -> usize {
        self.count
    }

    /// Eight words from the beginning of a row: behind the last piece they are something else's.
    #[inline(always)]
    pub(crate) fn eight(self, row: usize) -> &'a [u32; WIDTH] {
        self.words.get(row * self.count..).and_then(|words| words.first_chunk()).unwrap_or(&[0; WIDTH])
    }

    /// The same as numbers.
    #[inline(always)]
    pub(crate) fn eight_numbers(self, row: usize) -> &'a [f32; WIDTH] {
        bytemuck::cast_ref(self.eight(row))
    }

    fn word(self, row: usize, lane: usize) -> u32 {
        self.words[row * self.count + lane]
    }

    fn three(self, row: usize, lane: usize) -> [f32; 3] {
        [0, 1, 2].map(|k| f32::from_bits(self.word(row + k, lane)))
    }

    /// A piece's number.
    pub(crate) fn primitive(self, lane: usize) -> u32 {
        self.word(row::PRIMITIVE, lane) & ((1 << COUNT_SHIFT) - 1)
    }

    pub(super) fn joint(self, lane: usize) -> Joint {
        Joint(self.word(row::JOINT, lane))
    }

    pub(super) fn start(self, lane: usize) -> [f32; 3] {
        self.three(row::START, lane)
    }

    pub(super) fn axis(self, lane: usize) -> [f32; 3] {
        self.three(row::AXIS, lane)
    }

    /// Radius at the first end, and how much more it is at the second.
    pub(super) fn radius(self, lane: usize) -> [f32; 2] {
        [0, 1].map(|k| f32::from_bits(self.word(row::RADIUS + k, lane)))
    }

    /// A lane's axis, and its radius at a share of it.
    pub(super) fn lane(self, lane: usize, share: f32) -> ([f32; 3], f32) {
        let [radius, growth] = self.radius(lane);
        (self.axis(lane), share.mul_add(growth, radius))
    }
}

/// A leaf on its own: room for eight pieces. Unused lanes hold NaN, which no test accepts.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SegmentBlock([u32; ROWS * WIDTH]);

impl SegmentBlock {
    /// A block without pieces.
    pub(crate) fn empty() -> Self {
        let mut words = [f32::NAN.to_bits(); ROWS * WIDTH];
        words[row::JOINT * WIDTH..][..WIDTH].fill(Joint::ALONE.0);
        SegmentBlock(words)
    }

    pub(crate) fn set(&mut self, lane: usize, segment: &Segment, primitive: u32) {
        for (row, word) in segment.words(primitive).into_iter().enumerate() {
            self.0[row * WIDTH + lane] = word;
        }
    }

    /// The block as it is read.
    #[inline(always)]
    pub(crate) fn segments(&self) -> Segments<'_> {
        Segments { words: &self.0, count: WIDTH }
    }
}
