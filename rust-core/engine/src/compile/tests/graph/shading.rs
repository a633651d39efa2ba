//! Values that depend on the hit.

use super::{
    harness::{Bench, COLUMNS, PLACE, POINTS, TRIANGLES, close, dot, leaf, read, three, triple},
    steps::{uv_change, uv_directions},
};
use crate::graph::{CHUNK, Wanted};
use gonio_simd::{Column, Execution};
use serde_json::{Value, json};

fn corners(bench: &Bench, i: usize) -> [[f64; 3]; 3] {
    TRIANGLES[bench.points.primitive[i] as usize].map(|point| POINTS[point as usize].map(f64::from))
}

fn object_point(bench: &Bench, i: usize) -> [f64; 3] {
    let [u, v] = [0, 1].map(|k| f64::from(bench.points.barycentric[k][i]));
    let corners = corners(bench, i);
    [0, 1, 2].map(|k| corners[0][k] * (1.0 - u - v) + corners[1][k] * u + corners[2][k] * v)
}

#[test]
fn leaves_are_the_columns_of_the_hit() {
    let same = |name: &str, columns: fn(&Bench) -> &[Column; 3]| {
        let bench = leaf(&json!(name));
        bench.check(|i, found| {
            let [x, y, z] = triple(columns(&bench), i).map(|x| x as f32);
            assert_eq!(found, [x, y, z, 0.0], "{name}");
        });
    };
    same("Normal", |bench| &bench.points.shading_normal);
    same("GeometricNormal", |bench| &bench.points.geometric_normal);
    same("Incoming", |bench| &bench.points.wo);
    let bench = leaf(&json!("FrontFacing"));
    bench.check(|i, found| assert_eq!(found, [f32::from(bench.points.side[i] > 0.0); 4]));
    let front = bench.points.side.iter().filter(|side| **side > 0.0).count();
    assert!((50..206).contains(&front), "hits on both sides: {front}");
}

#[test]
fn positions_are_those_of_the_world() {
    let bench = leaf(&json!("Position"));
    assert!(bench.points.origin.iter().any(|x| x.abs() > 100.0), "the scene is rebased");
    bench.check(|i, found| {
        let p = object_point(&bench, i);
        for k in 0..3 {
            let expected = PLACE[k] + (0..3).map(|axis| COLUMNS[axis][k] * p[axis]).sum::<f64>();
            close(found[k], expected, 3e-4, "Position");
        }
    });
}

/// A leaf carried through changes of space.
fn carried(leaf: &str, quantity: &str, spaces: &[[&str; 2]]) -> Bench {
    let mut nodes = vec![json!({ "operation": leaf, "inputs": [] })];
    for (number, [from, to]) in spaces.iter().enumerate() {
        let operation = json!({ "Transform": { "from": from, "to": to, "quantity": quantity } });
        nodes.push(json!({ "operation": operation, "inputs": [{ "Node": [number, "Rgb"] }] }));
    }
    Bench::new(&Value::from(nodes))
}

const IN: [&str; 2] = ["World", "Object"];
const OUT: [&str; 2] = ["Object", "World"];

#[test]
fn points_are_known_in_object_space() {
    let bench = carried("Position", "Point", &[IN]);
    bench.check(|i, found| {
        let expected = object_point(&bench, i);
        (0..3).for_each(|k| close(found[k], expected[k], 1e-3, "Position in object space"));
    });
    let bench = carried("Position", "Point", &[IN, OUT]);
    let world = leaf(&json!("Position")).run(Execution::Scalar);
    bench.check(|i, found| (0..3).for_each(|k| close(found[k], f64::from(world[i][k]), 1e-3, "Position there and back")));
}

#[test]
fn vectors_and_normals_go_to_the_object_and_back() {
    let bench = carried("Incoming", "Vector", &[IN, OUT]);
    bench.check(|i, found| {
        let expected = triple(&bench.points.wo, i);
        (0..3).for_each(|k| close(found[k], expected[k], 1e-5, "Incoming there and back"));
    });
    let bench = carried("GeometricNormal", "Normal", &[IN, OUT]);
    bench.check(|i, found| {
        let expected = triple(&bench.points.geometric_normal, i);
        (0..3).for_each(|k| close(found[k], expected[k], 1e-5, "GeometricNormal there and back"));
    });
}

#[test]
fn vectors_in_object_space_lead_there() {
    let bench = carried("Incoming", "Vector", &[IN]);
    bench.check(|i, found| {
        let local = three(found);
        let world = triple(&bench.points.wo, i);
        for k in 0..3 {
            let mapped: f64 = (0..3).map(|axis| COLUMNS[axis][k] * local[axis]).sum();
            assert!((mapped - world[k]).abs() < 1e-5, "{mapped}, {world:?}");
        }
    });
}

#[test]
fn normals_in_object_space_are_perpendicular_there() {
    let bench = carried("GeometricNormal", "Normal", &[IN]);
    bench.check(|i, found| {
        let normal = three(found);
        let corners = corners(&bench, i);
        for corner in [1, 2] {
            let edge = [0, 1, 2].map(|k| corners[corner][k] - corners[0][k]);
            assert!(dot(edge, normal).abs() < 1e-6, "{}", dot(edge, normal));
        }
        assert!((dot(normal, normal) - 1.0).abs() < 1e-6);
    });
}

