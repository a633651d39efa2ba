//! Lights in words.

use crate::words::Words;
use gonio::colour::luminance_of_pixel;
use gonio::scene::{Light, LightQuantity, LightShape, Opening, OpeningShape};
use gonio_page::fill;
use std::f64::consts::PI;

/// The unit of light from afar.
const FACING: &str = "lx on a facing surface";

/// A light in words, with its lengths in metres in the world and its strength in units of light, rounded.
pub(super) fn describe(light: &Light, words: &Words) -> String {
    let (numbers, say) = (words.numbers, &words.lights);
    let [x, y, z] = extents(light).map(|length| numbers.short(length));
    let sized = |template: &str| fill(template, &[("x", &x), ("y", &y), ("z", &z)]);
    let shape = match light.shape {
        LightShape::Rectangle { .. } => sized(&say.rectangle),
        LightShape::Ellipse { .. } => sized(&say.ellipse),
        LightShape::Disk { .. } => sized(&say.disk),
        LightShape::Sphere { .. } => sized(&say.sphere),
        LightShape::FacingDisk { .. } => sized(&say.facing_disk),
        LightShape::Cylinder { .. } => sized(&say.cylinder),
        LightShape::Point => say.point.clone(),
        LightShape::Opening(Opening { shape: OpeningShape::Point, .. }) => say.luminaire.clone(),
        LightShape::Opening(Opening { shape, .. }) => {
            fill(&say.opening, &[("shape", words.file.name(name_of(shape))), ("x", &x), ("y", &y), ("z", &z)])
        }
        LightShape::Distant { angle_deg } => fill(&say.distant, &[("angle", &numbers.short(angle_deg))]),
        LightShape::Dome { .. } => say.dome.clone(),
    };
    let textured = if light.texture.is_some() { say.textured.as_str() } else { "" };
    let strength = match (light.quantity, strength(light)) {
        (Some(LightQuantity::LampLumens(flux)), _) => fill(&say.lamps, &[("flux", &numbers.short(flux))]),
        (Some(LightQuantity::Lux { illuminance, distance }), _) => {
            fill(&say.lux_at, &[("illuminance", &numbers.short(illuminance)), ("distance", &numbers.short(distance))])
        }
        (_, None) => say.measured.clone(),
        (_, Some((strength, FACING))) => format!("{} {}", numbers.short(strength), say.facing),
        (_, Some((strength, unit))) => format!("{} {unit}", numbers.short(strength)),
    };
    format!("{shape}, {strength}{textured}")
}

/// A light's strength with its unit; `None` where its light distribution alone tells it.
pub(super) fn strength(light: &Light) -> Option<(f64, &'static str)> {
    Some(match light.quantity {
        None => emitted(light, extents(light)),
        Some(LightQuantity::Lumens(flux) | LightQuantity::LampLumens(flux)) => (flux, "lm"),
        Some(LightQuantity::Candela(intensity)) => (intensity, "cd"),
        Some(LightQuantity::Lux { illuminance, .. }) => (illuminance, "lx"),
        Some(LightQuantity::Nits(luminance)) => (luminance, "cd/m²"),
        Some(LightQuantity::Watts(watts)) => (watts, "W"),
        Some(LightQuantity::Measured) => return None,
    })
}

/// What the schema's intensity amounts to.
fn emitted(light: &Light, extents: [f64; 3]) -> (f64, &'static str) {
    let strength = f64::from(luminance_of_pixel(light.emission.radiance));
    let unit = match (light.emission.normalized, light.shape) {
        (true, LightShape::Distant { .. }) => FACING,
        // Parallel light has no luminance.
        (false, LightShape::Distant { angle_deg }) if angle_deg <= 0.0 => FACING,
        (_, LightShape::Point | LightShape::Opening(_)) => "cd",
        _ => "cd/m²",
    };
    let normalized_by = area(light.shape, extents).filter(|area| light.emission.normalized && *area > 0.0);
    // Areas are those of the stage's own units.
    let factor = normalized_by.map_or(1.0, |area| area / light.emission.metres_per_unit.powi(2));
    (strength / factor, unit)
}

