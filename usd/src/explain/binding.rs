//! Which material a prim has, which binding won, and what became of it.

use super::lineage;
use crate::context::Context;
use crate::prim::Prim;
use crate::pxr::Module;
use crate::quadrics;
use crate::stage::Loaded;
use gonio::scene::{Input, Material};
use pyo3::{intern, prelude::*};

/// Most parameters of a material that are listed.
const MOST_PARAMETERS: usize = 12;

/// Lines about the material of a surface and of its subsets.
pub(super) fn lines<'py>(context: &mut Context<'_, 'py>, loaded: &Loaded, prim: &Prim<'py>) -> Vec<String> {
    let type_name = prim.type_name();
    if type_name == "Material" {
        return become_lines(loaded, &prim.path());
    }
    if !(type_name == "Mesh" || type_name == "GeomSubset" || quadrics::is_quadric(&type_name)) {
        return Vec::new();
    }
    let mut lines = bound(context, loaded, prim);
    for child in children(prim).iter().filter(|child| child.type_name() == "GeomSubset") {
        lines.extend(bound(context, loaded, child).into_iter().map(|line| format!("subset {}: {line}", child.name())));
    }
    lines
}

fn children<'py>(prim: &Prim<'py>) -> Vec<Prim<'py>> {
    let list = prim.object().call_method0(intern!(prim.py(), "GetChildren"));
    list.and_then(|list| list.try_iter()?.map(|child| child.map(Prim::new)).collect()).unwrap_or_default()
}

/// The material's path and the binding that won, for the first purpose that has one.
fn winner<'py>(context: &Context<'_, 'py>, prim: &Prim<'py>) -> Option<(String, String)> {
    let py = context.py;
    let api = Module::UsdShade.wrap("MaterialBindingAPI", prim.object()).ok()?;
    context.options.binding_purposes().into_iter().find_map(|purpose| {
        let found = api.call_method1(intern!(py, "ComputeBoundMaterial"), (&purpose,)).ok()?;
        let (material, relationship) = (found.get_item(0).ok()?, found.get_item(1).ok()?);
        if !material.is_truthy().ok()? {
            return None;
        }
        let path = |object: &Bound<'py, PyAny>| -> Option<String> {
            object.call_method0("GetPath").ok()?.getattr("pathString").ok()?.extract().ok()
        };
        Some((path(&material)?, path(&relationship)?))
    })
}

fn bound<'py>(context: &mut Context<'_, 'py>, loaded: &Loaded, prim: &Prim<'py>) -> Vec<String> {
    let won = winner(context, prim);
    let mut lines = Vec::new();
    match &won {
        Some((material, relationship)) => lines.push(format!("material: {material}, by {relationship} ({})", kind(prim, relationship))),
        None => lines.push("material: none is bound, primvars:displayColor is shown".to_owned()),
    }
    lines.extend(losers(prim, won.as_ref().map(|(_, relationship)| relationship.as_str())));
    if let Some((material, _)) = &won {
        lines.extend(become_lines(loaded, material));
    }
    lines
}

/// What kind of binding a relationship is, seen from the prim.
fn kind(prim: &Prim<'_>, relationship: &str) -> String {
    let place = relationship.rsplit_once('.').map_or("", |(place, _)| place);
    let how = if relationship.contains("material:binding:collection") { "a collection's" } else { "direct" };
    let place = if place == prim.path() { "on the prim itself" } else { "inherited" };
    let purpose = ["full", "preview"].into_iter().find(|purpose| relationship.split(':').any(|part| part == *purpose));
    format!("{how}, {place}{}, for {}", strength(prim, relationship), purpose.unwrap_or("all purposes"))
}

/// Says where a binding is stronger than those below it.
fn strength(prim: &Prim<'_>, relationship: &str) -> &'static str {
    let find = || -> PyResult<bool> {
        let stage = prim.object().call_method0("GetStage")?;
        let found = stage.call_method1("GetRelationshipAtPath", (relationship,))?;
        let api = Module::UsdShade.item(prim.py(), "MaterialBindingAPI")?;
        let strength: String = api.call_method1("GetMaterialBindingStrength", (found,))?.extract()?;
        Ok(strength == "strongerThanDescendants")
    };
    if find().unwrap_or(false) { ", stronger than those below" } else { "" }
}

/// Bindings at or above the prim that lost.
fn losers(prim: &Prim<'_>, won: Option<&str>) -> Vec<String> {
    let mut lines = Vec::new();
    for place in lineage(prim) {
        for name in place.authored_names().iter().filter(|name| name.starts_with("material:binding")) {
            let path = format!("{}.{name}", place.path());
            if won != Some(path.as_str()) {
                lines.push(format!("another binding: {path} → {}", place.targets(name).join(", ")));
            }
        }
    }
    lines
}

/// What a material prim has become.
fn become_lines(loaded: &Loaded, path: &str) -> Vec<String> {
    let found: Vec<&Material> = loaded.scene.materials.iter().filter(|material| &*material.origin.name == path).collect();
    if found.is_empty() {
        return vec![format!("{path}: no surface of it is in the scene")];
    }
    let mut lines = Vec::new();
    for material in found {
        for closure in &material.closures {
            let parameters: Vec<String> =
                closure.parameters.iter().take(MOST_PARAMETERS).map(|(name, input)| format!("{name} {}", value(input))).collect();
            let more = closure.parameters.len().saturating_sub(MOST_PARAMETERS);
            let more = if more > 0 { format!(" and {more} more") } else { String::new() };
            lines.push(format!("surface: {:?}, {}{more}", closure.model, parameters.join(", ")));
        }
    }
    let below = format!("{path}/");
    let told = loaded.diagnostics.iter().filter(|found| &*found.origin.name == path || found.origin.name.starts_with(&below));
    lines.extend(told.map(|found| format!("told: {found}")));
    lines
}

fn value(input: &Input) -> String {
    match input {
        Input::Node(..) => "by nodes".to_owned(),
        Input::Constant([a, b, c, _]) if a == b && b == c => format!("{a}"),
        Input::Constant([a, b, c, _]) => format!("({a}, {b}, {c})"),
    }
}
