//! Indices of refraction that materials name, each once however many materials are of it.

use crate::{
    error::Diagnostic,
    scene::{Closure, Scene},
};
use gonio_formats::FormatError;
use std::sync::Arc;

/// What is named, as the scene has it and as kernels want it, by row.
#[derive(Clone, Debug)]
pub(super) struct Indices<S, C> {
    rows: Vec<(Arc<S>, C)>,
    /// Where a closure names it.
    of: fn(&Closure) -> Option<&Arc<S>>,
}

impl<S: PartialEq, C> Indices<S, C> {
    /// Those of a scene's closures; of what is no index it is told what stands in for it.
    pub(super) fn of(
        scene: &Scene,
        of: fn(&Closure) -> Option<&Arc<S>>,
        compiled: impl Fn(&S) -> Result<C, FormatError>,
        instead: &str,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Self {
        let mut all = Self { rows: Vec::new(), of };
        for material in &scene.materials {
            for source in material.closures.iter().filter_map(of) {
                if all.find(source).is_some() {
                    continue;
                }
                match compiled(source) {
                    Ok(found) => all.rows.push((source.clone(), found)),
                    Err(error) => {
                        diagnostics.push(Diagnostic::warning(&material.origin, format!("its {instead}: {}", error.problem)));
                    }
                }
            }
        }
        all
    }

    fn find(&self, source: &Arc<S>) -> Option<usize> {
        self.rows.iter().position(|(known, _)| Arc::ptr_eq(known, source) || known == source)
    }

    /// The row of what a closure names.
    pub(super) fn row_of(&self, closure: &Closure) -> Option<u32> {
        (self.of)(closure).and_then(|source| self.find(source)).map(|row| row as u32)
    }

    /// What stands in a row.
    pub(super) fn row(&self, row: u32) -> &C {
        &self.rows[row as usize].1
    }

    /// All rows.
    pub(super) fn all(&self) -> impl Iterator<Item = &C> {
        self.rows.iter().map(|(_, compiled)| compiled)
    }
}
