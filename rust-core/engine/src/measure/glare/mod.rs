//! Glare from a picture of luminances: UGR and DGP, and the sources that cause it.

mod cluster;
mod coverage;
mod source;
mod view;

#[cfg(test)]
mod tests;

pub use coverage::{Coverage, LARGEST};
pub use gonio_annual::position_index;
pub use gonio_formats::photometry::position_index as cie_position_index;
pub use source::{GlareSource, Threshold};
pub use view::{EyeView, PixelView};

pub(crate) use coverage::{is_below, weight};

use crate::error::{Error, Result};
use std::f64::consts::PI;

/// How sources are told from what surrounds them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GlareOptions {
    /// From which luminance on a pixel glares.
    pub threshold: Threshold,
    /// Opening angle of the circle about a pixel, radians, within which what glares is of one source: evalglare's search radius.
    pub radius: f64,
    /// Luminance in cd/m² from which on pixels of a source are one of their own, as the sun's disk in a window: evalglare's peak extraction; none without.
    pub peak: Option<f64>,
    /// Illuminance at the eye across the line of sight, lx, where it was measured otherwise; pictures of less than a hemisphere do not tell it.
    pub illuminance: Option<f64>,
}

impl Default for GlareOptions {
    /// As evalglare 3 does where nothing is said: from 2000 cd/m² on, 0.2 radians, peaks from 50,000 cd/m² on.
    fn default() -> Self {
        Self { threshold: Threshold::Luminance(2000.0), radius: 0.2, peak: Some(50_000.0), illuminance: None }
    }
}

impl GlareOptions {
    /// Refuses thresholds, radii and illuminances that are none.
    fn check(&self) -> Result<()> {
        let (Threshold::Luminance(threshold) | Threshold::TimesMean(threshold)) = self.threshold;
        if !(threshold >= 0.0 && threshold.is_finite()) {
            return Err(Error::setting("threshold", format!("{threshold} was found, expected a number not below 0")));
        }
        if !(0.0..=PI).contains(&self.radius) {
            return Err(Error::setting("radius", format!("{} was found, expected radians from 0 to π", self.radius)));
        }
        for (name, value) in [("peak", self.peak), ("illuminance", self.illuminance)] {
            if let Some(value) = value.filter(|value| !(*value > 0.0 && value.is_finite())) {
                return Err(Error::setting(name, format!("{value} was found, expected a number above 0")));
            }
        }
        Ok(())
    }
}

/// What a picture says about glare.
#[derive(Clone, Debug, PartialEq)]
pub struct Glare {
    /// The sources, those with the most light first.
    pub sources: Vec<GlareSource>,
    /// Each pixel's source, from 1, or 0.
    pub source_of: Vec<u32>,
    /// Luminance from which on pixels glared, cd/m².
    pub threshold: f64,
    /// Mean luminance of the picture by solid angle, cd/m².
    pub mean_luminance: f64,
    /// Illuminance across the line of sight by what the picture shows, lx.
    pub seen_illuminance: f64,
    /// Share that the picture shows of all that lights the eye, by solid angles times cosines: 1 for a hemisphere and more.
    pub seen: f64,
    /// Illuminance at the eye across the line of sight, lx: as stated, or by the picture; none where it shows less than a hemisphere.
    pub eye_illuminance: Option<f64>,
    /// Luminance of what is no source: its illuminance at the eye over π, cd/m². Where the illuminance is not known, the mean over what the picture shows.
    pub background_luminance: f64,
}

impl Glare {
    /// Finds the sources in luminances (cd/m², rows from the top). Values that are not finite or below 0 count as 0.
    ///
    /// # Errors
    /// Another number of values than the view has pixels, or none, or options that are none.
    pub fn new(luminance: &[f32], view: &EyeView, options: &GlareOptions) -> Result<Self> {
        let [width, height] = view.size();
        if luminance.len() != width * height {
            return Err(Error::setting("luminance", format!("{} values were found, expected {width} × {height}", luminance.len())));
        }
        if luminance.is_empty() {
            return Err(Error::setting("luminance", "the picture has no pixels"));
        }
        options.check()?;
        let known: Vec<f32> = luminance.iter().map(|value| if value.is_finite() { value.max(0.0) } else { 0.0 }).collect();
        let (mut light, mut solid_angle, mut seen_illuminance, mut projected) = (0.0, 0.0, 0.0, 0.0);
        for (index, value) in known.iter().enumerate() {
            if let Some(pixel) = view.pixel([index % width, index / width]) {
                let own = f64::from(*value) * pixel.solid_angle;
                light += own;
                solid_angle += pixel.solid_angle;
                seen_illuminance += own * pixel.direction[2].max(0.0);
                projected += pixel.solid_angle * pixel.direction[2].max(0.0);
            }
        }
        if solid_angle <= 0.0 {
            return Err(Error::setting("fov", "nothing of the picture lies within the field of view"));
        }
        let whole = view.covers_hemisphere();
        let eye_illuminance = options.illuminance.or(whole.then_some(seen_illuminance));
        let mean_luminance = light / solid_angle;
        let threshold = match options.threshold {
            Threshold::Luminance(luminance) => luminance,
            Threshold::TimesMean(factor) => factor * mean_luminance,
        };
        // Everything would glare in the dark.
        let (sources, source_of) = source::find(&known, view, threshold.max(f64::MIN_POSITIVE), options);
        let of_sources: f64 = sources.iter().map(|source| source.illuminance).sum();
        let background_luminance = match eye_illuminance {
            Some(illuminance) => (illuminance - of_sources).max(0.0) / PI,
            None => (seen_illuminance - of_sources).max(0.0) / projected.max(f64::MIN_POSITIVE),
        };
        let seen = if whole { 1.0 } else { (projected / PI).min(1.0) };
        Ok(Self { sources, source_of, threshold, mean_luminance, seen_illuminance, seen, eye_illuminance, background_luminance })
    }

    /// Unified glare rating (CIE 117): 8 log₁₀(0.25 / L_b Σ L² ω / p²) over the sources that have a position index there. None without such sources, or where
    /// all but the sources is black.
    pub fn ugr(&self) -> Option<f64> {
        let rated = self.sources.iter().filter_map(|source| Some(source.strength() * source.weight().ok()?));
        let sum: f64 = rated.sum();
        (sum > 0.0 && self.background_luminance > 0.0).then(|| 8.0 * (0.25 / self.background_luminance * sum).log10())
    }

    /// What the unified glare rating leaves out.
    pub fn coverage(&self) -> Coverage {
        let mut coverage = Coverage::default();
        for source in &self.sources {
            let left_out = source.weight().err();
            coverage.count(left_out, source.solid_angle);
            coverage.add_light(left_out, source.illuminance);
        }
        coverage
    }

    /// Daylight glare probability ([`gonio_annual::dgp`]). Made for 380 lx and more at the eye and values from 0.2 to 0.8. None where the illuminance at the eye
    /// is not known.
    pub fn dgp(&self) -> Option<f64> {
        self.eye_illuminance.map(|illuminance| gonio_annual::dgp(illuminance, self.weighted_sum()))
    }

    /// The same with Wienold's correction for little light.
    pub fn dgp_low_light(&self) -> Option<f64> {
        self.eye_illuminance.map(|illuminance| gonio_annual::dgp_low_light(illuminance, self.weighted_sum()))
    }

    /// Σ L² ω / P² over the sources before the eye.
    fn weighted_sum(&self) -> f64 {
        let ahead = self.sources.iter().filter(|source| source.direction[2] > 0.0);
        ahead.map(|source| source.strength() / source.position_index.powi(2)).sum()
    }
}
