//! Meshes of diced triangles: all that belonged to points, corners and triangles carried over.

use super::super::primvars::{at_corner, elements, problem};
use crate::{
    mesh::Diced,
    scene::{Mesh, MeshKey, Primvar, PrimvarInterpolation},
};
use std::sync::Arc;

/// The corners' normals of a mesh that has usable ones, else none.
pub(super) fn corner_normals(mesh: &Mesh, normals: Option<&Primvar>) -> Vec<[f32; 3]> {
    let usable = normals.filter(|normals| normals.components == 3 && problem(normals, elements(mesh)).is_none());
    let Some(normals) = usable else { return Vec::new() };
    let of = |corner: usize| {
        let value = at_corner(normals, corner, mesh);
        [value[0], value[1], value[2]]
    };
    (0..mesh.triangles.len() * 3).map(of).collect()
}

/// The mesh that a diced one is.
pub(super) fn made(source: &Mesh, diced: &Diced) -> Mesh {
    let of_source =
        |values: &dyn Fn(usize) -> u32| diced.triangles.iter().map(|triangle| values(triangle.source as usize)).collect::<Vec<u32>>();
    let whole = |primvar: &&Primvar| problem(primvar, elements(source)).is_none();
    let slots = source.slots.as_ref().filter(|slots| slots.len() == source.triangles.len());
    Mesh {
        origin: source.origin.clone(),
        motion: source.motion.iter().map(|key| key_of(source, key, diced)).collect(),
        triangles: diced.triangles.iter().map(|triangle| triangle.points).collect(),
        normals: source.normals.as_ref().filter(whole).map(|normals| normals_of(source, normals, diced)),
        primvars: source.primvars.iter().filter(whole).map(|primvar| carried(source, primvar, diced)).collect(),
        slots: slots.map(|slots| diced.triangles.iter().map(|triangle| slots[triangle.source as usize]).collect()),
        faces: Some(Arc::from(of_source(&|triangle| source.faces.as_ref().map_or(triangle as u32, |faces| faces[triangle])))),
        points: Arc::from(diced.points.as_slice()),
        dicing: None,
    }
}

/// Shading normals as dicing made them.
fn normals_of(source: &Mesh, normals: &Primvar, diced: &Diced) -> Primvar {
    let values: Vec<[f32; 3]> = match normals.interpolation {
        PrimvarInterpolation::FaceVarying if normals.components == 3 => {
            diced.triangles.iter().flat_map(|triangle| triangle.normals).collect()
        }
        PrimvarInterpolation::Varying | PrimvarInterpolation::Vertex if normals.components == 3 => {
            let mut of_points = vec![[0.0, 0.0, 1.0]; diced.points.len()];
            for triangle in &diced.triangles {
                triangle.points.iter().zip(triangle.normals).for_each(|(point, normal)| of_points[*point as usize] = normal);
            }
            of_points
        }
        _ => return carried(source, normals, diced),
    };
    Primvar { values: Arc::from(values.as_flattened()), indices: None, ..normals.clone() }
}

/// A key's points and normals; a new point is as far off the middle as it is in the mesh itself.
fn key_of(source: &Mesh, key: &MeshKey, diced: &Diced) -> MeshKey {
    let mut points = key.points.to_vec();
    if points.len() == source.points.len() {
        for ([a, b], off) in &diced.parents {
            let [a, b] = [a, b].map(|point| points[*point as usize]);
            points.push([0, 1, 2].map(|k| 0.5 * (a[k] + b[k]) + off[k]));
        }
    }
    let at_key = |normals: &Primvar| key.normals.as_ref().map(|values| Primvar { values: values.clone(), ..normals.clone() });
    let normals = source.normals.as_ref().and_then(at_key).filter(|normals| problem(normals, elements(source)).is_none());
    MeshKey { points: Arc::from(points), normals: normals.map(|normals| carried(source, &normals, diced).values) }
}

/// A checked primvar over the diced triangles, even between the corners of what they are parts of.
fn carried(source: &Mesh, primvar: &Primvar, diced: &Diced) -> Primvar {
    let width = usize::from(primvar.components);
    let (values, indices) = match primvar.interpolation {
        PrimvarInterpolation::Constant => (primvar.values.clone(), primvar.indices.clone()),
        PrimvarInterpolation::Uniform => {
            let of = |triangle: u32| primvar.indices.as_ref().map_or(triangle, |indices| indices[triangle as usize]);
            (primvar.values.clone(), Some(diced.triangles.iter().map(|triangle| of(triangle.source)).collect()))
        }
        PrimvarInterpolation::Varying | PrimvarInterpolation::Vertex => {
            let of = |point: usize| primvar.indices.as_ref().map_or(point, |indices| indices[point] as usize) * width;
            let mut values: Vec<f32> = (0..source.points.len()).flat_map(|p| &primvar.values[of(p)..of(p) + width]).copied().collect();
            for ([a, b], _) in &diced.parents {
                for k in 0..width {
                    values.push(0.5 * (values[*a as usize * width + k] + values[*b as usize * width + k]));
                }
            }
            (Arc::from(values), None)
        }
        PrimvarInterpolation::FaceVarying => {
            let mut values = Vec::with_capacity(diced.triangles.len() * 3 * width);
            for triangle in &diced.triangles {
                let corners = [0, 1, 2].map(|k| at_corner(primvar, 3 * triangle.source as usize + k, source));
                for [u, v] in triangle.places {
                    values.extend((0..width).map(|k| corners[0][k] * (1.0 - u - v) + corners[1][k] * u + corners[2][k] * v));
                }
            }
            (Arc::from(values), None)
        }
    };
    Primvar { values, indices, ..primvar.clone() }
}
