//! What light paths leave out or carry otherwise than camera paths find it, told where they carry all of the light.

use super::lights::MOST_EMISSIVE_TRIANGLES;
use crate::{
    error::Diagnostic,
    geometry::NONE,
    scene::{Instances, Light, Scene},
    transport::Tables,
};

/// One warning a kind, at the first prim: surfaces whose light is missing, and lamps whose light differs.
pub(crate) fn unfollowed(scene: &Scene, tables: &Tables) -> Vec<Diagnostic> {
    let lamps = |differs: fn(&Light) -> bool, message: &str| {
        let found: Vec<_> = scene.lights.iter().filter(|light| !light.portal && differs(light)).map(|light| &light.origin).collect();
        found.first().map(|first| Diagnostic::warning(first, format!("{message}{}", others(found.len()))))
    };
    let factors = |light: &Light| [light.diffuse, light.specular, light.volume] != [1.0; 3];
    let dark = [
        missing(scene, tables),
        lamps(|light| !light.casts_shadow, "it casts no shadows, but light paths end at what stands in the way"),
        lamps(
            |light| light.falloff.power != 0 || light.falloff.smooth != 0.0,
            "light paths know nothing of its falloff: it falls by nature",
        ),
        lamps(factors, "light paths know nothing of its factors on diffuse, specular and volume light"),
    ];
    dark.into_iter().flatten().collect()
}

/// Surfaces that shine where no light path starts.
fn missing(scene: &Scene, tables: &Tables) -> Option<Diagnostic> {
    let materials = &tables.materials;
    let any = |set: &Instances, of_kind: &dyn Fn(usize) -> bool| set.materials.iter().any(|material| of_kind(material.index()));
    let mut starts = vec![true; scene.instances.len()];
    let rows = tables.geometry.instances.iter().take(tables.first_light_instance as usize);
    for (instance, row) in rows.enumerate() {
        let sampled = tables.triangle_lights.get(instance).is_some_and(|first| *first != NONE);
        if let Some(starts) = starts.get_mut(row.set as usize) {
            *starts &= sampled;
        }
    }
    let is_missing = |(set, starts): &(&Instances, bool)| {
        !set.transforms.is_empty()
            && (any(set, &|material| materials.emits_unknown(material))
                || !starts && any(set, &|material| materials.is_sampled(materials.number(material))))
    };
    let found: Vec<_> = scene.instances.iter().zip(starts).filter(is_missing).collect();
    let (first, _) = found.first()?;
    let message = format!(
        "its own light is missing: light paths start at meshes that stand still, of {MOST_EMISSIVE_TRIANGLES} triangles in all, that other surfaces see, \
         and whose emission does not depend on the bounces before{}",
        others(found.len())
    );
    Some(Diagnostic::warning(&first.origin, message))
}

/// How many more a message is of.
fn others(count: usize) -> String {
    if count > 1 { format!("; so with {} more", count - 1) } else { String::new() }
}
