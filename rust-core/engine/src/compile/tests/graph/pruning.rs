//! Steps that nothing reads.

use super::harness::{Bench, close, read, triple};
use crate::graph::{CHUNK, HitStep, Wanted, WantedOutput};
use gonio_nodes::Kernel;
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
    let value = |node: u16| bench.code().value(read(node));
    let program = bench.program(Wanted {
        outputs: vec![WantedOutput { offset: 0, width: 3, value: value(4), range: None }],
        coat_normal: Some(value(1)),
        ..Wanted::default()
    });
    let kernels: Vec<_> = program.kernels().collect();
    let is_point = |kernel: &&Kernel<HitStep>| matches!(kernel, Kernel::Hit(HitStep::Point(_)));
    // A position, a normal, and a sum of each of three components.
    assert_eq!((kernels.iter().copied().filter(|kernel| is_point(kernel)).count(), kernels.len()), (2, 5), "{kernels:?}");
    for execution in Execution::all() {
        let (points, values) = bench.run_program(&program, execution);
        for i in 0..CHUNK {
            let (normal, height) =
                (triple(&bench.points.shading_normal, i), f64::from(bench.points.position[1][i] + bench.points.origin[1]));
            for (k, part) in normal.into_iter().enumerate() {
                close(values.column(k)[i], part + height, 1e-3, "sum");
            }
            assert!(points.coat_normal.iter().any(|column| column[i] != 0.0));
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
