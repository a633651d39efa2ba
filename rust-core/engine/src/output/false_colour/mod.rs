//! False colour: a quantity in fixed steps, with isolines between them and a legend.

mod canvas;
mod font;
mod scale;

pub use canvas::Canvas;
pub use scale::{FalseColourScale, MOST_STEPS};

use gonio_formats::short_number;

/// What a false-colour picture shows beside the colours.
#[derive(Clone, Debug, PartialEq)]
pub struct FalseColour {
    /// The steps.
    pub scale: FalseColourScale,
    /// The unit's sign, above the legend.
    pub unit: String,
    /// Lines where steps meet.
    pub contours: bool,
    /// Pixels to each side over which values are averaged before lines are drawn: noise makes them ragged.
    pub smoothing: usize,
    /// A strip with the steps' colours and edges at the right.
    pub legend: bool,
}

/// The strip beside the picture, and what is written there.
const PAPER: [u8; 4] = [24, 24, 24, 255];
const INK: [u8; 4] = [235, 235, 235, 255];
/// Pixels of a digit's height, at least and at most.
const TEXT: [usize; 2] = [7, 64];
/// Lines that any legend has room for.
const LEAST_LINES: usize = 5;
/// Isolines over false colour; over pictures they take their steps' colours.
const LINE: [u8; 4] = [0, 0, 0, 255];

impl FalseColour {
    /// Values, rows from the top, as a picture; what is not a number is left transparent.
    pub fn draw(&self, values: &[f32], size: [usize; 2]) -> Canvas {
        let mut canvas = Canvas::new(size, [0; 4]);
        for (pixel, value) in canvas.rgba.chunks_exact_mut(4).zip(values) {
            if let Some(step) = self.scale.step(*value) {
                let [r, g, b] = self.scale.colour(step);
                pixel.copy_from_slice(&[r, g, b, 255]);
            }
        }
        if self.contours {
            self.contours(values, size, |at, _| canvas.set(at, LINE));
        }
        self.finish(canvas)
    }

    /// Isolines in their steps' colours over a picture of the same size.
    pub fn draw_over(&self, values: &[f32], mut canvas: Canvas) -> Canvas {
        let size = canvas.size;
        self.contours(values, size, |at, step| {
            let [r, g, b] = self.scale.colour(step);
            canvas.set(at, [r, g, b, 255]);
        });
        self.finish(canvas)
    }

    /// Calls `line` with every pixel whose right or lower neighbour lies in another step, and the higher of both.
    fn contours(&self, values: &[f32], [width, height]: [usize; 2], mut line: impl FnMut([usize; 2], usize)) {
        let smooth = smoothed(values, [width, height], self.smoothing);
        let steps: Vec<Option<usize>> = smooth.iter().map(|value| self.scale.step(*value)).collect();
        for y in 0..height {
            for x in 0..width {
                let Some(here) = steps[y * width + x] else { continue };
                let right = (x + 1 < width).then(|| steps[y * width + x + 1]).flatten();
                let below = (y + 1 < height).then(|| steps[(y + 1) * width + x]).flatten();
                if let Some(other) = [right, below].into_iter().flatten().find(|other| *other != here) {
                    line([x, y], here.max(other));
                }
            }
        }
    }

    /// The picture with its legend.
    fn finish(&self, picture: Canvas) -> Canvas {
        if !self.legend {
            return picture;
        }
        let strip = self.legend(picture.size[1]);
        let mut canvas = Canvas::new([picture.size[0] + strip.size[0], strip.size[1]], PAPER);
        canvas.put(&picture, [0, 0]);
        canvas.put(&strip, [picture.size[0], 0]);
        canvas
    }

