//! Elementary functions at every level against `f64`, with the error bounds that their documentation states.

#![allow(clippy::print_stdout, reason = "the measured errors, shown with --nocapture")]

#[macro_use]
mod common;

use common::{Function, map_columns};
use gonio_simd::{Execution, padded};

function!(Sin, x, _ => x.sin());
function!(Cos, x, _ => x.cos());
function!(SinOfPair, x, _ => x.sin_cos().0);
function!(CosOfPair, x, _ => x.sin_cos().1);
function!(SinTurns, x, _ => x.sin_cos_turns().0);
function!(CosTurns, x, _ => x.sin_cos_turns().1);
function!(Tan, x, _ => x.tan());
function!(Exp2, x, _ => x.exp2());
function!(Exp, x, _ => x.exp());
function!(Log2, x, _ => x.log2());
function!(Ln, x, _ => x.ln());
function!(Pow, x, y => x.pow(y));
function!(NormalPow, x, y => x.normal_pow(y));
function!(Asin, x, _ => x.asin());
function!(Acos, x, _ => x.acos());
function!(Atan2, y, x => y.atan2(x));
function!(InverseRoot, x, _ => x.inverse_root());

const INFINITY: f32 = f32::INFINITY;
const DENORMAL: f32 = 1e-40;

/// The function's values at pairs of arguments.
fn map2<K: Function>(execution: Execution, pairs: &[[f32; 2]]) -> Vec<f32> {
    let column = |k: usize| -> Vec<f32> { (0..padded(pairs.len())).map(|i| pairs.get(i).map_or(1.0, |p| p[k])).collect() };
    let (x, y) = (column(0), column(1));
    let mut out = vec![0.0; x.len()];
    map_columns::<K>(execution, &x, &y, &mut out);
    out.truncate(pairs.len());
    out
}

/// The function's values at single arguments.
fn map1<K: Function>(execution: Execution, x: &[f32]) -> Vec<f32> {
    let pairs: Vec<[f32; 2]> = x.iter().map(|&x| [x, 0.0]).collect();
    map2::<K>(execution, &pairs)
}

/// `count` values spread evenly over `[low, high]`, both ends included.
fn sweep(low: f32, high: f32, count: usize) -> Vec<f32> {
    (0..count).map(|i| (f64::from(low) + (f64::from(high) - f64::from(low)) * i as f64 / (count - 1) as f64) as f32).collect()
}

/// Every `step`-th float from `low` to `high`, both positive.
fn floats(low: f32, high: f32, step: usize) -> Vec<f32> {
    (low.to_bits()..=high.to_bits()).step_by(step).map(f32::from_bits).collect()
}

fn absolute(got: f32, exact: f64) -> f64 {
    (f64::from(got) - exact).abs()
}
fn relative(got: f32, exact: f64) -> f64 {
    if exact == 0.0 { f64::from(got).abs() } else { (f64::from(got) / exact - 1.0).abs() }
}
fn ulps(got: f32, exact: f64) -> f64 {
    (f64::from(got) - exact).abs() / 2.0_f64.powi((exact.abs().log2().floor() as i32).max(-126) - 23)
}

fn same(a: f32, b: f32) -> bool {
    a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())
}

/// Asserts the same bits at levels that fuse multiplication and addition, and at those that do not: pictures are the same for one lane and four, and
/// for eight and sixteen.
fn check_bits<K: Function>(name: &str, pairs: &[[f32; 2]]) {
    let fuses = |execution: Execution| !matches!(execution.name(), "scalar" | "sse4.2");
    for neighbours in Execution::all().windows(2).filter(|levels| fuses(levels[0]) == fuses(levels[1])) {
        let [narrow, wide] = [0, 1].map(|k| map2::<K>(neighbours[k], pairs));
        for ((pair, narrow), wide) in pairs.iter().zip(narrow).zip(wide) {
            assert!(same(narrow, wide), "{name} of {pair:?}: {narrow:e} at {}, {wide:e} at {}", neighbours[0].name(), neighbours[1].name());
        }
    }
}

