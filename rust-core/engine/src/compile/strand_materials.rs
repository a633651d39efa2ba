//! Materials of curves and points: no walk goes under their surfaces, which are met from outside alone.

use crate::{
    error::Diagnostic,
    scene::{Closure, MaterialId, Scene},
};
use std::collections::HashMap;

fn has_subsurface(closure: &Closure) -> bool {
    closure.input("subsurface_weight").is_some()
}

/// The scene with diffuse materials in place of those with subsurface scattering on curves and points; none where there are no such.
pub(super) fn without_subsurface(scene: &Scene, diagnostics: &mut Vec<Diagnostic>) -> Option<Scene> {
    let scatters = |id: &MaterialId| scene.materials.get(id.index()).is_some_and(|material| material.closures.iter().any(has_subsurface));
    if !scene.instances.iter().any(|group| group.geometry.mesh().is_none() && group.materials.iter().any(scatters)) {
        return None;
    }
    let mut changed = scene.clone();
    let mut diffuse: HashMap<MaterialId, MaterialId> = HashMap::new();
    for number in 0..changed.instances.len() {
        if changed.instances[number].geometry.mesh().is_some() {
            continue;
        }
        let mut materials = changed.instances[number].materials.clone();
        for id in materials.iter_mut().filter(|id| scatters(id)) {
            *id = *diffuse.entry(*id).or_insert_with(|| {
                let mut material = scene.materials[id.index()].clone();
                let parameters = material.closures.iter_mut().map(|closure| &mut closure.parameters);
                parameters.for_each(|parameters| parameters.retain(|(name, _)| name != "subsurface_weight"));
                changed.materials.push(material);
                MaterialId(changed.materials.len() as u32 - 1)
            });
        }
        if materials == changed.instances[number].materials {
            continue;
        }
        let group = &mut changed.instances[number];
        group.materials = materials;
        diagnostics.push(Diagnostic::warning(&group.origin, "subsurface scattering of curves and points is shown as diffuse reflection"));
    }
    Some(changed)
}
