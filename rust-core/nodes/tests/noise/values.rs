//! Noises against what others compute: Blender's Cycles (`tests/validate/nodes/noise_values.py` writes the table; 4.5 and 5.0 give the same) and
//! MaterialX 1.39.5's noise library for GLSL, compiled for the processor.

use crate::nodes::{KINDS, Node, POINTS, PROFILES, SHAPES};
use gonio_nodes::{MagicTexture, MxCellNoise, MxFractal, MxNoise, MxWorley, MxWorleyStyle, NoiseTexture, WaveTexture, WhiteNoise};
use gonio_simd::Execution;

/// The largest error, in parts of one more than the value's magnitude.
const TOLERANCE: f32 = 1e-5;

/// A line of a table.
struct Point {
    node: Node,
    inputs: Vec<f32>,
    outputs: Vec<f32>,
}

/// The points of a table: settings, inputs and outputs with bars between.
fn points(table: &str, node: fn(&str, &[&str]) -> Node) -> Vec<Point> {
    let numbers = |text: &str| text.split_whitespace().map(|word| word.parse().unwrap()).collect::<Vec<f32>>();
    let point = |line: &str| {
        let parts: Vec<&str> = line.split(" | ").collect();
        let (name, settings) = parts[0].split_once(' ').unwrap();
        let settings: Vec<&str> = settings.split(',').collect();
        let mut inputs = numbers(parts[1]);
        let node = node(name, &settings);
        if inputs.len() > node.inputs().len() {
            // The fourth coordinate is in the table for all nodes.
            inputs.remove(3);
        }
        Point { node, inputs, outputs: numbers(parts[2]) }
    };
    table.lines().map(point).collect()
}

fn number(word: &str) -> u8 {
    word.trim_end_matches('D').parse().unwrap()
}

/// The place of a word in a list.
fn place(word: &str, words: &[&str]) -> usize {
    words.iter().position(|known| *known == word).unwrap()
}

fn blender(name: &str, settings: &[&str]) -> Node {
    match name {
        "Noise" => {
            let kinds = ["FBM", "MULTIFRACTAL", "HYBRID_MULTIFRACTAL", "RIDGED_MULTIFRACTAL", "HETERO_TERRAIN"];
            let kind = KINDS[place(settings[0], &kinds)];
            Node::Noise(NoiseTexture { kind, dimensions: number(settings[1]), normalize: settings[2] == "True", color: true })
        }
        "WhiteNoise" => Node::White(WhiteNoise { dimensions: number(settings[0]), color: true }),
        "Wave" => {
            let direction = place(settings[2], &["X", "Y", "Z", "DIAGONAL", "SPHERICAL"]).min(3);
            let shape = SHAPES[direction + 4 * usize::from(settings[0] == "RINGS")];
            Node::Wave(WaveTexture { shape, profile: PROFILES[place(settings[1], &["SIN", "SAW", "TRI"])] })
        }
        _ => Node::Magic(MagicTexture { depth: number(settings[0]) }),
    }
}

fn materialx(name: &str, settings: &[&str]) -> Node {
    let (dimensions, channels) = (number(settings[0]), number(settings[1]));
    match name {
        "noise" => Node::MxNoise(MxNoise { dimensions, channels }),
        "cell" => Node::MxCell(MxCellNoise { dimensions, channels }),
        "fractal" => Node::MxFractal(MxFractal { dimensions, channels }),
        _ => {
            let style = [MxWorleyStyle::Distance, MxWorleyStyle::Solid][usize::from(number(settings[2]))];
            Node::MxWorley(MxWorley { dimensions, channels, style })
        }
    }
}

fn check(points: &[Point]) {
    let mut failures = Vec::new();
    for execution in Execution::all() {
        let mut worst = 0.0f32;
        for (line, point) in points.iter().enumerate() {
            let inputs: Vec<[f32; POINTS]> = point.inputs.iter().map(|input| [*input; POINTS]).collect();
            let outputs = point.node.evaluate(execution, &inputs);
            // A wave has one output, which is its colour too.
            let outputs = if matches!(point.node, Node::Wave(_)) { [outputs[0]; 4] } else { outputs };
            for (value, wanted) in outputs.iter().zip(&point.outputs) {
                let error = (value[0] - wanted).abs() / (1.0 + wanted.abs());
                worst = worst.max(error);
                if error.is_nan() || error > TOLERANCE {
                    failures.push(format!("{} line {} {:?}: {} for {wanted}", execution.name(), line + 1, point.node, value[0]));
                }
            }
        }
        eprintln!("{}: largest error {worst:e}", execution.name());
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn noises_are_those_of_cycles() {
    let points = points(include_str!("blender.txt"), blender);
    assert_eq!(points.len(), 176);
    check(&points);
}

#[test]
fn noises_are_those_of_materialx() {
    let points = points(include_str!("materialx.txt"), materialx);
    assert_eq!(points.len(), 128);
    check(&points);
}
