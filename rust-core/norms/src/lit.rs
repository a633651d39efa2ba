//! Points that are lit, and what readings at them come to.

use serde_json::{Map, Value, json};

/// A point and the plane, or the small cylinder, that is lit there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// In the scene's space, metres.
    pub position: [f64; 3],
    /// The plane's normal, of length 1 on floors, or the cylinder's axis.
    pub normal: [f64; 3],
    /// Whether the mean over a cylinder's side is meant.
    pub is_cylinder: bool,
}

impl Spot {
    pub(crate) fn plane(position: [f64; 3], normal: [f64; 3]) -> Self {
        Self { position, normal, is_cylinder: false }
    }

    pub(crate) fn cylinder(position: [f64; 3], axis: [f64; 3]) -> Self {
        Self { position, normal: axis, is_cylinder: true }
    }
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
    /// What each point stands for in the mean.
    weights: Vec<f64>,
}

impl Lit {
    pub(crate) fn new((spots, readings): (&[Spot], &[Reading])) -> Self {
        Self { spots: spots.to_vec(), readings: readings.to_vec(), weights: vec![1.0; readings.len()] }
    }

    /// Several areas as one: in the mean each counts by its size, m².
    pub(crate) fn joined<'a>(parts: impl Iterator<Item = (&'a Self, f64)>) -> Self {
        let mut whole = Self::new((&[], &[]));
        for (part, size) in parts {
            whole.spots.extend(&part.spots);
            whole.readings.extend(&part.readings);
            whole.weights.extend(part.readings.iter().map(|_| size / part.readings.len() as f64));
        }
        whole
    }

    /// The least over the mean and over the greatest; none without light.
    pub(crate) fn uniformities(&self) -> [Option<[f64; 2]>; 2] {
        self.ends().map_or([None; 2], |[least, most, mean]| [least.over(mean), least.over(most)])
    }

    /// The least, the greatest, and their mean; nothing of no points, and all unknown where a point is.
    pub(crate) fn ends(&self) -> Option<[Reading; 3]> {
        if self.readings.iter().any(|reading| reading.lx.is_nan()) {
            return Some([Reading::UNKNOWN; 3]);
        }
        let by = |a: &&Reading, b: &&Reading| a.lx.total_cmp(&b.lx);
        let (least, most) = (self.readings.iter().min_by(by)?, self.readings.iter().max_by(by)?);
        let whole: f64 = self.weights.iter().sum();
        let weighed = || self.readings.iter().zip(&self.weights);
        let mean = weighed().map(|(reading, weight)| weight * reading.lx).sum::<f64>() / whole;
        // Errors of points are independent.
        let error = weighed().map(|(reading, weight)| (weight * reading.error).powi(2)).sum::<f64>().sqrt() / whole;
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