/// Lengths in metres in the world along the shape's own axes; a radius counts as a diameter.
pub(super) fn extents(light: &Light) -> [f64; 3] {
    let own = match light.shape {
        LightShape::Rectangle { width, height } | LightShape::Ellipse { width, height } => [width, height, 0.0],
        LightShape::Disk { radius } | LightShape::Sphere { radius } | LightShape::FacingDisk { radius } => [2.0 * radius; 3],
        LightShape::Cylinder { radius, length } => [length, 2.0 * radius, 2.0 * radius],
        LightShape::Opening(Opening { size, .. }) => size,
        LightShape::Point | LightShape::Distant { .. } | LightShape::Dome { .. } => [0.0; 3],
    };
    let scale = |axis: usize| light.transform.columns[axis].iter().map(|x| x * x).sum::<f64>().sqrt();
    [0, 1, 2].map(|axis| own[axis] * scale(axis))
}

/// Square metres that shine, as UsdLux counts them; none of lights that have no size of their own.
fn area(shape: LightShape, [x, y, _]: [f64; 3]) -> Option<f64> {
    match shape {
        LightShape::Rectangle { .. } => Some(x * y),
        LightShape::Disk { .. } | LightShape::Ellipse { .. } | LightShape::FacingDisk { .. } => Some(0.25 * PI * x * y),
        LightShape::Sphere { .. } => Some(PI * x * x),
        LightShape::Cylinder { .. } => Some(PI * y * x),
        _ => None,
    }
}

/// An opening's shape in words.
fn name_of(shape: OpeningShape) -> &'static str {
    match shape {
        OpeningShape::Point => "point",
        OpeningShape::Rectangle => "rectangle",
        OpeningShape::Box => "box",
        OpeningShape::Disk | OpeningShape::DiskFacingX | OpeningShape::DiskFacingY => "disk",
        OpeningShape::VerticalCylinder | OpeningShape::CylinderAlongX | OpeningShape::CylinderAlongY => "cylinder",
        OpeningShape::Ellipsoid => "ellipsoid",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio::scene::{Emission, Origin, Transform};

    fn light(shape: LightShape, scale: f64, emission: Emission) -> String {
        describe(&Light { emission, ..Light::new(Origin::new("light"), shape, Transform::scale(scale)) }, Words::english())
    }

    #[test]
    fn lengths_are_metres_and_strengths_are_round() {
        let plain = |y: f32| Emission { radiance: [y; 3], ..Emission::default() };
        assert_eq!(
            light(LightShape::Rectangle { width: 120.0, height: 60.0 }, 0.01, plain(3199.9998)),
            "rectangle 1.2 × 0.6 m, 3200 cd/m²"
        );
        assert_eq!(light(LightShape::Sphere { radius: 5.0 }, 0.01, plain(0.5)), "sphere 0.1 m across, 0.5 cd/m²");
        assert_eq!(
            light(LightShape::Cylinder { radius: 0.013, length: 1.2 }, 1.0, plain(1e4)),
            "cylinder 1.2 m long, 0.026 m across, 10000 cd/m²"
        );
        // Normalized lights are divided by their area in square units of the stage: 120 × 60.
        let normalized = Emission { normalized: true, metres_per_unit: 0.01, ..plain(7200.0) };
        assert_eq!(light(LightShape::Rectangle { width: 120.0, height: 60.0 }, 0.01, normalized), "rectangle 1.2 × 0.6 m, 1 cd/m²");
        // A sun has no area, in whatever unit.
        for metres_per_unit in [1.0, 0.01, 0.001, 0.3048] {
            let sun = Emission { normalized: true, metres_per_unit, ..plain(50_000.2) };
            assert_eq!(light(LightShape::Distant { angle_deg: 0.53 }, 1.0, sun), "distant, 0.53 degrees, 50000 lx on a facing surface");
            let point = Emission { normalized: true, metres_per_unit, ..plain(80.0) };
            assert_eq!(light(LightShape::Point, 1.0, point), "point, 80 cd");
        }
    }
}
