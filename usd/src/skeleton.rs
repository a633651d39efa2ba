//! Skinning: skinned points are written by `UsdSkel.BakeSkinning` into an anonymous layer over the stage, never into files.

use crate::context::Context;
use crate::prim::Prim;
use crate::pxr::Module;
use gonio::scene::Origin;
use pyo3::intern;
use pyo3::prelude::*;

/// Attributes of a SkelAnimation that move with time.
const CHANNELS: [&str; 4] = ["translations", "rotations", "scales", "blendShapeWeights"];
/// How deep instances with skeletons may stand in one another.
const MAX_ROUNDS: usize = 16;

/// Skins the meshes below a `SkelRoot` at the context's time; where that fails they stay in their bind pose, which is reported.
pub fn bake<'py>(context: &mut Context<'_, 'py>, root: &Prim<'py>) {
    let origin = root.origin();
    let result = write_skinned_points(context, root);
    if context.attempt(&origin, "skinning failed, the meshes are in their bind pose", result) == Some(false) {
        context.warn(&origin, "skinning failed, the meshes are in their bind pose");
    }
}

fn write_skinned_points<'py>(context: &Context<'_, 'py>, root: &Prim<'py>) -> PyResult<bool> {
    let py = context.py;
    // BakeSkinning looks at authored samples only: one is put at the time that is read.
    let is_numeric = context.time.call_method0(intern!(py, "IsNumeric"))?.is_truthy()?;
    let time = if is_numeric { context.time.call_method0(intern!(py, "GetValue"))?.extract::<f64>()? } else { 0.0 };
    if is_numeric {
        for animation in animations(context)? {
            CHANNELS.iter().try_for_each(|name| pin(context, &animation, name))?;
        }
    }
    let interval = Module::Gf.item(py, "Interval")?.call1((time, time))?;
    let skel = Module::UsdSkel.import(py)?;
    let root = skel.getattr("Root")?.call1((root.object(),))?;
    skel.call_method1("BakeSkinning", (root, interval))?.is_truthy()
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

/// Takes native instances that hold a skeleton apart, because prototypes cannot be written to. The stage's edit target gets the opinions.
pub fn take_instances_apart(stage: &Bound<'_, PyAny>) -> PyResult<Vec<Origin>> {
    let mut apart = Vec::new();
    let class = Module::UsdSkel.item(stage.py(), "Root")?;
    for _ in 0..MAX_ROUNDS {
        let before = apart.len();
        for prototype in stage.call_method0("GetPrototypes")?.try_iter()? {
            let prototype = prototype?;
            let is_held = holds(&prototype, &class)?;
            for instance in prototype.call_method0("GetInstances")?.try_iter()? {
                let instance = Prim::new(instance?);
                // The root of a prototype has no type, its instances have.
                let is_apart = is_held || instance.is_a(&class);
                if is_apart && !instance.object().call_method0("IsInPrototype")?.is_truthy()? {
                    instance.object().call_method1("SetInstanceable", (false,))?;
                    apart.push(instance.origin());
                }
            }
        }
        if apart.len() == before {
            break;
        }
    }
    Ok(apart)
}

fn holds<'py>(prototype: &Bound<'py, PyAny>, class: &Bound<'py, PyAny>) -> PyResult<bool> {
    if !prototype.is_truthy()? {
        return Ok(false);
    }
    for prim in Module::Usd.wrap("PrimRange", prototype)?.try_iter()? {
        if Prim::new(prim?).is_a(class) {
            return Ok(true);
        }
    }
    Ok(false)
}
