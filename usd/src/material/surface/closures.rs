//! Surfaces that are put together from closures: MaterialX's `surface`, `surface_unlit` and mixes, with the distributions of its physically based
//! library (MaterialX 1.38 and 1.39, "Physically Based Shading Nodes"), and Arnold's mixes.

use super::convert as convert_surface;
use super::layers::sum;
use super::lobes::diffuse;
use super::parts::{shining, straight, weighted, with_opacity};
use crate::material::emit::{binary, is_constant, mix, multiply, scalar, subtract};
use crate::material::network::{Network, Shader};
use crate::material::neutral::Source;
use gonio::scene::{Closure, Input, Operation};

/// The closures of such a surface; `None` for other shaders.
pub(super) fn convert(network: &mut Network<'_>, shader: &Shader) -> Option<Vec<Closure>> {
    match &*shader.id {
        "ND_surface" | "ND_surface_surfaceshader" => Some(surface(network, shader)),
        "ND_surface_unlit" | "ND_surface_unlit_surfaceshader" => Some(unlit(network, shader)),
        "ND_mix_surfaceshader" => Some(mixed(network, shader, ["bg", "fg", "mix"], 0.0)),
        "arnold:mix_shader" => Some(mixed(network, shader, ["shader1", "shader2", "mix"], 0.5)),
        "arnold:flat" => Some(vec![shining(network.colour(shader, "color", [1.0; 3]))]),
        "arnold:lambert" => Some(vec![lambert(network, shader)]),
        _ => None,
    }
}

/// The shader that an input is connected to.
pub(in crate::material) fn behind(network: &mut Network<'_>, shader: &Shader, input: &str) -> Option<Shader> {
    match network.source(shader, input) {
        Source::Output(node, _) => Some(network.shader(node)),
        _ => None,
    }
}

fn mixed(network: &mut Network<'_>, shader: &Shader, [under, over, share]: [&str; 3], default: f32) -> Vec<Closure> {
    let share = network.share(shader, share, default);
    let rest = subtract(&mut network.graph, scalar(1.0), share);
    let mut closures = Vec::new();
    for (input, weight) in [(under, rest), (over, share)] {
        let Some(part) = behind(network, shader, input) else { continue };
        match network.within(&part, |network| convert_surface(network, &part)) {
            Some(Some(part)) => closures.extend(weighted(network, part, weight)),
            None => {}
            Some(None) => network.warn(&part, format!("the surface shader '{}' is not supported; its share is black", part.id)),
        }
    }
    closures
}

fn lambert(network: &mut Network<'_>, shader: &Shader) -> Closure {
    let (weight, base) = (network.share(shader, "Kd", 0.8), network.colour(shader, "Kd_color", [1.0; 3]));
    let base = multiply(&mut network.graph, base, weight);
    diffuse(base, scalar(0.0))
}

fn surface(network: &mut Network<'_>, shader: &Shader) -> Vec<Closure> {
    let lobes = behind(network, shader, "bsdf").map(|bsdf| sum(network, &bsdf).lobes).unwrap_or_default();
    let mut closures: Vec<Closure> = lobes.into_iter().map(|lobe| lobe.closure).collect();
    if network.number(shader, "thin_walled", 0.0) != 0.0 {
        closures.iter_mut().for_each(|closure| closure.thin_walled = true);
    }
    if let Some(edf) = behind(network, shader, "edf") {
        let radiance = emission(network, &edf);
        closures.push(shining(radiance));
    }
    let opacity = network.share(shader, "opacity", 1.0);
    with_opacity(network, closures, opacity)
}

fn unlit(network: &mut Network<'_>, shader: &Shader) -> Vec<Closure> {
    let (emission, tint) = (network.scalar(shader, "emission", 1.0), network.colour(shader, "emission_color", [1.0; 3]));
    let mut closures = vec![shining(multiply(&mut network.graph, tint, emission))];
    let passed = network.share(shader, "transmission", 0.0);
    if !is_constant(passed, 0.0) {
        let mut clear = straight(passed);
        clear.set_input("base_color", network.colour(shader, "transmission_color", [1.0; 3]));
        closures.push(clear);
    }
    let opacity = network.share(shader, "opacity", 1.0);
    with_opacity(network, closures, opacity)
}

/// Radiance of an emission distribution.
pub(in crate::material) fn emission(network: &mut Network<'_>, shader: &Shader) -> Input {
    let inner = |network: &mut Network<'_>, input: &str| {
        let part = behind(network, shader, input).and_then(|part| network.within(&part, |network| emission(network, &part)));
        part.unwrap_or(scalar(0.0))
    };
    let (node, _) = split(&shader.id);
    match node {
        "mix" => {
            let (bg, fg, share) = (inner(network, "bg"), inner(network, "fg"), network.scalar(shader, "mix", 0.0));
            mix(&mut network.graph, bg, fg, share)
        }
        "add" => {
            let (a, b) = (inner(network, "in1"), inner(network, "in2"));
            binary(&mut network.graph, Operation::Add, a, b)
        }
        "multiply" => {
            let (edf, factor) = (inner(network, "in1"), network.input(shader, "in2").unwrap_or(scalar(1.0)));
            multiply(&mut network.graph, edf, factor)
        }
        "uniform_edf" => network.colour(shader, "color", [1.0; 3]),
        "generalized_schlick_edf" => {
            network.unsupported(&format!("the directions of '{}'", shader.id), shader);
            let (edf, facing) = (inner(network, "base"), network.colour(shader, "color0", [1.0; 3]));
            multiply(&mut network.graph, edf, facing)
        }
        "conical_edf" | "measured_edf" => {
            network.unsupported(&format!("the directions of '{}'", shader.id), shader);
            network.colour(shader, "color", [1.0; 3])
        }
        _ => match network.inside(shader) {
            Some(inside) => network.within(&inside, |network| emission(network, &inside)).unwrap_or(scalar(0.0)),
            None => {
                network.warn(shader, format!("the emission distribution '{}' is not supported; it is left out", shader.id));
                scalar(0.0)
            }
        },
    }
}

/// The node of a definition's name, see [`split`].
pub(in crate::material) fn node_name(id: &str) -> &str {
    split(id).0
}

/// `ND_mix_bsdf` is `mix`, `ND_sheen_bsdf` is `sheen_bsdf`.
pub(super) fn split(id: &str) -> (&str, &str) {
    let name = id.strip_prefix("ND_").unwrap_or(id);
    let (node, kind) = name.split_once('_').unwrap_or((name, ""));
    if matches!(node, "mix" | "add" | "multiply" | "layer") { (node, kind) } else { (name, "") }
}
