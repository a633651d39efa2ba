//! A material's outputs, and the render contexts that they are for.

use crate::prim::Prim;

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