    /// The legend for a picture of a height, at least as tall as its unit and two edges want.
    pub fn legend(&self, height: usize) -> Canvas {
        let labels: Vec<String> = self.scale.edges().iter().map(|edge| short_number(f64::from(*edge))).collect();
        // A twenty-sixth of the picture, less where there are many steps.
        let text = (height / 26).min(height * 2 / (3 * (labels.len() + 2))).clamp(TEXT[0], TEXT[1]);
        let widest = labels.iter().chain([&self.unit]).map(|label| Canvas::text_size(label, text)[0]).max().unwrap_or(0);
        let (margin, swatch, line) = (text * 2 / 3, text * 3 / 2, text * 3 / 2);
        let mut canvas = Canvas::new([3 * margin + swatch + widest, height.max(LEAST_LINES * line)], PAPER);
        canvas.write(&self.unit, [margin, margin], text, INK);
        let (top, steps) = (margin + 2 * line, self.scale.steps());
        let room = canvas.size[1].saturating_sub(top + line);
        let edge = |step: usize| top + room * (steps - step) / steps;
        for step in 0..steps {
            let [r, g, b] = self.scale.colour(step);
            canvas.fill([margin, edge(step + 1)], [swatch, edge(step) - edge(step + 1)], [r, g, b, 255]);
        }
        // Both ends are named, and what stands evenly between them without touching.
        let every = (1..=steps).find(|every| steps.is_multiple_of(*every) && room * every >= steps * text * 5 / 4).unwrap_or(steps);
        for (step, label) in labels.iter().enumerate().step_by(every) {
            canvas.write(label, [2 * margin + swatch, edge(step).saturating_sub(text / 2)], text, INK);
        }
        canvas
    }
}

