//! Hair: round linear curves on a head, beside Embree's of the same kind.

use crate::embree::{self, EmbreeScene};
use crate::rays::{OwnedRays, Random, normalized};
use crate::{BATCH, print_row, timed};
use fearless_simd::Level;
use gonio::accel::{Blas, Care, FIRST_PIECE, Geometry, Hits, Instance, LAST_PIECE, NONE, Seen, Spheres, Tlas};
use gonio_simd::Execution;
use std::sync::{Arc, atomic::AtomicBool};

/// Pieces of a strand.
const PIECES: u32 = 10;
/// A strand's length over the head's radius, and its radius at the root.
const LENGTH: f32 = 0.5;
const RADIUS: f32 = 0.001;
/// Rays of the camera, a side of the picture.
const SIDE: usize = 512;

/// Points with radii, and the first point of each piece.
struct Hair {
    points: Vec<[f32; 4]>,
    pieces: Vec<u32>,
}

/// Strands that start all over a ball of radius 1, and fall.
fn head(strands: usize) -> Hair {
    let (mut random, mut hair) = (Random(11), Hair { points: Vec::new(), pieces: Vec::new() });
    for _ in 0..strands {
        let root = direction(&mut random);
        let (mut at, mut way) = (root, root);
        let wave = direction(&mut random);
        for piece in 0..=PIECES {
            let share = piece as f32 / PIECES as f32;
            hair.points.push([at[0], at[1], at[2], RADIUS * (1.0 - 0.8 * share)]);
            if piece < PIECES {
                hair.pieces.push(hair.points.len() as u32 - 1);
            }
            way = normalized([way[0] + 0.1 * wave[0], way[1] + 0.1 * wave[1], way[2] + 0.1 * wave[2] - 0.2]);
            at = [0, 1, 2].map(|k| at[k] + way[k] * LENGTH / PIECES as f32);
        }
    }
    hair
}

fn direction(random: &mut Random) -> [f32; 3] {
    let (phi, z) = (std::f32::consts::TAU * random.unit(), 2.0 * random.unit() - 1.0);
    let r = (1.0 - z * z).max(0.0).sqrt();
    [r * phi.cos(), r * phi.sin(), z]
}

fn scene(hair: &Hair) -> Tlas {
    let strand = |i: usize| i as u32 % PIECES;
    let ends = |i: usize| u32::from(strand(i) == 0) * FIRST_PIECE | u32::from(strand(i) + 1 == PIECES) * LAST_PIECE;
    let pieces: Vec<u32> = hair.pieces.iter().enumerate().map(|(i, piece)| piece | ends(i)).collect();
    let care = Care::of_scene(pieces.len());
    let tree = Blas::of_curves(Spheres::Together(&hair.points), &pieces, Seen::Solid, care, &AtomicBool::new(false)).expect("nobody cancels");
    let placed = Instance { geometry: Geometry::Mesh(0), object_to_world: Instance::IDENTITY, mask: 1, transparent: false };
    Tlas::build(vec![Arc::new(tree)], &[placed], &AtomicBool::new(false)).expect("nobody cancels")
}

/// Rays from a camera, pixels in tiles of 4 x 4.
fn camera() -> OwnedRays {
    let mut rays = OwnedRays::default();
    for i in 0..SIDE * SIDE {
        let (tile, k) = (i / 16, i % 16);
        let (x, y) = (tile % (SIDE / 4) * 4 + k % 4, tile / (SIDE / 4) * 4 + k / 4);
        let [x, y] = [x, y].map(|x| (x as f32 + 0.5) / SIDE as f32 - 0.5);
        rays.push([0.0, -4.0, 0.0], normalized([x, 1.0, -y]), 0.0, f32::INFINITY);
    }
    rays
}

/// Rays into all directions from a little before where others hit, or from outside.
fn scattered(rays: &OwnedRays, hits: &Hits, random: &mut Random) -> OwnedRays {
    let mut out = OwnedRays::default();
    for i in 0..rays.len() {
        let t = if hits.instance[i] == NONE { 3.0 } else { hits.t[i] - 2.0 * RADIUS };
        let from = [0, 1, 2].map(|k| rays.origin[k][i] + t * rays.direction[k][i]);
        out.push(from, direction(random), 0.0, f32::INFINITY);
    }
    out
}

