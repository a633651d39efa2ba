//! A ray in a ray stream: its traversal state and its steps. Each step returns the number of the next queue, so no step branches on it.

use super::single::EMPTY_STACK;
use super::single_mesh::traverse_mesh;
use crate::hit_callback::{HitCallback, RayQuery};
use crate::intersect::leaf::{Leaf, LeafVisitor, RayAtLeaf};
use crate::intersect::prepared::PreparedRay;
use crate::intersect::smooth::Smooth;
use crate::intersect::triangle_block::TriangleBlock;
use crate::intersect::wide::{Wide, intersect_boxes};
use crate::ray::{NONE, RayBatch, RayMask};
use crate::tree::blas::Blas;
use crate::tree::instance::{InstanceRecord, Owner};
use crate::tree::node::{ChildRef, KINDS, Kind, MAX_DEPTH, Node, WIDTH};
use crate::tree::tlas::Tlas;
use fearless_simd::{f32x4, prelude::*, u32x8};
use gonio_simd::{Sort8, prefetch_at};

/// Entries of both levels at most, with the end and the room that a whole register of children takes.
const STACK_SIZE: usize = 2 * (MAX_DEPTH * (WIDTH - 1) + 1) + 1 + WIDTH;

/// The room of each column. Processors look for what was just stored by the last twelve bits of its address: with one and a half times 4096 bytes
/// and a cache line, the two columns of a ray differ in them, and those of its neighbours too.
const ROOM: usize = (4096 + 2048 + 64) / size_of::<u32>();
const _: () = assert!(STACK_SIZE <= ROOM);

/// The step of a ray whose stack is empty, or whose search is over.
pub(crate) const END: usize = KINDS;

/// The step of a ray that takes the next entry of its stack.
pub(crate) const NEXT: usize = KINDS + 1;

/// More than there are steps: those at children of each kind, and the two above. Four bits tell them apart.
pub(crate) const STEPS: usize = 16;

/// Bytes of what a reference of each kind refers to.
const SIZES: [usize; STEPS] = {
    let mut sizes = [0; STEPS];
    sizes[Kind::Inner as usize] = size_of::<Node>();
    sizes[Kind::MeshInner as usize] = size_of::<Node>();
    sizes[Kind::Instance as usize] = size_of::<InstanceRecord>();
    sizes[Kind::WorldTriangles as usize] = size_of::<TriangleBlock>();
    sizes[Kind::Triangles as usize] = size_of::<TriangleBlock>();
    sizes
};

/// Bits of a distance that the slot takes while children are sorted.
const SLOT_BITS: u32 = WIDTH as u32 - 1;

/// The traversal stack: the bits of the children's distances, and what they are.
#[repr(C, align(64))]
pub(crate) struct TraversalStack {
    near: [u32; ROOM],
    child: [u32; ROOM],
}

impl TraversalStack {
    /// Without entries.
    pub(crate) const EMPTY: TraversalStack = TraversalStack { near: [0; ROOM], child: [0; ROOM] };

    /// Eight entries from `first` on.
    #[inline(always)]
    fn places(&mut self, first: usize) -> [&mut [u32; WIDTH]; 2] {
        let eight = |all| <&mut [u32; WIDTH]>::try_from(all).expect("eight of them");
        [eight(&mut self.near[first..first + WIDTH]), eight(&mut self.child[first..first + WIDTH])]
    }
}

