//! MaterialX nodes as they stand in USD: `ND_<node>_<type>`, by the standard library of MaterialX 1.38 and 1.39.

use super::arithmetic::{binary, clamp, combine, component, is_constant, luminance, mix, multiply, scalar, subtract};
use super::network::{Network, Shader};
use gonio::scene::{Channel, Graph, Input, NodeId, Operation, TextureFilter, WrapMode};

/// Node and type of a node's name without its prefix: `multiply_color3FA` is `multiply` on `color3FA`.
fn split(node: &str) -> (&str, &str) {
    node.split_once('_').unwrap_or((node, ""))
}

/// The component that a node's output stands for: of separating nodes by the output's name, of scalar nodes the first.
pub(super) fn output_component(id: &str, output: &str) -> Option<usize> {
    let (node, kind) = split(id.strip_prefix("ND_")?);
    match node {
        "separate2" | "separate3" | "separate4" => {
            "xyzw".find(output.strip_prefix("out")?).or_else(|| "rgba".find(output.strip_prefix("out")?))
        }
        // The last type is that of the output.
        _ => matches!(kind.rsplit('_').next(), Some("float" | "integer" | "boolean")).then_some(0),
    }
}

/// Builds the node called `node`; `None` where it is not supported.
pub(super) fn build<'py>(network: &mut Network<'_, '_, 'py>, shader: &Shader<'py>, node: &str) -> Option<Input> {
    let (node, kind) = split(node);
    arithmetic(network, shader, node)
        .or_else(|| channels(network, shader, node, kind))
        .or_else(|| texturing(network, shader, node, kind))
        .or_else(|| (node == "normalmap").then(|| normal_map(network, shader)).flatten())
}

fn arithmetic<'py>(network: &mut Network<'_, '_, 'py>, shader: &Shader<'py>, node: &str) -> Option<Input> {
    let (operation, neutral) = match node {
        "add" => (Operation::Add, 0.0),
        "subtract" => (Operation::Subtract, 0.0),
        "multiply" => (Operation::Multiply, 1.0),
        "divide" => (Operation::Divide, 1.0),
        "power" => (Operation::Power, 1.0),
        _ => return ranges(network, shader, node),
    };
    let a = network.input(shader, "in1").unwrap_or(scalar(0.0));
    let b = network.input(shader, "in2").unwrap_or(scalar(neutral));
    Some(binary(&mut network.graph, operation, a, b))
}

fn ranges<'py>(network: &mut Network<'_, '_, 'py>, shader: &Shader<'py>, node: &str) -> Option<Input> {
    let mut get = |name: &str, default: f32| network.input(shader, name).unwrap_or(scalar(default));
    match node {
        "constant" => Some(get("value", 0.0)),
        "dot" => Some(get("in", 0.0)),
        "mix" => {
            let (background, foreground, share) = (get("bg", 0.0), get("fg", 0.0), get("mix", 0.0));
            Some(mix(&mut network.graph, background, foreground, share))
        }
        "invert" => {
            let (input, amount) = (get("in", 0.0), get("amount", 1.0));
            Some(binary(&mut network.graph, Operation::Invert, input, amount))
        }
        "clamp" => {
            let (input, low, high) = (get("in", 0.0), get("low", 0.0), get("high", 1.0));
            Some(clamp(&mut network.graph, input, low, high))
        }
        "min" => {
            let (a, b) = (get("in1", 0.0), get("in2", 0.0));
            Some(clamp(&mut network.graph, a, scalar(f32::MIN), b))
        }
        "max" => {
            let (a, b) = (get("in1", 0.0), get("in2", 0.0));
            Some(clamp(&mut network.graph, a, b, scalar(f32::MAX)))
        }
        "remap" => {
            let input = get("in", 0.0);
            let ends = [("inlow", 0.0), ("inhigh", 1.0), ("outlow", 0.0), ("outhigh", 1.0)].map(|(name, default)| get(name, default));
            Some(remap(&mut network.graph, input, ends))
        }
        "contrast" => {
            let (input, amount, pivot) = (get("in", 0.0), get("amount", 1.0), get("pivot", 0.5));
            let graph = &mut network.graph;
            let centred = subtract(graph, input, pivot);
            let scaled = multiply(graph, centred, amount);
            Some(binary(graph, Operation::Add, scaled, pivot))
        }
        "saturate" => {
            let (input, amount) = (get("in", 0.0), get("amount", 1.0));
            let grey = luminance(&mut network.graph, input);
            Some(mix(&mut network.graph, grey, input, amount))
        }
        "luminance" => {
            let input = get("in", 0.0);
            Some(luminance(&mut network.graph, input))
        }
        _ => None,
    }
}

