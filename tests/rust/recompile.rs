//! What a second compilation keeps.

use gonio::{
    compile::compile,
    scene::{Aov, LightShape, Material, Origin, Transform},
};
use gonio_simd::Execution;
use gonio_tests::{
    picture::{compiled, render, settings},
    scenes::{add_quad, add_triangles, camera_from_above, facing_down, floor, light},
};
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

/// The tree of a mesh whose points moved is fitted to them, not built; no ray sees the difference.
#[test]
fn a_bent_mesh_looks_as_if_it_had_been_built_so() {
    let bent = |height: f32| {
        let mut scene = floor(0.5);
        let points: Vec<[f32; 3]> = (0..400).map(|i| [(i % 20) as f32 * 0.1, height * ((i % 7) as f32), (i / 20) as f32 * 0.1]).collect();
        let quads = (0..361).map(|i| i / 19 * 20 + i % 19);
        let triangles: Vec<[u32; 3]> = quads.flat_map(|i| [[i, i + 20, i + 1], [i + 1, i + 20, i + 21]]).collect();
        add_triangles(&mut scene, &points, &triangles, Material::diffuse(Origin::new("sheet"), [0.5; 3]));
        scene.cameras.push(camera_from_above([1.0, 5.0, 1.0], 3.0));
        scene.lights.push(light(LightShape::Sphere { radius: 0.2 }, facing_down([1.0, 2.0, 1.0]), [4.0; 3]));
        scene
    };
    let never = AtomicBool::new(false);
    let flat = compile(&bent(0.01), None, &never).expect("compiles");
    let fitted = Arc::new(compile(&bent(0.03), Some(&flat), &never).expect("compiles"));
    let built = compiled(&bent(0.03));
    let settings = settings(64, 4, &[Aov::Color]);
    assert!(render(&fitted, &settings, Execution::best()) == render(&built, &settings, Execution::best()));
}

#[test]
fn cancelling_ends_a_compilation() {
    let error = compile(&floor(0.5), None, &AtomicBool::new(true)).expect_err("cancelled");
    assert!(matches!(error, gonio::Error::Cancelled));
}
