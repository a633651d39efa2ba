//! RealityKit's surfaces, as Reality Composer and its exporters write them: the lit one has UsdPreviewSurface's parameters, the other shines.

use super::parts::{cut_by, shining};
use super::preview_surface;
use crate::material::emit::{multiply, scalar};
use crate::material::network::{Network, Shader};
use gonio::scene::Closure;

/// The closures of a RealityKit surface; `None` for other shaders.
pub(super) fn convert(network: &mut Network<'_>, shader: &Shader) -> Option<Vec<Closure>> {
    match shader.id.trim_start_matches("ND_") {
        "realitykit_pbr_surfaceshader" | "realitykit_pbr_surfaceshader_2_0" => Some(lit(network, shader)),
        "realitykit_unlit_surfaceshader" => Some(vec![unlit(network, shader)]),
        _ => None,
    }
}

fn lit(network: &mut Network<'_>, shader: &Shader) -> Vec<Closure> {
    let names = preview_surface::Names { base: "baseColor", base_default: [1.0; 3] };
    let mut closures = preview_surface::convert_as(network, shader, names);
    // Half of `specular` is a dielectric as it comes.
    let specular = network.scalar(shader, "specular", 0.5);
    let scale = multiply(&mut network.graph, specular, scalar(2.0));
    closures
        .iter_mut()
        .filter(|closure| closure.input("specular_ior").is_some())
        .for_each(|closure| closure.set_input("specular_scale", scale));
    closures
}

fn unlit(network: &mut Network<'_>, shader: &Shader) -> Closure {
    let mut closure = shining(network.colour(shader, "color", [1.0; 3]));
    let (opacity, threshold) = (network.scalar(shader, "opacity", 1.0), network.scalar(shader, "opacityThreshold", 0.0));
    cut_by(network, &mut closure, opacity, threshold);
    closure
}
