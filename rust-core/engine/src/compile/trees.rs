//! Trees of meshes, kept from one compilation to the next, or fitted to points that moved.

use super::{
    bounds::{Bounds, of_mesh},
    cancel::check,
};
use crate::{
    accel::{Blas, Care},
    error::{Diagnostic, Error, Result},
    scene::{Mesh, Scene},
};
use rayon::prelude::*;
use std::{
    collections::{HashMap, HashSet},
    sync::{Arc, atomic::AtomicBool},
};

/// A mesh's tree and the arrays it was built from.
#[derive(Clone, Debug)]
pub(super) struct KeptTree {
    points: Arc<[[f32; 3]]>,
    triangles: Arc<[[u32; 3]]>,
    pub(super) tree: Arc<Blas>,
    /// In the mesh's own space.
    pub(super) bounds: Bounds,
}

impl KeptTree {
    fn new(mesh: &Mesh, tree: Blas) -> Self {
        Self { points: mesh.points.clone(), triangles: mesh.triangles.clone(), tree: Arc::new(tree), bounds: of_mesh(mesh) }
    }
}

/// Where a mesh's arrays lie.
type Arrays = [usize; 2];

fn arrays(points: &[[f32; 3]], triangles: &[[u32; 3]]) -> Arrays {
    [points.as_ptr().addr(), triangles.as_ptr().addr()]
}

/// Larger meshes are built one after the other, each on all threads: what their building needs would add up.
pub(super) const LARGE: usize = 1 << 18;

/// Trees of all meshes; those whose arrays are the very same as before, or as `ahead`, are kept, those of gone meshes fitted to the same triangles
/// over other points.
pub(super) fn build_trees(
    scene: &Scene,
    previous: &[KeptTree],
    ahead: &[KeptTree],
    cancel: &AtomicBool,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<Vec<KeptTree>> {
    let gone = gone(scene, previous);
    let care = Care::of_scene(scene.meshes.iter().map(|mesh| mesh.triangles.len()).sum());
    // Quick ones, which a scene that lost most of its triangles again has no use for.
    let ahead = if care == Care::Quick { ahead } else { &[] };
    let known: HashMap<Arrays, &KeptTree> =
        ahead.iter().chain(previous).map(|kept| (arrays(&kept.points, &kept.triangles), kept)).collect();
    // Arrays of no length may share an address with others.
    let same = |kept: &&KeptTree, mesh: &Mesh| {
        kept.tree.is_still() && Arc::ptr_eq(&kept.points, &mesh.points) && Arc::ptr_eq(&kept.triangles, &mesh.triangles)
    };
    let tree = |mesh: &Mesh| {
        check(cancel)?;
        let deforms = super::motion::deforms(mesh, &scene.settings);
        if !deforms && let Some(kept) = known.get(&arrays(&mesh.points, &mesh.triangles)).copied().filter(|kept| same(kept, mesh)) {
            return Ok((kept.clone(), None));
        }
        match fitted(mesh, &gone) {
            _ if deforms => Ok((KeptTree::new(mesh, deforming(mesh, care, cancel)?), None)),
            Some(tree) => Ok((KeptTree::new(mesh, tree), None)),
            None => still(mesh, care, cancel),
        }
    };
    let (large, small): (Vec<usize>, Vec<usize>) = (0..scene.meshes.len()).partition(|i| scene.meshes[*i].triangles.len() > LARGE);
    let mut made: Vec<(usize, Made)> = small.into_par_iter().map(|i| Ok((i, tree(&scene.meshes[i])?))).collect::<Result<_>>()?;
    for i in large {
        made.push((i, tree(&scene.meshes[i])?));
    }
    made.sort_unstable_by_key(|(i, _)| *i);
    Ok(made
        .into_iter()
        .map(|(_, (kept, problem))| {
            diagnostics.extend(problem);
            kept
        })
        .collect())
}

/// A tree, and what is wrong with the mesh.
pub(super) type Made = (KeptTree, Option<Diagnostic>);

/// Trees that no mesh of the scene has any more, by the numbers of points and triangles.
fn gone<'a>(scene: &Scene, previous: &'a [KeptTree]) -> HashMap<[usize; 2], &'a KeptTree> {
    let present: HashSet<Arrays> = scene.meshes.iter().map(|mesh| arrays(&mesh.points, &mesh.triangles)).collect();
    let gone = previous.iter().filter(|kept| !present.contains(&arrays(&kept.points, &kept.triangles)));
    gone.map(|kept| ([kept.points.len(), kept.triangles.len()], kept)).collect()
}

/// The tree of a mesh that is gone, if its triangles were the same, over this one's points.
fn fitted(mesh: &Mesh, gone: &HashMap<[usize; 2], &KeptTree>) -> Option<Blas> {
    let kept = gone.get(&[mesh.points.len(), mesh.triangles.len()])?;
    let same = kept.tree.memory().triangles > 0 && kept.triangles == mesh.triangles;
    if same { kept.tree.refit(&mesh.points, &mesh.triangles) } else { None }
}

/// The tree of a mesh whose keys are right; a mesh of wrong triangles has none.
fn deforming(mesh: &Mesh, care: Care, cancel: &AtomicBool) -> Result<Blas> {
    let triangles: &[[u32; 3]] = if wrong_triangle(mesh).is_none() { &mesh.triangles } else { &[] };
    let keys: Vec<&[[f32; 3]]> = mesh.motion.iter().map(|key| &*key.points).collect();
    Blas::build_deforming(&keys, triangles, care, cancel).map_err(|_| Error::Cancelled)
}

/// The tree of a mesh that keeps its form.
pub(super) fn still(mesh: &Mesh, care: Care, cancel: &AtomicBool) -> Result<Made> {
    let problem = wrong_triangle(mesh);
    let triangles: &[[u32; 3]] = if problem.is_none() { &mesh.triangles } else { &[] };
    let tree = Blas::build(&mesh.points, triangles, care, cancel).map_err(|_| Error::Cancelled)?;
    Ok((KeptTree::new(mesh, tree), problem))
}

/// What is wrong with a triangle of a point that is not there.
fn wrong_triangle(mesh: &Mesh) -> Option<Diagnostic> {
    let points = mesh.points.len() as u64;
    let index = mesh.triangles.iter().flatten().find(|index| u64::from(**index) >= points)?;
    let message = format!("triangle index {index} is out of range, the mesh has {points} points; the mesh is left out");
    Some(Diagnostic::warning(&mesh.origin, message))
}
