//! Meshes of OBJ and PLY files.

use crate::error::exception;
use gonio::{
    Error, Result,
    mesh::{PolygonMesh, triangulate},
    scene::{Mesh, Origin, Primvar, PrimvarInterpolation, read_file},
};
use gonio_formats::polygons::{self, Polygons};
use pyo3::prelude::*;
use std::{path::Path, sync::Arc};

/// Reads a file; gives the mesh and the names of its materials, one a slot.
pub(crate) fn read(py: Python<'_>, path: &Path) -> PyResult<(Mesh, Vec<String>)> {
    py.detach(|| {
        let bytes = read_file(path).map_err(|error| Error::io(path, error))?;
        let polygons = polygons::read(&bytes).map_err(|error| Error::in_file(path, &error))?;
        mesh(path, polygons)
    })
    .map_err(exception)
}

fn mesh(path: &Path, file: Polygons) -> Result<(Mesh, Vec<String>)> {
    let Polygons { points, face_counts, corners, normals, uvs, materials, face_materials } = file;
    let polygons = PolygonMesh { points, face_counts, corners, ..PolygonMesh::default() };
    let cut = triangulate(&polygons);
    if cut.triangles.is_empty() {
        return Err(Error::Format { path: path.to_owned(), line: None, problem: "no face has a surface".to_owned() });
    }
    let of_corners: Arc<[u32]> = cut.corner_of.as_flattened().into();
    let primvar = |name: &str, components: u8, values: &[f32]| Primvar {
        name: name.to_owned(),
        interpolation: PrimvarInterpolation::FaceVarying,
        components,
        values: values.into(),
        indices: Some(of_corners.clone()),
    };
    let given = |values: &[f32]| !values.is_empty();
    let mesh = Mesh {
        origin: Origin::new(path.to_string_lossy()),
        points: polygons.points.into(),
        triangles: cut.triangles.into(),
        normals: given(normals.as_flattened()).then(|| primvar("normals", 3, normals.as_flattened())),
        primvars: given(uvs.as_flattened()).then(|| primvar("st", 2, uvs.as_flattened())).into_iter().collect(),
        slots: (materials.len() > 1).then(|| cut.face_of.iter().map(|face| face_materials[*face as usize]).collect()),
        faces: Some(cut.face_of.into()),
        ..Mesh::default()
    };
    Ok((mesh, materials))
}
