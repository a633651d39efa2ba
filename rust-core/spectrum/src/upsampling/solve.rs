//! The coefficients of the table's nodes, by the method of Levenberg and Marquardt.

use super::{REC709_TO_REC2020, Upsampling};
use crate::{
    integral::VISIBLE,
    white::{colour, solved, turned},
};

/// The points of sums, 5 nm apart.
const POINTS: usize = 81;

/// Points that are computed at once, in registers where the processor has wide ones.
const LANES: usize = 4;

/// The largest coefficient of a node: what a sharper spectrum would gain is not seen.
const LARGEST: f64 = 100.0;

/// The most steps of a node.
const STEPS: usize = 24;

/// The error that is small enough, relative to the greatest component.
const ERROR: f64 = 1e-5;

/// A step that changes the squared error by less than this share is the last: no reflectance has the colour.
const GAIN: f64 = 1e-3;

/// Points of the sums.
#[derive(Clone, Copy, Default)]
struct Points {
    /// (nm - 380) / 400.
    t: [f64; LANES],
    /// Their shares of each channel of linear Rec.2020.
    colour: [[f64; LANES]; 3],
}

/// A colour that is asked for.
struct Wanted {
    colour: [f64; 3],
    /// One over its greatest component, by which errors are weighed.
    weight: f64,
    /// One over 2 s (1 - s).
    scale: f64,
}

/// How far a node is from its colour, and the derivatives by its three coefficients.
struct Misfit {
    error: [f64; 3],
    slopes: [[f64; 3]; 3],
}

/// The table of n nodes along an axis.
pub(super) fn table(n: usize) -> Upsampling {
    let points = points();
    let mut table = vec![0.0; 3 * n * n * n * 4];
    for m in 0..3 {
        for y in 0..n {
            for x in 0..n {
                let ratios = [x, y].map(|node| node as f64 / (n - 1) as f64);
                let mut node = |s: usize, start: [f64; 3]| {
                    let found = solve(&points, &wanted(m, place(n, s), ratios), start);
                    let at = 4 * (((m * n + s) * n + y) * n + x);
                    table[at..at + 3].copy_from_slice(&found.map(|value| value as f32));
                    found
                };
                let middle = node(n / 2, grey(place(n, n / 2)));
                let step = 2.0 * (place(n, 1) - place(n, 0));
                (n / 2 + 1..n).fold((middle, [0.0, 0.0, step]), |from, s| onwards(from, |start| node(s, start)));
                (0..n / 2).rev().fold((middle, [0.0, 0.0, -step]), |from, s| onwards(from, |start| node(s, start)));
            }
        }
    }
    Upsampling { resolution: n, table }
}

/// The s of a node.
fn place(n: usize, node: usize) -> f64 {
    let edge = f64::from(Upsampling::EDGE);
    edge + (1.0 - 2.0 * edge) * node as f64 / (n - 1) as f64
}

/// The coefficients of a grey.
fn grey(s: f64) -> [f64; 3] {
    [0.0, 0.0, 2.0 * s - 1.0]
}

/// From a node's coefficients and the step to them, those of the next, which is sought where as long a step leads, and that step. Greys are
/// met exactly.
fn onwards((at, step): ([f64; 3], [f64; 3]), seek: impl FnOnce([f64; 3]) -> [f64; 3]) -> ([f64; 3], [f64; 3]) {
    let found = seek(std::array::from_fn(|k| at[k] + step[k]));
    (found, std::array::from_fn(|k| found[k] - at[k]))
}

/// The colour of a node.
fn wanted(m: usize, s: f64, [x, y]: [f64; 2]) -> Wanted {
    let z = s * s / (s * s + (1.0 - s) * (1.0 - s));
    let mut colour = [z; 3];
    colour[(m + 1) % 3] = x * z;
    colour[(m + 2) % 3] = y * z;
    Wanted { colour, weight: 1.0 / z, scale: 0.5 / (s * (1.0 - s)) }
}

