//! Components of values: taken apart, put together, converted between types.

use super::super::emit::{combine, component, rest, scalar};
use super::super::network::{Network, Shader};
use super::is_scalar;
use super::math::equal;
use gonio::scene::{Graph, Input};

pub(super) fn as_it_is(network: &mut Network<'_>, shader: &Shader, _: &str) -> Option<Input> {
    let [input] = network.inputs(shader, [("in", 0.0)]);
    Some(input)
}

pub(super) fn constant(network: &mut Network<'_>, shader: &Shader, _: &str) -> Option<Input> {
    Some(network.input(shader, "value").unwrap_or(scalar(0.0)))
}

/// Row or component `index`.
pub(super) fn extract(network: &mut Network<'_>, shader: &Shader, kind: &str) -> Option<Input> {
    let index = network.number(shader, "index", 0.0).clamp(0.0, 3.0) as usize;
    if kind.starts_with("matrix") {
        return super::matrices::rows(network, shader, "in").map(|rows| rows[index]);
    }
    let [input] = network.inputs(shader, [("in", 0.0)]);
    Some(component(input, index))
}

/// Between types: a number goes into all components, a fourth that is not there is 1, a third 0.
pub(super) fn convert(network: &mut Network<'_>, shader: &Shader, kind: &str) -> Option<Input> {
    let [input] = network.inputs(shader, [("in", 0.0)]);
    let (from, to) = kind.split_once('_').unwrap_or((kind, ""));
    let graph = &mut network.graph;
    let part = |index| component(input, index);
    Some(match (from, to) {
        (_, "boolean") => {
            let is_zero = equal(graph, part(0), scalar(0.0));
            rest(graph, is_zero)
        }
        (from, _) if is_scalar(from) => part(0),
        ("color3" | "vector3", "color4" | "vector4") => combine(graph, &[part(0), part(1), part(2), scalar(1.0)]),
        ("vector2", "color3" | "vector3") => combine(graph, &[part(0), part(1), scalar(0.0)]),
        ("vector2", "color4" | "vector4") => combine(graph, &[part(0), part(1), scalar(0.0), scalar(1.0)]),
        _ => input,
    })
}

/// Components by letters, as MaterialX had it up to 1.38.
pub(super) fn swizzle(network: &mut Network<'_>, shader: &Shader, _: &str) -> Option<Input> {
    let [input] = network.inputs(shader, [("in", 0.0)]);
    let names = network.text(shader, "channels")?;
    swizzled(&mut network.graph, input, &names)
}

fn swizzled(graph: &mut Graph, input: Input, names: &str) -> Option<Input> {
    let part = |name: char| match name {
        '0' => Some(scalar(0.0)),
        '1' => Some(scalar(1.0)),
        name => "rgba".find(name).or_else(|| "xyzw".find(name)).map(|index| component(input, index)),
    };
    let parts: Vec<Input> = names.chars().map(part).collect::<Option<_>>()?;
    match parts.as_slice() {
        [] => None,
        [single] => Some(*single),
        parts if parts.len() <= 4 => Some(combine(graph, parts)),
        _ => None,
    }
}

pub(super) fn combine_2(network: &mut Network<'_>, shader: &Shader, kind: &str) -> Option<Input> {
    let [a, b] = network.inputs(shader, [("in1", 0.0), ("in2", 0.0)]);
    let parts = match kind {
        "color4CF" | "vector4VF" => vec![component(a, 0), component(a, 1), component(a, 2), component(b, 0)],
        "vector4VV" => vec![component(a, 0), component(a, 1), component(b, 0), component(b, 1)],
        _ => vec![component(a, 0), component(b, 0)],
    };
    Some(combine(&mut network.graph, &parts))
}

pub(super) fn combine_parts(graph: &mut Graph, inputs: &[Input]) -> Input {
    let parts: Vec<Input> = inputs.iter().map(|input| component(*input, 0)).collect();
    combine(graph, &parts)
}
