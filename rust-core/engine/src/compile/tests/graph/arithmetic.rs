//! Component-wise operations against their formulas in double precision.

use super::harness::{Bench, close, inputs, on_numbers, uniform};
use gonio_nodes::Kernel;
use gonio_simd::Execution;
use serde_json::json;

/// Numbers of many magnitudes, and edges among them.
fn number(column: usize, i: usize) -> f32 {
    const EDGES: [f32; 16] = [0.0, -0.0, 1.0, -1.0, 0.5, -0.5, 88.0, 120.0, -120.0, 1e-30, -1e-30, 1e-40, 20_000.0, -300_000.0, 3.0, 1.5];
    if i < 64 {
        return EDGES[((i >> (2 * (column % 3))) ^ (column * 5)) % 16];
    }
    let magnitude = 10_f32.powf(uniform(20, 9 * i + column) * 4.0 - 2.5);
    if uniform(21, 9 * i + column) < 0.5 { -magnitude } else { magnitude }
}

type Formula = fn(f64, f64, f64) -> f64;

/// Relative error of a few roundings.
const EPSILON: f64 = 3e-7;
/// Results below the smallest normal number may be zero.
const TINY: f64 = 2e-38;

/// The smallest normal number of single precision.
const SMALLEST: f64 = f32::MIN_POSITIVE as f64;

fn power(a: f64, b: f64) -> f64 {
    let magnitude = a.abs().max(SMALLEST).powf(b);
    match a {
        _ if a > 0.0 => magnitude,
        _ if a == 0.0 => f64::from(u8::from(b == 0.0)),
        _ if b.floor() != b => 0.0,
        _ if (b * 0.5).floor() != b * 0.5 => -magnitude,
        _ => magnitude,
    }
}

fn fresnel(cosine: f64, eta: f64) -> f64 {
    let c = cosine.abs();
    let squared = eta * eta - 1.0 + c * c;
    if squared <= 0.0 {
        return 1.0;
    }
    let g = squared.sqrt();
    let a = if g + c == 0.0 { 0.0 } else { (g - c) / (g + c) };
    let divisor = c * (g - c) + 1.0;
    let b = (c * (g + c) - 1.0) / if divisor == 0.0 { 1.0 } else { divisor };
    0.5 * a * a * (1.0 + b * b)
}

/// The exact logarithm; denormals count as the smallest normal number.
fn logarithm(a: f64) -> f64 {
    if a > 0.0 { a.max(SMALLEST).ln() } else { 0.0 }
}

/// Angles beyond 10⁴ are reduced with the precision they are given in.
fn angle_error(a: f64) -> f64 {
    if a.abs() <= 1e4 { EPSILON } else { a.abs() * EPSILON }
}

/// Near the onset of total reflection the root multiplies rounding errors, so nothing is asked there.
fn fresnel_error(cosine: f64, eta: f64) -> f64 {
    if (eta * eta - 1.0 + cosine * cosine).abs() < 1e-3 { 1.0 } else { 1e-5 }
}

