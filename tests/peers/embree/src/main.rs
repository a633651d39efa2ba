//! Rays a second of gonio and of Embree on the same rays: one thread, runs interleaved, medians of ratios.
//!
//! `cargo run --release [-- <detail> <runs> <plants>]`; detail 1 is a room of 280 thousand triangles, which grow with its square. With plants, a
//! field of so many instances stands in the room's place. `cargo run --release -- curves <strands> <runs>`: a head of hair, ten pieces a strand.

mod curves;
mod embree;
// What the Python module renders with: large pages, as Embree has them.
#[path = "../../../../rust-core/python/src/memory.rs"]
mod memory;
mod rays;
mod world;

use embree::EmbreeScene;
use fearless_simd::Level;
use gonio::accel::{Blas, Care, Geometry, Hits, Instance, Tlas};
use gonio_simd::Execution;
use rays::{OwnedRays, Random};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Instant;
use world::{Mesh, Placement, World};

/// Rays a call, as the renderer makes them.
const BATCH: usize = 4096;

fn main() {
    if std::env::args().nth(1).as_deref() == Some("curves") {
        let number = |place: usize, other: usize| std::env::args().nth(place).and_then(|a| a.parse().ok()).unwrap_or(other);
        return curves::compare(number(2, 100_000), number(3, 7));
    }
    let arguments: Vec<f32> = std::env::args().skip(1).filter_map(|a| a.parse().ok()).collect();
    let detail = arguments.first().copied().unwrap_or(1.0);
    let runs = arguments.get(1).map_or(7, |&n| n as usize);
    embree::flush_denormals();
    let level = Level::new();
    println!("Embree {} (system library), shim: {}", embree::version(), env!("SHIM_COMPILER"));
    println!("gonio: {}, release profile, level {level:?}", env!("RUSTC_VERSION"));
    let world = arguments.get(2).map_or_else(|| world::room(detail), |&plants| world::field(plants as u32));
    let (triangles, placed) = (world.triangles(), world.placements.len());
    println!("{triangles} triangles, {placed} placed meshes, {runs} interleaved runs, one thread, robust unless said otherwise\n");
    if placed == 1 {
        builds(&world, runs);
    }
    let (robust, fast) = (EmbreeScene::new(&world, true, 1), EmbreeScene::new(&world, false, 1));
    traversal(&Bench { vector: Execution::Vector(level), scene: scene(&world), robust, fast, runs }, &world);
}

fn tree(mesh: &Mesh, care: Care) -> Blas {
    Blas::build(&mesh.positions, &mesh.triangles, care, &AtomicBool::new(false)).expect("nobody cancels")
}

fn scene(world: &World) -> Tlas {
    let care = Care::of_scene(world.triangles());
    let trees = world.meshes.iter().map(|mesh| Arc::new(tree(mesh, care))).collect();
    let place = |p: &Placement| Instance { geometry: Geometry::Mesh(p.mesh), object_to_world: p.object_to_world, mask: 1, transparent: false };
    let instances: Vec<Instance> = world.placements.iter().map(place).collect();
    Tlas::build(trees, &instances, &AtomicBool::new(false)).expect("nobody cancels")
}

/// Builds on one thread (processor seconds) and on two (seconds of the clock) beside Embree's.
fn builds(world: &World, runs: usize) {
    let build = || tree(&world.meshes[0], Care::of_scene(world.triangles()));
    for threads in [1, 2] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
        let (mut own, mut theirs) = (Vec::new(), Vec::new());
        for _ in 0..runs {
            let (clock, processor) = pool.install(|| {
                let (start, processor) = (Instant::now(), embree::thread_seconds());
                drop(build());
                (start.elapsed().as_secs_f64(), embree::thread_seconds() - processor)
            });
            own.push(if threads == 1 { processor } else { clock });
            let scene = EmbreeScene::new(world, true, threads);
            theirs.push(if threads == 1 { scene.build_processor_seconds } else { scene.build_seconds });
        }
        let ratios: Vec<f64> = own.iter().zip(&theirs).map(|(a, b)| b / a).collect();
        let least = own.iter().copied().fold(f64::INFINITY, f64::min);
        let (own, theirs) = (median(own), median(theirs));
        let million = world.triangles() as f64 * 1e-6;
        println!(
            "build, {threads} threads: own {own:.3} s = {:.2} M triangles/s (best {:.2}), Embree medium {theirs:.3} s, ratio {:.2}",
            million / own,
            million / least,
            median(ratios)
        );
    }
    let memory = build().memory();
    println!("own tree: {:.1} bytes a triangle\n", memory.bytes() as f64 / memory.triangles as f64);
}

struct Bench {
    vector: Execution,
    scene: Tlas,
    robust: EmbreeScene,
    fast: EmbreeScene,
    runs: usize,
}

