//! What the rays of an eye come to: sight angle, outside distance, layers.

use super::{View, fan::Fan};

/// Metres that stand for a distance without an end, and the greatest that is told: about as far as somebody who sits sees land.
pub const FARTHEST_M: f64 = 5000.0;

/// What is seen outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layer {
    /// What nothing stands before, above the horizon.
    Sky,
    /// Buildings, trees, all that is neither sky nor ground.
    Landscape,
    /// What one could walk on.
    Ground,
}

impl Layer {
    /// All of them, with their names.
    pub const NAMES: [(Self, &str); 3] = [(Self::Sky, "sky"), (Self::Landscape, "landscape"), (Self::Ground, "ground")];
}

/// Where a ray ends that goes out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Outside {
    pub(super) layer: Layer,
    /// Metres from the opening, across it, to what stands in the way; infinite where that is nothing.
    pub(super) distance_m: f64,
    /// Whether it went through no pane.
    pub(super) by_hole: bool,
    /// Whether it met nothing.
    pub(super) is_open: bool,
}

impl View {
    /// By the rays of a fan, azimuth by azimuth; none where a ray does not go out.
    pub(super) fn new(position: [f64; 3], fan: &Fan, ends: &[Option<Outside>]) -> Self {
        let count = fan.elevations.len();
        let mut layers_sr = [0.0; 3];
        let mut level = Vec::with_capacity(fan.azimuths);
        for of_azimuth in ends.chunks(count) {
            for (elevation, end) in of_azimuth.iter().enumerate() {
                if let Some(end) = end {
                    layers_sr[end.layer as usize] += fan.solid_angle(elevation);
                }
            }
            level.push(of_azimuth.iter().flatten().next().map(|end| end.distance_m.min(FARTHEST_M)));
        }
        let width = fan.width().to_degrees();
        let mut distances: Vec<f64> = level.iter().copied().flatten().collect();
        distances.sort_unstable_by(f64::total_cmp);
        let met_nothing = |layer| ends.iter().flatten().any(|end| end.is_open && end.layer == layer);
        Self {
            position,
            sight_angle_deg: distances.len() as f64 * width,
            widest_deg: longest_run(&level) as f64 * width,
            distances_m: quartiles(&distances),
            layers_sr,
            by_hole: ends.iter().flatten().any(|end| end.by_hole),
            has_open_horizon: met_nothing(Layer::Sky) && met_nothing(Layer::Ground),
        }
    }

    /// The median of the distances; 0 without a view.
    pub fn distance_m(&self) -> f64 {
        self.distances_m.map_or(0.0, |[_, _, median, _, _]| median)
    }

    /// Whether any ray ends at a layer.
    pub fn sees(&self, layer: Layer) -> bool {
        self.layers_sr[layer as usize] > 0.0
    }
}

/// Least, lower quartile, median, upper quartile and greatest of values in their order, each one of them; none of none.
fn quartiles(sorted: &[f64]) -> Option<[f64; 5]> {
    let last = sorted.len().checked_sub(1)?;
    Some([0, 1, 2, 3, 4].map(|quarter| sorted[quarter * last / 4]))
}

/// The longest run of azimuths with a view; the last is the first one's neighbour.
fn longest_run(level: &[Option<f64>]) -> usize {
    let mut longest = 0;
    let mut run = 0;
    for end in level.iter().chain(level) {
        run = if end.is_some() { run + 1 } else { 0 };
        longest = longest.max(run);
    }
    longest.min(level.len())
}
