//! Which meshes are displaced, by which materials, for which placements.

use super::super::{
    materials::{self, displaces, pruned},
    textures::CompiledTextures,
};
use crate::{
    error::{Diagnostic, Result},
    graph::Program,
    scene::{Displacement, DisplacementKind, Graph, Instances, Material, Operation, Scene},
};
use std::collections::HashMap;

/// What a slot's material does.
#[derive(Debug)]
pub(super) struct SlotField {
    pub(super) graph: Graph,
    pub(super) displacement: Displacement,
    pub(super) program: Program,
}

/// A mesh that is displaced in one way.
#[derive(Debug)]
pub(super) struct Recipe {
    pub(super) mesh: usize,
    /// What each slot's material does; nothing for those that do not displace.
    pub(super) slots: Vec<Option<SlotField>>,
    /// The sets of instances that show it.
    pub(super) sets: Vec<usize>,
    /// Whether it takes the mesh's place, so that nobody else shows that.
    pub(super) in_place: bool,
}

impl Recipe {
    /// What the displaced slots are.
    pub(super) fn fields(&self) -> impl Iterator<Item = &SlotField> {
        self.slots.iter().flatten()
    }
    /// The operations of all graphs.
    fn operations(&self) -> impl Iterator<Item = &Operation> {
        self.fields().flat_map(|field| field.graph.nodes.iter().map(|node| &node.operation))
    }
    /// Names of the primvars that are read.
    pub(super) fn names(&self) -> Vec<&str> {
        let mut names: Vec<&str> = self.operations().filter_map(name_of).collect();
        names.sort_unstable();
        names.dedup();
        names
    }
    /// Whether the shape may depend on where the mesh is placed.
    pub(super) fn asks_for_placement(&self, set: &Instances) -> bool {
        let asks = |operation: &Operation| match operation {
            Operation::Primvar { name, .. } => set.primvars.iter().any(|primvar| primvar.name == *name),
            Operation::Position
            | Operation::Normal
            | Operation::GeometricNormal
            | Operation::Incoming
            | Operation::Transform { .. }
            | Operation::UvTangent { .. }
            | Operation::NormalMap { .. }
            | Operation::PositionStep { .. } => true,
            _ => false,
        };
        self.operations().any(asks) || self.fields().any(|field| field.displacement.kind == DisplacementKind::World)
    }
}

fn name_of(operation: &Operation) -> Option<&str> {
    match operation {
        Operation::Primvar { name, .. } | Operation::PrimvarStep { name, .. } => Some(name),
        Operation::UvTangent { uv } | Operation::NormalMap { uv: Some(uv), .. } => Some(uv),
        _ => None,
    }
}

/// The recipes of a scene, in the order of its sets.
pub(super) fn recipes(
    scene: &Scene,
    textures: &CompiledTextures,
    names: &[String],
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<Vec<Recipe>> {
    if !scene.materials.iter().any(displaces) {
        return Ok(Vec::new());
    }
    let mut recipes: Vec<Recipe> = Vec::new();
    // By mesh and materials of the slots that displace.
    let mut known: HashMap<(usize, Vec<Option<u32>>), usize> = HashMap::new();
    let mut plain = vec![false; scene.meshes.len()];
    for (number, set) in scene.instances.iter().enumerate() {
        let Some(mesh) = set.geometry.mesh().map(|mesh| mesh.index()).filter(|mesh| *mesh < scene.meshes.len()) else { continue };
        let ids = signature(scene, set);
        if ids.iter().all(Option::is_none) {
            plain[mesh] = true;
            continue;
        }
        if let Some(recipe) = known.get(&(mesh, ids.clone())) {
            recipes[*recipe].sets.push(number);
            continue;
        }
        let slots = ids.iter().map(|id| id.map(|id| field(&scene.materials[id as usize], textures, names)).transpose());
        let slots = slots.collect::<Result<Vec<_>>>()?;
        known.insert((mesh, ids), recipes.len());
        recipes.push(Recipe { mesh, slots, sets: vec![number], in_place: false });
    }
    for recipe in &mut recipes {
        recipe.in_place = !std::mem::replace(&mut plain[recipe.mesh], true);
    }
    tell_rays(&recipes, scene, diagnostics);
    Ok(recipes)
}

/// The displaced material of each slot that the mesh has.
fn signature(scene: &Scene, set: &Instances) -> Vec<Option<u32>> {
    let displaced = |material: &Material| displaces(material);
    set.materials.iter().map(|id| scene.materials.get(id.index()).filter(|m| displaced(m)).map(|_| id.0)).collect()
}

fn field(material: &Material, textures: &CompiledTextures, names: &[String]) -> Result<SlotField> {
    let (graph, displacement) = pruned(material, &material.displacement.unwrap_or_default());
    let alone = Material { origin: material.origin.clone(), graph, ..Material::default() };
    let program = materials::program(&alone, &displacement, textures, names)?;
    Ok(SlotField { graph: alone.graph, displacement, program })
}

/// Says what displacement cannot ask: nothing is traced yet.
fn tell_rays(recipes: &[Recipe], scene: &Scene, diagnostics: &mut Vec<Diagnostic>) {
    for recipe in recipes {
        let traces = |operation: &Operation| matches!(operation, Operation::Occlusion { .. } | Operation::RoundedNormal { .. });
        if recipe.operations().any(traces) {
            let message = "displacement cannot look around itself: ambient occlusion counts as 1, and edges as they are";
            diagnostics.push(Diagnostic::warning(&scene.meshes[recipe.mesh].origin, message));
        }
    }
}
