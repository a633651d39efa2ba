//! What `Scene.add_light` takes of photometry.

use crate::{description, error::setting};
use gonio::{
    light::blackbody_rgb,
    scene::{Goniogram, Light, LightQuantity, LightShape, Opening, Shaping, Spot},
};
use pyo3::{prelude::*, types::PyDict};
use std::sync::Arc;

/// A light's photometric keyword arguments.
#[derive(Default)]
pub(crate) struct Photometry {
    quantity: Option<LightQuantity>,
    temperature: Option<f32>,
    dimming: Option<f32>,
    goniogram: Option<Goniogram>,
    opening: Option<Opening>,
    cosine_power: f32,
    spot: Option<[f32; 2]>,
    group: String,
}

impl Photometry {
    /// Of keyword arguments.
    pub(crate) fn new(arguments: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let mut read = Self::default();
        for (key, value) in arguments.into_iter().flatten() {
            let key: String = key.extract()?;
            if !value.is_none() {
                read.take(&key, &value)?;
            }
        }
        Ok(read)
    }

    fn take(&mut self, key: &str, value: &Bound<'_, PyAny>) -> PyResult<()> {
        match key {
            "temperature" => self.temperature = Some(value.extract()?),
            "dimming" => self.dimming = Some(value.extract()?),
            "goniogram" => self.goniogram = Some(description::read(value.cast()?, key)?),
            "opening" => self.opening = Some(description::read(value.cast()?, key)?),
            "cosine_power" => self.cosine_power = value.extract()?,
            "group" => self.group = value.extract()?,
            "spot" => self.spot = Some(value.extract()?),
            _ => {
                let quantity = quantity(key, value)?;
                if self.quantity.replace(quantity).is_some() {
                    return Err(setting(key, "a light has one quantity, and another was given beside it"));
                }
            }
        }
        Ok(())
    }

    /// The luminaire's opening: the one given, or the goniogram's.
    pub(crate) fn opening(&self) -> Opening {
        self.opening.or_else(|| self.goniogram.as_ref().map(|goniogram| goniogram.opening)).unwrap_or_default()
    }

    /// A light with all this.
    pub(crate) fn applied(self, mut light: Light) -> Light {
        if let Some(kelvin) = self.temperature {
            let colour = blackbody_rgb(kelvin);
            light.emission.radiance = [0, 1, 2].map(|k| light.emission.radiance[k] * colour[k]);
        }
        let sends_candela = matches!(light.shape, LightShape::Point | LightShape::Opening(_));
        let measured = (self.goniogram.is_some() && sends_candela).then_some(LightQuantity::Measured);
        Light {
            group: self.group,
            quantity: self.quantity.or(measured),
            dimming: self.dimming.unwrap_or(1.0),
            goniogram: self.goniogram.map(Arc::new),
            shaping: directed(self.cosine_power),
            spot: self.spot.map(|[angle_deg, blend]| Spot { angle_deg, blend, stretch: [1.0; 2] }),
            ..light
        }
    }
}

/// I = I₀ · cosⁿ θ, to the front alone; a power of 0 leaves the light as it is.
fn directed(power: f32) -> Shaping {
    if power > 0.0 { Shaping { focus: power, cone_angle_deg: Some(90.0), ..Shaping::default() } } else { Shaping::default() }
}

fn quantity(key: &str, value: &Bound<'_, PyAny>) -> PyResult<LightQuantity> {
    Ok(match key {
        "lumens" => LightQuantity::Lumens(value.extract()?),
        "lamp_lumens" => LightQuantity::LampLumens(value.extract()?),
        "candela" => LightQuantity::Candela(value.extract()?),
        "nits" => LightQuantity::Nits(value.extract()?),
        "watts" => LightQuantity::Watts(value.extract()?),
        "lux" => {
            let (illuminance, distance) = match value.extract::<f64>() {
                Ok(illuminance) => (illuminance, 1.0),
                Err(_) => value.extract()?,
            };
            LightQuantity::Lux { illuminance, distance }
        }
        other => return Err(setting(other, "a light has no setting of this name")),
    })
}
