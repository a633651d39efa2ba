//! Noises on lanes: levels against one another, each lane for itself, bounds, and inputs that nobody should give.

use crate::nodes::{Node, POINTS};
use gonio_nodes::{MagicTexture, NoiseKind, NoiseTexture};
use gonio_simd::Execution;

/// Numbers in [-1, 1], the same at each run.
struct Numbers(u32);

impl Numbers {
    fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (self.0 >> 8) as f32 / (1 << 23) as f32 - 1.0
    }
}

/// Sensible inputs, another in each lane.
fn sensible(node: &Node, numbers: &mut Numbers) -> Vec<[f32; POINTS]> {
    let input = |name: &&str| {
        let mut lanes = [0.0; POINTS];
        for lane in &mut lanes {
            let unit = 0.5 + 0.5 * numbers.next();
            *lane = match *name {
                "x" | "y" | "z" | "w" => 8.0 * unit - 4.0,
                "scale" | "detail_scale" => 0.5 + 2.0 * unit,
                "detail" | "octaves" => (6.0 * unit).floor() + if unit > 0.5 { unit } else { 0.0 },
                "lacunarity" => 1.5 + unit,
                _ => unit,
            };
        }
        lanes
    };
    node.inputs().iter().map(input).collect()
}

/// Products fused on some levels move the distorted point by its last bits, which high octaves enlarge.
const TOLERANCE: f32 = 1e-3;

#[test]
fn every_level_gives_what_one_lane_gives() {
    let mut numbers = Numbers(5);
    for node in Node::all() {
        for _ in 0..8 {
            let inputs = sensible(&node, &mut numbers);
            let scalar = node.evaluate(Execution::Scalar, &inputs);
            for execution in Execution::all() {
                let values = node.evaluate(execution, &inputs);
                for (value, wanted) in values.as_flattened().iter().zip(scalar.as_flattened()) {
                    let error = (value - wanted).abs() / (1.0 + wanted.abs());
                    assert!(error < TOLERANCE, "{node:?} {}: {value} for {wanted}", execution.name());
                }
            }
        }
    }
}

#[test]
fn lanes_do_not_disturb_each_other() {
    let mut numbers = Numbers(6);
    for node in Node::all() {
        let inputs = sensible(&node, &mut numbers);
        for execution in Execution::all() {
            let together = node.evaluate(execution, &inputs);
            for lane in 0..POINTS {
                let alone: Vec<[f32; POINTS]> = inputs.iter().map(|input| [input[lane]; POINTS]).collect();
                let alone = node.evaluate(execution, &alone);
                for (together, alone) in together.iter().zip(alone) {
                    assert_eq!(together[lane].to_bits(), alone[lane].to_bits(), "{node:?} {} lane {lane}", execution.name());
                }
            }
        }
    }
}

/// Whether the node's values lie in [0, 1] whatever its inputs.
fn is_bounded(node: &Node) -> bool {
    matches!(node, Node::White(_) | Node::Wave(_) | Node::MxCell(_))
        || matches!(node, Node::Noise(NoiseTexture { kind: NoiseKind::Fbm, normalize: true, .. }))
}

#[test]
fn values_keep_their_bounds() {
    let mut numbers = Numbers(7);
    for node in Node::all().iter().filter(|node| is_bounded(node)) {
        for _ in 0..200 {
            let inputs = sensible(node, &mut numbers);
            for value in node.evaluate(Execution::best(), &inputs).as_flattened() {
                assert!((0.0..=1.0).contains(value), "{node:?}: {value}");
            }
        }
    }
}

#[test]
fn finite_inputs_give_finite_values_and_others_no_harm() {
    const FINITE: [f32; 12] = [0.0, -0.0, 1e-40, -1.0, 0.999_999_94, 15.5, 1e5, -1e6, 3.0e9, -1e20, f32::MAX, f32::MIN];
    const HOSTILE: [f32; 3] = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY];
    let mut numbers = Numbers(8);
    for node in Node::all() {
        for turn in 0..60 {
            let mut inputs = sensible(&node, &mut numbers);
            let is_hostile = turn % 3 == 2;
            for lane in inputs.iter_mut().flatten() {
                let pick = ((numbers.next() + 1.0) * 1e4) as usize;
                if is_hostile && pick.is_multiple_of(3) {
                    *lane = HOSTILE[pick / 3 % HOSTILE.len()];
                } else if pick.is_multiple_of(2) || turn % 3 == 0 {
                    *lane = FINITE[pick / 6 % FINITE.len()];
                }
            }
            for execution in Execution::all() {
                for value in node.evaluate(execution, &inputs).as_flattened() {
                    assert!(value.is_finite(), "{node:?} {}: {value} for {inputs:?}", execution.name());
                }
            }
        }
    }
}

#[test]
fn without_colour_the_value_is_the_same() {
    let mut numbers = Numbers(9);
    let noise = NoiseTexture::default();
    let inputs = sensible(&Node::Noise(noise), &mut numbers);
    let with = Node::Noise(noise).evaluate(Execution::best(), &inputs);
    let without = Node::Noise(NoiseTexture { color: false, ..noise }).evaluate(Execution::best(), &inputs);
    assert_eq!(with[0], without[0]);
    assert_eq!(with[1], with[0]);
    assert_eq!(without, [with[0]; 4]);
}

#[test]
fn magic_deeper_than_ten_is_ten() {
    let mut numbers = Numbers(10);
    let deep = |depth| Node::Magic(MagicTexture { depth });
    let inputs = sensible(&deep(10), &mut numbers);
    assert_eq!(deep(10).evaluate(Execution::best(), &inputs), deep(200).evaluate(Execution::best(), &inputs));
}
