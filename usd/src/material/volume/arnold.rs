//! Arnold's standard_volume: extinction by density and transparency, of which a part is scattered, and light by a channel, the density or the heat.

use super::Parts;
use crate::material::emit::{binary, combine, component, mix, multiply, rest, scalar, unary};
use crate::material::network::{Network, Shader};
use crate::material::varying::primvar;
use gonio::scene::{Input, Operation};

pub(super) const ID: &str = "arnold:standard_volume";

/// What is left over `transparent_depth` where nothing is said: 1 / e.
const TRANSPARENT: f32 = 0.367_879;
/// Radiance of a black body a fourth power of kelvin, W/(m² sr K⁴), scaled as the emission of the engines that share this rule.
const STEFAN_BOLTZMANN: f32 = 5.670_373e-8 * 1e-6 / std::f32::consts::PI;

/// The node as a medium.
pub(super) fn convert(network: &mut Network<'_>, shader: &Shader) -> Parts {
    let density = network.scalar(shader, "density", 1.0);
    let density = by_channel(network, shader, density, "density_channel", "density");
    let (left, depth) = (network.colour(shader, "transparent", [TRANSPARENT; 3]), network.scalar(shader, "transparent_depth", 1.0));
    let left = by_channel(network, shader, left, "transparent_channel", "");
    let (scatter, tint) = (network.share(shader, "scatter", 1.0), network.colour(shader, "scatter_color", [0.5; 3]));
    let tint = by_channel(network, shader, tint, "scatter_color_channel", "");
    let graph = &mut network.graph;
    // What lets nothing through has no coefficient.
    let held = binary(graph, Operation::Maximum, left, scalar(1e-6));
    let held = binary(graph, Operation::Minimum, held, scalar(1.0));
    let logarithms = [0, 1, 2].map(|part| unary(graph, Operation::Logarithm, component(held, part)));
    let logarithm = combine(graph, &logarithms);
    let depths = multiply(graph, logarithm, scalar(-1.0));
    let a_unit = binary(graph, Operation::Divide, depths, depth);
    let albedo = multiply(graph, tint, scatter);
    let lost = rest(graph, albedo);
    let (scattered, absorbed) = (multiply(graph, a_unit, albedo), multiply(graph, a_unit, lost));
    let (scattering, absorption) = (multiply(graph, scattered, density), multiply(graph, absorbed, density));
    let anisotropy = network.number(shader, "scatter_anisotropy", 0.0);
    Parts { absorption, scattering, emission: emission(network, shader, density), anisotropy }
}

/// A value times the field that an input names; the value itself where that is empty.
fn by_channel(network: &mut Network<'_>, shader: &Shader, value: Input, input: &str, default: &str) -> Input {
    let name = network.text(shader, input).unwrap_or_else(|| default.to_owned());
    if name.is_empty() {
        return value;
    }
    let channel = primvar(&mut network.graph, name, scalar(0.0));
    multiply(&mut network.graph, value, channel)
}

fn emission(network: &mut Network<'_>, shader: &Shader, density: Input) -> Input {
    let (strength, tint) = (network.scalar(shader, "emission", 1.0), network.colour(shader, "emission_color", [1.0; 3]));
    let even = multiply(&mut network.graph, tint, strength);
    match network.text(shader, "emission_mode").as_deref().unwrap_or("blackbody") {
        "channel" => by_channel(network, shader, even, "emission_channel", "heat"),
        "density" => multiply(&mut network.graph, even, density),
        "blackbody" => {
            let glow = blackbody(network, shader);
            multiply(&mut network.graph, even, glow)
        }
        _ => scalar(0.0),
    }
}

/// The light of a black body: its colour, between even strength and that of the fourth power of its temperature.
fn blackbody(network: &mut Network<'_>, shader: &Shader) -> Input {
    let (temperature, kelvin) = (network.scalar(shader, "temperature", 1.0), network.scalar(shader, "blackbody_kelvin", 5000.0));
    let temperature = by_channel(network, shader, temperature, "temperature_channel", "temperature");
    let share = network.scalar(shader, "blackbody_intensity", 1.0);
    let graph = &mut network.graph;
    let kelvin = component(multiply(graph, temperature, kelvin), 0);
    let colour = unary(graph, Operation::Blackbody, kelvin);
    let square = multiply(graph, kelvin, kelvin);
    let fourth = multiply(graph, square, square);
    let physical = multiply(graph, fourth, scalar(STEFAN_BOLTZMANN));
    let strength = mix(graph, scalar(1.0), physical, share);
    multiply(graph, colour, strength)
}
