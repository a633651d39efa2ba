//! Nanoseconds a point for the Voronoi Texture at the scalar and the best level: `cargo run --release -p gonio-nodes --example bench_voronoi`.

use gonio_nodes::voronoi::{CellHash, Feature, Metric, Part, VoronoiTexture};
use gonio_simd::{Execution, Lanes, dispatch};
use std::time::Instant;

const POINTS: usize = 4096;

#[inline(always)]
fn sum<L: Lanes>(l: L, texture: &VoronoiTexture, places: &[Vec<f32>; 4], detail: f32) -> f32 {
    let mut sum = l.f(0.0);
    for at in (0..POINTS).step_by(L::COUNT) {
        let mut inputs = [l.f(1.0); 11];
        for (input, place) in inputs.iter_mut().zip(places) {
            *input = l.load(place, at);
        }
        inputs[5] = l.f(detail);
        for output in texture.evaluate(l, &inputs) {
            sum += output;
        }
    }
    sum.to_array().iter().sum()
}

/// The least of some runs, in nanoseconds a point.
fn time(execution: Execution, texture: &VoronoiTexture, places: &[Vec<f32>; 4], detail: f32) -> f64 {
    let mut least = f64::MAX;
    let begin = Instant::now();
    while begin.elapsed().as_millis() < 150 {
        let start = Instant::now();
        let sum = dispatch!(execution, l => sum(l, texture, places, detail));
        std::hint::black_box(sum);
        least = least.min(start.elapsed().as_secs_f64() * 1e9 / POINTS as f64);
    }
    least
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
    let best = Execution::best();
    println!("{:24} {:10} {:>5} {:>9} {:>9} {:>6}", "feature", "metric", "", "scalar", best.name(), "ratio");
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
        let [scalar, wide] = [Execution::Scalar, best].map(|execution| time(execution, &texture, &places, 0.0));
        let name = format!("{hash:?} {dimensions}D {feature:?}");
        println!("{name:24} {metric:?} {scalar:9.2} {wide:9.2} {:6.1}", scalar / wide);
    }
}
