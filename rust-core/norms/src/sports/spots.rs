//! Where light is measured, and from where glare is rated.

use super::plan::{Camera, EYES, Field, Plan};
use crate::{
    Spot,
    spacing::side_and_spacing,
    vector::{cross, dot, minus, plus, unit},
};

impl Field {
    /// Points along and across. Without a wish as EN 12193 has it: about p = 0.2 · 5^log₁₀ d apart, d the longer side, or the shorter where the longer has
    /// twice its length; odd numbers, so that one lies in the middle. The other side has the spacing that this comes to.
    pub(crate) fn counts(&self) -> [u32; 2] {
        if let Some(points) = self.points {
            return points;
        }
        let sides = self.sides();
        let [d, spacing] = side_and_spacing(sides);
        let nearest_odd = |quotient: f64| 2 * ((quotient - 1.0) / 2.0).round().max(0.0) as u32 + 1;
        let spacing = d / f64::from(nearest_odd(d / spacing));
        sides.map(|side| nearest_odd(side / spacing))
    }

    /// The middles of its cells, row by row along it, at a height.
    pub(crate) fn raster(&self, height: f64, up: [f64; 3]) -> Vec<[f64; 3]> {
        let [columns, rows] = self.counts();
        let at = |row: u32, column: u32| {
            let (u, v) = ((f64::from(column) + 0.5) / f64::from(columns), (f64::from(row) + 0.5) / f64::from(rows));
            std::array::from_fn(|k| self.corner[k] + u * self.along[k] + v * self.across[k] + height * up[k])
        };
        (0..rows).flat_map(|row| (0..columns).map(move |column| at(row, column))).collect()
    }
}

impl Camera {
    /// Whether it films a field.
    pub(crate) fn films(&self, field: &Field) -> bool {
        self.field.as_ref().is_none_or(|name| *name == field.name)
    }

    /// The normal of the plane at a point that faces it; straight up below a camera.
    fn normal(&self, point: [f64; 3], up: [f64; 3]) -> [f64; 3] {
        let way = match (self.position, self.facing) {
            (Some(place), _) => minus(place, point),
            (None, facing) => facing.unwrap_or(up),
        };
        unit(if self.inclined { way } else { levelled(way, up) }).unwrap_or(up)
    }
}

impl Plan {
    /// All points, in the order of fields: those on its ground, then those of each camera that films it. `up` is a unit vector along an axis.
    pub fn spots(&self, up: [f64; 3]) -> Vec<Spot> {
        let of_field = |field: &Field| {
            let ground = field.raster(field.height, up).into_iter().map(|position| Spot::plane(position, up));
            let filmed = self.cameras.iter().filter(|camera| camera.films(field)).flat_map(|camera| {
                let points = field.raster(camera.height, up);
                points.into_iter().map(|position| Spot::plane(position, camera.normal(position, up))).collect::<Vec<_>>()
            });
            ground.chain(filmed).collect::<Vec<_>>()
        };
        self.fields.iter().flat_map(of_field).collect()
    }

    /// Eyes whose glare is rated: observers, then those at the points of fields that want it.
    pub fn eyes(&self, up: [f64; 3]) -> Vec<[f64; 3]> {
        let at_points = self.fields.iter().filter(|field| field.glare).flat_map(|field| field.raster(EYES, up));
        self.observers.iter().map(|observer| observer.position).chain(at_points).collect()
    }

    /// Directions in which eyes look, unit: all around from the first field's side, so many degrees above the horizon.
    pub(crate) fn looks(&self, up: [f64; 3]) -> Vec<(f64, [f64; 3])> {
        let ahead = unit(levelled(self.fields[0].along, up)).unwrap_or([up[1], up[2], up[0]]);
        let side = cross(up, ahead);
        let (rise, level) = self.tilt_deg.to_radians().sin_cos();
        let look = |number: usize| {
            let degrees = self.step_deg * number as f64;
            let (sin, cos) = degrees.to_radians().sin_cos();
            (degrees, std::array::from_fn(|k| level * (cos * ahead[k] + sin * side[k]) + rise * up[k]))
        };
        (0..(360.0 / self.step_deg).ceil() as usize).map(look).collect()
    }
}

/// What of a way lies across the way up.
fn levelled(way: [f64; 3], up: [f64; 3]) -> [f64; 3] {
    plus(way, up, -dot(way, up))
}