/// Asserts that no error, divided by the bound at its arguments, is above one at any level, and [`check_bits`].
fn check2<K: Function>(
    name: &str,
    pairs: &[[f32; 2]],
    exact: impl Fn(f64, f64) -> f64,
    error: impl Fn(f32, f64) -> f64,
    bound: impl Fn(f64) -> f64,
) {
    check_bits::<K>(name, pairs);
    let exact: Vec<f64> = pairs.iter().map(|p| exact(f64::from(p[0]), f64::from(p[1]))).collect();
    for execution in Execution::all() {
        let got = map2::<K>(execution, pairs);
        let mut worst = (0.0, [0.0; 2], 0.0, 0.0);
        for ((&pair, &got), &exact) in pairs.iter().zip(&got).zip(&exact) {
            let share = error(got, exact) / bound(exact);
            assert!(!share.is_nan(), "{name} at {}: {got} for {pair:?}, expected {exact}", execution.name());
            if share > worst.0 {
                worst = (share, pair, got, exact);
            }
        }
        let (share, pair, got, expected) = worst;
        println!("{name:12} {:7} worst {:.2e} of {:.2e} at {pair:?}", execution.name(), error(got, expected), bound(expected));
        assert!(share <= 1.0, "{name} at {}: {got} for {pair:?}, expected {expected}: {share} of the bound", execution.name());
    }
}

/// [`check2`] for one argument and a constant bound.
fn check<K: Function>(name: &str, x: &[f32], exact: impl Fn(f64) -> f64, error: impl Fn(f32, f64) -> f64, bound: f64) {
    let pairs: Vec<[f32; 2]> = x.iter().map(|&x| [x, 0.0]).collect();
    check2::<K>(name, &pairs, |x, _| exact(x), error, |_| bound);
}

/// Asserts exact values, equal in sign of zero, at every level.
fn check_values<K: Function>(name: &str, cases: &[([f32; 2], f32)]) {
    let pairs: Vec<[f32; 2]> = cases.iter().map(|c| c.0).collect();
    for execution in Execution::all() {
        for ((pair, expected), got) in cases.iter().zip(map2::<K>(execution, &pairs)) {
            assert!(same(got, *expected), "{name} at {}: {got} for {pair:?}, expected {expected}", execution.name());
        }
    }
}

/// Asserts NaN for NaN and the infinities.
fn check_not_numbers<K: Function>(name: &str) {
    check_values::<K>(name, &[([f32::NAN, 0.0], f32::NAN), ([INFINITY, 0.0], f32::NAN), ([-INFINITY, 0.0], f32::NAN)]);
}

fn angles() -> Vec<f32> {
    let mut x = sweep(-6.5, 6.5, 200_001);
    x.extend(sweep(-1e4, 1e4, 200_001));
    x.extend((-6366..=6366).map(|k| (f64::from(k) * core::f64::consts::FRAC_PI_2) as f32));
    x.extend(floats(1e-42, 1.0, 50_021));
    x
}

#[test]
fn sine_and_cosine_in_radians() {
    let x = angles();
    for execution in Execution::all() {
        for wave in [map1::<Sin>(execution, &x), map1::<Cos>(execution, &x)] {
            assert!(wave.iter().all(|y| y.abs() <= 1.0), "a sine or cosine above one at {}", execution.name());
        }
    }
    check::<Sin>("sin", &x, f64::sin, absolute, 1e-7);
    check::<Cos>("cos", &x, f64::cos, absolute, 1e-7);
    check::<SinOfPair>("sin_cos.0", &x, f64::sin, absolute, 1e-7);
    check::<CosOfPair>("sin_cos.1", &x, f64::cos, absolute, 1e-7);
    let small = floats(1e-30, 1.57, 5_003);
    check::<SinOfPair>("sin_cos ulp", &small, f64::sin, ulps, 2.0);
    check_not_numbers::<Sin>("sin");
    check_not_numbers::<Cos>("cos");
    check_not_numbers::<SinOfPair>("sin_cos.0");
    check_not_numbers::<CosOfPair>("sin_cos.1");
    check_values::<SinOfPair>("sin_cos.0", &[([0.0, 0.0], 0.0), ([DENORMAL, 0.0], DENORMAL)]);
    check_values::<CosOfPair>("sin_cos.1", &[([0.0, 0.0], 1.0), ([-0.0, 0.0], 1.0), ([DENORMAL, 0.0], 1.0)]);
}

#[test]
fn sine_and_cosine_in_turns() {
    let mut x = sweep(-2.0, 2.0, 200_001);
    x.extend(sweep(-1e6, 1e6, 50_001));
    x.extend(sweep(-2.6e8, 2.6e8, 50_001));
    let angle = |x: f64| x.rem_euclid(1.0) * core::f64::consts::TAU;
    check::<SinTurns>("sin turns", &x, |x| angle(x).sin(), absolute, 1.2e-7);
    check::<CosTurns>("cos turns", &x, |x| angle(x).cos(), absolute, 1.2e-7);
    check_not_numbers::<SinTurns>("sin turns");
    check_not_numbers::<CosTurns>("cos turns");
    let one = |x: f32, y: f32| ([x, 0.0], y);
    check_values::<SinTurns>("sin turns", &[one(0.0, 0.0), one(0.25, 1.0), one(0.75, -1.0)]);
    check_values::<CosTurns>("cos turns", &[one(0.0, 1.0), one(0.5, -1.0), one(1.0, 1.0)]);
}

