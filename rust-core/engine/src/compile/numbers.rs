//! One row of numbers for all geometry: meshes, behind them curves, behind these points.

use crate::scene::{Geometry, Scene};

/// The number of a set's geometry among all of the scene; beyond all of them for one that does not exist.
pub(super) fn geometry_number(scene: &Scene, geometry: Geometry) -> usize {
    let (first, number, count) = match geometry {
        Geometry::Mesh(mesh) => (0, mesh.index(), scene.meshes.len()),
        Geometry::Curves { curves } => (scene.meshes.len(), curves.index(), scene.curves.len()),
        Geometry::Points { points } => (scene.meshes.len() + scene.curves.len(), points.index(), scene.points.len()),
    };
    if number < count { first + number } else { usize::MAX }
}

/// What geometry is called in messages.
pub(super) fn named(geometry: Geometry) -> String {
    match geometry {
        Geometry::Mesh(mesh) => format!("mesh {}", mesh.0),
        Geometry::Curves { curves } => format!("curves {}", curves.0),
        Geometry::Points { points } => format!("points {}", points.0),
    }
}
