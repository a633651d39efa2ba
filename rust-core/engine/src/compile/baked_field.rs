//! Fields from node graphs: densities that vary by position are computed once, on a lattice.

use super::compile;
use crate::{
    error::{Error, Result},
    scene::{Closure, Field, Graph, Input, Instances, Lattice, Material, Mesh, Model, Origin, Scene, Texture, Transform},
    threads::in_pool,
    transport::emission_at,
};
use gonio_simd::Execution;
use rayon::prelude::*;
use std::sync::atomic::AtomicBool;

/// Points that a task computes.
const TASK: usize = 1 << 14;
/// Most points of a lattice.
pub const MOST_POINTS: usize = 1 << 29;

/// A density and a heat by a graph, within a box.
#[derive(Clone, Copy, Debug)]
pub struct Recipe<'a> {
    /// Where it came from.
    pub origin: &'a Origin,
    /// The nodes.
    pub graph: &'a Graph,
    /// Images that nodes name.
    pub textures: &'a [Texture],
    /// The density; the first component counts.
    pub density: Input,
    /// What the emission follows, likewise.
    pub heat: Option<Input>,
    /// The box in its own space: least and greatest coordinates.
    pub domain: [[f64; 3]; 2],
    /// From that space to the world.
    pub to_world: &'a Transform,
    /// Voxels along the axes.
    pub voxels: [usize; 3],
}

/// Computes a recipe at the middles of all voxels. Nodes that ask for a surface are told nothing of use: the place lies on the box's first triangle.
///
/// # Errors
///
/// If the box is empty, too many voxels are asked for, the graph cannot be compiled, or it is cancelled.
pub fn bake(recipe: &Recipe<'_>, cancel: &AtomicBool) -> Result<Field> {
    let [min, max] = recipe.domain;
    let count =
        recipe.voxels.iter().try_fold(1usize, |product, n| product.checked_mul(*n)).filter(|count| (1..=MOST_POINTS).contains(count));
    let Some(count) = count else {
        let problem = format!("{:?} voxels were asked for, expected 1 to {MOST_POINTS} in all", recipe.voxels);
        return Err(Error::scene(recipe.origin, problem));
    };
    if !(0..3).all(|axis| min[axis] < max[axis] && (max[axis] - min[axis]).is_finite()) || recipe.to_world.inverse().is_none() {
        return Err(Error::scene(recipe.origin, "its box is flat"));
    }
    let edge: [f64; 3] = std::array::from_fn(|axis| (max[axis] - min[axis]) / recipe.voxels[axis] as f64);
    let [x, y, z] = edge;
    let corner = std::array::from_fn(|axis| min[axis] + 0.5 * edge[axis]);
    let of_voxels = Transform { columns: [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z], corner] };
    let to_world = recipe.to_world.after(&of_voxels);
    let compiled = compile(&scene(recipe), None, cancel)?;
    let tables = &compiled.tables;
    let [_, ny, nz] = recipe.voxels;
    let place = |n: usize| {
        let place = to_world.point([n / (ny * nz), n / nz % ny, n % nz].map(|n| n as f64));
        std::array::from_fn(|axis| (place[axis] - tables.origin[axis]) as f32)
    };
    let computed = |surface: usize| {
        let mut values = vec![0.0f32; count];
        let fill = |(task, values): (usize, &mut [f32])| {
            let places: Vec<[f32; 3]> = (0..values.len()).map(|n| place(task * TASK + n)).collect();
            let mut found = vec![[0.0; 3]; values.len()];
            emission_at(tables, Execution::detect(), surface, 0, &places, &mut found);
            values.iter_mut().zip(found).for_each(|(value, [found, ..])| *value = if found.is_finite() { found.max(0.0) } else { 0.0 });
        };
        in_pool(|| values.par_chunks_mut(TASK).enumerate().for_each(fill));
        Lattice::of_values(&values, recipe.voxels).map_err(|problem| Error::scene(recipe.origin, problem))
    };
    let density = computed(0)?;
    let heat = recipe.heat.map(|_| computed(1)).transpose()?;
    let hottest = heat.as_ref().map_or(0.0, Lattice::most);
    Ok(Field { origin: recipe.origin.clone(), to_world, density, heat, glow: Vec::new(), hottest })
}

/// A scene of one box, whose surfaces send the density and the heat.
fn scene(recipe: &Recipe<'_>) -> Scene {
    let closure = |input: Input| {
        let mut closure = Closure { model: Model::Emission, ..Closure::default() };
        closure.set_input("emission_color", input);
        closure
    };
    let closures = [Some(recipe.density), recipe.heat].into_iter().flatten().map(closure).collect();
    let material = Material { origin: recipe.origin.clone(), closures, graph: recipe.graph.clone(), ..Material::default() };
    let [min, max] = recipe.domain.map(|corner| corner.map(|x| x as f32));
    let mesh = Mesh { origin: recipe.origin.clone(), ..Mesh::of_box(min, max) };
    let mut scene = Scene { textures: recipe.textures.to_vec(), ..Scene::default() };
    let (mesh, material) = (scene.add_mesh(mesh), scene.add_material(material));
    scene.instances.push(Instances::new(recipe.origin.clone(), mesh, vec![material], vec![*recipe.to_world]));
    scene
}
