//! Which primvars materials read, and their layout in the value tables.

use super::fill::append_values;
use super::measured::CompiledMeasured;
use crate::{
    geometry::{GeometryTable, NONE, PrimvarKind, PrimvarRef},
    scene::{Aov, Closure, Input, Mesh, Operation, PRIMVARS, Primvar, PrimvarInterpolation, Scene},
};

/// What texture coordinates are called, the likeliest first.
pub(super) const COORDINATES: [&str; 4] = ["st", "UVMap", "map1", "uv"];

/// Names of the primvars that any material reads; their columns follow the one of the normals.
pub(super) fn used_names(scene: &Scene, measured: &CompiledMeasured) -> Vec<String> {
    let mut names = Vec::new();
    let mut add = |name: &str| {
        if !names.iter().any(|known| known == name) {
            names.push(name.to_owned());
        }
    };
    for node in scene.materials.iter().flat_map(|material| &material.graph.nodes) {
        match &node.operation {
            Operation::Primvar { name, .. } | Operation::PrimvarStep { name, .. } => add(name),
            Operation::UvTangent { uv } | Operation::NormalMap { uv: Some(uv), .. } => add(uv),
            _ => {}
        }
    }
    // Surfaces without a material show them too.
    scene.settings.shader_passes.iter().filter_map(|name| name.strip_prefix(PRIMVARS)).for_each(&mut add);
    let closures = || scene.materials.iter().flat_map(|material| &material.closures);
    if scene.settings.aovs.contains(&Aov::Uv) || closures().any(|closure| lies_along_coordinates(closure, measured)) {
        let there = |name: &str| {
            let mut primvars = scene.meshes.iter().map(|mesh| &mesh.primvars).chain(scene.instances.iter().map(|placed| &placed.primvars));
            primvars.any(|primvars| primvars.iter().any(|primvar| primvar.name == name))
        };
        COORDINATES.into_iter().filter(|name| there(name)).for_each(add);
    }
    names
}

/// Whether a surface depends on its tangent, and that follows texture coordinates.
fn lies_along_coordinates(closure: &Closure, measured: &CompiledMeasured) -> bool {
    let anisotropy = closure.input("specular_anisotropy").is_some_and(|input| !matches!(input, Input::Constant([0.0, ..])));
    let fibre = closure.model.is_fibre();
    closure.tangent.is_none() && (anisotropy || fibre || measured.of(closure).is_some_and(|measured| !measured.is_isotropic()))
}

/// The column of a name.
pub(super) fn column(names: &[String], name: &str) -> Option<usize> {
    names.iter().position(|known| known == name).map(|i| i + 1)
}

/// How many elements an interpolation has.
#[derive(Clone, Copy, Debug)]
pub(super) struct Elements {
    pub(super) uniform: usize,
    pub(super) points: usize,
    pub(super) corners: usize,
}

impl Elements {
    fn count(&self, interpolation: PrimvarInterpolation) -> usize {
        match interpolation {
            PrimvarInterpolation::Constant => 1,
            PrimvarInterpolation::Uniform => self.uniform,
            PrimvarInterpolation::Vertex | PrimvarInterpolation::Varying => self.points,
            PrimvarInterpolation::FaceVarying => self.corners,
        }
    }
}

/// How many elements a mesh has.
pub(super) fn elements(mesh: &Mesh) -> Elements {
    Elements { uniform: mesh.triangles.len(), points: mesh.points.len(), corners: mesh.triangles.len() * 3 }
}

/// A checked primvar's value at a corner of a mesh, three a triangle.
pub(super) fn at_corner<'a>(primvar: &'a Primvar, corner: usize, mesh: &Mesh) -> &'a [f32] {
    let element = match primvar.interpolation {
        PrimvarInterpolation::Constant => 0,
        PrimvarInterpolation::Uniform => corner / 3,
        PrimvarInterpolation::Varying | PrimvarInterpolation::Vertex => mesh.triangles[corner / 3][corner % 3] as usize,
        PrimvarInterpolation::FaceVarying => corner,
    };
    let element = primvar.indices.as_ref().map_or(element, |indices| indices[element] as usize);
    let width = usize::from(primvar.components);
    &primvar.values[element * width..(element + 1) * width]
}

/// What is wrong with a primvar's arrays, if anything.
pub(super) fn problem(primvar: &Primvar, elements: Elements) -> Option<String> {
    let components = usize::from(primvar.components);
    if !(1..=4).contains(&components) {
        return Some(format!("primvar '{}' has {components} components, expected 1 to 4", primvar.name));
    }
    let expected = elements.count(primvar.interpolation);
    let values = primvar.values.len() / components;
    let found = primvar.indices.as_ref().map_or(values, |indices| indices.len());
    if found < expected {
        return Some(format!("primvar '{}' has {found} elements, expected {expected} ({:?})", primvar.name, primvar.interpolation));
    }
    let largest = primvar.indices.as_ref().and_then(|indices| indices.iter().max().copied());
    match largest {
        Some(index) if index as usize >= values => Some(format!("primvar '{}' has index {index}, but only {values} values", primvar.name)),
        _ => None,
    }
}

/// Puts a checked primvar's arrays into the tables.
pub(super) fn append(primvar: &Primvar, table: &mut GeometryTable) -> PrimvarRef {
    let first_value = table.values.len() as u32;
    append_values(&mut table.values, &primvar.values);
    let first_index = match &primvar.indices {
        Some(indices) => {
            let first = table.value_indices.len() as u32;
            append_values(&mut table.value_indices, indices);
            first
        }
        None => NONE,
    };
    let kind = match primvar.interpolation {
        PrimvarInterpolation::Constant => PrimvarKind::Constant,
        PrimvarInterpolation::Uniform => PrimvarKind::Uniform,
        PrimvarInterpolation::Vertex | PrimvarInterpolation::Varying => PrimvarKind::Vertex,
        PrimvarInterpolation::FaceVarying => PrimvarKind::FaceVarying,
    };
    PrimvarRef { kind, components: u32::from(primvar.components), first_value, first_index }
}
