//! The Voronoi Texture against Cycles, between levels, and with awkward inputs.

mod common;

use common::{Numbers, hostile, inputs, run, table};
use gonio_nodes::voronoi::{CellHash, Feature, Metric, Part, VoronoiTexture};
use gonio_simd::Execution;

node!(VoronoiTexture, 11, 4);

fn texture(words: &[String], part: Part) -> VoronoiTexture {
    VoronoiTexture {
        hash: if words[1] == "pcg" { CellHash::Pcg } else { CellHash::Lookup3 },
        dimensions: words[2].parse().expect("dimensions"),
        feature: match words[3].as_str() {
            "F1" => Feature::F1,
            "F2" => Feature::F2,
            "SMOOTH_F1" => Feature::SmoothF1,
            "DISTANCE_TO_EDGE" => Feature::DistanceToEdge,
            _ => Feature::NSphereRadius,
        },
        metric: match words[4].as_str() {
            "EUCLIDEAN" => Metric::Euclidean,
            "MANHATTAN" => Metric::Manhattan,
            "CHEBYCHEV" => Metric::Chebychev,
            _ => Metric::Minkowski,
        },
        normalize: words[5] == "1",
        part,
    }
}

/// The largest difference, relative to numbers above 1.
fn difference(a: &[f32], b: &[f32]) -> f32 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs() / b.abs().max(1.0)).fold(0.0, f32::max)
}

/// All settings but the parts.
fn all_settings() -> Vec<VoronoiTexture> {
    let mut all = Vec::new();
    for hash in [CellHash::Lookup3, CellHash::Pcg] {
        for dimensions in 1..=4 {
            for metric in [Metric::Euclidean, Metric::Manhattan, Metric::Chebychev, Metric::Minkowski] {
                for feature in [Feature::F1, Feature::F2, Feature::SmoothF1, Feature::DistanceToEdge, Feature::NSphereRadius] {
                    for part in [Part::ColorDistance, Part::Position] {
                        all.push(VoronoiTexture { dimensions, feature, metric, normalize: all.len() % 3 > 0, hash, part });
                    }
                }
            }
        }
    }
    all
}

#[test]
fn it_is_what_cycles_computes() {
    for execution in Execution::all() {
        for group in table(include_str!("data/voronoi.txt")) {
            for (part, from) in [(Part::ColorDistance, 0), (Part::Position, 4)] {
                let texture = texture(&group.words, part);
                for (own, (at, theirs)) in run(execution, &texture, &inputs(&group)).iter().zip(&group.points) {
                    let theirs = &theirs[from..from + 4];
                    assert!(difference(own, theirs) < 1e-5, "{} {texture:?} at {at:?}: {own:?}, not {theirs:?}", execution.name());
                }
            }
        }
    }
}

#[test]
fn levels_agree() {
    let mut numbers = Numbers(7);
    let mut points = Vec::new();
    for _ in 0..48 {
        let mut at = [0.0; 11];
        for (value, (low, high)) in at.iter_mut().zip([
            (-4.0, 4.0),
            (-4.0, 4.0),
            (-4.0, 4.0),
            (-4.0, 4.0),
            (0.5, 3.0),
            (0.0, 2.5),
            (0.2, 1.0),
            (1.5, 2.5),
            (0.1, 1.0),
            (0.5, 3.0),
            (0.0, 1.0),
        ]) {
            *value = low + (high - low) * numbers.next();
        }
        points.push(at);
    }
    let (mut all, mut off) = (0, 0);
    for texture in all_settings() {
        let scalar = run(Execution::Scalar, &texture, &points);
        for execution in Execution::all() {
            for (own, scalar) in run(execution, &texture, &points).iter().zip(&scalar) {
                all += 1;
                off += usize::from(difference(own, scalar) > 2e-5);
            }
        }
    }
    // Two points at equal distances may change places by rounding.
    assert!(off * 2000 < all, "{off} of {all} points differ");
}

#[test]
fn outputs_are_finite_for_finite_inputs() {
    let points = hostile::<11>(64);
    for texture in all_settings() {
        for execution in Execution::all() {
            for (at, own) in points.iter().zip(run(execution, &texture, &points)) {
                let finite = at.iter().all(|value| value.is_finite());
                assert!(!finite || own.iter().all(|value| value.is_finite()), "{} {texture:?} at {at:?}: {own:?}", execution.name());
            }
        }
    }
}

#[test]
fn normalized_outputs_are_bounded() {
    let mut numbers = Numbers(11);
    let mut points = Vec::new();
    for _ in 0..256 {
        points.push([0.0, 1.0, 2.0, 3.0, 7.0, 0.7, 0.5, 2.0, 0.5, 2.0, 1.0].map(|value| value + numbers.next() * 0.3));
    }
    for texture in all_settings().into_iter().filter(|texture| texture.normalize && texture.part == Part::ColorDistance) {
        for own in run(Execution::best(), &texture, &points) {
            let low = if texture.feature == Feature::SmoothF1 { -0.5 } else { 0.0 };
            assert!(own.iter().all(|value| (low..=1.0).contains(value)), "{texture:?}: {own:?}");
        }
    }
}

#[test]
fn settings_survive_json() {
    for texture in all_settings() {
        let text = serde_json::to_string(&texture).unwrap();
        assert_eq!(serde_json::from_str::<VoronoiTexture>(&text).unwrap(), texture);
    }
}
