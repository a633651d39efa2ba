//! Filters that lie on the face of a rectangle: what it shows of itself.

use super::slide::{Passed, Slide};
use gonio::{scene::Transform, threads::in_pool};
use rayon::prelude::*;

/// Texels each way of a picture on a rectangle.
pub(super) const TEXELS: usize = 512;

/// How much of what a filter lets through counts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Strength {
    /// 0 is no filter.
    pub(super) density: f32,
    /// On what passes.
    pub(super) factor: Passed,
    /// Whether what passes is what did not.
    pub(super) inverted: bool,
}

impl Strength {
    pub(super) fn on(&self, passed: Passed) -> Passed {
        std::array::from_fn(|k| {
            let passed = if self.inverted { 1.0 - passed[k] } else { passed[k] };
            (1.0 + self.density * (passed * self.factor[k] - 1.0)).max(0.0)
        })
    }
}

/// A filter as the light sees it.
#[derive(Clone, Debug)]
pub(super) struct Plane<'a> {
    pub(super) slide: &'a Slide,
    pub(super) strength: Strength,
    /// The light's own space to the filter's.
    pub(super) from_light: Transform,
}

impl Plane<'_> {
    /// What passes at a place in the light's space, which lies on the filter's plane.
    fn on_face(&self, [x, y]: [f64; 2]) -> Passed {
        let [x, y, _] = self.from_light.point([x, y, 0.0]);
        self.strength.on(self.slide.at([x, y]))
    }

    /// Whether the plane is the one that the light's axes x and y span.
    pub(super) fn is_face(&self) -> bool {
        let [x, y, _, middle] = self.from_light.columns;
        [middle[2], x[2], y[2]].iter().all(|z| self.is_small(*z))
    }

    /// Whether the plane goes through the light's middle.
    pub(super) fn is_in_the_middle(&self) -> bool {
        self.is_small(self.from_light.columns[3][2])
    }

    /// Whether a length in the filter's space is nothing beside a unit of the light's.
    fn is_small(&self, length: f64) -> bool {
        let unit = self.from_light.columns[..3].iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
        length.abs() <= 1e-6 * unit
    }
}

/// What filters let through over the face of a rectangle of a size: RGBA rows from the top, as those see it whom it lights.
pub(super) fn picture(planes: &[Plane<'_>], [width, height]: [f64; 2]) -> Vec<f32> {
    let place = |index: usize, size: f64| (0.5 - (index as f64 + 0.5) / TEXELS as f64) * size;
    let texel = |at: usize| {
        let place = [place(at % TEXELS, width), place(at / TEXELS, height)];
        let [r, g, b] = planes.iter().fold([1.0; 3], |all, plane| multiplied(all, plane.on_face(place)));
        [r, g, b, 1.0]
    };
    in_pool(|| (0..TEXELS * TEXELS).into_par_iter().flat_map_iter(texel).collect())
}

fn multiplied(a: Passed, b: Passed) -> Passed {
    std::array::from_fn(|k| a[k] * b[k])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strengths() {
        let half = Strength { density: 0.5, factor: [1.0, 2.0, 0.0], inverted: false };
        assert_eq!(half.on([1.0; 3]), [1.0, 1.5, 0.5]);
        let inverted = Strength { density: 1.0, factor: [1.0; 3], inverted: true };
        assert_eq!(inverted.on([1.0, 0.25, 0.0]), [0.0, 0.75, 1.0]);
    }
}
