//! Filters of a light as seen from its middle: factors by direction, which a goniogram holds, or over the face of a rectangle.

use super::slide::{Passed, Slide};
use gonio::scene::{Goniogram, PhotometricType, Transform};
use rayon::prelude::*;

/// Intervals of a grid across what a filter shows.
const FINE: usize = 512;
/// Degrees between the lines of a grid where it shows nothing, and where it shows something everywhere.
const COARSE: [f64; 2] = [1.0, 0.5];
/// Degrees between the two lines that stand for a sharp border.
const BORDER: f64 = 2e-3;
/// Samples each way about a line of a grid.
const SAMPLES: usize = 4;
/// Texels each way of a picture on a rectangle.
pub(super) const TEXELS: usize = 512;
/// Factors that differ by less, as parts of the largest, are of one colour.
const SAME: f32 = 1e-4;

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

/// A filter in front of a light.
#[derive(Clone, Debug)]
pub(super) struct Plane<'a> {
    pub(super) slide: &'a Slide,
    pub(super) strength: Strength,
    /// The light's space, with axes a metre long each, to the filter's.
    pub(super) from_light: Transform,
    /// What its axes x and y are in the filter's space as they are, with the light's own units.
    pub(super) face: [[f64; 3]; 2],
}

impl Plane<'_> {
    /// What passes towards a direction in the light's space.
    fn towards(&self, direction: [f64; 3]) -> Passed {
        let ([x, y, z], middle) = (self.from_light.vector(direction), self.middle());
        let distance = -middle[2] / z;
        let passed = if distance > 0.0 && distance.is_finite() {
            self.slide.at([middle[0] + distance * x, middle[1] + distance * y])
        } else {
            self.slide.behind()
        };
        self.strength.on(passed)
    }

    /// What passes at a place in the light's space, which lies on the filter's plane.
    fn on_face(&self, place: [f64; 2]) -> Passed {
        let middle = self.middle();
        let [x, y] = std::array::from_fn(|k| middle[k] + place[0] * self.face[0][k] + place[1] * self.face[1][k]);
        self.strength.on(self.slide.at([x, y]))
    }

    /// Whether the plane is the one that the light's axes x and y span.
    pub(super) fn is_face(&self) -> bool {
        let [x, y, _, middle] = self.from_light.columns;
        [middle[2], x[2], y[2]].iter().all(|z| self.is_small(*z))
    }

    /// Whether the plane goes through the light's middle, from where nothing can be thrown.
    pub(super) fn is_in_the_middle(&self) -> bool {
        *self.slide != Slide::Even && self.is_small(self.middle()[2])
    }

    /// The light's middle in the filter's space.
    fn middle(&self) -> [f64; 3] {
        self.from_light.columns[3]
    }

    /// Whether a length in the filter's space is nothing beside a metre of the light's.
    fn is_small(&self, length: f64) -> bool {
        let metre = self.from_light.columns[..3].iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
        length.abs() <= 1e-6 * metre
    }

    /// The angles that the slide's frame spans; none where it is endless, or is not all in front of the light.
    fn span(&self) -> Option<[[f64; 2]; 2]> {
        let ([low, high], _) = self.slide.frame()?;
        let to_light = self.from_light.inverse()?;
        let mut span = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
        for number in 0..=256 {
            let along = f64::from(number % 64) / 64.0;
            let [x, y] = match number / 64 {
                0 => [low[0] + along * (high[0] - low[0]), low[1]],
                1 => [high[0], low[1] + along * (high[1] - low[1])],
                2 => [high[0] - along * (high[0] - low[0]), high[1]],
                _ => [low[0], high[1] - along * (high[1] - low[1])],
            };
            let [x, y, z] = to_light.point([x, y, 0.0]);
            if z >= 0.0 {
                return None;
            }
            for (span, angle) in span.iter_mut().zip([x.atan2(-z), y.atan2(x.hypot(z))]) {
                *span = [span[0].min(angle.to_degrees()), span[1].max(angle.to_degrees())];
            }
        }
        Some(span)
    }

    /// Whether nothing passes but through the slide's frame.
    fn is_dark_around(&self) -> bool {
        let around = self.slide.frame().map(|(_, around)| around);
        around.is_some_and(|around| [around, self.slide.behind()].into_iter().all(|passed| self.strength.on(passed) == [0.0; 3]))
    }
}

