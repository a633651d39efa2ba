//! `gonio:MeasuredBSDF`: a measured material by asset path.
//!
//! Inputs: `file` (asset), `tint` (color3f, white), `scale` (float, 1), `rotation` (float, degrees of the tangent about the normal, 0) and
//! `normal` (a tangent-space normal).

use crate::material::emit::{binary, constant_scalar, scalar};
use crate::material::network::{Network, Shader};
use crate::material::neutral::{Source, Value};
use crate::material::usd_nodes::tangent_normal;
use gonio::scene::{Closure, Input, MeasuredId, Model, Operation};

/// The shader's name.
pub(super) const ID: &str = "gonio:MeasuredBSDF";

/// Converts the surface. Where its file cannot be read it has no measurement, and so is grey.
pub(super) fn convert(network: &mut Network<'_>, shader: &Shader) -> Closure {
    let mut closure = Closure { model: Model::Measured, measured: file(network, shader), ..Closure::default() };
    closure.set_input("base_color", network.colour(shader, "tint", [1.0; 3]));
    closure.set_input("specular_scale", network.scalar(shader, "scale", 1.0));
    let degrees = network.scalar(shader, "rotation", 0.0);
    let turns = match constant_scalar(degrees) {
        Some(degrees) => scalar(degrees / 360.0),
        None => binary(&mut network.graph, Operation::Divide, degrees, scalar(360.0)),
    };
    closure.set_input("specular_rotation", turns);
    if let Some(normal @ Input::Node(..)) = tangent_normal(network, shader) {
        closure.normal = Some(network.graph.add(Operation::NormalMap { scale: 1.0, uv: None }, vec![normal]));
    }
    closure
}

/// The measurement in a shader's `file` input; `None`, with a warning, where there is none.
fn file(network: &mut Network<'_>, shader: &Shader) -> Option<MeasuredId> {
    let path = match network.source(shader, "file") {
        Source::Value(Value::Asset(path), _) if !path.authored.is_empty() => path,
        _ => {
            network.warn(shader, "no file of a measured BSDF is named; the surface is grey");
            return None;
        }
    };
    network.host.measured(&shader.path, &path)
}