fn traversal(bench: &Bench, world: &World) {
    let mut random = Random(1);
    let primary = rays::primary(world, 1024, 512);
    let first = hits(bench, &primary);
    let bounce1 = rays::bounce(world, &primary, &first, &mut random);
    let second = hits(bench, &bounce1);
    let bounce2 = rays::bounce(world, &bounce1, &second, &mut random);
    let shadow1 = rays::shadow(world, &primary, &first, &mut random);
    let shadow2 = rays::shadow(world, &bounce1, &second, &mut random);
    println!("ratios to Embree rtcIntersect1 or rtcOccluded1, robust (median; least to largest)");
    println!(
        "{:10} {:>8} {:>18} {:>18} {:>18} {:>18} {:>18} {:>8}",
        "rays", "Mray/s", "own single", "own packet", "own scalar", "Embree packet", "Embree not robust", "differ"
    );
    first_hits(bench, "bounce 1", &bounce1, false);
    first_hits(bench, "bounce 2", &bounce2, false);
    // After those by whose time the tree chooses how single rays walk.
    first_hits(bench, "camera", &primary, true);
    occlusions(bench, "shadow 1", &shadow1);
    occlusions(bench, "shadow 2", &shadow2);
}

fn hits(bench: &Bench, rays: &OwnedRays) -> Hits {
    let mut hits = Hits::default();
    bench.scene.first_hit(bench.vector, &rays.batch(0, rays.len()), false, &mut hits);
    hits
}

/// Processor seconds of a pass over all batches.
fn timed(rays: &OwnedRays, mut batch: impl FnMut(usize)) -> f64 {
    let start = embree::thread_seconds();
    for first in (0..rays.len()).step_by(BATCH) {
        batch(first);
    }
    embree::thread_seconds() - start
}

fn first_hits(bench: &Bench, name: &str, rays: &OwnedRays, coherent: bool) {
    let mut seconds = vec![Vec::new(); 6];
    let (mut t, mut primitive) = (vec![0.0; BATCH], vec![0; BATCH]);
    let mut own = Hits::default();
    let mut differ = 0;
    for run in 0..bench.runs {
        let batch = |first| rays.batch(first, BATCH);
        seconds[0].push(timed(rays, |first| bench.robust.first_hit(&batch(first), false, coherent, &mut t, &mut primitive)));
        seconds[1].push(timed(rays, |first| bench.scene.first_hit(bench.vector, &batch(first), false, &mut own)));
        seconds[2].push(timed(rays, |first| bench.scene.first_hit(bench.vector, &batch(first), true, &mut own)));
        seconds[3].push(timed(rays, |first| bench.scene.first_hit(Execution::Scalar, &batch(first), false, &mut own)));
        seconds[4].push(timed(rays, |first| bench.robust.first_hit(&batch(first), true, coherent, &mut t, &mut primitive)));
        seconds[5].push(timed(rays, |first| bench.fast.first_hit(&batch(first), false, coherent, &mut t, &mut primitive)));
        if run == 0 {
            timed(rays, |first| {
                bench.robust.first_hit(&batch(first), false, coherent, &mut t, &mut primitive);
                bench.scene.first_hit(bench.vector, &batch(first), false, &mut own);
                differ += primitive.iter().zip(&own.primitive).filter(|(a, b)| a != b).count();
            });
        }
    }
    print_row(name, rays.len(), &seconds, differ);
}

fn occlusions(bench: &Bench, name: &str, rays: &OwnedRays) {
    let mut seconds = vec![Vec::new(); 6];
    let (mut theirs, mut own) = (vec![0; BATCH], vec![0; BATCH]);
    let mut differ = 0;
    for run in 0..bench.runs {
        let batch = |first| rays.batch(first, BATCH);
        seconds[0].push(timed(rays, |first| bench.robust.occluded(&batch(first), false, &mut theirs)));
        seconds[1].push(timed(rays, |first| bench.scene.occluded(bench.vector, &batch(first), false, &mut own)));
        seconds[2].push(timed(rays, |first| bench.scene.occluded(bench.vector, &batch(first), true, &mut own)));
        seconds[3].push(timed(rays, |first| bench.scene.occluded(Execution::Scalar, &batch(first), false, &mut own)));
        seconds[4].push(timed(rays, |first| bench.robust.occluded(&batch(first), true, &mut theirs)));
        seconds[5].push(timed(rays, |first| bench.fast.occluded(&batch(first), false, &mut theirs)));
        if run == 0 {
            timed(rays, |first| {
                bench.robust.occluded(&batch(first), false, &mut theirs);
                bench.scene.occluded(bench.vector, &batch(first), false, &mut own);
                differ += theirs.iter().zip(&own).filter(|(a, b)| a != b).count();
            });
        }
    }
    print_row(name, rays.len(), &seconds, differ);
}

fn print_row(name: &str, rays: usize, seconds: &[Vec<f64>], differ: usize) {
    print!("{name:10} {:8.2}", rays as f64 * 1e-6 / median(seconds[0].clone()));
    for column in &seconds[1..] {
        let mut ratios: Vec<f64> = seconds[0].iter().zip(column).map(|(embree, own)| embree / own).collect();
        ratios.sort_by(f64::total_cmp);
        let text = format!("{:.2} ({:.2}-{:.2})", median(ratios.clone()), ratios[0], ratios[ratios.len() - 1]);
        print!(" {text:>18}");
    }
    println!(" {differ:8}");
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
