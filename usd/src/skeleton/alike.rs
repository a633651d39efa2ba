//! Instances of one prototype that skin alike: one of them is taken apart and skinned, the others show what it shows.
//!
//! What bends a mesh is the prototype's, but for what the root of an instance or a prim above it says of skeletons and animations.

use crate::prim::Prim;
use crate::pxr::Module;
use pyo3::intern;
use pyo3::prelude::*;
use std::collections::HashMap;

/// Native instances by the path of the one that is skinned in their place; that one is among them.
pub type Alike = HashMap<String, String>;

/// The instances of a prototype that are to be taken apart: one of those that skin alike, which are noted.
pub(super) fn one_of_each<'py>(
    prototype: &Prim<'py>,
    instances: Vec<Prim<'py>>,
    above: &mut HashMap<String, Option<String>>,
    alike: &mut Alike,
) -> PyResult<Vec<Prim<'py>>> {
    if !can_be_shared(prototype)? {
        return Ok(instances);
    }
    let mut shown: HashMap<String, String> = HashMap::new();
    let mut found = Vec::new();
    for instance in instances {
        let words = words(&instance, above);
        if let Some(first) = words.as_ref().and_then(|words| shown.get(words)) {
            alike.insert(first.clone(), first.clone());
            alike.insert(instance.path(), first.clone());
            continue;
        }
        shown.extend(words.map(|words| (words, instance.path())));
        found.push(instance);
    }
    Ok(found)
}

/// Whether nothing in a prototype depends on where an instance of it stands: skeletons outside and resets of the transformation would.
fn can_be_shared(prototype: &Prim<'_>) -> PyResult<bool> {
    let py = prototype.py();
    let below = format!("{}/", prototype.path());
    let xformable = Module::UsdGeom.item(py, "Xformable")?;
    for prim in Module::Usd.wrap("PrimRange", prototype.object())?.try_iter()? {
        let prim = Prim::new(prim?);
        if prim.has_authored("skel:skeleton") && prim.targets("skel:skeleton").iter().any(|target| !target.starts_with(&below)) {
            return Ok(false);
        }
        if prim.has_authored("xformOpOrder")
            && xformable.call1((prim.object(),))?.call_method0(intern!(py, "GetResetXformStack"))?.is_truthy()?
        {
            return Ok(false);
        }
    }
    Ok(true)
}

/// What the root of an instance and the prims above it say of its skeletons: instances of a prototype with the same words skin alike. `None`
/// where that cannot be said.
fn words(instance: &Prim<'_>, above: &mut HashMap<String, Option<String>>) -> Option<String> {
    let own = instance.path();
    let mut words = instance.type_name();
    for name in instance.authored_names() {
        if name.starts_with("primvars:skel:") {
            return None;
        }
        if !name.starts_with("skel:") {
            continue;
        }
        words.push_str(name);
        for target in instance.targets(name) {
            match target.strip_prefix(&own) {
                Some(inside) => words.push_str(inside),
                None if name == "skel:skeleton" => return None,
                None => words.push_str(&target),
            }
        }
    }
    words.push_str(&nearest_animated(&instance.parent()?, above).unwrap_or_default());
    Some(words)
}

/// The path of the nearest prim from here upwards that says something of skeletons, whose animation those below inherit.
fn nearest_animated(prim: &Prim<'_>, known: &mut HashMap<String, Option<String>>) -> Option<String> {
    let path = prim.path();
    if let Some(known) = known.get(&path) {
        return known.clone();
    }
    let is_said = prim.has_authored_prefix("skel:");
    let nearest = if is_said { Some(path.clone()) } else { prim.parent().and_then(|parent| nearest_animated(&parent, known)) };
    known.insert(path, nearest.clone());
    nearest
}
