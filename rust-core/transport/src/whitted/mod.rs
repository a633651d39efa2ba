//! Trees of rays in the place of paths (Whitted 1980, and the renderer of the paper that gonio descends from): every point is lit by every light at
//! fixed places, and all that is mirrored, refracted or goes straight through sharply is followed. Nothing is drawn at random but the place in the
//! pixel and on the lens, so neighbouring rays have no noise between them.
//!
//! A batch holds rays of one way alone, at most one for each slot: what one generation mirrors, refracts and lets straight on are batches of their own,
//! and so are the closures of a mix. So rays of a batch lie side by side, room is never short, and a slot's light is added up in the same order
//! for registers of any width.

mod closures;
mod surface;

pub(super) use gonio_camera::sampler::Runs;
pub(super) use surface::shade_lanes;

use super::{
    catcher,
    intersect::intersect,
    material_order::sort_by_material,
    measure::measure,
    path::{MOST_DEPTH, SampleContext, Tracer},
    paths::Paths,
    shadow::trace_shadows,
    transport::Transport,
    workspace::Workspace,
};
use closures::Undivided;
use gonio_bsdf::Way;
use gonio_camera::sampler::Sampler;
use std::time::Instant;

/// What a generation sends on, and batches that wait for their turn.
#[derive(Debug, Default)]
pub(super) struct Branches {
    /// By way, in the order of [`Way::ALL`].
    ways: Vec<Paths>,
    /// Depth and paths; the last is the next.
    waiting: Vec<(u32, Paths)>,
    /// Columns for later batches.
    spare: Vec<Paths>,
    undivided: Undivided,
}

impl Branches {
    /// Makes room where trees are asked for.
    pub(super) fn prepare(&mut self, transport: &Transport) {
        if transport.fixed_samples.is_some() {
            self.ways.resize_with(Way::ALL.len(), Paths::default);
        }
    }

    /// Puts what was sent on into the queue.
    fn queue(&mut self, depth: u32) {
        for way in self.ways.iter_mut().rev().filter(|way| way.count > 0) {
            let empty = self.spare.pop().unwrap_or_default();
            self.waiting.push((depth, std::mem::replace(way, empty)));
        }
    }

    /// Exchanges paths that are done for those that come next, and gives their depth.
    fn next(&mut self, paths: &mut Paths) -> Option<u32> {
        let (depth, next) = self.waiting.pop()?;
        let mut done = std::mem::replace(paths, next);
        done.count = 0;
        self.spare.push(done);
        Some(depth)
    }
}

/// Follows the trees of all paths of the workspace to their ends.
pub(super) fn follow(tracer: &Tracer<'_>, sampler: Sampler, runs: &Runs, first: u32, ws: &mut Workspace, cancelled: &dyn Fn() -> bool) {
    let mut depth = first;
    loop {
        if cancelled() {
            ws.branches.waiting.clear();
            return;
        }
        if ws.paths.count > 0 && depth < MOST_DEPTH {
            follow_batch(tracer, &SampleContext { sampler, runs, depth }, ws);
        }
        match ws.branches.next(&mut ws.paths) {
            Some(next) => depth = next,
            None => return,
        }
        catcher::rejoin(tracer.tables, &mut ws.paths);
        ws.paths.set_masks();
        catcher::narrow(tracer.tables, &mut ws.paths);
    }
}

/// Finds and shades what a batch hits, one closure of mixes after the other.
fn follow_batch(tracer: &Tracer<'_>, context: &SampleContext<'_>, ws: &mut Workspace) {
    let Tracer { tables, transport, .. } = tracer;
    let start = Instant::now();
    intersect(tables, transport, context.depth, ws);
    ws.statistics.spent(1, start);
    closures::keep(tables, ws);
    for closure in 0..closures::most(tables) {
        closures::select(tables, transport, closure, ws);
        sort_by_material(tables, transport, ws);
        tracer.shade(context, ws);
        let start = Instant::now();
        measure(tables, transport, context, ws);
        trace_shadows(tables, transport, context.depth == 0, ws);
        ws.statistics.spent(5, start);
        ws.branches.queue(context.depth + 1);
    }
}
