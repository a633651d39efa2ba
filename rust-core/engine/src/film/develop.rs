//! From sums to an image.

use super::backdrop::Backdrop;
use super::splats::SplatFilm;
use super::{Film, PictureView, ZONES, catcher, channel_names, channels::MOTION_CHANNELS, divisor, is_index, zone_of};
use crate::{
    camera::sampler::{BATCH, TILE, tile_code, tile_place},
    colour::luminance,
    deep::DeepPicture,
    scene::{Aov, Crop, Manifests},
    threads::{available_threads, start},
};
use std::{
    borrow::Cow,
    sync::{Arc, Mutex, PoisonError},
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

/// How a picture is to be placed and shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Pixels at the left, top, right and bottom of the resolution that lie outside the picture proper.
    pub overscan: [u32; 4],
    /// Width of a pixel over its height.
    pub pixel_aspect: f64,
    /// How the rendered window was taken, where that is known.
    pub view: Option<PictureView>,
}

impl Default for Frame {
    fn default() -> Self {
        Self { overscan: [0; 4], pixel_aspect: 1.0, view: None }
    }
}

/// A developed film: the rendered window of an image.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// The whole image's width and height.
    pub resolution: [u32; 2],
    /// The part the layers hold.
    pub window: Crop,
    /// Overscan, the pixels' shape, and how the window was taken.
    pub frame: Frame,
    /// What is seen where no surface is.
    pub backdrop: Backdrop,
    /// The passes.
    pub layers: Vec<Layer>,
    /// Samples a pixel, the least of all.
    pub samples: u32,
    /// Samples a pixel in the mean.
    pub mean_samples: f64,
    /// The names in its mattes.
    pub manifests: Arc<Manifests>,
    /// What lies at which depth, where that was asked for.
    pub deep: Option<Arc<DeepPicture>>,
}

impl Image {
    /// A picture without layers, of which nothing is known but its width and height.
    pub fn empty(size: [usize; 2]) -> Self {
        let resolution = size.map(|side| side as u32);
        Self {
            resolution,
            window: Crop { min: [0; 2], max: resolution },
            frame: Frame::default(),
            backdrop: Backdrop::default(),
            layers: Vec::new(),
            samples: 0,
            mean_samples: 0.0,
            manifests: Arc::default(),
            deep: None,
        }
    }

    /// Width and height of the window.
    pub fn size(&self) -> [usize; 2] {
        [0, 1].map(|axis| (self.window.max[axis] - self.window.min[axis]) as usize)
    }

    /// The layer of a pass.
    pub fn layer(&self, aov: Aov) -> Option<&Layer> {
        self.layers.iter().find(|layer| layer.aov == aov)
    }
}

/// Rows of one tile's height in every layer: what one thread develops at a time.
struct Band<'a> {
    first_tile: usize,
    layers: Vec<&'a mut [f32]>,
}

impl Film {
    /// The means so far, on all cores.
    ///
    /// Depth, normal and position are means over what was covered; alpha tells how much that was.
    pub fn develop(&self) -> Image {
        let [width, height] = [0, 1].map(|axis| (self.window.max[axis] - self.window.min[axis]) as usize);
        let mut layers: Vec<Layer> = self
            .layout
            .aovs
            .iter()
            .zip(&self.names)
            .filter(|(aov, _)| **aov != Aov::Deep)
            .map(|(aov, name)| empty_layer(*aov, name, width * height))
            .collect();
        let aovs: Vec<Aov> = layers.iter().map(|layer| layer.aov).collect();
        let bands = Mutex::new(self.bands(&mut layers, width));
        let next = || bands.lock().unwrap_or_else(PoisonError::into_inner).pop();
        let work = || std::iter::from_fn(next).map(|band| self.develop_band(band, &aovs, width)).reduce(together);
        let samples = std::thread::scope(|scope| {
            let others: Vec<_> = (1..available_threads()).map_while(|_| start(scope, work)).collect();
            let own = work();
            others.into_iter().filter_map(|other| other.join().ok().flatten()).chain(own).reduce(together)
        });
        let (samples, total) = samples.unwrap_or((0, 0));
        let mean_samples = total as f64 / (width * height).max(1) as f64;
        let manifests = self.manifests.clone();
        let colour = layers.iter().find(|layer| layer.aov == Aov::Color);
        let deep = self.plan.deep.zip(colour).map(|(tolerance, colour)| Arc::new(self.develop_deep(tolerance, colour)));
        let (resolution, window, frame) = (self.resolution, self.window, self.frame);
        Image { resolution, window, frame, backdrop: self.backdrop(width), layers, samples, mean_samples, manifests, deep }
    }

