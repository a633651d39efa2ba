//! The one place that emits a graph's nodes. What is known while the graph is made is computed here, so that only what varies over a surface
//! becomes a node.

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
    let mut values = [[0.0; 4]; 4];
    let mut known = inputs.len() <= values.len();
    for (value, input) in values.iter_mut().zip(inputs) {
        match input {
            Input::Constant(constant) => *value = *constant,
            Input::Node(..) => known = false,
        }
    }
    if let Some(folded) = known.then(|| fold(&operation, &values)).flatten() {
        return Input::Constant(folded);
    }
    Input::Node(graph.add(operation, inputs.to_vec()), Channel::Rgb)
}

/// The value of an operation on constants; `None` for operations that need a hit or a table.
fn fold(operation: &Operation, [a, b, c, d]: &[[f32; 4]; 4]) -> Option<[f32; 4]> {
    let dot = |a: &[f32; 4], b: &[f32; 4]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    Some(match operation {
        Operation::Combine => [a[0], b[0], c[0], d[0]],
        Operation::Dot => [dot(a, b); 4],
        Operation::Luminance => [luminance_of_pixel([a[0], a[1], a[2]]); 4],
        Operation::Cross => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0], 0.0],
        Operation::Normalize => {
            let length = dot(a, a).sqrt();
            let scale = if length > 0.0 { length.recip() } else { 0.0 };
            [a[0] * scale, a[1] * scale, a[2] * scale, 0.0]
        }
        Operation::RgbToHsv => to_hsv(*a),
        Operation::HsvToRgb => to_rgb(*a),
        _ => {
            let one = fold_component(operation)?;
            std::array::from_fn(|i| one(a[i], b[i], c[i]))
        }
    })
}

/// Hue in turns, saturation and value.
fn to_hsv([r, g, b, alpha]: [f32; 4]) -> [f32; 4] {
    let (most, least) = (r.max(g).max(b), r.min(g).min(b));
    let spread = most - least;
    if spread == 0.0 {
        return [0.0, 0.0, most, alpha];
    }
    let sixths = match most {
        most if most == r => (g - b) / spread,
        most if most == g => (b - r) / spread + 2.0,
        _ => (r - g) / spread + 4.0,
    };
    let hue = sixths / 6.0;
    [hue - hue.floor(), if most == 0.0 { 0.0 } else { spread / most }, most, alpha]
}

/// The inverse of [`to_hsv`].
fn to_rgb([hue, saturation, value, alpha]: [f32; 4]) -> [f32; 4] {
    let part = |offset: f32| {
        let turned = hue + offset;
        let pure = (((turned - turned.floor()) * 6.0 - 3.0).abs() - 1.0).clamp(0.0, 1.0);
        ((pure - 1.0) * saturation + 1.0) * value
    };
    [part(0.0), part(2.0 / 3.0), part(1.0 / 3.0), alpha]
}

/// One component of an operation that treats each alike.
fn fold_component(operation: &Operation) -> Option<fn(f32, f32, f32) -> f32> {
    Some(match operation {
        Operation::Add => |a, b, _| a + b,
        Operation::Subtract => |a, b, _| a - b,
        Operation::Multiply => |a, b, _| a * b,
        Operation::Divide => |a, b, _| if b == 0.0 { 0.0 } else { a / b },
        Operation::Mix => |a, b, t| a * (1.0 - t) + b * t,
        Operation::Power => |a, b, _| match a {
            a if a > 0.0 => a.powf(b),
            a if a == 0.0 && b == 0.0 => 1.0,
            _ => 0.0,
        },
        Operation::Invert => |a, amount, _| amount - a,
        Operation::Clamp => |a, low, high| a.max(low).min(high),
        Operation::Minimum => |a, b, _| a.min(b),
        Operation::Maximum => |a, b, _| a.max(b),
        Operation::Absolute => |a, _, _| a.abs(),
        Operation::Sign => |a, _, _| if a == 0.0 { 0.0 } else { a.signum() },
        Operation::Floor => |a, _, _| a.floor(),
        Operation::SquareRoot => |a, _, _| a.max(0.0).sqrt(),
        Operation::Exponential => |a, _, _| a.min(88.0).exp(),
        Operation::Logarithm => |a, _, _| if a > 0.0 { a.ln() } else { 0.0 },
        Operation::Sine => |a, _, _| a.sin(),
        Operation::Cosine => |a, _, _| a.cos(),
        Operation::ArcSine => |a, _, _| a.clamp(-1.0, 1.0).asin(),
        Operation::ArcCosine => |a, _, _| a.clamp(-1.0, 1.0).acos(),
        Operation::ArcTangent2 => |a, b, _| a.atan2(b),
        Operation::Less => |a, b, _| f32::from(u8::from(a < b)),
        _ => return None,
    })
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
        assert_eq!(apply(&mut graph, Operation::Power, &[scalar(-2.0), scalar(2.0)]), scalar(0.0));
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
