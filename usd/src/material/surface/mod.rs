//! Surface shaders as closures: each model has a file of its own.

mod albedo;
mod closures;
mod facets;
mod hair;
mod layers;
mod lobes;
mod materialx;
mod measured;
mod omniverse;
mod parts;
mod preview_surface;
mod realitykit;
mod solid;

pub(super) use closures::{behind, emission, node_name};
pub(super) use parts::straight;

use super::network::{Network, Shader};
use gonio::scene::Closure;

/// The closures of a surface shader; `None` where it is not one that is known.
pub(super) fn convert(network: &mut Network<'_>, shader: &Shader) -> Option<Vec<Closure>> {
    match &*shader.id {
        "UsdPreviewSurface" | "ND_UsdPreviewSurface_surfaceshader" => Some(preview_surface::convert(network, shader)),
        measured::ID => Some(vec![measured::convert(network, shader)]),
        _ => materialx::convert(network, shader)
            .map(|closure| vec![closure])
            .or_else(|| realitykit::convert(network, shader))
            .or_else(|| omniverse::convert(network, shader))
            .or_else(|| closures::convert(network, shader))
            .or_else(|| {
                // A surface that is defined by a graph.
                let inside = network.inside(shader)?;
                network.within(&inside, |network| convert(network, &inside)).flatten()
            }),
    }
}
