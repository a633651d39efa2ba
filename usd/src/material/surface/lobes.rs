//! Scattering distributions of MaterialX's physically based library as closures.

use super::albedo::{dielectric_albedo, mean, schlick_albedo, sheen_albedo};
use super::facets::{Widths, facets, film};
use super::hair;
use crate::material::emit::{add, clamp, colour, divide, multiply, rest, scalar, unary};
use crate::material::network::{Network, Shader};
use gonio::scene::{Channel, Closure, Distribution, Input, Model, NodeId, Operation};

/// The distributions that become lobes.
const LOBES: [&str; 9] = [
    "ND_oren_nayar_diffuse_bsdf",
    "ND_burley_diffuse_bsdf",
    "ND_subsurface_bsdf",
    "ND_translucent_bsdf",
    "ND_sheen_bsdf",
    "ND_dielectric_bsdf",
    "ND_generalized_schlick_bsdf",
    "ND_conductor_bsdf",
    "ND_chiang_hair_bsdf",
];

/// The distribution of hair, which has no weight.
const HAIR: &str = "ND_chiang_hair_bsdf";

/// What a lobe can be in a layer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Diffuse or subsurface: takes layers.
    Base,
    /// The reflection of a dielectric.
    Reflection,
    /// Fuzz.
    Sheen,
    /// Anything else.
    Other,
}

/// A closure on its way into a surface.
#[derive(Clone, Debug)]
pub(super) struct Lobe {
    pub(super) closure: Closure,
    pub(super) kind: Kind,
}

/// Whether a distribution is one of the library's own.
pub(super) fn is_lobe(id: &str) -> bool {
    LOBES.contains(&id)
}

/// A diffuse base without a layer.
pub(super) fn diffuse(base: Input, roughness: Input) -> Closure {
    let mut closure = Closure { model: Model::OpenPbr, ..Closure::default() };
    closure.set_input("base_color", base);
    closure.set_input("diffuse_roughness", roughness);
    closure.set("specular_weight", 0.0);
    closure
}

/// A lobe of the library, and the share of light that it lets pass to what lies under it: none for what is opaque.
pub(super) fn lobe(network: &mut Network<'_>, shader: &Shader) -> (Lobe, Input) {
    let (mut closure, kind) = match &*shader.id {
        "ND_subsurface_bsdf" => (subsurface(network, shader), Kind::Base),
        "ND_translucent_bsdf" => (single(Model::Translucent, network.colour(shader, "color", [1.0; 3])), Kind::Other),
        "ND_sheen_bsdf" => (sheen(network, shader), Kind::Sheen),
        "ND_dielectric_bsdf" => dielectric(network, shader),
        "ND_generalized_schlick_bsdf" => schlick(network, shader),
        "ND_conductor_bsdf" => (conductor(network, shader), Kind::Other),
        HAIR => (hair::chiang(network, shader), Kind::Other),
        _ => {
            let (base, roughness) = (network.colour(shader, "color", [0.18; 3]), network.scalar(shader, "roughness", 0.0));
            (diffuse(base, roughness), Kind::Base)
        }
    };
    closure.normal = direction(network, shader, "normal");
    if &*shader.id == HAIR {
        return (Lobe { closure, kind }, scalar(0.0));
    }
    closure.weight = network.share(shader, "weight", 1.0);
    closure.tangent = direction(network, shader, "tangent");
    let reflected = match &*shader.id {
        "ND_sheen_bsdf" => Some(sheen_albedo(network, &closure)),
        "ND_dielectric_bsdf" => Some(dielectric_albedo(network, &closure)),
        "ND_generalized_schlick_bsdf" => Some(schlick_albedo(network, shader, &closure)),
        _ => None,
    };
    let graph = &mut network.graph;
    let passed = match reflected {
        Some(reflected) => {
            let taken = multiply(graph, reflected, closure.weight);
            rest(graph, taken)
        }
        None => scalar(0.0),
    };
    (Lobe { closure, kind }, passed)
}

/// A direction of the world that an input reads from a node.
pub(super) fn direction(network: &mut Network<'_>, shader: &Shader, name: &str) -> Option<NodeId> {
    match network.input(shader, name)? {
        Input::Node(node, Channel::Rgb) => Some(node),
        _ => None,
    }
}

fn single(model: Model, base: Input) -> Closure {
    let mut closure = Closure { model, ..Closure::default() };
    closure.set_input("base_color", base);
    closure
}

