//! A road as its file describes it.

use crate::{
    required::{Class, Requirement},
    standard::Standard,
    surface::Surface,
};
use gonio_formats::photometry::Goniogram;
use std::sync::Arc;

/// A straight, level road with its rows of luminaires; lengths in metres, angles in degrees.
#[derive(Clone, Debug)]
pub struct Road {
    /// Width of the carriageway.
    pub carriageway_width: f64,
    /// Lanes of the same width, from the right.
    pub lanes: u32,
    /// How the dry road reflects.
    pub surface: Surface,
    /// How the wet road reflects, if that is known.
    pub wet: Option<Surface>,
    /// Whose way of interpolation is taken.
    pub standard: Standard,
    /// Age of the observer in years, for the threshold increment.
    pub observer_age: f64,
    /// Width of the strips beside and within the carriageway's edges, for the edge illuminance ratio.
    pub edge_strip: f64,
    /// Which luminaires count.
    pub reach: Reach,
    /// Rows of luminaires; at least one.
    pub rows: Vec<Row>,
    /// Areas beside the carriageway.
    pub footpaths: Vec<Footpath>,
    /// What the carriageway's results have to be.
    pub required: Vec<Requirement>,
    /// Classes of which the first that is met is told.
    pub classes: Vec<Class>,
    /// How long in a year the luminaires run at what level; none where energy does not matter.
    pub periods: Vec<Period>,
    /// What may be varied to meet what is required.
    pub ranges: Option<Ranges>,
}

/// How far luminaires are looked for, in mounting heights from the point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach {
    /// For luminance: towards the observer, away from the observer, to each side.
    pub luminance: [f64; 3],
    /// For illuminance: in plan, all around.
    pub illuminance: f64,
}

/// Luminaires of one kind at equal distances.
#[derive(Clone, Debug)]
pub struct Row {
    /// The luminaire's file as the road's file names it.
    pub luminaire: String,
    /// The luminaire's intensities in cd, for the lamps and the tilt of this row.
    pub goniogram: Arc<Goniogram>,
    /// Distance between luminaires along the road.
    pub spacing: f64,
    /// Height of the photometric centre above the road.
    pub height: f64,
    /// How far the photometric centre is inside the carriageway's edge; negative where it is beside the carriageway.
    pub overhang: f64,
    /// How far the side to the carriageway is turned up.
    pub tilt: f64,
    /// Turn about the vertical, anticlockwise seen from above; 180 faces away from the carriageway.
    pub orientation: f64,
    /// C plane of the file that faces the carriageway.
    pub front: f64,
    /// Where the row stands.
    pub side: Side,
    /// Where the first luminaire is along the road.
    pub offset: f64,
    /// Share of the initial light that is left when maintenance is due.
    pub maintenance_factor: f64,
    /// Power of one luminaire in W, if known.
    pub power: Option<f64>,
}

/// Where a row stands, seen by a driver.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// At the left edge.
    Left,
    /// At the right edge.
    Right,
    /// At both edges, luminaires across from each other.
    Opposite,
    /// At both edges, those on the left half a spacing further on.
    Staggered,
}

/// An area beside the carriageway and as long as the field.
#[derive(Clone, Debug)]
pub struct Footpath {
    /// What it is called.
    pub name: String,
    /// Whether it is on the left.
    pub left: bool,
    /// Distance from the carriageway's edge.
    pub distance: f64,
    /// Its width.
    pub width: f64,
    /// What its results have to be.
    pub required: Vec<Requirement>,
}

/// A part of a year's running time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Period {
    /// Hours in a year.
    pub hours: f64,
    /// Power over full power.
    pub level: f64,
}

/// What may be varied, in metres and degrees, from the least to the greatest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ranges {
    /// Spacings of all rows.
    pub spacing: [f64; 2],
    /// Heights of all rows; their own where none.
    pub height: Option<[f64; 2]>,
    /// Tilts of all rows; their own where none.
    pub tilt: Option<[f64; 2]>,
    /// Steps of the first, coarse search.
    pub spacing_step: f64,
    /// The same for heights.
    pub height_step: f64,
    /// The same for tilts.
    pub tilt_step: f64,
}

impl Default for Reach {
    fn default() -> Self {
        Self { luminance: [5.0, 12.0, 5.0], illuminance: 5.0 }
    }
}

impl Side {
    /// The word of the road's file.
    pub fn name(self) -> &'static str {
        match self {
            Self::Left => "left",
            Self::Right => "right",
            Self::Opposite => "opposite",
            Self::Staggered => "staggered",
        }
    }
}

impl Road {
    /// Whether any value is required, of the carriageway or of a path.
    pub fn requires_anything(&self) -> bool {
        !self.required.is_empty() || self.footpaths.iter().any(|path| !path.required.is_empty())
    }

    /// Width of one lane.
    pub fn lane_width(&self) -> f64 {
        self.carriageway_width / f64::from(self.lanes)
    }
}
