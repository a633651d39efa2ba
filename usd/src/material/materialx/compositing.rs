//! Compositing of colours with and without alpha: `fg` over `bg`, as much of it as `mix` says.

use super::super::emit::{add, binary, combine, component, divide, less, mix, multiply, rest, scalar, subtract, unary};
use gonio::scene::{Graph, Input, Operation};

/// What counts as zero where it would divide.
const TINY: f32 = 1e-8;

pub(super) fn plus(graph: &mut Graph, inputs: &[Input]) -> Input {
    let laid = add(graph, inputs[1], inputs[0]);
    mix(graph, inputs[1], laid, inputs[2])
}

pub(super) fn minus(graph: &mut Graph, inputs: &[Input]) -> Input {
    let laid = subtract(graph, inputs[1], inputs[0]);
    mix(graph, inputs[1], laid, inputs[2])
}

pub(super) fn difference(graph: &mut Graph, inputs: &[Input]) -> Input {
    let signed = subtract(graph, inputs[1], inputs[0]);
    let laid = unary(graph, Operation::Absolute, signed);
    mix(graph, inputs[1], laid, inputs[2])
}

/// Nothing at all where the divisor is zero, whatever the share.
fn unless_zero(graph: &mut Graph, divisor: Input, value: Input) -> Input {
    let magnitude = unary(graph, Operation::Absolute, divisor);
    let is_zero = less(graph, magnitude, scalar(TINY));
    mix(graph, value, scalar(0.0), is_zero)
}

pub(super) fn burn(graph: &mut Graph, inputs: &[Input]) -> Input {
    let lack = rest(graph, inputs[1]);
    let ratio = divide(graph, lack, inputs[0]);
    let laid = rest(graph, ratio);
    let mixed = mix(graph, inputs[1], laid, inputs[2]);
    unless_zero(graph, inputs[0], mixed)
}

pub(super) fn dodge(graph: &mut Graph, inputs: &[Input]) -> Input {
    let lack = rest(graph, inputs[0]);
    let laid = divide(graph, inputs[1], lack);
    let mixed = mix(graph, inputs[1], laid, inputs[2]);
    unless_zero(graph, lack, mixed)
}

pub(super) fn screen(graph: &mut Graph, inputs: &[Input]) -> Input {
    let (over, under) = (rest(graph, inputs[0]), rest(graph, inputs[1]));
    let dark = multiply(graph, over, under);
    let laid = rest(graph, dark);
    mix(graph, inputs[1], laid, inputs[2])
}

/// `fg` where `bg` is.
pub(super) fn inside_ground(graph: &mut Graph, inputs: &[Input]) -> Input {
    let laid = multiply(graph, inputs[0], component(inputs[1], 3));
    mix(graph, inputs[1], laid, inputs[2])
}

/// `bg` where `fg` is.
pub(super) fn mask(graph: &mut Graph, inputs: &[Input]) -> Input {
    let laid = multiply(graph, inputs[1], component(inputs[0], 3));
    mix(graph, inputs[1], laid, inputs[2])
}

/// `fg` where `bg` is not.
pub(super) fn outside_ground(graph: &mut Graph, inputs: &[Input]) -> Input {
    let open = rest(graph, component(inputs[1], 3));
    let laid = multiply(graph, inputs[0], open);
    mix(graph, inputs[1], laid, inputs[2])
}

/// `fg`, which holds its alpha already, over `bg`.
pub(super) fn over(graph: &mut Graph, inputs: &[Input]) -> Input {
    let open = rest(graph, component(inputs[0], 3));
    let behind = multiply(graph, inputs[1], open);
    let laid = add(graph, inputs[0], behind);
    mix(graph, inputs[1], laid, inputs[2])
}

/// `fg`, whose colour is yet to be dimmed by its alpha, over `bg`.
pub(super) fn matte(graph: &mut Graph, inputs: &[Input]) -> Input {
    let alpha = component(inputs[0], 3);
    let dimmed = multiply(graph, inputs[0], alpha);
    let ready = with_alpha(graph, dimmed, alpha);
    over(graph, &[ready, inputs[1], inputs[2]])
}

/// Both side by side as long as there is room for both.
pub(super) fn disjoint_over(graph: &mut Graph, inputs: &[Input]) -> Input {
    let (over_alpha, under_alpha) = (component(inputs[0], 3), component(inputs[1], 3));
    let sum = add(graph, over_alpha, under_alpha);
    let open = rest(graph, over_alpha);
    let share = divide(graph, open, under_alpha);
    let is_full = less(graph, scalar(1.0), sum);
    let factor = mix(graph, scalar(1.0), share, is_full);
    let behind = multiply(graph, inputs[1], factor);
    let both = add(graph, inputs[0], behind);
    // A ground without alpha under a full layer leaves nothing.
    let magnitude = unary(graph, Operation::Absolute, under_alpha);
    let is_bare = less(graph, magnitude, scalar(TINY));
    let is_lost = multiply(graph, is_bare, is_full);
    let colour = mix(graph, both, scalar(0.0), is_lost);
    let alpha = binary(graph, Operation::Minimum, sum, scalar(1.0));
    let laid = with_alpha(graph, colour, alpha);
    mix(graph, inputs[1], laid, inputs[2])
}

/// `in` times `mask`.
pub(super) fn inside(graph: &mut Graph, inputs: &[Input]) -> Input {
    multiply(graph, inputs[0], inputs[1])
}

/// `in` times what `mask` leaves.
pub(super) fn outside(graph: &mut Graph, inputs: &[Input]) -> Input {
    let open = rest(graph, inputs[1]);
    multiply(graph, inputs[0], open)
}

pub(super) fn premultiply(graph: &mut Graph, inputs: &[Input]) -> Input {
    let alpha = component(inputs[0], 3);
    let dimmed = multiply(graph, inputs[0], alpha);
    with_alpha(graph, dimmed, alpha)
}

pub(super) fn unpremultiply(graph: &mut Graph, inputs: &[Input]) -> Input {
    let alpha = component(inputs[0], 3);
    let plain = divide(graph, inputs[0], alpha);
    with_alpha(graph, plain, alpha)
}

fn with_alpha(graph: &mut Graph, colour: Input, alpha: Input) -> Input {
    combine(graph, &[component(colour, 0), component(colour, 1), component(colour, 2), alpha])
}