fn subsurface(network: &mut Network<'_>, shader: &Shader) -> Closure {
    let inner = network.colour(shader, "color", [0.18; 3]);
    let mut closure = diffuse(inner, scalar(0.0));
    closure.set("subsurface_weight", 1.0);
    closure.set_input("subsurface_color", inner);
    let (radius, metres) = (network.colour(shader, "radius", [1.0; 3]), scalar(network.host.metres_per_unit() as f32));
    closure.set_input("subsurface_radius", multiply(&mut network.graph, radius, metres));
    closure.set_input("subsurface_scatter_anisotropy", network.scalar(shader, "anisotropy", 0.0));
    closure
}

fn sheen(network: &mut Network<'_>, shader: &Shader) -> Closure {
    let tint = network.colour(shader, "color", [1.0; 3]);
    let mut closure = single(Model::Sheen, tint);
    closure.set_input("fuzz_color", tint);
    closure.set_input("fuzz_roughness", network.scalar(shader, "roughness", 0.3));
    closure
}

/// Reflection, refraction or both, by `scatter_mode`.
fn dielectric(network: &mut Network<'_>, shader: &Shader) -> (Closure, Kind) {
    let tint = network.colour(shader, "tint", [1.0; 3]);
    let (mut closure, kind) = match network.text(shader, "scatter_mode").as_deref() {
        Some("T") => (single(Model::Refraction, tint), Kind::Other),
        Some("RT") => (single(Model::Glass, tint), Kind::Other),
        _ => {
            let mut closure = diffuse(colour([0.0; 3]), scalar(0.0));
            closure.set("specular_weight", 1.0);
            closure.set_input("specular_color", tint);
            (closure, Kind::Reflection)
        }
    };
    closure.set_input("specular_ior", network.scalar(shader, "ior", 1.5));
    finish_interface(network, shader, &mut closure);
    (closure, kind)
}

/// What all interfaces are told: widths, film, distribution.
fn finish_interface(network: &mut Network<'_>, shader: &Shader, closure: &mut Closure) {
    let widths = if closure.model == Model::OpenPbr { Widths::OpenPbr } else { Widths::Principled };
    facets(network, shader, closure, widths);
    film(network, shader, closure);
    if network.number(shader, "retroreflective", 0.0) != 0.0 {
        network.unsupported("retroreflection of MaterialX", shader);
    }
    closure.distribution = Distribution::MultiGgx;
}

/// As a metal between its normal colour and that at 82°; what passes is refracted by an index of the same normal reflectance.
fn schlick(network: &mut Network<'_>, shader: &Shader) -> (Closure, Kind) {
    let normal_colour = network.colour(shader, "color0", [1.0; 3]);
    let mode = network.text(shader, "scatter_mode");
    let mut closure = match mode.as_deref() {
        Some("T" | "RT") => {
            let model = if mode.as_deref() == Some("T") { Model::Refraction } else { Model::Glass };
            let mut closure = single(model, scalar(1.0));
            let graph = &mut network.graph;
            let mean = mean(graph, normal_colour);
            let mean = clamp(graph, mean, scalar(0.0), scalar(0.99));
            let root = unary(graph, Operation::SquareRoot, mean);
            let (more, less) = (add(graph, root, scalar(1.0)), rest(graph, root));
            closure.set_input("specular_ior", divide(graph, more, less));
            closure
        }
        _ => {
            let mut closure = diffuse(normal_colour, scalar(0.0));
            closure.set("metalness", 1.0);
            closure.set_input("metal_edge_tint", network.colour(shader, "color82", [1.0; 3]));
            closure
        }
    };
    for (name, meant) in [("color90", 1.0), ("exponent", 5.0)] {
        if network.input(shader, name).is_some_and(|value| !crate::material::emit::is_constant(value, meant)) {
            network.unsupported(&format!("input '{name}' of {}", shader.id), shader);
        }
    }
    finish_interface(network, shader, &mut closure);
    (closure, Kind::Other)
}

fn conductor(network: &mut Network<'_>, shader: &Shader) -> Closure {
    let mut closure = Closure { model: Model::Conductor, ..Closure::default() };
    closure.set_input("metal_n", network.colour(shader, "ior", [0.183, 0.421, 1.373]));
    closure.set_input("metal_k", network.colour(shader, "extinction", [3.424, 2.346, 1.770]));
    finish_interface(network, shader, &mut closure);
    closure
}