/// Lines of a grid between two angles, close together in a span.
fn lines(whole: [f64; 2], fine: Option<[f64; 2]>) -> Vec<f32> {
    let even = |[first, last]: [f64; 2], count: usize| (0..=count).map(move |i| first + (last - first) * i as f64 / count as f64);
    let found: Vec<f64> = match fine {
        None => even(whole, ((whole[1] - whole[0]) / COARSE[1]).round() as usize).collect(),
        Some([first, last]) if [first, last] == whole => even(whole, FINE).collect(),
        Some([first, last]) => {
            let coarse: Vec<f64> = even(whole, ((whole[1] - whole[0]) / COARSE[0]).round() as usize).collect();
            let before = coarse.iter().copied().filter(|angle| *angle < first - 2.0 * BORDER);
            let after = coarse.iter().copied().filter(|angle| *angle > last + 2.0 * BORDER);
            let inside = even([first, last], FINE);
            before.chain([first - BORDER]).chain(inside).chain([last + BORDER]).chain(after).collect()
        }
    };
    let mut narrow: Vec<f32> = found.into_iter().filter(|angle| (whole[0]..=whole[1]).contains(angle)).map(|angle| angle as f32).collect();
    narrow.dedup();
    narrow
}

/// Where samples about each line of a grid lie: half the way to the next ones.
fn samples(lines: &[f32]) -> Vec<[f64; SAMPLES]> {
    let half = |a: f32, b: f32| 0.5 * (f64::from(a) + f64::from(b));
    let about = |i: usize| {
        let (low, high) = (half(lines[i.saturating_sub(1)], lines[i]), half(lines[i], lines[(i + 1).min(lines.len() - 1)]));
        std::array::from_fn(|k| (low + (high - low) * (k as f64 + 0.5) / SAMPLES as f64).to_radians())
    };
    (0..lines.len()).map(about).collect()
}

