//! From photometric types A and B to type C, for formats that hold no other.

use super::{Goniogram, PhotometricType, Symmetry};

/// The finest step of the new grid in degrees.
const FINEST: f64 = 0.5;

impl Goniogram {
    /// The same luminaire in type C planes. Types A and B are resampled, at most every degree, and scaled to keep their flux.
    #[must_use]
    pub fn to_type_c(&self) -> Self {
        if self.photometric_type == PhotometricType::C {
            return self.clone();
        }
        let (start, span) = match self.symmetry {
            Symmetry::None | Symmetry::Rotational => (0.0, 360.0),
            Symmetry::AboutC0 => (0.0, 180.0),
            Symmetry::AboutC90 => (90.0, 180.0),
            Symmetry::Quadrants => (0.0, 90.0),
        };
        // Nothing is seen above the horizon of a luminaire that was measured in front alone; the step down to nothing is exact there.
        let behind = self.about_axis().iter().any(|angle| angle.abs() > 90.0);
        let vertical = steps(0.0, if behind { 180.0 } else { 90.0 }, self.finest());
        let horizontal = steps(start, span, 2.0 * self.finest());
        let at = |c: &f64| {
            let direction = |gamma: &f64| self.intensity(PhotometricType::C.direction(*c, *gamma));
            vertical.iter().map(direction).collect::<Vec<_>>()
        };
        let intensities = horizontal.iter().flat_map(at).collect();
        let mut resampled = Self { photometric_type: PhotometricType::C, horizontal, vertical, intensities, ..self.clone() };
        let (wanted, found) = (self.flux(), resampled.flux());
        if found > 0.0 {
            resampled = resampled.times(wanted / found);
        }
        resampled
    }

    /// The angles about the polar axis.
    fn about_axis(&self) -> &[f64] {
        if self.photometric_type == PhotometricType::B { &self.vertical } else { &self.horizontal }
    }

    /// The least step of the angles, between half a degree and one.
    fn finest(&self) -> f64 {
        let steps = self.horizontal.windows(2).chain(self.vertical.windows(2)).map(|pair| pair[1] - pair[0]);
        if steps.fold(1.0, f64::min) < 1.0 { FINEST } else { 1.0 }
    }
}

/// Angles from `start` over `span` degrees in whole steps.
fn steps(start: f64, span: f64, step: f64) -> Vec<f64> {
    let count = (span / step).round() as usize;
    (0..=count).map(|index| start + span * index as f64 / count as f64).collect()
}
