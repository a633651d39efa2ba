//! Light and shadow linking: lights that are linked alike become sets, and instances that are linked to alike classes.

use crate::{
    accel::{Blockers, Instance},
    error::Diagnostic,
    geometry::{GeometryTable, NONE},
    light::{LightLinks, LightRecord},
    scene::{Link, Linking, Scene},
    transport::{Links, ray_mask},
};
use std::collections::HashMap;

/// Bits of all rows of blockers together; where there would be more, all instances block all lights.
const MOST_BITS: usize = 1 << 31;

/// Links as tables.
#[derive(Debug, Default)]
pub(super) struct CompiledLinking {
    pub(super) tables: Links,
    /// Whether the instances of each set block the lights whose blockers go by a visibility bit.
    blocks_by_mask: Vec<bool>,
}

/// Links of one kind that differ, numbered from 1 on; 0 stands for all.
#[derive(Default)]
struct Numbered<'a> {
    number_of: HashMap<&'a Link, u32>,
    links: Vec<&'a Link>,
}

impl<'a> Numbered<'a> {
    fn number(&mut self, link: &'a Link) -> u32 {
        if *link == Link::All {
            return 0;
        }
        *self.number_of.entry(link).or_insert_with(|| {
            self.links.push(link);
            self.links.len() as u32
        })
    }

    /// By instance set, the numbers of links that name it.
    fn named(&self, sets: usize) -> Vec<Vec<u32>> {
        let mut named = vec![Vec::new(); sets];
        for (number, link) in (1..).zip(&self.links) {
            let (Link::Only(list) | Link::Except(list)) = link else { continue };
            for set in list {
                if let Some(numbers) = named.get_mut(*set as usize).filter(|numbers: &&mut Vec<u32>| numbers.last() != Some(&number)) {
                    numbers.push(number);
                }
            }
        }
        // A list may name a set twice.
        named.iter_mut().for_each(|numbers| numbers.dedup());
        named
    }

    fn only(&self, number: u32) -> bool {
        matches!(self.links[number as usize - 1], Link::Only(_))
    }
}

impl CompiledLinking {
    /// The tables, and what the light table is to know; `light_of` gives the light in the scene of the first records, the others are those of
    /// `triangle_lights`. Marks the records of lights with blockers of their own.
    pub(super) fn new(
        scene: &Scene,
        geometry: &GeometryTable,
        light_of: &[u32],
        triangle_lights: &[u32],
        records: &mut [LightRecord],
        diagnostics: &mut Vec<Diagnostic>,
    ) -> (Self, Option<LightLinks>) {
        let all = || scene.lights.iter().map(|light| &light.linking).chain(scene.instances.iter().map(|set| &set.linking));
        if all().all(Linking::is_whole) {
            return (Self::default(), None);
        }
        report_unknown(scene, diagnostics);
        let (mut receivers, mut blockers) = (Numbered::default(), Numbered::default());
        let of_lights: Vec<[u32; 2]> = all().map(|link| [receivers.number(&link.receivers), blockers.number(&link.blockers)]).collect();
        let (of_lights, of_sets) = of_lights.split_at(scene.lights.len());
        let mut of_records: Vec<[u32; 2]> = light_of.iter().map(|light| of_lights[*light as usize]).collect();
        of_records.resize(records.len().max(1), [0; 2]);
        for (instance, first) in triangle_lights.iter().enumerate().filter(|(_, first)| **first != NONE) {
            let row = &geometry.instances[instance];
            let count = scene.meshes[row.mesh as usize].triangles.len();
            of_records[*first as usize..*first as usize + count].fill(of_sets[row.set as usize]);
        }
        let mut linking = Self::default();
        let links = linking.link_receivers(scene, geometry, &receivers, &of_records, of_sets);
        linking.link_blockers(scene, geometry, &blockers, &of_records, records, diagnostics);
        (linking, links)
    }

