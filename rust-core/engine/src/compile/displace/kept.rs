//! What one compilation leaves for the next: displaced meshes by what they were made of.

use super::super::kept::Stamp;
use super::recipe::Recipe;
use crate::{
    error::Diagnostic,
    scene::{Displacement, Graph, Mesh, Operation, Primvar, Scene, Transform},
};

/// A displaced mesh.
#[derive(Clone, Debug)]
pub(in crate::compile) struct KeptDisplaced {
    pub(super) ingredients: Ingredients,
    pub(super) mesh: Mesh,
    /// What was said of it.
    pub(super) told: Vec<Diagnostic>,
}

/// What a displaced mesh was made of.
#[derive(Clone, Debug)]
pub(super) struct Ingredients {
    mesh: Mesh,
    fields: Vec<Option<(Graph, Displacement)>>,
    images: Vec<Stamp>,
    /// Where the first placements stand, and what values they have, where it depends on that.
    placements: Vec<(Transform, Vec<Primvar>)>,
    limit: u64,
    blurs: bool,
}

/// Placements that count.
const PLACEMENTS: usize = 8;

impl Ingredients {
    pub(super) fn of(scene: &Scene, recipe: &Recipe) -> Self {
        let fields = recipe.slots.iter().map(|field| field.as_ref().map(|field| (field.graph.clone(), field.displacement)));
        let images = recipe.fields().flat_map(|field| &field.graph.nodes).filter_map(|node| match &node.operation {
            Operation::Image { texture, .. } => scene.textures.get(texture.index()).map(Stamp::of),
            _ => None,
        });
        let sets = recipe.sets.iter().map(|set| &scene.instances[*set]).filter(|set| recipe.asks_for_placement(set));
        let placed = sets.flat_map(|set| set.transforms.iter().take(PLACEMENTS).map(|transform| (*transform, set.primvars.clone())));
        Self {
            mesh: scene.meshes[recipe.mesh].clone(),
            fields: fields.collect(),
            images: images.collect(),
            placements: placed.take(PLACEMENTS).collect(),
            limit: scene.settings.displacement_memory,
            blurs: crate::compile::times::blurs(&scene.settings),
        }
    }
}

impl KeptDisplaced {
    /// Whether it was made of what a recipe asks for now.
    pub(super) fn is_of(&self, scene: &Scene, recipe: &Recipe) -> bool {
        let (old, mesh) = (&self.ingredients, &scene.meshes[recipe.mesh]);
        if !old.mesh.holds_arrays_of(mesh) {
            return false;
        }
        let new = Ingredients::of(scene, recipe);
        let same_images = old.images.len() == new.images.len() && old.images.iter().zip(&new.images).all(|(old, new)| old.is(new));
        same_images && old.fields == new.fields && old.placements == new.placements && (old.limit, old.blurs) == (new.limit, new.blurs)
    }
}
