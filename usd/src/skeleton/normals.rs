//! Normals of skinned meshes: `BakeSkinning` turns `normals`, but leaves `primvars:normals`, which go before them, as they were bound.

use crate::context::Context;
use crate::prim::Prim;
use crate::pxr::Module;
use pyo3::intern;
use pyo3::prelude::*;

const PRIMVAR: &str = "primvars:normals";
/// The interpolations for which `BakeSkinning` turns normals.
const TURNED: [&str; 3] = ["vertex", "varying", "faceVarying"];

/// The normals of a mesh, one of each index, as `normals` has them.
struct Normals<'py> {
    path: String,
    values: Bound<'py, PyAny>,
    interpolation: Bound<'py, PyAny>,
}

/// Moves `primvars:normals` of what hangs on skeletons to `normals`, in the layer for skinned points, before that is skinned.
pub(super) fn hand_over(context: &Context<'_, '_>) -> PyResult<()> {
    let mut found = Vec::new();
    for prim in context.stage.call_method0(intern!(context.py, "Traverse"))?.try_iter()? {
        found.extend(normals(context, &Prim::new(prim?))?);
    }
    if found.is_empty() { Ok(()) } else { write(context, &found) }
}

/// The prim's `primvars:normals`, if it is skinned and they would stay behind.
fn normals<'py>(context: &Context<'_, 'py>, prim: &Prim<'py>) -> PyResult<Option<Normals<'py>>> {
    let py = context.py;
    let attribute = prim.object().call_method1(intern!(py, "GetAttribute"), (intern!(py, "primvars:normals"),))?;
    if !attribute.is_truthy()? || !attribute.call_method0(intern!(py, "HasAuthoredValue"))?.is_truthy()? {
        return Ok(None);
    }
    let root = Module::UsdSkel.item(py, "Root")?.call_method1("Find", (prim.object(),))?;
    let primvar = Module::UsdGeom.wrap("Primvar", &attribute)?;
    let interpolation = primvar.call_method0("GetInterpolation")?;
    if !root.is_truthy()? || !TURNED.contains(&interpolation.extract::<String>()?.as_str()) {
        return Ok(None);
    }
    let values = primvar.call_method1("ComputeFlattened", (&context.time,))?;
    let Ok(values) = Module::Vt.item(py, "Vec3fArray")?.call1((values,)) else { return Ok(None) };
    Ok(Some(Normals { path: prim.path(), values, interpolation }))
}

/// Writes all of them before `pxr` composes anew: once, not once a mesh.
fn write(context: &Context<'_, '_>, found: &[Normals<'_>]) -> PyResult<()> {
    let (py, none) = (context.py, context.py.None());
    let layer = context.stage.call_method0("GetEditTarget")?.call_method0("GetLayer")?;
    let kind = Module::Sdf.item(py, "ValueTypeNames")?.getattr("Normal3fArray")?;
    let (create, attribute) = (Module::Sdf.item(py, "CreatePrimInLayer")?, Module::Sdf.item(py, "AttributeSpec")?);
    let no_value = Module::Sdf.item(py, "ValueBlock")?.call0()?;
    let write_one = |normals: &Normals<'_>| -> PyResult<()> {
        let prim = create.call1((&layer, &normals.path))?;
        let turned = attribute.call1((&prim, "normals", &kind))?;
        turned.setattr("default", &normals.values)?;
        turned.call_method1("SetInfo", ("interpolation", &normals.interpolation))?;
        attribute.call1((&prim, PRIMVAR, &kind))?.setattr("default", &no_value)
    };
    let block = Module::Sdf.item(py, "ChangeBlock")?.call0()?;
    block.call_method0("__enter__")?;
    let written = found.iter().try_for_each(write_one);
    block.call_method1("__exit__", (&none, &none, &none))?;
    written
}
