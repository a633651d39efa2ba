//! Luminaires, whose IES files are in the model as text.

use super::Reader;
use super::node::Node;
use crate::Luminaire;
use crate::vector::Vec3;
use gonio_formats::photometry;
use gonio_scene::{Goniogram, Light, LightQuantity, LightShape, Transform};
use std::sync::Arc;

impl<'a> Reader<'a> {
    pub(super) fn luminaire(&mut self, node: &Node<'a>) {
        self.builder.count("Luminaire");
        let result = self.placed(node);
        self.tell(node, result);
    }

    fn placed(&mut self, node: &Node<'a>) -> Result<(), String> {
        let text = node.text("ies_content").ok_or("ies_content is missing, expected the text of an IES file")?;
        let found = photometry::read(text.as_bytes(), "luminaire.ies").map_err(|error| format!("ies_content: {error}"))?;
        for warning in &found.warnings {
            self.warn(node, &format!("ies_content: {warning}"));
        }
        let goniogram = Arc::new(Goniogram::from(&found));
        let lamp = node.get("custom_lamp");
        let factor = |node: &Node<'_>, key: &str| -> Result<f64, String> {
            let value = node.number(key, 1.0)?;
            if value >= 0.0 { Ok(value) } else { Err(format!("{key} is {value}, expected a number of 0 or more")) }
        };
        let mut dimming = factor(node, "light_loss_factor")? * factor(node, "candela_multiplier")?;
        if let Some(lamp) = &lamp {
            dimming *= factor(lamp, "depreciation_factor")?;
            self.warn(lamp, "the lamp's colour is left out");
        }
        let instances = node.get("luminaire_zone").map(|zone| zone.list("instances")).unwrap_or_default();
        if instances.is_empty() {
            self.warn(node, "it stands nowhere: luminaire_zone has no instances");
        }
        for instance in instances {
            match self.place(&instance) {
                Ok(transform) => {
                    let mut light = Light::new(self.origin(node), LightShape::Opening(goniogram.opening), transform);
                    light.quantity = Some(LightQuantity::Measured);
                    light.goniogram = Some(goniogram.clone());
                    light.dimming = dimming as f32;
                    self.builder.model.scene.lights.push(light);
                }
                Err(problem) => self.tell(&instance, Err(problem)),
            }
        }
        self.builder.model.luminaires.push(Luminaire { name: node.identifier().to_owned(), photometry: found, goniogram });
        Ok(())
    }

    /// About z by the spin, about y by the tilt, about z by the rotation, then to its point.
    fn place(&self, instance: &Node<'a>) -> Result<Transform, String> {
        let point = instance.get("point").ok_or("point is missing, expected a Point3D")?;
        let at: Vec3 = match point.value.is_array() {
            true => point.vector()?,
            false => [point.number("x", f64::NAN)?, point.number("y", f64::NAN)?, point.number("z", f64::NAN)?],
        };
        if at.iter().any(|x| !x.is_finite()) {
            return Err("point has no x, y and z".into());
        }
        let angle = |key: &str| instance.number(key, 0.0);
        let turned = about_z(angle("rotation")?).after(&about_y(angle("tilt")?)).after(&about_z(angle("spin")?));
        Ok(Transform::translation(at.map(|x| x * self.metres)).after(&turned))
    }
}

fn about_z(degrees: f64) -> Transform {
    let (s, c) = degrees.to_radians().sin_cos();
    Transform { columns: [[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0], [0.0; 3]] }
}

fn about_y(degrees: f64) -> Transform {
    let (s, c) = degrees.to_radians().sin_cos();
    Transform { columns: [[c, 0.0, -s], [0.0, 1.0, 0.0], [s, 0.0, c], [0.0; 3]] }
}
