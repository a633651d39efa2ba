//! Scattering distributions of MaterialX's physically based library, and how they are mixed, added, multiplied and layered.

use super::closures::{behind, split};
use crate::material::arithmetic::{colour, component, constant_scalar, is_constant, multiply, scalar, subtract};
use crate::material::network::{Network, Shader};
use gonio::scene::{Channel, Closure, Input, Model, Operation};

/// What a lobe can be in a layer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
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
    kind: Kind,
}

/// The lobes whose sum a scattering distribution is.
pub(super) fn lobes<'py>(network: &mut Network<'_, '_, 'py>, shader: &Shader<'py>) -> Vec<Lobe> {
    let inner = |network: &mut Network<'_, '_, 'py>, input: &str| {
        let part = behind(network, shader, input).and_then(|part| network.within(&part, |network| lobes(network, &part)));
        part.unwrap_or_default()
    };
    match split(&shader.id).0 {
        "mix" => {
            let share = network.scalar(shader, "mix", 0.0);
            let rest = subtract(&mut network.graph, scalar(1.0), share);
            let (under, over) = (inner(network, "bg"), inner(network, "fg"));
            let mut sum = scaled(network, under, rest);
            sum.extend(scaled(network, over, share));
            sum
        }
        "add" => {
            let mut sum = inner(network, "in1");
            sum.extend(inner(network, "in2"));
            sum
        }
        "multiply" => {
            let (part, factor) = (inner(network, "in1"), network.input(shader, "in2").unwrap_or(scalar(1.0)));
            scaled(network, part, factor)
        }
        "layer" => {
            let (top, base) = (inner(network, "top"), inner(network, "base"));
            layered(network, shader, top, base)
        }
        _ => lobe(network, shader).into_iter().collect(),
    }
}

fn scaled(network: &mut Network<'_, '_, '_>, mut lobes: Vec<Lobe>, factor: Input) -> Vec<Lobe> {
    for lobe in &mut lobes {
        lobe.closure.weight = multiply(&mut network.graph, lobe.closure.weight, factor);
    }
    lobes.retain(|lobe| !is_constant(lobe.closure.weight, 0.0));
    lobes
}

/// A single reflection or fuzz goes into each base under it, which then loses what the layer takes; other layers are added, with a word.
fn layered<'py>(network: &mut Network<'_, '_, 'py>, shader: &Shader<'py>, top: Vec<Lobe>, mut base: Vec<Lobe>) -> Vec<Lobe> {
    let takes = |lobe: &Lobe, parameter: &str| {
        lobe.kind == Kind::Base && lobe.closure.input(parameter).is_none_or(|weight| is_constant(weight, 0.0))
    };
    let parameters: &[(&str, &str)] = match top.as_slice() {
        [Lobe { kind: Kind::Reflection, .. }] if base.iter().all(|lobe| takes(lobe, "specular_weight")) => {
            &[("specular_color", "specular_color"), ("specular_ior", "specular_ior"), ("specular_roughness", "specular_roughness")]
        }
        [Lobe { kind: Kind::Sheen, .. }] if base.iter().all(|lobe| takes(lobe, "fuzz_weight")) => {
            &[("fuzz_color", "fuzz_color"), ("fuzz_roughness", "fuzz_roughness")]
        }
        [] => return base,
        _ => {
            network.unsupported("a layer over others than one diffuse base", shader);
            base.extend(top);
            return base;
        }
    };
    let layer = &top[0];
    let weight = if layer.kind == Kind::Sheen { "fuzz_weight" } else { "specular_weight" };
    for lobe in &mut base {
        for (to, from) in parameters {
            if let Some(value) = layer.closure.input(from) {
                lobe.closure.set_input(to, value);
            }
        }
        lobe.closure.set_input(weight, component(layer.closure.weight, 0));
    }
    base
}

/// A diffuse base without a layer.
pub(super) fn diffuse(base: Input, roughness: Input) -> Closure {
    let mut closure = Closure { model: Model::OpenPbr, ..Closure::default() };
    closure.set_input("base_color", base);
    closure.set_input("diffuse_roughness", roughness);
    closure.set("specular_weight", 0.0);
    closure
}

