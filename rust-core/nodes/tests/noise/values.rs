//! Noises against what Blender's Cycles computes (`tests/validate/nodes/noise_values.py` writes the table).

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]
use gonio_nodes::{MagicTexture, NoiseKind, NoiseTexture, WaveProfile, WaveShape, WaveTexture, WhiteNoise};
use gonio_simd::{Execution, F, Lanes, dispatch};

const BLENDER: &str = include_str!("noise/blender.txt");

/// A line of the table.
struct Point {
    name: &'static str,
    settings: Vec<&'static str>,
    inputs: Vec<f32>,
    outputs: [f32; 4],
}

fn numbers(text: &str) -> Vec<f32> {
    text.split_whitespace().map(|word| word.parse().unwrap()).collect()
}

fn points() -> Vec<Point> {
    let point = |line: &'static str| {
        let parts: Vec<&str> = line.split(" | ").collect();
        let (name, settings) = parts[0].split_once(' ').unwrap();
        let outputs = numbers(parts[2]).try_into().unwrap();
        Point { name, settings: settings.split(',').collect(), inputs: numbers(parts[1]), outputs }
    };
    BLENDER.lines().map(point).collect()
}

fn noise(settings: &[&str]) -> NoiseTexture {
    let kind = match settings[0] {
        "FBM" => NoiseKind::Fbm,
        "MULTIFRACTAL" => NoiseKind::Multifractal,
        "HYBRID_MULTIFRACTAL" => NoiseKind::HybridMultifractal,
        "RIDGED_MULTIFRACTAL" => NoiseKind::RidgedMultifractal,
        _ => NoiseKind::HeteroTerrain,
    };
    NoiseTexture { kind, dimensions: dimensions(settings[1]), normalize: settings[2] == "True", color: true }
}

fn dimensions(word: &str) -> u8 {
    word[..1].parse().unwrap()
}

fn wave(settings: &[&str]) -> WaveTexture {
    let shape = match (settings[0], settings[2]) {
        ("BANDS", "X") => WaveShape::BandsX,
        ("BANDS", "Y") => WaveShape::BandsY,
        ("BANDS", "Z") => WaveShape::BandsZ,
        ("BANDS", _) => WaveShape::BandsDiagonal,
        (_, "X") => WaveShape::RingsX,
        (_, "Y") => WaveShape::RingsY,
        (_, "Z") => WaveShape::RingsZ,
        _ => WaveShape::RingsSpherical,
    };
    let profile = match settings[1] {
        "SIN" => WaveProfile::Sine,
        "SAW" => WaveProfile::Saw,
        _ => WaveProfile::Triangle,
    };
    WaveTexture { shape, profile }
}

/// The inputs in every lane, those at `left_out` taken away.
#[inline(always)]
fn splat<L: Lanes, const N: usize>(l: L, inputs: &[f32], left_out: Option<usize>) -> [F<L>; N] {
    let mut out = [l.f(0.0); N];
    let kept = inputs.iter().enumerate().filter(|(number, _)| Some(*number) != left_out);
    for (out, (_, input)) in out.iter_mut().zip(kept) {
        *out = l.f(*input);
    }
    out
}

/// What the kernel gives in the first lane.
#[inline(always)]
fn evaluate<L: Lanes>(l: L, point: &Point) -> [f32; 4] {
    let outputs = match point.name {
        "Noise" => noise(&point.settings).evaluate(l, &splat(l, &point.inputs, None)),
        "WhiteNoise" => WhiteNoise { dimensions: dimensions(point.settings[0]), color: true }.evaluate(l, &splat(l, &point.inputs, None)),
        "Wave" => {
            let [value] = wave(&point.settings).evaluate(l, &splat(l, &point.inputs, Some(3)));
            [value; 4]
        }
        _ => MagicTexture { depth: point.settings[0].parse().unwrap() }.evaluate(l, &splat(l, &point.inputs, Some(3))),
    };
    let mut out = [0.0; 4];
    for (out, value) in out.iter_mut().zip(outputs) {
        *out = value.to_array()[0];
    }
    out
}

#[test]
fn noises_are_those_of_cycles() {
    let points = points();
    assert!(points.len() > 150);
    let mut failures = Vec::new();
    for execution in Execution::all() {
        let mut worst = std::collections::BTreeMap::<&str, f32>::new();
        for (number, point) in points.iter().enumerate() {
            let values = dispatch!(execution, l => evaluate(l, point));
            for (channel, (value, wanted)) in values.into_iter().zip(point.outputs).enumerate() {
                let error = (value - wanted).abs() / (1.0 + wanted.abs());
                let worst = worst.entry(point.name).or_default();
                *worst = worst.max(error);
                if error.is_nan() || error > 1e-5 {
                    failures.push(format!("{} line {} channel {channel}: {value} for {wanted}", execution.name(), number + 1));
                }
            }
        }
        eprintln!("{}: {worst:?}", execution.name());
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}
