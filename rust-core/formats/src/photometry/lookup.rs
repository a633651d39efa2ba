//! The intensity in a direction.

use super::{Goniogram, PhotometricType, Symmetry};

/// Slack in degrees at the ends of an axis: directions come with rounding.
const SLACK: f64 = 1e-6;

impl PhotometricType {
    /// Horizontal and vertical angle in degrees of a direction in the luminaire's frame (any length but zero).
    pub fn angles(self, [x, y, z]: [f64; 3]) -> [f64; 2] {
        let degrees = match self {
            // The arc tangent of both keeps its digits at the poles, where the arc cosine loses half of them.
            Self::C => [y.atan2(x), x.hypot(y).atan2(-z)],
            Self::B => [y.atan2(x.hypot(z)), x.atan2(-z)],
            Self::A => [y.atan2(-z), x.atan2(y.hypot(z))],
        };
        degrees.map(f64::to_degrees)
    }

    /// The unit direction of a horizontal and a vertical angle in degrees.
    pub fn direction(self, horizontal: f64, vertical: f64) -> [f64; 3] {
        let ((sin_h, cos_h), (sin_v, cos_v)) = (horizontal.to_radians().sin_cos(), vertical.to_radians().sin_cos());
        match self {
            Self::C => [sin_v * cos_h, sin_v * sin_h, -cos_v],
            Self::B => [sin_v * cos_h, sin_h, -cos_v * cos_h],
            Self::A => [sin_v, cos_v * sin_h, -cos_v * cos_h],
        }
    }
}

impl Goniogram {
    /// The intensity in cd in a direction of the luminaire's frame (−Z is nadir, +X is C0), bilinear in the file's own angles.
    pub fn intensity(&self, direction: [f64; 3]) -> f64 {
        let [horizontal, vertical] = self.photometric_type.angles(direction);
        self.intensity_at(horizontal, vertical)
    }

    /// The intensity in cd at a horizontal and a vertical angle of the file's photometric type, in degrees.
    pub fn intensity_at(&self, horizontal: f64, vertical: f64) -> f64 {
        let [horizontal, vertical] = self.fold(horizontal, vertical);
        let Some((v, t)) = cell(&self.vertical, vertical) else { return 0.0 };
        let along = |h: usize| {
            let lower = self.at(h, v);
            // The neighbour is not touched at a tabulated angle, which keeps its value exact.
            if t == 0.0 { lower } else { lower + t * (self.at(h, v + 1) - lower) }
        };
        let Some((low, high, s)) = self.planes_about(horizontal) else { return 0.0 };
        let lower = along(low);
        if s == 0.0 { lower } else { lower + s * (along(high) - lower) }
    }

    /// Two planes and how far a horizontal angle, already folded, lies from the first to the second.
    fn planes_about(&self, horizontal: f64) -> Option<(usize, usize, f64)> {
        if self.symmetry == Symmetry::Rotational {
            return Some((0, 0, 0.0));
        }
        if let Some((h, s)) = cell(&self.horizontal, horizontal) {
            return Some((h, h + 1, s));
        }
        let circle = self.photometric_type == PhotometricType::C && self.symmetry == Symmetry::None;
        let (first, last) = (self.horizontal.first()?, self.horizontal.last()?);
        let gap = first + 360.0 - last;
        let beyond = (horizontal - last).rem_euclid(360.0);
        (circle && gap > 0.0).then(|| (self.horizontal.len() - 1, 0, (beyond / gap).min(1.0)))
    }

    /// The stored angles that stand for the given ones.
    fn fold(&self, horizontal: f64, vertical: f64) -> [f64; 2] {
        if self.photometric_type == PhotometricType::C {
            return [fold_plane(horizontal, self.symmetry), vertical];
        }
        match self.symmetry {
            Symmetry::None | Symmetry::Rotational => [horizontal, vertical],
            Symmetry::AboutC0 => [horizontal.abs(), vertical],
            Symmetry::AboutC90 => [horizontal, vertical.abs()],
            Symmetry::Quadrants => [horizontal.abs(), vertical.abs()],
        }
    }
}

/// The C plane in degrees that is stored for `c`.
pub(crate) fn fold_plane(c: f64, symmetry: Symmetry) -> f64 {
    let c = c.rem_euclid(360.0);
    let half = |c: f64| if c > 180.0 { 360.0 - c } else { c };
    match symmetry {
        Symmetry::None => c,
        Symmetry::Rotational => 0.0,
        Symmetry::AboutC0 => half(c),
        Symmetry::AboutC90 if c < 90.0 => 180.0 - c,
        Symmetry::AboutC90 if c > 270.0 => 540.0 - c,
        Symmetry::AboutC90 => c,
        Symmetry::Quadrants if half(c) > 90.0 => 180.0 - half(c),
        Symmetry::Quadrants => half(c),
    }
}

/// The index of the cell that holds `angle`, and how far into it the angle lies, 0 to 1; `None` outside.
fn cell(angles: &[f64], angle: f64) -> Option<(usize, f64)> {
    let (first, last) = (*angles.first()?, *angles.last()?);
    if !(angle >= first - SLACK && angle <= last + SLACK) {
        return None;
    }
    let index = angles.partition_point(|a| *a <= angle).saturating_sub(1);
    let Some(next) = angles.get(index + 1) else { return Some((index, 0.0)) };
    let t = (angle - angles[index]) / (next - angles[index]);
    Some((index, t.clamp(0.0, 1.0)))
}
