//! Dicing: meshes that ask for it cut to the size of pixels, before they are displaced.

mod made;
mod rate;

use super::cancel::check;
use crate::{
    error::{Diagnostic, Result},
    mesh::{DiceLimits, Undiced, dice},
    scene::{Dicing, Geometry, Mesh, MeshId, Scene, Transform},
};
use made::{corner_normals, made};
use rate::{Rate, View};
use rayon::prelude::*;
use std::sync::atomic::AtomicBool;

/// Bytes that a triangle takes while it is made and when it is there.
const TRIANGLE_BYTES: u64 = 256;
/// Most triangles of one mesh.
const MOST_TRIANGLES: u64 = 1 << 26;

/// A diced mesh, and what it was made of.
#[derive(Clone, Debug)]
pub(super) struct KeptDiced {
    source: Mesh,
    view: View,
    placements: Vec<Transform>,
    limit: u64,
    mesh: Mesh,
    told: Option<Diagnostic>,
}

/// A scene whose meshes are diced, and what it leaves for the next.
#[derive(Debug)]
pub(super) struct DicedScene {
    pub(super) scene: Scene,
    pub(super) kept: Vec<KeptDiced>,
}

/// The scene with diced meshes; none where no mesh asks for it.
pub(super) fn apply(
    scene: &Scene,
    previous: &[KeptDiced],
    cancel: &AtomicBool,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<Option<DicedScene>> {
    let wanting: Vec<usize> = (0..scene.meshes.len()).filter(|mesh| scene.meshes[*mesh].dicing.is_some()).collect();
    if wanting.is_empty() {
        return Ok(None);
    }
    let view = View::of(scene);
    let limit = scene.settings.displacement_memory / TRIANGLE_BYTES / wanting.len() as u64;
    let one = |mesh: &usize| {
        check(cancel)?;
        let source = &scene.meshes[*mesh];
        let placements = rate::nearest(scene, *mesh, &view);
        let same = |kept: &&KeptDiced| {
            (kept.view, kept.limit) == (view, limit) && kept.placements == placements && kept.source.holds_arrays_of(source)
        };
        let kept = previous.iter().find(same).cloned();
        Ok(kept.unwrap_or_else(|| diced(source, &view, placements, limit)))
    };
    let kept: Vec<KeptDiced> = wanting.par_iter().map(one).collect::<Result<_>>()?;
    let mut scene = scene.clone();
    for (mesh, kept) in wanting.iter().zip(&kept) {
        scene.meshes[*mesh] = kept.mesh.clone();
        diagnostics.extend(kept.told.clone());
    }
    Ok(Some(DicedScene { scene, kept }))
}

fn diced(source: &Mesh, view: &View, placements: Vec<Transform>, limit: u64) -> KeptDiced {
    let mut kept = KeptDiced { source: source.clone(), view: *view, limit, mesh: source.clone(), told: None, placements };
    let Some(dicing) = source.dicing.filter(|_| source.triangles.as_flattened().iter().all(|p| (*p as usize) < source.points.len())) else {
        return kept;
    };
    let normals = corner_normals(source, source.normals.as_ref());
    let rate = Rate::new(view, &kept.placements, dicing);
    let mesh = Undiced { points: &source.points, triangles: &source.triangles, normals: &normals, smooth: dicing.smooth };
    let triangles = limit.min(MOST_TRIANGLES).max(source.triangles.len() as u64) as usize;
    let diced = dice(&mesh, DiceLimits { levels: dicing.levels.min(Dicing::MOST_LEVELS), triangles }, &|a, b| rate.of(a, b));
    if diced.is_cut_short {
        let message = format!("dicing stops at {} triangles: more than {limit} go beyond the limit of displacement", diced.triangles.len());
        kept.told = Some(Diagnostic::warning(&source.origin, message));
    }
    kept.mesh = made(source, &diced);
    kept
}

/// Whether a mesh has other triangles when it is rendered.
pub(crate) fn is_diced(scene: &Scene, geometry: Geometry) -> bool {
    geometry.mesh().and_then(|MeshId(mesh)| scene.meshes.get(mesh as usize)).is_some_and(|mesh| mesh.dicing.is_some())
}
