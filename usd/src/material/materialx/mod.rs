//! MaterialX's nodes, `ND_<node>_<type>`, by its standard library (1.38 and 1.39). Those that are graphs of others are put together from these
//! where the library is at hand; each row of the table is one that is computed.

mod adjust;
mod channels;
mod compositing;
mod geometric;
mod hair;
mod hextile;
mod math;
mod matrices;
mod noise;
mod normals;
mod pattern;
mod physical;
mod table;
mod texture;
mod transform;
mod varying_matrices;

use super::network::{Network, Shader};
use gonio::scene::{Graph, Input};
pub(in crate::material) use table::{ROWS, Row};

/// How a node is computed.
#[derive(Clone, Copy)]
pub(in crate::material) enum Rule {
    /// From the inputs of these names, which have these defaults in all components.
    Of(&'static [(&'static str, f32)], fn(&mut Graph, &[Input]) -> Input),
    /// In its own way, given the node and its types; `None` where the input that it feeds keeps its default.
    Own(fn(&mut Network<'_>, &Shader, &str) -> Option<Input>),
    /// In its own way for each of its outputs, given the output.
    Each(fn(&mut Network<'_>, &Shader, &str) -> Option<Input>),
    /// Not yet: it waits for an operation of the engine.
    Later,
}

/// Node and type of a node's name: `ND_multiply_color3FA` is `multiply` on `color3FA`.
pub(in crate::material) fn split(id: &str) -> (&str, &str) {
    let name = id.strip_prefix("ND_").unwrap_or(id);
    let name = name.strip_prefix("logical_").unwrap_or(name);
    let row = |name: &str| ROWS.iter().any(|row| row.name == name);
    if row(name) {
        return (name, "");
    }
    // Names of nodes may have underscores of their own.
    let ends = name.match_indices('_').map(|(end, _)| end);
    ends.rev()
        .find(|end| row(&name[..*end]))
        .map_or_else(|| name.split_once('_').unwrap_or((name, "")), |end| (&name[..end], &name[end + 1..]))
}

/// The row of a node; `None` where the table has none.
pub(in crate::material) fn row(id: &str) -> Option<&'static Row> {
    let (name, _) = split(id.strip_prefix("ND_").map(|_| id)?);
    ROWS.iter().find(|row| row.name == name)
}

/// The component that a node's output stands for: of separating nodes by the output's name, of scalar nodes the first.
pub(in crate::material) fn output_component(id: &str, output: &str) -> Option<usize> {
    // What graphs give is of the right type already.
    let node = row(id)?.name;
    match node {
        "separate2" | "separate3" | "separate4" => {
            "xyzw".find(output.strip_prefix("out")?).or_else(|| "rgba".find(output.strip_prefix("out")?))
        }
        "dotproduct" | "magnitude" | "distance" | "determinant" => Some(0),
        // Named by the type of an input.
        "normalmap" => None,
        // The last type is that of the output.
        _ => is_scalar(split(id).1.rsplit('_').next().unwrap_or_default()).then_some(0),
    }
}

/// Whether a type, as it stands in a definition's name, is that of a number.
fn is_scalar(kind: &str) -> bool {
    ["float", "integer", "boolean"].iter().any(|scalar| kind.strip_prefix(scalar).is_some_and(|rest| rest.len() <= 2))
}

/// Builds a node's output; `None` where that cannot be had.
pub(in crate::material) fn build(network: &mut Network<'_>, shader: &Shader, output: &str) -> Option<Input> {
    match row(&shader.id)?.rule {
        Rule::Of(inputs, compute) => {
            let values: Vec<Input> =
                inputs.iter().map(|(name, default)| network.input(shader, name).unwrap_or(Input::Constant([*default; 4]))).collect();
            Some(compute(&mut network.graph, &values))
        }
        Rule::Own(build) => build(network, shader, split(&shader.id).1),
        Rule::Each(build) => build(network, shader, output),
        Rule::Later => {
            network.waits(shader);
            None
        }
    }
}