/// A ray in a stream.
pub(crate) struct StreamRay<'a, C: HitCallback> {
    /// In the world, and in the space of the mesh it is in.
    pub(super) rays: [PreparedRay; 2],
    nodes: [&'a [Node]; 2],
    blocks: [&'a [TriangleBlock]; 2],
    /// Leaves of the curves or points it is in.
    smooth: &'a Smooth,
    /// Where in memory the children of a kind begin, for fetching them.
    addresses: [usize; STEPS],
    pub(super) callback: C,
    /// Nothing beyond is of interest: the bits of the distance, and all of a slot.
    farthest: u32,
    /// Entries on the traversal stack.
    stacked: usize,
    pub(super) current: ChildRef,
    /// The instance that the ray is in.
    pub(super) owner: Owner,
    pub(super) mask: RayMask,
    pub(super) time: f32,
    /// The ray's number in its batch, [`NONE`] without a ray.
    number: u32,
    /// Whether a hit ended the search.
    ended: bool,
}

impl<'a, C: HitCallback> StreamRay<'a, C> {
    /// Without a ray.
    pub(crate) fn new(scene: &'a Tlas, callback: C) -> Self {
        let mut addresses = [0; STEPS];
        addresses[Kind::Inner as usize] = scene.nodes.as_ptr().addr();
        addresses[Kind::Instance as usize] = scene.records.as_ptr().addr();
        addresses[Kind::WorldTriangles as usize] = scene.blocks.as_ptr().addr();
        StreamRay {
            rays: [PreparedRay::NOTHING; 2],
            nodes: [&scene.nodes, &[]],
            blocks: [&scene.blocks, &[]],
            smooth: &Smooth::Nothing,
            addresses,
            callback,
            farthest: 0,
            stacked: 0,
            current: ChildRef::ROOT,
            owner: Owner { id: NONE, mask: 0, transparent: false },
            mask: 0,
            time: 0.5,
            number: NONE,
            ended: false,
        }
    }

    /// Starts ray `i` of a query; false when it can hit nothing.
    #[inline(always)]
    pub(crate) fn start<S: Simd, Q: RayQuery<Callback = C>>(
        &mut self,
        simd: S,
        stack: &mut TraversalStack,
        rays: &RayBatch,
        i: usize,
        query: &Q,
    ) -> bool {
        query.begin(&mut self.callback, i, rays.t_max[i]);
        (self.number, self.ended) = (i as u32, false);
        let [origin, direction] = [f32x4::from_slice(simd, &rays.origin_of(i)), f32x4::from_slice(simd, &rays.direction_of(i))];
        if !self.rays[0].prepare(simd, origin, direction, rays.t_min[i], rays.t_max[i]) {
            return false;
        }
        self.mask = rays.mask[i];
        self.time = rays.time_of(i);
        self.shorten();
        stack.near[0] = 0;
        stack.child[0] = ChildRef::END.0;
        self.stacked = 1;
        self.current = ChildRef::ROOT;
        true
    }

    /// Hands over what was found for its ray, if it has one, and drops it.
    #[inline(always)]
    pub(crate) fn end<Q: RayQuery<Callback = C>>(&mut self, query: &mut Q) {
        if self.number != NONE {
            query.end(self.number as usize, &self.callback, self.ended);
            self.number = NONE;
        }
    }

    /// Updates how far to look.
    #[inline(always)]
    fn shorten(&mut self) {
        self.farthest = self.callback.t_max().to_bits() | SLOT_BITS;
    }

    /// Pops the nearest child off the traversal stack.
    #[inline(always)]
    pub(crate) fn pop(&mut self, stack: &TraversalStack) -> usize {
        loop {
            self.stacked -= 1;
            if !C::ORDERED || stack.near[self.stacked] <= self.farthest {
                self.current = ChildRef(stack.child[self.stacked]);
                let kind = self.current.kind_or_end() % STEPS;
                // Other rays take their steps before this one takes its next.
                prefetch_at(self.addresses[kind].wrapping_add(SIZES[kind] * self.current.index()), size_of::<Node>());
                return kind;
            }
        }
    }

    /// To the root of a mesh's tree.
    #[inline(always)]
    pub(super) fn enter(&mut self, mesh: &'a Blas) -> usize {
        self.nodes[1] = &mesh.nodes;
        self.blocks[1] = &mesh.blocks;
        self.smooth = &mesh.smooth;
        self.addresses[Kind::MeshInner as usize] = mesh.nodes.as_ptr().addr();
        self.addresses[Kind::Triangles as usize] = mesh.blocks.as_ptr().addr();
        self.current = ChildRef::new(Kind::MeshInner, 0);
        Kind::MeshInner as usize
    }

    /// Through a mesh that deforms, to the end: its triangles are not those in memory.
    #[inline(always)]
    pub(super) fn pass_deforming<S: Simd>(&mut self, simd: S, mesh: &Blas) -> usize {
        let (ray, at) = (self.rays[1], (self.owner, self.time));
        let mut stack = EMPTY_STACK;
        let callback = &mut self.callback;
        let ended = simd.vectorize(
            #[inline(always)]
            || traverse_mesh(Wide(simd), mesh, ChildRef::ROOT, &ray, at, &mut stack, callback),
        );
        self.go_on(ended)
    }

    /// Tests a leaf with its image in a space.
    #[inline(always)]
    pub(super) fn test<S: Simd, L: Leaf>(&mut self, simd: S, space: usize, leaf: L) -> usize {
        let at_leaf = RayAtLeaf { lanes: Wide(simd), ray: &self.rays[space], owner: self.owner, callback: &mut self.callback };
        let ended = at_leaf.visit(leaf);
        self.go_on(ended)
    }

    /// After a search that may have ended.
    #[inline(always)]
    pub(super) fn go_on(&mut self, ended: bool) -> usize {
        self.ended = ended;
        self.shorten();
        if ended { END } else { NEXT }
    }

    /// The step at a node.
    #[inline(always)]
    pub(crate) fn inner<S: Simd>(&mut self, simd: S, stack: &mut TraversalStack) {
        let space = self.current.space();
        let node = &self.nodes[space][self.current.index()];
        let (near, met) = intersect_boxes(simd, node, &self.rays[space], self.callback.t_max());
        let children = u32x8::from_slice(simd, bytemuck::cast_ref::<_, [u32; WIDTH]>(&node.children)) | self.current.child_bits();
        let [distances, stacked] = stack.places(self.stacked);
        let mask = met.to_bitmask() as u32;
        if C::ORDERED {
            simd.sort8(near, mask, children, distances, stacked);
        } else {
            // Smallest box on top: often a leaf, and a likely end of the search.
            simd.pack8(met, children, stacked);
        }
        self.stacked += mask.count_ones() as usize;
    }

    /// The step at a block of triangles.
    #[inline(always)]
    pub(crate) fn triangles<S: Simd>(&mut self, simd: S) -> usize {
        let space = self.current.space();
        self.test(simd, space, &self.blocks[space][self.current.index()])
    }

    /// The step at a block of pieces of curves or of points.
    #[inline(always)]
    pub(crate) fn smooth<S: Simd>(&mut self, simd: S) -> usize {
        self.test(simd, 1, self.smooth.leaf(self.current.index()))
    }
}