#[test]
fn a_space_to_itself_changes_nothing() {
    let bench = carried("Incoming", "Normal", &[["Object", "Object"]]);
    bench.check(|i, found| assert_eq!(found[..3], triple(&bench.points.wo, i).map(|x| x as f32)));
}

#[test]
fn tangents_follow_the_first_coordinate() {
    let bench = leaf(&json!({ "UvTangent": { "uv": "st" } }));
    bench.check(|i, found| {
        let tangent = three(found);
        let [du, dv] = uv_change(bench.points.primitive[i] as usize, tangent);
        assert!((dot(tangent, tangent) - 1.0).abs() < 1e-5);
        assert!(du > 0.0 && dv.abs() < 1e-4 * du, "{du}, {dv}");
    });
    leaf(&json!({ "UvTangent": { "uv": "absent" } })).check(|_, found| assert_eq!(found, [0.0; 4]));
}

fn normal_map(uv: &str, map: [f64; 3]) -> Bench {
    let operation = json!({ "NormalMap": { "scale": 1.0, "uv": uv } });
    Bench::new(&json!([{ "operation": operation, "inputs": [{ "Constant": [map[0], map[1], map[2], 0.0] }] }]))
}

#[test]
fn normal_maps_follow_named_coordinates() {
    let map = [0.3, 0.4, 0.8];
    let length = dot(map, map).sqrt();
    let bench = normal_map("st", map);
    bench.check(|i, found| {
        let side = f64::from(bench.points.side[i]);
        let bent = three(found).map(|x| x * side);
        let smooth = triple(&bench.points.shading_normal, i).map(|x| x * side);
        assert!((dot(bent, smooth) - map[2] / length).abs() < 1e-5, "the part along the normal");
        // In the plane of the smooth normal: along u, and to the side on which v grows, mirrored coordinates or not.
        let flat = |v: [f64; 3]| [0, 1, 2].map(|k| v[k] - smooth[k] * dot(v, smooth));
        let [along, across] = uv_directions(bench.points.primitive[i] as usize).map(flat);
        let rest = [0, 1, 2].map(|k| across[k] - along[k] * dot(across, along) / dot(along, along));
        for (direction, expected) in [(along, map[0]), (rest, map[1])] {
            let part = dot(bent, direction) / dot(direction, direction).sqrt();
            assert!((part - expected / length).abs() < 1e-4, "{part}, {expected} of {length}");
        }
    });
}

#[test]
fn normal_maps_without_coordinates_leave_the_normal() {
    let bench = normal_map("absent", [0.5, 0.0, 0.5]);
    bench.check(|i, found| {
        let expected = triple(&bench.points.shading_normal, i);
        (0..3).for_each(|k| close(found[k], expected[k], 1e-6, "normal"));
    });
}

#[test]
fn any_vector_bends_the_normals() {
    let node = |number: usize| json!({ "Node": [number, "Rgb"] });
    let bench = Bench::new(&json!([
        { "operation": "Normal", "inputs": [] },
        { "operation": "Incoming", "inputs": [] },
        { "operation": "Add", "inputs": [node(0), node(1)] }
    ]));
    let sum = bench.code().value(read(2));
    let program = bench.program(Wanted { normal: Some(sum), coat_normal: Some(sum), free_normal: true, ..Wanted::default() });
    for execution in Execution::all() {
        let (after, _) = bench.run_program(&program, execution);
        for i in 0..CHUNK {
            let (normal, wo) = (triple(&bench.points.shading_normal, i), triple(&bench.points.wo, i));
            let half = [0, 1, 2].map(|k| normal[k] + wo[k]);
            let length = dot(half, half).sqrt();
            for k in 0..3 {
                close(after.shading_normal[k][i], half[k] / length, 1e-4, "bent");
                close(after.coat_normal[k][i], half[k] / length, 1e-4, "coat");
                close(after.smooth_normal[k][i], normal[k], 0.0, "smooth");
            }
        }
    }
}

#[test]
fn any_vector_counts_as_the_unbent_normal() {
    let bench = Bench::new(&json!([{ "operation": "Normal", "inputs": [] }, { "operation": "Incoming", "inputs": [] }]));
    let [normal, incoming] = [0, 1].map(|number| bench.code().value(read(number)));
    let wanted = Wanted { normal: Some(normal), smooth_normal: Some(incoming), free_normal: true, ..Wanted::default() };
    let program = bench.program(wanted);
    for execution in Execution::all() {
        let (after, _) = bench.run_program(&program, execution);
        for i in 0..CHUNK {
            let (normal, wo) = (triple(&bench.points.shading_normal, i), triple(&bench.points.wo, i));
            for k in 0..3 {
                close(after.shading_normal[k][i], normal[k], 1e-4, "bent");
                close(after.smooth_normal[k][i], wo[k], 1e-4, "unbent");
            }
        }
    }
}
