//! Operations on vectors and colours.

use super::harness::{Bench, close, dot, inputs, on_numbers, uniform};
use serde_json::json;

/// Random components, and vectors that are zero, very short and very long.
fn number(column: usize, i: usize) -> f32 {
    let random = uniform(30, 9 * i + column) * 4.0 - 1.0;
    random * [0.0, 1e-25, -1e15, 1.0].get(i).copied().unwrap_or(1.0)
}

/// Runs an operation and compares it with a formula of its first two inputs, relative to the product of the inputs' sizes.
fn compare(name: &str, formula: impl Fn([f64; 4], [f64; 4]) -> [f64; 4]) {
    Bench::with_numbers(&on_numbers(&json!(name)), number).check(|i, found| {
        let [a, b, _] = inputs(number, i).map(|input| input.map(f64::from));
        let size = |v: [f64; 4]| v.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
        let expected = formula(a, b);
        for k in 0..4 {
            close(found[k], expected[k], 1e-6 * size(a) * size(b), &format!("{name}, component {k} of {a:?}, {b:?}"));
        }
    });
}

fn first([x, y, z, _]: [f64; 4]) -> [f64; 3] {
    [x, y, z]
}

#[test]
fn products_of_vectors() {
    compare("Dot", |a, b| [dot(first(a), first(b)); 4]);
    compare("Luminance", |a, _| [dot(first(a), [0.2126, 0.7152, 0.0722]); 4]);
    compare("Cross", |a, b| [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0], 0.0]);
}

#[test]
fn unit_vectors_of_any_length() {
    Bench::with_numbers(&on_numbers(&json!("Normalize")), number).check(|i, found| {
        let a = first(inputs(number, i)[0].map(f64::from));
        let length = dot(a, a).sqrt();
        for k in 0..3 {
            close(found[k], if length == 0.0 { 0.0 } else { a[k] / length }, 1e-6, &format!("Normalize of {a:?}"));
        }
        assert_eq!(found[3], 0.0);
    });
}

fn hsv_to_rgb([h, s, v, alpha]: [f64; 4]) -> [f64; 4] {
    let pure = |offset: f64| (((h + offset).rem_euclid(1.0) * 6.0 - 3.0).abs() - 1.0).clamp(0.0, 1.0);
    let [r, g, b] = [0.0, 2.0 / 3.0, 1.0 / 3.0].map(|offset| ((pure(offset) - 1.0) * s + 1.0) * v);
    [r, g, b, alpha]
}

#[test]
fn hue_to_colour() {
    let colour = |column: usize, i: usize| uniform(31, 9 * i + column) * 2.0 - 0.5;
    Bench::with_numbers(&on_numbers(&json!("HsvToRgb")), colour).check(|i, found| {
        let expected = hsv_to_rgb(inputs(colour, i)[0].map(f64::from));
        (0..4).for_each(|k| close(found[k], expected[k], 1e-5, "HsvToRgb"));
    });
}

#[test]
fn colour_to_hue_and_back() {
    // Greys and primaries, where two or three components are equal, among random colours.
    let colour = |column: usize, i: usize| match i {
        0..27 => [0.0, 0.5, 1.0][i / [1, 3, 9][column % 3] % 3],
        _ => uniform(32, 9 * i + column) * 2.0,
    };
    Bench::with_numbers(&on_numbers(&json!("RgbToHsv")), colour).check(|i, found| {
        let rgb = inputs(colour, i)[0].map(f64::from);
        let [h, s, v, _] = found.map(f64::from);
        assert!((0.0..=1.0).contains(&h) && (0.0..=1.0).contains(&s), "{found:?} of {rgb:?}");
        assert_eq!(v, rgb[0].max(rgb[1]).max(rgb[2]));
        let back = hsv_to_rgb(found.map(f64::from));
        (0..4).for_each(|k| close(back[k] as f32, rgb[k], 5e-6, &format!("RgbToHsv of {rgb:?}")));
    });
}
