//! Arithmetic, trigonometry, comparisons and logic.

use super::super::emit::{add, apply, binary, component, divide, less, mix, multiply, rest, scalar, subtract, unary};
use super::super::network::{Network, Shader};
use gonio::scene::{Graph, Input, Operation};

/// Components of the vectors whose type is in a definition's name.
fn width(kind: &str) -> usize {
    match kind.as_bytes().get(kind.len().saturating_sub(1)) {
        Some(b'2') => 2,
        Some(b'4') => 4,
        _ => 3,
    }
}

/// `in1 - in2 · floor(in1 / in2)`.
pub(super) fn modulo(graph: &mut Graph, inputs: &[Input]) -> Input {
    let ratio = divide(graph, inputs[0], inputs[1]);
    let whole = unary(graph, Operation::Floor, ratio);
    let taken = multiply(graph, inputs[1], whole);
    subtract(graph, inputs[0], taken)
}

pub(super) fn fract(graph: &mut Graph, inputs: &[Input]) -> Input {
    let whole = unary(graph, Operation::Floor, inputs[0]);
    subtract(graph, inputs[0], whole)
}

pub(super) fn ceil(graph: &mut Graph, inputs: &[Input]) -> Input {
    let negative = multiply(graph, inputs[0], scalar(-1.0));
    let whole = unary(graph, Operation::Floor, negative);
    multiply(graph, whole, scalar(-1.0))
}

/// To the nearest whole number, halves up.
pub(super) fn round(graph: &mut Graph, inputs: &[Input]) -> Input {
    let moved = add(graph, inputs[0], scalar(0.5));
    unary(graph, Operation::Floor, moved)
}

/// Small whole powers also of negative bases.
pub(super) fn power(graph: &mut Graph, inputs: &[Input]) -> Input {
    let whole = match inputs[1] {
        Input::Constant(exponents) if exponents == [exponents[0]; 4] => exponents[0],
        _ => 0.0,
    };
    match whole {
        1.0 => inputs[0],
        2.0 => multiply(graph, inputs[0], inputs[0]),
        3.0 => {
            let square = multiply(graph, inputs[0], inputs[0]);
            multiply(graph, square, inputs[0])
        }
        4.0 => {
            let square = multiply(graph, inputs[0], inputs[0]);
            multiply(graph, square, square)
        }
        _ => binary(graph, Operation::Power, inputs[0], inputs[1]),
    }
}

/// The sign of the base stays.
pub(super) fn safe_power(graph: &mut Graph, inputs: &[Input]) -> Input {
    let (sign, magnitude) = (unary(graph, Operation::Sign, inputs[0]), unary(graph, Operation::Absolute, inputs[0]));
    let power = binary(graph, Operation::Power, magnitude, inputs[1]);
    multiply(graph, sign, power)
}

pub(super) fn tangent(graph: &mut Graph, inputs: &[Input]) -> Input {
    let (sine, cosine) = (unary(graph, Operation::Sine, inputs[0]), unary(graph, Operation::Cosine, inputs[0]));
    divide(graph, sine, cosine)
}

/// The inner product of vectors of two to four components.
pub(super) fn dot(graph: &mut Graph, a: Input, b: Input, width: usize) -> Input {
    if width == 3 {
        return component(binary(graph, Operation::Dot, a, b), 0);
    }
    let product = multiply(graph, a, b);
    let mut sum = component(product, 0);
    for index in 1..width {
        sum = add(graph, sum, component(product, index));
    }
    sum
}

pub(super) fn dot_product(network: &mut Network<'_>, shader: &Shader, kind: &str) -> Option<Input> {
    let [a, b] = network.inputs(shader, [("in1", 0.0), ("in2", 0.0)]);
    Some(dot(&mut network.graph, a, b, width(kind)))
}

pub(super) fn magnitude(network: &mut Network<'_>, shader: &Shader, kind: &str) -> Option<Input> {
    let [a] = network.inputs(shader, [("in", 0.0)]);
    let square = dot(&mut network.graph, a, a, width(kind));
    Some(unary(&mut network.graph, Operation::SquareRoot, square))
}

pub(super) fn distance(network: &mut Network<'_>, shader: &Shader, kind: &str) -> Option<Input> {
    let [a, b] = network.inputs(shader, [("in1", 0.0), ("in2", 0.0)]);
    let difference = subtract(&mut network.graph, a, b);
    let square = dot(&mut network.graph, difference, difference, width(kind));
    Some(unary(&mut network.graph, Operation::SquareRoot, square))
}

pub(super) fn normalize(network: &mut Network<'_>, shader: &Shader, kind: &str) -> Option<Input> {
    let [a] = network.inputs(shader, [("in", 0.0)]);
    let graph = &mut network.graph;
    if width(kind) == 3 {
        return Some(unary(graph, Operation::Normalize, a));
    }
    let square = dot(graph, a, a, width(kind));
    let length = unary(graph, Operation::SquareRoot, square);
    Some(divide(graph, a, length))
}

pub(super) fn reflect(network: &mut Network<'_>, shader: &Shader, _: &str) -> Option<Input> {
    let [incoming] = network.inputs(shader, [("in", 0.0)]);
    let normal = network.geometric_input(shader, "normal", "Nworld");
    let graph = &mut network.graph;
    let cosine = dot(graph, normal, incoming, 3);
    let twice = multiply(graph, cosine, scalar(2.0));
    let taken = multiply(graph, normal, twice);
    Some(subtract(graph, incoming, taken))
}

