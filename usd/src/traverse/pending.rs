//! Meshes that are built on other threads, without the interpreter, while the stage is read on.

use super::Walker;
use crate::build::{self, BuildError, BuiltMesh, MeshSource};
use crate::kept::KeptShape;
use gonio::scene::{Mesh, MeshId, Origin};
use gonio::{Error, Result, threads::in_pool_later};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::time::{Duration, Instant};

/// Floats of meshes that wait to be built; beyond that reading waits, to bound memory.
const PENDING_LIMIT: usize = 1 << 25;
/// How often a wait looks whether the caller wants to stop.
const LOOK_EVERY: Duration = Duration::from_millis(20);

/// What became of a mesh.
#[derive(Debug)]
struct Outcome {
    id: MeshId,
    origin: Origin,
    floats: usize,
    result: Result<BuiltMesh, BuildError>,
}

/// Meshes on their way.
#[derive(Debug)]
pub(super) struct Pending {
    sender: Sender<Outcome>,
    receiver: Receiver<Outcome>,
    outcomes: Vec<Outcome>,
    /// Floats of meshes that are not built yet.
    floats: usize,
    stop: Arc<AtomicBool>,
    /// Time that reading has waited.
    pub(super) waited: Duration,
}

impl Default for Pending {
    fn default() -> Self {
        let (sender, receiver) = channel();
        let stop = Arc::default();
        Self { sender, receiver, outcomes: Vec::new(), floats: 0, stop, waited: Duration::ZERO }
    }
}

impl Drop for Pending {
    fn drop(&mut self) {
        // Nobody waits for what is left.
        self.stop.store(true, Ordering::Relaxed);
    }
}

impl Pending {
    fn take(&mut self, outcome: Outcome) {
        self.floats -= outcome.floats;
        self.outcomes.push(outcome);
    }
}

impl Walker<'_, '_, '_> {
    /// Reserves the scene's place for a mesh and has it built.
    pub(super) fn submit(&mut self, source: MeshSource) -> Result<MeshId> {
        let id = self.context.scene.add_mesh(Mesh { origin: source.origin.clone(), ..Mesh::default() });
        let primvar_floats: usize = source.polygons.primvars.iter().map(|primvar| primvar.values.len()).sum();
        // At least one, so that meshes without points are waited for too.
        let floats = 1 + source.polygons.points.len() * 3 + source.polygons.corners.len() + primvar_floats;
        let pending = &mut self.pending;
        pending.floats += floats;
        let (sender, stop) = (pending.sender.clone(), pending.stop.clone());
        // Without a receiver the reading has ended.
        in_pool_later(move || drop(sender.send(built(id, floats, source, &stop))));
        self.wait_for_meshes(PENDING_LIMIT)?;
        Ok(id)
    }

    /// Takes what is built, and waits until no more floats than these are left.
    fn wait_for_meshes(&mut self, limit: usize) -> Result<()> {
        while let Ok(outcome) = self.pending.receiver.try_recv() {
            self.pending.take(outcome);
        }
        let start = Instant::now();
        while self.pending.floats > limit {
            let received = self.receive();
            match received {
                Ok(outcome) => self.pending.take(outcome),
                Err(RecvTimeoutError::Timeout) => self.context.check_cancel()?,
                Err(RecvTimeoutError::Disconnected) => return Err(Error::Internal("the building of meshes broke off".into())),
            }
        }
        self.pending.waited += start.elapsed();
        Ok(())
    }

    /// The next mesh; others have the interpreter meanwhile.
    fn receive(&mut self) -> Result<Outcome, RecvTimeoutError> {
        let pending = std::mem::take(&mut self.pending);
        let (received, pending) = self.context.py.detach(move || (pending.receiver.recv_timeout(LOOK_EVERY), pending));
        self.pending = pending;
        received
    }

    /// Waits for all meshes, and puts them into the scene in the order of their reading.
    pub(super) fn finish_meshes(&mut self) -> Result<()> {
        self.wait_for_meshes(0)?;
        let mut outcomes = std::mem::take(&mut self.pending.outcomes);
        outcomes.sort_by_key(|outcome| outcome.id);
        for Outcome { id, origin, result, .. } in outcomes {
            match result {
                Ok(BuiltMesh { mesh, problems }) => {
                    // What is to be told is told for each reading.
                    if let Some((known, parts)) = self.to_keep.remove(&id).filter(|_| problems.is_empty()) {
                        // Full where the shape changes with time.
                        let _ = known.shape.set(KeptShape::Mesh(mesh.clone(), parts));
                    }
                    if !problems.is_empty() {
                        self.quadrics.retain(|_, quadric| *quadric != id);
                    }
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
        for (key, id) in &self.quadrics {
            if !self.failed.contains(id) {
                self.context.kept.keep_quadric(key, &self.context.scene.meshes[id.index()]);
            }
        }
        Ok(())
    }
}

fn built(id: MeshId, floats: usize, source: MeshSource, cancel: &AtomicBool) -> Outcome {
    let origin = source.origin.clone();
    // A defect in one mesh must not take the stage with it.
    let result = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| build::build(source, cancel)));
    let result = result.unwrap_or_else(|_| Err(BuildError::Problem("internal error while the mesh was cut into triangles".into())));
    Outcome { id, origin, floats, result }
}
