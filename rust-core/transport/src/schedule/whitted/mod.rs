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

pub(crate) use surface::WhittedIntegrator;

use crate::schedule::steps::{self, MOST_DEPTH};
use crate::schedule::tracer::Tracer;
use crate::stage::find::sort::sort_by_material;
use crate::stage::shade::catcher;
use crate::state::sample::SampleContext;
use crate::state::workspace::Workspace;
use crate::statistics::Stage;
use std::time::Instant;

/// Follows the trees of all paths of the workspace to their ends.
pub(crate) fn follow(
    tracer: &Tracer<'_>,
    integrator: &WhittedIntegrator<'_>,
    first: SampleContext<'_>,
    ws: &mut Workspace,
    cancelled: &dyn Fn() -> bool,
) {
    ws.queues.branches.prepare();
    let mut depth = first.depth;
    loop {
        if cancelled() {
            ws.queues.branches.waiting.clear();
            return;
        }
        if ws.paths.count > 0 && depth < MOST_DEPTH {
            follow_batch(tracer, integrator, &SampleContext { depth, ..first }, ws);
        }
        match ws.queues.branches.next(&mut ws.paths) {
            Some(next) => depth = next,
            None => return,
        }
        catcher::join(tracer.tables, &mut ws.paths);
        steps::set_masks(tracer.tables, &mut ws.paths);
    }
}

/// Finds and shades what a batch hits, one closure of mixes after the other.
fn follow_batch(tracer: &Tracer<'_>, integrator: &WhittedIntegrator<'_>, sample: &SampleContext<'_>, ws: &mut Workspace) {
    let Tracer { tables, transport, .. } = tracer;
    let start = Instant::now();
    steps::intersect(tracer, sample, ws);
    steps::pass_media(tracer, sample, false, ws);
    steps::find_materials(tracer, ws);
    ws.statistics.spent(Stage::Intersect, start);
    closures::keep(tables, &ws.materials, &ws.paths, &mut ws.queues.branches.undivided);
    for closure in 0..closures::most(tables) {
        let whole = closures::Whole { undivided: &ws.queues.branches.undivided, hits: &ws.nearest.hits };
        closures::select(tables, transport, closure, &whole, &mut ws.paths, &mut ws.materials, &mut ws.chunk);
        sort_by_material(tables, transport, &mut ws.materials);
        steps::shade(tracer, integrator, sample, ws);
        let start = Instant::now();
        steps::measure_found(tracer, integrator, sample, ws);
        steps::trace_shadows(tracer, sample, ws);
        ws.statistics.spent(Stage::Shadow, start);
        ws.queues.branches.queue(sample.depth + 1);
    }
}
