//! Lights in words.

use gonio::colour::luminance_of_pixel;
use gonio::scene::{Light, LightQuantity, LightShape, Opening};

/// A light in words, with units.
pub(super) fn describe(light: &Light) -> String {
    let y = luminance_of_pixel(light.emission.radiance);
    let shape = match light.shape {
        LightShape::Rectangle { width, height } => format!("rectangle {} x {} units", short(width), short(height)),
        LightShape::Disk { radius } => format!("disk of radius {} units", short(radius)),
        LightShape::Ellipse { width, height } => format!("ellipse {} x {} units", short(width), short(height)),
        LightShape::Sphere { radius } => format!("sphere of radius {} units", short(radius)),
        LightShape::FacingDisk { radius } => format!("facing disk of radius {} units", short(radius)),
        LightShape::Point => "point".to_owned(),
        LightShape::Opening(Opening { shape, size: [x, y, z], .. }) => {
            let [x, y, z] = [x, y, z].map(short);
            format!("luminaire's opening, {shape:?} {x} x {y} x {z} units")
        }
        LightShape::Cylinder { radius, length } => {
            format!("cylinder of radius {}, length {} units", short(radius), short(length))
        }
        LightShape::Distant { angle_deg } => format!("distant, {angle_deg} degrees"),
        LightShape::Dome { .. } => "dome".to_owned(),
    };
    let textured = if light.texture.is_some() { ", textured" } else { "" };
    if let Some(quantity) = light.quantity {
        return format!("{shape}, {}{textured}", strength(quantity));
    }
    let unit = match (light.emission.normalized, light.shape) {
        (true, LightShape::Distant { .. }) => "lx on a facing surface",
        (_, LightShape::Point | LightShape::Opening(_)) => "cd",
        (true, LightShape::Dome { .. }) | (false, _) => "cd/m²",
        (true, _) => "cd/m² times its area in square units",
    };
    format!("{shape}, {y} {unit}{textured}")
}

/// A length to six digits: stages keep them in single precision.
fn short(length: f64) -> f64 {
    let scale = 10f64.powi(5 - length.abs().max(f64::MIN_POSITIVE).log10().floor() as i32);
    let rounded = (length * scale).round() / scale;
    if rounded.is_finite() { rounded } else { length }
}

/// A light's quantity with its unit.
fn strength(quantity: LightQuantity) -> String {
    match quantity {
        LightQuantity::Lumens(flux) => format!("{flux} lm"),
        LightQuantity::LampLumens(flux) => format!("lamps of {flux} lm"),
        LightQuantity::Candela(intensity) => format!("{intensity} cd"),
        LightQuantity::Lux { illuminance, distance } => format!("{illuminance} lx at {distance} m"),
        LightQuantity::Nits(luminance) => format!("{luminance} cd/m²"),
        LightQuantity::Watts(watts) => format!("{watts} W"),
        LightQuantity::Measured => "as measured".to_owned(),
    }
}
