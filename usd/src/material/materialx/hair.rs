//! What hair is told: absorption from pigments or from a colour, widths of lobes from roughnesses.

use super::super::emit::{add, apply, binary, colour, combine, component, multiply, rest, scalar, subtract, unary};
use super::super::network::{Network, Shader};
use gonio::scene::{Graph, Input, Operation};

/// Least share of light that pigments leave.
const LEAST: f32 = 1e-4;

/// Variance along the fibre and width about it of one of three lobes.
pub(super) fn roughness(network: &mut Network<'_>, shader: &Shader, output: &str) -> Option<Input> {
    let [along, about] = network.inputs(shader, [("longitudinal", 0.1), ("azimuthal", 0.2)]);
    let (name, usual) = match output {
        "roughness_TT" => ("scale_TT", 0.5),
        "roughness_TRT" => ("scale_TRT", 2.0),
        _ => ("", 1.0),
    };
    let scale = if name.is_empty() { scalar(usual) } else { network.scalar(shader, name, usual) };
    let graph = &mut network.graph;
    let widths = apply(graph, Operation::HairRoughness, &[component(along, 0), component(about, 0)]);
    let square = multiply(graph, scale, scale);
    let variance = multiply(graph, component(widths, 0), square);
    Some(combine(graph, &[component(variance, 0), component(widths, 1)]))
}

/// Absorption of two pigments, whose colours are what a unit of them leaves of light.
pub(super) fn from_melanin(network: &mut Network<'_>, shader: &Shader, _: &str) -> Option<Input> {
    let [concentration, redness] = network.inputs(shader, [("melanin_concentration", 0.25), ("melanin_redness", 0.5)]);
    let eumelanin = network.colour(shader, "eumelanin_color", [0.657_704, 0.498_077, 0.254_107]);
    let pheomelanin = network.colour(shader, "pheomelanin_color", [0.829_444, 0.670_32, 0.349_938]);
    let graph = &mut network.graph;
    let left = rest(graph, component(concentration, 0));
    let amount = absorbed(graph, left, LEAST);
    let red = multiply(graph, amount, component(redness, 0));
    let brown = subtract(graph, amount, red);
    let (eumelanin, pheomelanin) = (absorbed(graph, eumelanin, 1e-6), absorbed(graph, pheomelanin, 1e-6));
    let (brown, red) = (multiply(graph, eumelanin, component(brown, 0)), multiply(graph, pheomelanin, component(red, 0)));
    let sum = add(graph, brown, red);
    Some(binary(graph, Operation::Maximum, sum, scalar(0.0)))
}

/// −ln of a share that is held to `least`.
fn absorbed(graph: &mut Graph, share: Input, least: f32) -> Input {
    let share = binary(graph, Operation::Maximum, share, scalar(least));
    let logarithm = unary(graph, Operation::Logarithm, share);
    binary(graph, Operation::Subtract, scalar(0.0), logarithm)
}

/// The absorption with which much hair has a colour.
pub(super) fn from_color(network: &mut Network<'_>, shader: &Shader, _: &str) -> Option<Input> {
    let asked = network.input(shader, "color").unwrap_or(colour([1.0; 3]));
    let about = network.scalar(shader, "azimuthal_roughness", 0.2);
    Some(apply(&mut network.graph, Operation::HairAbsorption, &[asked, about]))
}
