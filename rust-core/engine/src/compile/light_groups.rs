//! Light groups: names in the scene as numbers in the tables, and those that a view shows.

use crate::{
    error::Diagnostic,
    geometry::{GeometryTable, NONE},
    scene::{Aov, OTHER_LIGHTS, Scene, Settings},
    transport::{GroupPasses, LightGroups, MaterialTable, UNSEEN},
};

/// The groups met so far.
#[derive(Debug, Default)]
pub(super) struct GroupNames {
    names: Vec<String>,
    /// The group of each light record.
    pub(super) of_light: Vec<u32>,
}

impl GroupNames {
    /// A group's number.
    pub(super) fn number(&mut self, name: &str) -> u32 {
        let name = if name.is_empty() { OTHER_LIGHTS } else { name };
        let known = self.names.iter().position(|known| known == name);
        known.unwrap_or_else(|| {
            self.names.push(name.to_owned());
            self.names.len() - 1
        }) as u32
    }

    /// All groups, with those of what sets of instances emit: of `lights` records, the triangles come last.
    pub(super) fn with_instances(mut self, scene: &Scene, geometry: &GeometryTable, triangle_lights: &[u32], lights: usize) -> LightGroups {
        let mut of_set: Vec<u32> = scene.instances.iter().map(|set| self.number(&set.light_group)).collect();
        let other = self.number("");
        // Hits of no instance are gathered too, and thrown away.
        of_set.push(other);
        let mut of_light = self.of_light;
        of_light.resize(lights.max(1), other);
        for (instance, first) in triangle_lights.iter().enumerate().filter(|(_, first)| **first != NONE) {
            let row = &geometry.instances[instance];
            let count = scene.meshes[row.mesh as usize].triangles.len();
            of_light[*first as usize..*first as usize + count].fill(of_set[row.set as usize]);
        }
        LightGroups { names: self.names, of_light, of_set }
    }
}

/// Tells media which sets they are of; gives a note of those that sets of several groups share, whose light is in none.
pub(super) fn own_media(scene: &Scene, materials: &mut MaterialTable) -> Option<Diagnostic> {
    let none = scene.instances.len() as u32;
    let mut owners: Vec<Option<u32>> = vec![None; materials.media.len()];
    let mut shared = None;
    for (number, set) in scene.instances.iter().enumerate() {
        let known = set.materials.iter().map(|material| material.index()).filter(|index| *index < materials.numbers.len());
        for row in known.flat_map(|index| materials.media_of(materials.number(index))) {
            let owner = &mut owners[row as usize - 1];
            match *owner {
                None => *owner = Some(number as u32),
                Some(first) if first != none && scene.instances[first as usize].light_group != set.light_group => {
                    *owner = Some(none);
                    shared.get_or_insert(&set.origin);
                }
                Some(_) => {}
            }
        }
    }
    let owners: Vec<u32> = owners.into_iter().map(|owner| owner.unwrap_or(none)).collect();
    materials.media.set_owners(&owners);
    let is_asked = scene.settings.aovs.iter().any(|aov| matches!(aov, Aov::LightGroup(_)));
    let message = "what fills it is the same as in objects of another light group; what that sends counts as of no group";
    shared.filter(|_| is_asked && materials.media.shines()).map(|origin| Diagnostic::warning(origin, message))
}

/// What a view shows of the groups; names that no light has show nothing.
pub(super) fn passes(groups: &LightGroups, settings: &Settings) -> GroupPasses {
    if !settings.aovs.iter().any(|aov| matches!(aov, Aov::LightGroup(_))) {
        return GroupPasses::default();
    }
    let shown = |name: &String| settings.light_groups.iter().position(|asked| asked == name).map_or(UNSEEN, |number| number as u32);
    let numbers: Vec<u32> = groups.names.iter().map(shown).collect();
    let renumbered = |list: &[u32]| list.iter().map(|group| numbers[*group as usize]).collect();
    GroupPasses { of_light: renumbered(&groups.of_light), of_set: renumbered(&groups.of_set), count: settings.light_groups.len() }
}
