//! Rays through the trees of the car, and of a head of hair, by class.

use crate::scenes::compiled;
use crate::{
    kernel::{Case, Kernel, Outcome, ROUNDING},
    numbers::{BATCH, Random},
    rays::Rays,
    scenes,
};
use gonio::accel::Hits;
use gonio::compile::{CompiledScene, View};
use gonio::error::Result;
use gonio::scene::{Scene, Settings};
use gonio_simd::Execution;
use std::sync::{Arc, atomic::AtomicBool};

/// Pixels a side: more rays than a batch, so that the tree does not stay in the first caches.
const SIDE: usize = 192;

/// What is asked of the tree.
#[derive(Clone, Copy, PartialEq)]
enum Query {
    Nearest,
    Any,
}

/// Rays of one class, batch by batch as the renderer has them.
struct Traversal {
    scene: Arc<CompiledScene>,
    rays: Rays,
    query: Query,
    /// Sixteen rays at a time at levels that have lanes.
    packets: bool,
    hits: Hits,
    blocked: Vec<u8>,
    /// Rays that hit, and the sum of their distances.
    found: (usize, f64),
}

pub(super) fn cases(cancel: &AtomicBool) -> Result<Vec<Case>> {
    let mut cases = of_scene("", &scenes::car(), cancel)?;
    cases.extend(of_scene("hair: ", &scenes::strands(), cancel)?);
    Ok(cases)
}

/// All classes of rays in a scene, whose name comes before theirs.
fn of_scene(scene_name: &str, scene: &Scene, cancel: &AtomicBool) -> Result<Vec<Case>> {
    let scene = compiled(scene, cancel)?;
    let settings = Settings { resolution: [SIDE as u32; 2], ..Settings::default() };
    let view = View::new(&scene, &settings, Execution::best())?;
    let (tables, mut random) = (&scene.tables, Random(1));
    let camera = Rays::camera(&view.camera, [SIDE; 2]);
    let first = camera.scattered(tables, &mut random);
    let second = first.scattered(tables, &mut random);
    let (shadow, shadow_later) = (camera.to_lights(tables, &mut random), first.to_lights(tables, &mut random));
    let case = |name: &str, rays: Rays, query: Query, packets: bool| {
        let count = rays.len();
        let (hits, blocked) = (Hits::default(), vec![0; BATCH]);
        let kernel = Traversal { scene: scene.clone(), rays, query, packets, hits, blocked, found: (0, 0.0) };
        Case::new(format!("{scene_name}{name}"), "ray", count, kernel)
    };
    Ok(vec![
        case("first bounce", first, Query::Nearest, false),
        case("second bounce (incoherent)", second, Query::Nearest, false),
        // After those by whose time the tree chooses how single rays walk.
        case("camera, single", camera.clone(), Query::Nearest, false),
        case("camera, packets", camera, Query::Nearest, true),
        case("shadow from first bounce", shadow_later, Query::Any, false),
        case("shadow from camera hits, single", shadow.clone(), Query::Any, false),
        case("shadow from camera hits, packets", shadow, Query::Any, true),
    ])
}

impl Traversal {
    fn nearest(&mut self, execution: Execution, first: usize) {
        let (bvh, rays) = (&self.scene.tables.bvh, self.rays.batch(first, BATCH));
        bvh.first_hit(execution, &rays, self.packets, &mut self.hits);
        let hits = self.hits.t.iter().zip(&self.hits.instance).filter(|(_, instance)| **instance != gonio::accel::NONE);
        for (t, _) in hits {
            self.found = (self.found.0 + 1, self.found.1 + f64::from(*t));
        }
    }

    fn any(&mut self, execution: Execution, first: usize) {
        let (bvh, rays) = (&self.scene.tables.bvh, self.rays.batch(first, BATCH));
        let blocked = &mut self.blocked[..rays.len()];
        bvh.occluded(execution, &rays, self.packets, blocked);
        self.found.0 += blocked.iter().filter(|blocked| **blocked != 0).count();
    }
}

impl Kernel for Traversal {
    fn run(&mut self, execution: Execution) -> Result<()> {
        self.found = (0, 0.0);
        for first in (0..self.rays.len()).step_by(BATCH) {
            match self.query {
                Query::Nearest => self.nearest(execution, first),
                Query::Any => self.any(execution, first),
            }
        }
        Ok(())
    }
    fn outcome(&self) -> Outcome {
        // Rays along edges may hit at one level and miss at another: watertight walks leave a handful in tens of thousands.
        Outcome { value: self.found.1 + self.found.0 as f64, tolerance: 5.0 * ROUNDING }
    }
}
