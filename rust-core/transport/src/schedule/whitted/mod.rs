//! Whitted ray tracing: trees of rays in the place of paths (Whitted 1980, and the renderer of the paper that gonio descends from).
//!
//! Every point is lit by fixed samples of every light. All that is mirrored, refracted or goes straight through is followed. Only the places in
//! the pixel and on the lens are random, so neighbouring rays have no noise between them.
//!
//! A batch holds the rays of one specular way, at most one for each slot: each way out of a generation is a batch of its own, and so is each
//! closure of a mix. So rays of a batch lie side by side, and room is never short. A slot's light is added in the same order for registers of
//! any width.

mod closures;
mod surface;

pub(crate) use gonio_camera::sampler::Runs;
pub(crate) use surface::shade_lanes;

use crate::schedule::path::{MOST_DEPTH, Tracer};
use crate::stage::catcher;
use crate::stage::intersect::intersect;
use crate::stage::measure::measure;
use crate::stage::shadow::trace_shadows;
use crate::stage::sort::sort_by_material;
use crate::state::sample::SampleContext;
use crate::state::workspace::Workspace;
use gonio_camera::sampler::Sampler;
use std::time::Instant;

/// Follows the trees of all paths of the workspace to their ends.
pub(crate) fn follow(tracer: &Tracer<'_>, sampler: Sampler, runs: &Runs, first: u32, ws: &mut Workspace, cancelled: &dyn Fn() -> bool) {
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
        catcher::join(tracer.tables, &mut ws.paths);
        ws.paths.set_masks();
        catcher::set_masks(tracer.tables, &mut ws.paths);
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
