//! Meshes that `MeshLightAPI` makes lights: their materials shine.

use crate::context::Context;
use crate::lamp_spectrum::lamp_spectrum;
use crate::light::{input, radiance, report_left_out, tint};
use crate::light_filter;
use crate::photometry;
use crate::prim::Prim;
use gonio::colour::luminance_of_pixel;
use gonio::scene::{Channel, Closure, Input, Material, MaterialId, Operation, lumens_per_watt};

/// Whether a light is made of the prim's geometry.
pub(crate) fn is_geometry_light(prim: &Prim<'_>) -> bool {
    prim.applied_schemas().iter().any(|schema| matches!(schema.as_str(), "MeshLightAPI" | "VolumeLightAPI"))
}

/// The material of a prim that `MeshLightAPI` makes a light: the bound one with the light's emission. `area` is the mesh's in square units of
/// the stage, for `normalize`.
pub(crate) fn material<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, bound: MaterialId, area: Option<f64>) -> MaterialId {
    let origin = prim.origin();
    if !prim.applied_schemas().iter().any(|schema| schema == "MeshLightAPI") {
        context.unsupported("VolumeLightAPI", &origin);
        return bound;
    }
    let Some(mut radiance) = radiance(context, prim) else {
        return bound;
    };
    let square_metres = area.map(|area| area * context.metres_per_unit.powi(2));
    let mode: String = context.get(prim, "light:materialSyncMode").unwrap_or_default();
    let of_material = context.scene.materials.get(bound.index()).and_then(|base| base.spectrum.clone());
    let spectrum = lamp_spectrum(context, prim).or(of_material.filter(|_| mode != "noMaterialResponse"));
    if let Some(luminance) = photometry::of_mesh(context, prim, square_metres, lumens_per_watt(spectrum.as_deref())) {
        let tint = tint(context, prim);
        let own = f64::from(luminance_of_pixel(tint));
        radiance = tint.map(|x| if own > 0.0 { (f64::from(x) * luminance / own) as f32 } else { 0.0 });
    } else if input(context, prim, "normalize").unwrap_or(false) {
        match area.filter(|area| *area > 0.0) {
            Some(area) => radiance = radiance.map(|x| (f64::from(x) / area) as f32),
            None => context.warn(&origin, "normalize of a mesh light needs the mesh's area, which is zero or unknown; it is ignored"),
        }
    }
    let dimming: f32 = photometry::factors(context, prim).into_iter().product();
    radiance = radiance.map(|x| x * dimming);
    photometry::report_unused_of_mesh(context, prim);
    report_left_out(context, prim);
    light_filter::report(context, prim);
    for name in ["diffuse", "specular"] {
        if input::<f32>(context, prim, name).is_some_and(|factor| factor != 1.0) {
            context.unsupported(&format!("the {name} multiplier of mesh lights"), &prim.origin());
        }
    }
    if prim.has_authored_prefix("inputs:shaping:") {
        context.unsupported("shaping of mesh lights", &origin);
    }
    let Some(base) = context.scene.materials.get(bound.index()) else {
        return bound;
    };
    let mut material = if mode == "noMaterialResponse" { Material::diffuse(origin.clone(), [0.0; 3]) } else { base.clone() };
    let base_shines = material.shines();
    material.origin = origin.clone();
    emit(&mut material, radiance, mode != "independent");
    if mode == "independent" && spectrum.is_some() && base_shines {
        context.warn(&origin, "the light's spectrum is that of what its material sends, too");
    }
    material.spectrum = spectrum;
    context.scene.add_material(material)
}

/// Adds the light to what the material emits itself, or tints a material's glow with it.
fn emit(material: &mut Material, [r, g, b]: [f32; 3], tints: bool) {
    let light = Input::Constant([r, g, b, 1.0]);
    let glow = |surface: &Closure| surface.input("emission_color").filter(|glow| !matches!(glow, Input::Constant([0.0, 0.0, 0.0, _])));
    let is_tinted = tints && material.closures.iter().any(|surface| glow(surface).is_some());
    if !is_tinted && material.closures.len() > 1 {
        // Closures have shares of the surface, the light has all of it.
        let mut whole = Closure::default();
        whole.set_colour("base_color", [0.0; 3]);
        whole.set("specular_weight", 0.0);
        whole.set_input("emission_color", light);
        material.closures.push(whole);
        return;
    }
    for surface in &mut material.closures {
        let emission = match glow(surface) {
            None if is_tinted => continue,
            None => light,
            Some(Input::Constant(glow)) if tints => Input::Constant([glow[0] * r, glow[1] * g, glow[2] * b, 1.0]),
            Some(Input::Constant(glow)) => Input::Constant([glow[0] + r, glow[1] + g, glow[2] + b, 1.0]),
            Some(node) => {
                let operation = if tints { Operation::Multiply } else { Operation::Add };
                Input::Node(material.graph.add(operation, vec![node, light]), Channel::Rgb)
            }
        };
        surface.set_input("emission_color", emission);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_light_tints_a_glow_or_adds_to_it() {
        let mut material = Material::default();
        material.closures[0].set_colour("emission_color", [1.0, 0.5, 0.0]);
        let mut sum = material.clone();
        emit(&mut material, [2.0; 3], true);
        emit(&mut sum, [2.0; 3], false);
        assert_eq!(material.closures[0].input("emission_color"), Some(Input::Constant([2.0, 1.0, 0.0, 1.0])));
        assert_eq!(sum.closures[0].input("emission_color"), Some(Input::Constant([3.0, 2.5, 2.0, 1.0])));
    }

    #[test]
    fn a_light_on_several_closures_has_all_of_the_surface() {
        let mut material = Material::default();
        material.closures.push(Closure { weight: Input::Constant([0.5; 4]), ..Closure::default() });
        emit(&mut material, [2.0; 3], true);
        assert_eq!(material.closures.len(), 3);
        assert_eq!(material.closures[2].input("emission_color"), Some(Input::Constant([2.0, 2.0, 2.0, 1.0])));
    }
}
