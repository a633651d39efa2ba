//! What the readings come to.

use crate::{plan::Plan, spots::Spot};
use serde_json::{Value, json};

/// An illuminance, lx, and its standard error.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reading {
    /// The illuminance.
    pub lx: f64,
    /// Its standard error.
    pub error: f64,
}

impl Reading {
    fn times(self, factor: f64) -> Self {
        Self { lx: self.lx * factor, error: self.error * factor }
    }
}

/// A luminaire as somebody who flees sees it.
#[derive(Clone, Debug, PartialEq)]
pub struct Lamp {
    /// Its prim.
    pub name: String,
    /// Metres above the lowest floor of the plan.
    pub height: f64,
    /// Its greatest intensity between the plan's angles, cd, with all of its flux.
    pub peak_cd: f64,
}

/// The readings along a line or in an area.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Lit {
    pub(crate) spots: Vec<Spot>,
    pub(crate) readings: Vec<Reading>,
}

impl Lit {
    fn new((spots, readings): (&[Spot], &[Reading])) -> Self {
        Self { spots: spots.to_vec(), readings: readings.to_vec() }
    }

    /// The least, the greatest, and their mean; nothing of no points.
    pub(crate) fn ends(&self) -> Option<[Reading; 3]> {
        let by = |a: &&Reading, b: &&Reading| a.lx.total_cmp(&b.lx);
        let (least, most) = (self.readings.iter().min_by(by)?, self.readings.iter().max_by(by)?);
        let count = self.readings.len() as f64;
        let mean = self.readings.iter().map(|reading| reading.lx).sum::<f64>() / count;
        // Errors of points are independent.
        let error = self.readings.iter().map(|reading| reading.error.powi(2)).sum::<f64>().sqrt() / count;
        Some([*least, *most, Reading { lx: mean, error }])
    }

    /// The greatest over the least (EN 1838 allows 40 : 1), with its standard error; none where the least is no light.
    pub(crate) fn max_to_min(&self) -> Option<[f64; 2]> {
        let [least, most, _] = self.ends().filter(|[least, ..]| least.lx > 0.0)?;
        let ratio = most.lx / least.lx;
        Some([ratio, ratio * (most.error / most.lx).hypot(least.error / least.lx)])
    }

    fn json(&self) -> serde_json::Map<String, Value> {
        let mut found = serde_json::Map::new();
        if let Some([least, most, mean]) = self.ends() {
            for (key, reading) in [("min", least), ("max", most), ("average", mean)] {
                found.insert(format!("{key}_lx"), json!(reading.lx));
                found.insert(format!("{key}_error_lx"), json!(reading.error));
            }
        }
        let ratio = self.max_to_min();
        found.insert("max_to_min".into(), json!(ratio.map(|[ratio, _]| ratio)));
        found.insert("max_to_min_error".into(), json!(ratio.map(|[_, error]| error)));
        let point =
            |(spot, reading): (&Spot, &Reading)| json!({ "position_m": spot.position, "lx": reading.lx, "standard_error": reading.error });
        found.insert("points".into(), self.spots.iter().zip(&self.readings).map(point).collect());
        found
    }
}

/// Everything that a plan asks for.
#[derive(Clone, Debug, PartialEq)]
pub struct Figures {
    /// By route: its name, its centre line, its central band.
    pub(crate) routes: Vec<(String, Lit, Lit)>,
    pub(crate) areas: Vec<(String, Lit)>,
    pub(crate) places: Vec<(String, Reading)>,
    pub(crate) lamps: Vec<Lamp>,
    pub(crate) factor: f64,
    pub(crate) glare_deg: [f64; 2],
}

impl Figures {
    /// Of readings at a plan's spots, in their order, with the stage's whole flux.
    pub fn new(plan: &Plan, spots: &[Spot], readings: &[Reading], lamps: Vec<Lamp>) -> Self {
        let factor = plan.flux * plan.maintenance_factor;
        let readings: Vec<Reading> = readings.iter().map(|reading| reading.times(factor)).collect();
        let mut first = 0;
        let mut take = |count: usize| {
            let range = first..first + count;
            first += count;
            (&spots[range.clone()], &readings[range])
        };
        let mut routes = Vec::new();
        for route in &plan.routes {
            let (spots, readings) = take(route.count());
            let along = route.along();
            routes.push((route.name.clone(), Lit::new((&spots[..along], &readings[..along])), Lit::new((spots, readings))));
        }
        let up = spots.first().map_or([0.0, 0.0, 1.0], |spot| spot.normal);
        let areas = plan.areas.iter().map(|area| (area.name.clone(), Lit::new(take(area.points(up).len())))).collect();
        let places = plan.places.iter().map(|place| (place.name.clone(), take(1).1[0])).collect();
        Self { routes, areas, places, lamps, factor, glare_deg: plan.glare_deg }
    }

    /// For machines; `docs/emergency.md` lists the keys.
    pub fn json(&self) -> Value {
        let route = |(name, centre, band): &(String, Lit, Lit)| json!({ "name": name, "centre": centre.json(), "band": band.json() });
        let area = |(name, lit): &(String, Lit)| {
            let mut found = lit.json();
            found.insert("name".into(), json!(name));
            Value::Object(found)
        };
        let place = |(name, reading): &(String, Reading)| json!({ "name": name, "lx": reading.lx, "standard_error": reading.error });
        let lamp = |lamp: &Lamp| json!({ "name": lamp.name, "height_m": lamp.height, "peak_cd": lamp.peak_cd });
        json!({
            "factor": self.factor,
            "routes": self.routes.iter().map(route).collect::<Vec<_>>(),
            "areas": self.areas.iter().map(area).collect::<Vec<_>>(),
            "places": self.places.iter().map(place).collect::<Vec<_>>(),
            "glare_deg": self.glare_deg,
            "luminaires": self.lamps.iter().map(lamp).collect::<Vec<_>>(),
        })
    }
}