    /// What is seen behind surfaces, `width` pixels a row.
    fn backdrop(&self, width: usize) -> Backdrop {
        let Some(channel) = self.layout.holes else { return if self.sky { Backdrop::Sky(Arc::default()) } else { Backdrop::Open } };
        let height = (self.window.max[1] - self.window.min[1]) as usize;
        let mut holes = vec![0.0; width * height];
        for tile in 0..self.tile_count() {
            let area = self.tile_area(tile);
            let size = [0, 1].map(|axis| (area.max[axis] - area.min[axis]) as usize);
            let [left, top] = [0, 1].map(|axis| (area.min[axis] - self.window.min[axis]) as usize);
            self.read(tile, |film| {
                if film.total_samples() == 0 {
                    return;
                }
                let developing = Developing { sums: film.sums.total(self.plan.rules()), samples: film.samples };
                let mut part = Part { rows: &mut holes[top * width..], left, width, size, channels: 1 };
                part.fill(|_, code| developing.sums[channel * BATCH + code] * developing.scale(code));
            });
        }
        Backdrop::Sky(holes.into())
    }

    fn bands<'a>(&self, layers: &'a mut [Layer], width: usize) -> Vec<Band<'a>> {
        let columns = self.columns as usize;
        let mut bands: Vec<Band<'_>> =
            (0..self.tile_count()).step_by(columns.max(1)).map(|first_tile| Band { first_tile, layers: Vec::new() }).collect();
        for layer in layers {
            let rows = layer.values.chunks_mut((width * TILE * layer.channels).max(1));
            bands.iter_mut().zip(rows).for_each(|(band, rows)| band.layers.push(rows));
        }
        bands
    }

    /// Develops a row of tiles; gives the least number of samples of any pixel, and those of all.
    fn develop_band(&self, mut band: Band<'_>, aovs: &[Aov], width: usize) -> (u32, u64) {
        let (mattes, mut ranked) = (self.layout.mattes(), Vec::new());
        let (mut least, mut total) = (u32::MAX, 0);
        for tile in band.first_tile..band.first_tile + self.columns as usize {
            let area = self.tile_area(tile);
            let size = [0, 1].map(|axis| (area.max[axis] - area.min[axis]) as usize);
            let left = (area.min[0] - self.window.min[0]) as usize;
            let corner = [left, (area.min[1] - self.window.min[1]) as usize];
            let splats = self.splats();
            self.read(tile, |film| {
                least = least.min(film.least_samples());
                total += film.total_samples();
                let sums = film.sums.total(self.plan.rules());
                if film.total_samples() == 0 {
                    return;
                }
                let developing = Developing { sums, samples: film.samples };
                for (aov, rows) in aovs.iter().zip(&mut band.layers) {
                    let mut part = Part { rows, left, width, size, channels: channel_names(*aov).len() };
                    if let Aov::Cryptomatte(kind, layer) = aov {
                        let number = mattes.iter().position(|known| known == kind);
                        if let Some(matte) = number.and_then(|number| film.mattes.get(number)) {
                            part.for_each(|code, values| {
                                values.copy_from_slice(&matte.ranks(code, *layer, developing.scale(code), &mut ranked));
                            });
                        }
                        continue;
                    }
                    self.develop_tile(*aov, &developing, &mut part);
                    if let Some(first) = self.layout.catchers {
                        catcher::show(*aov, &developing, first, self.exposure, &mut part);
                    }
                    if let Some(splats) = &splats {
                        self.show_splats(*aov, splats, &developing, corner, &mut part);
                    }
                }
            });
        }
        (least, total)
    }

    /// Adds to the pixels of a tile what light paths brought there; `corner` is the tile's first pixel in the window.
    fn show_splats(&self, aov: Aov, splats: &SplatFilm, tile: &Developing<'_>, corner: [usize; 2], out: &mut Part<'_>) {
        let Some(shown) = splats.shown(aov) else { return };
        let factor = if matches!(aov, Aov::Color | Aov::LightGroup(_) | Aov::LightPaths(..)) { f64::from(self.exposure) } else { 1.0 };
        let divisor = divisor(aov).and_then(|aov| self.layout.offset(aov));
        out.for_each_at(|code, [x, y], values| {
            let light = shown.at([corner[0] + x, corner[1] + y]).map(|x| x * factor);
            if aov == Aov::Luminance {
                values[0] += luminance(light) as f32;
                return;
            }
            for (channel, (value, light)) in values.iter_mut().zip(light).enumerate() {
                *value += match divisor {
                    Some(offset) => share(light, tile.sums[(offset + channel) * BATCH + code] * tile.scale(code)) as f32,
                    None => light as f32,
                };
            }
        });
    }

    fn develop_tile(&self, aov: Aov, tile: &Developing<'_>, part: &mut Part<'_>) {
        let Some(offset) = self.layout.offset(aov) else { return };
        let sum = |channel: usize, code: usize| tile.sums[(offset + channel) * BATCH + code];
        let divisor = divisor(aov).and_then(|aov| self.layout.offset(aov));
        match (aov, divisor) {
            (_, Some(divisor)) => part.fill(|channel, code| share(sum(channel, code), tile.sums[(divisor + channel) * BATCH + code])),
            // Ids are kept one higher, so that nothing met is −1; indices of hosts start at 0 for nothing.
            (Aov::ShadowCatcher, _) => part.fill(|_, _| 1.0),
            // Of what moves alone: the background takes nothing off.
            (Aov::Motion, _) => part.fill(|channel, code| share(sum(channel, code), sum(MOTION_CHANNELS, code))),
            // Blocks bring their seconds; pixels' own, which are not means.
            (Aov::Cost, _) => part.fill(sum),
            (Aov::PrimId | Aov::InstanceId | Aov::ElementId, _) => part.fill(|channel, code| sum(channel, code) - 1.0),
            (_, None) if is_index(aov) => part.fill(|channel, code| (sum(channel, code) - 1.0).max(0.0)),
            (Aov::Mist, _) => part.fill(|channel, code| 1.0 - sum(channel, code) * tile.scale(code)),
            // Pixels that counted their rays themselves know better.
            (Aov::SampleCount, _) => part.fill(|channel, code| sum(channel, code).max(f64::from(tile.samples[zone_of(code)]))),
            _ => part.fill(|channel, code| sum(channel, code) * tile.scale(code)),
        }
    }
}

