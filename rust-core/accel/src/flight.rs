//! One ray of a stream: where it is, and the steps it takes. What it does next is told by a number, so that no step has to branch on it.

use super::blas::Blas;
use super::collector::{Collector, Hit, Query};
use super::instance::Geometry;
use super::lanes8::Lanes8;
use super::node::{ChildRef, KINDS, Kind, MAX_DEPTH, Node, WIDTH};
use super::prepared::PreparedRay;
use super::ray::{NONE, RayBatch};
use super::scene_bvh::SceneBvh;
use super::triangle_block::{BlockHits, TriangleBlock};
use super::wide::{Wide, meets};
use fearless_simd::{f32x4, prelude::*, u32x8};
use gonio_simd::{Sort8, prefetch_at};

/// What may wait in both levels, with the end and the room that a whole register of children takes.
const PENDING: usize = 2 * (MAX_DEPTH * (WIDTH - 1) + 1) + 1 + WIDTH;

/// The room of each list. Processors look for what was just stored by the last twelve bits of its address: with one and a half times 4096 bytes
/// and a cache line, the two lists of a ray differ in them, and those of its neighbours too.
const ROOM: usize = (4096 + 2048 + 64) / size_of::<u32>();
const _: () = assert!(PENDING <= ROOM);

/// Bits of a distance that the slot takes while children are sorted.
const SLOT_BITS: u32 = WIDTH as u32 - 1;

/// Children that wait: the bits of their distances, and what they are.
#[repr(C, align(64))]
pub(super) struct Pending {
    near: [u32; ROOM],
    child: [u32; ROOM],
}

impl Pending {
    /// None.
    pub(super) const EMPTY: Pending = Pending { near: [0; ROOM], child: [0; ROOM] };

    /// Eight places from `first` on.
    #[inline(always)]
    fn places(&mut self, first: usize) -> [&mut [u32; WIDTH]; 2] {
        let eight = |all| <&mut [u32; WIDTH]>::try_from(all).expect("eight of them");
        [eight(&mut self.near[first..first + WIDTH]), eight(&mut self.child[first..first + WIDTH])]
    }
}