/// A side of a choice: the whole condition where it is known, so that the other side is never built.
fn choose(network: &mut Network<'_>, shader: &Shader, condition: Input) -> Option<Input> {
    let yes = |network: &mut Network<'_>| network.input(shader, "in1").unwrap_or(scalar(default(&shader.id)[0]));
    let no = |network: &mut Network<'_>| network.input(shader, "in2").unwrap_or(scalar(default(&shader.id)[1]));
    let condition = component(condition, 0);
    match condition {
        Input::Constant([0.0, ..]) => Some(no(network)),
        Input::Constant(_) => Some(yes(network)),
        Input::Node(..) => {
            let (yes, no) = (yes(network), no(network));
            Some(mix(&mut network.graph, no, yes, condition))
        }
    }
}

/// What the sides are where nothing is said: comparisons that give a flag have no sides.
fn default(id: &str) -> [f32; 2] {
    if id.contains("_boolean") { [1.0, 0.0] } else { [0.0, 0.0] }
}

/// A node that chooses between two inputs by comparing numbers.
pub(super) fn if_compared(network: &mut Network<'_>, shader: &Shader, _: &str) -> Option<Input> {
    let condition = condition(network, shader)?;
    choose(network, shader, condition)
}

/// 1 where such a node takes its first input, else 0; `None` for other nodes.
pub(super) fn condition(network: &mut Network<'_>, shader: &Shader) -> Option<Input> {
    let node = super::split(&shader.id).0;
    let [a, b] = network.inputs(shader, [("value1", if node == "ifequal" { 0.0 } else { 1.0 }), ("value2", 0.0)]);
    let graph = &mut network.graph;
    Some(match node {
        "ifgreater" => less(graph, b, a),
        "ifgreatereq" => {
            let below = less(graph, a, b);
            rest(graph, below)
        }
        "ifequal" => equal(graph, a, b),
        _ => return None,
    })
}

/// 1 where two numbers are the same, else 0.
pub(super) fn equal(graph: &mut Graph, a: Input, b: Input) -> Input {
    let (below, above) = (less(graph, a, b), less(graph, b, a));
    let other = add(graph, below, above);
    rest(graph, other)
}

/// The input of the number that `which` begins with; the first two only where nothing is said of the others.
pub(super) fn switch(network: &mut Network<'_>, shader: &Shader, _: &str) -> Option<Input> {
    const NAMES: [&str; 10] = ["in1", "in2", "in3", "in4", "in5", "in6", "in7", "in8", "in9", "in10"];
    let [which] = network.inputs(shader, [("which", 0.0)]);
    if let Input::Constant([which, ..]) = which {
        let name = NAMES.get(which.max(0.0) as usize);
        return Some(name.and_then(|name| network.input(shader, name)).unwrap_or(scalar(0.0)));
    }
    let mut chosen = scalar(0.0);
    for (index, name) in NAMES.iter().enumerate().rev() {
        let side = network.input(shader, name).unwrap_or(scalar(0.0));
        let graph = &mut network.graph;
        let is_below = less(graph, component(which, 0), scalar(index as f32 + 1.0));
        chosen = mix(graph, chosen, side, is_below);
    }
    Some(chosen)
}

pub(super) fn and(graph: &mut Graph, inputs: &[Input]) -> Input {
    multiply(graph, inputs[0], inputs[1])
}

pub(super) fn or(graph: &mut Graph, inputs: &[Input]) -> Input {
    binary(graph, Operation::Maximum, inputs[0], inputs[1])
}

pub(super) fn xor(graph: &mut Graph, inputs: &[Input]) -> Input {
    let difference = subtract(graph, inputs[0], inputs[1]);
    unary(graph, Operation::Absolute, difference)
}

pub(super) fn not(graph: &mut Graph, inputs: &[Input]) -> Input {
    rest(graph, inputs[0])
}

/// From 0 up to a half and down again over each unit, the same on both sides of zero.
pub(super) fn triangle_wave(graph: &mut Graph, inputs: &[Input]) -> Input {
    let magnitude = unary(graph, Operation::Absolute, inputs[0]);
    let part = fract(graph, &[magnitude]);
    let centred = subtract(graph, part, scalar(0.5));
    let distance = unary(graph, Operation::Absolute, centred);
    subtract(graph, scalar(0.5), distance)
}

/// An operation of the engine as it stands.
macro_rules! plain {
    ($($name:ident $operation:ident),* $(,)?) => {
        $(pub(super) fn $name(graph: &mut Graph, inputs: &[Input]) -> Input {
            apply(graph, Operation::$operation, inputs)
        })*
    };
}
plain!(absolute Absolute, arc_cosine ArcCosine, arc_sine ArcSine, arc_tangent ArcTangent2, clamp Clamp, cosine Cosine, cross Cross,
    exponential Exponential, floor Floor, invert Invert, logarithm Logarithm, maximum Maximum, minimum Minimum, sign Sign, sine Sine,
    square_root SquareRoot, to_hsv RgbToHsv, to_rgb HsvToRgb);