/// A lobe of the library; `None`, with a word, for those that gonio does not have.
fn lobe<'py>(network: &mut Network<'_, '_, 'py>, shader: &Shader<'py>) -> Option<Lobe> {
    let (mut closure, kind) = match shader.id.as_str() {
        "ND_oren_nayar_diffuse_bsdf" | "ND_burley_diffuse_bsdf" => {
            let (base, roughness) = (network.colour(shader, "color", [0.18; 3]), network.scalar(shader, "roughness", 0.0));
            (diffuse(base, roughness), Kind::Base)
        }
        "ND_subsurface_bsdf" => (subsurface(network, shader), Kind::Base),
        "ND_translucent_bsdf" => (single(Model::Translucent, network.colour(shader, "color", [1.0; 3])), Kind::Other),
        "ND_sheen_bsdf" => (sheen(network, shader), Kind::Sheen),
        "ND_dielectric_bsdf" => dielectric(network, shader),
        "ND_generalized_schlick_bsdf" => (schlick(network, shader), Kind::Other),
        "ND_conductor_bsdf" => (conductor(network, shader), Kind::Other),
        _ => {
            network.warn(shader, format!("the scattering distribution '{}' is not supported; it is left out", shader.id));
            return None;
        }
    };
    closure.weight = network.scalar(shader, "weight", 1.0);
    closure.normal = match network.input(shader, "normal") {
        Some(Input::Node(node, Channel::Rgb)) => Some(node).filter(|node| {
            matches!(network.graph.nodes.get(usize::from(node.0)).map(|node| &node.operation), Some(Operation::NormalMap { .. }))
        }),
        _ => None,
    };
    Some(Lobe { closure, kind })
}

fn single(model: Model, base: Input) -> Closure {
    let mut closure = Closure { model, ..Closure::default() };
    closure.set_input("base_color", base);
    closure
}

/// MaterialX's roughness is the width of the facets' distribution, of which the surface block takes the root.
fn roughness<'py>(network: &mut Network<'_, '_, 'py>, shader: &Shader<'py>) -> Input {
    if let Some(source) = behind(network, shader, "roughness").filter(|source| source.id.starts_with("ND_roughness_anisotropy")) {
        return network.scalar(&source, "roughness", 0.0);
    }
    let width = network.scalar(shader, "roughness", 0.05);
    match constant_scalar(width) {
        Some(width) => scalar(width.max(0.0).sqrt()),
        None => Input::Node(network.graph.add(Operation::SquareRoot, vec![width]), Channel::Rgb),
    }
}

fn subsurface<'py>(network: &mut Network<'_, '_, 'py>, shader: &Shader<'py>) -> Closure {
    let inner = network.colour(shader, "color", [0.18; 3]);
    let mut closure = diffuse(inner, scalar(0.0));
    closure.set("subsurface_weight", 1.0);
    closure.set_input("subsurface_color", inner);
    let (radius, metres) = (network.colour(shader, "radius", [1.0; 3]), scalar(network.context.metres_per_unit as f32));
    closure.set_input("subsurface_radius", multiply(&mut network.graph, radius, metres));
    closure.set_input("subsurface_scatter_anisotropy", network.scalar(shader, "anisotropy", 0.0));
    closure
}

fn sheen<'py>(network: &mut Network<'_, '_, 'py>, shader: &Shader<'py>) -> Closure {
    let tint = network.colour(shader, "color", [1.0; 3]);
    let mut closure = single(Model::Sheen, tint);
    closure.set_input("fuzz_color", tint);
    closure.set_input("fuzz_roughness", network.scalar(shader, "roughness", 0.3));
    closure
}

/// Reflection, refraction or both, by `scatter_mode`.
fn dielectric<'py>(network: &mut Network<'_, '_, 'py>, shader: &Shader<'py>) -> (Closure, Kind) {
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
    closure.set_input("specular_roughness", roughness(network, shader));
    (closure, kind)
}

/// As a metal between its normal colour and that at 82°.
fn schlick<'py>(network: &mut Network<'_, '_, 'py>, shader: &Shader<'py>) -> Closure {
    let mut closure = diffuse(network.colour(shader, "color0", [1.0; 3]), scalar(0.0));
    closure.set("metalness", 1.0);
    closure.set_input("metal_edge_tint", network.colour(shader, "color82", [1.0; 3]));
    closure.set_input("specular_roughness", roughness(network, shader));
    if network.text(shader, "scatter_mode").is_some_and(|mode| mode != "R") {
        network.unsupported("transmission of generalized_schlick_bsdf", shader);
    }
    closure
}

fn conductor<'py>(network: &mut Network<'_, '_, 'py>, shader: &Shader<'py>) -> Closure {
    let mut closure = Closure { model: Model::Conductor, ..Closure::default() };
    closure.set_input("metal_n", network.colour(shader, "ior", [0.183, 0.421, 1.373]));
    closure.set_input("metal_k", network.colour(shader, "extinction", [3.424, 2.346, 1.770]));
    closure.set_input("specular_roughness", roughness(network, shader));
    closure
}
