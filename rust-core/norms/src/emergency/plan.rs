//! The file that says where people flee, and what the lamps still give.

use crate::{
    plan::{few, one, read, within},
    vector::distance,
};
use gonio_formats::FormatError;
use serde::Deserialize;

/// What a plan's file says; lengths are metres in the scene's space.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// Light groups that shine in an emergency; with `lights` empty as well all lights of the stage do.
    #[serde(default)]
    pub groups: Vec<String>,
    /// Lights that do: paths of their prims, or of what these lie under.
    #[serde(default)]
    pub lights: Vec<String>,
    /// The least flux over the rated time, as a share of what the stage says.
    #[serde(default = "one")]
    pub flux: f64,
    /// What soiling and ageing leave of the light.
    #[serde(default = "one")]
    pub maintenance_factor: f64,
    /// Height above the floor at which its light is measured.
    #[serde(default = "height")]
    pub height: f64,
    /// Escape routes.
    #[serde(default, rename = "route")]
    pub routes: Vec<Route>,
    /// Open areas.
    #[serde(default, rename = "area")]
    pub areas: Vec<Area>,
    /// Points of emphasis: first aid, alarms, extinguishers.
    #[serde(default, rename = "place")]
    pub places: Vec<Place>,
    /// Degrees from straight down, from which to which luminaires must not dazzle; see [`Plan::glare`].
    pub glare_deg: Option<[f64; 2]>,
}

/// A route of some width along a line on the floor.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Route {
    /// What it is called.
    pub name: String,
    /// Its centre line, corner by corner.
    pub line: Vec<[f64; 3]>,
    /// Its width; the band in its middle that is measured is half of it.
    #[serde(default = "width")]
    pub width: f64,
    /// The greatest distance between points along the line.
    #[serde(default = "spacing")]
    pub spacing: f64,
}

/// An open area, level within its outline.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Area {
    /// What it is called.
    pub name: String,
    /// Its corners, on the floor.
    pub outline: Vec<[f64; 3]>,
    /// What is left out along its edges.
    #[serde(default = "border")]
    pub border: f64,
    /// The distance between points.
    #[serde(default = "spacing")]
    pub spacing: f64,
}

/// A point that must be lit, as on a wall.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Place {
    /// What it is called.
    pub name: String,
    /// Where it is.
    pub position: [f64; 3],
    /// The normal of the plane that is lit.
    pub facing: [f64; 3],
}

fn height() -> f64 {
    0.02
}
fn width() -> f64 {
    2.0
}
fn spacing() -> f64 {
    0.5
}
fn border() -> f64 {
    0.5
}
/// Where ways are level, and where they are not (EN 1838).
const GLARE_DEG: [[f64; 2]; 2] = [[60.0, 90.0], [0.0, 180.0]];
/// Metres that a level way may rise.
const LEVEL: f64 = 0.01;

impl Plan {
    /// Reads a plan.
    ///
    /// # Errors
    /// What is no such TOML, with its line, numbers out of their range, a plan without anything to measure.
    pub fn read(text: &str) -> Result<Self, FormatError> {
        read(text, Self::check)
    }

    /// Degrees from straight down, from which to which luminaires are looked at: where nothing is said all where a route rises, else 60 to 90.
    pub fn glare(&self, up: [f64; 3]) -> [f64; 2] {
        let height = |p: &[f64; 3]| p[0] * up[0] + p[1] * up[1] + p[2] * up[2];
        let rises = |pair: &[[f64; 3]]| (height(&pair[0]) - height(&pair[1])).abs() > LEVEL;
        let usual = GLARE_DEG[usize::from(self.routes.iter().any(|route| route.line.windows(2).any(rises)))];
        self.glare_deg.unwrap_or(usual)
    }

    fn check(&self) -> Result<(), String> {
        if self.routes.is_empty() && self.areas.is_empty() && self.places.is_empty() {
            return Err("nothing to measure, expected [[route]], [[area]] or [[place]]".to_owned());
        }
        within("flux", self.flux, [0.0, 1.0])?;
        within("maintenance_factor", self.maintenance_factor, [0.0, 1.0])?;
        within("height", self.height, [0.0, 3.0])?;
        let [from, to] = self.glare_deg.unwrap_or(GLARE_DEG[0]);
        if !(0.0 <= from && from < to && to <= 180.0) {
            return Err(format!("glare_deg is [{from}, {to}], expected two rising numbers from 0 to 180"));
        }
        self.routes.iter().try_for_each(Route::check)?;
        self.areas.iter().try_for_each(Area::check)?;
        let flat = |place: &&Place| place.facing == [0.0; 3] || !place.facing.iter().chain(&place.position).all(|x| x.is_finite());
        match self.places.iter().find(flat) {
            Some(place) => Err(format!("place '{}': facing and position want numbers, facing other than zero", place.name)),
            None => Ok(()),
        }
    }
}

impl Route {
    fn check(&self) -> Result<(), String> {
        let of = |problem: String| format!("route '{}': {problem}", self.name);
        within("width", self.width, [0.1, 100.0]).map_err(of)?;
        within("spacing", self.spacing, [0.01, 100.0]).map_err(of)?;
        let steps: Vec<f64> = self.line.windows(2).map(|pair| distance(pair[0], pair[1])).collect();
        if steps.is_empty() || !steps.iter().all(|step| *step > 1e-6 && step.is_finite()) {
            return Err(of("line wants two corners at least, each at a place of its own".to_owned()));
        }
        few(steps.iter().sum::<f64>() / self.spacing).map_err(of)
    }
}

impl Area {
    fn check(&self) -> Result<(), String> {
        let of = |problem: String| format!("area '{}': {problem}", self.name);
        within("border", self.border, [0.0, 100.0]).map_err(of)?;
        within("spacing", self.spacing, [0.01, 100.0]).map_err(of)?;
        if self.outline.len() < 3 || !self.outline.iter().flatten().all(|x| x.is_finite()) {
            return Err(of("outline wants three corners at least".to_owned()));
        }
        let size = |axis: usize| {
            let at = || self.outline.iter().map(|corner| corner[axis]);
            (at().fold(f64::MIN, f64::max) - at().fold(f64::MAX, f64::min)) / self.spacing + 1.0
        };
        few(size(0) * size(1) * size(2)).map_err(of)
    }
}
