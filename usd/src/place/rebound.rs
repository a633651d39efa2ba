//! Materials of what stands in native instances whose bindings come from outside: looked up for the whole stage in one call, because `pxr` reads
//! the collections above anew in each.

use super::Placement;
use crate::context::Context;
use crate::material;
use crate::model::{Kind, Model};
use crate::options::Purpose;
use gonio::scene::MaterialId;
use std::collections::HashMap;

/// Materials by the path of the prim as it stands in its instance.
pub(super) fn materials(context: &mut Context<'_, '_>, world: &Model, placement: &Placement) -> HashMap<String, MaterialId> {
    let mut paths = Vec::new();
    collect(context, world, placement, None, &mut paths);
    let found = paths.into_iter().filter_map(|path| Some((context.prim_at(&path)?, path)));
    let (prims, paths): (Vec<_>, Vec<_>) = found.unzip();
    if prims.is_empty() {
        return HashMap::new();
    }
    paths.into_iter().zip(material::bound_all(context, &prims)).collect()
}

fn collect(context: &Context<'_, '_>, model: &Model, placement: &Placement, purpose: Option<Purpose>, paths: &mut Vec<String>) {
    for element in &model.elements {
        let purpose = element.purpose.or(purpose);
        match &element.kind {
            Kind::Group(group) => {
                collect(context, &group.model, &placement.inside(element, group), purpose, paths);
            }
            Kind::Shape(shape) if placement.is_rebound && context.options.shows(purpose.unwrap_or_default()) => {
                paths.extend(shape.slot_prims.iter().map(|path| placement.path(path)));
            }
            _ => {}
        }
    }
}
