//! Materials that ask for text of the prim that they shade, as the name of an image: one material for each set of answers.

use super::convert::convert;
use super::neutral::Value;
use super::textures::resolve_text;
use crate::context::Context;
use crate::prim::{Attribute, Prim};
use crate::pxr::Module;
use gonio::scene::MaterialId;
use pyo3::{intern, prelude::*};

/// The scene's material for a material prim on a prim, converted when first asked for; `None` where its surface cannot be converted, which is
/// reported once.
pub(super) fn material_on<'py>(context: &mut Context<'_, 'py>, material: &Prim<'py>, place: &Prim<'py>) -> Option<MaterialId> {
    let path = material.path();
    if let Some(known) = context.material_ids.get(&path) {
        return *known;
    }
    context.shaded.prim = Some(place.clone());
    if let Some(names) = context.asked_of_prims.get(&path).cloned() {
        let key = key(context, &path, &names);
        if let Some(known) = context.material_ids.get(&key) {
            return *known;
        }
    }
    context.shaded.asked.clear();
    let id = convert(context, material, &path).map(|material| context.scene.add_material(material));
    let names = std::mem::take(&mut context.shaded.asked);
    let key = if names.is_empty() { path.clone() } else { key(context, &path, &names) };
    if !names.is_empty() {
        context.asked_of_prims.insert(path, names);
    }
    context.material_ids.insert(key, id);
    id
}

/// The path of the material and what the prim answers.
fn key(context: &mut Context<'_, '_>, path: &str, names: &[String]) -> String {
    let answers = names.iter().map(|name| match named_text(context, name) {
        // One name may mean files in several folders.
        Some((Value::Asset(path), _)) => path.authored + &path.resolved,
        Some((Value::Text(text), attribute)) => resolve_text(&attribute, &text) + &text,
        _ => String::new(),
    });
    answers.fold(path.to_owned(), |key, answer| key + "\n" + &answer)
}

/// The text in a primvar of the shaded prim, or of those above it.
pub(super) fn named_text<'py>(context: &mut Context<'_, 'py>, name: &str) -> Option<(Value, Attribute<'py>)> {
    if !context.shaded.asked.iter().any(|asked| asked == name) {
        context.shaded.asked.push(name.to_owned());
    }
    let prim = context.shaded.prim.clone()?;
    let py = context.py;
    let find = || -> PyResult<Option<(Value, Attribute<'py>)>> {
        let primvars = Module::UsdGeom.wrap("PrimvarsAPI", prim.object())?;
        let primvar = primvars.call_method1(intern!(py, "FindPrimvarWithInheritance"), (name,))?;
        let attribute = Attribute::new(primvar.call_method0(intern!(py, "GetAttr"))?);
        if !attribute.object().is_truthy()? {
            return Ok(None);
        }
        let Some(mut value) = attribute.get(&context.time)? else { return Ok(None) };
        // An array stands for its first value.
        if value.get_type().name()?.to_string().ends_with("Array") {
            value = value.get_item(0)?;
        }
        Ok(match Value::from_python(&value) {
            Some(value @ (Value::Text(_) | Value::Asset(_))) => Some((value, attribute)),
            _ => None,
        })
    };
    find().unwrap_or(None)
}
