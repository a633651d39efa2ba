//! What a road's light comes to. Names in JSON are those of the fields.

use serde::Serialize;

/// Everything that was calculated. Values are maintained unless they are said to be initial; none where they have no meaning, as ratios in the dark.
#[derive(Clone, Debug, Serialize)]
pub struct Results {
    /// The norm whose conventions were taken.
    pub standard: &'static str,
    /// Average luminance in cd/m²: the lowest of all observers.
    pub l_av: f64,
    /// Overall uniformity of luminance: the lowest of all observers.
    pub uo: Option<f64>,
    /// Longitudinal uniformity of luminance: the lowest of all lanes.
    pub ul: Option<f64>,
    /// Overall uniformity of the wet road's luminance.
    pub uo_wet: Option<f64>,
    /// Threshold increment in per cent: the greatest of all observers.
    pub ti: Option<f64>,
    /// Edge illuminance ratio: the lower of both sides.
    pub eir: Option<f64>,
    /// Illuminances of the carriageway.
    #[serde(flatten)]
    pub illuminances: Illuminances,
    /// What the observer in each lane sees, from the right.
    pub observers: Vec<Observed>,
    /// Both edges.
    pub edges: [Edge; 2],
    /// Areas beside the carriageway.
    pub footpaths: Vec<Footing>,
    /// Power and energy, where all luminaires' power is known.
    pub energy: Option<Energy>,
    /// The dry surface.
    pub surface: SurfaceFigures,
    /// The wet surface.
    pub wet_surface: Option<SurfaceFigures>,
    /// Where was calculated.
    pub field: Field,
    /// x of all points.
    pub x: Vec<f64>,
    /// y of points of luminance.
    pub luminance_y: Vec<f64>,
    /// y of points of illuminance.
    pub illuminance_y: Vec<f64>,
    /// Horizontal illuminances of the carriageway in lx, by y and x.
    pub illuminance: Vec<Vec<f64>>,
    /// What was required of the road.
    pub required: Vec<Verdict>,
    /// Whether everything that was required, of paths too, is met; none where nothing was.
    pub met: Option<bool>,
    /// The first of the file's classes that is met.
    pub class: Option<String>,
    /// All classes of the file.
    pub classes: Vec<Classed>,
    /// What a reader should know beside the numbers.
    pub notes: Vec<String>,
}

/// Whether the road meets a class.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Classed {
    /// What it is called.
    pub name: String,
    /// Whether all that it requires is met.
    pub met: bool,
    /// What it requires.
    pub required: Vec<Verdict>,
}

/// Illuminances of an area in lx.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Illuminances {
    /// Average horizontal illuminance.
    pub e_av: f64,
    /// Least horizontal illuminance.
    pub e_min: f64,
    /// Greatest horizontal illuminance.
    pub e_max: f64,
    /// Least over average horizontal illuminance.
    pub u0: Option<f64>,
    /// Average hemispherical illuminance.
    pub e_hs_av: f64,
    /// Least hemispherical illuminance.
    pub e_hs_min: f64,
    /// Least over average hemispherical illuminance.
    pub u0_hs: Option<f64>,
    /// Least semicylindrical illuminance 1.5 m above, facing along the road: the lower of both ways.
    pub e_sc_min: f64,
    /// The same facing with and against the traffic.
    pub e_sc_min_facing: [f64; 2],
    /// Least vertical illuminance 1.5 m above, facing along the road: the lower of both ways.
    pub e_v_min: f64,
    /// The same facing with and against the traffic.
    pub e_v_min_facing: [f64; 2],
}

/// What an observer sees.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Observed {
    /// The lane, counted from the right from 1.
    pub lane: u32,
    /// The eye when luminance is seen, in metres.
    pub position: [f64; 3],
    /// Average luminance in cd/m².
    pub l_av: f64,
    /// Average luminance with new, clean luminaires, in cd/m².
    pub l_av_initial: f64,
    /// Overall uniformity.
    pub uo: Option<f64>,
    /// Longitudinal uniformity of the observer's own lane.
    pub ul: Option<f64>,
    /// Overall uniformity of the wet road.
    pub uo_wet: Option<f64>,
    /// Threshold increment in per cent.
    pub ti: Option<f64>,
    /// The greatest veiling luminance on the way in cd/m², initial.
    pub veiling: f64,
    /// x of the observer at that place.
    pub veiling_x: f64,
    /// Luminances in cd/m², by y and x.
    pub luminance: Vec<Vec<f64>>,
}

/// An edge of the carriageway.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Edge {
    /// `right` or `left`.
    pub side: &'static str,
    /// Average illuminance of the strip beside the carriageway in lx.
    pub outside: f64,
    /// Average illuminance of the strip within the carriageway in lx.
    pub inside: f64,
    /// The first over the second.
    pub ratio: Option<f64>,
}

/// The results of an area beside the carriageway.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Footing {
    /// What it is called.
    pub name: String,
    /// Where it is across the road, in metres.
    pub range: [f64; 2],
    /// Its illuminances.
    #[serde(flatten)]
    pub illuminances: Illuminances,
    /// What was required of it.
    pub required: Vec<Verdict>,
}

/// Power and energy (EN 13201-5).
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Energy {
    /// Power of all luminaires along a kilometre, in W.
    pub power_w_per_km: f64,
    /// Power density indicator in mW/(lx·m²).
    pub pdi: Option<f64>,
    /// Annual energy consumption indicator in kWh/m².
    pub aeci: f64,
}

/// Numbers that describe a surface.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SurfaceFigures {
    /// `lambert`, or the table's file.
    pub name: String,
    /// Mean luminance coefficient in 1/sr.
    pub q0: f64,
    /// Specular factor r(0, 2)/r(0, 0).
    pub s1: Option<f64>,
}

/// The part of the road that is calculated.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Field {
    /// x of its beginning in metres.
    pub start: f64,
    /// Its length in metres.
    pub length: f64,
    /// Mounting height of its luminaires in metres.
    pub height: f64,
    /// Points along it.
    pub along: usize,
    /// Points of luminance across it.
    pub across: usize,
}

/// Whether a required value is met.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Verdict {
    /// Its key.
    pub key: &'static str,
    /// What was required.
    pub required: f64,
    /// Whether that is the most that is allowed, not the least.
    pub at_most: bool,
    /// What was found.
    pub found: Option<f64>,
    /// Whether it is met; what was not found is not.
    pub met: bool,
}