/// Means over squares of `radius` pixels to each side, held to the picture; what is not a number stays so and counts nowhere.
fn smoothed(values: &[f32], [width, height]: [usize; 2], radius: usize) -> Vec<f32> {
    if radius == 0 {
        return values.to_vec();
    }
    // A wider one holds the whole picture too, and would not count on.
    let radius = radius.min(width.max(height));
    // Along rows, then along columns, with running sums.
    let along = |values: &[[f64; 2]], count: usize, stride: usize, start: usize, out: &mut [[f64; 2]]| {
        let (mut sum, mut next) = ([0.0; 2], 0);
        for i in 0..count {
            while next < count && next <= i + radius {
                (0..2).for_each(|c| sum[c] += values[start + next * stride][c]);
                next += 1;
            }
            if i > radius {
                (0..2).for_each(|c| sum[c] -= values[start + (i - radius - 1) * stride][c]);
            }
            out[start + i * stride] = sum;
        }
    };
    let known: Vec<[f64; 2]> = values.iter().map(|v| if v.is_finite() { [f64::from(*v), 1.0] } else { [0.0; 2] }).collect();
    let (mut rows, mut both) = (known.clone(), known.clone());
    (0..height).for_each(|y| along(&known, width, 1, y * width, &mut rows));
    (0..width).for_each(|x| along(&rows, height, width, x, &mut both));
    values.iter().zip(both).map(|(v, [sum, count])| if v.is_finite() { (sum / count.max(1.0)) as f32 } else { *v }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plain(max: f32, steps: u32) -> FalseColour {
        let scale = FalseColourScale::new(max, steps, None).expect("a scale");
        FalseColour { scale, unit: "lx".into(), contours: false, smoothing: 0, legend: false }
    }

    #[test]
    fn values_take_their_steps_colours() {
        let picture = plain(500.0, 5);
        let canvas = picture.draw(&[0.0, 99.9, 100.0, 499.0, 500.0, 1e9, f32::NAN, -3.0], [8, 1]);
        let steps = [0, 0, 1, 4, 4, 4];
        for (pixel, step) in canvas.rgba.chunks_exact(4).zip(steps) {
            assert_eq!(pixel[..3], picture.scale.colour(step));
        }
        assert_eq!(canvas.rgba[27], 0, "not a number is transparent");
        assert_eq!(canvas.rgba[28..31], picture.scale.colour(0));
    }

    #[test]
    fn scales_have_even_or_logarithmic_edges() {
        assert_eq!(FalseColourScale::new(500.0, 5, None).expect("even").edges(), [0.0, 100.0, 200.0, 300.0, 400.0, 500.0]);
        let log = FalseColourScale::new(1000.0, 3, Some(3.0)).expect("logarithmic");
        for (edge, expected) in log.edges().iter().zip([1.0, 10.0, 100.0, 1000.0]) {
            assert!((edge / expected - 1.0).abs() < 1e-5, "{edge}");
        }
        for wrong in [
            FalseColourScale::new(0.0, 5, None),
            FalseColourScale::new(f32::NAN, 5, None),
            FalseColourScale::new(1.0, 0, None),
            FalseColourScale::new(1.0, 5, Some(-1.0)),
        ] {
            assert!(wrong.is_err());
        }
        assert_eq!(FalseColourScale::around(&[3012.0, f32::NAN, 3390.0], 4).edges(), [3000.0, 3100.0, 3200.0, 3300.0, 3400.0]);
        assert_eq!(FalseColourScale::around(&[-0.003, 0.0008], 4).edges(), [-0.003, -0.002, -0.001, 0.0, 0.001]);
        assert_eq!(FalseColourScale::around(&[80.0; 3], 4).edges().len(), 2);
        assert_eq!([0.9, 430.0, 1000.0].map(|high| FalseColourScale::round_max(&[high; 7])), [1.0, 500.0, 1000.0]);
    }

    #[test]
    fn contours_lie_where_steps_meet() {
        // A ramp of 1 a column: steps of 4 meet behind columns 3 and 7.
        let values: Vec<f32> = (0..3).flat_map(|_| (0..12u8).map(f32::from)).collect();
        let picture = FalseColour { contours: true, ..plain(12.0, 3) };
        let canvas = picture.draw(&values, [12, 3]);
        let black = |x: usize| canvas.rgba[4 * (12 + x)..4 * (12 + x) + 3] == [0, 0, 0];
        assert_eq!((0..12).filter(|x| black(*x)).collect::<Vec<_>>(), [3, 7]);
    }

    #[test]
    fn smoothing_keeps_even_ramps_and_takes_noise_away() {
        let ramp: Vec<f32> = (0..64).map(|i| (i % 8) as f32).collect();
        let smooth = smoothed(&ramp, [8, 8], 1);
        assert!((1..7).all(|x| (smooth[8 + x] - x as f32).abs() < 1e-6));
        let spike: Vec<f32> = (0..25).map(|i| if i == 12 { 9.0 } else { 0.0 }).collect();
        assert!((smoothed(&spike, [5, 5], 1)[12] - 1.0).abs() < 1e-6);
        assert!(smoothed(&spike, [5, 5], usize::MAX).iter().all(|mean| (mean - 9.0 / 25.0).abs() < 1e-6));
    }

    #[test]
    fn the_legend_stands_at_the_right() {
        let picture = FalseColour { legend: true, ..plain(500.0, 5) };
        let canvas = picture.draw(&vec![250.0; 320 * 240], [320, 240]);
        assert!(canvas.size[0] > 320 && canvas.size[1] == 240, "{:?}", canvas.size);
        let colours: std::collections::HashSet<_> = canvas.rgba.chunks_exact(4).map(|p| [p[0], p[1], p[2]]).collect();
        assert!((0..5).all(|step| colours.contains(&picture.scale.colour(step))));
    }

    #[test]
    fn legends_leave_small_pictures_their_size() {
        let tenths = FalseColour { legend: true, ..plain(500.0, 10) };
        for (size, most) in [([160, 120], 48), ([64, 64], 48), ([640, 480], 110)] {
            let canvas = tenths.draw(&vec![250.0; size[0] * size[1]], size);
            assert!(canvas.size[1] == size[1] && canvas.size[0] - size[0] <= most, "{size:?}: {:?}", canvas.size);
        }
    }
}
