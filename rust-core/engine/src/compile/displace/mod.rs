//! Displacement: meshes whose points have moved to where the graphs of their materials say, before anything else is laid out.
//!
//! A mesh is displaced once for each choice of displaced materials that its placements show, and these share it. Points of one place move alike,
//! by the mean of what their corners say, so that seams stay closed.

mod corners;
mod field;
mod kept;
mod moved;
mod recipe;

use super::{cancel::check, materials, textures::CompiledTextures};
use crate::{
    error::{Diagnostic, Result},
    scene::{MeshId, Scene},
    transport::MaterialTable,
};
use kept::Ingredients;
pub(super) use kept::KeptDisplaced;
use moved::displaced;
use recipe::{Recipe, recipes};
use std::sync::atomic::AtomicBool;

/// A scene whose meshes are displaced, and what it leaves for the next.
#[derive(Debug)]
pub(super) struct Displaced {
    pub(super) scene: Scene,
    pub(super) kept: Vec<KeptDisplaced>,
}

/// What displacement reads beside the scene.
#[derive(Clone, Copy)]
pub(super) struct Laid<'a> {
    pub(super) textures: &'a CompiledTextures,
    pub(super) materials: &'a MaterialTable,
    pub(super) names: &'a [String],
}

/// The scene with displaced meshes; none where no material displaces anything.
pub(super) fn apply(
    scene: &Scene,
    laid: Laid<'_>,
    previous: &[KeptDisplaced],
    cancel: &AtomicBool,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<Option<Displaced>> {
    tell_strands(scene, diagnostics);
    let recipes = recipes(scene, laid.textures, laid.names, diagnostics)?;
    if recipes.is_empty() {
        return Ok(None);
    }
    let mut made = Displaced { scene: scene.clone(), kept: Vec::new() };
    let mut room = scene.settings.displacement_memory;
    for recipe in &recipes {
        check(cancel)?;
        let kept = match previous.iter().find(|kept| kept.is_of(scene, recipe)) {
            Some(kept) => kept.clone(),
            None => {
                let (mesh, told) = displaced(scene, recipe, laid, room, cancel)?;
                KeptDisplaced { ingredients: Ingredients::of(scene, recipe), mesh, told }
            }
        };
        diagnostics.extend(kept.told.iter().cloned());
        room = room.saturating_sub(kept.mesh.memory() as u64);
        put(&mut made.scene, recipe, &kept);
        made.kept.push(kept);
    }
    Ok(Some(made))
}

/// Shows a recipe's placements the displaced mesh; the first of a mesh takes its place, if nobody shows it as it was.
fn put(scene: &mut Scene, recipe: &Recipe, kept: &KeptDisplaced) {
    let number = if recipe.in_place {
        scene.meshes[recipe.mesh] = kept.mesh.clone();
        recipe.mesh
    } else {
        scene.meshes.push(kept.mesh.clone());
        scene.meshes.len() - 1
    };
    for set in &recipe.sets {
        scene.instances[*set].geometry = MeshId(number as u32).into();
    }
}

/// Says which curves and points would be displaced.
fn tell_strands(scene: &Scene, diagnostics: &mut Vec<Diagnostic>) {
    let displaces = |id: &crate::scene::MaterialId| scene.materials.get(id.index()).is_some_and(materials::displaces);
    for set in scene.instances.iter().filter(|set| set.geometry.mesh().is_none() && set.materials.iter().any(displaces)) {
        diagnostics.push(Diagnostic::warning(&set.origin, "displacement of curves and points is left out"));
    }
}
