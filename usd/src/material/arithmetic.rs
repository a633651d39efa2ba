//! Arithmetic on node inputs that folds constants, so that only what varies over a surface becomes a node.

use gonio::colour::luminance_of_pixel;
use gonio::scene::{Channel, Graph, Input, Operation};

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

/// One component of an input.
pub(in crate::material) fn component(input: Input, index: usize) -> Input {
    match input {
        Input::Constant(values) => scalar(values[index.min(3)]),
        Input::Node(node, Channel::Rgb) => Input::Node(node, [Channel::R, Channel::G, Channel::B, Channel::A][index.min(3)]),
        single @ Input::Node(..) => single,
    }
}

/// `a · b`.
pub(in crate::material) fn multiply(graph: &mut Graph, a: Input, b: Input) -> Input {
    if is_constant(a, 1.0) {
        return b;
    }
    if is_constant(b, 1.0) {
        return a;
    }
    binary(graph, Operation::Multiply, a, b)
}

/// `a - b`.
pub(in crate::material) fn subtract(graph: &mut Graph, a: Input, b: Input) -> Input {
    binary(graph, Operation::Subtract, a, b)
}

/// The operation on two inputs: a constant if both are, else a node.
pub(in crate::material) fn binary(graph: &mut Graph, operation: Operation, a: Input, b: Input) -> Input {
    if let (Input::Constant(x), Input::Constant(y), Some(apply)) = (a, b, folding(&operation)) {
        return Input::Constant(std::array::from_fn(|i| apply(x[i], y[i])));
    }
    Input::Node(graph.add(operation, vec![a, b]), Channel::Rgb)
}

fn folding(operation: &Operation) -> Option<fn(f32, f32) -> f32> {
    Some(match operation {
        Operation::Add => |a, b| a + b,
        Operation::Subtract => |a, b| a - b,
        Operation::Multiply => |a, b| a * b,
        Operation::Divide => |a, b| if b == 0.0 { 0.0 } else { a / b },
        Operation::Power => |a, b| if a < 0.0 { 0.0 } else { a.powf(b) },
        Operation::Invert => |a, amount| amount - a,
        _ => return None,
    })
}

/// `background` where `mix` is 0, `foreground` where it is 1.
pub(in crate::material) fn mix(graph: &mut Graph, background: Input, foreground: Input, mix: Input) -> Input {
    if let (Input::Constant(a), Input::Constant(b), Input::Constant(t)) = (background, foreground, mix) {
        return Input::Constant(std::array::from_fn(|i| a[i] * (1.0 - t[i]) + b[i] * t[i]));
    }
    Input::Node(graph.add(Operation::Mix, vec![background, foreground, mix]), Channel::Rgb)
}

/// `value` held between `low` and `high`.
pub(in crate::material) fn clamp(graph: &mut Graph, value: Input, low: Input, high: Input) -> Input {
    if let (Input::Constant(v), Input::Constant(l), Input::Constant(h)) = (value, low, high) {
        return Input::Constant(std::array::from_fn(|i| v[i].max(l[i]).min(h[i])));
    }
    Input::Node(graph.add(Operation::Clamp, vec![value, low, high]), Channel::Rgb)
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
        Input::Constant([r, g, b, _]) => scalar(luminance_of_pixel([r, g, b])),
        Input::Node(_, Channel::Rgb) => Input::Node(graph.add(Operation::Luminance, vec![input]), Channel::R),
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
        assert!(graph.nodes.is_empty());
    }

    #[test]
    fn one_times_a_node_is_the_node() {
        let mut graph = Graph::default();
        let node = Input::Node(graph.add(Operation::Primvar { name: "a".into(), fallback: [0.0; 4] }, vec![]), Channel::Rgb);
        assert_eq!(multiply(&mut graph, scalar(1.0), node), node);
        assert_eq!(graph.nodes.len(), 1);
    }
}
