//! The file that says where people play, and who watches.

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
    /// Light groups that shine; with `lights` empty as well all lights of the stage that have a place do.
    #[serde(default)]
    pub groups: Vec<String>,
    /// Lights that do: paths of their prims, or of what these lie under.
    #[serde(default)]
    pub lights: Vec<String>,
    /// What soiling and ageing leave of the light. Glare is rated by new lamps.
    #[serde(default = "one")]
    pub maintenance_factor: f64,
    /// What the ground sends back of its light, as the glare's background has it: 0.15 to 0.25 for grass (CIE 112).
    #[serde(default = "reflectance")]
    pub reflectance: f64,
    /// Metres for which the steepest change of illuminance is told.
    #[serde(default = "gradient_over")]
    pub gradient_over: f64,
    /// Degrees between directions in which observers look, all around.
    #[serde(default = "step")]
    pub step_deg: f64,
    /// Degrees above the horizon in which they look.
    #[serde(default = "tilt")]
    pub tilt_deg: f64,
    /// Where people play.
    #[serde(rename = "field")]
    pub fields: Vec<Field>,
    /// Towards whom fields are lit.
    #[serde(default, rename = "camera")]
    pub cameras: Vec<Camera>,
    /// Who may be dazzled.
    #[serde(default, rename = "observer")]
    pub observers: Vec<Observer>,
}

/// A level rectangle that is played on.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Field {
    /// What it is called.
    pub name: String,
    /// One of its corners.
    pub corner: [f64; 3],
    /// From there along one side, and along the other.
    pub along: [f64; 3],
    /// See `along`.
    pub across: [f64; 3],
    /// Height above it at which its light is measured.
    #[serde(default)]
    pub height: f64,
    /// Points along and across; without them as EN 12193 has it.
    pub points: Option<[u32; 2]>,
    /// Whether glare is rated at its points as well, at the height of eyes.
    #[serde(default)]
    pub glare: bool,
}

/// Who watches from where, or from so far that the direction alone counts.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Camera {
    /// What it is called.
    pub name: String,
    /// Where it stands.
    pub position: Option<[f64; 3]>,
    /// The direction from the field to it.
    pub facing: Option<[f64; 3]>,
    /// Whether planes are turned up to the camera; else they are upright.
    #[serde(default)]
    pub inclined: bool,
    /// Height of what it films above the field.
    #[serde(default = "eyes")]
    pub height: f64,
    /// The field that it films; without it all of them.
    pub field: Option<String>,
}

/// An eye that looks around.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Observer {
    /// What it is called.
    pub name: String,
    /// Where the eye is.
    pub position: [f64; 3],
    /// The field before whose light it is dazzled; without it the first.
    pub field: Option<String>,
}

/// Metres above the field of eyes, and of what cameras film.
pub(crate) const EYES: f64 = 1.5;

fn eyes() -> f64 {
    EYES
}
fn gradient_over() -> f64 {
    5.0
}
fn reflectance() -> f64 {
    0.25
}
fn step() -> f64 {
    15.0
}
fn tilt() -> f64 {
    -2.0
}

impl Plan {
    /// Reads a plan.
    ///
    /// # Errors
    /// What is no such TOML, with its line, numbers out of their range, names of fields that are not there.
    pub fn read(text: &str) -> Result<Self, FormatError> {
        read(text, Self::check)
    }

    fn check(&self) -> Result<(), String> {
        within("maintenance_factor", self.maintenance_factor, [0.0, 1.0])?;
        within("reflectance", self.reflectance, [0.01, 1.0])?;
        within("gradient_over", self.gradient_over, [0.01, 1000.0])?;
        within("step_deg", self.step_deg, [1.0, 360.0])?;
        within("tilt_deg", self.tilt_deg, [-90.0, 90.0])?;
        if self.fields.is_empty() {
            return Err("nothing to measure, expected [[field]]".to_owned());
        }
        self.fields.iter().try_for_each(Field::check)?;
        self.cameras.iter().try_for_each(Camera::check)?;
        let named = self.cameras.iter().map(|camera| (&camera.name, &camera.field));
        for (name, field) in named.chain(self.observers.iter().map(|observer| (&observer.name, &observer.field))) {
            if let Some(field) = field.as_ref().filter(|field| !self.fields.iter().any(|known| known.name == **field)) {
                let known: Vec<&str> = self.fields.iter().map(|field| field.name.as_str()).collect();
                return Err(format!("'{name}' is of field '{field}', expected one of {}", known.join(", ")));
            }
        }
        match self.observers.iter().find(|observer| !observer.position.iter().all(|x| x.is_finite())) {
            Some(observer) => Err(format!("observer '{}': position wants numbers", observer.name)),
            None => Ok(()),
        }
    }

    /// The field of a name, or the first.
    pub(crate) fn field(&self, name: Option<&String>) -> usize {
        name.and_then(|name| self.fields.iter().position(|field| field.name == *name)).unwrap_or(0)
    }
}

impl Field {
    fn check(&self) -> Result<(), String> {
        let of = |problem: String| format!("field '{}': {problem}", self.name);
        within("height", self.height, [0.0, 100.0]).map_err(of)?;
        let [along, across] = self.sides();
        if !(along > 1e-6 && across > 1e-6 && along.is_finite() && across.is_finite() && self.corner.iter().all(|x| x.is_finite())) {
            return Err(of("corner, along and across want numbers, and sides of some length".to_owned()));
        }
        let dot: f64 = self.along.iter().zip(&self.across).map(|(a, b)| a * b).sum();
        if dot.abs() > 1e-3 * along * across {
            return Err(of("along and across stand at no right angle".to_owned()));
        }
        let [nx, ny] = self.counts();
        if nx == 0 || ny == 0 {
            return Err(of("points want one at least each way".to_owned()));
        }
        few(f64::from(nx) * f64::from(ny)).map_err(of)
    }

    /// Lengths of its sides.
    pub(crate) fn sides(&self) -> [f64; 2] {
        [self.along, self.across].map(|side| distance(side, [0.0; 3]))
    }
}

impl Camera {
    fn check(&self) -> Result<(), String> {
        let of = |problem: &str| Err(format!("camera '{}': {problem}", self.name));
        within("height", self.height, [0.0, 100.0]).or_else(|problem| of(&problem))?;
        match (self.position, self.facing) {
            (Some(_), Some(_)) | (None, None) => of("expected a position, or the direction that faces it"),
            (None, Some([0.0, 0.0, 0.0])) => of("facing is zero"),
            (place, facing) if !place.or(facing).into_iter().flatten().all(f64::is_finite) => of("its place wants numbers"),
            _ => Ok(()),
        }
    }
}
