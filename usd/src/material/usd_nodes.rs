//! The nodes of the UsdPreviewSurface specification: textures, primvar readers and 2D transforms.

use super::emit::{binary, scalar};
use super::network::{Network, Shader};
use super::neutral::{Source, Value};
use super::varying::{Image, placed, primvar};
use gonio::scene::{Input, Operation, WrapMode};

/// Where images lie without wrapping when nothing is said: outside them there is nothing.
const UNSTATED_WRAP: &str = "useMetadata";

/// Whether `node` (without MaterialX's prefix) is one of the specification's.
pub(in crate::material) fn is_usd_node(node: &str) -> bool {
    node.starts_with("UsdUVTexture") || node.starts_with("UsdPrimvarReader_") || node.starts_with("UsdTransform2d")
}

/// The component that a named output of a texture or of a scalar reader stands for.
pub(in crate::material) fn output_component(id: &str, output: &str) -> Option<usize> {
    let node = id.strip_prefix("ND_").unwrap_or(id);
    match (node, output) {
        ("UsdPrimvarReader_float" | "UsdPrimvarReader_int" | "UsdPrimvarReader_integer", _) => Some(0),
        (node, output) if node.starts_with("UsdUVTexture") => ["r", "g", "b", "a"].iter().position(|name| *name == output),
        _ => None,
    }
}

/// Whether a node of the specification has an output; `None` for other nodes.
pub(in crate::material) fn has_output(id: &str, output: &str) -> Option<bool> {
    let node = id.strip_prefix("ND_").unwrap_or(id);
    let outputs: &[&str] = if node.starts_with("UsdUVTexture") { &["r", "g", "b", "a", "rgb", "rgba"] } else { &["result", "out"] };
    is_usd_node(node).then(|| outputs.contains(&output))
}

/// Builds a node of the specification; `is_materialx` says that MaterialX's defaults hold.
pub(in crate::material) fn build(network: &mut Network<'_>, shader: &Shader, node: &str, is_materialx: bool) -> Option<Input> {
    match node {
        _ if node.starts_with("UsdUVTexture") => Some(texture(network, shader, is_materialx)),
        "UsdTransform2d" => Some(transform(network, shader)),
        _ => primvar_reader(network, shader, node.strip_prefix("UsdPrimvarReader_")?),
    }
}

fn wrap_mode(network: &mut Network<'_>, shader: &Shader, name: &str, mode: &str) -> WrapMode {
    match mode {
        "repeat" | "periodic" => WrapMode::Repeat,
        "clamp" => WrapMode::Clamp,
        "mirror" => WrapMode::Mirror,
        "black" | "constant" | UNSTATED_WRAP => WrapMode::Black,
        other => {
            network.warn(shader, format!("{name} is '{other}', expected useMetadata, black, clamp, repeat or mirror; repeat is used"));
            WrapMode::Repeat
        }
    }
}

fn texture(network: &mut Network<'_>, shader: &Shader, is_materialx: bool) -> Input {
    let unstated = if is_materialx { "periodic" } else { UNSTATED_WRAP };
    let wrap = ["wrapS", "wrapT"].map(|name| {
        let mode = network.text(shader, name).unwrap_or_else(|| unstated.to_owned());
        wrap_mode(network, shader, name, &mode)
    });
    let fallback = network.input(shader, "fallback").unwrap_or(Input::Constant([0.0, 0.0, 0.0, 1.0]));
    let [scale, bias] = network.inputs(shader, [("scale", 1.0), ("bias", 0.0)]);
    let stated = network.text(shader, "sourceColorSpace").filter(|space| space != "auto");
    let Some(texture) = network.texture(shader, stated.as_deref(), "auto") else {
        return fallback;
    };
    let st = match network.input(shader, "st") {
        Some(input) => input,
        None if is_materialx => network.texture_coordinates(0),
        None => scalar(0.0),
    };
    Image { scale, bias, ..Image::plain(texture, wrap, fallback) }.at(&mut network.graph, st)
}

fn transform(network: &mut Network<'_>, shader: &Shader) -> Input {
    let [input, scale] = network.inputs(shader, [("in", 0.0), ("scale", 1.0)]);
    let [rotation, translation] = network.inputs(shader, [("rotation", 0.0), ("translation", 0.0)]);
    placed(&mut network.graph, input, scale, rotation, translation)
}

fn primvar_reader(network: &mut Network<'_>, shader: &Shader, kind: &str) -> Option<Input> {
    if !matches!(
        kind,
        "float" | "float2" | "float3" | "float4" | "int" | "integer" | "normal" | "point" | "vector" | "vector2" | "vector3" | "vector4"
    ) {
        return None;
    }
    let [fallback] = network.inputs(shader, [("fallback", 0.0)]);
    match network.text(shader, "varname").filter(|name| !name.is_empty()) {
        Some(name) => Some(primvar(&mut network.graph, name, fallback)),
        None => {
            network.warn(shader, "varname names no primvar; the reader's fallback is used");
            Some(fallback)
        }
    }
}

/// Whether a normal map's texture says neither scale nor bias, so that its numbers are still in [0, 1].
fn is_unscaled(network: &mut Network<'_>, texture: &Shader) -> bool {
    ["scale", "bias"].iter().all(|name| matches!(network.source(texture, name), Source::Nothing))
        && matches!(network.source(texture, "file"), Source::Value(Value::Asset(path), _) if is_unsigned_format(&path.authored))
}

fn is_unsigned_format(file: &str) -> bool {
    let end = file.trim_end_matches(']').rsplit('.').next().unwrap_or_default().to_ascii_lowercase();
    matches!(end.as_str(), "png" | "jpg" | "jpeg" | "tga" | "bmp" | "webp" | "gif" | "avif")
}

/// The preview surface's `normal` input as a tangent-space normal in [-1, 1]; `None` if it is not connected.
pub(in crate::material) fn tangent_normal(network: &mut Network<'_>, shader: &Shader) -> Option<Input> {
    let Source::Output(node, _) = network.source(shader, "normal") else {
        return None;
    };
    let input = network.input(shader, "normal")?;
    let texture = network.shader(node);
    if &*texture.id == "UsdUVTexture" && is_unscaled(network, &texture) {
        network.warn(&texture, "a normal map without scale and bias; (2, 2, 2) and (-1, -1, -1) are used");
        let doubled = binary(&mut network.graph, Operation::Multiply, input, scalar(2.0));
        return Some(binary(&mut network.graph, Operation::Subtract, doubled, scalar(1.0)));
    }
    Some(input)
}
