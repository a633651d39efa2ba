//! Flat areas with a front, and points on them.

use crate::{
    Spot,
    outline::{edge_distance, extent, is_inside},
    spacing::side_and_spacing,
    vector::{cross, distance, dot, minus, plus, unit},
};

/// Metres before a plane at which its light is measured: desks and walls may lie in it.
const BEFORE: f64 = 0.005;
/// Metres that a corner may lie off the plane of the others.
const FLAT: f64 = 0.01;
/// Part of a length within which two places count as one.
const SLACK: f64 = 1e-9;

/// Cells of a raster, those that count.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Raster {
    /// Cells along and across.
    pub(crate) size: [usize; 2],
    /// Metres from one to the next.
    pub(crate) spacing: [f64; 2],
    /// Their numbers, row by row, and middles.
    pub(crate) cells: Vec<(usize, [f64; 2])>,
}

impl Raster {
    /// Those whose middle holds.
    pub(crate) fn keep(mut self, holds: impl Fn(&[f64; 2]) -> bool) -> Self {
        self.cells.retain(|(_, at)| holds(at));
        self
    }
}

/// A flat outline.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Patch {
    origin: [f64; 3],
    /// Along its first edge, across that, and to its front: unit vectors.
    axes: [[f64; 3]; 3],
    /// Its corners along the first two.
    pub(crate) flat: Vec<[f64; 2]>,
    pub(crate) is_level: bool,
}

impl Patch {
    /// Of corners that run anticlockwise as who looks at it sees them; what lies level looks up however they run. None where they are not flat, or have
    /// no area.
    pub(crate) fn new(corners: &[[f64; 3]], up: [f64; 3]) -> Option<Self> {
        let next = corners.iter().cycle().skip(1);
        let sum =
            corners.iter().zip(next).fold([0.0; 3], |sum, (a, b)| plus(sum, cross(minus(*a, corners[0]), minus(*b, corners[0])), 1.0));
        let mut front = unit(sum)?;
        let is_level = dot(front, up).abs() > 0.5;
        if is_level && dot(front, up) < 0.0 {
            front = front.map(|part| -part);
        }
        let (origin, other) = (corners[0], corners.iter().find(|corner| distance(corners[0], **corner) > SLACK)?);
        let way = minus(*other, origin);
        let along = unit(plus(way, front, -dot(way, front)))?;
        let axes = [along, cross(front, along), front];
        let off = |corner: &[f64; 3]| dot(minus(*corner, origin), front).abs();
        let is_flat = corners.len() > 2 && corners.iter().all(|corner| off(corner) <= FLAT);
        let flat = |corner: &[f64; 3]| [0, 1].map(|k| dot(minus(*corner, origin), axes[k]));
        is_flat.then(|| Self { origin, axes, flat: corners.iter().map(flat).collect(), is_level })
    }

    /// The same `up` metres higher, looking down.
    pub(crate) fn lid(corners: &[[f64; 3]], up: [f64; 3], height: f64) -> Option<Self> {
        let raised: Vec<[f64; 3]> = corners.iter().map(|corner| plus(*corner, up, height)).collect();
        let mut patch = Self::new(&raised, up)?;
        let [_, across, front] = patch.axes;
        (patch.axes[1], patch.axes[2]) = (across.map(|part| -part), front.map(|part| -part));
        patch.flat.iter_mut().for_each(|at| at[1] = -at[1]);
        Some(patch)
    }

    /// The walls on a floor's edges, facing inwards, in the order of its corners.
    pub(crate) fn walls(corners: &[[f64; 3]], up: [f64; 3], height: f64) -> Vec<Self> {
        let next = corners.iter().cycle().skip(1);
        let turn: f64 = corners.iter().zip(next.clone()).map(|(a, b)| dot(cross(minus(*a, corners[0]), minus(*b, corners[0])), up)).sum();
        let wall = |(a, b): (&[f64; 3], &[f64; 3])| {
            // Anticlockwise from above the room lies to the left of each edge: it sees the wall from its end to its start.
            let [from, to] = if turn > 0.0 { [b, a] } else { [a, b] };
            Self::new(&[*from, *to, plus(*to, up, height), plus(*from, up, height)], up)
        };
        corners.iter().zip(next).filter_map(wall).collect()
    }

