//! Trees fitted to points that moved.

use super::{Geometry, Instance, Mesh, OwnedRays, Random, first_hits, instance, levels, scene};
use crate::Blas;
use std::sync::Arc;

/// The tree of `before` fitted to the points of `after`.
fn refitted(before: &Mesh, after: &Mesh) -> Option<Blas> {
    before.blas().refit(&after.positions, &after.triangles)
}

fn moved(mesh: &Mesh, by: impl FnMut([f32; 3]) -> [f32; 3]) -> Mesh {
    Mesh { positions: mesh.positions.iter().copied().map(by).collect(), ..mesh.clone() }
}

#[test]
fn a_fitted_tree_is_hit_as_a_built_one() {
    let mut random = Random(61);
    let before = Mesh::soup(&mut random, 3000, 1.0, 0.1);
    let after = moved(&before, |[x, y, z]| [x + 0.3 * (2.0 * y).sin(), 1.2 * y, z + 0.1 * x * y]);
    let fitted = refitted(&before, &after).expect("a bend leaves boxes tight");
    let fitted = scene(vec![Arc::new(fitted)], &[instance(Geometry::Mesh(0), Instance::IDENTITY)]);
    let rays = OwnedRays::random(&mut random, 10_000, 1.0, true);
    for level in levels() {
        assert_eq!(first_hits(&fitted, level, &rays), first_hits(&after.scene(), level, &rays), "{level:?}");
    }
}

#[test]
fn what_would_be_slow_is_not_fitted() {
    let mut random = Random(62);
    let before = Mesh::soup(&mut random, 1000, 1.0, 0.02);
    let after = Mesh { positions: Mesh::soup(&mut random, 1000, 1.0, 0.02).positions, ..before.clone() };
    assert!(refitted(&before, &after).is_none());
}

#[test]
fn triangles_that_leave_or_enter_are_not_fitted() {
    let whole = Mesh::soup(&mut Random(63), 100, 1.0, 0.2);
    let broken = |point: usize| {
        let mut number = 0;
        moved(&whole, |p| {
            number += 1;
            if number - 1 == point { [f32::NAN; 3] } else { p }
        })
    };
    assert!(refitted(&whole, &broken(7)).is_none());
    assert!(refitted(&broken(7), &whole).is_none());
    assert!(refitted(&broken(7), &broken(100)).is_none());
    assert!(refitted(&broken(7), &broken(7)).is_some());
}
