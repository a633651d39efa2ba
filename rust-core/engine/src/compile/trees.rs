//! Trees of meshes, kept from one compilation to the next, or fitted to points that moved.

use super::{
    bounds::{Bounds, of_mesh},
    check,
};
use crate::{
    accel::Blas,
    error::{Diagnostic, Error, Result},
    scene::{Mesh, Scene},
};
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

/// Where a mesh's arrays lie.
type Arrays = (*const [f32; 3], *const [u32; 3]);

fn arrays(points: &[[f32; 3]], triangles: &[[u32; 3]]) -> Arrays {
    (points.as_ptr(), triangles.as_ptr())
}

/// Trees of all meshes; those whose arrays are the very same as before are kept, those of gone meshes fitted to the same triangles over other points.
pub(super) fn build_trees(
    scene: &Scene,
    previous: &[KeptTree],
    cancel: &AtomicBool,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<Vec<KeptTree>> {
    let known: HashMap<Arrays, &KeptTree> = previous.iter().map(|kept| (arrays(&kept.points, &kept.triangles), kept)).collect();
    let gone = gone(scene, previous);
    let mut trees = Vec::with_capacity(scene.meshes.len());
    for mesh in &scene.meshes {
        check(cancel)?;
        // Arrays of no length may share an address with others.
        let same = |kept: &&KeptTree| Arc::ptr_eq(&kept.points, &mesh.points) && Arc::ptr_eq(&kept.triangles, &mesh.triangles);
        if let Some(kept) = known.get(&arrays(&mesh.points, &mesh.triangles)).copied().filter(same) {
            trees.push(kept.clone());
            continue;
        }
        let tree = match fitted(mesh, &gone) {
            Some(tree) => tree,
            None => built(mesh, cancel, diagnostics)?,
        };
        let bounds = of_mesh(mesh);
        trees.push(KeptTree { points: mesh.points.clone(), triangles: mesh.triangles.clone(), tree: Arc::new(tree), bounds });
    }
    Ok(trees)
}

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

fn built(mesh: &Mesh, cancel: &AtomicBool, diagnostics: &mut Vec<Diagnostic>) -> Result<Blas> {
    let usable = has_valid_triangles(mesh, diagnostics);
    let triangles: &[[u32; 3]] = if usable { &mesh.triangles } else { &[] };
    Blas::build(&mesh.points, triangles, cancel).map_err(|_| Error::Cancelled)
}

fn has_valid_triangles(mesh: &Mesh, diagnostics: &mut Vec<Diagnostic>) -> bool {
    let points = mesh.points.len() as u64;
    let wrong = mesh.triangles.iter().flatten().find(|index| u64::from(**index) >= points);
    if let Some(index) = wrong {
        let message = format!("triangle index {index} is out of range, the mesh has {points} points; the mesh is left out");
        diagnostics.push(Diagnostic::warning(&mesh.origin, message));
    }
    wrong.is_none()
}
