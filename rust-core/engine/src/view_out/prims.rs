//! Elements of the scene that somebody named as ground or as openings.

use super::task::ViewTask;
use crate::{
    compile::CompiledScene,
    error::{Error, Result},
    scene::{MaterialId, Scene},
    transport::MaterialTable,
};

/// By number of the scene's sets of instances, whether they are meant.
#[derive(Debug)]
pub(super) struct Prims {
    ground: Vec<bool>,
    openings: Vec<bool>,
    names_ground: bool,
    names_openings: bool,
}

impl Prims {
    /// Looks the task's names up.
    ///
    /// # Errors
    /// A name that no surface has, an opening that is opaque.
    pub(super) fn find(scene: &Scene, task: &ViewTask, compiled: &CompiledScene) -> Result<Self> {
        let found = Self {
            ground: named(scene, "ground", &task.ground)?,
            openings: named(scene, "openings", &task.openings)?,
            names_ground: !task.ground.is_empty(),
            names_openings: !task.openings.is_empty(),
        };
        for name in &task.openings {
            let one = named(scene, "openings", std::slice::from_ref(name))?;
            if !lets_see(scene, &compiled.tables.materials, &one) {
                let problem = format!("nobody sees through {name}; name what has a clear pane, or lay a clear sheet into the hole");
                return Err(Error::setting("openings", problem));
            }
        }
        Ok(found)
    }

    pub(super) fn are_openings_named(&self) -> bool {
        self.names_openings
    }

    pub(super) fn is_opening(&self, set: u32) -> bool {
        self.openings.get(set as usize).copied().unwrap_or(false)
    }

    /// Whether a set is ground; none where nobody said what is.
    pub(super) fn is_ground(&self, set: u32) -> Option<bool> {
        self.names_ground.then(|| self.ground.get(set as usize).copied().unwrap_or(false))
    }
}

/// Whether each set of instances stands at one of the names, or below.
fn named(scene: &Scene, setting: &str, names: &[String]) -> Result<Vec<bool>> {
    let mut found = vec![false; scene.instances.len()];
    for name in names {
        let below: Vec<bool> = scene.instances.iter().map(|set| set.origin.is_below(name)).collect();
        if !below.contains(&true) {
            return Err(Error::setting(setting, format!("'{name}' has no surface; name a prim of the stage by its path, as /Site/Lawn")));
        }
        found.iter_mut().zip(below).for_each(|(found, below)| *found |= below);
    }
    Ok(found)
}

/// Whether any material of some sets may be seen through.
fn lets_see(scene: &Scene, materials: &MaterialTable, chosen: &[bool]) -> bool {
    let number = |material: &MaterialId| materials.number(material.index());
    let is_clear = |number: u32| materials.lets_light_pass(number) || materials.is_clear_solid(number);
    let sets = scene.instances.iter().zip(chosen).filter(|(_, chosen)| **chosen);
    sets.flat_map(|(set, _)| &set.materials).map(number).any(is_clear)
}
