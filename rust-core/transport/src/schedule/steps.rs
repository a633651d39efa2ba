//! Steps that schedules share: each hands the parts of the workspace to a stage, some chunk by chunk.

use crate::accumulate::shader_passes::shader_program;
use crate::kernels;
use crate::schedule::tracer::{Start, Tracer};
use crate::stage::find::sort::list_materials;
use crate::stage::find::surface::{ChunkRays, ChunkSource};
use crate::stage::find::{found_light, intersect};
use crate::stage::light::measure::MeasureContext;
use crate::stage::light::shadow;
use crate::stage::medium;
use crate::stage::shade::catcher;
use crate::stage::shade::integrator::Integrator;
use crate::stage::shade::shading::shade_chunk;
use crate::stage::start::index::weigh_points;
use crate::state::chunk::{ChunkColumns, ChunkContext};
use crate::state::paths::Paths;
use crate::state::queue::shadow_rays::hits_together;
use crate::state::sample::SampleContext;
use crate::state::workspace::Workspace;
use crate::statistics::{LaneStage, Stage};
use crate::tables::Tables;
use crate::words::flag;
use gonio_simd::{Lanes, dispatch};
use std::{ops::Range, time::Instant};

/// Most surfaces of a path, those that it went straight through included: a guard against endless stacks of cut-outs.
pub(crate) const MOST_DEPTH: u32 = 256;
const _: () = assert!(MOST_DEPTH < 1 << (32 - flag::BOUNCE_SHIFT));

/// Finds what all paths hit, and adds the light of lights among it.
pub(crate) fn intersect(tracer: &Tracer<'_>, sample: &SampleContext<'_>, ws: &mut Workspace) {
    let depth = sample.depth;
    let Tracer { tables, transport, .. } = tracer;
    let Workspace { paths, nearest, deposits, statistics, times, .. } = ws;
    paths.set_times(times);
    if depth == 0 && matches!(tracer.start, Start::Places(_)) {
        // Their hits were written when they started.
        nearest.escaped.clear();
    } else {
        statistics.rays += paths.count as u64;
        deposits.sums.effort.count(paths);
        intersect::find(tables, transport, depth, paths, nearest);
        found_light::add_found((tables, transport), sample, paths, nearest, deposits);
    }
    let escaped = nearest.escaped.len();
    statistics.count_lanes(depth, LaneStage::Escaped, escaped.next_multiple_of(transport.execution.lanes()), escaped);
}

/// Forks at shadow catchers, and looks up the materials of what was hit. What media scatter before a catcher belongs to the pixel and to neither half.
pub(crate) fn find_materials(tracer: &Tracer<'_>, ws: &mut Workspace) {
    let Tracer { tables, transport, .. } = tracer;
    catcher::fork(tables, transport, &mut ws.paths, &mut ws.nearest.hits);
    dispatch!(transport.execution, l => list_materials(l, tables, &ws.nearest.hits, &mut ws.materials.material_of));
}

/// Takes paths through the media before what they hit, where these scatter them; else what varies dims them.
pub(crate) fn pass_media(tracer: &Tracer<'_>, sample: &SampleContext<'_>, scatters: bool, ws: &mut Workspace) {
    let Tracer { tables, transport, start } = tracer;
    let media = &tables.materials.media;
    // Baked places have no way before them.
    let known = sample.depth == 0 && matches!(start, Start::Places(_));
    if known || !(media.scatters() || media.shines() || media.varies()) {
        return;
    }
    if !scatters {
        if media.varies() {
            medium::dim((tables, transport), sample, &mut ws.paths, &ws.nearest);
        }
        return;
    }
    medium::pass((tables, transport), sample, &mut ws.paths, &mut ws.nearest, &mut ws.queues, &mut ws.deposits);
}

/// Shades all surface hits, material by material, a chunk at a time.
pub(crate) fn shade<I: Integrator>(tracer: &Tracer<'_>, integrator: &I, context: &SampleContext<'_>, ws: &mut Workspace) {
    let most = hits_together(integrator.shadow_rays_per_hit());
    for surface in 0..tracer.tables.materials.surfaces.len() {
        let Range { mut start, end } = ws.materials.hits_of(surface);
        while start < end {
            let count = (end - start).min(most);
            let time = Instant::now();
            make_room(tracer, integrator, context, count, ws);
            ws.statistics.spent(Stage::Shadow, time);
            let hits = start..start + count;
            dispatch!(tracer.transport.execution, l => shade_hits(l, tracer, integrator, context, surface, hits.clone(), ws));
            start += count;
        }
    }
}

