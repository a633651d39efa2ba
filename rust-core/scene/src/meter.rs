//! Where light is measured: meters at points, and calculation grids.

use super::{Eyes, MeshId, Origin, Transform};
use serde::{Deserialize, Serialize};

/// What is measured.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Measurand {
    /// Of a plane, lx: E = ∫ L cos θ dω over the normal's hemisphere.
    #[default]
    Illuminance,
    /// Mean over the curved surface of a small cylinder about the normal, lx: (1/π) ∫ L sin θ dω (EN 12464-1).
    Cylindrical,
    /// The same of the half that faces `facing`, lx: (1/π) ∫ L sin θ (1 + cos φ) dω (EN 13201-3).
    Semicylindrical,
    /// Illuminance by domes alone over that of level ground under nothing else than them, per cent.
    DaylightFactor,
    /// Towards `facing`, cd/m².
    Luminance,
    /// Melanopic equivalent daylight illuminance at an eye that looks along `facing`, lx (CIE S 026): by wavelengths, so lamps want spectra.
    MelanopicEdi,
    /// Correlated colour temperature of what a plane gets, K (CIE 15).
    Cct,
    /// Its signed distance from the blackbodies in the CIE 1960 diagram, positive above them (greenish).
    Duv,
    /// Colour rendering by it (CIE 13.3): lamps want spectra.
    Ra,
    /// Colour fidelity (TM-30-20): lamps want spectra.
    Rf,
    /// Gamut (TM-30-20): lamps want spectra.
    Rg,
    /// Of the luminaires' glare, as an eye rates it that looks along `facing` and stands upright along `normal`; without a unit (CIE 117).
    Ugr,
}

impl Measurand {
    /// All with their names.
    pub const NAMES: [(Self, &'static str); 12] = [
        (Self::Illuminance, "illuminance"),
        (Self::Cylindrical, "cylindrical"),
        (Self::Semicylindrical, "semicylindrical"),
        (Self::DaylightFactor, "daylight-factor"),
        (Self::Luminance, "luminance"),
        (Self::MelanopicEdi, "melanopic-edi"),
        (Self::Cct, "cct"),
        (Self::Duv, "duv"),
        (Self::Ra, "ra"),
        (Self::Rf, "rf"),
        (Self::Rg, "rg"),
        (Self::Ugr, "ugr"),
    ];

    /// Those that say something of the light's spectrum and not how much there is.
    pub const OF_COLOUR: [Self; 5] = [Self::Cct, Self::Duv, Self::Ra, Self::Rf, Self::Rg];

    /// The name.
    pub fn name(self) -> &'static str {
        Self::NAMES.iter().find(|(known, _)| *known == self).map_or("", |(_, name)| name)
    }
    /// What has the name.
    pub fn by_name(name: &str) -> Option<Self> {
        Self::NAMES.iter().find(|(_, known)| *known == name).map(|(measurand, _)| *measurand)
    }
    /// The unit's sign.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Illuminance | Self::Cylindrical | Self::Semicylindrical | Self::MelanopicEdi => "lx",
            Self::DaylightFactor => "%",
            Self::Luminance => "cd/m²",
            Self::Cct => "K",
            Self::Duv | Self::Ra | Self::Rf | Self::Rg | Self::Ugr => "",
        }
    }
    /// Whether it is one of [`Self::OF_COLOUR`].
    pub fn is_of_colour(self) -> bool {
        Self::OF_COLOUR.contains(&self)
    }
    /// Whether the colour of a lamp does not tell it.
    pub fn wants_spectra(self) -> bool {
        matches!(self, Self::MelanopicEdi | Self::Ra | Self::Rf | Self::Rg)
    }
    /// Whether eyes have it, which look their own ways: what the plane before them gets.
    pub fn is_of_eyes(self) -> bool {
        self.is_of_colour() || matches!(self, Self::Illuminance | Self::MelanopicEdi)
    }
    /// Whether it is how much light there is, in parts of which its evenness can be told.
    pub fn is_amount(self) -> bool {
        !self.is_of_colour() && self != Self::Ugr
    }
}

/// A measurement at one point.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Meter {
    /// Where it came from.
    pub origin: Origin,
    /// World space, metres.
    pub position: [f64; 3],
    /// The plane's normal, the cylinder's axis, or the way up of an observer; any length.
    pub normal: [f64; 3],
    /// Where half a cylinder, a luminance meter or an observer faces; any length. Cylinders take what stands across their axis of it.
    pub facing: [f64; 3],
    /// What is measured.
    pub measurand: Measurand,
}

impl Default for Meter {
    /// A level luxmeter at the origin, facing +y.
    fn default() -> Self {
        Self {
            origin: Origin::default(),
            position: [0.0; 3],
            normal: [0.0, 0.0, 1.0],
            facing: [0.0, 1.0, 0.0],
            measurand: Measurand::default(),
        }
    }
}

/// The surface that a grid measures.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum GridArea {
    /// A parallelogram, world space, metres; its normal is the first edge × the second.
    Rectangle {
        /// Where both edges start.
        corner: [f64; 3],
        /// The edges: along a row, and from row to row.
        edges: [[f64; 3]; 2],
    },
    /// What a mesh of the scene covers, seen along its mean normal, whether or not the mesh is shown.
    Mesh {
        /// Which.
        mesh: MeshId,
        /// Local to world, metres.
        transform: Transform,
    },
}

/// A calculation grid: points at the middles of equal cells.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Grid {
    /// Where it came from.
    pub origin: Origin,
    /// What it covers.
    pub area: GridArea,
    /// Metres from point to point, about: cells fill the area evenly. 0 is that of EN 12464-1.
    pub spacing: f64,
    /// Metres along the area's edges that are left out.
    pub margin: f64,
    /// Metres by which the points lie above the area, along its normal.
    pub height: f64,
    /// As a meter's.
    pub facing: [f64; 3],
    /// Where eyes at the points look; the area's plane is measured without any.
    pub eyes: Option<Eyes>,
    /// What is measured.
    pub measurand: Measurand,
}

impl Default for Grid {
    /// A square metre of level ground.
    fn default() -> Self {
        Self {
            origin: Origin::default(),
            area: GridArea::Rectangle { corner: [0.0; 3], edges: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]] },
            spacing: 0.0,
            margin: 0.0,
            height: 0.0,
            facing: [0.0, 1.0, 0.0],
            eyes: None,
            measurand: Measurand::default(),
        }
    }
}
