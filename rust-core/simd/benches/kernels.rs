//! Elementary functions, gathers and compaction at every level, with their ratios to scalar code on the standard library.

#![allow(clippy::print_stdout, reason = "the ratios are what the benchmark is for")]

#[path = "../tests/common/mod.rs"]
#[macro_use]
mod common;

use common::{Function, map_columns};
use criterion::{Criterion, Throughput};
use gonio_simd::{Column, Execution, Lanes, PADDING, dispatch};
use std::hint::black_box;
use std::time::{Duration, Instant};

const BATCH: usize = 4096;
/// Entries of the table gathered from: 256 kB, inside the second-level cache.
const TABLE: usize = 1 << 16;

function!(Sin, x, _ => x.sin());
function!(SinCosTurns, x, _ => { let (sin, cos) = x.sin_cos_turns(); sin + cos });
function!(Tan, x, _ => x.tan());
function!(Exp, x, _ => x.exp());
function!(Exp2, x, _ => x.exp2());
function!(Log2, x, _ => x.log2());
function!(Ln, x, _ => x.ln());
function!(Pow, x, y => x.pow(y));
function!(Asin, x, _ => x.asin());
function!(Acos, x, _ => x.acos());
function!(Atan2, y, x => y.atan2(x));

/// Values between 0 and 1 without a pattern (a Weyl sequence).
fn column(step: f64) -> Column {
    let mut column = Column::new(BATCH);
    for (i, x) in column.iter_mut().enumerate() {
        *x = (i as f64 * step).fract() as f32;
    }
    column
}

/// Measures the scalar code and each level, and prints their ratios by the fastest runs.
fn measure(criterion: &mut Criterion, name: &str, mut scalar: impl FnMut(), mut lanes: impl FnMut(Execution)) {
    let mut group = criterion.benchmark_group(name);
    group.throughput(Throughput::Elements(BATCH as u64)).sample_size(20);
    group.warm_up_time(Duration::from_millis(100)).measurement_time(Duration::from_millis(400));
    let mut fastest = |label: &str, work: &mut dyn FnMut()| {
        let mut best = f64::INFINITY;
        group.bench_function(label, |bencher| {
            bencher.iter_custom(|count| {
                let start = Instant::now();
                (0..count).for_each(|_| work());
                let elapsed = start.elapsed();
                best = best.min(elapsed.as_secs_f64() / count as f64);
                elapsed
            });
        });
        best
    };
    let base = fastest("std", &mut scalar);
    let mut line = format!("{name}: std {:.2} ns", base * 1e9 / BATCH as f64);
    for execution in Execution::all() {
        let best = fastest(execution.name(), &mut || lanes(execution));
        line += &format!(", {} {:.1}x", execution.name(), base / best);
    }
    println!("{line}");
}

fn function<K: Function>(criterion: &mut Criterion, name: &str, [low, high]: [f32; 2], standard: impl Fn(f32, f32) -> f32) {
    let (mut x, y) = (column(0.618_034), column(0.754_878));
    x.iter_mut().for_each(|x| *x = low + (high - low) * *x);
    let (mut one, mut wide) = (Column::new(BATCH), Column::new(BATCH));
    let scalar = || {
        // An opaque index keeps the loop scalar, as a renderer that follows one path at a time has it.
        (0..BATCH).map(black_box).for_each(|i| one[i] = standard(x[i], y[i]));
    };
    measure(criterion, name, scalar, |execution| map_columns::<K>(execution, &x, &y, black_box(&mut wide)));
}

fn functions(criterion: &mut Criterion) {
    const TURN: f32 = core::f32::consts::TAU;
    function::<Sin>(criterion, "sin", [-TURN, TURN], |x, _| x.sin());
    function::<SinCosTurns>(criterion, "sin_cos_turns", [0.0, 1.0], |x, _| {
        let (sin, cos) = (x * TURN).sin_cos();
        sin + cos
    });
    function::<Tan>(criterion, "tan", [-1.5, 1.5], |x, _| x.tan());
    function::<Exp2>(criterion, "exp2", [-20.0, 20.0], |x, _| x.exp2());
    function::<Exp>(criterion, "exp", [-20.0, 20.0], |x, _| x.exp());
    function::<Log2>(criterion, "log2", [0.0, 10.0], |x, _| x.log2());
    function::<Ln>(criterion, "ln", [0.0, 10.0], |x, _| x.ln());
    function::<Pow>(criterion, "pow", [0.0, 10.0], f32::powf);
    function::<Asin>(criterion, "asin", [-1.0, 1.0], |x, _| x.asin());
    function::<Acos>(criterion, "acos", [-1.0, 1.0], |x, _| x.acos());
    function::<Atan2>(criterion, "atan2", [-1.0, 1.0], |y, x| y.atan2(x - 0.5));
}

#[inline(always)]
fn gather_batch<L: Lanes>(l: L, table: &[f32], index: &[u32], out: &mut [f32]) {
    for at in (0..out.len()).step_by(L::COUNT) {
        l.gather(table, l.load_integers(index, at)).store(out, at);
    }
}

#[inline(always)]
fn gather_pairs_batch<L: Lanes>(l: L, table: &[f32], index: &[u32], out: &mut [f32]) {
    for at in (0..out.len()).step_by(L::COUNT) {
        let [low, high] = l.gather_pairs(table, l.load_integers(index, at));
        (low + high).store(out, at);
    }
}

#[inline(always)]
fn compact_batch<L: Lanes>(l: L, values: &[f32], out: &mut [f32]) -> usize {
    let mut len = 0;
    for at in (0..values.len()).step_by(L::COUNT) {
        let x = l.load(values, at);
        let chosen = x.lt(0.5);
        x.append(chosen, out, len);
        len += chosen.count();
    }
    len
}

fn tables(criterion: &mut Criterion) {
    let table: Vec<f32> = (0..TABLE).map(|i| i as f32).collect();
    let mut index = Column::<u32>::new(BATCH);
    index.iter_mut().zip(column(0.618_034).iter()).for_each(|(index, x)| *index = (x * (TABLE - 1) as f32) as u32);
    let (mut one, mut wide) = (Column::new(BATCH), Column::new(BATCH));
    let scalar = || (0..BATCH).map(black_box).for_each(|i| one[i] = table[(index[i] as usize).min(TABLE - 1)]);
    measure(criterion, "gather", scalar, |execution| {
        dispatch!(execution, l => gather_batch(l, &table, &index, black_box(&mut wide)));
    });
    let scalar = || {
        (0..BATCH).map(black_box).for_each(|i| {
            let at = (index[i] as usize).min(TABLE - 2);
            one[i] = table[at] + table[at + 1];
        });
    };
    measure(criterion, "gather_pairs", scalar, |execution| {
        dispatch!(execution, l => gather_pairs_batch(l, &table, &index, black_box(&mut wide)));
    });
}

fn compaction(criterion: &mut Criterion) {
    let values = column(0.618_034);
    let (mut one, mut wide) = (Column::new(BATCH + PADDING), Column::new(BATCH + PADDING));
    let scalar = || {
        let mut len = 0;
        for &x in values.iter() {
            one[len] = x;
            len += usize::from(x < 0.5);
        }
        black_box(len);
    };
    measure(criterion, "compaction", scalar, |execution| {
        black_box(dispatch!(execution, l => compact_batch(l, &values, black_box(&mut wide))));
    });
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    functions(&mut criterion);
    tables(&mut criterion);
    compaction(&mut criterion);
    criterion.final_summary();
}
