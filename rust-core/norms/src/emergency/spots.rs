//! Where light is measured.

use super::plan::{Area, Plan, Route};
use crate::{
    Spot,
    outline::{edge_distance, is_inside},
    vector::{cross, distance, minus},
};

/// Parts of the central band's width across which points lie, from its middle.
const ACROSS: [f64; 5] = [0.0, -0.25, -0.125, 0.125, 0.25];

impl Plan {
    /// All points: those of routes (each the centre line, then the lines beside it), of areas, and places, in the plan's order. `up` is a unit vector
    /// along an axis.
    pub fn spots(&self, up: [f64; 3]) -> Vec<Spot> {
        let raised = |[x, y, z]: [f64; 3]| Spot::plane([x + up[0] * self.height, y + up[1] * self.height, z + up[2] * self.height], up);
        let routes = self.routes.iter().flat_map(|route| route.points(up));
        let areas = self.areas.iter().flat_map(|area| area.points(up));
        let places = self.places.iter().map(|place| Spot::plane(place.position, place.facing));
        routes.chain(areas).map(raised).chain(places).collect()
    }
}

impl Route {
    /// How many points its centre line has.
    pub(crate) fn along(&self) -> usize {
        1 + self.line.windows(2).map(|pair| self.steps(pair[0], pair[1])).sum::<usize>()
    }

    /// How many points it has in all.
    pub(crate) fn count(&self) -> usize {
        self.along() * ACROSS.len()
    }

    fn steps(&self, from: [f64; 3], to: [f64; 3]) -> usize {
        (distance(from, to) / self.spacing).ceil().max(1.0) as usize
    }

    /// Line by line, the centre first.
    pub(crate) fn points(&self, up: [f64; 3]) -> Vec<[f64; 3]> {
        let mut centre: Vec<([f64; 3], [f64; 3])> = Vec::new();
        for pair in self.line.windows(2) {
            let (steps, side) = (self.steps(pair[0], pair[1]), across(pair[0], pair[1], up));
            let first = usize::from(!centre.is_empty());
            centre.extend((first..=steps).map(|step| {
                let t = step as f64 / steps as f64;
                (std::array::from_fn(|k| pair[0][k] + t * (pair[1][k] - pair[0][k])), side)
            }));
        }
        let beside = |part: f64| centre.iter().map(move |(point, side)| std::array::from_fn(|k| point[k] + part * self.width * side[k]));
        ACROSS.into_iter().flat_map(beside).collect()
    }
}

/// The level direction across a way; none where it goes straight up.
fn across(from: [f64; 3], to: [f64; 3], up: [f64; 3]) -> [f64; 3] {
    let side = cross(up, minus(to, from));
    let length = distance(side, [0.0; 3]);
    if length > 0.0 { side.map(|part| part / length) } else { [0.0; 3] }
}

impl Area {
    /// Points of a raster over its level extent that are within its outline and off its edges, at the height of its first corner.
    pub(crate) fn points(&self, up: [f64; 3]) -> Vec<[f64; 3]> {
        let vertical = (0..3).max_by(|a, b| up[*a].abs().total_cmp(&up[*b].abs())).unwrap_or(2);
        let [u, v] = [(vertical + 1) % 3, (vertical + 2) % 3];
        let flat: Vec<[f64; 2]> = self.outline.iter().map(|corner| [corner[u], corner[v]]).collect();
        let [us, vs] = [0, 1].map(|axis| self.stations(flat.iter().map(|corner| corner[axis])));
        let mut found = Vec::new();
        for (pu, pv) in vs.iter().flat_map(|pv| us.iter().map(move |pu| (*pu, *pv))) {
            if is_inside(&flat, [pu, pv]) && edge_distance(&flat, [pu, pv]) >= self.border - 1e-9 {
                let mut point = [0.0; 3];
                (point[u], point[v], point[vertical]) = (pu, pv, self.outline[0][vertical]);
                found.push(point);
            }
        }
        found
    }

    /// Even steps within an extent less its borders, both ends among them.
    fn stations(&self, at: impl Iterator<Item = f64> + Clone) -> Vec<f64> {
        let (low, high) = (at.clone().fold(f64::MAX, f64::min) + self.border, at.fold(f64::MIN, f64::max) - self.border);
        if high < low {
            return Vec::new();
        }
        let steps = ((high - low) / self.spacing).ceil().max(1.0);
        (0..=steps as usize).map(|step| low + (high - low) * step as f64 / steps).collect()
    }
}
