//! Normal maps, and normals of heights.

use super::super::emit::{add, apply, combine, component, is_constant, less, mix, multiply, scalar, subtract, unary};
use super::super::network::{Network, Shader};
use super::super::neutral::Source;
use super::math::dot;
use gonio::scene::{Channel, Graph, Input, NodeId, Operation, Quantity, Space};

/// By this much heights are lowered, so that they are those of the filter of older versions.
const HEIGHT_SCALE: f32 = 1.0 / 16.0;

/// A normal of the world from one in the tangents' space, coded between 0 and 1.
pub(super) fn normal_map(network: &mut Network<'_>, shader: &Shader, _: &str) -> Option<Input> {
    let input = network.input(shader, "in")?;
    let signed = signed(&mut network.graph, input);
    if is_constant(signed, 0.0) {
        return None;
    }
    if network.text(shader, "space").as_deref() == Some("object") {
        return Some(network.carried(signed, Space::Object, Space::World, Quantity::Normal));
    }
    let [scale] = network.inputs(shader, [("scale", 1.0)]);
    let named = ["normal", "tangent", "bitangent"].map(|name| match network.source(shader, name) {
        Source::Nothing => false,
        Source::Geometric(property) => !property.ends_with("world"),
        _ => true,
    });
    if named != [false; 3] {
        return Some(in_frame(network, shader, signed, scale));
    }
    match scale {
        Input::Constant([x, y, ..]) if x == y => Some(network.node(Operation::NormalMap { scale: x, uv: None }, vec![signed])),
        _ => {
            let graph = &mut network.graph;
            let factors = combine(graph, &[component(scale, 0), component(scale, 1), scalar(1.0)]);
            let scaled = multiply(graph, signed, factors);
            Some(network.node(Operation::NormalMap { scale: 1.0, uv: None }, vec![scaled]))
        }
    }
}

/// A coded normal along directions that the node names.
fn in_frame(network: &mut Network<'_>, shader: &Shader, signed: Input, scale: Input) -> Input {
    let normal = network.geometric_input(shader, "normal", "Nworld");
    let tangent = network.geometric_input(shader, "tangent", "Tworld");
    let bitangent = match network.input(shader, "bitangent") {
        Some(bitangent) => bitangent,
        None => network.node(Operation::Cross, vec![normal, tangent]),
    };
    let graph = &mut network.graph;
    let (x, y) = (multiply(graph, component(signed, 0), component(scale, 0)), multiply(graph, component(signed, 1), component(scale, 1)));
    let parts = [multiply(graph, tangent, x), multiply(graph, bitangent, y), multiply(graph, normal, component(signed, 2))];
    let sum = add(graph, parts[0], parts[1]);
    let sum = add(graph, sum, parts[2]);
    apply(graph, Operation::Normalize, &[sum])
}

/// `2 x - 1`, folded into the image that `x` comes from.
fn signed(graph: &mut Graph, input: Input) -> Input {
    if let Input::Node(NodeId(index), Channel::Rgb) = input
        && let Some(node) = graph.nodes.get(usize::from(index))
        && let Operation::Image { texture, wrap, filter, scale, bias, fallback } = &node.operation
    {
        let operation = Operation::Image {
            texture: *texture,
            wrap: *wrap,
            filter: *filter,
            scale: scale.map(|s| 2.0 * s),
            bias: bias.map(|b| 2.0 * b - 1.0),
            fallback: fallback.map(|f| 2.0 * f - 1.0),
        };
        let inputs = node.inputs.clone();
        return Input::Node(graph.add(operation, inputs), Channel::Rgb);
    }
    let doubled = multiply(graph, input, scalar(2.0));
    subtract(graph, doubled, scalar(1.0))
}

/// The coded normal of a height over texture coordinates, by its changes to the next pixels.
pub(super) fn height_to_normal(network: &mut Network<'_>, shader: &Shader, _: &str) -> Option<Input> {
    let places = |network: &mut Network<'_>| {
        let height = network.input(shader, "in").unwrap_or(scalar(0.0));
        (component(height, 0), network.geometric_input(shader, "texcoord", "UV0"))
    };
    let [scale] = network.inputs(shader, [("scale", 1.0)]);
    let (height, coordinates) = places(network);
    let scale = multiply(&mut network.graph, component(scale, 0), scalar(HEIGHT_SCALE));
    let edges = [0, 1].map(|axis| {
        let (there_height, there) = network.beside(axis, places);
        let graph = &mut network.graph;
        let rise = subtract(graph, there_height, height);
        let rise = multiply(graph, rise, scale);
        let run = subtract(graph, there, coordinates);
        combine(graph, &[component(run, 0), component(run, 1), rise])
    });
    let graph = &mut network.graph;
    let cross = apply(graph, Operation::Cross, &edges);
    let normal = unary(graph, Operation::Normalize, cross);
    // The side of the surface is the one that coordinates are seen from; without any change the normal stays.
    let is_below = less(graph, component(normal, 2), scalar(0.0));
    let turned = multiply(graph, normal, scalar(-1.0));
    let facing = mix(graph, normal, turned, is_below);
    let square = dot(graph, facing, facing, 3);
    let is_flat = less(graph, square, scalar(0.5));
    let normal = mix(graph, facing, Input::Constant([0.0, 0.0, 1.0, 0.0]), is_flat);
    let halved = multiply(graph, normal, scalar(0.5));
    Some(add(graph, halved, scalar(0.5)))
}
