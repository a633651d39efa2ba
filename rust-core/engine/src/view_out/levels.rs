//! Levels of EN 17037 for view out: of points by three criteria, and of areas by what most of their points have.

use super::{View, figures::Layer};

/// Degrees of sight angle, and metres of outside distance, from which on a level is reached: minimum, medium, high (EN 17037:2018, annex A).
const ANGLES_DEG: [f64; 3] = [14.0, 28.0, 54.0];
const DISTANCES_M: [f64; 3] = [6.0, 20.0, 50.0];
/// Share of an area's points that must have what its level asks for.
pub const SHARE: f64 = 0.75;
/// What rounding of sums of steps may lack, and of metres in single precision.
const ROUNDING: f64 = 1e-9;
const ROUNDING_M: f64 = 1e-3;

/// How good a view is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ViewLevel {
    /// Less than the minimum.
    Below,
    /// The least that is recommended.
    Minimum,
    /// Medium.
    Medium,
    /// High.
    High,
}

impl ViewLevel {
    /// Those that may be reached, upwards.
    pub const REACHED: [Self; 3] = [Self::Minimum, Self::Medium, Self::High];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Below => "below the minimum",
            Self::Minimum => "minimum",
            Self::Medium => "medium",
            Self::High => "high",
        }
    }

    /// The greatest whose limit a value reaches.
    fn by(value: f64, limits: [f64; 3]) -> Self {
        let reached = Self::REACHED.into_iter().zip(limits).rev().find(|(_, limit)| value >= *limit);
        reached.map_or(Self::Below, |(level, _)| level)
    }
}

/// What a view is judged by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Criterion {
    /// The horizontal sight angle.
    Angle,
    /// The outside distance.
    Distance,
    /// Which layers are seen.
    Layers,
}

impl Criterion {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Angle, Self::Distance, Self::Layers];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Angle => "sight_angle",
            Self::Distance => "distance",
            Self::Layers => "layers",
        }
    }
}

impl View {
    /// What it reaches by one criterion.
    pub fn level_by(&self, criterion: Criterion) -> ViewLevel {
        match criterion {
            Criterion::Angle => ViewLevel::by(self.sight_angle_deg + ROUNDING, ANGLES_DEG),
            Criterion::Distance => ViewLevel::by(self.distance_m() + ROUNDING_M, DISTANCES_M),
            Criterion::Layers if !self.sees(Layer::Landscape) => ViewLevel::Below,
            Criterion::Layers => ViewLevel::REACHED[[Layer::Sky, Layer::Ground].iter().filter(|layer| self.sees(**layer)).count()],
        }
    }

    /// The least of the three.
    pub fn level(&self) -> ViewLevel {
        Criterion::ALL.map(|criterion| self.level_by(criterion)).into_iter().min().unwrap_or(ViewLevel::Below)
    }
}

/// The views of an area's points together.
#[derive(Clone, Debug, PartialEq)]
pub struct AreaView {
    /// By criterion, the level that at least [`SHARE`] of the points have.
    pub levels: [ViewLevel; 3],
    /// By criterion, which shares of the points reach minimum, medium and high.
    pub shares: [[f64; 3]; 3],
    /// Shares of the points that reach them by all three criteria at once.
    pub shares_of_all: [f64; 3],
    /// Degrees of sight angle and metres of outside distance that at least [`SHARE`] of the points have.
    pub sight_angle_deg: f64,
    /// As the angle.
    pub distance_m: f64,
}

impl AreaView {
    /// Of the views of an area's points.
    pub fn new(views: &[View]) -> Self {
        let by = |criterion| shares(views.iter().map(|view| view.level_by(criterion)).collect());
        let shares_by = Criterion::ALL.map(by);
        Self {
            levels: shares_by.map(reached),
            shares: shares_by,
            shares_of_all: shares(views.iter().map(View::level).collect()),
            sight_angle_deg: had_by_most(views.iter().map(|view| view.sight_angle_deg).collect()),
            distance_m: had_by_most(views.iter().map(View::distance_m).collect()),
        }
    }

    /// The least of the three criteria's.
    pub fn level(&self) -> ViewLevel {
        self.levels.into_iter().min().unwrap_or(ViewLevel::Below)
    }
}

fn shares(levels: Vec<ViewLevel>) -> [f64; 3] {
    let share = |least| levels.iter().filter(|level| **level >= least).count() as f64 / levels.len().max(1) as f64;
    ViewLevel::REACHED.map(share)
}

/// The greatest level that enough points reach.
fn reached(shares: [f64; 3]) -> ViewLevel {
    let level = ViewLevel::REACHED.into_iter().zip(shares).rev().find(|(_, share)| *share >= SHARE - ROUNDING);
    level.map_or(ViewLevel::Below, |(level, _)| level)
}

/// What enough points have or exceed.
fn had_by_most(mut values: Vec<f64>) -> f64 {
    values.sort_unstable_by(|a, b| b.total_cmp(a));
    let count = (SHARE * values.len() as f64 - ROUNDING).ceil() as usize;
    values.get(count.max(1) - 1).copied().unwrap_or(0.0)
}