/// Prints millions of rays a second of Embree, robust, and the others' ratios.
pub fn compare(strands: usize, runs: usize) {
    embree::flush_denormals();
    let level = Level::new();
    let hair = head(strands);
    println!("Embree {}; gonio: {}, level {level:?}", embree::version(), env!("RUSTC_VERSION"));
    println!("{} round pieces, {runs} interleaved runs, one thread", hair.pieces.len());
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread starts");
    let (own, built) = pool.install(|| {
        let start = embree::thread_seconds();
        (scene(&hair), embree::thread_seconds() - start)
    });
    let [robust, fast] = [true, false].map(|robust| EmbreeScene::of_curves(&hair.points, &hair.pieces, robust));
    println!(
        "built in {built:.2} s, Embree in {:.2} s; {:.0} bytes a piece",
        robust.build_processor_seconds,
        bytes(&own) / hair.pieces.len() as f64
    );
    let vector = Execution::Vector(level);
    println!("rays       M rays/s               own       own, packets        own, scalar  Embree, 16 packets       Embree, fast   differ");
    let mut random = Random(5);
    let mut rays = camera();
    for name in ["camera", "bounce 1", "bounce 2"] {
        first_hits(&own, &robust, &fast, vector, runs, name, &rays);
        occlusions(&own, &robust, &fast, vector, runs, &format!("shadow {name}"), &rays);
        let mut hits = Hits::default();
        own.first_hit(vector, &rays.batch(0, rays.len()), false, &mut hits);
        rays = scattered(&rays, &hits, &mut random);
    }
}

fn bytes(scene: &Tlas) -> f64 {
    scene.meshes().iter().map(|tree| tree.memory().bytes() as f64).sum()
}

fn first_hits(own: &Tlas, robust: &EmbreeScene, fast: &EmbreeScene, vector: Execution, runs: usize, name: &str, rays: &OwnedRays) {
    let mut seconds = vec![Vec::new(); 6];
    let (mut t, mut primitive, mut hits, mut differ) = (vec![0.0; BATCH], vec![0; BATCH], Hits::default(), 0);
    let batch = |first| rays.batch(first, BATCH);
    for run in 0..runs {
        seconds[0].push(timed(rays, |first| robust.first_hit(&batch(first), false, false, &mut t, &mut primitive)));
        seconds[1].push(timed(rays, |first| own.first_hit(vector, &batch(first), false, &mut hits)));
        seconds[2].push(timed(rays, |first| own.first_hit(vector, &batch(first), true, &mut hits)));
        seconds[3].push(timed(rays, |first| own.first_hit(Execution::Scalar, &batch(first), false, &mut hits)));
        seconds[4].push(timed(rays, |first| robust.first_hit(&batch(first), true, false, &mut t, &mut primitive)));
        seconds[5].push(timed(rays, |first| fast.first_hit(&batch(first), false, false, &mut t, &mut primitive)));
        if run == 0 {
            timed(rays, |first| {
                robust.first_hit(&batch(first), false, false, &mut t, &mut primitive);
                own.first_hit(vector, &batch(first), false, &mut hits);
                differ += primitive.iter().zip(&hits.primitive).filter(|(a, b)| a != b).count();
            });
        }
    }
    print_row(name, rays.len(), &seconds, differ);
}

fn occlusions(own: &Tlas, robust: &EmbreeScene, fast: &EmbreeScene, vector: Execution, runs: usize, name: &str, rays: &OwnedRays) {
    let mut seconds = vec![Vec::new(); 6];
    let (mut theirs, mut blocked, mut differ) = (vec![0; BATCH], vec![0; BATCH], 0);
    let batch = |first| rays.batch(first, BATCH);
    for run in 0..runs {
        seconds[0].push(timed(rays, |first| robust.occluded(&batch(first), false, &mut theirs)));
        seconds[1].push(timed(rays, |first| own.occluded(vector, &batch(first), false, &mut blocked)));
        seconds[2].push(timed(rays, |first| own.occluded(vector, &batch(first), true, &mut blocked)));
        seconds[3].push(timed(rays, |first| own.occluded(Execution::Scalar, &batch(first), false, &mut blocked)));
        seconds[4].push(timed(rays, |first| robust.occluded(&batch(first), true, &mut theirs)));
        seconds[5].push(timed(rays, |first| fast.occluded(&batch(first), false, &mut theirs)));
        if run == 0 {
            timed(rays, |first| {
                robust.occluded(&batch(first), false, &mut theirs);
                own.occluded(vector, &batch(first), false, &mut blocked);
                differ += theirs.iter().zip(&blocked).filter(|(a, b)| a != b).count();
            });
        }
    }
    print_row(name, rays.len(), &seconds, differ);
}
