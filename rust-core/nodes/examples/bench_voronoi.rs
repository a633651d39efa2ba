//! Nanoseconds a point for the Voronoi Texture, Gabor, brick and radial tiling at the scalar and the best level:
//! `cargo run --release -p gonio-nodes --example bench_voronoi`.

use gonio_nodes::voronoi::{CellHash, Feature, Metric, Part, VoronoiTexture};
use gonio_nodes::{BrickTexture, GaborTexture, RadialTiling, TilingPart};
use gonio_simd::{Execution, F, Lanes, dispatch};
use std::time::Instant;

const POINTS: usize = 4096;

/// A node with `N` inputs and `M` outputs.
trait Node<const N: usize, const M: usize> {
    fn evaluate<L: Lanes>(&self, l: L, inputs: &[F<L>; N]) -> [F<L>; M];
}

macro_rules! node {
    ($type:ty, $inputs:literal, $outputs:literal) => {
        impl Node<$inputs, $outputs> for $type {
            #[inline(always)]
            fn evaluate<L: Lanes>(&self, l: L, inputs: &[F<L>; $inputs]) -> [F<L>; $outputs] {
                <$type>::evaluate(self, l, inputs)
            }
        }
    };
}
node!(VoronoiTexture, 11, 4);
node!(GaborTexture, 10, 3);
node!(BrickTexture, 8, 2);
node!(RadialTiling, 4, 3);

/// The sum of outputs at all places; the inputs after the coordinates are the same everywhere.
#[inline(always)]
fn sum<L: Lanes, K: Node<N, M>, const N: usize, const M: usize>(l: L, node: &K, places: &[Vec<f32>], inputs: [f32; N]) -> f32 {
    let mut sum = l.f(0.0);
    for at in (0..POINTS).step_by(L::COUNT) {
        let mut registers = [l.f(0.0); N];
        for (register, input) in registers.iter_mut().zip(inputs) {
            *register = l.f(input);
        }
        for (register, place) in registers.iter_mut().zip(places) {
            *register = l.load(place, at);
        }
        for output in node.evaluate(l, &registers) {
            sum += output;
        }
    }
    sum.to_array().iter().sum()
}

/// Prints the least of some runs, in nanoseconds a point, at both levels.
#[allow(clippy::print_stdout, reason = "it is what this prints")]
fn report<K: Node<N, M>, const N: usize, const M: usize>(name: &str, node: &K, places: &[Vec<f32>], inputs: [f32; N]) {
    let mut times = [f64::MAX; 2];
    for (time, execution) in times.iter_mut().zip([Execution::Scalar, Execution::best()]) {
        let begin = Instant::now();
        while begin.elapsed().as_millis() < 150 {
            let start = Instant::now();
            std::hint::black_box(dispatch!(execution, l => sum(l, node, places, inputs)));
            *time = time.min(start.elapsed().as_secs_f64() * 1e9 / POINTS as f64);
        }
    }
    println!("{name:36} {:9.2} {:9.2} {:6.1}", times[0], times[1], times[0] / times[1]);
}

#[allow(clippy::print_stdout, reason = "it is what this prints")]
fn main() {
    let mut state = 1_u32;
    let mut places = [const { Vec::new() }; 4];
    for place in &mut places {
        place.resize_with(POINTS, || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            state as f32 / 1e8 - 20.0
        });
    }
    println!("{:36} {:>9} {:>9} {:>6}", "node", "scalar", Execution::best().name(), "ratio");
    let euclidean = [Feature::F1, Feature::F2, Feature::SmoothF1, Feature::DistanceToEdge, Feature::NSphereRadius];
    let mut settings = Vec::new();
    for hash in [CellHash::Pcg, CellHash::Lookup3] {
        for dimensions in 1..=4 {
            settings.extend(euclidean.map(|feature| (hash, dimensions, feature, Metric::Euclidean)));
        }
        settings.extend([Metric::Manhattan, Metric::Chebychev, Metric::Minkowski].map(|metric| (hash, 3, Feature::F1, metric)));
    }
    for (hash, dimensions, feature, metric) in settings {
        let texture = VoronoiTexture { dimensions, feature, metric, normalize: true, hash, part: Part::ColorDistance };
        let inputs = [0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.5, 2.0, 1.0, 1.5, 1.0];
        report(&format!("{hash:?} {dimensions}D {feature:?} {metric:?}"), &texture, &places, inputs);
    }
    for dimensions in [2, 3] {
        for anisotropy in [0.0, 1.0] {
            let inputs = [0.0, 0.0, 0.0, 1.0, 2.0, anisotropy, 0.7, 0.6, 0.5, 0.3];
            report(&format!("Gabor {dimensions}D, anisotropy {anisotropy}"), &GaborTexture { dimensions }, &places[..3], inputs);
        }
    }
    let brick = BrickTexture { offset: 0.5, offset_frequency: 2, squash: 0.8, squash_frequency: 3 };
    report("Brick", &brick, &places[..2], [0.0, 0.0, 1.0, 0.02, 0.1, 0.0, 0.5, 0.25]);
    for sides in [5.0, 5.3] {
        let tiling = RadialTiling { normalize: true, part: TilingPart::Coordinates };
        report(&format!("Radial tiling, {sides} sides"), &tiling, &places[..2], [0.0, 0.0, sides, 0.4]);
    }
}
