//! Values that operations hold as constants, where they vary over the surface: put together from operations on what varies.

use super::emit::{add, combine, component, less, mix, multiply, rest, scalar, subtract, unary};
use gonio::scene::{Channel, Graph, Input, Operation, TextureFilter, TextureId, WrapMode};

/// An image that is looked up: `scale` times its texel plus `bias`, and `fallback` where there is none.
#[derive(Clone, Copy, Debug)]
pub(in crate::material) struct Image {
    pub(in crate::material) texture: TextureId,
    pub(in crate::material) wrap: [WrapMode; 2],
    pub(in crate::material) filter: TextureFilter,
    pub(in crate::material) scale: Input,
    pub(in crate::material) bias: Input,
    pub(in crate::material) fallback: Input,
}

impl Image {
    /// The image as it is.
    pub(in crate::material) fn plain(texture: TextureId, wrap: [WrapMode; 2], fallback: Input) -> Self {
        Self { texture, wrap, filter: TextureFilter::Linear, scale: scalar(1.0), bias: scalar(0.0), fallback }
    }

    /// The value at coordinates.
    pub(in crate::material) fn at(&self, graph: &mut Graph, coordinates: Input) -> Input {
        let Self { texture, wrap, filter, .. } = *self;
        let look_up = |graph: &mut Graph, scale, bias, fallback| {
            let operation = Operation::Image { texture, wrap, filter, scale, bias, fallback };
            Input::Node(graph.add(operation, vec![coordinates]), Channel::Rgb)
        };
        if let (Input::Constant(scale), Input::Constant(bias), Input::Constant(fallback)) = (self.scale, self.bias, self.fallback) {
            return look_up(graph, scale, bias, fallback);
        }
        let texel = look_up(graph, [1.0; 4], [0.0; 4], [0.0; 4]);
        let scaled = multiply(graph, texel, self.scale);
        let value = add(graph, scaled, self.bias);
        // 1 where there is no texel, else 0.
        let missing = look_up(graph, [0.0; 4], [0.0; 4], [1.0; 4]);
        mix(graph, value, self.fallback, missing)
    }
}

/// A primvar; `fallback` where the prim has none.
pub(in crate::material) fn primvar(graph: &mut Graph, name: String, fallback: Input) -> Input {
    let read =
        |graph: &mut Graph, name: String, fallback| Input::Node(graph.add(Operation::Primvar { name, fallback }, vec![]), Channel::Rgb);
    if let Input::Constant(fallback) = fallback {
        return read(graph, name, fallback);
    }
    let (value, marked) = (read(graph, name.clone(), [0.0; 4]), read(graph, name, [1.0; 4]));
    // 1 where the primvar is missing, else 0.
    let missing = subtract(graph, marked, value);
    let filled = multiply(graph, missing, fallback);
    add(graph, value, filled)
}

/// Coordinates scaled, turned to the left by degrees, and moved.
pub(in crate::material) fn placed(graph: &mut Graph, input: Input, scale: Input, degrees: Input, translation: Input) -> Input {
    if let (Input::Constant([sx, sy, ..]), Input::Constant([rotation_deg, ..]), Input::Constant([x, y, ..])) = (scale, degrees, translation)
    {
        let operation = Operation::Transform2d { scale: [sx, sy], rotation_deg, translation: [x, y] };
        return Input::Node(graph.add(operation, vec![input]), Channel::Rgb);
    }
    let scaled = multiply(graph, input, scale);
    let right = subtract(graph, scalar(0.0), degrees);
    let turned = turned(graph, scaled, right);
    add(graph, turned, translation)
}

/// Clockwise by degrees.
pub(in crate::material) fn turned(graph: &mut Graph, input: Input, degrees: Input) -> Input {
    let angle = multiply(graph, component(degrees, 0), scalar(1.0_f32.to_radians()));
    let (sin, cos) = (unary(graph, Operation::Sine, angle), unary(graph, Operation::Cosine, angle));
    let (x, y) = (component(input, 0), component(input, 1));
    let (cos_x, sin_y) = (multiply(graph, cos, x), multiply(graph, sin, y));
    let (cos_y, sin_x) = (multiply(graph, cos, y), multiply(graph, sin, x));
    let parts = [add(graph, cos_x, sin_y), subtract(graph, cos_y, sin_x)];
    combine(graph, &parts)
}

/// A normal in the tangents' space, bent so many times as much.
pub(in crate::material) fn bent(graph: &mut Graph, normal: Input, strength: Input) -> Input {
    let bend =
        |graph: &mut Graph, scale, normal| Input::Node(graph.add(Operation::NormalMap { scale, uv: None }, vec![normal]), Channel::Rgb);
    match strength {
        Input::Constant([scale, ..]) => bend(graph, scale, normal),
        Input::Node(..) => {
            let factors = combine(graph, &[component(strength, 0), component(strength, 0), scalar(1.0)]);
            let scaled = multiply(graph, normal, factors);
            bend(graph, 1.0, scaled)
        }
    }
}

/// Opacity where the threshold is zero; elsewhere all or nothing, as it reaches the threshold or not.
pub(in crate::material) fn cut_out(graph: &mut Graph, opacity: Input, threshold: Input) -> Input {
    let below = less(graph, opacity, threshold);
    let all = rest(graph, below);
    let cuts = less(graph, scalar(0.0), threshold);
    mix(graph, opacity, all, cuts)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn primvar_of(graph: &mut Graph, name: &str) -> Input {
        primvar(graph, name.to_owned(), scalar(0.0))
    }

    #[test]
    fn what_does_not_vary_is_one_operation() {
        let mut graph = Graph::default();
        let st = primvar_of(&mut graph, "st");
        Image::plain(TextureId(0), [WrapMode::Repeat; 2], scalar(0.0)).at(&mut graph, st);
        placed(&mut graph, st, scalar(2.0), scalar(30.0), scalar(0.0));
        bent(&mut graph, st, scalar(0.5));
        assert_eq!(graph.nodes.len(), 4);
    }

    #[test]
    fn what_varies_is_asked_where_something_is_missing() {
        let mut graph = Graph::default();
        let (st, other) = (primvar_of(&mut graph, "st"), primvar_of(&mut graph, "other"));
        let image = Image::plain(TextureId(0), [WrapMode::Repeat; 2], other);
        assert!(matches!(image.at(&mut graph, st), Input::Node(..)));
        assert!(matches!(graph.nodes.last().map(|node| &node.operation), Some(Operation::Mix)));
        primvar(&mut graph, "tint".to_owned(), other);
        let asked = graph.nodes.iter().filter(|node| matches!(&node.operation, Operation::Primvar { name, .. } if name == "tint"));
        assert_eq!(asked.count(), 2);
    }
}