/// The points' colours: those of whole nanometres, shared by the points beside them, so that a reflectance is linear between points.
fn points() -> Vec<Points> {
    let to_rec2020 = REC709_TO_REC2020.map(|row| row.map(f64::from));
    let mut colours = [[0.0; 3]; POINTS];
    let [first, last] = VISIBLE.map(|nm| nm as usize);
    for nm in first..=last {
        let width = if nm == first || nm == last { 0.5 } else { 1.0 };
        let colour = turned(&to_rec2020, colour(nm as f64));
        let [low, part] = [(nm - first) / 5, (nm - first) % 5];
        for (point, share) in [(low, 5 - part), (low + 1, part)] {
            if share > 0 {
                colours[point] = std::array::from_fn(|k| colours[point][k] + width * share as f64 / 5.0 * colour[k]);
            }
        }
    }
    let white = colours.iter().fold([0.0; 3], |sum: [f64; 3], colour| std::array::from_fn(|k| sum[k] + colour[k]));
    let mut points = vec![Points::default(); POINTS.div_ceil(LANES)];
    for (k, colour) in colours.iter().enumerate() {
        let group = &mut points[k / LANES];
        group.t[k % LANES] = k as f64 / (POINTS - 1) as f64;
        for channel in 0..3 {
            group.colour[channel][k % LANES] = colour[channel] / white[channel];
        }
    }
    points
}

/// The coefficients of a colour, times 2 s (1 - s), from those of a colour near it.
fn solve(points: &[Points], wanted: &Wanted, start: [f64; 3]) -> [f64; 3] {
    let mut found = start.map(|value| value.clamp(-LARGEST, LARGEST));
    let mut misfit = error_of(points, wanted, found);
    let mut damping = 1e-6;
    for _ in 0..STEPS {
        if squares(misfit.error) < ERROR * ERROR {
            break;
        }
        let step = step(&misfit, damping);
        let trial: [f64; 3] = std::array::from_fn(|k| (found[k] + step[k]).clamp(-LARGEST, LARGEST));
        let next = error_of(points, wanted, trial);
        let gain = 1.0 - squares(next.error) / squares(misfit.error);
        if gain > 0.0 {
            (found, misfit, damping) = (trial, next, damping * 0.1);
        } else {
            damping *= 10.0;
        }
        if gain.abs() < GAIN {
            break;
        }
    }
    found
}

fn squares(error: [f64; 3]) -> f64 {
    error.iter().map(|error| error * error).sum()
}

/// The step of least squares: of Gauss and Newton, shortened by the damping.
fn step(misfit: &Misfit, damping: f64) -> [f64; 3] {
    let slopes = &misfit.slopes;
    let product = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let mut normal: [[f64; 3]; 3] = std::array::from_fn(|a| std::array::from_fn(|b| product(slopes[a], slopes[b])));
    normal.iter_mut().enumerate().for_each(|(k, row)| row[k] += damping * (row[k] + 1e-9));
    solved(normal, slopes.map(|slope| -product(slope, misfit.error)))
}

/// How far coefficients, times 2 s (1 - s), are from a colour.
fn error_of(points: &[Points], wanted: &Wanted, coefficients: [f64; 3]) -> Misfit {
    let [c0, c1, c2] = coefficients.map(|value| value * wanted.scale);
    let mut sums = [[0.0; LANES]; 3];
    let mut slopes = [[[0.0; LANES]; 3]; 3];
    for Points { t, colour } in points {
        for lane in 0..LANES {
            let t = t[lane];
            let x = (c0 * t + c1) * t + c2;
            let square = 1.0 + x * x;
            let q = square.sqrt();
            // One division serves both.
            let part = 0.5 / (square * q * (q + x.abs()));
            let h = part * square;
            let slope = part * (q + x.abs());
            let reflectance = if x < 0.0 { h } else { 1.0 - h };
            for k in 0..3 {
                let colour = colour[k][lane];
                sums[k][lane] += colour * reflectance;
                slopes[2][k][lane] += colour * slope;
                slopes[1][k][lane] += colour * (slope * t);
                slopes[0][k][lane] += colour * (slope * t * t);
            }
        }
    }
    let total = |lanes: [f64; LANES]| lanes.iter().sum::<f64>();
    let scale = wanted.weight * wanted.scale;
    Misfit {
        error: std::array::from_fn(|k| wanted.weight * (total(sums[k]) - wanted.colour[k])),
        slopes: slopes.map(|slope| slope.map(|lanes| scale * total(lanes))),
    }
}
