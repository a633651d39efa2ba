//! The path tracer: the wavefront schedule, stage by stage and bounce by bounce (pbrt's `WavefrontPathIntegrator::Render`).

mod surface;

pub(crate) use surface::PathIntegrator;

use crate::schedule::steps::{self, MOST_DEPTH};
use crate::schedule::tracer::Tracer;
use crate::stage::find::sort::sort_by_material;
use crate::stage::shade::catcher;
use crate::stage::shade::closure::choose_closures;
use crate::stage::walk::subsurface::{WalkContext, walk};
use crate::state::sample::SampleContext;
use crate::state::workspace::Workspace;
use crate::statistics::Stage;
use std::time::Instant;

/// Follows all paths to their ends, bounce by bounce.
pub(crate) fn follow(
    tracer: &Tracer<'_>,
    integrator: &PathIntegrator,
    first: SampleContext<'_>,
    ws: &mut Workspace,
    cancelled: &dyn Fn() -> bool,
) {
    for depth in first.depth..MOST_DEPTH {
        if let Some(notes) = &mut ws.deposits.guiding {
            notes.go_on(&ws.paths);
        }
        if ws.paths.count == 0 || cancelled() {
            break;
        }
        follow_bounce(tracer, integrator, &SampleContext { depth, ..first }, ws, cancelled);
        std::mem::swap(&mut ws.paths, &mut ws.queues.next);
        catcher::join(tracer.tables, &mut ws.paths);
        steps::set_masks(tracer.tables, &mut ws.paths);
    }
    if let Some(notes) = &mut ws.deposits.guiding {
        notes.settle();
    }
}

/// One bounce: what paths hit is shaded and lit, and sends on the next rays.
fn follow_bounce(
    tracer: &Tracer<'_>,
    integrator: &PathIntegrator,
    sample: &SampleContext<'_>,
    ws: &mut Workspace,
    cancelled: &dyn Fn() -> bool,
) {
    let Tracer { tables, transport, .. } = tracer;
    let time = Instant::now();
    steps::intersect(tracer, sample, ws);
    ws.queues.next.clear();
    steps::pass_media(tracer, sample, integrator.lit, ws);
    steps::find_materials(tracer, ws);
    choose_closures(tables, transport, sample, &mut ws.paths, &ws.nearest.hits, &mut ws.materials, &mut ws.chunk, Some(&mut ws.deposits));
    sort_by_material(tables, transport, &mut ws.materials);
    ws.statistics.spent(Stage::Intersect, time);
    steps::shade(tracer, integrator, sample, ws);
    let time = Instant::now();
    let context = WalkContext { tables, transport, sample, paths: &ws.paths, times: &ws.times, lit: true };
    ws.statistics.rays += walk(&context, &mut ws.walk_hits, &mut ws.chunk, &mut ws.queues, &mut ws.deposits, cancelled);
    steps::measure_found(tracer, integrator, sample, ws);
    steps::trace_shadows(tracer, sample, ws);
    ws.statistics.spent(Stage::Shadow, time);
}
