//! The whole goniogram as one table, for those who look up without knowing of symmetries.

use super::{Goniogram, PhotometricType, Symmetry};

/// Angles closer than this, in degrees, are one.
pub(crate) const SAME: f64 = 1e-6;

/// Intensities on a full, non-uniform grid of two angles.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// Horizontal angles in degrees, increasing; type C: from 0 to 360, both included.
    pub horizontal: Vec<f64>,
    /// Vertical angles in degrees, increasing.
    pub vertical: Vec<f64>,
    /// Intensities in cd: `intensities[h * vertical.len() + v]`.
    pub intensities: Vec<f64>,
}

impl Goniogram {
    /// All planes, by unfolding the symmetry. Type C gets planes from 0 to 360 degrees; types A and B both signs of what is mirrored.
    pub fn expanded(&self) -> Grid {
        if self.photometric_type == PhotometricType::C && self.symmetry == Symmetry::None && self.closed() {
            let (horizontal, vertical) = (self.horizontal.clone(), self.vertical.clone());
            return Grid { horizontal, vertical, intensities: self.intensities.clone() };
        }
        let (horizontal, vertical) = match self.photometric_type {
            PhotometricType::C => (self.all_planes(), self.vertical.clone()),
            _ => self.both_signs(),
        };
        let at = |h: &f64| vertical.iter().map(|v| self.intensity_at(*h, *v)).collect::<Vec<_>>();
        let intensities = horizontal.iter().flat_map(at).collect();
        Grid { horizontal, vertical, intensities }
    }

    /// Whether the planes run from 0 to 360 with both ends stored.
    fn closed(&self) -> bool {
        self.horizontal.first() == Some(&0.0) && self.horizontal.last() == Some(&360.0)
    }

    fn all_planes(&self) -> Vec<f64> {
        let images = |c: &f64| images(*c, self.symmetry);
        let mut planes: Vec<f64> = self.horizontal.iter().flat_map(images).map(|c| c.rem_euclid(360.0)).collect();
        if self.symmetry == Symmetry::Rotational {
            planes.clear();
        }
        planes.extend([0.0, 360.0]);
        sorted(planes)
    }

    fn both_signs(&self) -> (Vec<f64>, Vec<f64>) {
        let mirrored = |angles: &[f64]| sorted(angles.iter().flat_map(|a| [*a, -*a]).collect());
        let (horizontal, vertical) = (&self.horizontal, &self.vertical);
        match self.symmetry {
            Symmetry::None | Symmetry::Rotational => (horizontal.clone(), vertical.clone()),
            Symmetry::AboutC0 => (mirrored(horizontal), vertical.clone()),
            Symmetry::AboutC90 => (horizontal.clone(), mirrored(vertical)),
            Symmetry::Quadrants => (mirrored(horizontal), mirrored(vertical)),
        }
    }
}

/// The C planes in degrees that a symmetry makes equal to `c`, itself among them.
pub(crate) fn images(c: f64, symmetry: Symmetry) -> Vec<f64> {
    match symmetry {
        Symmetry::None | Symmetry::Rotational => vec![c],
        Symmetry::AboutC0 => vec![c, 360.0 - c],
        Symmetry::AboutC90 => vec![c, 180.0 - c],
        Symmetry::Quadrants => vec![c, 360.0 - c, 180.0 - c, 180.0 + c],
    }
}

/// Angles in increasing order, each once.
pub(crate) fn sorted(mut angles: Vec<f64>) -> Vec<f64> {
    angles.sort_by(f64::total_cmp);
    angles.dedup_by(|later, earlier| *later - *earlier < SAME);
    angles
}
