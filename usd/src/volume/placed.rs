//! Placed volumes, which come into the scene when all else is in it.

use super::Filling;
use crate::context::Context;
use crate::roles::Role;
use gonio::scene::{Field, MatteName, Origin, Transform, Visibility};
use std::rc::Rc;

/// A volume that waits for the surfaces to be in the scene.
#[derive(Debug)]
pub(crate) struct PlacedVolume {
    pub(crate) filling: Rc<[Filling]>,
    pub(crate) to_world: Transform,
    pub(crate) origin: Origin,
    pub(crate) role: Role,
    /// The collections of links that name it.
    pub(crate) naming: Vec<u32>,
    pub(crate) matte_name: MatteName,
}

impl PlacedVolume {
    /// How many sets of instances it makes.
    fn sets(&self) -> usize {
        self.filling.len()
    }

    /// Puts it into the scene.
    fn add(self, context: &mut Context<'_, '_>) {
        let Self { filling, to_world, origin, role, matte_name, .. } = self;
        for Filling { medium, field, is_even, velocity } in filling.iter() {
            if !velocity.is_empty() {
                context.flows.add(&context.scene, velocity, field.to_world);
            }
            let field = Field { origin: origin.clone(), to_world: to_world.after(&field.to_world), ..field.clone() };
            let scene = &mut context.scene;
            let set = if *is_even { scene.add_filled(field.mesh(), *medium, field.to_world) } else { scene.add_volume(field, *medium) };
            set.visibility = Visibility { camera: role.camera, ..Visibility::default() };
            set.holdout = role.matte;
            set.matte_names.push(matte_name.clone());
        }
    }
}

/// Puts volumes into a scene behind all else, so that the number of files that are there at a time moves nothing else.
pub(crate) fn add_all(context: &mut Context<'_, '_>, volumes: Vec<PlacedVolume>) {
    volumes.into_iter().for_each(|volume| volume.add(context));
}

/// The collections that the sets of instances of volumes are named by, in the order in which they are added.
pub(crate) fn naming(volumes: &[PlacedVolume]) -> impl Iterator<Item = Vec<u32>> + '_ {
    volumes.iter().flat_map(|volume| std::iter::repeat_n(volume.naming.clone(), volume.sets()))
}
