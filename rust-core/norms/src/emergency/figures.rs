//! What the readings come to.

use super::plan::Plan;
use crate::lit::{Lit, Reading, Spot};
use serde_json::{Map, Value, json};

/// A luminaire as somebody who flees sees it.
#[derive(Clone, Debug, PartialEq)]
pub struct Lamp {
    /// Its prim.
    pub name: String,
    /// Metres above the floor of the plan's routes and areas that is nearest below it; none where none is.
    pub height: Option<f64>,
    /// Its greatest intensity between the plan's angles, cd, with all of its flux; none where nobody knows it.
    pub peak_cd: Option<f64>,
}

/// The greatest over the least (EN 1838 allows 40 : 1), with its standard error; none where the least is no light.
pub(crate) fn max_to_min(lit: &Lit) -> Option<[f64; 2]> {
    let [least, most, _] = lit.ends()?;
    most.over(least)
}

fn json_of(lit: &Lit) -> Map<String, Value> {
    lit.json(&[("max_to_min", max_to_min(lit))])
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
    /// What the figures leave out.
    pub(crate) notes: Vec<String>,
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
        Self { routes, areas, places, lamps, factor, notes: Vec::new(), glare_deg: plan.glare(up) }
    }

    /// With what the figures leave out.
    pub fn with_notes(self, notes: Vec<String>) -> Self {
        Self { notes, ..self }
    }

    /// For machines; `docs/emergency.md` lists the keys.
    pub fn json(&self) -> Value {
        let route = |(name, centre, band): &(String, Lit, Lit)| json!({ "name": name, "centre": json_of(centre), "band": json_of(band) });
        let area = |(name, lit): &(String, Lit)| {
            let mut found = json_of(lit);
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
            "notes": self.notes,
            "luminaires": self.lamps.iter().map(lamp).collect::<Vec<_>>(),
        })
    }
}
