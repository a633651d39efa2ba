//! From sums to an image.

use super::{Film, catcher, channel_names, divisor, is_index};
use crate::{
    integrator::{BATCH, tile_place},
    scene::{Aov, Crop},
};

/// A named group of channels, pixel by pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Layer {
    /// The pass.
    pub aov: Aov,
    /// Its name.
    pub name: String,
    /// `channels` floats a pixel, rows from the top.
    pub values: Vec<f32>,
    /// Channels a pixel.
    pub channels: usize,
}

/// A developed film: the rendered window of an image.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// The whole image's width and height.
    pub resolution: [u32; 2],
    /// The part the layers hold.
    pub window: Crop,
    /// The passes.
    pub layers: Vec<Layer>,
    /// Samples a pixel, the least of all tiles.
    pub samples: u32,
}

impl Image {
    /// Width and height of the window.
    pub fn size(&self) -> [usize; 2] {
        [0, 1].map(|axis| (self.window.max[axis] - self.window.min[axis]) as usize)
    }

    /// The layer of a pass.
    pub fn layer(&self, aov: Aov) -> Option<&Layer> {
        self.layers.iter().find(|layer| layer.aov == aov)
    }
}

impl Film {
    /// The means so far.
    ///
    /// Depth, normal and position are means over what was covered; alpha tells how much that was.
    pub fn develop(&self) -> Image {
        let [width, height] = [0, 1].map(|axis| (self.window.max[axis] - self.window.min[axis]) as usize);
        let mut layers: Vec<Layer> =
            self.layout.aovs.iter().zip(&self.names).map(|(aov, name)| empty_layer(*aov, name, width * height)).collect();
        let mut least = u32::MAX;
        for tile in 0..self.tile_count() {
            let area = self.tile_area(tile);
            self.read(tile, |sums| {
                least = least.min(sums.samples);
                for layer in &mut layers {
                    let places = [Some(layer.aov), divisor(layer.aov)].map(|aov| aov.and_then(|aov| self.layout.offset(aov)));
                    develop_tile(layer, places, sums, area, self.window.min, width);
                    if let Some(first) = self.layout.catchers {
                        catcher::show(layer, sums, first, self.exposure, [area, self.window]);
                    }
                }
            });
        }
        Image { resolution: self.resolution, window: self.window, layers, samples: if least == u32::MAX { 0 } else { least } }
    }
}

fn empty_layer(aov: Aov, name: &str, pixels: usize) -> Layer {
    let channels = channel_names(aov).len();
    Layer { aov, name: name.to_owned(), values: vec![0.0; pixels * channels], channels }
}

/// A sum of light over the sum of its colour; what has no colour shows none.
fn share(light: f64, colour: f64) -> f64 {
    if colour > 0.0 { light / colour } else { 0.0 }
}

/// Morton number in the tile and number in the window of each pixel of a tile.
pub(super) fn pixels(area: Crop, corner: [u32; 2], width: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..BATCH).filter_map(move |code| {
        let [x, y] = tile_place(code);
        let place = [area.min[0] + x as u32, area.min[1] + y as u32];
        let inside = place[0] < area.max[0] && place[1] < area.max[1];
        inside.then(|| (code, (place[1] - corner[1]) as usize * width + (place[0] - corner[0]) as usize))
    })
}

fn develop_tile(
    layer: &mut Layer,
    [offset, divisor]: [Option<usize>; 2],
    tile: &super::TileFilm,
    area: Crop,
    corner: [u32; 2],
    width: usize,
) {
    let Some(offset) = offset.filter(|_| tile.samples > 0) else { return };
    let index = is_index(layer.aov);
    let scale = if index { 1.0 } else { 1.0 / f64::from(tile.samples) };
    for (code, pixel) in pixels(area, corner, width) {
        for channel in 0..layer.channels {
            let sum = tile.sums[(offset + channel) * BATCH + code];
            let value = match (layer.aov, divisor) {
                (_, Some(divisor)) => share(sum, tile.sums[(divisor + channel) * BATCH + code]),
                // Ids are kept one higher, so that nothing met is −1; indices of hosts start at 0 for nothing.
                (Aov::PrimId, _) => sum - 1.0,
                (_, None) if index => (sum - 1.0).max(0.0),
                (Aov::Mist, _) => 1.0 - sum * scale,
                (Aov::SampleCount, _) => f64::from(tile.samples),
                _ => sum * scale,
            };
            layer.values[pixel * layer.channels + channel] = value as f32;
        }
    }
}
