//! Coordinates turned, scaled and moved.

use super::super::emit::{add, component, divide, multiply, scalar, subtract, unary};
use super::super::network::{Network, Shader};
use super::super::varying::turned;
use super::math::dot;
use gonio::scene::{Input, Operation};

pub(super) fn transformed(network: &mut Network<'_>, input: Input, scale: [f32; 2], rotation_deg: f32, translation: [f32; 2]) -> Input {
    network.node(Operation::Transform2d { scale, rotation_deg, translation }, vec![input])
}

pub(super) fn rotate_2d(network: &mut Network<'_>, shader: &Shader, _: &str) -> Option<Input> {
    let [input, amount] = network.inputs(shader, [("in", 0.0), ("amount", 0.0)]);
    Some(match (input, amount) {
        (Input::Node(..), Input::Constant([degrees, ..])) => transformed(network, input, [1.0; 2], -degrees, [0.0; 2]),
        _ => turned(&mut network.graph, input, amount),
    })
}

/// About an axis by degrees, to the left seen along it (Rodrigues' formula).
pub(super) fn rotate_3d(network: &mut Network<'_>, shader: &Shader, _: &str) -> Option<Input> {
    let [input, amount] = network.inputs(shader, [("in", 0.0), ("amount", 0.0)]);
    let axis = network.input(shader, "axis").unwrap_or(Input::Constant([0.0, 1.0, 0.0, 1.0]));
    let graph = &mut network.graph;
    let axis = unary(graph, Operation::Normalize, axis);
    let angle = multiply(graph, component(amount, 0), scalar(1.0_f32.to_radians()));
    let (sin, cos) = (unary(graph, Operation::Sine, angle), unary(graph, Operation::Cosine, angle));
    let cross = super::math::cross(graph, &[input, axis]);
    let along = dot(graph, axis, input, 3);
    let open = subtract(graph, scalar(1.0), cos);
    let share = multiply(graph, along, open);
    let parts = [multiply(graph, input, cos), multiply(graph, cross, sin), multiply(graph, axis, share)];
    let sum = add(graph, parts[0], parts[1]);
    Some(add(graph, sum, parts[2]))
}

/// About a pivot: scaled, turned, moved, or the other way round. It turns the other way than `Transform2d` and divides by its scale.
pub(super) fn place_2d(network: &mut Network<'_>, shader: &Shader, _: &str) -> Option<Input> {
    let coordinates = match network.input(shader, "texcoord") {
        Some(input) => input,
        None => network.texture_coordinates(0),
    };
    let [pivot, scale, rotate, offset] = network.inputs(shader, [("pivot", 0.0), ("scale", 1.0), ("rotate", 0.0), ("offset", 0.0)]);
    let is_reversed = network.number(shader, "operationorder", 0.0) != 0.0;
    if let (Input::Node(..), Input::Constant(pivot), Input::Constant(scale), Input::Constant(turn), Input::Constant(offset)) =
        (coordinates, pivot, scale, rotate, offset)
    {
        let pair = |[x, y, ..]: [f32; 4]| [x, y];
        return Some(place_constant(network, coordinates, pair(pivot), pair(scale), -turn[0], pair(offset), is_reversed));
    }
    let graph = &mut network.graph;
    let centred = subtract(graph, coordinates, pivot);
    let placed = if is_reversed {
        let moved = subtract(graph, centred, offset);
        let turned = turned(graph, moved, rotate);
        divide(graph, turned, scale)
    } else {
        let scaled = divide(graph, centred, scale);
        let turned = turned(graph, scaled, rotate);
        subtract(graph, turned, offset)
    };
    Some(add(graph, placed, pivot))
}

fn place_constant(
    network: &mut Network<'_>,
    coordinates: Input,
    pivot: [f32; 2],
    scale: [f32; 2],
    turn: f32,
    offset: [f32; 2],
    is_reversed: bool,
) -> Input {
    let inverse = scale.map(|s| if s == 0.0 { 0.0 } else { s.recip() });
    if !is_reversed {
        let [x, y] = rotated([-pivot[0] * inverse[0], -pivot[1] * inverse[1]], turn);
        return transformed(network, coordinates, inverse, turn, [x - offset[0] + pivot[0], y - offset[1] + pivot[1]]);
    }
    let moved = rotated([-pivot[0] - offset[0], -pivot[1] - offset[1]], turn);
    let turned = transformed(network, coordinates, [1.0; 2], turn, moved);
    transformed(network, turned, inverse, 0.0, pivot)
}

fn rotated([x, y]: [f32; 2], degrees: f32) -> [f32; 2] {
    let (sin, cos) = degrees.to_radians().sin_cos();
    [x * cos - y * sin, x * sin + y * cos]
}
