//! Ramps and splits over texture coordinates.

use super::super::emit::{add, clamp, component, mix, scalar, subtract, unary};
use super::super::network::{Network, Shader};
use super::adjust::smoothstep;
use gonio::scene::{Input, Operation};

/// Half the width of an edge, in the changes of its value to the next pixels.
const EDGE: f32 = std::f32::consts::FRAC_1_SQRT_2;

pub(super) fn ramp_lr(network: &mut Network<'_>, shader: &Shader, _: &str) -> Option<Input> {
    let [left, right] = network.inputs(shader, [("valuel", 0.0), ("valuer", 0.0)]);
    let share = held(network, shader, 0);
    Some(mix(&mut network.graph, left, right, share))
}

pub(super) fn ramp_tb(network: &mut Network<'_>, shader: &Shader, _: &str) -> Option<Input> {
    let [top, bottom] = network.inputs(shader, [("valuet", 0.0), ("valueb", 0.0)]);
    let share = held(network, shader, 1);
    Some(mix(&mut network.graph, bottom, top, share))
}

pub(super) fn ramp_4(network: &mut Network<'_>, shader: &Shader, _: &str) -> Option<Input> {
    let names = [("valuetl", 0.0), ("valuetr", 0.0), ("valuebl", 0.0), ("valuebr", 0.0)];
    let [top_left, top_right, bottom_left, bottom_right] = network.inputs(shader, names);
    let (s, t) = (held(network, shader, 0), held(network, shader, 1));
    let graph = &mut network.graph;
    let top = mix(graph, top_left, top_right, s);
    let bottom = mix(graph, bottom_left, bottom_right, s);
    Some(mix(graph, bottom, top, t))
}

/// One of the coordinates between 0 and 1.
fn held(network: &mut Network<'_>, shader: &Shader, axis: usize) -> Input {
    let coordinates = network.geometric_input(shader, "texcoord", "UV0");
    clamp(&mut network.graph, component(coordinates, axis), scalar(0.0), scalar(1.0))
}

pub(super) fn split_lr(network: &mut Network<'_>, shader: &Shader, _: &str) -> Option<Input> {
    let [left, right] = network.inputs(shader, [("valuel", 0.0), ("valuer", 0.0)]);
    let share = step(network, shader, 0);
    Some(mix(&mut network.graph, left, right, share))
}

pub(super) fn split_tb(network: &mut Network<'_>, shader: &Shader, _: &str) -> Option<Input> {
    let [top, bottom] = network.inputs(shader, [("valuet", 0.0), ("valueb", 0.0)]);
    let share = step(network, shader, 1);
    Some(mix(&mut network.graph, bottom, top, share))
}

/// 0 before the centre, 1 behind it, smooth over the pixels between.
fn step(network: &mut Network<'_>, shader: &Shader, axis: usize) -> Input {
    let [centre] = network.inputs(shader, [("center", 0.5)]);
    let here = network.geometric_input(shader, "texcoord", "UV0");
    let mut squares = scalar(0.0);
    for direction in 0..2 {
        let there = network.beside(direction, |network| network.geometric_input(shader, "texcoord", "UV0"));
        let graph = &mut network.graph;
        let change = subtract(graph, component(there, axis), component(here, axis));
        let square = super::math::and(graph, &[change, change]);
        squares = add(graph, squares, square);
    }
    let graph = &mut network.graph;
    let length = unary(graph, Operation::SquareRoot, squares);
    let width = super::math::and(graph, &[length, scalar(EDGE)]);
    let (low, high) = (subtract(graph, centre, width), add(graph, centre, width));
    smoothstep(graph, &[component(here, axis), component(low, 0), component(high, 0)])
}