fn remap(graph: &mut Graph, input: Input, [in_low, in_high, out_low, out_high]: [Input; 4]) -> Input {
    let offset = subtract(graph, input, in_low);
    let in_range = subtract(graph, in_high, in_low);
    let out_range = subtract(graph, out_high, out_low);
    let share = binary(graph, Operation::Divide, offset, in_range);
    let scaled = multiply(graph, share, out_range);
    binary(graph, Operation::Add, scaled, out_low)
}

fn channels<'py>(network: &mut Network<'_, '_, 'py>, shader: &Shader<'py>, node: &str, kind: &str) -> Option<Input> {
    match node {
        "separate2" | "separate3" | "separate4" => Some(network.input(shader, "in").unwrap_or(scalar(0.0))),
        "extract" => {
            let input = network.input(shader, "in").unwrap_or(scalar(0.0));
            let index = network.number(shader, "index", 0.0);
            Some(component(input, index.clamp(0.0, 3.0) as usize))
        }
        "convert" => {
            let input = network.input(shader, "in").unwrap_or(scalar(0.0));
            Some(if kind.starts_with("float_") { component(input, 0) } else { input })
        }
        "swizzle" => {
            let input = network.input(shader, "in").unwrap_or(scalar(0.0));
            let names = network.text(shader, "channels")?;
            swizzle(&mut network.graph, input, &names)
        }
        "combine2" | "combine3" | "combine4" => {
            let parts = ["in1", "in2", "in3", "in4"].map(|name| network.input(shader, name));
            let [a, b, c, d] = parts.map(|part| part.unwrap_or(scalar(0.0)));
            let first = |input| component(input, 0);
            let sides: Vec<Input> = match (node, kind) {
                ("combine2", "color4CF" | "vector4VF") => vec![component(a, 0), component(a, 1), component(a, 2), first(b)],
                ("combine2", "vector4VV") => vec![component(a, 0), component(a, 1), component(b, 0), component(b, 1)],
                ("combine2", _) => vec![first(a), first(b)],
                ("combine3", _) => vec![first(a), first(b), first(c)],
                _ => vec![first(a), first(b), first(c), first(d)],
            };
            Some(combine(&mut network.graph, &sides))
        }
        _ => None,
    }
}

fn swizzle(graph: &mut Graph, input: Input, names: &str) -> Option<Input> {
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

fn texturing<'py>(network: &mut Network<'_, '_, 'py>, shader: &Shader<'py>, node: &str, kind: &str) -> Option<Input> {
    match node {
        "texcoord" => {
            let index = network.number(shader, "index", 0.0);
            Some(network.texture_coordinates(index.clamp(0.0, 64.0) as u32))
        }
        "geomcolor" => Some(network.node(Operation::Primvar { name: "displayColor".to_owned(), fallback: [0.0, 0.0, 0.0, 1.0] }, vec![])),
        "geompropvalue" => {
            let fallback = network.uniform(shader, "default", [0.0; 4]);
            let name = network.text(shader, "geomprop").filter(|name| !name.is_empty() && !kind.starts_with("string"))?;
            // MaterialX's own name of the first texture coordinates.
            let name = if name == "UV0" { "st".to_owned() } else { name };
            Some(network.node(Operation::Primvar { name, fallback }, vec![]))
        }
        "image" | "tiledimage" => Some(image(network, shader, node, kind)),
        "place2d" => Some(place_2d(network, shader)),
        "rotate2d" => {
            let input = network.input(shader, "in").unwrap_or(scalar(0.0));
            let amount = network.number(shader, "amount", 0.0);
            Some(transform(network, input, [1.0; 2], -amount, [0.0; 2]))
        }
        _ => None,
    }
}

fn transform(network: &mut Network<'_, '_, '_>, input: Input, scale: [f32; 2], rotation_deg: f32, translation: [f32; 2]) -> Input {
    network.node(Operation::Transform2d { scale, rotation_deg, translation }, vec![input])
}

fn image<'py>(network: &mut Network<'_, '_, 'py>, shader: &Shader<'py>, node: &str, kind: &str) -> Input {
    let fallback = network.uniform(shader, "default", if kind.ends_with('4') { [0.0; 4] } else { [0.0, 0.0, 0.0, 1.0] });
    let unstated = if kind.starts_with("color") { "auto" } else { "raw" };
    let Some(texture) = network.texture(shader, None, unstated) else {
        return Input::Constant(fallback);
    };
    let wrap = ["uaddressmode", "vaddressmode"].map(|name| match network.text(shader, name).as_deref() {
        None | Some("periodic") => WrapMode::Repeat,
        Some("clamp") => WrapMode::Clamp,
        Some("mirror") => WrapMode::Mirror,
        Some("constant") => WrapMode::Black,
        Some(other) => {
            let message = format!("{name} is '{other}', expected constant, clamp, periodic or mirror; periodic is used");
            network.warn(shader, message);
            WrapMode::Repeat
        }
    });
    let is_closest = network.text(shader, "filtertype").as_deref() == Some("closest");
    let filter = if is_closest { TextureFilter::Closest } else { TextureFilter::Linear };
    let mut coordinates = match network.input(shader, "texcoord") {
        Some(input) => input,
        None => network.texture_coordinates(0),
    };
    if node == "tiledimage" {
        coordinates = tile(network, shader, coordinates);
    }
    network.node(Operation::Image { texture, wrap, filter, scale: [1.0; 4], bias: [0.0; 4], fallback }, vec![coordinates])
}

