//! Volumes of the world: each placement is a field of its own, whose numbers they share.

use super::{Placement, Placer};
use crate::material::{self, VolumeShading};
use crate::model::{Element, Inherited};
use crate::primvar;
use crate::volume::{self, Filling, PlacedVolume, Volume};
use gonio::scene::Origin;
use std::rc::Rc;

impl Placer<'_, '_, '_> {
    /// Places a volume.
    pub(super) fn volume(&mut self, element: &Element, volume: &Volume, placement: &Placement) {
        let role = self.role(element, placement);
        if !role.rendered {
            return;
        }
        let path = placement.path(&element.path);
        let primvars = primvar::merged(&element.primvars, &placement.primvars);
        let filling = self.filling(element, volume, placement, &primvars);
        if filling.is_empty() {
            return;
        }
        let instance = placement.renamed.as_ref().map(|(_, instance)| instance.as_str());
        let matte_name = super::matte_name::of(path.clone(), instance, 0, &self.assets);
        let naming = if self.links.is_empty() { Vec::new() } else { self.links.naming(placement.stand_in.as_ref().unwrap_or(&path)) };
        let origin = Origin::new(path);
        for to_world in self.transforms(element, placement) {
            if to_world.inverse().is_none() {
                let message = || "the volume is scaled to nothing along an axis; it is left out".to_owned();
                self.context.once("flat volume", &element.path, &origin, message);
                continue;
            }
            let (filling, origin, naming, matte_name) = (filling.clone(), origin.clone(), naming.clone(), matte_name.clone());
            self.volumes.push(PlacedVolume { filling, to_world, origin, role, naming, matte_name });
        }
    }

    /// What fills a volume by the material that it has where it is placed; found once a prim.
    fn filling(&mut self, element: &Element, volume: &Volume, placement: &Placement, primvars: &[Inherited]) -> Rc<[Filling]> {
        // Bindings outside of the model may count inside it.
        let bound_at = if placement.is_rebound { placement.path(&element.path) } else { element.path.clone() };
        let constant = |name: &str| {
            let found = primvars.iter().find(|value| value.name == name && !value.is_varying)?;
            let value = |part: usize| found.values.get(if found.components == 1 { 0 } else { part }).copied().unwrap_or(0.0);
            Some([value(0), value(1), value(2), value(3)])
        };
        let key = format!("{bound_at} {:?}", primvars.iter().filter(|value| !value.is_varying).collect::<Vec<_>>());
        if let Some(known) = self.fillings.get(&key) {
            return known.clone();
        }
        let origin = Origin::new(placement.path(&element.path));
        let shading = self.context.prim_at(&bound_at).and_then(|prim| material::volume_shading(self.context, &prim));
        let shading = shading.unwrap_or_else(|| self.usual(&bound_at, &origin, volume));
        let filling: Rc<[Filling]> = volume::fill(self.context, &origin, volume, &shading, &constant).into();
        self.fillings.insert(key, filling.clone());
        filling
    }

    /// What volumes without a material are.
    fn usual(&mut self, path: &str, origin: &Origin, volume: &Volume) -> Rc<VolumeShading> {
        let field = volume.density().name.clone();
        let message =
            || format!("no material says what it is; it scatters white light evenly, by its field '{field}' once a unit of the stage");
        self.context.once("volume without a material", "", origin, message);
        Rc::new(VolumeShading::usual(path.to_owned(), &field))
    }
}
