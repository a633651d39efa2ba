//! The one place that emits a graph's nodes. What is known while the graph is made is computed here, so that only what varies over a surface
//! becomes a node.

use gonio::scene::{Channel, Graph, Input, Operation};
use gonio_nodes::fold;

/// A number as an input.
pub(in crate::material) fn scalar(value: f32) -> Input {
    Input::Constant([value; 4])
}

/// A colour as an input.
pub(in crate::material) fn colour([r, g, b]: [f32; 3]) -> Input {
    Input::Constant([r, g, b, 1.0])
}

/// The first component of a constant.
pub(in crate::material) fn constant_scalar(input: Input) -> Option<f32> {
    match input {
        Input::Constant([x, ..]) => Some(x),
        Input::Node(..) => None,
    }
}

/// Whether the input is the same known number in all colour components.
pub(in crate::material) fn is_constant(input: Input, value: f32) -> bool {
    matches!(input, Input::Constant([r, g, b, _]) if r == value && g == value && b == value)
}

/// Whether the input is the same known number in all four components.
fn is_all(input: Input, value: f32) -> bool {
    matches!(input, Input::Constant(values) if values == [value; 4])
}

/// One component of an input.
pub(in crate::material) fn component(input: Input, index: usize) -> Input {
    match input {
        Input::Constant(values) => scalar(values[index.min(3)]),
        Input::Node(node, Channel::Rgb) => Input::Node(node, [Channel::R, Channel::G, Channel::B, Channel::A][index.min(3)]),
        single @ Input::Node(..) => single,
    }
}

/// The operation on inputs: a constant where all are and the operation needs nothing else, else a node.
pub(in crate::material) fn apply(graph: &mut Graph, operation: Operation, inputs: &[Input]) -> Input {
    let constants = inputs.iter().map(|input| match input {
        Input::Constant(constant) => Some(*constant),
        Input::Node(..) => None,
    });
    let constants: Option<Vec<[f32; 4]>> = constants.collect();
    // Operations without inputs ask for a hit.
    if let Some(folded) = constants.filter(|values| !values.is_empty()).and_then(|values| fold(&operation, &values)) {
        return Input::Constant(folded);
    }
    Input::Node(graph.add(operation, inputs.to_vec()), Channel::Rgb)
}

/// `a · b`.
pub(in crate::material) fn multiply(graph: &mut Graph, a: Input, b: Input) -> Input {
    if is_constant(a, 1.0) {
        return b;
    }
    if is_constant(b, 1.0) {
        return a;
    }
    if is_all(a, 0.0) || is_all(b, 0.0) {
        return Input::Constant([0.0; 4]);
    }
    binary(graph, Operation::Multiply, a, b)
}

/// `a + b`.
pub(in crate::material) fn add(graph: &mut Graph, a: Input, b: Input) -> Input {
    match (is_all(a, 0.0), is_all(b, 0.0)) {
        (true, _) => b,
        (_, true) => a,
        _ => binary(graph, Operation::Add, a, b),
    }
}

/// `a - b`.
pub(in crate::material) fn subtract(graph: &mut Graph, a: Input, b: Input) -> Input {
    if is_all(b, 0.0) { a } else { binary(graph, Operation::Subtract, a, b) }
}

/// `a / b`, zero where `b` is.
pub(in crate::material) fn divide(graph: &mut Graph, a: Input, b: Input) -> Input {
    if is_all(b, 1.0) { a } else { binary(graph, Operation::Divide, a, b) }
}

/// `1 - a`.
pub(in crate::material) fn rest(graph: &mut Graph, a: Input) -> Input {
    binary(graph, Operation::Subtract, scalar(1.0), a)
}

/// The operation on one input.
pub(in crate::material) fn unary(graph: &mut Graph, operation: Operation, a: Input) -> Input {
    apply(graph, operation, &[a])
}

/// The operation on two inputs: a constant if both are, else a node.
pub(in crate::material) fn binary(graph: &mut Graph, operation: Operation, a: Input, b: Input) -> Input {
    apply(graph, operation, &[a, b])
}

/// `background` where `mix` is 0, `foreground` where it is 1.
pub(in crate::material) fn mix(graph: &mut Graph, background: Input, foreground: Input, mix: Input) -> Input {
    if is_all(mix, 0.0) || background == foreground {
        return background;
    }
    if is_all(mix, 1.0) {
        return foreground;
    }
    apply(graph, Operation::Mix, &[background, foreground, mix])
}

/// `value` held between `low` and `high`.
pub(in crate::material) fn clamp(graph: &mut Graph, value: Input, low: Input, high: Input) -> Input {
    apply(graph, Operation::Clamp, &[value, low, high])
}

/// 1 where `a < b`, else 0.
pub(in crate::material) fn less(graph: &mut Graph, a: Input, b: Input) -> Input {
    binary(graph, Operation::Less, a, b)
}

/// The first components of up to four inputs side by side.
pub(in crate::material) fn combine(graph: &mut Graph, parts: &[Input]) -> Input {
    if parts.iter().all(|part| matches!(part, Input::Constant(_))) {
        let mut values = [0.0, 0.0, 0.0, 1.0];
        for (value, part) in values.iter_mut().zip(parts) {
            *value = constant_scalar(*part).unwrap_or_default();
        }
        return Input::Constant(values);
    }
    Input::Node(graph.add(Operation::Combine, parts.to_vec()), Channel::Rgb)
}

/// The luminance of a linear Rec.709 colour.
pub(in crate::material) fn luminance(graph: &mut Graph, input: Input) -> Input {
    match input {
        Input::Node(_, Channel::Rgb) => component(unary(graph, Operation::Luminance, input), 0),
        Input::Constant(_) => unary(graph, Operation::Luminance, input),
        single @ Input::Node(..) => single,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constants_fold_without_nodes() {
        let mut graph = Graph::default();
        let product = multiply(&mut graph, scalar(0.5), colour([0.2, 0.4, 0.8]));
        assert_eq!(product, Input::Constant([0.1, 0.2, 0.4, 0.5]));
        assert_eq!(mix(&mut graph, scalar(1.0), scalar(3.0), scalar(0.5)), scalar(2.0));
        assert_eq!(luminance(&mut graph, colour([1.0; 3])), scalar(1.0));
        assert_eq!(apply(&mut graph, Operation::Power, &[scalar(-2.0), scalar(2.0)]), scalar(4.0));
        assert_eq!(apply(&mut graph, Operation::Power, &[scalar(-2.0), scalar(0.5)]), scalar(0.0));
        assert_eq!(divide(&mut graph, scalar(1.0), scalar(0.0)), scalar(0.0));
        assert!(graph.nodes.is_empty());
    }

    #[test]
    fn what_changes_nothing_is_no_node() {
        let mut graph = Graph::default();
        let node = Input::Node(graph.add(Operation::Primvar { name: "a".into(), fallback: [0.0; 4] }, vec![]), Channel::Rgb);
        assert_eq!(multiply(&mut graph, scalar(1.0), node), node);
        assert_eq!(add(&mut graph, node, scalar(0.0)), node);
        assert_eq!(mix(&mut graph, node, scalar(2.0), scalar(0.0)), node);
        assert_eq!(mix(&mut graph, node, scalar(2.0), scalar(1.0)), scalar(2.0));
        assert_eq!(graph.nodes.len(), 1);
    }
}
