//! Nanoseconds a point of the noises, on one lane and at each level of this machine:
//! `cargo run --release -p gonio-nodes --example bench`.
#![allow(clippy::print_stdout, reason = "a program for people")]

use gonio_nodes::{MagicTexture, NoiseKind, NoiseTexture, WaveProfile, WaveShape, WaveTexture, WhiteNoise};
use gonio_simd::{Column, Execution, F, Lanes, dispatch};
use std::time::Instant;

const POINTS: usize = 2048;
const ROUNDS: usize = 9;

#[derive(Clone, Copy)]
enum Case {
    Noise(NoiseTexture),
    White(WhiteNoise),
    Wave(WaveTexture),
    Magic(MagicTexture),
}

/// Runs a kernel over the points: three or four coordinates from the columns, then constants.
macro_rules! pass {
    ($l:ident, $node:expr, $columns:expr, $out:expr, $coordinates:literal, $constants:expr) => {
        for at in (0..POINTS).step_by(L::COUNT) {
            let mut inputs = [$l.f(0.0); $coordinates + $constants.len()];
            for (input, column) in inputs.iter_mut().zip($columns).take($coordinates) {
                *input = $l.load(column, at);
            }
            for (input, constant) in inputs[$coordinates..].iter_mut().zip($constants) {
                *input = $l.f(constant);
            }
            let outputs = $node.evaluate($l, &inputs);
            let mut sum: F<L> = $l.f(0.0);
            for output in outputs {
                sum += output;
            }
            sum.store($out, at);
        }
    };
}

#[inline(always)]
fn run<L: Lanes>(l: L, case: Case, columns: &[Column; 4], out: &mut [f32]) {
    l.vectorize(
        #[inline(always)]
        || match case {
            Case::Noise(node) => pass!(l, node, columns, out, 4, [5.0, 4.0, 0.5, 2.0, 0.8, 1.0, 0.0]),
            Case::White(node) => pass!(l, node, columns, out, 4, [0.0; 0]),
            Case::Wave(node) => pass!(l, node, columns, out, 3, [5.0, 1.5, 4.0, 1.0, 0.5, 0.0]),
            Case::Magic(node) => pass!(l, node, columns, out, 3, [5.0, 1.0]),
        },
    );
}

/// The least time a point of some rounds.
fn nanoseconds(execution: Execution, case: Case, columns: &[Column; 4], out: &mut [f32]) -> f64 {
    let mut best = f64::MAX;
    for _ in 0..ROUNDS {
        let start = Instant::now();
        dispatch!(execution, l => run(l, case, columns, out));
        best = best.min(start.elapsed().as_secs_f64());
    }
    best / POINTS as f64 * 1e9
}

fn cases() -> Vec<(String, Case)> {
    let noise = |dimensions, kind, color| Case::Noise(NoiseTexture { dimensions, kind, normalize: true, color });
    let mut cases = Vec::new();
    for dimensions in 1..=4 {
        cases.push((format!("Brownian {dimensions}D, detail 4"), noise(dimensions, NoiseKind::Fbm, false)));
    }
    cases.push(("Brownian 3D, detail 4, colour".into(), noise(3, NoiseKind::Fbm, true)));
    cases.push(("hybrid 3D, detail 4".into(), noise(3, NoiseKind::HybridMultifractal, false)));
    cases.push(("white noise 3D, colour".into(), Case::White(WhiteNoise { dimensions: 3, color: true })));
    let wave = WaveTexture { shape: WaveShape::RingsSpherical, profile: WaveProfile::Sine };
    cases.push(("wave, distorted, detail 4".into(), Case::Wave(wave)));
    cases.push(("magic, depth 5".into(), Case::Magic(MagicTexture { depth: 5 })));
    cases
}

fn main() {
    let mut columns = [Column::new(POINTS), Column::new(POINTS), Column::new(POINTS), Column::new(POINTS)];
    for (axis, column) in columns.iter_mut().enumerate() {
        for (number, value) in column.iter_mut().enumerate() {
            *value = ((number * 7919 + axis * 104_729) % 10_007) as f32 * 0.001 - 5.0;
        }
    }
    let mut out = Column::new(POINTS);
    let levels = Execution::all();
    for (name, case) in cases() {
        let times: Vec<f64> = levels.iter().map(|level| nanoseconds(*level, case, &columns, &mut out)).collect();
        let scalar = times[times.len() - 1];
        print!("{name:32}");
        for (level, time) in levels.iter().zip(&times) {
            print!("  {} {time:8.2} ns ({:4.1}x)", level.name(), scalar / time);
        }
        println!();
    }
}