/// Operations with their formulas, and how far results may be off.
const CASES: [(&str, Formula, Formula); 23] = [
    ("Add", |a, b, _| a + b, |a, b, _| EPSILON * (a.abs() + b.abs())),
    ("Subtract", |a, b, _| a - b, |a, b, _| EPSILON * (a.abs() + b.abs())),
    ("Multiply", |a, b, _| a * b, |a, b, _| EPSILON * (a * b).abs() + TINY),
    ("Divide", |a, b, _| if b == 0.0 { 0.0 } else { a / b }, |a, b, _| EPSILON * (a / b).abs() + TINY),
    ("Mix", |a, b, c| a + (b - a) * c, |a, b, c| EPSILON * (a.abs() + b.abs()) * (1.0 + c.abs())),
    ("Power", |a, b, _| power(a, b), |a, b, _| power(a, b).abs() * EPSILON * (1.0 + (b * logarithm(a.abs())).abs()) + TINY),
    ("Invert", |a, b, _| b - a, |a, b, _| EPSILON * (a.abs() + b.abs())),
    ("Clamp", |a, b, c| a.max(b).min(c), |_, _, _| 0.0),
    ("Minimum", |a, b, _| a.min(b), |_, _, _| 0.0),
    ("Maximum", |a, b, _| a.max(b), |_, _, _| 0.0),
    ("Absolute", |a, _, _| a.abs(), |_, _, _| 0.0),
    ("Sign", |a, _, _| if a == 0.0 { 0.0 } else { a.signum() }, |_, _, _| 0.0),
    ("Floor", |a, _, _| a.floor(), |_, _, _| 0.0),
    ("SquareRoot", |a, _, _| a.max(0.0).sqrt(), |a, _, _| EPSILON * a.abs().sqrt()),
    ("Exponential", |a, _, _| a.min(88.0).exp(), |a, _, _| EPSILON * a.min(88.0).exp() + TINY),
    ("Logarithm", |a, _, _| logarithm(a), |a, _, _| EPSILON * logarithm(a).abs()),
    ("Sine", |a, _, _| a.sin(), |a, _, _| angle_error(a)),
    ("Cosine", |a, _, _| a.cos(), |a, _, _| angle_error(a)),
    ("ArcSine", |a, _, _| a.clamp(-1.0, 1.0).asin(), |_, _, _| 1e-6),
    ("ArcCosine", |a, _, _| a.clamp(-1.0, 1.0).acos(), |_, _, _| 1e-6),
    ("ArcTangent2", |a, b, _| a.atan2(b), |_, _, _| 1e-6),
    ("Less", |a, b, _| if a < b { 1.0 } else { 0.0 }, |_, _, _| 0.0),
    ("Fresnel", |a, b, _| fresnel(a, b), |a, b, _| fresnel_error(a, b)),
];

#[test]
fn operations_follow_their_formulas() {
    for (name, formula, tolerance) in CASES {
        Bench::with_numbers(&on_numbers(&json!(name)), number).check(|i, found| {
            let inputs = inputs(number, i);
            for k in 0..4 {
                let [a, b, c] = inputs.map(|input| f64::from(input[k]));
                close(found[k], formula(a, b, c), tolerance(a, b, c), &format!("{name} of {a}, {b}, {c}"));
            }
        });
    }
}

#[test]
fn scalars_are_computed_once() {
    for (name, _, _) in CASES {
        let mut nodes = on_numbers(&json!(name));
        let wide = Bench::with_numbers(&nodes, number);
        nodes[6]["inputs"] = json!([{ "Node": [3, "G"] }, { "Node": [4, "G"] }, { "Node": [5, "G"] }]);
        let even = Bench::with_numbers(&nodes, number);
        assert_eq!([arithmetic(&even), arithmetic(&wide)], [1, 4], "{name}");
        for execution in Execution::all() {
            for (scalar, all) in even.run(execution).into_iter().zip(wide.run(execution)) {
                assert_eq!(scalar.map(f32::to_bits), [all[1].to_bits(); 4], "{name}");
            }
        }
    }
}

/// How many steps of a program are arithmetic.
fn arithmetic(bench: &Bench) -> usize {
    bench.last().kernels().filter(|kernel| matches!(kernel, Kernel::Operation(_))).count()
}

#[test]
fn scalars_are_known_through_operations() {
    let nodes = json!([
        { "operation": "FrontFacing", "inputs": [] },
        { "operation": "Multiply", "inputs": [{ "Node": [0, "Rgb"] }, { "Constant": [2.0, 2.0, 2.0, 2.0] }] },
        { "operation": "Add", "inputs": [{ "Node": [1, "Rgb"] }, { "Constant": [1.0, 1.0, 1.0, 0.0] }] },
        { "operation": "Sine", "inputs": [{ "Node": [2, "Rgb"] }] }
    ]);
    // One product; a sum and a sine of each of two different components.
    assert_eq!(arithmetic(&Bench::new(&nodes)), 5);
}
