//! What of a prim is in the scene: triangles, and where they come from.

use crate::context::Context;
use crate::prim::Prim;
use crate::quadrics;
use crate::stage::Loaded;
use gonio::scene::MeshId;
use pyo3::prelude::*;

/// Lines about a surface.
pub(super) fn lines<'py>(context: &mut Context<'_, 'py>, loaded: &Loaded, prim: &Prim<'py>) -> Vec<String> {
    let type_name = prim.type_name();
    let mut lines = Vec::new();
    if type_name == "Mesh" {
        lines.push(topology(context, prim));
    }
    if type_name == "Mesh" || quadrics::is_quadric(&type_name) {
        lines.push(triangles(loaded, prim));
    }
    if type_name == "PointInstancer" {
        lines.push(format!("prototypes: {}", prim.targets("prototypes").join(", ")));
    }
    lines
}

fn topology<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> String {
    let mut length = |name: &str| {
        let attribute = prim.attribute(name);
        attribute.and_then(|attribute| context.get_value(&attribute)).and_then(|value| value.len().ok()).unwrap_or(0)
    };
    let (points, faces) = (length("points"), length("faceVertexCounts"));
    let scheme: String = context.get(prim, "subdivisionScheme").unwrap_or_else(|| "catmullClark".to_owned());
    let origin = if prim.has_authored("subdivisionScheme") { "authored" } else { "the schema's default" };
    let complexity = context.options.complexity;
    let refined = match (scheme.as_str(), complexity.levels()) {
        ("none", _) => "the polygons as they are".to_owned(),
        (_, 0) => "not refined, with smooth normals".to_owned(),
        (_, levels) => format!("refined {levels} times by complexity {}", format!("{complexity:?}").to_lowercase()),
    };
    format!("topology: {points} points, {faces} faces; subdivision {scheme} ({origin}), {refined}")
}

fn triangles(loaded: &Loaded, prim: &Prim<'_>) -> String {
    let path = prim.path();
    let in_prototype = || -> Option<String> {
        let is_proxy = prim.object().call_method0("IsInstanceProxy").ok()?.is_truthy().ok()?;
        let place = prim.object().call_method0("GetPrimInPrototype").ok().filter(|_| is_proxy)?;
        Some(Prim::new(place).path())
    };
    let names = [Some(path), in_prototype()];
    let is_it = |name: &str| names.iter().flatten().any(|known| known == name);
    let scene = &loaded.scene;
    let Some(number) = scene.meshes.iter().position(|mesh| is_it(&mesh.origin.name)) else {
        let is_quadric = quadrics::is_quadric(&prim.type_name());
        return if is_quadric {
            "triangles: shared with an equal prim, or none".to_owned()
        } else {
            "triangles: none are in the scene".to_owned()
        };
    };
    let mesh = MeshId(number as u32);
    let placed: usize = scene.instances.iter().filter(|set| set.geometry.mesh() == Some(mesh)).map(|set| set.transforms.len()).sum();
    format!("triangles: {}, placed {placed} times", scene.meshes[number].triangles.len())
}
