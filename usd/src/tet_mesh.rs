//! `TetMesh` prims: the faces that bound their tetrahedra, as a mesh.

use crate::build::{MeshSource, Surface};
use crate::context::Context;
use crate::mesh::{self, ReadMesh};
use crate::prim::Prim;
use crate::primvar;
use gonio::mesh::{Interpolation, PolygonMesh};
use std::collections::HashMap;

/// Reads a prim of tetrahedra; `None`, with a report, where there is nothing to show.
pub fn read<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> Option<ReadMesh<'py>> {
    let origin = prim.origin();
    let points = mesh::points(context, prim).unwrap_or_default();
    let stated = context.get_authored::<Vec<[i32; 3]>>(prim, "surfaceFaceVertexIndices").unwrap_or_default();
    let faces = if stated.is_empty() {
        surface_faces(&context.get_authored::<Vec<[i32; 4]>>(prim, "tetVertexIndices").unwrap_or_default())
    } else {
        stated
    };
    if points.is_empty() || faces.is_empty() {
        context
            .once("mesh", "empty", &origin, || "the tetrahedra have no usable points, tetVertexIndices or surfaceFaceVertexIndices".into());
        return None;
    }
    let mut polygons = match PolygonMesh::from_signed(points, &vec![3; faces.len()], faces.as_flattened()) {
        Ok(polygons) => polygons,
        Err(problem) => {
            context.warn(&origin, format!("{problem}; the tetrahedra are left out"));
            return None;
        }
    };
    polygons.left_handed = context.left_handed(prim);
    for primvar in primvar::authored(context, prim).into_iter().chain(primvar::normals(context, prim)) {
        if matches!(primvar.interpolation, Interpolation::Constant | Interpolation::Varying | Interpolation::Vertex) {
            polygons.primvars.push(primvar);
        } else {
            context.unsupported(&format!("primvar '{}' of the faces of a TetMesh", primvar.name), &origin);
        }
    }
    let source = MeshSource { origin, polygons, surface: Surface::Polygons, face_slots: None };
    Some(ReadMesh { source, slot_prims: vec![prim.clone()] })
}

/// The faces of tetrahedra that no two of them share, seen counter-clockwise from outside of right-handed ones.
fn surface_faces(tetrahedra: &[[i32; 4]]) -> Vec<[i32; 3]> {
    let of_one = |[a, b, c, d]: [i32; 4]| [[b, c, d], [a, d, c], [a, b, d], [a, c, b]];
    let key = |face: &[i32; 3]| {
        let mut points = *face;
        points.sort_unstable();
        points
    };
    let faces: Vec<[i32; 3]> = tetrahedra.iter().copied().flat_map(of_one).collect();
    let mut counts: HashMap<[i32; 3], u32> = HashMap::with_capacity(faces.len());
    for face in &faces {
        *counts.entry(key(face)).or_default() += 1;
    }
    faces.into_iter().filter(|face| counts.get(&key(face)) == Some(&1)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shared_faces_are_inside() {
        assert_eq!(surface_faces(&[[0, 1, 2, 3]]), [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]]);
        let two = surface_faces(&[[0, 1, 2, 3], [1, 2, 3, 4]]);
        assert_eq!(two.len(), 6);
        assert!(two.iter().all(|face| *face != [1, 2, 3]));
    }
}