    /// A place on it, so far before it.
    pub(crate) fn place(&self, [u, v]: [f64; 2], before: f64) -> [f64; 3] {
        plus(plus(plus(self.origin, self.axes[0], u), self.axes[1], v), self.axes[2], before)
    }

    /// Where a place lies on it, seen along its normal.
    pub(crate) fn flattened(&self, place: [f64; 3]) -> [f64; 2] {
        [0, 1].map(|k| dot(minus(place, self.origin), self.axes[k]))
    }

    /// How far a place lies before it.
    pub(crate) fn before(&self, place: [f64; 3]) -> f64 {
        dot(minus(place, self.origin), self.axes[2])
    }

    /// Its light at a place.
    pub(crate) fn spot(&self, at: [f64; 2]) -> Spot {
        Spot::plane(self.place(at, BEFORE), self.axes[2])
    }

    /// Its size, m².
    pub(crate) fn size(&self) -> f64 {
        let twice: f64 = crate::outline::edges(&self.flat).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum();
        twice.abs() / 2.0
    }

    /// Its extent along its two axes.
    pub(crate) fn sides(&self) -> [f64; 2] {
        let [low, high] = extent(&self.flat);
        [high[0] - low[0], high[1] - low[1]]
    }

    /// About how many points it has.
    pub(crate) fn count(&self, spacing: Option<f64>) -> f64 {
        let sides = self.sides();
        let spacing = spacing.unwrap_or_else(|| usual_spacing(sides));
        sides.iter().map(|side| side / spacing + 1.0).product()
    }

    /// Even cells over its extent, which `grow` metres on each side make larger.
    pub(crate) fn raster(&self, grow: f64, spacing: f64) -> Raster {
        let [low, high] = extent(&self.flat);
        let lengths = [0, 1].map(|k| high[k] - low[k] + 2.0 * grow);
        let size = lengths.map(|length| if length > SLACK { (length / spacing).round().max(1.0) as usize } else { 0 });
        let spacing = [0, 1].map(|k| lengths[k] / size[k].max(1) as f64);
        let middle = |cell: usize| [cell % size[0], cell / size[0]].map(|number| number as f64 + 0.5);
        let place = |[u, v]: [f64; 2]| [low[0] - grow + u * spacing[0], low[1] - grow + v * spacing[1]];
        Raster { size, spacing, cells: (0..size[0] * size[1]).map(|cell| (cell, place(middle(cell)))).collect() }
    }

    /// Points within it and off its edges.
    pub(crate) fn points(&self, border: f64, spacing: Option<f64>) -> Raster {
        let inner = self.sides().map(|side| side - 2.0 * border);
        if inner.iter().any(|side| *side <= 0.0) {
            return Raster::default();
        }
        let all = self.raster(-border, spacing.unwrap_or_else(|| usual_spacing(inner)));
        all.keep(|at| self.holds(*at, border))
    }

    /// Whether a place is within it and off its edges.
    pub(crate) fn holds(&self, at: [f64; 2], border: f64) -> bool {
        is_inside(&self.flat, at) && edge_distance(&self.flat, at) >= border - SLACK
    }

    /// Metres from a place to it: 0 within.
    pub(crate) fn distance(&self, at: [f64; 2]) -> f64 {
        if is_inside(&self.flat, at) { 0.0 } else { edge_distance(&self.flat, at) }
    }
}

/// Metres from point to point by EN 12464-1: d over the whole number next to d / p.
pub(crate) fn usual_spacing(sides: [f64; 2]) -> f64 {
    let [d, most] = side_and_spacing(sides);
    d / (d / most).round().max(1.0)
}
