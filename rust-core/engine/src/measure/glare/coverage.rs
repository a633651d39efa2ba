//! What a glare rating was made of, and what CIE 117 leaves out of it.

use super::cie_position_index;
use gonio_formats::photometry::NoIndex;
use std::f64::consts::PI;

/// Steradians of the largest source for which the unified glare rating was made (CIE 117).
pub const LARGEST: f64 = 0.1;

/// The sources ahead of an eye that sees them, and those of them for which CIE 117 has no position index, wholly or in part: a rating leaves these out.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Coverage {
    /// All that are ahead and seen.
    pub sources: usize,
    /// Left out: below the line of sight.
    pub below: usize,
    /// Left out: too high for their distance (H/R above 1.9).
    pub high: usize,
    /// Left out: too far aside for their distance (|T/R| above 3).
    pub aside: usize,
    /// Rated, but larger than 0.1 sr, for which the rating was not made.
    pub large: usize,
    /// Not among these: luminaires that the eye sees through glass or a cover alone, which are not rated.
    pub covered: usize,
    /// Illuminance at the eye by all, and by those that are left out, lx.
    pub illuminance: [f64; 2],
}

impl Coverage {
    /// Counts a source by what it has in the place of a position index, if anything; what lies behind the eye does not count.
    pub(crate) fn count(&mut self, left_out: Option<NoIndex>, solid_angle: f64) {
        let place = match left_out {
            Some(NoIndex::Behind) => return,
            Some(NoIndex::Below) => Some(&mut self.below),
            Some(NoIndex::High) => Some(&mut self.high),
            Some(NoIndex::Aside) => Some(&mut self.aside),
            None => (solid_angle > LARGEST).then_some(&mut self.large),
        };
        if let Some(place) = place {
            *place += 1;
        }
        self.sources += 1;
    }

    /// Adds light at the eye, lx, of a source or a part of one.
    pub(crate) fn add_light(&mut self, left_out: Option<NoIndex>, illuminance: f64) {
        match left_out {
            Some(NoIndex::Behind) => {}
            Some(_) => self.illuminance = self.illuminance.map(|light| light + illuminance),
            None => self.illuminance[0] += illuminance,
        }
    }

    /// Sources that are left out.
    pub fn left_out(&self) -> usize {
        self.below + self.high + self.aside
    }

    /// Share of the sources' illuminance at the eye that those bring which are left out, 0 to 1.
    pub fn share_left_out(&self) -> f64 {
        let [all, left_out] = self.illuminance;
        if all > 0.0 { left_out / all } else { 0.0 }
    }

    /// In words; none where all is rated and nothing is too large.
    pub fn note(&self) -> Option<String> {
        let part = |count: usize, reason: &str| (count > 0).then(|| format!("{count} {reason}"));
        let reasons: Vec<String> = [
            part(self.high, "too high (H/R > 1.9)"),
            part(self.aside, "too far aside (T/R > 3)"),
            part(self.below, "below the line of sight"),
        ]
        .into_iter()
        .flatten()
        .collect();
        let percent = 100.0 * self.share_left_out();
        let out = (!reasons.is_empty()).then(|| {
            let reasons = reasons.join(", ");
            format!(
                "{} of {} sources left out (CIE 117): {reasons}; {percent:.0} % of their light at the eye",
                self.left_out(),
                self.sources
            )
        });
        let large = part(self.large, "rated, though larger than 0.1 sr, for which UGR was not made");
        let covered = part(
            self.covered,
            "behind glass or covers of the scene, which are not rated: give luminaires with their covers by IES or EULUMDAT files",
        );
        let all: Vec<String> = [out, large, covered].into_iter().flatten().collect();
        (!all.is_empty()).then(|| all.join("; "))
    }
}

/// Slack in radians for rounding: what is level with the eye.
const LEVEL: f64 = 1e-5;

/// Whether a source with this middle (right, up, ahead; any length) is below the line of sight as a whole: what reaches up to it is rated.
pub(crate) fn is_below([right, up, ahead]: [f64; 3], solid_angle: f64) -> bool {
    up.atan2(right.hypot(ahead)) < -LEVEL - (solid_angle / PI).sqrt()
}

/// CIE 117's weight 1 / p² of a source by its direction in the eye's frame (right, up, ahead), or why it has none. The index of a part under the line of
/// sight is that of its mirror image: whether the source is left out, [`is_below`] says.
pub(crate) fn weight([right, up, ahead]: [f64; 3]) -> Result<f64, NoIndex> {
    cie_position_index([right, up.abs(), ahead]).map(|index| index.powi(-2))
}
