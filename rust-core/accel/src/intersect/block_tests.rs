//! Triangle tests apart from any tree, for the benchmark: the inner operation of every traversal.

use super::lanes8::Lanes8;
use super::prepared::PreparedRay;
use super::scalar::Scalar;
use super::triangle_block::{BlockHits, TriangleBlock};
use super::wide::Wide;
use crate::tree::blas::Blas;
use crate::tree::node::WIDTH;
use gonio_simd::Execution;
use gonio_simd::dispatch_level;

/// Leaves that each ray is tested against: one that it hits, and the next.
const LEAVES: usize = 2;

/// Rays and the leaves of a mesh that they are tested against.
#[derive(Debug)]
pub struct BlockTests {
    blocks: Vec<TriangleBlock>,
    rays: Vec<PreparedRay>,
    /// First leaf of each ray.
    first: Vec<usize>,
}

impl BlockTests {
    /// Up to `count` rays from one point to the middles of triangles all over the mesh.
    pub fn new(blas: &Blas, origin: [f32; 3], count: usize) -> Self {
        let mut tests = Self { blocks: blas.blocks.clone(), rays: Vec::new(), first: Vec::new() };
        let leaves = tests.blocks.len().saturating_sub(LEAVES - 1);
        for i in 0..count.min(leaves) {
            let first = i * leaves / count.min(leaves);
            let block = &blas.blocks[first];
            let lane = i % block.len().max(1);
            let middle = |axis: usize| block.vertices.iter().map(|corner| corner[axis][lane]).sum::<f32>() / 3.0;
            let direction = [0, 1, 2].map(|axis| middle(axis) - origin[axis]);
            if let Some(ray) =
                PreparedRay::new([origin[0], origin[1], origin[2], 0.0], [direction[0], direction[1], direction[2], 0.0], 0.0, f32::MAX)
            {
                tests.rays.push(ray);
                tests.first.push(first);
            }
        }
        tests
    }

    /// Tests of one ray and one triangle in a run, counting empty places of leaves.
    pub fn count(&self) -> usize {
        self.rays.len() * LEAVES * WIDTH
    }

    /// Runs all tests; gives the number of hits.
    pub fn run(&self, execution: Execution) -> u32 {
        match execution {
            Execution::Scalar => count_hits(Scalar, self),
            Execution::Vector(level) => dispatch_level!(level, simd => count_hits(Wide(simd), self)),
        }
    }
}

#[inline(always)]
fn count_hits<K: Lanes8>(lanes: K, tests: &BlockTests) -> u32 {
    let mut hits = BlockHits::default();
    let mut count = 0;
    for (ray, first) in tests.rays.iter().zip(&tests.first) {
        for block in tests.blocks[*first..].iter().take(LEAVES) {
            count += lanes.leaf(block, ray, f32::MAX, &mut hits).count_ones();
        }
    }
    count
}
