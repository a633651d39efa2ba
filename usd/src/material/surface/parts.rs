//! What surfaces are put together from.

use crate::material::emit::{colour, constant_scalar, is_constant, multiply, scalar, subtract};
use crate::material::network::Network;
use crate::material::varying::cut_out;
use gonio::scene::{Closure, Input, Model};

/// A surface that only shines.
pub(super) fn shining(radiance: Input) -> Closure {
    let mut closure = Closure { model: Model::OpenPbr, ..Closure::default() };
    closure.set_input("base_color", colour([0.0; 3]));
    closure.set("specular_weight", 0.0);
    closure.set_input("emission_color", radiance);
    closure
}

/// Light that goes straight through.
pub(in crate::material) fn straight(weight: Input) -> Closure {
    let mut closure = Closure { model: Model::Transparent, weight, ..Closure::default() };
    closure.set_input("base_color", colour([1.0; 3]));
    closure
}

/// Multiplies what closures scatter and emit.
pub(super) fn weighted(network: &mut Network<'_>, mut closures: Vec<Closure>, weight: Input) -> Vec<Closure> {
    for closure in &mut closures {
        closure.weight = multiply(&mut network.graph, closure.weight, weight);
    }
    closures.retain(|closure| !is_constant(closure.weight, 0.0));
    closures
}

/// Opacity, all or nothing where there is a threshold.
pub(super) fn cut_by(network: &mut Network<'_>, closure: &mut Closure, opacity: Input, threshold: Input) {
    match constant_scalar(threshold) {
        Some(threshold) => {
            closure.opacity_threshold = threshold.clamp(0.0, 1.0);
            closure.set_input("geometry_opacity", opacity);
        }
        None => closure.set_input("geometry_opacity", cut_out(&mut network.graph, opacity, threshold)),
    }
}

/// Closures of which only a share is there; through the rest light goes straight.
pub(super) fn with_opacity(network: &mut Network<'_>, closures: Vec<Closure>, opacity: Input) -> Vec<Closure> {
    if is_constant(opacity, 1.0) {
        return closures;
    }
    let open = subtract(&mut network.graph, scalar(1.0), opacity);
    let mut closures = weighted(network, closures, opacity);
    closures.push(straight(open));
    closures
}
