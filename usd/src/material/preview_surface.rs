//! UsdPreviewSurface as parameters of the surface block, by the UsdPreviewSurface specification.

use super::arithmetic::{binary, colour, constant_scalar, is_constant, scalar, subtract};
use super::network::{Network, Shader};
use super::usd_nodes::tangent_normal;
use gonio::scene::{Closure, Input, Model, NodeId, Operation};

/// Index of refraction that stands in where the interface's own reflects nothing.
const FALLBACK_IOR: f32 = 1.5;

/// Reflectance at normal incidence of an interface.
fn normal_reflectance(ior: f32) -> f32 {
    let ratio = (ior - 1.0) / (ior + 1.0);
    ratio * ratio
}

/// Converts the surface; its defaults are the specification's.
pub(super) fn convert<'py>(network: &mut Network<'_, '_, 'py>, shader: &Shader<'py>) -> Closure {
    let mut closure = Closure { model: Model::PreviewSurface, ..Closure::default() };
    let diffuse = network.colour(shader, "diffuseColor", [0.18; 3]);
    closure.set_input("base_color", diffuse);
    let ior = network.scalar(shader, "ior", 1.5);
    closure.set_input("specular_ior", ior);
    closure.set_input("specular_roughness", network.scalar(shader, "roughness", 0.5));
    if network.number(shader, "useSpecularWorkflow", 0.0) != 0.0 {
        specular_workflow(network, shader, &mut closure, ior);
    } else {
        // The metal's colour holds at all angles: F90 = F0.
        closure.set_input("metalness", network.scalar(shader, "metallic", 0.0));
        closure.set_input("metal_edge_tint", diffuse);
    }
    // Without a step of the index there is no interface that could reflect.
    if is_constant(ior, 1.0) && closure.input("specular_color").is_none_or(|tint| is_constant(tint, 0.0)) {
        closure.set("specular_scale", 0.0);
    }
    closure.set_input("coat_weight", network.scalar(shader, "clearcoat", 0.0));
    closure.set_input("coat_roughness", network.scalar(shader, "clearcoatRoughness", 0.01));
    closure.set_input("coat_ior", ior);
    closure.set("coat_darkening", 0.0);
    closure.set_input("emission_color", network.colour(shader, "emissiveColor", [0.0; 3]));
    opacity(network, shader, &mut closure);
    closure.normal = normal(network, shader);
    if network.input(shader, "displacement").is_some_and(|input| !is_constant(input, 0.0)) {
        network.unsupported("displacement of UsdPreviewSurface", shader);
    }
    closure
}

/// F0 is the specular colour: a tint of what the index gives.
fn specular_workflow<'py>(network: &mut Network<'_, '_, 'py>, shader: &Shader<'py>, closure: &mut Closure, ior: Input) {
    let wanted = network.colour(shader, "specularColor", [0.0; 3]);
    closure.set("metalness", 0.0);
    let tint = match constant_scalar(ior) {
        Some(ior) if normal_reflectance(ior) > 0.0 => {
            binary(&mut network.graph, Operation::Multiply, wanted, scalar(normal_reflectance(ior).recip()))
        }
        Some(_) => {
            if !is_constant(wanted, 0.0) {
                closure.set("specular_ior", FALLBACK_IOR);
            }
            binary(&mut network.graph, Operation::Multiply, wanted, scalar(normal_reflectance(FALLBACK_IOR).recip()))
        }
        None => {
            let graph = &mut network.graph;
            let difference = subtract(graph, ior, scalar(1.0));
            let sum = binary(graph, Operation::Add, ior, scalar(1.0));
            let ratio = binary(graph, Operation::Divide, difference, sum);
            let reflectance = binary(graph, Operation::Multiply, ratio, ratio);
            binary(graph, Operation::Divide, wanted, reflectance)
        }
    };
    closure.set_input("specular_color", tint);
}

/// Opacity removes the surface. Only where the file itself says `transparent`, what is missing is smooth transmission under the reflection.
fn opacity<'py>(network: &mut Network<'_, '_, 'py>, shader: &Shader<'py>, closure: &mut Closure) {
    let opacity = network.scalar(shader, "opacity", 1.0);
    closure.opacity_threshold = network.number(shader, "opacityThreshold", 0.0).clamp(0.0, 1.0);
    let is_strict = network.text(shader, "opacityMode").as_deref() == Some("transparent");
    if is_strict && closure.opacity_threshold == 0.0 {
        let transmission = subtract(&mut network.graph, scalar(1.0), opacity);
        closure.set_input("transmission_weight", transmission);
        closure.set_input("transmission_color", colour([1.0; 3]));
        // Held in 0 to 1 after the sum: smooth whatever the roughness of the reflection.
        closure.set("transmission_extra_roughness", -1.0);
    } else {
        closure.set_input("geometry_opacity", opacity);
    }
}

fn normal<'py>(network: &mut Network<'_, '_, 'py>, shader: &Shader<'py>) -> Option<NodeId> {
    match tangent_normal(network, shader)? {
        Input::Constant(_) => None,
        tangent @ Input::Node(..) => Some(network.graph.add(Operation::NormalMap { scale: 1.0, uv: None }, vec![tangent])),
    }
}
