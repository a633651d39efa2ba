//! Arnold's arithmetic, conversions and corrections of colours: what stands between its images and surfaces.

use super::emit::{add, apply, binary, clamp, combine, component, divide, luminance, mix, multiply, rest, scalar, subtract, unary};
use super::network::{Network, Shader};
use gonio::scene::{Input, Operation};

/// Builds a node; `None` where it is not supported.
pub(super) fn build(network: &mut Network<'_>, shader: &Shader, node: &str) -> Option<Input> {
    let one = |operation| (operation, vec![("input", 0.0)]);
    let two = |operation| (operation, vec![("input1", 0.0), ("input2", 0.0)]);
    let (operation, names) = match node {
        "abs" => one(Operation::Absolute),
        "sqrt" => one(Operation::SquareRoot),
        "min" => two(Operation::Minimum),
        "max" => two(Operation::Maximum),
        "pow" => (Operation::Power, vec![("base", 0.0), ("exponent", 1.0)]),
        _ => return build_other(network, shader, node),
    };
    let inputs: Vec<Input> = names.into_iter().map(|(name, default)| network.input(shader, name).unwrap_or(scalar(default))).collect();
    Some(apply(&mut network.graph, operation, &inputs))
}

fn build_other(network: &mut Network<'_>, shader: &Shader, node: &str) -> Option<Input> {
    match node {
        "complement" => {
            let [input] = network.inputs(shader, [("input", 0.0)]);
            Some(rest(&mut network.graph, input))
        }
        "float_to_rgb" | "float_to_rgba" => {
            let parts = network.inputs(shader, [("r", 0.0), ("g", 0.0), ("b", 0.0), ("a", 1.0)]);
            let parts = if node == "float_to_rgb" { &parts[..3] } else { &parts[..] };
            Some(combine(&mut network.graph, parts))
        }
        "rgb_to_float" | "rgba_to_float" => to_float(network, shader),
        "range" => Some(range(network, shader)),
        "color_correct" => Some(corrected(network, shader)),
        _ => None,
    }
}

/// A colour as a number, by the mode's name.
fn to_float(network: &mut Network<'_>, shader: &Shader) -> Option<Input> {
    let [input] = network.inputs(shader, [("input", 0.0)]);
    let mode = network.text(shader, "mode").unwrap_or_else(|| "average".to_owned());
    let graph = &mut network.graph;
    let parts = [0, 1, 2].map(|index| component(input, index));
    match mode.as_str() {
        "luminance" => Some(luminance(graph, input)),
        "average" | "sum" => {
            let two = add(graph, parts[0], parts[1]);
            let sum = add(graph, two, parts[2]);
            Some(if mode == "sum" { sum } else { divide(graph, sum, scalar(3.0)) })
        }
        "min" | "max" => {
            let operation = || if mode == "min" { Operation::Minimum } else { Operation::Maximum };
            let two = binary(graph, operation(), parts[0], parts[1]);
            Some(binary(graph, operation(), two, parts[2]))
        }
        _ => None,
    }
}

/// From one range to another, along a line or a smooth step; contrast goes first.
fn range(network: &mut Network<'_>, shader: &Shader) -> Input {
    let [input, low, high] = network.inputs(shader, [("input", 0.0), ("input_min", 0.0), ("input_max", 1.0)]);
    let [out_low, out_high] = network.inputs(shader, [("output_min", 0.0), ("output_max", 1.0)]);
    let [strength, pivot] = network.inputs(shader, [("contrast", 1.0), ("contrast_pivot", 0.5)]);
    let is_smooth = network.number(shader, "smoothstep", 0.0) != 0.0;
    let graph = &mut network.graph;
    let (offset, width) = (subtract(graph, input, low), subtract(graph, high, low));
    let mut share = divide(graph, offset, width);
    if strength != scalar(1.0) {
        share = contrast(network, share, strength, pivot);
    }
    let graph = &mut network.graph;
    if is_smooth {
        let t = clamp(graph, share, scalar(0.0), scalar(1.0));
        let (square, twice) = (multiply(graph, t, t), multiply(graph, t, scalar(2.0)));
        let slope = subtract(graph, scalar(3.0), twice);
        share = multiply(graph, square, slope);
    }
    mix(graph, out_low, out_high, share)
}

fn contrast(network: &mut Network<'_>, input: Input, strength: Input, pivot: Input) -> Input {
    let graph = &mut network.graph;
    let centred = subtract(graph, input, pivot);
    let scaled = multiply(graph, centred, strength);
    add(graph, scaled, pivot)
}

/// The corrections in the order that the node names them; masks and alpha have no part in it.
fn corrected(network: &mut Network<'_>, shader: &Shader) -> Input {
    let [mut value] = network.inputs(shader, [("input", 0.0)]);
    if network.number(shader, "invert", 0.0) != 0.0 {
        value = rest(&mut network.graph, value);
    }
    let [gamma, hue, saturation] = network.inputs(shader, [("gamma", 1.0), ("hue_shift", 0.0), ("saturation", 1.0)]);
    let graph = &mut network.graph;
    if gamma != scalar(1.0) {
        let exponent = divide(graph, scalar(1.0), gamma);
        value = binary(graph, Operation::Power, value, exponent);
    }
    if hue != scalar(0.0) || saturation != scalar(1.0) {
        let hsv = unary(graph, Operation::RgbToHsv, value);
        let turned = add(graph, component(hsv, 0), hue);
        let strength = multiply(graph, component(hsv, 1), saturation);
        let adjusted = combine(graph, &[turned, strength, component(hsv, 2)]);
        value = unary(graph, Operation::HsvToRgb, adjusted);
    }
    let [strength, pivot, exposure] = network.inputs(shader, [("contrast", 1.0), ("contrast_pivot", 0.18), ("exposure", 0.0)]);
    if strength != scalar(1.0) {
        value = contrast(network, value, strength, pivot);
    }
    let [factor, offset] = network.inputs(shader, [("multiply", 1.0), ("add", 0.0)]);
    let graph = &mut network.graph;
    if exposure != scalar(0.0) {
        let stops = binary(graph, Operation::Power, scalar(2.0), exposure);
        value = multiply(graph, value, stops);
    }
    let scaled = multiply(graph, value, factor);
    add(graph, scaled, offset)
}
