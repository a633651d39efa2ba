//! Symmetries that intensities have, and that they can be given.

use super::grid::{images, sorted};
use super::lookup::fold_plane;
use super::{Goniogram, PhotometricType, Symmetry};

impl Goniogram {
    /// The highest symmetry that holds within `tolerance` times the peak; types A and B are never found rotational.
    pub fn symmetry_found(&self, tolerance: f64) -> Symmetry {
        let holds = |symmetry: Symmetry| {
            let averaged = self.symmetrised(symmetry);
            let limit = tolerance * self.peak();
            let grid = self.expanded();
            let points = grid.horizontal.iter().flat_map(|h| grid.vertical.iter().map(move |v| (*h, *v)));
            points.zip(&grid.intensities).all(|((h, v), intensity)| (averaged.intensity_at(h, v) - intensity).abs() <= limit)
        };
        if self.photometric_type == PhotometricType::C && (self.symmetry == Symmetry::Rotational || holds(Symmetry::Rotational)) {
            return Symmetry::Rotational;
        }
        let implied = |symmetry| self.symmetry == symmetry || self.symmetry == Symmetry::Quadrants || holds(symmetry);
        match (implied(Symmetry::AboutC0), implied(Symmetry::AboutC90)) {
            (true, true) => Symmetry::Quadrants,
            (true, false) => Symmetry::AboutC0,
            (false, true) => Symmetry::AboutC90,
            (false, false) => Symmetry::None,
        }
    }

    /// The goniogram with a symmetry, each intensity the mean over what the symmetry makes equal. The flux stays.
    ///
    /// What the goniogram has of symmetry already and `symmetry` does not name is unfolded. Rotational symmetry resamples types A and B
    /// to type C.
    #[must_use]
    pub fn symmetrised(&self, symmetry: Symmetry) -> Self {
        match self.photometric_type {
            _ if symmetry == Symmetry::Rotational => self.to_type_c().averaged(),
            PhotometricType::C => self.mirrored_planes(symmetry),
            _ => self.mirrored_angles(symmetry),
        }
    }

    /// One plane, the mean of all, weighted with the angles they stand for.
    fn averaged(&self) -> Self {
        let weights = self.plane_weights();
        let total: f64 = weights.iter().sum();
        let mean = |v: usize| weights.iter().enumerate().map(|(h, weight)| weight * self.at(h, v)).sum::<f64>() / total;
        let intensities = (0..self.vertical.len()).map(mean).collect();
        Self { symmetry: Symmetry::Rotational, horizontal: vec![0.0], intensities, ..self.clone() }
    }

    fn mirrored_planes(&self, symmetry: Symmetry) -> Self {
        let whole = self.expanded();
        let ends: &[f64] = match symmetry {
            Symmetry::None | Symmetry::Rotational => &[0.0, 360.0],
            Symmetry::AboutC0 => &[0.0, 180.0],
            Symmetry::AboutC90 => &[90.0, 270.0],
            Symmetry::Quadrants => &[0.0, 90.0],
        };
        let folded = whole.horizontal.iter().map(|c| if symmetry == Symmetry::None { *c } else { fold_plane(*c, symmetry) });
        let horizontal = sorted(folded.chain(ends.iter().copied()).collect());
        let mean = |c: f64, v: f64| {
            let images = images(c, symmetry);
            images.iter().map(|image| self.intensity_at(*image, v)).sum::<f64>() / images.len() as f64
        };
        self.tabulated(symmetry, horizontal, whole.vertical, mean)
    }

    fn mirrored_angles(&self, symmetry: Symmetry) -> Self {
        let whole = self.expanded();
        let (about_h, about_v) =
            (matches!(symmetry, Symmetry::AboutC0 | Symmetry::Quadrants), matches!(symmetry, Symmetry::AboutC90 | Symmetry::Quadrants));
        let folded = |angles: Vec<f64>, about: bool| {
            let end = about.then_some(0.0);
            sorted(angles.into_iter().map(|angle| if about { angle.abs() } else { angle }).chain(end).collect())
        };
        let (horizontal, vertical) = (folded(whole.horizontal, about_h), folded(whole.vertical, about_v));
        let mean = |h: f64, v: f64| {
            let horizontals: &[f64] = if about_h { &[h, -h] } else { &[h] };
            let verticals: &[f64] = if about_v { &[v, -v] } else { &[v] };
            let sum: f64 = horizontals.iter().flat_map(|h| verticals.iter().map(|v| self.intensity_at(*h, *v))).sum();
            sum / (horizontals.len() * verticals.len()) as f64
        };
        self.tabulated(symmetry, horizontal, vertical, mean)
    }

    fn tabulated(&self, symmetry: Symmetry, horizontal: Vec<f64>, vertical: Vec<f64>, at: impl Fn(f64, f64) -> f64) -> Self {
        let at = &at;
        let intensities = horizontal.iter().flat_map(|h| vertical.iter().map(move |v| at(*h, *v))).collect();
        Self { symmetry, horizontal, vertical, intensities, ..self.clone() }
    }
}