/// A tile's sums on their way to means.
pub(super) struct Developing<'a> {
    /// Channel after channel, `BATCH` values each.
    pub(super) sums: Cow<'a, [f64]>,
    /// By zone.
    samples: [u32; ZONES],
}

impl Developing<'_> {
    /// What the sums of a pixel are multiplied by.
    pub(super) fn scale(&self, code: usize) -> f64 {
        1.0 / f64::from(self.samples[zone_of(code)].max(1))
    }
}

/// A tile's place in the rows of a layer.
pub(super) struct Part<'a> {
    rows: &'a mut [f32],
    left: usize,
    /// Pixels a row of the layer.
    width: usize,
    /// Pixels of the tile.
    size: [usize; 2],
    channels: usize,
}

impl Part<'_> {
    /// Does something to every pixel of the tile, given its Morton number.
    pub(super) fn for_each(&mut self, mut change: impl FnMut(usize, &mut [f32])) {
        for y in 0..self.size[1] {
            let first = (y * self.width + self.left) * self.channels;
            let row = &mut self.rows[first..first + self.size[0] * self.channels];
            row.chunks_exact_mut(self.channels).enumerate().for_each(|(x, pixel)| change(tile_code([x, y]), pixel));
        }
    }
    /// The same, given its place in the tile too.
    pub(super) fn for_each_at(&mut self, mut change: impl FnMut(usize, [usize; 2], &mut [f32])) {
        self.for_each(|code, pixel| change(code, tile_place(code), pixel));
    }
    /// Sets every pixel of the tile by channel and Morton number.
    fn fill(&mut self, value: impl Fn(usize, usize) -> f64) {
        self.for_each(|code, pixel| pixel.iter_mut().enumerate().for_each(|(channel, out)| *out = value(channel, code) as f32));
    }
}

/// The least and the sum of two parts' samples.
fn together(a: (u32, u64), b: (u32, u64)) -> (u32, u64) {
    (a.0.min(b.0), a.1 + b.1)
}

fn empty_layer(aov: Aov, name: &str, pixels: usize) -> Layer {
    let channels = channel_names(aov).len();
    Layer { aov, name: name.to_owned(), values: vec![0.0; pixels * channels], channels }
}

/// A sum of light over the sum of its colour; what has no colour shows none.
fn share(light: f64, colour: f64) -> f64 {
    if colour > 0.0 { light / colour } else { 0.0 }
}