#[test]
fn tangent() {
    check::<Tan>("tan", &sweep(-1.57, 1.57, 400_001), f64::tan, relative, 4e-7);
    check_not_numbers::<Tan>("tan");
    check_values::<Tan>("tan", &[([0.0, 0.0], 0.0)]);
}

#[test]
fn exponentials() {
    check::<Exp2>("exp2", &sweep(-126.0, 127.999_99, 400_001), f64::exp2, ulps, 2.0);
    check::<Exp>("exp", &sweep(-87.336_5, 88.722_8, 400_001), f64::exp, ulps, 2.0);
    check::<Exp2>("exp2 small", &floats(1e-42, 1.0, 50_021), f64::exp2, ulps, 2.0);
    check::<Exp>("exp small", &floats(1e-42, 1.0, 50_021), f64::exp, ulps, 2.0);
    let integers: Vec<f32> = (-126..128).map(|k| k as f32).collect();
    check::<Exp2>("exp2 whole", &integers, f64::exp2, absolute, 1e-300);
    let limits = [(0.0, 1.0), (-0.0, 1.0), (DENORMAL, 1.0), (-200.0, 0.0), (200.0, INFINITY), (-INFINITY, 0.0), (INFINITY, INFINITY)];
    let mut cases: Vec<([f32; 2], f32)> = limits.iter().map(|&(x, y)| ([x, 0.0], y)).collect();
    cases.extend([([f32::NAN, 0.0], f32::NAN), ([f32::MAX, 0.0], INFINITY), ([f32::MIN, 0.0], 0.0)]);
    check_values::<Exp>("exp", &cases);
    cases.extend([([128.0, 0.0], INFINITY), ([-126.0, 0.0], f32::MIN_POSITIVE), ([-126.1, 0.0], 0.0)]);
    check_values::<Exp2>("exp2", &cases);
}

#[test]
fn logarithms() {
    let mut x = floats(f32::MIN_POSITIVE, f32::MAX, 5_003);
    x.extend(floats(0.5, 2.0, 53));
    x.extend(floats(0.999, 1.001, 1));
    check::<Log2>("log2", &x, f64::log2, relative, 1.8e-7);
    check::<Ln>("ln", &x, f64::ln, relative, 2.4e-7);
    let powers: Vec<f32> = (-126..128).map(|k| 2.0_f32.powi(k)).collect();
    check::<Log2>("log2 whole", &powers, f64::log2, absolute, 1e-300);
    let cases = [
        ([0.0, 0.0], -INFINITY),
        ([-0.0, 0.0], -INFINITY),
        ([DENORMAL, 0.0], -INFINITY),
        ([1.0, 0.0], 0.0),
        ([INFINITY, 0.0], INFINITY),
        ([-1.0, 0.0], f32::NAN),
        ([-DENORMAL, 0.0], f32::NAN),
        ([-INFINITY, 0.0], f32::NAN),
        ([f32::NAN, 0.0], f32::NAN),
    ];
    check_values::<Log2>("log2", &cases);
    check_values::<Ln>("ln", &cases);
}

#[test]
fn powers() {
    let mut pairs = Vec::new();
    for y in [-3.0, -1.0, -0.25, 1.0 / 2.4, 0.5, 1.0, 1.5, 2.4, 5.0, 20.0] {
        let limit = 2.0_f32.powf((30.0 / f32::abs(y)).min(120.0));
        pairs.extend(floats(1.0 / limit, limit, 20_011).into_iter().map(|x| [x, y]));
        pairs.extend(sweep(0.01, 3.0, 20_001).into_iter().filter(|&x| x > 1.0 / limit && x < limit).map(|x| [x, y]));
    }
    // Highlights of narrow lobes: bases near 1 and large exponents.
    pairs.extend(sweep(0.99, 1.0, 20_001).into_iter().map(|x| [x, 1000.0]));
    check2::<Pow>("pow", &pairs, f64::powf, relative, |exact| 2e-7 + 1.8e-7 * exact.ln().abs());
    check2::<NormalPow>("normal_pow", &pairs, f64::powf, relative, |exact| 2e-7 + 1.8e-7 * exact.ln().abs());
    check2::<Pow>("pow 1e-5", &pairs, f64::powf, relative, |_| 1e-5);
    let cases = [
        ([0.0, 0.0], 1.0),
        ([5.0, 0.0], 1.0),
        ([f32::NAN, 0.0], 1.0),
        ([INFINITY, -0.0], 1.0),
        ([0.0, 2.0], 0.0),
        ([0.0, 0.01], 0.0),
        ([DENORMAL, 1.0], 0.0),
        ([0.0, -1.0], INFINITY),
        ([1.0, 1e30], 1.0),
        ([2.0, 10.0], 1024.0),
        ([INFINITY, 2.0], INFINITY),
        ([INFINITY, -2.0], 0.0),
        ([-1.0, 2.0], f32::NAN),
        ([f32::NAN, 2.0], f32::NAN),
        ([2.0, f32::NAN], f32::NAN),
    ];
    check_values::<Pow>("pow", &cases);
}

