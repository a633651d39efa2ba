//! MaterialX's noises.

use super::super::emit::{apply, binary, multiply};
use super::super::network::{Network, Shader};
use gonio::scene::{Input, Operation};
use gonio_nodes::{MxCellNoise, MxFractal, MxNoise, MxWorley, MxWorleyStyle};

/// How many components a type has.
fn channels(kind: &str) -> u8 {
    kind.bytes().find_map(|byte| byte.is_ascii_digit().then_some(byte - b'0')).unwrap_or(1).clamp(1, 4)
}

/// Where a noise of so many dimensions is taken: texture coordinates, or the place on the object.
fn place(network: &mut Network<'_>, shader: &Shader, dimensions: u8) -> Input {
    match dimensions {
        2 => network.geometric_input(shader, "texcoord", "UV0"),
        _ => network.geometric_input(shader, "position", "Pobject"),
    }
}

/// A value scaled by the amplitude about the pivot.
fn scaled(network: &mut Network<'_>, shader: &Shader, noise: Input) -> Input {
    let [amplitude, pivot] = network.inputs(shader, [("amplitude", 1.0), ("pivot", 0.0)]);
    let product = multiply(&mut network.graph, noise, amplitude);
    binary(&mut network.graph, Operation::Add, product, pivot)
}

fn noise(network: &mut Network<'_>, shader: &Shader, kind: &str, dimensions: u8) -> Option<Input> {
    let place = place(network, shader, dimensions);
    let operation = Operation::MxNoise(MxNoise { dimensions, channels: channels(kind) });
    let value = apply(&mut network.graph, operation, &[place]);
    Some(scaled(network, shader, spread(value, kind)))
}

pub(super) fn noise_2d(network: &mut Network<'_>, shader: &Shader, kind: &str) -> Option<Input> {
    noise(network, shader, kind, 2)
}

pub(super) fn noise_3d(network: &mut Network<'_>, shader: &Shader, kind: &str) -> Option<Input> {
    noise(network, shader, kind, 3)
}

fn fractal(network: &mut Network<'_>, shader: &Shader, kind: &str, dimensions: u8) -> Option<Input> {
    let place = place(network, shader, dimensions);
    let [octaves, lacunarity, diminish] = network.inputs(shader, [("octaves", 3.0), ("lacunarity", 2.0), ("diminish", 0.5)]);
    let operation = Operation::MxFractal(MxFractal { dimensions, channels: channels(kind) });
    let value = apply(&mut network.graph, operation, &[place, octaves, lacunarity, diminish]);
    let [amplitude] = network.inputs(shader, [("amplitude", 1.0)]);
    Some(multiply(&mut network.graph, spread(value, kind), amplitude))
}

pub(super) fn fractal_2d(network: &mut Network<'_>, shader: &Shader, kind: &str) -> Option<Input> {
    fractal(network, shader, kind, 2)
}

pub(super) fn fractal_3d(network: &mut Network<'_>, shader: &Shader, kind: &str) -> Option<Input> {
    fractal(network, shader, kind, 3)
}

fn cells(network: &mut Network<'_>, shader: &Shader, kind: &str, dimensions: u8) -> Option<Input> {
    let place = place(network, shader, dimensions);
    let channels = if channels(kind) > 1 { 3 } else { 1 };
    let value = apply(&mut network.graph, Operation::MxCellNoise(MxCellNoise { dimensions, channels }), &[place]);
    Some(spread(value, kind))
}

pub(super) fn cells_2d(network: &mut Network<'_>, shader: &Shader, kind: &str) -> Option<Input> {
    cells(network, shader, kind, 2)
}

pub(super) fn cells_3d(network: &mut Network<'_>, shader: &Shader, kind: &str) -> Option<Input> {
    cells(network, shader, kind, 3)
}

fn worley(network: &mut Network<'_>, shader: &Shader, kind: &str, dimensions: u8) -> Option<Input> {
    let place = place(network, shader, dimensions);
    let [jitter] = network.inputs(shader, [("jitter", 1.0)]);
    let style = if network.number(shader, "style", 0.0) == 0.0 { MxWorleyStyle::Distance } else { MxWorleyStyle::Solid };
    let operation = Operation::MxWorley(MxWorley { dimensions, channels: channels(kind).min(3), style });
    let value = apply(&mut network.graph, operation, &[place, jitter]);
    Some(spread(value, kind))
}

pub(super) fn worley_2d(network: &mut Network<'_>, shader: &Shader, kind: &str) -> Option<Input> {
    worley(network, shader, kind, 2)
}

pub(super) fn worley_3d(network: &mut Network<'_>, shader: &Shader, kind: &str) -> Option<Input> {
    worley(network, shader, kind, 3)
}

/// A number fills all components.
fn spread(value: Input, kind: &str) -> Input {
    if channels(kind) == 1 { super::super::emit::component(value, 0) } else { value }
}
