//! Finding what glares: pixels above a threshold, gathered into sources.

use super::{
    coverage::{is_below, weight},
    position::position_index,
    view::FisheyeView,
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
    fn add(&mut self, other: &Self) {
        self.light += other.light;
        self.solid_angle += other.solid_angle;
        self.illuminance += other.illuminance;
        (0..3).for_each(|i| self.direction[i] += other.direction[i]);
    }
    fn unit_direction(&self) -> [f64; 3] {
        let length = self.direction.iter().map(|x| x * x).sum::<f64>().sqrt().max(f64::MIN_POSITIVE);
        self.direction.map(|x| x / length)
    }
}

/// Sources of at least `threshold` cd/m². Pixels that touch, also by a corner, are one source, and so are sources whose middles lie within `radius`
/// radians of a brighter one's; the second value has each pixel's source, from 1, or 0.
pub(super) fn find(luminance: &[f32], view: &FisheyeView, threshold: f64, radius: f64) -> (Vec<GlareSource>, Vec<u32>) {
    let [width, _] = view.size();
    let (mut labels, count) = connected(luminance, view, threshold);
    let mut sums = vec![Sums::default(); count];
    for (index, label) in labels.iter().enumerate().filter(|(_, label)| **label > 0) {
        let Some(pixel) = view.pixel([index % width, index / width]) else { continue };
        let light = f64::from(luminance[index]) * pixel.solid_angle;
        let own = Sums {
            light,
            solid_angle: pixel.solid_angle,
            direction: pixel.direction.map(|x| x * light),
            illuminance: light * pixel.direction[2].max(0.0),
        };
        sums[*label as usize - 1].add(&own);
    }
    let (merged, place) = merge(&sums, radius);
    labels.iter_mut().filter(|label| **label > 0).for_each(|label| *label = place[*label as usize - 1] as u32 + 1);
    let source = |sums: &Sums| GlareSource {
        luminance: sums.light / sums.solid_angle,
        solid_angle: sums.solid_angle,
        direction: sums.unit_direction(),
        position_index: position_index(sums.unit_direction()),
        illuminance: sums.illuminance,
    };
    (merged.iter().map(source).collect(), labels)
}

/// Labels of connected pixels from 1, and how many there are.
fn connected(luminance: &[f32], view: &FisheyeView, threshold: f64) -> (Vec<u32>, usize) {
    let [width, height] = view.size();
    let glares = |index: usize| f64::from(luminance[index]) >= threshold && view.pixel([index % width, index / width]).is_some();
    let mut labels = vec![0u32; width * height];
    let (mut count, mut waiting) = (0, Vec::new());
    for start in 0..width * height {
        if labels[start] != 0 || !glares(start) {
            continue;
        }
        count += 1;
        labels[start] = count;
        waiting.push(start);
        while let Some(index) = waiting.pop() {
            let (x, y) = (index % width, index / width);
            for near_y in y.saturating_sub(1)..(y + 2).min(height) {
                for near_x in x.saturating_sub(1)..(x + 2).min(width) {
                    let near = near_y * width + near_x;
                    if labels[near] == 0 && glares(near) {
                        labels[near] = count;
                        waiting.push(near);
                    }
                }
            }
        }
    }
    (labels, count as usize)
}

/// Gathers sources by their middles, those with the most light first; gives each one's new place.
fn merge(sums: &[Sums], radius: f64) -> (Vec<Sums>, Vec<usize>) {
    let mut order: Vec<usize> = (0..sums.len()).collect();
    order.sort_by(|a, b| sums[*b].light.total_cmp(&sums[*a].light));
    let (mut middles, mut merged, mut place) = (Vec::<[f64; 3]>::new(), Vec::<Sums>::new(), vec![0; sums.len()]);
    // Cells about as wide as the radius: only near middles are compared.
    let width = radius.max(1e-3);
    let cell = |v: [f64; 3]| v.map(|x| (x / width).floor() as i32);
    let mut cells: HashMap<[i32; 3], Vec<usize>> = HashMap::new();
    for index in order {
        let direction = sums[index].unit_direction();
        let [x, y, z] = cell(direction);
        let around = (0..27).map(|i| [x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1]);
        let near = around.filter_map(|cell| cells.get(&cell)).flatten().copied();
        let cosine = |other: usize| (0..3).map(|i| middles[other][i] * direction[i]).sum::<f64>();
        match near.filter(|other| cosine(*other) > radius.cos()).min() {
            Some(other) => {
                merged[other].add(&sums[index]);
                place[index] = other;
            }
            None => {
                place[index] = merged.len();
                cells.entry(cell(direction)).or_default().push(merged.len());
                middles.push(direction);
                merged.push(sums[index]);
            }
        }
    }
    (merged, place)
}
