//! How scattering distributions are mixed, added, multiplied and layered: each is a sum of lobes, and the share of light that it lets pass to
//! what lies under it.

use super::closures::{behind, split};
use super::lobes::{Kind, Lobe, is_lobe, lobe};
use crate::material::emit::{add, binary, clamp, component, is_constant, mix, multiply, rest, scalar, subtract};
use crate::material::network::{Network, Shader};
use gonio::scene::{Input, Operation};

/// Lobes whose sum a scattering distribution is.
#[derive(Clone, Debug)]
pub(super) struct Sum {
    pub(super) lobes: Vec<Lobe>,
    /// Share of light that passes to what lies under it.
    passed: Input,
}

impl Sum {
    /// Nothing, through which all light passes.
    pub(super) fn empty() -> Self {
        Self { lobes: Vec::new(), passed: scalar(1.0) }
    }
}

/// The sum that a node stands for.
pub(super) fn sum(network: &mut Network<'_>, shader: &Shader) -> Sum {
    let inner = |network: &mut Network<'_>, input: &str| {
        let part = behind(network, shader, input).and_then(|part| network.within(&part, |network| sum(network, &part)));
        part.unwrap_or_else(Sum::empty)
    };
    match split(&shader.id).0 {
        "mix" => {
            let share = network.share(shader, "mix", 0.0);
            let (under, over) = (inner(network, "bg"), inner(network, "fg"));
            mixed(network, under, over, share)
        }
        "add" => {
            let (mut a, b) = (inner(network, "in1"), inner(network, "in2"));
            a.lobes.extend(b.lobes);
            let graph = &mut network.graph;
            let both = add(graph, a.passed, b.passed);
            let left = subtract(graph, both, scalar(1.0));
            Sum { lobes: a.lobes, passed: binary(graph, Operation::Maximum, left, scalar(0.0)) }
        }
        "multiply" => {
            let (part, factor) = (inner(network, "in1"), network.input(shader, "in2").unwrap_or(scalar(1.0)));
            let factor = clamp(&mut network.graph, factor, scalar(0.0), scalar(1.0));
            Sum { lobes: scaled(network, part.lobes, factor), passed: part.passed }
        }
        "layer" => {
            let (top, base) = (inner(network, "top"), inner(network, "base"));
            layered(network, top, base)
        }
        _ if !is_lobe(&shader.id) => match network.inside(shader) {
            Some(inside) => network.within(&inside, |network| sum(network, &inside)).unwrap_or_else(Sum::empty),
            None => {
                network.warn(shader, format!("the scattering distribution '{}' is not supported; it is left out", shader.id));
                Sum::empty()
            }
        },
        _ => {
            let (lobe, passed) = lobe(network, shader);
            // What has no weight takes no light either.
            if is_constant(lobe.closure.weight, 0.0) { Sum::empty() } else { Sum { lobes: vec![lobe], passed } }
        }
    }
}

fn mixed(network: &mut Network<'_>, under: Sum, over: Sum, share: Input) -> Sum {
    let graph = &mut network.graph;
    let open = rest(graph, share);
    let passed = mix(graph, under.passed, over.passed, share);
    let mut lobes = scaled(network, under.lobes, open);
    lobes.extend(scaled(network, over.lobes, share));
    Sum { lobes, passed }
}

fn scaled(network: &mut Network<'_>, mut lobes: Vec<Lobe>, factor: Input) -> Vec<Lobe> {
    for lobe in &mut lobes {
        lobe.closure.weight = multiply(&mut network.graph, lobe.closure.weight, factor);
    }
    lobes.retain(|lobe| !is_constant(lobe.closure.weight, 0.0));
    lobes
}

/// A single reflection or fuzz over diffuse bases becomes a layer of theirs, which the engine knows in all directions; other bases keep what
/// the top lets pass of the light to the viewer.
fn layered(network: &mut Network<'_>, top: Sum, mut base: Sum) -> Sum {
    let passed = multiply(&mut network.graph, top.passed, base.passed);
    let takes = |lobe: &Lobe, parameter: &str| {
        lobe.kind == Kind::Base && lobe.closure.input(parameter).is_none_or(|weight| is_constant(weight, 0.0))
    };
    let all_take = |parameter: &str| !base.lobes.is_empty() && base.lobes.iter().all(|lobe| takes(lobe, parameter));
    let parameters: &[&str] = match top.lobes.as_slice() {
        [] => return Sum { passed, ..base },
        [Lobe { kind: Kind::Reflection, .. }] if all_take("specular_weight") => &[
            "specular_color",
            "specular_ior",
            "specular_roughness",
            "specular_anisotropy",
            "specular_rotation",
            "thin_film_weight",
            "thin_film_thickness",
            "thin_film_ior",
        ],
        [Lobe { kind: Kind::Sheen, .. }] if all_take("fuzz_weight") => &["fuzz_color", "fuzz_roughness"],
        _ => {
            let mut lobes = top.lobes;
            lobes.extend(scaled(network, base.lobes, top.passed));
            return Sum { lobes, passed };
        }
    };
    let layer = &top.lobes[0];
    let weight = if layer.kind == Kind::Sheen { "fuzz_weight" } else { "specular_weight" };
    for lobe in &mut base.lobes {
        for name in parameters {
            if let Some(value) = layer.closure.input(name) {
                lobe.closure.set_input(name, value);
            }
        }
        lobe.closure.set_input(weight, component(layer.closure.weight, 0));
        lobe.closure.normal = lobe.closure.normal.or(layer.closure.normal);
        lobe.closure.tangent = lobe.closure.tangent.or(layer.closure.tangent);
    }
    Sum { passed, ..base }
}
