//! What shading of physically based surfaces is told: widths of facets, indices of metals, black bodies.

use super::super::emit::{add, binary, clamp, colour, combine, component, divide, less, mix, multiply, rest, scalar, subtract, unary};
use super::super::network::{Network, Shader};
use super::math::dot;
use gonio::scene::{Graph, Input, Operation};

/// The narrowest width of facets.
const NARROWEST: f32 = 1e-8;

/// Widths along and across from a roughness and an anisotropy.
pub(super) fn roughness_anisotropy(graph: &mut Graph, inputs: &[Input]) -> Input {
    let square = multiply(graph, inputs[0], inputs[0]);
    let width = clamp(graph, square, scalar(NARROWEST), scalar(1.0));
    let stretched = clamp(graph, inputs[1], scalar(0.0), scalar(0.98));
    let open = rest(graph, stretched);
    let aspect = unary(graph, Operation::SquareRoot, open);
    let along = divide(graph, width, aspect);
    let along = binary(graph, Operation::Minimum, along, scalar(1.0));
    let across = multiply(graph, width, aspect);
    combine(graph, &[component(along, 0), component(across, 0)])
}

/// Widths along and across from two roughnesses; a negative second one is as the first.
pub(super) fn roughness_dual(graph: &mut Graph, inputs: &[Input]) -> Input {
    let (x, y) = (component(inputs[0], 0), component(inputs[0], 1));
    let is_same = less(graph, y, scalar(0.0));
    let y = mix(graph, y, x, is_same);
    let widths = [x, y].map(|roughness| {
        let square = multiply(graph, roughness, roughness);
        component(clamp(graph, square, scalar(NARROWEST), scalar(1.0)), 0)
    });
    combine(graph, &widths)
}

/// Index and extinction of a metal from its colours (Gulbrandsen, Artist Friendly Metallic Fresnel, JCGT 2014).
pub(super) fn artistic_ior(network: &mut Network<'_>, shader: &Shader, output: &str) -> Option<Input> {
    let reflectivity = network.colour(shader, "reflectivity", [0.944, 0.776, 0.373]);
    let edge = network.colour(shader, "edge_color", [0.998, 0.981, 0.751]);
    let graph = &mut network.graph;
    let r = clamp(graph, reflectivity, scalar(0.0), scalar(0.99));
    let root = unary(graph, Operation::SquareRoot, r);
    let (one_less, one_more) = (rest(graph, r), add(graph, r, scalar(1.0)));
    let least = divide(graph, one_less, one_more);
    let (root_less, root_more) = (rest(graph, root), add(graph, root, scalar(1.0)));
    let most = divide(graph, root_more, root_less);
    let ior = mix(graph, most, least, edge);
    if output != "extinction" {
        return Some(ior);
    }
    let (more, less_one) = (add(graph, ior, scalar(1.0)), subtract(graph, ior, scalar(1.0)));
    let (more, less_one) = (multiply(graph, more, more), multiply(graph, less_one, less_one));
    let kept = multiply(graph, more, r);
    let square = subtract(graph, kept, less_one);
    let square = divide(graph, square, one_less);
    Some(unary(graph, Operation::SquareRoot, square))
}

/// The colour of a black body between 800 K and 25,000 K, of luminance 1 (Kang and others, 2002, by powers of the inverse temperature).
pub(super) fn blackbody(network: &mut Network<'_>, shader: &Shader, _: &str) -> Option<Input> {
    let [temperature] = network.inputs(shader, [("temperature", 5000.0)]);
    let graph = &mut network.graph;
    let kelvin = clamp(graph, component(temperature, 0), scalar(800.0), scalar(25_000.0));
    let t = divide(graph, scalar(1000.0), kelvin);
    let warm = polynomial(graph, t, [-0.266_123_9, -0.234_358, 0.877_695_6, 0.179_910]);
    let cold = polynomial(graph, t, [-3.025_847, 2.107_037_9, 0.222_634_7, 0.240_390]);
    let is_warm = less(graph, kelvin, scalar(4000.0));
    let x = mix(graph, cold, warm, is_warm);
    let red = polynomial(graph, x, [-1.106_381_4, -1.348_110_2, 2.185_558_3, -0.202_196_83]);
    let yellow = polynomial(graph, x, [-0.954_947_6, -1.374_185_9, 2.091_37, -0.167_488_67]);
    let blue = polynomial(graph, x, [3.081_758, -5.873_387, 3.751_13, -0.370_014_83]);
    let is_red = less(graph, kelvin, scalar(2222.0));
    let y = mix(graph, blue, yellow, is_warm);
    let y = mix(graph, y, red, is_red);
    let sum = add(graph, x, y);
    let z = rest(graph, sum);
    let (x, z) = (divide(graph, x, y), divide(graph, z, y));
    let xyz = combine(graph, &[component(x, 0), scalar(1.0), component(z, 0)]);
    let rows = [[3.2406, -1.5372, -0.4986], [-0.9689, 1.8758, 0.0415], [0.0557, -0.2040, 1.0570]];
    let parts = rows.map(|row| {
        let part = dot(graph, xyz, colour(row), 3);
        component(binary(graph, Operation::Maximum, part, scalar(0.0)), 0)
    });
    Some(combine(graph, &parts))
}

/// A cubic, the highest power first.
fn polynomial(graph: &mut Graph, x: Input, [a, b, c, d]: [f32; 4]) -> Input {
    let mut sum = scalar(a);
    for coefficient in [b, c, d] {
        let product = multiply(graph, sum, x);
        sum = add(graph, product, scalar(coefficient));
    }
    component(sum, 0)
}
