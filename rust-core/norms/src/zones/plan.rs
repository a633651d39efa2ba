//! The file that says which rooms there are, and where in them people work.

use super::patch::Patch;
use crate::plan::{few, one, read, within};
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
    /// What soiling and ageing leave of the light.
    #[serde(default = "one")]
    pub maintenance_factor: f64,
    /// Rooms.
    #[serde(default, rename = "room")]
    pub rooms: Vec<Room>,
    /// Where people work.
    #[serde(default, rename = "task")]
    pub tasks: Vec<Task>,
}

/// A room of upright walls, all as high.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Room {
    /// What it is called.
    pub name: String,
    /// Corners of its level floor.
    #[serde(default)]
    pub floor: Vec<[f64; 3]>,
    /// In their place a grid or a surface of the stage that covers the floor, by its name or the end of its path.
    pub surface: Option<String>,
    /// From the floor to the ceiling.
    pub height: f64,
    /// What is left out of its floor along walls, and of cylindrical illuminance; without it 15 % of the narrower side, half a metre at most (EN 12464-1).
    pub border: Option<f64>,
    /// How far the background reaches from surrounds.
    #[serde(default = "background")]
    pub background: f64,
    /// Height above the floor of cylindrical illuminance: 1.2 m for those who sit, 1.6 m for those who stand.
    #[serde(default = "eyes")]
    pub eye_height: f64,
    /// The distance between points; without it as EN 12464-1 has it.
    pub spacing: Option<f64>,
}

/// A task area: flat, level or not.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Task {
    /// What it is called.
    pub name: String,
    /// Its corners at its own height, those of what does not lie level anticlockwise as the one who looks at it sees them.
    pub outline: Vec<[f64; 3]>,
    /// What is left out along its edges.
    #[serde(default)]
    pub border: f64,
    /// Width of the band about it in its plane; without it half a metre about level ones, none about others.
    pub surround: Option<f64>,
    /// The room that it is in; without it the first whose walls stand about its middle.
    pub room: Option<String>,
    /// The distance between points; without it as EN 12464-1 has it.
    pub spacing: Option<f64>,
}

/// Metres of the bands about tasks and surrounds (EN 12464-1).
const SURROUND: f64 = 0.5;
fn background() -> f64 {
    3.0
}
fn eyes() -> f64 {
    1.2
}

impl Plan {
    /// Reads a plan.
    ///
    /// # Errors
    /// What is no such TOML, with its line, numbers out of their range, outlines that are not flat, names of rooms that are not there.
    pub fn read(text: &str) -> Result<Self, FormatError> {
        read(text, Self::check)
    }

    /// The same with floors for the surfaces that rooms name.
    ///
    /// # Errors
    /// What `floor_of` says.
    pub fn placed<E>(mut self, floor_of: impl Fn(&str) -> Result<Vec<[f64; 3]>, E>) -> Result<Self, E> {
        for room in &mut self.rooms {
            if let Some(surface) = &room.surface {
                room.floor = floor_of(surface)?;
            }
        }
        Ok(self)
    }

    /// Says what is wrong with numbers and outlines; floors of surfaces are known once the plan is [`placed`](Self::placed).
    ///
    /// # Errors
    /// The first thing that is.
    pub fn check(&self) -> Result<(), String> {
        if self.rooms.is_empty() && self.tasks.is_empty() {
            return Err("nothing to measure, expected [[room]] or [[task]]".to_owned());
        }
        within("maintenance_factor", self.maintenance_factor, [0.0, 1.0])?;
        self.rooms.iter().try_for_each(Room::check)?;
        self.tasks.iter().try_for_each(Task::check)?;
        let unknown = self.tasks.iter().find_map(|task| {
            let room = task.room.as_ref().filter(|room| !self.rooms.iter().any(|known| known.name == **room))?;
            let known: Vec<&str> = self.rooms.iter().map(|room| room.name.as_str()).collect();
            Some(format!("task '{}' is of room '{room}', expected one of {}", task.name, known.join(", ")))
        });
        unknown.map_or(Ok(()), Err)
    }
}

impl Room {
    fn check(&self) -> Result<(), String> {
        let of = |problem: String| format!("room '{}': {problem}", self.name);
        within("height", self.height, [0.1, 1000.0]).map_err(of)?;
        within("border", self.border.unwrap_or(0.0), [0.0, 100.0]).map_err(of)?;
        within("background", self.background, [0.0, 1000.0]).map_err(of)?;
        within("eye_height", self.eye_height, [0.0, self.height]).map_err(of)?;
        match (&self.surface, self.floor.is_empty()) {
            (Some(_), true) => Ok(()),
            (None, true) => Err(of("expected a floor, or the surface that is one".to_owned())),
            _ => check_area("floor", &self.floor, self.spacing).map_err(of),
        }
    }
}

impl Task {
    fn check(&self) -> Result<(), String> {
        let of = |problem: String| format!("task '{}': {problem}", self.name);
        within("border", self.border, [0.0, 100.0]).map_err(of)?;
        within("surround", self.surround.unwrap_or(0.0), [0.0, 100.0]).map_err(of)?;
        check_area("outline", &self.outline, self.spacing).map_err(of)
    }

    /// Width of its surround.
    pub(crate) fn surround(&self, patch: &Patch) -> f64 {
        self.surround.unwrap_or(if patch.is_level { SURROUND } else { 0.0 })
    }
}

fn check_area(name: &str, corners: &[[f64; 3]], spacing: Option<f64>) -> Result<(), String> {
    within("spacing", spacing.unwrap_or(1.0), [0.01, 100.0])?;
    // The way up matters for the front alone.
    let patch = Patch::new(corners, [0.0, 0.0, 1.0]).ok_or_else(|| format!("{name} wants three corners at least that lie in one plane"))?;
    few(patch.count(spacing))
}
