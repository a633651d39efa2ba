//! Ray streams: traversal by thirty-two incoherent rays at once, each a step at a time.
//!
//! A single ray waits for memory, and for branches that no predictor knows: what it meets next is as good as random. Here every kind of step (test
//! a node's boxes, test a block of triangles or of curves, enter an instance, end) has a queue of rays. The rays of a queue take their step one after the other,
//! without a branch on its outcome. Each goes to the queue of its next step, and memory fetches what that step reads. Queues within the cache are
//! the idea of Barringer and Akenine-Möller: Dynamic Ray Stream Traversal, ACM TOG 33(4), 2014. There rays are grouped by node, here by step.

use super::stream_ray::{END, NEXT, STEPS, StreamRay, TraversalStack};
use super::stream_tuner::{Numbers, Part};
use crate::hit_callback::RayQuery;
use crate::ray::RayBatch;
use crate::tree::node::Kind;
use crate::tree::tlas::Tlas;
use fearless_simd::prelude::*;
use std::cell::RefCell;

/// Rays under way: enough to hide memory, and few enough to stay in the first cache.
const STREAM_WIDTH: usize = 32;

/// So many others are tested at nodes before a ray goes on to what it met there: what was just sorted and stored would be waited for.
const BEHIND: usize = 8;

/// Fewer rays than this are traced one by one.
pub(crate) const FEWEST_RAYS: usize = 2 * STREAM_WIDTH;

/// A queue of rays for each step, a bit a ray.
struct StepQueues([u32; STEPS]);

impl StepQueues {
    #[inline(always)]
    fn add(&mut self, step: usize, ray: usize) {
        self.0[step % STEPS] |= 1 << ray;
    }

    /// Takes all rays out of a queue.
    #[inline(always)]
    fn take(&mut self, step: usize) -> StepQueue {
        StepQueue(std::mem::take(&mut self.0[step]))
    }
}

/// Places of the rays in a queue.
struct StepQueue(u32);

impl Iterator for StepQueue {
    type Item = usize;

    #[inline(always)]
    fn next(&mut self) -> Option<usize> {
        let place = self.0.trailing_zeros() as usize % STREAM_WIDTH;
        let more = self.0 != 0;
        self.0 &= self.0.wrapping_sub(1);
        more.then_some(place)
    }
}

/// The traversal stacks of all rays of a stream.
pub(crate) type StreamStacks = [TraversalStack; STREAM_WIDTH];

thread_local! {
    /// Kept, as clearing them would take as long as some hundred rays.
    static STACKS: RefCell<Box<StreamStacks>> = RefCell::new(Box::new([TraversalStack::EMPTY; STREAM_WIDTH]));
}

/// Runs something with this thread's traversal stacks.
pub(crate) fn with_stacks(run: impl FnOnce(&mut StreamStacks)) {
    STACKS.with_borrow_mut(|stacks| run(stacks));
}

/// Sends the rays of a part of a batch through the scene.
#[inline(always)]
pub(crate) fn stream<S: Simd, Q: RayQuery>(simd: S, scene: &Tlas, rays: &RayBatch, part: Part, stacks: &mut StreamStacks, query: &mut Q) {
    let rays = &rays.same_length();
    let mut streamed: [StreamRay<Q::Callback>; STREAM_WIDTH] = std::array::from_fn(|_| StreamRay::new(scene, query.callback()));
    let mut queues = StepQueues([0; STEPS]);
    queues.0[END] = u32::MAX >> (u32::BITS as usize - STREAM_WIDTH);
    let (mut numbers, mut under_way) = (part.of(rays.len()), STREAM_WIDTH);
    while under_way > 0 {
        for place in queues.take(END) {
            let ray = &mut streamed[place];
            ray.end(query);
            if start(simd, rays, &mut numbers, ray, &mut stacks[place], query) {
                queues.add(Kind::Inner as usize, place);
            } else {
                under_way -= 1;
            }
        }
        for place in queues.take(Kind::Instance as usize) {
            queues.add(streamed[place].instance(simd, scene), place);
        }
        for place in queues.take(Kind::Triangles as usize) {
            queues.add(streamed[place].triangles(simd), place);
        }
        for place in queues.take(Kind::WorldTriangles as usize) {
            queues.add(streamed[place].world_triangles(simd, scene), place);
        }
        for place in queues.take(Kind::Smooth as usize) {
            queues.add(streamed[place].smooth(simd), place);
        }
        for place in queues.take(NEXT) {
            queues.add(streamed[place].pop(&stacks[place]), place);
        }
        // Nodes of the scene and of meshes together: a queue that ends sooner than foreseen costs more than what they differ by.
        let inner = StepQueue(queues.take(Kind::Inner as usize).0 | queues.take(Kind::MeshInner as usize).0);
        let mut tested = StepQueue(0);
        for (before, place) in inner.enumerate() {
            streamed[place].inner(simd, &mut stacks[place]);
            tested.0 |= 1 << place;
            if before >= BEHIND
                && let Some(place) = tested.next()
            {
                queues.add(streamed[place].pop(&stacks[place]), place);
            }
        }
        for place in tested {
            queues.add(streamed[place].pop(&stacks[place]), place);
        }
    }
}

/// Starts the next ray that can hit something; false when there is none.
#[inline(always)]
fn start<S: Simd, Q: RayQuery>(
    simd: S,
    rays: &RayBatch,
    numbers: &mut Numbers,
    ray: &mut StreamRay<Q::Callback>,
    stack: &mut TraversalStack,
    query: &mut Q,
) -> bool {
    for number in numbers {
        if ray.start(simd, stack, rays, number, query) {
            return true;
        }
        ray.end(query);
    }
    false
}