/// `(uv · tiling - offset) / image size · tile size`.
fn tile<'py>(network: &mut Network<'_, '_, 'py>, shader: &Shader<'py>, coordinates: Input) -> Input {
    let mut pair = |name: &str, default: f32| network.input(shader, name).unwrap_or(scalar(default));
    let (tiling, offset) = (pair("uvtiling", 1.0), pair("uvoffset", 0.0));
    let (image_size, tile_size) = (pair("realworldimagesize", 1.0), pair("realworldtilesize", 1.0));
    let graph = &mut network.graph;
    let size = binary(graph, Operation::Divide, tile_size, image_size);
    if let (Input::Constant(tiling), Input::Constant(offset), Input::Constant(size)) = (tiling, offset, size) {
        let scale = [tiling[0] * size[0], tiling[1] * size[1]];
        let translation = [-offset[0] * size[0], -offset[1] * size[1]];
        let is_identity = scale == [1.0; 2] && translation.iter().all(|x| *x == 0.0);
        return if is_identity { coordinates } else { transform(network, coordinates, scale, 0.0, translation) };
    }
    let tiled = multiply(graph, coordinates, tiling);
    let moved = subtract(graph, tiled, offset);
    multiply(graph, moved, size)
}

/// place2d turns the other way round than `Transform2d` and divides by its scale.
fn place_2d<'py>(network: &mut Network<'_, '_, 'py>, shader: &Shader<'py>) -> Input {
    let coordinates = match network.input(shader, "texcoord") {
        Some(input) => input,
        None => network.texture_coordinates(0),
    };
    let mut pair = |name: &str, default: f32| {
        let [x, y, ..] = network.uniform(shader, name, [default; 4]);
        [x, y]
    };
    let (pivot, scale, offset) = (pair("pivot", 0.0), pair("scale", 1.0), pair("offset", 0.0));
    let turn = -network.number(shader, "rotate", 0.0);
    let inverse = scale.map(|s| if s == 0.0 { 0.0 } else { s.recip() });
    if network.number(shader, "operationorder", 0.0) == 0.0 {
        let [x, y] = rotated([-pivot[0] * inverse[0], -pivot[1] * inverse[1]], turn);
        return transform(network, coordinates, inverse, turn, [x - offset[0] + pivot[0], y - offset[1] + pivot[1]]);
    }
    let moved = rotated([-pivot[0] - offset[0], -pivot[1] - offset[1]], turn);
    let turned = transform(network, coordinates, [1.0; 2], turn, moved);
    transform(network, turned, inverse, 0.0, pivot)
}

fn rotated([x, y]: [f32; 2], degrees: f32) -> [f32; 2] {
    let (sin, cos) = degrees.to_radians().sin_cos();
    [x * cos - y * sin, x * sin + y * cos]
}

fn normal_map<'py>(network: &mut Network<'_, '_, 'py>, shader: &Shader<'py>) -> Option<Input> {
    if network.text(shader, "space").as_deref() == Some("object") {
        network.warn(shader, "object-space normal maps are not supported; the surface's own normal is used");
        return None;
    }
    let input = network.input(shader, "in")?;
    let [scale, scale_y, ..] = network.uniform(shader, "scale", [1.0; 4]);
    if scale != scale_y {
        network.warn(shader, "a normal map with two strengths counts with the first for both");
    }
    let signed = signed(&mut network.graph, input);
    (!is_constant(signed, 0.0)).then(|| network.node(Operation::NormalMap { scale, uv: None }, vec![signed]))
}

/// `2 x - 1`, folded into the image that `x` comes from.
fn signed(graph: &mut Graph, input: Input) -> Input {
    if let Input::Node(NodeId(index), Channel::Rgb) = input
        && let Some(node) = graph.nodes.get(usize::from(index))
        && let Operation::Image { texture, wrap, filter, scale, bias, fallback } = &node.operation
    {
        let operation = Operation::Image {
            texture: *texture,
            wrap: *wrap,
            filter: *filter,
            scale: scale.map(|s| 2.0 * s),
            bias: bias.map(|b| 2.0 * b - 1.0),
            fallback: fallback.map(|f| 2.0 * f - 1.0),
        };
        let inputs = node.inputs.clone();
        return Input::Node(graph.add(operation, inputs), Channel::Rgb);
    }
    let doubled = multiply(graph, input, scalar(2.0));
    subtract(graph, doubled, scalar(1.0))
}
