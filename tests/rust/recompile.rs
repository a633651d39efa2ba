//! What a second compilation keeps.

use gonio::{
    compile::compile,
    scene::{Material, Origin, Transform},
};
use gonio_tests::scenes::{add_quad, floor};
use std::sync::{Arc, atomic::AtomicBool};

#[test]
fn moving_an_instance_keeps_every_mesh_tree() {
    let never = AtomicBool::new(false);
    let mut scene = floor(0.5);
    add_quad(&mut scene, [0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], Material::diffuse(Origin::new("card"), [0.5; 3]));
    let first = compile(&scene, None, &never).expect("compiles");
    scene.instances[1].transforms[0] = Transform::translation([0.0, 3.0, 0.0]);
    let second = compile(&scene, Some(&first), &never).expect("compiles");
    for (before, after) in first.tables.bvh.meshes().iter().zip(second.tables.bvh.meshes()) {
        assert!(Arc::ptr_eq(before, after));
    }
    assert_eq!(second.bounds.max[1], 4.0);
}

#[test]
fn cancelling_ends_a_compilation() {
    let error = compile(&floor(0.5), None, &AtomicBool::new(true)).expect_err("cancelled");
    assert!(matches!(error, gonio::Error::Cancelled));
}
