//! Arnold's shaders as they stand in USD, `arnold:image`: images, normal maps, arithmetic and primvars.

use super::arnold_math;
use super::emit::{binary, combine, component, mix, scalar};
use super::network::{Network, Shader};
use super::varying::{Image, bent, placed, primvar};
use gonio::scene::{Input, Operation, WrapMode};

/// The component that an output stands for: `r`, or `out:r`.
pub(in crate::material) fn output_component(id: &str, output: &str) -> Option<usize> {
    let name = output.rsplit(':').next().filter(|_| id.starts_with("arnold:"))?;
    ["r", "g", "b", "a"].iter().position(|known| *known == name).or_else(|| ["x", "y", "z"].iter().position(|known| *known == name))
}

/// Builds a node; `None` where it is not supported.
pub(in crate::material) fn build(network: &mut Network<'_>, shader: &Shader, node: &str) -> Option<Input> {
    let operation = match node {
        "image" => return Some(image(network, shader)),
        "normal_map" => return normal_map(network, shader),
        "flat" => return Some(network.input(shader, "color").unwrap_or(scalar(1.0))),
        "mix_rgba" => {
            let [a, b] = ["input1", "input2"].map(|name| network.input(shader, name).unwrap_or(scalar(0.0)));
            let share = network.scalar(shader, "mix", 0.5);
            return Some(mix(&mut network.graph, a, b, share));
        }
        "user_data_rgb" | "user_data_rgba" | "user_data_float" | "user_data_int" => {
            let fallback = network.input(shader, "default").unwrap_or(Input::Constant([0.0, 0.0, 0.0, 1.0]));
            let name = network.text(shader, "attribute").filter(|name| !name.is_empty())?;
            return Some(primvar(&mut network.graph, name, fallback));
        }
        "add" => (Operation::Add, 0.0),
        "subtract" => (Operation::Subtract, 0.0),
        "multiply" => (Operation::Multiply, 1.0),
        "divide" => (Operation::Divide, 1.0),
        _ => return arnold_math::build(network, shader, node),
    };
    let [a, b] = ["input1", "input2"].map(|name| network.input(shader, name).unwrap_or(scalar(operation.1)));
    Some(binary(&mut network.graph, operation.0, a, b))
}

fn image(network: &mut Network<'_>, shader: &Shader) -> Input {
    let fallback = network.input(shader, "missing_texture_color").unwrap_or(Input::Constant([0.0, 0.0, 0.0, 1.0]));
    let space = network.text(shader, "color_space").filter(|space| !space.is_empty());
    let Some(texture) = network.texture_of(shader, "filename", space.as_deref(), "auto") else { return fallback };
    let wrap = ["swrap", "twrap"].map(|name| match network.text(shader, name).as_deref() {
        Some("clamp") => WrapMode::Clamp,
        Some("mirror") => WrapMode::Mirror,
        Some("black") => WrapMode::Black,
        _ => WrapMode::Repeat,
    });
    let set = network.text(shader, "uvset").filter(|set| !set.is_empty()).unwrap_or_else(|| "st".to_owned());
    let mut place = |names: [&str; 2], default: f32| {
        let parts = names.map(|name| network.scalar(shader, name, default));
        combine(&mut network.graph, &parts)
    };
    let (scale, translation) = (place(["sscale", "tscale"], 1.0), place(["soffset", "toffset"], 0.0));
    let mut coordinates = match network.input(shader, "uvcoords") {
        Some(coordinates @ Input::Node(..)) => coordinates,
        _ => network.node(Operation::Primvar { name: set, fallback: [0.0; 4] }, vec![]),
    };
    let is_as_it_lies = matches!((scale, translation), (Input::Constant([1.0, 1.0, ..]), Input::Constant([0.0, 0.0, ..])));
    if !is_as_it_lies {
        coordinates = placed(&mut network.graph, coordinates, scale, scalar(0.0), translation);
    }
    let [scale, bias] = [("multiply", 1.0, 1.0), ("offset", 0.0, 0.0)].map(|(name, default, alpha)| {
        let tint = network.colour(shader, name, [default; 3]);
        let parts = [component(tint, 0), component(tint, 1), component(tint, 2), scalar(alpha)];
        combine(&mut network.graph, &parts)
    });
    Image { scale, bias, ..Image::plain(texture, wrap, fallback) }.at(&mut network.graph, coordinates)
}

fn normal_map(network: &mut Network<'_>, shader: &Shader) -> Option<Input> {
    let mut input = network.input(shader, "input")?;
    if network.number(shader, "color_to_signed", 1.0) != 0.0 {
        let doubled = binary(&mut network.graph, Operation::Multiply, input, scalar(2.0));
        input = binary(&mut network.graph, Operation::Subtract, doubled, scalar(1.0));
    }
    let strength = network.scalar(shader, "strength", 1.0);
    Some(bent(&mut network.graph, input, strength))
}
