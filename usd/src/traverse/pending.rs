//! Meshes that wait to be built, many at once and without the interpreter.

use super::Walker;
use crate::build::{self, BuildError, BuiltMesh, MeshSource};
use gonio::scene::{Mesh, MeshId, Origin};
use gonio::{Error, Result};
use rayon::prelude::*;
use std::sync::atomic::AtomicBool;

/// Floats of meshes that wait to be built; more are built at once, to bound memory.
const PENDING_LIMIT: usize = 1 << 25;

impl Walker<'_, '_, '_> {
    /// Reserves the scene's place for a mesh that is built later.
    pub(super) fn submit(&mut self, source: MeshSource) -> Result<MeshId> {
        let id = self.context.scene.add_mesh(Mesh { origin: source.origin.clone(), ..Mesh::default() });
        let primvar_floats: usize = source.polygons.primvars.iter().map(|primvar| primvar.values.len()).sum();
        self.pending_floats += source.polygons.points.len() * 3 + source.polygons.corners.len() + primvar_floats;
        self.pending.push((id, source));
        if self.pending_floats > PENDING_LIMIT {
            self.build_pending()?;
        }
        Ok(id)
    }

    /// Builds the waiting meshes on all cores, without the interpreter.
    pub(super) fn build_pending(&mut self) -> Result<()> {
        let pending = std::mem::take(&mut self.pending);
        self.pending_floats = 0;
        let cancel = self.context.cancel_flag();
        let built: Vec<_> = self.context.py.detach(|| pending.into_par_iter().map(|(id, source)| built(id, source, cancel)).collect());
        for (id, origin, result) in built {
            match result {
                Ok(BuiltMesh { mesh, problems }) => {
                    self.context.scene.meshes[id.index()] = mesh;
                    problems.into_iter().for_each(|problem| self.context.warn(&origin, problem));
                }
                Err(BuildError::Cancelled) => return Err(Error::Cancelled),
                Err(BuildError::Problem(problem)) => {
                    self.context.warn(&origin, format!("{problem}; the mesh is left out"));
                    self.failed.insert(id);
                }
            }
        }
        Ok(())
    }
}

fn built(id: MeshId, source: MeshSource, cancel: &AtomicBool) -> (MeshId, Origin, Result<BuiltMesh, BuildError>) {
    let origin = source.origin.clone();
    // A defect in one mesh must not take the stage with it.
    let result = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| build::build(source, cancel)));
    (id, origin, result.unwrap_or_else(|_| Err(BuildError::Problem("internal error while the mesh was cut into triangles".into()))))
}
