//! A material prim as a material of the scene, and what surfaces look like that have none.

use super::network::Network;
use super::neutral::NodeIndex;
use super::outputs::{output_name, render_contexts};
use super::surface::straight;
use super::{dangling, displaced, from_usd, made_of, surface, volume};
use crate::context::Context;
use crate::lamp_spectrum::lamp_spectrum;
use crate::prim::Prim;
use crate::pxr::Module;
use gonio::scene::{Channel, Closure, Graph, Input, Material, MaterialId, Model, Operation, Origin};
use pyo3::{intern, prelude::*};

/// Reflectance of surfaces that say nothing about themselves.
const FALLBACK_REFLECTANCE: f32 = 0.18;

/// The material of a prim; `None` where its surface cannot be converted, which is reported.
pub(super) fn convert<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, path: &str) -> Option<Material> {
    let origin = Origin::new(path);
    let (surfaces, dangling) = context.attempt(&origin, "the material's surface cannot be found", surfaces(prim))?;
    for end in dangling {
        context.warn(&origin, format!("its surface is connected to {end}"));
    }
    let medium = volume::read(context, prim);
    let mut unknown = Vec::new();
    for (render_context, surface) in surfaces {
        let document = from_usd::read(surface, &context.time);
        let mut network = Network::new(context, document);
        let shader = network.shader(NodeIndex(0));
        if let Some(mut closures) = surface::convert(&mut network, &shader) {
            let mut graph = network.graph;
            made_of::apply(context, prim, &mut closures);
            let displacement = displaced::read(context, prim, &mut graph);
            let spectrum = lamp_spectrum(context, prim);
            return Some(Material {
                origin,
                closures,
                graph,
                displacement,
                spectrum,
                medium: medium.unwrap_or_default(),
                ..Material::default()
            });
        }
        let name = if shader.id.is_empty() { format!("<{}> without a name", shader.path) } else { format!("'{}'", shader.id) };
        let place = if render_context.is_empty() { String::new() } else { format!(" (render context {render_context})") };
        unknown.push(name + &place);
    }
    if let (Some(medium), true) = (medium, unknown.is_empty()) {
        // Rays pass what is a volume alone.
        return Some(Material { medium, ..Material::of(origin, straight(Input::Constant([1.0; 4]))) });
    }
    let found = match unknown.as_slice() {
        [] => "the material has no surface in any render context".to_owned(),
        names => format!("the surface shader {} is not supported", names.join(", ")),
    };
    context.warn(&origin, format!("{found}; displayColor takes its place"));
    None
}

/// Surface shader prims with their render contexts, and where connections lead that end at nothing or in circles.
type Surfaces<'py> = (Vec<(String, Prim<'py>)>, Vec<String>);

/// The surface shader prims of a material with their render contexts, the preferred one's first.
fn surfaces<'py>(prim: &Prim<'py>) -> PyResult<Surfaces<'py>> {
    let py = prim.py();
    let material = Module::UsdShade.wrap("Material", prim.object())?;
    let (mut surfaces, mut ends) = (Vec::new(), Vec::new());
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
                ends.extend(dangling::dangling(&attribute)?);
            }
            undeclared
        };
        surfaces.extend(shader.map(|shader| (render_context, shader)));
    }
    Ok((surfaces, ends))
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
