//! Adjustment of numbers and colours: ranges, contrast, saturation, hue.

use super::super::emit::{add, clamp, colour, combine, component, divide, less, mix, multiply, rest, scalar, subtract};
use super::super::network::{Network, Shader};
use super::math::{dot, safe_power, to_hsv, to_rgb};
use gonio::scene::{Graph, Input};

/// The weights of a luminance where none are said: those of ACEScg, whatever the working space.
const WEIGHTS: [f32; 3] = [0.272_228_7, 0.674_081_8, 0.053_689_5];

/// `in`, `inlow`, `inhigh`, `outlow`, `outhigh`.
pub(super) fn remap(graph: &mut Graph, inputs: &[Input]) -> Input {
    let offset = subtract(graph, inputs[0], inputs[1]);
    let in_range = subtract(graph, inputs[2], inputs[1]);
    let out_range = subtract(graph, inputs[4], inputs[3]);
    let share = divide(graph, offset, in_range);
    let scaled = multiply(graph, share, out_range);
    add(graph, scaled, inputs[3])
}

/// `in`, `amount`, `pivot`.
pub(super) fn contrast(graph: &mut Graph, inputs: &[Input]) -> Input {
    let centred = subtract(graph, inputs[0], inputs[2]);
    let scaled = multiply(graph, centred, inputs[1]);
    add(graph, scaled, inputs[2])
}

/// `in`, `inlow`, `inhigh`, `gamma`, `outlow`, `outhigh`, `doclamp`.
pub(super) fn range(graph: &mut Graph, inputs: &[Input]) -> Input {
    let unit = remap(graph, &[inputs[0], inputs[1], inputs[2], scalar(0.0), scalar(1.0)]);
    let exponent = divide(graph, scalar(1.0), inputs[3]);
    let curved = if exponent == scalar(1.0) { unit } else { safe_power(graph, &[unit, exponent]) };
    let spread = remap(graph, &[curved, scalar(0.0), scalar(1.0), inputs[4], inputs[5]]);
    let held = clamp(graph, spread, inputs[4], inputs[5]);
    mix(graph, spread, held, inputs[6])
}

/// `in`, `low`, `high`: 0 below, 1 above, the cubic between.
pub(super) fn smoothstep(graph: &mut Graph, inputs: &[Input]) -> Input {
    let (value, low, high) = (inputs[0], inputs[1], inputs[2]);
    let (offset, width) = (subtract(graph, value, low), subtract(graph, high, low));
    let share = divide(graph, offset, width);
    let t = clamp(graph, share, scalar(0.0), scalar(1.0));
    let twice = multiply(graph, t, scalar(2.0));
    let slope = subtract(graph, scalar(3.0), twice);
    let square = multiply(graph, t, t);
    let cubic = multiply(graph, square, slope);
    // A step, where the ends are the same or change sides: above comes first.
    let below_high = less(graph, value, high);
    let above_low = less(graph, low, value);
    let inner = multiply(graph, cubic, above_low);
    mix(graph, scalar(1.0), inner, below_high)
}

/// The luminance of a colour by weights, in its colour components.
fn grey(network: &mut Network<'_>, shader: &Shader, input: Input) -> Input {
    let weights = network.input(shader, "lumacoeffs").unwrap_or(colour(WEIGHTS));
    let grey = dot(&mut network.graph, input, weights, 3);
    with_alpha(&mut network.graph, grey, input)
}

/// The colour of one input with the alpha of another.
fn with_alpha(graph: &mut Graph, colour: Input, alpha: Input) -> Input {
    let parts = [component(colour, 0), component(colour, 1), component(colour, 2), component(alpha, 3)];
    combine(graph, &parts)
}

pub(super) fn luminance(network: &mut Network<'_>, shader: &Shader, _: &str) -> Option<Input> {
    let [input] = network.inputs(shader, [("in", 0.0)]);
    Some(grey(network, shader, input))
}

pub(super) fn saturate(network: &mut Network<'_>, shader: &Shader, _: &str) -> Option<Input> {
    let [input, amount] = network.inputs(shader, [("in", 0.0), ("amount", 1.0)]);
    let grey = grey(network, shader, input);
    let mixed = mix(&mut network.graph, grey, input, amount);
    Some(with_alpha(&mut network.graph, mixed, input))
}

/// The hue is turned, saturation and value are multiplied.
pub(super) fn hsv_adjust(network: &mut Network<'_>, shader: &Shader, _: &str) -> Option<Input> {
    let [input] = network.inputs(shader, [("in", 0.0)]);
    let amount = network.input(shader, "amount").unwrap_or(colour([0.0, 1.0, 1.0]));
    let graph = &mut network.graph;
    let hsv = to_hsv(graph, &[input]);
    let turn = multiply(graph, amount, Input::Constant([1.0, 0.0, 0.0, 0.0]));
    let factors = multiply(graph, amount, Input::Constant([0.0, 1.0, 1.0, 0.0]));
    let factors = add(graph, factors, Input::Constant([1.0, 0.0, 0.0, 1.0]));
    let turned = add(graph, hsv, turn);
    let adjusted = multiply(graph, turned, factors);
    Some(to_rgb(graph, &[adjusted]))
}

/// `fg`, `bg`, `mix`: multiplied where the ground is dark, screened where it is light.
pub(super) fn overlay(graph: &mut Graph, inputs: &[Input]) -> Input {
    let (over, under) = (inputs[0], inputs[1]);
    let (over_rest, under_rest) = (rest(graph, over), rest(graph, under));
    let dark = multiply(graph, over, under);
    let dark = multiply(graph, dark, scalar(2.0));
    let light = multiply(graph, over_rest, under_rest);
    let light = multiply(graph, light, scalar(2.0));
    let light = rest(graph, light);
    let is_dark = less(graph, under, scalar(0.5));
    let laid = mix(graph, light, dark, is_dark);
    mix(graph, under, laid, inputs[2])
}