/// A ray under way.
pub(super) struct Flight<'a, C: Collector> {
    /// In the world, and in the space of the mesh it is in.
    rays: [PreparedRay; 2],
    nodes: [&'a [Node]; 2],
    blocks: [&'a [TriangleBlock]; 2],
    /// Where in memory the children of a kind begin, for fetching them.
    addresses: [usize; KINDS],
    collector: C,
    /// Nothing beyond is of interest: the bits of the distance, and all of a slot.
    farthest: u32,
    /// The number of children that wait.
    waiting: usize,
    current: ChildRef,
    /// The instance that the ray is in.
    instance: u32,
    /// Whether that one may let shadow rays pass.
    transparent: bool,
    mask: u8,
    /// The ray's number in its batch, [`NONE`] without a ray.
    number: u32,
    /// Whether a hit ended the search.
    ended: bool,
}

impl<'a, C: Collector> Flight<'a, C> {
    /// Without a ray.
    pub(super) fn new(scene: &'a SceneBvh, collector: C) -> Self {
        let mut addresses = [0; KINDS];
        addresses[Kind::Inner as usize] = scene.nodes.as_ptr().addr();
        addresses[Kind::Instance as usize] = scene.records.as_ptr().addr();
        addresses[Kind::WorldTriangles as usize] = scene.blocks.as_ptr().addr();
        Flight {
            rays: [PreparedRay::NOTHING; 2],
            nodes: [&scene.nodes, &[]],
            blocks: [&scene.blocks, &[]],
            addresses,
            collector,
            farthest: 0,
            waiting: 0,
            current: ChildRef::ROOT,
            instance: NONE,
            transparent: false,
            mask: 0,
            number: NONE,
            ended: false,
        }
    }

    /// Takes up ray `i` for a query; false when it can hit nothing.
    #[inline(always)]
    pub(super) fn start<S: Simd, Q: Query<Collector = C>>(
        &mut self,
        simd: S,
        pending: &mut Pending,
        rays: &RayBatch,
        i: usize,
        query: &Q,
    ) -> bool {
        query.begin(&mut self.collector, i, rays.t_max[i]);
        (self.number, self.ended) = (i as u32, false);
        let [origin, direction] = [f32x4::from_slice(simd, &rays.origin_of(i)), f32x4::from_slice(simd, &rays.direction_of(i))];
        if !self.rays[0].prepare(simd, origin, direction, rays.t_min[i], rays.t_max[i]) {
            return false;
        }
        self.mask = rays.mask[i];
        self.shorten();
        pending.near[0] = 0;
        pending.child[0] = ChildRef::new(Kind::End, 0).0;
        self.waiting = 1;
        self.current = ChildRef::ROOT;
        true
    }

    /// Hands over what was found for its ray, if it has one, and lets go of it.
    #[inline(always)]
    pub(super) fn end<Q: Query<Collector = C>>(&mut self, query: &mut Q) {
        if self.number != NONE {
            query.end(self.number as usize, &self.collector, self.ended);
            self.number = NONE;
        }
    }

    /// Keeps in mind how far to look.
    #[inline(always)]
    fn shorten(&mut self) {
        self.farthest = self.collector.t_max().to_bits() | SLOT_BITS;
    }

    /// Goes on to the nearest child that waits.
    #[inline(always)]
    pub(super) fn go_on(&mut self, pending: &Pending) -> usize {
        loop {
            self.waiting -= 1;
            if !C::ORDERED || pending.near[self.waiting] <= self.farthest {
                self.current = ChildRef(pending.child[self.waiting]);
                let kind = self.current.kind();
                // Other rays take their steps before this one takes its next.
                prefetch_at(self.addresses[kind].wrapping_add(Kind::SIZES[kind] * self.current.index()), size_of::<Node>());
                return kind;
            }
        }
    }

    /// To the root of a mesh's tree.
    #[inline(always)]
    fn enter(&mut self, mesh: &'a Blas) -> usize {
        self.nodes[1] = &mesh.nodes;
        self.blocks[1] = &mesh.blocks;
        self.addresses[Kind::MeshInner as usize] = mesh.nodes.as_ptr().addr();
        self.addresses[Kind::Triangles as usize] = mesh.blocks.as_ptr().addr();
        self.current = ChildRef::new(Kind::MeshInner, 0);
        Kind::MeshInner as usize
    }

    /// Takes a hit; true when it ends the search.
    #[inline(always)]
    fn add(&mut self, hit: Hit, transparent: bool) -> bool {
        self.ended = self.collector.add(hit, transparent);
        self.shorten();
        self.ended
    }

    /// The step at a node.
    #[inline(always)]
    pub(super) fn inner<S: Simd>(&mut self, simd: S, pending: &mut Pending) {
        let space = self.current.space();
        let node = &self.nodes[space][self.current.index()];
        let (near, met) = meets(simd, node, &self.rays[space], self.collector.t_max());
        let children = u32x8::from_slice(simd, bytemuck::cast_ref::<_, [u32; WIDTH]>(&node.children)) | self.current.child_bits();
        let [distances, waiting] = pending.places(self.waiting);
        let mask = met.to_bitmask() as u32;
        if C::ORDERED {
            simd.sort8(near, mask, children, distances, waiting);
        } else {
            // Smallest box on top: often a leaf, and a likely end of the search.
            children.compress(met).store_slice(waiting);
        }
        self.waiting += mask.count_ones() as usize;
    }

    /// The step at a block of triangles.
    #[inline(always)]
    pub(super) fn triangles<S: Simd>(&mut self, simd: S) -> usize {
        let space = self.current.space();
        let block = &self.blocks[space][self.current.index()];
        let mut hits = BlockHits::default();
        let mut mask = Wide(simd).triangles(block, &self.rays[space], self.collector.t_max(), &mut hits);
        while mask != 0 {
            let lane = mask.trailing_zeros() as usize % WIDTH;
            mask &= mask - 1;
            let [t, u, v] = [hits.t[lane], hits.u[lane], hits.v[lane]];
            if self.add(Hit { t, u, v, primitive: block.primitives[lane], instance: self.instance }, self.transparent) {
                return Kind::End as usize;
            }
        }
        Kind::Next as usize
    }

    /// The step at a block of triangles in world space.
    #[inline(always)]
    pub(super) fn world_triangles<S: Simd>(&mut self, simd: S, scene: &SceneBvh) -> usize {
        let owner = scene.owners[self.current.index()];
        if owner.mask & self.mask == 0 {
            return Kind::Next as usize;
        }
        (self.instance, self.transparent) = (owner.id, owner.transparent);
        self.triangles(simd)
    }

    /// The step at an instance.
    #[inline(always)]
    pub(super) fn instance<S: Simd>(&mut self, simd: S, scene: &'a SceneBvh) -> usize {
        let record = &scene.records[self.current.index()];
        if record.mask & self.mask == 0 {
            return Kind::Next as usize;
        }
        (self.instance, self.transparent) = (record.id, record.transparent);
        let ([ray, image], map, t_max) = (&mut self.rays, &record.world_to_object, self.collector.t_max());
        match record.geometry.get() {
            Geometry::Mesh(index) => {
                let may_hit = if record.keeps_directions {
                    image.shift(simd, ray, map.translation(simd), t_max)
                } else {
                    let [origin, direction] = map.images(simd, &ray.origin, &ray.direction);
                    image.prepare(simd, origin, direction, ray.t_min, t_max)
                };
                if may_hit { self.enter(&scene.meshes[index as usize]) } else { Kind::Next as usize }
            }
            Geometry::Shape(shape) => {
                self.ended = record.meet_shape(shape, ray.origin, ray.direction, ray.t_min, &mut self.collector);
                self.shorten();
                if self.ended { Kind::End as usize } else { Kind::Next as usize }
            }
        }
    }
}
