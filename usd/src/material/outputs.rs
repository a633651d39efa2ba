//! A material's outputs, and the render contexts that they are for.

use super::dangling;
use crate::prim::Prim;
use crate::pxr::Module;
use pyo3::{intern, prelude::*};

/// Render contexts that go before others, the best first; the empty one is the universal.
pub(super) const RENDER_CONTEXTS: [&str; 3] = ["gonio", "mtlx", ""];

/// Whether a shader is the surface whose displacement may be an output of it.
pub(super) fn is_preview_surface(id: &str) -> bool {
    matches!(id, "UsdPreviewSurface" | "ND_UsdPreviewSurface_surfaceshader")
}

/// The property that is a material's output of a kind in a render context.
pub(super) fn output_name(render_context: &str, kind: &str) -> String {
    if render_context.is_empty() { format!("outputs:{kind}") } else { format!("outputs:{render_context}:{kind}") }
}

/// The preferred contexts, then those that the material has beside them: `outputs:arnold:surface` is arnold's.
pub(super) fn render_contexts(prim: &Prim<'_>) -> Vec<String> {
    let others = prim.authored_names().iter().filter_map(|name| name.strip_prefix("outputs:")?.strip_suffix(":surface"));
    let others = others.filter(|context| !RENDER_CONTEXTS.contains(context));
    RENDER_CONTEXTS.iter().copied().chain(others).map(str::to_owned).collect()
}

/// An output of materials beside their surface.
pub(super) struct Output {
    name: &'static str,
    /// The method of `UsdShade.Material` that finds it.
    output: &'static str,
    /// That which finds its shader.
    source: &'static str,
    /// Whether it is read in render contexts of other renderers.
    in_others: bool,
}

pub(super) const DISPLACEMENT: Output =
    Output { name: "displacement", output: "GetDisplacementOutput", source: "ComputeDisplacementSource", in_others: false };
pub(super) const VOLUME: Output = Output { name: "volume", output: "GetVolumeOutput", source: "ComputeVolumeSource", in_others: true };

/// The shader behind an output, in the render context that goes first, and where outputs lead that lead nowhere.
pub(super) fn source<'py>(
    material: &Prim<'py>,
    Output { name, output, source, in_others }: Output,
) -> PyResult<(Option<Prim<'py>>, Vec<String>)> {
    let mut ends = Vec::new();
    // Most materials have none, which is told by names that are known.
    let known = RENDER_CONTEXTS.into_iter().filter(|context| material.has_authored(&output_name(context, name)));
    let mut stated: Vec<&str> = known.collect();
    if in_others {
        let others = material
            .authored_names()
            .iter()
            .filter_map(|authored| authored.strip_prefix("outputs:")?.strip_suffix(name)?.strip_suffix(':'));
        stated.extend(others.filter(|context| !RENDER_CONTEXTS.contains(context)));
    }
    if stated.is_empty() {
        return Ok((None, ends));
    }
    let py = material.py();
    let wrapped = Module::UsdShade.wrap("Material", material.object())?;
    for render_context in stated {
        let output = wrapped.call_method1(output, (render_context,))?;
        // A missing context falls back to the universal one, which has its own turn.
        if !output.is_truthy()? {
            continue;
        }
        if !output.call_method0(intern!(py, "HasConnectedSource"))?.is_truthy()? {
            ends.extend(dangling::dangling(&output.call_method0(intern!(py, "GetAttr"))?)?);
            continue;
        }
        let shader = wrapped.call_method1(source, (render_context,))?.get_item(0)?;
        if shader.is_truthy()? {
            return Ok((Some(Prim::new(shader.call_method0(intern!(py, "GetPrim"))?)), ends));
        }
    }
    Ok((None, ends))
}
