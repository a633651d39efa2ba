//! UsdPreviewSurface as parameters of the surface block, by the UsdPreviewSurface specification.

use super::parts::{cut_by, straight, weighted};
use crate::material::emit::{binary, constant_scalar, is_constant, multiply, scalar, subtract};
use crate::material::network::{Network, Shader};
use crate::material::usd_nodes::tangent_normal;
use gonio::scene::{Channel, Closure, Graph, Input, Model, NodeId, Operation};

/// Index of refraction that stands in where the interface's own reflects nothing.
const FALLBACK_IOR: f32 = 1.5;

/// Reflectance at normal incidence of an interface.
fn normal_reflectance(ior: f32) -> f32 {
    let ratio = (ior - 1.0) / (ior + 1.0);
    ratio * ratio
}

/// What models that are otherwise like it call the base colour, and its default.
#[derive(Clone, Copy, Debug)]
pub(super) struct Names {
    pub(super) base: &'static str,
    pub(super) base_default: [f32; 3],
}

/// Converts the surface; its defaults are the specification's.
pub(super) fn convert(network: &mut Network<'_>, shader: &Shader) -> Vec<Closure> {
    convert_as(network, shader, Names { base: "diffuseColor", base_default: [0.18; 3] })
}

/// Converts a surface of the same parameters but for these names.
pub(super) fn convert_as(network: &mut Network<'_>, shader: &Shader, names: Names) -> Vec<Closure> {
    let mut closure = Closure { model: Model::PreviewSurface, ..Closure::default() };
    let diffuse = network.colour(shader, names.base, names.base_default);
    closure.set_input("base_color", diffuse);
    let ior = network.scalar(shader, "ior", 1.5);
    closure.set_input("specular_ior", ior);
    closure.set_input("specular_roughness", network.scalar(shader, "roughness", 0.5));
    if network.number(shader, "useSpecularWorkflow", 0.0) != 0.0 {
        specular_workflow(network, shader, &mut closure, ior);
    } else {
        // The metal's colour holds at all angles: F90 = F0.
        closure.set_input("metalness", network.share(shader, "metallic", 0.0));
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
    closure.normal = normal(network, shader);
    opacity(network, shader, closure)
}

/// F0 is the specular colour: a tint of what the index gives.
fn specular_workflow(network: &mut Network<'_>, shader: &Shader, closure: &mut Closure, ior: Input) {
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

/// What opacity lacks goes straight through what the interface does not reflect, and leaves the reflection; with a threshold or the mode
/// `presence` it removes the surface.
fn opacity(network: &mut Network<'_>, shader: &Shader, mut closure: Closure) -> Vec<Closure> {
    let opacity = network.share(shader, "opacity", 1.0);
    let threshold = network.scalar(shader, "opacityThreshold", 0.0);
    let cuts = constant_scalar(threshold).is_none_or(|threshold| threshold > 0.0);
    let is_presence = network.text(shader, "opacityMode").as_deref() == Some("presence");
    if is_presence || cuts || is_constant(opacity, 1.0) {
        cut_by(network, &mut closure, opacity, threshold);
        return vec![closure];
    }
    let clear = reflection_alone(network, &closure);
    let metalness = closure.input("metalness").unwrap_or(scalar(0.0));
    let graph = &mut network.graph;
    let open = subtract(graph, scalar(1.0), opacity);
    let dielectric = subtract(graph, scalar(1.0), metalness);
    let reflected = interface_reflectance(graph, &closure);
    let passed = subtract(graph, scalar(1.0), reflected);
    let passed = multiply(graph, passed, dielectric);
    let passed = straight(multiply(graph, open, passed));
    let mut closures = weighted(network, vec![closure], opacity);
    closures.extend(weighted(network, vec![clear], open));
    closures.push(passed);
    closures
}

/// The surface without its diffuse part; the metal's colour stays.
fn reflection_alone(network: &mut Network<'_>, closure: &Closure) -> Closure {
    let (base, metalness) = (closure.input("base_color").unwrap_or(scalar(0.0)), closure.input("metalness").unwrap_or(scalar(0.0)));
    let mut clear = closure.clone();
    clear.set_input("base_color", multiply(&mut network.graph, base, metalness));
    clear
}

/// What a smooth interface of the surface's index reflects of light from where it is seen.
fn interface_reflectance(graph: &mut Graph, closure: &Closure) -> Input {
    if closure.input("specular_scale").is_some_and(|scale| is_constant(scale, 0.0)) {
        return scalar(0.0);
    }
    let whole = |graph: &mut Graph, operation, inputs| Input::Node(graph.add(operation, inputs), Channel::Rgb);
    let (incoming, normal) = (whole(graph, Operation::Incoming, vec![]), whole(graph, Operation::Normal, vec![]));
    let cosine = whole(graph, Operation::Dot, vec![incoming, normal]);
    let ior = closure.input("specular_ior").unwrap_or(scalar(FALLBACK_IOR));
    whole(graph, Operation::Fresnel, vec![cosine, ior])
}

fn normal(network: &mut Network<'_>, shader: &Shader) -> Option<NodeId> {
    match tangent_normal(network, shader)? {
        Input::Constant(_) => None,
        tangent @ Input::Node(..) => Some(network.graph.add(Operation::NormalMap { scale: 1.0, uv: None }, vec![tangent])),
    }
}
