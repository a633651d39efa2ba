//! Finding what glares: pixels above a threshold, gathered into sources.

use super::{
    GlareOptions,
    cluster::{Pixel, clusters},
    coverage::{is_below, weight},
    position_index,
    view::{EyeView, PixelView},
};
use gonio_formats::photometry::NoIndex;
use std::collections::HashMap;

/// From which luminance on a pixel glares.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Threshold {
    /// cd/m².
    Luminance(f64),
    /// Times the mean luminance of the picture.
    TimesMean(f64),
}

/// A source of glare.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GlareSource {
    /// Mean luminance by solid angle, cd/m².
    pub luminance: f64,
    /// Steradians.
    pub solid_angle: f64,
    /// Unit vector to its middle by light: right, up, ahead.
    pub direction: [f64; 3],
    /// Of its middle, for daylight glare.
    pub position_index: f64,
    /// What it brings to the eye, lx on the plane across the line of sight.
    pub illuminance: f64,
}

impl GlareSource {
    /// L² ω.
    pub(crate) fn strength(&self) -> f64 {
        self.luminance.powi(2) * self.solid_angle
    }

    /// CIE 117's weight 1 / p², or why there is none.
    pub(crate) fn weight(&self) -> Result<f64, NoIndex> {
        if self.direction[2] > 0.0 && is_below(self.direction, self.solid_angle) {
            return Err(NoIndex::Below);
        }
        weight(self.direction)
    }

    /// CIE 117's position index, for the unified glare rating; none where the rating leaves the source out.
    pub fn cie_position_index(&self) -> Option<f64> {
        self.weight().ok().map(|weight| weight.sqrt().recip())
    }
}

/// Sums over the pixels of a source.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    light: f64,
    solid_angle: f64,
    direction: [f64; 3],
    illuminance: f64,
}

impl Sums {
    fn add(&mut self, pixel: &PixelView, luminance: f64) {
        let light = luminance * pixel.solid_angle;
        self.light += light;
        self.solid_angle += pixel.solid_angle;
        self.illuminance += light * pixel.direction[2].max(0.0);
        (0..3).for_each(|i| self.direction[i] += light * pixel.direction[i]);
    }
    fn source(&self) -> GlareSource {
        let direction = self.unit_direction();
        GlareSource {
            luminance: self.light / self.solid_angle,
            solid_angle: self.solid_angle,
            direction,
            position_index: position_index(direction),
            illuminance: self.illuminance,
        }
    }
    fn unit_direction(&self) -> [f64; 3] {
        let length = self.direction.iter().map(|x| x * x).sum::<f64>().sqrt().max(f64::MIN_POSITIVE);
        self.direction.map(|x| x / length)
    }
}

/// Sources of at least `threshold` cd/m², as evalglare gathers them. Pixels within half the options' radius of each other are of one source, and so are those
/// that touch. What is as bright as a peak within a source is one of its own. The second value has each pixel's source, from 1, or 0.
pub(super) fn find(luminance: &[f32], view: &EyeView, threshold: f64, options: &GlareOptions) -> (Vec<GlareSource>, Vec<u32>) {
    let [width, _] = view.size();
    let seen = |index: usize| view.pixel([index % width, index / width]);
    let glares: Vec<usize> = (0..luminance.len()).filter(|index| f64::from(luminance[*index]) >= threshold).collect();
    let pixels: Vec<Pixel> = glares.iter().filter_map(|index| seen(*index).map(|view| Pixel { index: *index, view })).collect();
    let of_pixel = clusters(&pixels, width, options.radius, |_| 0);
    let of_pixel = match options.peak {
        Some(peak) => {
            let is_peak = |at: usize| usize::from(f64::from(luminance[pixels[at].index]) >= peak);
            // Peaks of other sources stay apart, and what is left of a source stays one.
            let peaks = clusters(&pixels, width, options.radius, |at| 2 * of_pixel[at] + is_peak(at));
            (0..pixels.len()).map(|at| if is_peak(at) == 1 { [of_pixel[at], 1 + peaks[at]] } else { [of_pixel[at], 0] }).collect()
        }
        None => of_pixel.iter().map(|source| [*source, 0]).collect::<Vec<_>>(),
    };
    let (mut sums, mut number) = (Vec::<Sums>::new(), HashMap::new());
    let mut place = Vec::with_capacity(pixels.len());
    for (pixel, source) in pixels.iter().zip(of_pixel) {
        let at = *number.entry(source).or_insert_with(|| {
            sums.push(Sums::default());
            sums.len() - 1
        });
        sums[at].add(&pixel.view, f64::from(luminance[pixel.index]));
        place.push(at);
    }
    let mut order: Vec<usize> = (0..sums.len()).collect();
    order.sort_by(|a, b| sums[*b].light.total_cmp(&sums[*a].light));
    let mut rank = vec![0; order.len()];
    order.iter().enumerate().for_each(|(rank_of, source)| rank[*source] = rank_of);
    let mut labels = vec![0u32; luminance.len()];
    pixels.iter().zip(place).for_each(|(pixel, source)| labels[pixel.index] = rank[source] as u32 + 1);
    (order.iter().map(|source| sums[*source].source()).collect(), labels)
}
