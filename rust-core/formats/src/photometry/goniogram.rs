//! The data of a goniogram, as plain as the files' own.

use super::Opening;
use crate::{FormatError, spectrum::SpectralPower};
use serde::{Deserialize, Serialize};

/// Luminous intensity of a luminaire by direction, with what its maker says of it.
///
/// Only what a file stores is kept: [`Symmetry`] says how the rest of the sphere follows. Angles are in degrees, strictly increasing;
/// outside of the vertical angles' range the intensity is zero.
#[derive(Clone, Debug, PartialEq)]
pub struct Goniogram {
    /// How the two angles make a direction.
    pub photometric_type: PhotometricType,
    /// How the stored planes stand for all of them.
    pub symmetry: Symmetry,
    /// Horizontal angles (type C: C planes) in degrees, increasing.
    ///
    /// Type C: one for rotational symmetry, 0 to 180 about C0, 90 to 270 about C90, 0 to 90 for quadrants; without symmetry within 0 to
    /// 360, and where 360 is not stored the first plane closes the circle.
    pub horizontal: Vec<f64>,
    /// Vertical angles (type C: γ, 0 at nadir) in degrees, increasing.
    pub vertical: Vec<f64>,
    /// Intensities in cd with all the file's factors applied: `intensities[h * vertical.len() + v]`.
    pub intensities: Vec<f64>,
    /// The luminous opening.
    pub opening: Opening,
    /// Length, width and height of the whole luminaire in metres; width 0 means round; all 0 where the file does not say.
    pub body: [f64; 3],
    /// What the luminaire may be lamped with. The sets are alternatives; there is at least one.
    pub lamp_sets: Vec<LampSet>,
    /// Which of the lamp sets the intensities are for.
    pub lamp_set: usize,
    /// How the lamp's flux follows the luminaire's tilt.
    pub tilt: Option<Tilt>,
    /// Figures that the file states beside the intensities.
    pub stated: Stated,
    /// Texts of the file's head, in its order.
    pub header: Vec<HeaderLine>,
    /// The spectrum of its light, where the file has one.
    pub spectrum: Option<SpectralPower>,
    /// What was repaired or is doubtful, with line numbers.
    pub warnings: Vec<FormatError>,
}

/// The photometric coordinate system (CIE 121, LM-63).
///
/// With x, y, z a direction in the luminaire's frame and nadir at −Z:
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum PhotometricType {
    /// Polar axis −Z: tan C = y/x, cos γ = −z. Interiors and streets.
    #[default]
    C,
    /// Polar axis Y: the vertical angle turns about it, tan V = x/−z; the horizontal angle is sin H = y. Floodlights.
    B,
    /// Polar axis X: the horizontal angle turns about it, tan H = y/−z; the vertical angle is sin V = x. Headlights and signals.
    A,
}

/// How the stored planes stand for all of them, the same for every photometric type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Symmetry {
    /// Everything is stored.
    None,
    /// Type C: one plane stands for all.
    Rotational,
    /// Mirrored at the plane through C0 and C180; types A and B: at horizontal angle 0.
    AboutC0,
    /// Mirrored at the plane through C90 and C270; types A and B: at vertical angle 0.
    AboutC90,
    /// Mirrored at both.
    Quadrants,
}

/// One way of lamping a luminaire.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LampSet {
    /// Number of lamps.
    pub count: u32,
    /// What kind of lamp.
    pub name: String,
    /// Luminous flux of all the set's lamps in lm; `None` where the file gives none.
    pub flux: Option<f64>,
    /// Absolute photometry: the luminaire was measured as a whole, and the flux is its own.
    pub absolute: bool,
    /// Power of the set with its gear in W; 0 where the file does not say.
    pub watts: f64,
    /// Colour appearance or correlated colour temperature, as the file words it.
    pub colour: String,
    /// Colour rendering, as the file words it.
    pub colour_rendering: String,
}

/// The lamp's flux by the luminaire's tilt (LM-63, TILT=).
#[derive(Clone, Debug, PartialEq)]
pub struct Tilt {
    /// How the lamp stands in the luminaire: 1 upright, 2 lying and tilted about its own axis, 3 lying and tilted across it.
    pub lamp_to_luminaire: u32,
    /// Tilt angles in degrees, increasing.
    pub angles: Vec<f64>,
    /// Factor on the intensities at each angle.
    pub factors: Vec<f64>,
}

/// Figures that a file states beside its intensities.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stated {
    /// Light output ratio of the luminaire (LORL), 0 to 1.
    pub light_output_ratio: Option<f64>,
    /// Share of the luminaire's flux that goes below the horizontal (DFF), 0 to 1.
    pub downward_fraction: Option<f64>,
    /// Tilt of the luminaire while it was measured, in degrees.
    pub measurement_tilt: f64,
    /// EULUMDAT's direct ratios for room indices 0.6, 0.8, 1, 1.25, 1.5, 2, 2.5, 3, 4, 5.
    pub direct_ratios: Option<[f64; 10]>,
}

/// A text of a file's head.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct HeaderLine {
    /// LM-63's keyword without brackets (`MANUFAC`, `LUMINAIRE`, `LUMCAT`, `TEST`, …); empty for free text.
    pub keyword: String,
    /// The text.
    pub text: String,
}

impl Goniogram {
    /// The intensity in cd at the `h`-th horizontal and `v`-th vertical angle.
    pub(crate) fn at(&self, h: usize, v: usize) -> f64 {
        self.plane(h).get(v).copied().unwrap_or(0.0)
    }

    /// The `h`-th plane's intensities.
    pub(crate) fn plane(&self, h: usize) -> &[f64] {
        let count = self.vertical.len();
        self.intensities.get(h * count..(h + 1) * count).unwrap_or(&[])
    }

    /// The text of a keyword, if the head has one.
    pub fn text(&self, keyword: &str) -> Option<&str> {
        let line = self.header.iter().find(|line| line.keyword.eq_ignore_ascii_case(keyword));
        line.map(|line| line.text.as_str()).filter(|text| !text.is_empty())
    }

    /// The lamp set that the intensities are for.
    pub fn lamps(&self) -> Option<&LampSet> {
        self.lamp_sets.get(self.lamp_set)
    }

    /// The greatest intensity in cd.
    pub fn peak(&self) -> f64 {
        self.intensities.iter().copied().fold(0.0, f64::max)
    }

    /// The same with every intensity times `factor`.
    #[must_use]
    pub(crate) fn times(mut self, factor: f64) -> Self {
        self.intensities.iter_mut().for_each(|intensity| *intensity *= factor);
        self
    }
}

impl Tilt {
    /// The factor at a tilt in degrees, linear between the angles and constant beyond them.
    pub fn factor(&self, angle: f64) -> f64 {
        let after = self.angles.partition_point(|a| *a <= angle);
        let factor = |index: usize| self.factors.get(index).copied().unwrap_or(1.0);
        let (Some(before), Some(next)) = (after.checked_sub(1), self.angles.get(after)) else {
            return factor(after.saturating_sub(1));
        };
        let t = (angle - self.angles[before]) / (next - self.angles[before]);
        factor(before) * (1.0 - t) + factor(after) * t
    }
}
