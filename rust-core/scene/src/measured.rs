//! Measured scattering: what a material's file or table holds.

use super::{Origin, blob};
use gonio_formats::bsdf::{Measured, read};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error};
use std::sync::Arc;

/// A measured BSDF, which closures of [`super::Model::Measured`] refer to. Any number of closures may share one.
///
/// z of the measurement is the front's normal, x the tangent along the first texture coordinate or the closure's own. A bundle and a
/// dictionary hold it as the bytes of a file of its kind.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct MeasuredBsdf {
    /// Where it came from.
    pub origin: Origin,
    /// What was measured.
    #[serde(serialize_with = "serialize", deserialize_with = "deserialize")]
    pub data: Arc<Measured>,
}

impl MeasuredBsdf {
    /// What a reader or a table gives.
    pub fn new(origin: Origin, data: impl Into<Arc<Measured>>) -> Self {
        Self { origin, data: data.into() }
    }
}

impl From<Measured> for MeasuredBsdf {
    fn from(data: Measured) -> Self {
        Self::new(Origin::default(), data)
    }
}

fn serialize<S: Serializer>(data: &Arc<Measured>, serializer: S) -> Result<S::Ok, S::Error> {
    blob::serialize(&Arc::<[u8]>::from(data.to_bytes()), serializer)
}

fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Arc<Measured>, D::Error> {
    let bytes: Arc<[u8]> = blob::deserialize(deserializer)?;
    read(&bytes, "").map(Arc::new).map_err(D::Error::custom)
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio_formats::bsdf::{Axis, Band, Basis, Channels, Coordinates, Hemispheres, Layout, Matrix, Mode, Patches, Table};

    fn table() -> Measured {
        let axis = |last: f64, count| Axis::uniform(0.0, f64::to_radians(last), count, Mode::Linear).expect("increasing");
        let layout = Layout {
            coordinates: Coordinates::Isotropic,
            axes: vec![axis(80.0, 3), axis(75.0, 2), axis(180.0, 4)],
            channels: Channels::Rgb,
            hemispheres: Hemispheres::TransmissionBack,
            reciprocal: false,
            bilateral: true,
        };
        let values = (0..72).map(|i| 0.1 + i as f32 / 7.0).collect();
        Measured::Tables(vec![Table::new(layout, values).expect("as many values as cells")])
    }

    fn patches() -> Measured {
        let basis = Basis::known("LBNL/Klems Quarter").expect("a known basis");
        let values = (0..41 * 41).map(|i| (i % 97) as f32 / 300.0).collect();
        let matrix = Matrix::new(Hemispheres::ReflectionFront, Band::Visible, 0, 0, values);
        Measured::Patches(Patches::new(vec![basis], vec![matrix]).expect("a sound matrix"))
    }

    #[test]
    fn what_was_measured_survives_a_bundle_and_a_dictionary() {
        for data in [table(), patches()] {
            let bsdf = MeasuredBsdf::new(Origin::new("there"), data);
            let (json, arrays) = blob::collect(|| serde_json::to_vec(&bsdf).expect("a description"));
            let back: MeasuredBsdf = blob::supply(arrays, || serde_json::from_slice(&json).expect("the same description"));
            assert_eq!(back.data, bsdf.data);
            let value = serde_json::to_value(&bsdf).expect("a description");
            let back: MeasuredBsdf = serde_json::from_value(value).expect("the same description");
            assert_eq!(back.data, bsdf.data);
        }
    }
}
