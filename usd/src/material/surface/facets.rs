//! Widths of facets and films as MaterialX states them, in the parameters of the surface block.

use crate::material::emit::{add, binary, component, constant_scalar, divide, is_constant, multiply, rest, scalar, unary};
use crate::material::network::{Network, Shader};
use gonio::scene::{Closure, Operation};

/// How a model makes two widths of a roughness and an anisotropy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Widths {
    /// r² √(2 / (1 + q²)) and q times it, q = 1 − k.
    OpenPbr,
    /// r² / A and r² A, A = √(1 − 0.9 k).
    Principled,
}

/// Sets roughness and anisotropy from the widths along and across the tangent.
pub(super) fn facets(network: &mut Network<'_>, shader: &Shader, closure: &mut Closure, model: Widths) {
    let widths = network.input(shader, "roughness").unwrap_or(scalar(0.05));
    let (mut along, mut across) = (component(widths, 0), component(widths, 1));
    if along == across {
        closure.set_input("specular_roughness", unary(&mut network.graph, Operation::SquareRoot, along));
        return;
    }
    // The larger width lies along the tangent.
    if let (Some(x), Some(y)) = (constant_scalar(along), constant_scalar(across))
        && y > x
    {
        (along, across) = (across, along);
        closure.set("specular_rotation", 0.25);
    }
    let graph = &mut network.graph;
    let ratio = divide(graph, across, along);
    let ratio = binary(graph, Operation::Minimum, ratio, scalar(1.0));
    let stretch = rest(graph, ratio);
    let (square, anisotropy) = match model {
        Widths::OpenPbr => {
            let squared = multiply(graph, ratio, ratio);
            let sum = add(graph, squared, scalar(1.0));
            let half = multiply(graph, sum, scalar(0.5));
            let root = unary(graph, Operation::SquareRoot, half);
            (multiply(graph, along, root), stretch)
        }
        Widths::Principled => {
            let product = multiply(graph, along, across);
            let root = unary(graph, Operation::SquareRoot, product);
            let anisotropy = multiply(graph, stretch, scalar(1.0 / 0.9));
            (root, binary(graph, Operation::Minimum, anisotropy, scalar(1.0)))
        }
    };
    closure.set_input("specular_roughness", component(unary(graph, Operation::SquareRoot, square), 0));
    closure.set_input("specular_anisotropy", component(anisotropy, 0));
}

/// Sets the film over an interface, in nanometres.
pub(super) fn film(network: &mut Network<'_>, shader: &Shader, closure: &mut Closure) {
    let thickness = network.scalar(shader, "thinfilm_thickness", 0.0);
    if is_constant(thickness, 0.0) {
        return;
    }
    closure.set("thin_film_weight", 1.0);
    closure.set_input("thin_film_thickness", thickness);
    closure.set_input("thin_film_ior", network.scalar(shader, "thinfilm_ior", 1.5));
}
