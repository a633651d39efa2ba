//! Points that are lit, and what readings at them come to.

use serde_json::{Map, Value, json};

/// A point and the normal of the plane that is lit there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// In the scene's space, metres.
    pub position: [f64; 3],
    /// Of length 1 on floors.
    pub normal: [f64; 3],
}

/// An illuminance, lx, and its standard error.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reading {
    /// The illuminance.
    pub lx: f64,
    /// Its standard error.
    pub error: f64,
}

impl Reading {
    /// Of a point that has no figure.
    pub const UNKNOWN: Self = Self { lx: f64::NAN, error: f64::NAN };

    pub(crate) fn times(self, factor: f64) -> Self {
        Self { lx: self.lx * factor, error: self.error * factor }
    }

    /// A ratio to another, with its standard error; none to no light.
    pub(crate) fn over(self, other: Self) -> Option<[f64; 2]> {
        let ratio = Some(self.lx / other.lx).filter(|_| other.lx > 0.0)?;
        Some([ratio, (self.error / other.lx).hypot(ratio * other.error / other.lx)])
    }

    /// For people.
    pub(crate) fn told(self) -> String {
        if self.lx.is_nan() { "unknown".to_owned() } else { format!("{:.2} lx ± {:.2}", self.lx, self.error) }
    }
}

/// The readings along a line or in an area.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Lit {
    pub(crate) spots: Vec<Spot>,
    pub(crate) readings: Vec<Reading>,
}

impl Lit {
    pub(crate) fn new((spots, readings): (&[Spot], &[Reading])) -> Self {
        Self { spots: spots.to_vec(), readings: readings.to_vec() }
    }

    /// The least, the greatest, and their mean; nothing of no points, and all unknown where a point is.
    pub(crate) fn ends(&self) -> Option<[Reading; 3]> {
        if self.readings.iter().any(|reading| reading.lx.is_nan()) {
            return Some([Reading::UNKNOWN; 3]);
        }
        let by = |a: &&Reading, b: &&Reading| a.lx.total_cmp(&b.lx);
        let (least, most) = (self.readings.iter().min_by(by)?, self.readings.iter().max_by(by)?);
        let count = self.readings.len() as f64;
        let mean = self.readings.iter().map(|reading| reading.lx).sum::<f64>() / count;
        // Errors of points are independent.
        let error = self.readings.iter().map(|reading| reading.error.powi(2)).sum::<f64>().sqrt() / count;
        Some([*least, *most, Reading { lx: mean, error }])
    }

    /// The least, the greatest and the mean with their errors, and each point; `ratios` by their keys.
    pub(crate) fn json(&self, ratios: &[(&str, Option<[f64; 2]>)]) -> Map<String, Value> {
        let mut found = Map::new();
        if let Some([least, most, mean]) = self.ends() {
            for (key, reading) in [("min", least), ("max", most), ("average", mean)] {
                found.insert(format!("{key}_lx"), json!(reading.lx));
                found.insert(format!("{key}_error_lx"), json!(reading.error));
            }
        }
        for (key, ratio) in ratios {
            found.insert((*key).to_owned(), json!(ratio.map(|[ratio, _]| ratio)));
            found.insert(format!("{key}_error"), json!(ratio.map(|[_, error]| error)));
        }
        let point =
            |(spot, reading): (&Spot, &Reading)| json!({ "position_m": spot.position, "lx": reading.lx, "standard_error": reading.error });
        found.insert("points".into(), self.spots.iter().zip(&self.readings).map(point).collect());
        found
    }
}
