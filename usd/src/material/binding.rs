//! Which material a prim has: UsdShade's resolution over inheritance, strength, collections and purposes.

use super::convert::fallback;
use super::shaded::material_on;
use super::volume::{self, VolumeShading};
use crate::context::Context;
use crate::kept::KeptPrim;
use crate::prim::Prim;
use crate::pxr::Module;
use gonio::scene::{MaterialId, Origin};
use pyo3::{intern, prelude::*, types::PyList};
use std::collections::HashMap;
use std::rc::Rc;

/// The material of a prim (a geometry prim or a GeomSubset), or the one that shows its displayColor.
pub fn bound<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> MaterialId {
    bound_all(context, std::slice::from_ref(prim)).first().copied().unwrap_or_else(|| fallback(context, false))
}

/// The materials of many prims in one call; the result has their order.
pub fn bound_all<'py>(context: &mut Context<'_, 'py>, prims: &[Prim<'py>]) -> Vec<MaterialId> {
    let origin = prims.first().map_or_else(|| Origin::new("stage"), Prim::origin);
    let computed = compute(context, prims);
    let materials = context.attempt(&origin, "the bound materials cannot be found", computed).unwrap_or_default();
    let mut ids = Vec::with_capacity(prims.len());
    for (index, prim) in prims.iter().enumerate() {
        let id = materials.get(index).and_then(Option::as_ref).and_then(|bound| material_on(context, bound, prim));
        if materials.get(index).is_none_or(Option::is_none) {
            report_absent(context, prim, "displayColor takes its place");
        }
        ids.push(id.unwrap_or_else(|| fallback(context, has_display_opacity(context, prim))));
    }
    ids
}

/// What the volume prim's material says of it; `None` where none is bound, or that says nothing of volumes. Each material is read once.
pub(crate) fn volume_shading<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> Option<Rc<VolumeShading>> {
    let computed = compute(context, std::slice::from_ref(prim));
    let materials = context.attempt_at(prim, "the bound material cannot be found", computed)?;
    let Some(Some(material)) = materials.into_iter().next() else {
        report_absent(context, prim, "the usual one of volumes takes its place");
        return None;
    };
    let path = material.path();
    if let Some(known) = context.volume_shadings.get(&path) {
        return known.clone();
    }
    context.shaded.prim = Some(prim.clone());
    let shading = volume::shading(context, &material).map(Rc::new);
    context.volume_shadings.insert(path, shading.clone());
    shading
}

/// Names the material that a prim or its nearest bound ancestor asks for, where there is none, and what is used instead.
fn report_absent<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, instead: &str) {
    let mut place = Some(Prim::new(prim.object().clone()));
    while let Some(bound) = place {
        if let Some(path) = bound.targets("material:binding").first() {
            if context.prim_at(path).is_none() {
                let message = || format!("the material <{path}> that is bound does not exist; {instead}");
                context.once("absent material", path, &bound.origin(), message);
            }
            return;
        }
        place = bound.parent();
    }
}

/// The bound material of each prim: by the first purpose of the options that gives one.
fn compute<'py>(context: &Context<'_, 'py>, prims: &[Prim<'py>]) -> PyResult<Vec<Option<Prim<'py>>>> {
    let py = context.py;
    let api = Module::UsdShade.item(py, "MaterialBindingAPI")?;
    let kept =
        |prim: &Prim<'py>| prim.known().material.get().map(|material| material.prim(py)).filter(|material| context.kept.is_there(material));
    let mut found: Vec<Option<Prim<'py>>> = prims.iter().map(kept).collect();
    // One for all prims that it is bound to, with its path and what else is known.
    let mut materials: HashMap<String, Prim<'py>> = HashMap::new();
    for purpose in &context.options.binding_purposes() {
        let open: Vec<usize> = (0..prims.len()).filter(|&index| found[index].is_none()).collect();
        if open.is_empty() {
            break;
        }
        let list = PyList::new(py, open.iter().map(|&index| prims[index].object()))?;
        let computed = api.call_method1(intern!(py, "ComputeBoundMaterials"), (list, purpose))?;
        for (&index, material) in open.iter().zip(computed.get_item(0)?.try_iter()?) {
            let material = material?;
            if material.is_truthy()? {
                let path: String = material.call_method0(intern!(py, "GetPath"))?.getattr(intern!(py, "pathString"))?.extract()?;
                let bound = match materials.get(&path) {
                    Some(known) => known.clone(),
                    None => {
                        let bound = Prim::new(material.call_method0(intern!(py, "GetPrim"))?);
                        materials.insert(path, bound.clone());
                        bound
                    }
                };
                let _ = prims[index].known().material.set(KeptPrim::of(&bound));
                found[index] = Some(bound);
            }
        }
    }
    Ok(found)
}

fn has_display_opacity<'py>(context: &Context<'_, 'py>, prim: &Prim<'py>) -> bool {
    let py = context.py;
    let find = || -> PyResult<bool> {
        let primvars = Module::UsdGeom.wrap("PrimvarsAPI", prim.object())?;
        let primvar = primvars.call_method1(intern!(py, "FindPrimvarWithInheritance"), (intern!(py, "displayOpacity"),))?;
        primvar.call_method0(intern!(py, "HasValue"))?.is_truthy()
    };
    find().unwrap_or(false)
}