    fn link_receivers(
        &mut self,
        scene: &Scene,
        geometry: &GeometryTable,
        receivers: &Numbered<'_>,
        of_records: &[[u32; 2]],
        of_sets: &[[u32; 2]],
    ) -> Option<LightLinks> {
        let count = receivers.links.len() as u32;
        if count == 0 {
            return None;
        }
        let named = receivers.named(scene.instances.len());
        let (only, except): (Vec<u32>, Vec<u32>) = (1..=count).partition(|number| receivers.only(*number));
        // Who is named by all that light those alone whom they name, and by no other link, sees all lights.
        let mut classes: HashMap<&[u32], u32> = HashMap::from([(only.as_slice(), 0)]);
        let mut of_class = vec![only.as_slice()];
        let class_of: Vec<u32> = named
            .iter()
            .map(|numbers| {
                *classes.entry(numbers).or_insert_with(|| {
                    of_class.push(numbers);
                    of_class.len() as u32 - 1
                })
            })
            .collect();
        let mut links = LightLinks::new(of_records.iter().map(|[set, _]| *set).collect(), of_class.len(), count as usize + 1);
        for (class, numbers) in (0..).zip(&of_class).skip(1) {
            links.allow(class, 0);
            let excepting = except.iter().filter(|number| numbers.binary_search(number).is_err());
            let naming = numbers.iter().filter(|number| receivers.only(**number));
            excepting.chain(naming).for_each(|set| links.allow(class, *set));
        }
        let of_instances = |of_set: &dyn Fn(usize) -> u32| {
            geometry
                .instances
                .iter()
                .map(|row| if (row.set as usize) < scene.instances.len() { of_set(row.set as usize) } else { 0 })
                .collect()
        };
        self.tables.receivers = of_instances(&|set| class_of[set]);
        if of_sets.iter().any(|[set, _]| *set != 0) {
            self.tables.emitters = of_instances(&|set| of_sets[set][0]);
        }
        links.any_sees_all = class_of.contains(&0) || !scene.meters.is_empty() || !scene.grids.is_empty();
        Some(links)
    }

    fn link_blockers(
        &mut self,
        scene: &Scene,
        geometry: &GeometryTable,
        blockers: &Numbered<'_>,
        of_records: &[[u32; 2]],
        records: &mut [LightRecord],
        diagnostics: &mut Vec<Diagnostic>,
    ) {
        let rows = blockers.links.len();
        if rows == 0 {
            return;
        }
        if (rows + 1).saturating_mul(geometry.instances.len()) > MOST_BITS {
            let message = "there are too many lights with shadows of their own; all that casts shadows blocks them";
            diagnostics
                .push(Diagnostic::warning(&scene.lights.first().map_or_else(Default::default, |light| light.origin.clone()), message));
            return;
        }
        for (record, [_, row]) in records.iter_mut().zip(of_records).filter(|(_, [_, row])| *row != 0) {
            record.sampled_alone = true;
            record.casts_shadow &= !matches!(blockers.links[*row as usize - 1], Link::Only(list) if list.is_empty());
        }
        let sets = 0..scene.instances.len() as u32;
        let blocks: Vec<Vec<bool>> = blockers.links.iter().map(|link| members(link, sets.clone())).collect();
        self.tables.blockers = Blockers::new(rows + 1, geometry.instances.len());
        for (instance, row) in geometry.instances.iter().enumerate() {
            for (number, blocks) in (1..).zip(&blocks) {
                if blocks.get(row.set as usize) == Some(&true) {
                    self.tables.blockers.block(number, instance);
                }
            }
        }
        self.tables.shadows = of_records.iter().map(|[_, row]| *row).collect();
        // Rays among shadow catchers alone have a visibility bit of their own.
        if geometry.set_catcher.is_empty() {
            self.tables.by_mask = 1;
            self.blocks_by_mask = blocks.into_iter().next().unwrap_or_default();
        }
    }

    /// Lets instances block the lights that go by a visibility bit.
    pub(super) fn set_masks(&self, geometry: &GeometryTable, instances: &mut [Instance]) {
        for (instance, row) in instances.iter_mut().zip(&geometry.instances) {
            if self.blocks_by_mask.get(row.set as usize) == Some(&true) && instance.mask & ray_mask::SHADOW != 0 {
                instance.mask |= ray_mask::LINKED_SHADOW;
            }
        }
    }
}

/// Which instance sets a link names.
fn members(link: &Link, sets: std::ops::Range<u32>) -> Vec<bool> {
    let (list, named) = match link {
        Link::All => return sets.map(|_| true).collect(),
        Link::Only(list) => (list, true),
        Link::Except(list) => (list, false),
    };
    let mut members = vec![!named; sets.len()];
    for set in list {
        if let Some(member) = members.get_mut(*set as usize) {
            *member = named;
        }
    }
    members
}

/// Says which links name what is not there.
fn report_unknown(scene: &Scene, diagnostics: &mut Vec<Diagnostic>) {
    let known = scene.instances.len() as u32;
    let lights = scene.lights.iter().map(|light| (&light.origin, &light.linking));
    for (origin, linking) in lights.chain(scene.instances.iter().map(|set| (&set.origin, &set.linking))) {
        for (role, link) in [("receivers", &linking.receivers), ("blockers", &linking.blockers)] {
            let (Link::Only(list) | Link::Except(list)) = link else { continue };
            if let Some(unknown) = list.iter().find(|set| **set >= known) {
                let message = format!("{role} name the instances {unknown}, the scene has {known} sets of instances; they are left out");
                diagnostics.push(Diagnostic::warning(origin, message));
            }
        }
    }
}
