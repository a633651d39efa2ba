//! Images at texture coordinates.

use super::super::emit::{divide, multiply, subtract};
use super::super::network::{Network, Shader};
use super::super::varying::Image;
use super::transform::transformed;
use gonio::scene::{Input, TextureFilter, WrapMode};

pub(super) fn image(network: &mut Network<'_>, shader: &Shader, kind: &str) -> Option<Input> {
    let fallback = fallback(network, shader, kind);
    let unstated = if kind.starts_with("color") { "auto" } else { "raw" };
    let Some(texture) = network.texture(shader, None, unstated) else {
        return Some(fallback);
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
    let mut coordinates = network.geometric_input(shader, "texcoord", "UV0");
    if super::split(&shader.id).0 == "tiledimage" {
        coordinates = tile(network, shader, coordinates);
    }
    Some(Image { filter, ..Image::plain(texture, wrap, fallback) }.at(&mut network.graph, coordinates))
}

/// What an image is where it is not to be had.
pub(super) fn fallback(network: &mut Network<'_>, shader: &Shader, kind: &str) -> Input {
    let black = if kind.ends_with('4') { [0.0; 4] } else { [0.0, 0.0, 0.0, 1.0] };
    network.input(shader, "default").unwrap_or(Input::Constant(black))
}

/// `(uv · tiling - offset) / image size · tile size`.
fn tile(network: &mut Network<'_>, shader: &Shader, coordinates: Input) -> Input {
    let [tiling, offset] = network.inputs(shader, [("uvtiling", 1.0), ("uvoffset", 0.0)]);
    let [image_size, tile_size] = network.inputs(shader, [("realworldimagesize", 1.0), ("realworldtilesize", 1.0)]);
    let graph = &mut network.graph;
    let size = divide(graph, tile_size, image_size);
    if let (Input::Constant(tiling), Input::Constant(offset), Input::Constant(size)) = (tiling, offset, size) {
        let scale = [tiling[0] * size[0], tiling[1] * size[1]];
        let translation = [-offset[0] * size[0], -offset[1] * size[1]];
        let is_identity = scale == [1.0; 2] && translation.iter().all(|x| *x == 0.0);
        return if is_identity { coordinates } else { transformed(network, coordinates, scale, 0.0, translation) };
    }
    let tiled = multiply(graph, coordinates, tiling);
    let moved = subtract(graph, tiled, offset);
    multiply(graph, moved, size)
}
