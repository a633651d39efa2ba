//! Skinning: skinned points are written by `UsdSkel.BakeSkinning` into an anonymous layer over the stage, never into files.

mod alike;
mod normals;

pub use alike::Alike;

use crate::context::Context;
use crate::prim::Prim;
use crate::pxr::Module;
use gonio::scene::Origin;
use pyo3::intern;
use pyo3::prelude::*;
use std::collections::HashMap;

/// Attributes of a SkelAnimation that move with time.
const CHANNELS: [&str; 4] = ["translations", "rotations", "scales", "blendShapeWeights"];
/// How deep instances with skeletons may stand in one another.
const MAX_ROUNDS: usize = 16;

/// Whether a prim holds skinned meshes.
pub fn is_root(prim: &Prim<'_>) -> bool {
    // By its name: most stages need not import the module.
    prim.is_a(intern!(prim.py(), "SkelRoot"))
}

/// Skins the meshes below all `SkelRoot`s at the context's time, in one go: each writing makes `pxr` compose anew. Where that fails meshes stay in
/// their bind pose, which is reported.
pub fn bake<'py>(context: &mut Context<'_, 'py>) {
    let stage = Origin::new("/");
    let time = pinned_time(context);
    let Some(time) = context.attempt(&stage, "skinning failed, the meshes are in their bind pose", time) else { return };
    let handed_over = normals::hand_over(context);
    let _ = context.attempt(&stage, "normals of skinned meshes stay as they are in the bind pose", handed_over);
    let whole = || -> PyResult<bool> {
        let usd = Module::Usd.import(context.py)?;
        let root = context.stage.call_method0(intern!(context.py, "GetPseudoRoot"))?;
        // What is left of instances with skeletons shows what others are skinned to; writing to them would fail.
        let written = usd.getattr("PrimDefaultPredicate")?.bitand(usd.getattr("PrimIsInstance")?.call_method0("__invert__")?)?;
        let range = usd.getattr("PrimRange")?.call1((root, written))?;
        write_skinned_points(context, &range, time)
    };
    if !whole().unwrap_or(false) {
        bake_one_by_one(context, time);
    }
}

/// One bad skeleton does not spoil the others.
fn bake_one_by_one<'py>(context: &mut Context<'_, 'py>, time: f64) {
    let prims = || -> PyResult<Vec<Prim<'py>>> {
        let prims = context.stage.call_method0(intern!(context.py, "Traverse"))?;
        prims.try_iter()?.map(|prim| prim.map(Prim::new)).collect()
    };
    for prim in prims().unwrap_or_default().into_iter().filter(is_root) {
        let root = Module::UsdSkel.wrap("Root", prim.object());
        let result = root.and_then(|root| write_skinned_points(context, &root, time));
        if context.attempt_at(&prim, "skinning failed, the meshes are in their bind pose", result) == Some(false) {
            context.warn(&prim.origin(), "skinning failed, the meshes are in their bind pose");
        }
    }
}

/// Skins what is below a root, or below all roots of a range of prims.
fn write_skinned_points<'py>(context: &Context<'_, 'py>, roots: &Bound<'py, PyAny>, time: f64) -> PyResult<bool> {
    let interval = Module::Gf.item(context.py, "Interval")?.call1((time, time))?;
    Module::UsdSkel.import(context.py)?.call_method1("BakeSkinning", (roots, interval))?.is_truthy()
}

/// The time that is read. BakeSkinning looks at authored samples only: one is put there.
fn pinned_time(context: &Context<'_, '_>) -> PyResult<f64> {
    let py = context.py;
    if !context.time.call_method0(intern!(py, "IsNumeric"))?.is_truthy()? {
        return Ok(0.0);
    }
    for animation in animations(context)? {
        CHANNELS.iter().try_for_each(|name| pin(context, &animation, name))?;
    }
    context.time.call_method0(intern!(py, "GetValue"))?.extract()
}