#[test]
fn arcsine_and_arccosine() {
    let mut x = sweep(-1.0, 1.0, 400_001);
    x.extend(floats(0.999, 1.0, 1));
    x.extend(floats(1e-42, 0.5, 50_021));
    check::<Asin>("asin", &x, f64::asin, absolute, 2e-7);
    check::<Asin>("asin rel", &x, f64::asin, relative_or_denormal, 3e-7);
    check::<Acos>("acos", &x, f64::acos, absolute, 3e-7);
    let positive: Vec<f32> = x.iter().copied().filter(|x| *x >= 0.0).collect();
    check::<Acos>("acos rel", &positive, f64::acos, relative, 4e-7);
    let (half, whole) = (core::f32::consts::FRAC_PI_2, core::f32::consts::PI);
    let beyond = 1.0_f32.next_up();
    check_values::<Asin>("asin", &[([beyond, 0.0], half), ([-beyond, 0.0], -half), ([-0.0, 0.0], -0.0), ([f32::NAN, 0.0], f32::NAN)]);
    check_values::<Acos>("acos", &[([beyond, 0.0], 0.0), ([-beyond, 0.0], whole), ([0.0, 0.0], half), ([f32::NAN, 0.0], f32::NAN)]);
}

/// Relative error, with the spacing of denormals allowed for.
fn relative_or_denormal(got: f32, exact: f64) -> f64 {
    if exact.abs() < f64::from(f32::MIN_POSITIVE) { absolute(got, exact) } else { relative(got, exact) }
}

#[test]
fn arctangent() {
    let mut pairs = Vec::new();
    for radius in [1e-30, 1e-3, 1.0, 37.0, 1e30] {
        for angle in sweep(-core::f32::consts::PI, core::f32::consts::PI, 50_001) {
            pairs.push([radius * angle.sin(), radius * angle.cos()]);
        }
    }
    pairs.extend(floats(1e-37, 1e37, 20_011).into_iter().map(|y| [y, 1.0]));
    check2::<Atan2>("atan2", &pairs, f64::atan2, absolute, |_| 3e-7);
    check2::<Atan2>("atan2 rel", &pairs, f64::atan2, relative_or_denormal, |_| 4e-7);
    let mut cases = Vec::new();
    for y in [0.0, -0.0, 1.0, -1.0] {
        for x in [0.0, -0.0, INFINITY, -INFINITY] {
            cases.push(([y, x], y.atan2(x)));
        }
        cases.push(([INFINITY, y], f32::atan2(INFINITY, y)));
        cases.push(([f32::NAN, y], f32::NAN));
        cases.push(([y, f32::NAN], f32::NAN));
    }
    check_values::<Atan2>("atan2", &cases);
}

#[test]
fn zero_keeps_its_sign() {
    for execution in Execution::all() {
        for got in [map1::<Sin>(execution, &[-0.0]), map1::<Tan>(execution, &[-0.0]), map1::<Asin>(execution, &[-0.0])] {
            assert_eq!(got[0], 0.0, "{}", execution.name());
        }
    }
}

#[test]
fn inverse_roots() {
    let x = floats(1e-38, 3e38, 10_007);
    check::<InverseRoot>("inverse_root", &x, |x| 1.0 / x.sqrt(), ulps, 2.0);
    check_values::<InverseRoot>(
        "inverse_root",
        &[([0.0, 0.0], INFINITY), ([INFINITY, 0.0], 0.0), ([-1.0, 0.0], f32::NAN), ([f32::NAN, 0.0], f32::NAN), ([4.0, 0.0], 0.5)],
    );
}
