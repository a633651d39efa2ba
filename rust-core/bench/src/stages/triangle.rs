//! One ray against eight triangles, apart from the tree.

use crate::scenes::compiled;
use crate::{
    kernel::{Case, Kernel, Outcome, ROUNDING},
    scenes,
};
use gonio::accel::BlockTests;
use gonio::error::Result;
use gonio_simd::Execution;
use std::sync::atomic::AtomicBool;

/// Rays of a run; what they are tested against fits into the second-level cache.
const RAYS: usize = 1024;
/// Where they start, in the space of the car's body.
const EYE: [f32; 3] = [4.2, 1.2, 5.0];

struct Triangles {
    tests: BlockTests,
    hits: u32,
}

pub(super) fn cases(cancel: &AtomicBool) -> Result<Vec<Case>> {
    let scene = compiled(&scenes::car(), cancel)?;
    let meshes = scene.tables.bvh.meshes();
    let body = meshes.iter().max_by_key(|mesh| mesh.memory().triangles);
    let tests = body.map(|body| BlockTests::new(body, EYE, RAYS));
    Ok(tests.into_iter().map(|tests| Case::new("watertight test", "triangle", tests.count(), Triangles { tests, hits: 0 })).collect())
}

impl Kernel for Triangles {
    fn run(&mut self, execution: Execution) -> Result<()> {
        self.hits = self.tests.run(execution);
        Ok(())
    }
    fn outcome(&self) -> Outcome {
        // Without fused multiply-add a ray through an edge may count for one triangle more or less.
        Outcome { value: f64::from(self.hits), tolerance: 20.0 * ROUNDING }
    }
}
