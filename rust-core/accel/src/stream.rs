//! Thirty-two incoherent rays on their way at once, each a step at a time.
//!
//! A ray that walks alone waits: for memory, and for branches that no predictor knows, as what it meets next is as good as random. Here all rays
//! that are to do the same (test a node's boxes, a block of triangles, enter an instance, end) do it one after the other, without a
//! branch on what comes of it; it sorts each ray into the list of its next step, and has memory fetch what that step reads. The idea of queues
//! within the cache is that of Barringer and Akenine-Möller: Dynamic Ray Stream Traversal, ACM TOG 33(4), 2014; here rays are not grouped by
//! node but by step.

use super::collector::Query;
use super::flight::{Flight, Pending};
use super::node::{KINDS, Kind};
use super::ray::RayBatch;
use super::scene_bvh::SceneBvh;
use super::trial::{Numbers, Part};
use fearless_simd::prelude::*;
use std::cell::RefCell;

/// Rays under way: enough to hide memory, and few enough to stay in the first cache.
const FLIGHTS: usize = 32;

/// So many others are tested at nodes before a ray goes on to what it met there: what was just sorted and stored would be waited for.
const BEHIND: usize = 8;

/// Fewer rays than this walk one by one.
pub(super) const FEWEST_RAYS: usize = 2 * FLIGHTS;

/// The rays that wait for each kind of step, a bit each.
struct Lists([u32; KINDS]);

impl Lists {
    #[inline(always)]
    fn add(&mut self, kind: usize, flight: usize) {
        self.0[kind % KINDS] |= 1 << flight;
    }

    /// Takes a whole list off.
    #[inline(always)]
    fn take(&mut self, kind: Kind) -> List {
        List(std::mem::take(&mut self.0[kind as usize]))
    }
}

/// Places of rays.
struct List(u32);

impl Iterator for List {
    type Item = usize;

    #[inline(always)]
    fn next(&mut self) -> Option<usize> {
        let place = self.0.trailing_zeros() as usize % FLIGHTS;
        let more = self.0 != 0;
        self.0 &= self.0.wrapping_sub(1);
        more.then_some(place)
    }
}

/// What waits, by ray.
pub(super) type AllPending = [Pending; FLIGHTS];

thread_local! {
    /// Kept, as clearing it would take as long as some hundred rays.
    static PENDING: RefCell<Box<AllPending>> = RefCell::new(Box::new([Pending::EMPTY; FLIGHTS]));
}

/// Lends this thread's lists of what waits.
pub(super) fn with_pending(run: impl FnOnce(&mut AllPending)) {
    PENDING.with_borrow_mut(|pending| run(pending));
}

/// Sends the rays of a part of a batch through the scene.
#[inline(always)]
pub(super) fn stream<S: Simd, Q: Query>(simd: S, scene: &SceneBvh, rays: &RayBatch, part: Part, pending: &mut AllPending, query: &mut Q) {
    let rays = &rays.same_length();
    let mut flights: [Flight<Q::Collector>; FLIGHTS] = std::array::from_fn(|_| Flight::new(scene, query.collector()));
    let mut lists = Lists([0; KINDS]);
    lists.0[Kind::End as usize] = u32::MAX >> (u32::BITS as usize - FLIGHTS);
    let (mut numbers, mut under_way) = (part.of(rays.len()), FLIGHTS);
    while under_way > 0 {
        for place in lists.take(Kind::End) {
            let flight = &mut flights[place];
            flight.end(query);
            if take_up(simd, rays, &mut numbers, flight, &mut pending[place], query) {
                lists.add(Kind::Inner as usize, place);
            } else {
                under_way -= 1;
            }
        }
        for place in lists.take(Kind::Instance) {
            lists.add(flights[place].instance(simd, scene), place);
        }
        for place in lists.take(Kind::Triangles) {
            lists.add(flights[place].triangles(simd), place);
        }
        for place in lists.take(Kind::WorldTriangles) {
            lists.add(flights[place].world_triangles(simd, scene), place);
        }
        for place in lists.take(Kind::Next) {
            lists.add(flights[place].go_on(&pending[place]), place);
        }
        // Nodes of the scene and of meshes together: a list that ends sooner than foreseen costs more than what they differ by.
        let inner = List(lists.take(Kind::Inner).0 | lists.take(Kind::MeshInner).0);
        let mut tested = List(0);
        for (before, place) in inner.enumerate() {
            flights[place].inner(simd, &mut pending[place]);
            tested.0 |= 1 << place;
            if before >= BEHIND
                && let Some(place) = tested.next()
            {
                lists.add(flights[place].go_on(&pending[place]), place);
            }
        }
        for place in tested {
            lists.add(flights[place].go_on(&pending[place]), place);
        }
    }
}

/// Starts the next ray that can hit something; false when there is none.
#[inline(always)]
fn take_up<S: Simd, Q: Query>(
    simd: S,
    rays: &RayBatch,
    numbers: &mut Numbers,
    flight: &mut Flight<Q::Collector>,
    pending: &mut Pending,
    query: &mut Q,
) -> bool {
    for ray in numbers {
        if flight.start(simd, pending, rays, ray, query) {
            return true;
        }
        flight.end(query);
    }
    false
}
