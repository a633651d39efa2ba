//! Trees of rays (Whitted): the rays that one generation sends on, and the batches that wait.

use crate::state::paths::Paths;
use gonio_bsdf::Way;
use gonio_simd::SpectrumItems;

/// The rays that one generation sends on, and the batches that wait for their turn.
#[derive(Debug, Default)]
pub(crate) struct Branches {
    /// By specular way out of the surface, in the order of [`Way::ALL`].
    pub(crate) ways: Vec<Paths>,
    /// Depth and paths, a stack: the last is taken next.
    pub(crate) waiting: Vec<(u32, Paths)>,
    /// Columns for later batches.
    pub(crate) spare: Vec<Paths>,
    pub(crate) undivided: Undivided,
}

impl Branches {
    /// Makes room for the ways.
    pub(crate) fn prepare(&mut self) {
        self.ways.resize_with(Way::ALL.len(), Paths::default);
    }

    /// Pushes what was sent on, so that it is taken in the order of the ways.
    pub(crate) fn queue(&mut self, depth: u32) {
        for way in self.ways.iter_mut().rev().filter(|way| way.count > 0) {
            let empty = self.spare.pop().unwrap_or_default();
            self.waiting.push((depth, std::mem::replace(way, empty)));
        }
    }

    /// Exchanges paths that are done for those that come next, and gives their depth.
    pub(crate) fn next(&mut self, paths: &mut Paths) -> Option<u32> {
        let (depth, next) = self.waiting.pop()?;
        let mut done = std::mem::replace(paths, next);
        done.clear();
        self.spare.push(done);
        Some(depth)
    }
}

/// A batch before its closures are told apart; empty where there are no mixes.
#[derive(Debug, Default)]
pub(crate) struct Undivided {
    pub(crate) material_of: Vec<u32>,
    pub(crate) carried: SpectrumItems,
}
