//! Groups of openings by which light is told apart.

use crate::{
    compile::CompiledScene,
    scene::{Instances, Scene, is_below},
    transport::Openings,
};
use std::sync::Arc;

/// Whether a set's placement is a prim of these or below one.
pub fn is_of(set: &Instances, placement: usize, prims: &[String]) -> bool {
    let name = || set.matte_names.iter().rev().find(|name| name.first as usize <= placement);
    let is_named = |prim: &String| name().is_some_and(|name| is_below(&name.object, prim));
    prims.iter().any(|prim| set.origin.is_below(prim) || is_named(prim))
}

/// The groups of a scene's instances, the first of which has the number 1; `None` where there is no group.
pub(super) fn openings(scene: &Scene, compiled: &CompiledScene, groups: &[Vec<String>]) -> Option<Arc<Openings>> {
    if groups.is_empty() {
        return None;
    }
    let group = |set: usize, placement: usize| {
        let set = scene.instances.get(set)?;
        groups.iter().position(|prims| is_of(set, placement, prims)).map(|place| place as u32 + 1)
    };
    let of_instance = compiled.tables.geometry.instances.iter();
    let of_instance = of_instance.map(|row| group(row.set as usize, row.number as usize).unwrap_or_default()).collect();
    Some(Arc::new(Openings { of_instance }))
}