/// The animations outside of instances.
fn animations<'py>(context: &Context<'_, 'py>) -> PyResult<Vec<Prim<'py>>> {
    let class = Module::UsdSkel.item(context.py, "Animation")?;
    let prims = context.stage.call_method0("TraverseAll")?;
    let prims: Vec<Prim<'py>> = prims.try_iter()?.map(|prim| prim.map(Prim::new)).collect::<PyResult<_>>()?;
    Ok(prims.into_iter().filter(|prim| prim.is_a(&class)).collect())
}

/// Writes an animated attribute's value at the time as a sample of its own.
fn pin<'py>(context: &Context<'_, 'py>, animation: &Prim<'py>, name: &str) -> PyResult<()> {
    let Some(attribute) = animation.attribute(name) else { return Ok(()) };
    let samples: usize = attribute.object().call_method0("GetNumTimeSamples")?.extract()?;
    match attribute.get(&context.time)? {
        Some(value) if samples > 1 => attribute.object().call_method1("Set", (value, &context.time)).map(|_| ()),
        _ => Ok(()),
    }
}

/// What became of native instances that hold skeletons.
#[derive(Debug, Default)]
pub struct Apart {
    /// Those that were taken apart, because prototypes cannot be written to.
    pub apart: Vec<Origin>,
    /// Those that are skinned alike, where there are several, and which of them was taken apart.
    pub alike: Alike,
}

/// Takes native instances that hold a skeleton apart, one of those that skin alike. The stage's edit target gets the opinions.
pub fn take_instances_apart(stage: &Bound<'_, PyAny>) -> PyResult<Apart> {
    let mut done = Apart::default();
    let layer = stage.call_method0("GetEditTarget")?.call_method0("GetLayer")?;
    for _ in 0..MAX_ROUNDS {
        let found = instances_with_skeletons(stage, &mut done.alike)?;
        if found.is_empty() {
            break;
        }
        write_apart(&layer, &found)?;
        done.apart.extend(found.iter().map(Prim::origin));
    }
    Ok(done)
}

/// The instances that are to be taken apart; those that show what one of them is skinned to are noted.
fn instances_with_skeletons<'py>(stage: &Bound<'py, PyAny>, alike: &mut Alike) -> PyResult<Vec<Prim<'py>>> {
    let mut found = Vec::new();
    let mut above = HashMap::new();
    for prototype in stage.call_method0("GetPrototypes")?.try_iter()? {
        let prototype = Prim::new(prototype?);
        let is_held = holds(prototype.object())?;
        let mut skinned = Vec::new();
        for instance in prototype.object().call_method0("GetInstances")?.try_iter()? {
            let instance = Prim::new(instance?);
            // The root of a prototype has no type, its instances have.
            let is_skinned = is_held || is_root(&instance);
            let is_known = !alike.is_empty() && alike.contains_key(&instance.path());
            if is_skinned && !is_known && !instance.object().call_method0("IsInPrototype")?.is_truthy()? {
                skinned.push(instance);
            }
        }
        found.extend(if skinned.len() > 1 { alike::one_of_each(&prototype, skinned, &mut above, alike)? } else { skinned });
    }
    Ok(found)
}

/// Writes the opinions of all instances before `pxr` composes anew: once, not once an instance.
fn write_apart(layer: &Bound<'_, PyAny>, instances: &[Prim<'_>]) -> PyResult<()> {
    let py = layer.py();
    let paths: Vec<String> = instances.iter().map(Prim::path).collect();
    let (create, none) = (Module::Sdf.item(py, "CreatePrimInLayer")?, py.None());
    let block = Module::Sdf.item(py, "ChangeBlock")?.call0()?;
    block.call_method0("__enter__")?;
    let written = paths.iter().try_for_each(|path| create.call1((layer, path))?.call_method1("SetInfo", ("instanceable", false)).map(drop));
    block.call_method1("__exit__", (&none, &none, &none))?;
    written
}

fn holds(prototype: &Bound<'_, PyAny>) -> PyResult<bool> {
    if !prototype.is_truthy()? {
        return Ok(false);
    }
    for prim in Module::Usd.wrap("PrimRange", prototype)?.try_iter()? {
        if is_root(&Prim::new(prim?)) {
            return Ok(true);
        }
    }
    Ok(false)
}