/// Surface points, programs and shading of a chunk of hits.
#[inline(always)]
fn shade_hits<L: Lanes, I: Integrator>(
    l: L,
    tracer: &Tracer<'_>,
    integrator: &I,
    sample: &SampleContext<'_>,
    surface: usize,
    hits: Range<usize>,
    ws: &mut Workspace,
) {
    let Tracer { tables, transport, .. } = tracer;
    let Workspace { paths, nearest, materials, chunk: columns, queues, deposits, statistics, .. } = ws;
    let (hits, count, order) = (&nearest.hits, hits.len(), &materials.order[hits.start..]);
    let shader = shader_program(&transport.passes.shader, surface, &order[..count], paths);
    let material = &tables.materials.surfaces[surface];
    let start = Instant::now();
    let source = ChunkSource { order, count, rays: ChunkRays::Paths(paths) };
    kernels::surface_points(l, tables, &material.program, hits, &source, &mut columns.surface);
    let start = statistics.spent(Stage::Surface, start);
    columns.wavelengths.fill(sample.wavelengths, order[..count].iter().map(|path| paths.slot(*path as usize)));
    let ChunkColumns { surface, scratch, outputs, shader_outputs, .. } = columns;
    if let Some(program) = shader {
        // Before the surface's own program bends the normals.
        kernels::evaluate(l, tables, program, surface, count, scratch, shader_outputs);
    }
    if !material.program.is_empty() {
        kernels::evaluate(l, tables, &material.program, surface, count, scratch, outputs);
    }
    let start = statistics.spent(Stage::Graph, start);
    let (sent, going_on) = (queues.shadows.count, queues.next.count);
    let straight = material.way_straight();
    let chunk = ChunkContext { l, tables, transport, sample, shader, count, order, paths, hits, columns, straight };
    shade_chunk(integrator, &chunk, material, queues, deposits);
    statistics.spent(Stage::Shade, start);
    let run = count.next_multiple_of(L::COUNT);
    let (sent, going_on) = (queues.shadows.count - sent, queues.next.count - going_on);
    for (stage, alive) in [(LaneStage::Shade, count), (LaneStage::Light, sent), (LaneStage::Scatter, going_on)] {
        statistics.count_lanes(sample.depth, stage, run, alive);
    }
}

/// Lights the points whose illuminance is measured.
pub(crate) fn measure<I: Integrator>(tracer: &Tracer<'_>, integrator: &I, sample: &SampleContext<'_>, ws: &mut Workspace) {
    let Tracer { tables, transport, .. } = tracer;
    let (count, together) = (ws.queues.measure.count, hits_together(integrator.shadow_rays_per_hit()));
    for first in (0..count).step_by(together) {
        let range = first..(first + together).min(count);
        make_room(tracer, integrator, sample, range.len(), ws);
        let (queues, deposits) = (&mut ws.queues, &mut ws.deposits);
        dispatch!(transport.execution, l => {
            let chunk = MeasureContext { l, tables, transport, sample, points: &queues.measure, range: range.clone() };
            integrator.measure(&chunk, &mut queues.shadows, &mut queues.next, deposits);
        });
    }
    ws.queues.measure.count = 0;
}

/// The same for points that paths have found.
pub(crate) fn measure_found<I: Integrator>(tracer: &Tracer<'_>, integrator: &I, sample: &SampleContext<'_>, ws: &mut Workspace) {
    weigh_points(tracer.tables, &tracer.transport, &mut ws.queues.measure);
    measure(tracer, integrator, sample, ws);
}

/// Traces the queue of shadow rays if those of some more hits would not fit into it.
fn make_room<I: Integrator>(tracer: &Tracer<'_>, integrator: &I, sample: &SampleContext<'_>, hits: usize, ws: &mut Workspace) {
    if !ws.queues.shadows.has_room(hits, integrator.shadow_rays_per_hit()) {
        trace_shadows(tracer, sample, ws);
    }
}

/// Traces the queued shadow rays and adds the light of those that arrive.
pub(crate) fn trace_shadows(tracer: &Tracer<'_>, sample: &SampleContext<'_>, ws: &mut Workspace) {
    let Workspace { queues, shadow_trace, chunk, deposits, statistics, times, .. } = ws;
    statistics.shadow_rays += queues.shadows.count as u64;
    queues.shadows.set_times(times);
    if tracer.tables.materials.media.varies() {
        dispatch!(tracer.transport.execution, l => queues.shadows.set_salts(l, sample));
    }
    shadow::trace_shadows(tracer.tables, &tracer.transport, sample.depth == 0, &mut queues.shadows, shadow_trace, chunk, deposits);
}

/// Sets the visibility bits of paths that are about to be traced.
pub(crate) fn set_masks(tables: &Tables, paths: &mut Paths) {
    paths.set_masks();
    catcher::set_masks(tables, paths);
}
