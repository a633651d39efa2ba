//! Curves and matrices.

use super::harness::{Bench, close, inputs, on_numbers, uniform};
use crate::graph::HitStep;
use gonio_nodes::{Curve, Kernel};
use serde_json::json;

const RANGE: [f64; 2] = [-0.5, 2.0];

/// Arguments within the range, beyond it, and at its ends.
fn number(column: usize, i: usize) -> f32 {
    [-0.5, 2.0, 0.0, 1e6, -1e6].get(i).copied().unwrap_or(uniform(40, 9 * i + column) * 4.0 - 1.5)
}

/// Where an argument lies in a table, in rows.
fn place(rows: usize, x: f64) -> f64 {
    ((x - RANGE[0]) / (RANGE[1] - RANGE[0])).clamp(0.0, 1.0) * (rows - 1) as f64
}

fn expected(table: &[[f32; 4]], [linear, extrapolate]: [bool; 2], x: f64, column: usize) -> f64 {
    let entry = |row: usize| f64::from(table[row][column]);
    let last = table.len() - 1;
    let place = place(table.len(), x);
    let value = if linear {
        let below = (place.floor() as usize).min(last - 1);
        entry(below) + (entry(below + 1) - entry(below)) * (place - below as f64)
    } else {
        entry(((place + 1e-5).floor() as usize).min(last))
    };
    let row = (RANGE[1] - RANGE[0]) / last as f64;
    let below = (x - RANGE[0]).min(0.0) * (entry(1) - entry(0)) / row;
    let above = (x - RANGE[1]).max(0.0) * (entry(last) - entry(last - 1)) / row;
    if extrapolate { value + below + above } else { value }
}

#[test]
fn curves_follow_their_tables() {
    for rows in [2, 7, 256] {
        let table: Vec<[f32; 4]> = (0..rows).map(|row| [0, 1, 2, 3].map(|k| uniform(41, row * 4 + k))).collect();
        for kinds in [[true, true], [true, false], [false, true], [false, false]] {
            let operation = json!({ "Curve": { "table": table, "range": RANGE, "linear": kinds[0], "extrapolate": kinds[1] } });
            Bench::with_numbers(&on_numbers(&operation), number).check(|i, found| {
                for (k, x) in inputs(number, i)[0].map(f64::from).into_iter().enumerate() {
                    let expected = expected(&table, kinds, x, k);
                    // Right at a step either row is right, for the place is known to 10⁻⁷ of the table only.
                    let fraction = place(rows, x).fract();
                    if kinds[0] || fraction == 0.0 || (0.001..0.999).contains(&fraction) {
                        close(found[k], expected, 1e-4 + 1e-6 * expected.abs(), &format!("{rows} rows {kinds:?} at {x}"));
                    }
                }
            });
        }
    }
}

#[test]
fn poor_tables_are_harmless() {
    for (table, value) in [(json!([]), [0.0; 4]), (json!([[1.0, 2.0, 3.0, 4.0]]), [1.0, 2.0, 3.0, 4.0])] {
        for range in [[0.0, 1.0], [1.0, 1.0]] {
            let operation = json!({ "Curve": { "table": table, "range": range, "linear": true, "extrapolate": true } });
            Bench::with_numbers(&on_numbers(&operation), number).check(|_, found| assert_eq!(found, value));
        }
    }
    let broken = Curve::new([f32::NAN; 2].into_iter(), [f32::INFINITY, 0.0], true, true);
    assert_eq!(broken, Curve::new([0.0; 2].into_iter(), [0.0, 0.0], true, true));
}

#[test]
fn matrices_move_points() {
    let rows = [[0.0, 2.0, 0.0, 3.0], [-8.0, 0.0, 0.5, -1.0], [0.25, 0.0, 4.0, 0.0]];
    let moved = |column: usize, i: usize| number(column, i + 5);
    Bench::with_numbers(&on_numbers(&json!({ "Transform3d": { "rows": rows } })), moved).check(|i, found| {
        let v = inputs(moved, i)[0].map(f64::from);
        for (k, row) in rows.iter().enumerate() {
            close(found[k], row[0] * v[0] + row[1] * v[1] + row[2] * v[2] + row[3], 1e-5, "Transform3d");
        }
        assert_eq!(found[3], v[3] as f32);
    });
}

/// The footprint of the last image of a graph that looks it up at `coordinates`, the last of these nodes.
fn footprint(mut coordinates: Vec<serde_json::Value>) -> f32 {
    let node = |number: usize| json!({ "Node": [number, "Rgb"] });
    let image = json!({ "Image": {
        "texture": 0, "wrap": ["Repeat", "Repeat"], "filter": "Linear",
        "scale": [1, 1, 1, 1], "bias": [0, 0, 0, 0], "fallback": [0, 0, 0, 0]
    } });
    coordinates.push(json!({ "operation": image, "inputs": [node(coordinates.len() - 1)] }));
    let program = Bench::new(&json!(coordinates)).last();
    let footprints = program.kernels().filter_map(|kernel| match kernel {
        Kernel::Hit(HitStep::Image { footprint, .. }) => Some(*footprint),
        _ => None,
    });
    footprints.last().expect("an image")
}

#[test]
fn footprints_follow_matrices_alone() {
    let rows = [[0.0, 2.0, 0.0, 3.0], [-8.0, 0.0, 0.5, -1.0], [0.25, 0.0, 4.0, 0.0]];
    let first = json!([{ "Node": [0, "Rgb"] }]);
    let primvar = json!({ "operation": { "Primvar": { "name": "st", "fallback": [0, 0, 0, 0] } }, "inputs": [] });
    assert_eq!(footprint(vec![primvar.clone(), json!({ "operation": { "Transform3d": { "rows": rows } }, "inputs": first })]), 4.0);
    // What is bent, and what follows no coordinates of the mesh, is read from the finest level.
    assert_eq!(footprint(vec![primvar, json!({ "operation": "ArcCosine", "inputs": first })]), 0.0);
    assert_eq!(footprint(vec![json!({ "operation": "Position", "inputs": [] })]), 0.0);
}
