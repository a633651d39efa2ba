//! Disability glare: the threshold increment.

use crate::{
    line::{Line, dot, sin_cos},
    luminance::EYE,
    results::Field,
};

/// Degrees by which the line of sight points down.
const DOWN: f64 = 1.0;
/// Degrees of elevation from which on a car's roof screens luminaires.
const SCREEN: f64 = 20.0;
/// How far before the field the first observer stands, over the luminaires' height above the eye.
const BEFORE: f64 = 2.75;
/// Metres from the observer up to which luminaires count.
const FARTHEST: f64 = 500.0;
/// Degrees off the line of sight between which formulas of veiling luminance hold (EN 13201-3; CIE 146 for the smaller angles).
const SMALLEST: f64 = 0.1;
const SMALL: f64 = 1.5;
const LARGE: f64 = 60.0;

/// Luminances in cd/m² between which the first formula of the threshold increment holds.
const DIM: f64 = 0.05;
const BRIGHT: f64 = 5.0;

/// The greatest veiling luminance in cd/m², of initial light, on an observer's way along a field, and where the observer is then.
pub(crate) fn veiling(lines: &[Line<'_>], field: &Field, y: f64, age: f64) -> [f64; 2] {
    let first = field.start - BEFORE * (field.height - EYE);
    let places = (0..field.along).map(|index| first + index as f64 * field.step());
    let at = |x: f64| lines.iter().map(|line| of_line(line, [x, y, EYE], age)).sum();
    places.map(|x| [at(x), x]).fold([0.0, first], |best, found| if found[0] > best[0] { found } else { best })
}

/// Veiling luminance by one line's luminaires ahead.
fn of_line(line: &Line<'_>, eye: [f64; 3], age: f64) -> f64 {
    let [sin, cos] = sin_cos(DOWN);
    let above = line.row.height - EYE;
    let ahead = line.between(eye[0], eye[0] + FARTHEST).filter(|at| at - eye[0] > 0.0);
    let seen = ahead.filter(|at| above.atan2(at - eye[0]).to_degrees() <= SCREEN);
    seen.map(|at| {
        let ray = line.ray(at, eye);
        let towards = dot(ray.to, [cos, 0.0, -sin]) / ray.square.sqrt();
        let angle = towards.clamp(-1.0, 1.0).acos().to_degrees();
        ray.intensity / ray.square * towards * scattered(angle, age)
    })
    .sum()
}

/// Veiling luminance over the illuminance at the eye, by the angle off the line of sight and the observer's age in years.
fn scattered(angle: f64, age: f64) -> f64 {
    if angle > LARGE || angle <= SMALLEST {
        0.0
    } else if angle > SMALL {
        9.86 / angle.powi(2) * (1.0 + (age / 66.4).powi(4))
    } else {
        10.0 / angle.powi(3) + 5.0 / angle.powi(2) * (1.0 + (age / 62.5).powi(4))
    }
}

/// The threshold increment in per cent; none on a road that is darker than the formulas hold for.
pub(crate) fn increment(veiling: f64, average: f64) -> Option<f64> {
    if average > BRIGHT { Some(95.0 * veiling / average.powf(1.05)) } else { (average > DIM).then(|| 65.0 * veiling / average.powf(0.8)) }
}
