//! What layers take of the light to the viewer, so that what lies under them gets the rest.

use crate::material::emit::{add, binary, clamp, component, divide, multiply, rest, scalar, subtract, unary};
use crate::material::network::{Network, Shader};
use gonio::scene::{Channel, Closure, Graph, Input, Operation};

/// The cosine between the viewer and a closure's normal.
fn cosine(network: &mut Network<'_>, closure: &Closure) -> Input {
    let incoming = network.node(Operation::Incoming, vec![]);
    let normal = match closure.normal {
        Some(normal) => Input::Node(normal, Channel::Rgb),
        None => network.node(Operation::Normal, vec![]),
    };
    component(network.node(Operation::Dot, vec![incoming, normal]), 0)
}

/// What a smooth interface reflects of the light to the viewer.
pub(super) fn dielectric_albedo(network: &mut Network<'_>, closure: &Closure) -> Input {
    let cosine = cosine(network, closure);
    let ior = closure.input("specular_ior").unwrap_or(scalar(1.5));
    component(network.node(Operation::Fresnel, vec![cosine, ior]), 0)
}

/// The mean of a colour's components.
pub(super) fn mean(graph: &mut Graph, colour: Input) -> Input {
    let sum = binary(graph, Operation::Dot, colour, scalar(1.0));
    component(multiply(graph, sum, scalar(1.0 / 3.0)), 0)
}

/// The mean of the components of Schlick's curve at the viewer's angle.
pub(super) fn schlick_albedo(network: &mut Network<'_>, shader: &Shader, closure: &Closure) -> Input {
    let colours = [network.colour(shader, "color0", [1.0; 3]), network.colour(shader, "color90", [1.0; 3])];
    let cosine = cosine(network, closure);
    let graph = &mut network.graph;
    let [low, high] = colours.map(|colour| mean(graph, colour));
    let magnitude = unary(graph, Operation::Absolute, cosine);
    let lack = rest(graph, magnitude);
    let square = multiply(graph, lack, lack);
    let fourth = multiply(graph, square, square);
    let fifth = multiply(graph, fourth, lack);
    let spread = subtract(graph, high, low);
    let rise = multiply(graph, spread, fifth);
    add(graph, low, rise)
}

/// What fuzz takes at the viewer's angle, by the rational fit of MaterialX's library to Estevez and Kulla's sheen.
pub(super) fn sheen_albedo(network: &mut Network<'_>, closure: &Closure) -> Input {
    const FIT: [[f32; 6]; 2] = [
        [13.673, -68.780_18, 799.088_25, -905.000_6, 60.289_56, 1_086.964_7],
        [1.0, 61.577_46, 442.782_1, 2_597.493, 121.812_41, 3_045.550_8],
    ];
    let cosine = cosine(network, closure);
    let roughness = closure.input("fuzz_roughness").unwrap_or(scalar(0.3));
    let graph = &mut network.graph;
    let x = unary(graph, Operation::Absolute, cosine);
    let y = component(clamp(graph, roughness, scalar(0.07), scalar(1.0)), 0);
    let terms = [x, y, multiply(graph, x, y), multiply(graph, x, x), multiply(graph, y, y)];
    let [over, under] = FIT.map(|[constant, factors @ ..]| {
        let mut sum = scalar(constant);
        for (term, factor) in terms.iter().zip(factors) {
            let part = multiply(graph, *term, scalar(factor));
            sum = add(graph, sum, part);
        }
        sum
    });
    let ratio = divide(graph, over, under);
    component(clamp(graph, ratio, scalar(0.0), scalar(1.0)), 0)
}
