//! MaterialX's hair distribution as a closure.

use super::lobes::direction;
use crate::material::emit::{combine, component, multiply, scalar, subtract};
use crate::material::network::{Network, Shader};
use gonio::scene::{Closure, Model};

/// The closure of `ND_chiang_hair_bsdf`.
pub(super) fn chiang(network: &mut Network<'_>, shader: &Shader) -> Closure {
    let mut closure = Closure { model: Model::Hair, ..Closure::default() };
    closure.set_input("hair_absorption", network.colour(shader, "absorption_coefficient", [0.0; 3]));
    closure.set_input("specular_ior", network.scalar(shader, "ior", 1.55));
    for (parameter, name) in [("hair_tint_r", "tint_R"), ("hair_tint_tt", "tint_TT"), ("hair_tint_trt", "tint_TRT")] {
        closure.set_input(parameter, network.colour(shader, name, [1.0; 3]));
    }
    let usual = [("roughness_R", [0.1, 0.1]), ("roughness_TT", [0.05, 0.05]), ("roughness_TRT", [0.2, 0.2])];
    let widths = usual.map(|(name, [along, about])| network.colour(shader, name, [along, about, 0.0]));
    for (place, parameter) in ["hair_variance", "hair_scale"].into_iter().enumerate() {
        let parts = widths.map(|pair| component(pair, place));
        closure.set_input(parameter, combine(&mut network.graph, &parts));
    }
    // From 0 to 1: half a turn, even scales in the middle.
    let angle = network.scalar(shader, "cuticle_angle", 0.5);
    let graph = &mut network.graph;
    let middle = subtract(graph, angle, scalar(0.5));
    let tilt = multiply(graph, middle, scalar(std::f32::consts::PI));
    closure.set_input("hair_tilt", component(tilt, 0));
    closure.tangent = direction(network, shader, "curve_direction");
    closure
}