/// What filters let through by direction: a colour and a goniogram for each that spreads in its own way.
pub(super) fn goniograms(planes: &[Plane<'_>]) -> Vec<(Passed, Goniogram)> {
    let spans: Vec<_> = planes.iter().filter_map(|plane| Some((plane.span()?, plane.is_dark_around()))).collect();
    let dark = spans.iter().find(|(_, is_dark)| *is_dark);
    let fine = dark.or(spans.first()).map(|(span, _)| *span);
    let whole = match dark {
        Some((span, _)) => *span,
        None => [[-180.0, 180.0], [-90.0, 90.0]],
    };
    let [vertical, horizontal] = [0, 1].map(|k| lines(whole[k], fine.map(|fine| fine[k])));
    if vertical.len() < 2 || horizontal.len() < 2 {
        return Vec::new();
    }
    let (down, across) = (samples(&vertical), samples(&horizontal));
    let mean = |h: &[f64; SAMPLES], v: &[f64; SAMPLES]| {
        let mut sum = [0.0; 3];
        for (h, v) in h.iter().flat_map(|h| v.iter().map(move |v| (h, v))) {
            // Type B: the vertical angle turns about y.
            let direction = [v.sin() * h.cos(), h.sin(), -v.cos() * h.cos()];
            let passed = planes.iter().fold([1.0; 3], |all, plane| multiplied(all, plane.towards(direction)));
            sum = std::array::from_fn(|k| sum[k] + passed[k]);
        }
        sum.map(|x| x / (SAMPLES * SAMPLES) as f32)
    };
    let values: Vec<Passed> = across.par_iter().flat_map_iter(|h| down.iter().map(move |v| mean(h, v))).collect();
    let goniogram = |factors| Goniogram {
        photometric_type: PhotometricType::B,
        horizontal_deg: horizontal.clone(),
        vertical_deg: vertical.clone(),
        factors,
        ..Goniogram::default()
    };
    split(&values).into_iter().map(|(colour, factors)| (colour, goniogram(factors))).collect()
}

/// A goniogram has no colours: those that spread alike are one, others shine in red, green and blue apart.
fn split(values: &[Passed]) -> Vec<(Passed, Vec<f32>)> {
    let most = values.iter().fold([0.0_f32; 3], |most, value| std::array::from_fn(|k| most[k].max(value[k])));
    let scaled = |k: usize| values.iter().map(move |value| if most[k] > 0.0 { value[k] / most[k] } else { 0.0 });
    let lit: Vec<usize> = (0..3).filter(|k| most[*k] > 0.0).collect();
    let Some(&first) = lit.first() else { return Vec::new() };
    if lit.iter().all(|k| scaled(first).zip(scaled(*k)).all(|(a, b)| (a - b).abs() < SAME)) {
        return vec![(most, scaled(first).collect())];
    }
    lit.iter().map(|k| (std::array::from_fn(|other| if other == *k { most[*k] } else { 0.0 }), scaled(*k).collect())).collect()
}

/// What filters let through over the face of a rectangle of a size: RGBA rows from the top, as those see it whom it lights.
pub(super) fn picture(planes: &[Plane<'_>], [width, height]: [f64; 2]) -> Vec<f32> {
    let place = |index: usize, size: f64| (0.5 - (index as f64 + 0.5) / TEXELS as f64) * size;
    let texel = |at: usize| {
        let place = [place(at % TEXELS, width), place(at / TEXELS, height)];
        let [r, g, b] = planes.iter().fold([1.0; 3], |all, plane| multiplied(all, plane.on_face(place)));
        [r, g, b, 1.0]
    };
    (0..TEXELS * TEXELS).into_par_iter().flat_map_iter(texel).collect()
}

fn multiplied(a: Passed, b: Passed) -> Passed {
    std::array::from_fn(|k| a[k] * b[k])
}

#[cfg(test)]
mod tests {
    use super::super::slide::Window;
    use super::*;

    /// A window of 1 × 1 a metre in front of the light.
    fn window(passes_behind: bool) -> Slide {
        Slide::Window(Window { low: [-0.5; 2], high: [0.5; 2], radius: 0.0, edge: 0.0, passes_behind })
    }

    fn plane(slide: &Slide) -> Plane<'_> {
        let strength = Strength { density: 1.0, factor: [1.0; 3], inverted: false };
        let from_light = Transform::translation([0.0, 0.0, 1.0]);
        Plane { slide, strength, from_light, face: [from_light.columns[0], from_light.columns[1]] }
    }

    /// The integral of a goniogram over the sphere, by its cells.
    fn solid_angle(goniogram: &Goniogram) -> f64 {
        let Goniogram { horizontal_deg: h, vertical_deg: v, factors, .. } = goniogram;
        let mut sum = 0.0;
        for (i, h_pair) in h.windows(2).enumerate() {
            let [low, high] = [0, 1].map(|k| f64::from(h_pair[k]).to_radians());
            for (j, v_pair) in v.windows(2).enumerate() {
                let corners = [(i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1)].map(|(i, j)| f64::from(factors[i * v.len() + j]));
                let width = f64::from(v_pair[1] - v_pair[0]).to_radians();
                sum += 0.25 * corners.iter().sum::<f64>() * width * (high.sin() - low.sin());
            }
        }
        sum
    }

    #[test]
    fn a_window_has_its_solid_angle() {
        // A square of side a at a distance d: 4 asin(a² / (a² + 4 d²)).
        let expected = 4.0 * (1.0_f64 / 5.0).asin();
        let slide = window(false);
        let [(colour, goniogram)] = &goniograms(&[plane(&slide)])[..] else { panic!("one colour") };
        assert_eq!(*colour, [1.0; 3]);
        let found = solid_angle(goniogram);
        assert!((found / expected - 1.0).abs() < 2e-3, "{found} {expected}");
    }

    #[test]
    fn light_behind_a_window_is_the_whole_half() {
        let slide = window(true);
        let found = solid_angle(&goniograms(&[plane(&slide)])[0].1);
        let expected = 4.0 * (1.0_f64 / 5.0).asin() + 2.0 * std::f64::consts::PI;
        assert!((found / expected - 1.0).abs() < 5e-3, "{found} {expected}");
    }

    #[test]
    fn strengths() {
        let half = Strength { density: 0.5, factor: [1.0, 2.0, 0.0], inverted: false };
        assert_eq!(half.on([1.0; 3]), [1.0, 1.5, 0.5]);
        let inverted = Strength { density: 1.0, factor: [1.0; 3], inverted: true };
        assert_eq!(inverted.on([1.0, 0.25, 0.0]), [0.0, 0.75, 1.0]);
    }
}
