//! Materials of a stage: which is bound to a prim, and its shading network as a surface of the scene.
//!
//! A material's surface is looked for in the render contexts `gonio`, `mtlx` and the universal one, in this order, then in all others that it has.
//! Its network is read into a neutral document (`from_usd`; documents of MaterialX by `mtlx`), which `network` and the nodes' and surfaces' files
//! translate without `pxr`; what they ask of the stage goes through `host`. Nodes of the graph are made in `emit` alone.

mod arnold_math;
mod arnold_nodes;
mod binding;
mod definition;
mod displaced;
mod document;
mod emit;
mod from_usd;
mod host;
mod inputs;
mod library;
mod materialx;
mod mtlx;
mod network;
mod neutral;
mod shaded;
mod stage_host;
mod surface;
#[cfg(test)]
mod tests;
mod textures;
mod usd_nodes;
mod value;
mod varying;
mod xml;

pub use binding::{bound, bound_all};
pub use document::{Substitution, substitute_documents};
pub use library::Library;
pub use shaded::Shaded;
pub(crate) use textures::{image_source, texture};
pub(crate) use value::{stated_colour_space, to_linear_rec709};

use crate::context::Context;
use crate::prim::Prim;
use crate::pxr::Module;
use gonio::scene::{Channel, Closure, Graph, Input, Material, MaterialId, Model, Operation, Origin};
use network::Network;
use neutral::NodeIndex;
use pyo3::{intern, prelude::*};

/// Render contexts that go before others, the best first; the empty one is the universal.
const RENDER_CONTEXTS: [&str; 3] = ["gonio", "mtlx", ""];
/// Reflectance of surfaces that say nothing about themselves.
const FALLBACK_REFLECTANCE: f32 = 0.18;

/// Whether a shader is the surface whose displacement may be an output of it.
fn is_preview_surface(id: &str) -> bool {
    matches!(id, "UsdPreviewSurface" | "ND_UsdPreviewSurface_surfaceshader")
}

fn convert<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, path: &str) -> Option<Material> {
    let origin = Origin::new(path);
    let (surfaces, dangling) = context.attempt(&origin, "the material's surface cannot be found", surfaces(prim))?;
    for path in dangling {
        context.warn(&origin, format!("its surface is connected to <{path}>, which is not there"));
    }
    let mut unknown = Vec::new();
    for (render_context, surface) in surfaces {
        let document = from_usd::read(surface, &context.time);
        let mut network = Network::new(context, document);
        let shader = network.shader(NodeIndex(0));
        if let Some(closures) = surface::convert(&mut network, &shader) {
            let mut graph = network.graph;
            let displacement = displaced::read(context, prim, &mut graph);
            return Some(Material { origin, closures, graph, displacement, ..Material::default() });
        }
        let name = if shader.id.is_empty() { format!("<{}> without a name", shader.path) } else { format!("'{}'", shader.id) };
        let place = if render_context.is_empty() { String::new() } else { format!(" (render context {render_context})") };
        unknown.push(name + &place);
    }
    let found = match unknown.as_slice() {
        [] => "the material has no surface in any render context".to_owned(),
        names => format!("the surface shader {} is not supported", names.join(", ")),
    };
    context.warn(&origin, format!("{found}; displayColor takes its place"));
    None
}

/// Surface shader prims with their render contexts, and where connections lead that end at nothing.
type Surfaces<'py> = (Vec<(String, Prim<'py>)>, Vec<String>);

/// The surface shader prims of a material with their render contexts, the preferred one's first.
fn surfaces<'py>(prim: &Prim<'py>) -> PyResult<Surfaces<'py>> {
    let py = prim.py();
    let material = Module::UsdShade.wrap("Material", prim.object())?;
    let (mut surfaces, mut dangling) = (Vec::new(), Vec::new());
    for render_context in render_contexts(prim) {
        if !prim.has_authored(&output_name(&render_context, "surface")) {
            continue;
        }
        let output = material.call_method1(intern!(py, "GetSurfaceOutput"), (&render_context,))?;
        // A missing context falls back to the universal one, which has its own turn.
        if !output.is_truthy()? {
            continue;
        }
        let shader = if output.call_method0(intern!(py, "HasConnectedSource"))?.is_truthy()? {
            let source = material.call_method1(intern!(py, "ComputeSurfaceSource"), (&render_context,))?;
            let shader = source.get_item(0)?;
            if shader.is_truthy()? { Some(Prim::new(shader.call_method0(intern!(py, "GetPrim"))?)) } else { None }
        } else {
            let attribute = output.call_method0(intern!(py, "GetAttr"))?;
            let undeclared = from_usd::undeclared_source(&attribute)?.map(|(prim, _)| prim);
            if undeclared.is_none() {
                dangling.extend(from_usd::dangling(&attribute)?);
            }
            undeclared
        };
        surfaces.extend(shader.map(|shader| (render_context, shader)));
    }
    Ok((surfaces, dangling))
}

/// The property that is a material's output of a kind in a render context.
fn output_name(render_context: &str, kind: &str) -> String {
    if render_context.is_empty() { format!("outputs:{kind}") } else { format!("outputs:{render_context}:{kind}") }
}

/// The preferred contexts, then those that the material has beside them: `outputs:arnold:surface` is arnold's.
fn render_contexts(prim: &Prim<'_>) -> Vec<String> {
    let others = prim.authored_names().iter().filter_map(|name| name.strip_prefix("outputs:")?.strip_suffix(":surface"));
    let others = others.filter(|context| !RENDER_CONTEXTS.contains(context));
    RENDER_CONTEXTS.iter().copied().chain(others).map(str::to_owned).collect()
}

/// What surfaces without a material look like: Lambert's law with the prim's displayColor, and its displayOpacity where it has one.
pub fn fallback(context: &mut Context<'_, '_>, with_opacity: bool) -> MaterialId {
    let key = if with_opacity { " displayColor, displayOpacity" } else { " displayColor" };
    if let Some(Some(known)) = context.material_ids.get(key) {
        return *known;
    }
    let mut closure = Closure { model: Model::OpenPbr, ..Closure::default() };
    let mut graph = Graph::default();
    let primvar = |name: &str, fallback: f32| Operation::Primvar { name: name.to_owned(), fallback: [fallback, fallback, fallback, 1.0] };
    let colour = graph.add(primvar("displayColor", FALLBACK_REFLECTANCE), vec![]);
    closure.set_input("base_color", Input::Node(colour, Channel::Rgb));
    closure.set("specular_weight", 0.0);
    if with_opacity {
        let opacity = graph.add(primvar("displayOpacity", 1.0), vec![]);
        closure.set_input("geometry_opacity", Input::Node(opacity, Channel::R));
    }
    let id = context.scene.add_material(Material { graph, ..Material::of(Origin::new(key.trim()), closure) });
    context.material_ids.insert(key.to_owned(), Some(id));
    id
}
