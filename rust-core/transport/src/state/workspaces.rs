//! The pool of workspaces between renders.

use crate::state::workspace::Workspace;
use crate::statistics::Statistics;
use std::sync::{Mutex, PoisonError};

/// Workspaces that workers have left: a new one is megabytes that the kernel hands out page by page, which shows in a picture of a few samples.
#[derive(Debug, Default)]
pub struct Workspaces(Mutex<Vec<Workspace>>);

impl Workspaces {
    /// One that was left, else a new one.
    pub fn take(&self) -> Workspace {
        Workspace { statistics: Statistics::default(), ..self.list(Vec::pop).unwrap_or_default() }
    }

    /// Leaves one for others; nothing may be under way in it.
    pub fn leave(&self, workspace: Workspace) {
        self.list(|list| list.push(workspace));
    }

    fn list<T>(&self, run: impl FnOnce(&mut Vec<Workspace>) -> T) -> T {
        run(&mut self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }
}
