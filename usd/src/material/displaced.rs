//! Displacement: what a material's output of that name reads, in the graph of its surface.

use super::emit::{is_constant, multiply};
use super::from_usd;
use super::network::{Network, Shader};
use super::neutral::NodeIndex;
use super::outputs::{DISPLACEMENT, is_preview_surface, source};
use crate::context::Context;
use crate::prim::Prim;
use gonio::scene::{Displacement, DisplacementKind, Graph};

/// What displaces a material; its nodes are added to the graph.
pub(super) fn read<'py>(context: &mut Context<'_, 'py>, material: &Prim<'py>, graph: &mut Graph) -> Option<Displacement> {
    let prim = context.connected(material, "displacement", source(material, DISPLACEMENT))?;
    let document = from_usd::read(prim, &context.time);
    let mut network = Network::new(context, document);
    network.graph = std::mem::take(graph);
    let shader = network.shader(NodeIndex(0));
    let found = convert(&mut network, &shader);
    *graph = network.graph;
    found.filter(|displacement| !displacement.is_nothing())
}

/// A displacement shader's value; `None` for one that is not known, which is told.
fn convert(network: &mut Network<'_>, shader: &Shader) -> Option<Displacement> {
    let (value, kind) = match &*shader.id {
        id if is_preview_surface(id) => (network.scalar(shader, "displacement", 0.0), DisplacementKind::Height),
        "ND_displacement_float" => {
            (scaled(network, shader, |network| network.scalar(shader, "displacement", 0.0)), DisplacementKind::Height)
        }
        "ND_displacement_vector3" => {
            (scaled(network, shader, |network| network.colour(shader, "displacement", [0.0; 3])), DisplacementKind::Tangent)
        }
        other => {
            network.unsupported(&format!("the displacement shader '{other}'"), shader);
            return None;
        }
    };
    Some(Displacement { value, kind, ..Displacement::default() })
}

fn scaled<'h>(
    network: &mut Network<'h>,
    shader: &Shader,
    value: impl FnOnce(&mut Network<'h>) -> gonio::scene::Input,
) -> gonio::scene::Input {
    let value = value(network);
    let scale = network.scalar(shader, "scale", 1.0);
    if is_constant(scale, 1.0) { value } else { multiply(&mut network.graph, value, scale) }
}
