//! Glare.

use crate::{
    buffer::side_lengths,
    error::{exception, setting},
    picture::flat,
};
use gonio::{
    film::PictureView,
    measure::glare::{self as engine, EyeView, GlareOptions, Threshold},
};
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
    /// Not among the sources: luminaires behind glass or covers, which are not rated.
    covered: usize,
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
            covered: coverage.covered,
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

/// What a picture says about glare.
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
    /// Daylight glare probability; None where the illuminance at the eye is not known.
    #[getter]
    fn dgp(&self) -> Option<f64> {
        self.found.dgp()
    }
    /// The same with the correction for less than 1000 lx at the eye.
    #[getter]
    fn dgp_low_light(&self) -> Option<f64> {
        self.found.dgp_low_light()
    }
    /// Illuminance at the eye across the line of sight, lx; None where the picture shows less than a hemisphere and nothing was stated.
    #[getter]
    fn eye_illuminance(&self) -> Option<f64> {
        self.found.eye_illuminance
    }
    /// The same by what the picture shows, lx.
    #[getter]
    fn seen_illuminance(&self) -> f64 {
        self.found.seen_illuminance
    }
    /// Share that the picture shows of all that lights the eye, by solid angles times cosines.
    #[getter]
    fn share_seen(&self) -> f64 {
        self.found.seen
    }
    /// Luminance of what is no source, by its illuminance at the eye, cd/m²; where that is not known, its mean in the picture.
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

/// Rates glare in a picture of luminances in cd/m²: a float buffer (height, width) or (height, width, 1), rows from the top. `projection`: perspective,
/// equidistant, equisolid or hemispherical; `fov`: degrees, of a perspective across, of a fisheye all around, 180 unless stated: its circle touches the
/// picture's edges; `threshold`: cd/m² from which on a pixel glares; `radius`: opening angle in radians of the circle within which what glares is of one
/// source; `peak`: cd/m² from which on pixels of a source are one of their own, None for never; `illuminance`: lx at the eye, measured otherwise.
#[pyfunction]
#[pyo3(signature = (luminance, *, projection, fov = None, threshold = 2000.0, radius = 0.2, peak = Some(50_000.0), illuminance = None))]
#[expect(clippy::too_many_arguments, reason = "keywords of Python")]
pub(crate) fn glare(
    py: Python<'_>,
    luminance: &Bound<'_, PyAny>,
    projection: &str,
    fov: Option<f64>,
    threshold: f64,
    radius: f64,
    peak: Option<f64>,
    illuminance: Option<f64>,
) -> PyResult<Glare> {
    let size = side_lengths(luminance, "luminance")?;
    let fov = match fov {
        Some(fov) => fov,
        None if projection == "perspective" => return Err(setting("fov", "a perspective wants its field of view across, degrees")),
        None => 180.0,
    };
    let picture = PictureView::by_name(projection, fov, size[0] as f64 / size[1].max(1) as f64).map_err(exception)?;
    let view = EyeView::new(picture, size).map_err(exception)?;
    let values = flat(luminance, "luminance")?;
    let options = GlareOptions { threshold: Threshold::Luminance(threshold), radius, peak, illuminance };
    let found = py.detach(|| engine::Glare::new(&values, &view, &options));
    Ok(Glare { found: found.map_err(exception)? })
}
