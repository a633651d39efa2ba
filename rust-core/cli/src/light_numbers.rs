//! Lights as numbers, for machines.

use super::{
    light_words::{describe, extents, strength},
    words::Words,
};
use gonio::{
    colour::luminance_of_pixel,
    compile::luminous_fluxes,
    scene::{Input, Light, LightQuantity, LightShape, Material, OpeningShape, Scene},
};
use serde_json::{Value, json};

/// All lights of a scene; keys end in their units, and what a light has not is null.
pub(super) fn lights(scene: &Scene) -> Vec<Value> {
    scene.lights.iter().zip(luminous_fluxes(scene)).map(|(light, flux)| numbers(light, flux)).collect()
}

/// Materials that shine by themselves, each with its luminance in cd/m², which is null where it varies.
pub(super) fn emissive_materials(scene: &Scene) -> Vec<Value> {
    let shining = scene.materials.iter().filter(|material| material.shines());
    shining.map(|material| json!({ "path": &*material.origin.name, "luminance_cd_m2": luminance_sent(material) })).collect()
}

/// The sum of what the closures send, where it is the same everywhere.
fn luminance_sent(material: &Material) -> Option<f32> {
    let constant = |input| match input {
        Input::Constant(value) => Some(value),
        Input::Node(..) => None,
    };
    material.closures.iter().try_fold(0.0, |sum, closure| {
        let Some(colour) = closure.input("emission_color") else { return Some(sum) };
        let (colour, weight) = (constant(colour)?, constant(closure.weight)?);
        Some(sum + luminance_of_pixel([0, 1, 2].map(|channel| colour[channel] * weight[channel])))
    })
}

fn numbers(light: &Light, flux: Option<f64>) -> Value {
    let (strength, unit) = strength(light).unzip();
    let position = light.transform.columns[3];
    json!({
        "path": &*light.origin.name,
        "what": describe(light, Words::english()),
        "shape": name_of(light.shape),
        "size_m": has_extent(light.shape).then(|| extents(light)),
        "position_m": (!light.shape.is_at_infinity()).then_some(position),
        "angle_deg": match light.shape {
            LightShape::Distant { angle_deg } => Some(angle_deg),
            _ => None,
        },
        "strength": strength,
        "unit": unit,
        "distance_m": match light.quantity {
            Some(LightQuantity::Lux { distance, .. }) => Some(distance),
            _ => None,
        },
        "dimming": light.dimming,
        "maintenance": light.maintenance,
        "flux_lm": flux,
        "colour": of_luminance_1(light.emission.radiance),
        "textured": light.texture.is_some(),
        "measured": light.goniogram.is_some(),
        "seen_by_camera": light.visibility.camera,
        "group": (!light.group.is_empty()).then_some(&light.group),
    })
}

fn has_extent(shape: LightShape) -> bool {
    match shape {
        LightShape::Point | LightShape::Distant { .. } | LightShape::Dome { .. } => false,
        LightShape::Opening(opening) => opening.shape != OpeningShape::Point,
        _ => true,
    }
}

fn name_of(shape: LightShape) -> &'static str {
    match shape {
        LightShape::Rectangle { .. } => "rectangle",
        LightShape::Disk { .. } => "disk",
        LightShape::Ellipse { .. } => "ellipse",
        LightShape::Sphere { .. } => "sphere",
        LightShape::FacingDisk { .. } => "facing disk",
        LightShape::Point => "point",
        LightShape::Cylinder { .. } => "cylinder",
        LightShape::Opening(_) => "opening",
        LightShape::Distant { .. } => "distant",
        LightShape::Dome { .. } => "dome",
    }
}

/// Linear Rec.709 of luminance 1; `None` for black.
fn of_luminance_1(radiance: [f32; 3]) -> Option<[f32; 3]> {
    let luminance = luminance_of_pixel(radiance);
    (luminance != 0.0).then(|| radiance.map(|x| x / luminance))
}
