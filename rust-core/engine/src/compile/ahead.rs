//! Trees of meshes that are built while the rest of a scene is still being described.

use super::trees::{KeptTree, LARGE, still};
use crate::{accel::Care, scene::Mesh, threads::in_pool_later};
use std::{
    collections::VecDeque,
    fmt, mem, process,
    sync::{
        Arc, Condvar, Mutex, MutexGuard, PoisonError,
        atomic::{AtomicBool, Ordering},
    },
};

/// Trees that threads of the pool build ahead of [`compile`](super::compile), which takes those whose arrays the scene still has.
///
/// The same trees come of it as without. What is not begun by then is built as ever.
pub struct TreesAhead {
    shared: Arc<Shared>,
    /// The first meshes, until there are too many triangles for thorough trees.
    held: Vec<Mesh>,
    triangles: usize,
    /// The process whose pool builds.
    process: u32,
}

#[derive(Default)]
struct Shared {
    work: Mutex<Work>,
    changed: Condvar,
    cancel: AtomicBool,
}

#[derive(Default)]
struct Work {
    waiting: VecDeque<Mesh>,
    underway: usize,
    built: Vec<KeptTree>,
}

impl Default for TreesAhead {
    fn default() -> Self {
        Self { shared: Arc::default(), held: Vec::new(), triangles: 0, process: process::id() }
    }
}

impl fmt::Debug for TreesAhead {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("TreesAhead").field("triangles", &self.triangles).finish_non_exhaustive()
    }
}

impl TreesAhead {
    /// Has a mesh's tree built, if the tree does not depend on what is still to come: of meshes that keep their form, are not cut finer and are not
    /// so large that all threads build them.
    pub fn add(&mut self, mesh: &Mesh) {
        if !mesh.motion.is_empty() || mesh.dicing.is_some() || mesh.triangles.is_empty() || mesh.triangles.len() > LARGE {
            return;
        }
        self.triangles += mesh.triangles.len();
        // Its arrays alone: they are shared.
        self.held.push(Mesh {
            origin: mesh.origin.clone(),
            points: mesh.points.clone(),
            triangles: mesh.triangles.clone(),
            ..Mesh::default()
        });
        if Care::of_scene(self.triangles) == Care::Quick {
            for mesh in mem::take(&mut self.held) {
                self.shared.lock().waiting.push_back(mesh);
                let shared = self.shared.clone();
                in_pool_later(move || shared.build_next());
            }
        }
    }

    /// The trees that were built; waits for those under way. Not to be called on a thread of the pool, which might have one of these under way itself.
    pub(super) fn finish(self) -> Vec<KeptTree> {
        if self.process != process::id() {
            return Vec::new();
        }
        let mut work = self.shared.lock();
        work.waiting.clear();
        while work.underway > 0 {
            work = self.shared.changed.wait(work).unwrap_or_else(PoisonError::into_inner);
        }
        mem::take(&mut work.built)
    }
}

impl Drop for TreesAhead {
    fn drop(&mut self) {
        self.shared.cancel.store(true, Ordering::Relaxed);
    }
}

impl Shared {
    fn lock(&self) -> MutexGuard<'_, Work> {
        self.work.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn build_next(&self) {
        let mesh = {
            let mut work = self.lock();
            let Some(mesh) = work.waiting.pop_front() else { return };
            work.underway += 1;
            mesh
        };
        // Counted down even where building panics.
        let _ended = Ended(self);
        if let Ok((tree, None)) = still(&mesh, Care::Quick, &self.cancel) {
            self.lock().built.push(tree);
        }
    }
}

/// One tree less is under way once this is dropped.
struct Ended<'a>(&'a Shared);

impl Drop for Ended<'_> {
    fn drop(&mut self) {
        self.0.lock().underway -= 1;
        self.0.changed.notify_all();
    }
}
