//! Glare.

use crate::{
    buffer::side_lengths,
    error::{exception, setting},
    picture::flat,
};
use gonio::measure::glare::{self as engine, FisheyeProjection, FisheyeView, GlareOptions, Threshold};
use pyo3::prelude::*;

/// The sources ahead of an eye that sees them, and those that a unified glare rating leaves out, since CIE 117 has no position index for them.
#[pyclass(frozen, get_all, module = "gonio")]
pub(crate) struct Coverage {
    /// All that are ahead and seen.
    sources: usize,
    /// Those of them that are left out.
    left_out: usize,
    /// Left out: H/R above 1.9.
    high: usize,
    /// Left out: |T/R| above 3.
    aside: usize,
    /// Left out: below the line of sight.
    below: usize,
    /// Rated, but larger than 0.1 sr, for which the rating was not made.
    large: usize,
    /// Share of the sources' illuminance at the eye that is left out, 0 to 1.
    share_left_out: f64,
    /// The same in words; None where all is rated.
    note: Option<String>,
}

impl Coverage {
    pub(crate) fn of(coverage: &engine::Coverage) -> Self {
        Self {
            sources: coverage.sources,
            left_out: coverage.left_out(),
            high: coverage.high,
            aside: coverage.aside,
            below: coverage.below,
            large: coverage.large,
            share_left_out: coverage.share_left_out(),
            note: coverage.note(),
        }
    }
}

/// A source of glare.
#[pyclass(frozen, get_all, module = "gonio")]
pub(crate) struct GlareSource {
    /// cd/m².
    luminance: f64,
    /// Steradians.
    solid_angle: f64,
    /// Unit vector from the eye: right, up, ahead.
    direction: (f64, f64, f64),
    /// Of daylight glare: Guth's above the line of sight, Iwata's below.
    position_index: f64,
    /// Of the unified glare rating (CIE 117); None where it leaves the source out.
    cie_position_index: Option<f64>,
    /// What it brings to the eye, lx.
    illuminance: f64,
}

/// What a fisheye picture says about glare.
#[pyclass(frozen, module = "gonio")]
pub(crate) struct Glare {
    found: engine::Glare,
}

#[pymethods]
impl Glare {
    /// Unified glare rating; None without sources ahead, or where all but them is black.
    #[getter]
    fn ugr(&self) -> Option<f64> {
        self.found.ugr()
    }
    /// What the unified glare rating leaves out.
    #[getter]
    fn coverage(&self) -> Coverage {
        Coverage::of(&self.found.coverage())
    }
    /// Daylight glare probability.
    #[getter]
    fn dgp(&self) -> f64 {
        self.found.dgp()
    }
    /// The same with the correction for less than 1000 lx at the eye.
    #[getter]
    fn dgp_low_light(&self) -> f64 {
        self.found.dgp_low_light()
    }
    /// Illuminance at the eye across the line of sight, lx.
    #[getter]
    fn eye_illuminance(&self) -> f64 {
        self.found.eye_illuminance
    }
    /// Luminance of what is no source, by its illuminance at the eye, cd/m².
    #[getter]
    fn background_luminance(&self) -> f64 {
        self.found.background_luminance
    }
    /// Luminance from which on pixels glared, cd/m².
    #[getter]
    fn threshold(&self) -> f64 {
        self.found.threshold
    }
    /// The sources, those with the most light first.
    #[getter]
    fn sources(&self) -> Vec<GlareSource> {
        let source = |source: &engine::GlareSource| GlareSource {
            luminance: source.luminance,
            solid_angle: source.solid_angle,
            direction: source.direction.into(),
            position_index: source.position_index,
            cie_position_index: source.cie_position_index(),
            illuminance: source.illuminance,
        };
        self.found.sources.iter().map(source).collect()
    }
}

/// Rates glare in a fisheye picture of luminances in cd/m²: a float buffer (height, width) or (height, width, 1), rows from the top, whose circle touches
/// its edges. `projection`: equidistant, equisolid or hemispherical; `fov`: degrees; `threshold`: cd/m² from which on a pixel glares, five times the
/// mean without it; `radius`: radians within which sources count as one.
#[pyfunction]
#[pyo3(signature = (luminance, *, projection = "equidistant", fov = 180.0, threshold = None, radius = 0.2))]
pub(crate) fn glare(
    py: Python<'_>,
    luminance: &Bound<'_, PyAny>,
    projection: &str,
    fov: f64,
    threshold: Option<f64>,
    radius: f64,
) -> PyResult<Glare> {
    let expected = || FisheyeProjection::NAMES.map(|(_, name)| name).join(", ");
    let problem = || setting("projection", format!("'{projection}' was found, expected one of {}", expected()));
    let projection = FisheyeProjection::by_name(projection).ok_or_else(problem)?;
    let view = FisheyeView::new(projection, fov, side_lengths(luminance, "luminance")?).map_err(exception)?;
    let values = flat(luminance, "luminance")?;
    let threshold = threshold.map_or(GlareOptions::default().threshold, Threshold::Luminance);
    let found = py.detach(|| engine::Glare::new(&values, &view, &GlareOptions { threshold, radius }));
    Ok(Glare { found: found.map_err(exception)? })
}
