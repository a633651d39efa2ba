//! Shapes in space: trees of meshes, curves and points, their tables, and the top-level tree over all that is placed.

use super::{
    bounds::{self, Bounds},
    cancel::check,
    compiled::Kept,
    cut,
    geometry::{self, CompiledGeometry},
    looks::Looks,
    motion, motion_vectors, oversized,
    smooth::{self, KeptSmooth},
    times,
    trees::{self, KeptTree},
};
use crate::{
    accel::{Blas, Tlas},
    error::{Diagnostic, Error, Result},
    scene::Scene,
    transport::NeighbourFrames,
};
use std::{
    sync::{Arc, atomic::AtomicBool},
    time::{Duration, Instant},
};

/// All shapes of a scene but those of lights.
#[derive(Debug)]
pub(super) struct Shapes {
    pub(super) trees: Vec<KeptTree>,
    pub(super) smooth: Vec<KeptSmooth>,
    /// Of each mesh, then of curves and points, in their own space.
    pub(super) mesh_bounds: Vec<Bounds>,
    /// Of all that is placed.
    pub(super) bounds: Bounds,
    /// What rebased world space has in its middle, metres.
    pub(super) origin: [f64; 3],
    pub(super) geometry: CompiledGeometry,
    pub(super) neighbours: Option<NeighbourFrames>,
    /// Straight pieces of curves.
    pub(super) segments: u64,
    /// What building trees took.
    pub(super) built: Duration,
}

impl Shapes {
    pub(super) fn compile(
        scene: &Scene,
        looks: &Looks,
        kept: &Kept,
        ahead: &[KeptTree],
        cancel: &AtomicBool,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Result<Self> {
        let start = Instant::now();
        let trees = trees::build_trees(scene, &kept.trees, ahead, cancel, diagnostics)?;
        let built = start.elapsed();
        let mut cuts = cut::cut_all(scene, &looks.names, diagnostics);
        let segments = cuts.iter().map(|cut| cut.pieces.len() as u64).sum();
        let blurs = times::blurs(&scene.settings);
        let mesh_bounds: Vec<Bounds> =
            trees.iter().map(|kept| kept.bounds).chain(cuts.iter().map(|cut| smooth::bounds(cut, blurs))).collect();
        let bounds = bounds::of_instances(scene, &mesh_bounds);
        oversized::report(scene, &bounds, diagnostics);
        let origin = bounds.rebase_origin();
        let geometry = geometry::tables(scene, &mut cuts, &mesh_bounds, &looks.names, &looks.materials, origin, diagnostics)?;
        let start = Instant::now();
        let smooth = smooth::build(scene, &cuts, &geometry.table, &kept.smooth, cancel)?;
        let built = built + start.elapsed();
        motion::report_cameras(scene, diagnostics);
        motion_vectors::report(scene, diagnostics);
        let neighbours = motion_vectors::neighbours(scene, &cuts, &geometry, origin, diagnostics);
        Ok(Self { trees, smooth, mesh_bounds, bounds, origin, geometry, neighbours, segments, built })
    }

    /// The tree over all instances, those of lights as well.
    pub(super) fn top_level(&self, cancel: &AtomicBool) -> Result<Tlas> {
        check(cancel)?;
        let first_light = self.geometry.first_light as usize;
        Tlas::build_moving(self.blases().cloned().collect(), &self.geometry.instances, &self.geometry.moving, first_light, cancel)
            .map_err(|_| Error::Cancelled)
    }

    /// Bytes of the trees of all shapes.
    pub(super) fn tree_bytes(&self) -> usize {
        self.blases().map(|tree| tree.memory().bytes()).sum()
    }

    fn blases(&self) -> impl Iterator<Item = &Arc<Blas>> {
        self.trees.iter().map(|kept| &kept.tree).chain(self.smooth.iter().map(|kept| &kept.tree))
    }
}
