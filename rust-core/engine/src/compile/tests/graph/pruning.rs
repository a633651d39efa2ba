//! Steps that nothing reads.

use super::harness::{Bench, read};
use crate::graph::{Output, Program, Source, Step};
use gonio_simd::Execution;
use serde_json::json;

#[test]
fn steps_that_nothing_reads_are_left_out() {
    let node = |number: usize| json!({ "Node": [number, "Rgb"] });
    let bench = Bench::new(&json!([
        { "operation": "Incoming", "inputs": [] },
        { "operation": "Position", "inputs": [] },
        { "operation": "Sine", "inputs": [node(0)] },
        { "operation": "Normal", "inputs": [] },
        { "operation": "Add", "inputs": [node(3), { "Node": [1, "G"] }] },
        { "operation": "Cosine", "inputs": [node(2)] }
    ]));
    let whole =
        Program { outputs: vec![Output { offset: 0, width: 3, source: Source::Register(4) }], coat_normal: Some(1), ..bench.program() };
    let pruned = whole.clone().pruned();
    assert!(matches!(pruned.steps.as_slice(), [Step::Hit(_), Step::Hit(_), Step::Arithmetic { .. }]), "{:?}", pruned.steps);
    assert_eq!((pruned.coat_normal, pruned.outputs[0].source), (Some(0), Source::Register(2)));
    for execution in Execution::all() {
        let ((points, values), (points_before, values_before)) =
            (bench.run_program(&pruned, execution), bench.run_program(&whole, execution));
        for k in 0..3 {
            assert_eq!(values.column(k), values_before.column(k));
            assert_eq!(points.coat_normal[k][..], points_before.coat_normal[k][..]);
        }
    }
}

#[test]
fn a_node_that_is_not_there_is_an_error() {
    use crate::{
        compile::compile,
        scene::{Material, Origin, Scene},
    };
    let mut scene = Scene::default();
    let mut material = Material::diffuse(Origin::new("Lost"), [0.5; 3]);
    material.closures[0].parameters.push(("base_color".into(), read(3)));
    scene.add_material(material);
    let error = compile(&scene, None, &false.into()).expect_err("no such node").to_string();
    assert!(error.contains("Lost") && error.contains("node 3"), "{error}");
}
