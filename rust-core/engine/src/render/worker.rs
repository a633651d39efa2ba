//! A worker: takes blocks, traces them, adds them to the film; a panic becomes the render's failure.

use super::{Learned, Shared, TileReady, learn::learn, meter::meter, schedule::Work, source::Source};
use crate::{
    film::Block,
    integrator::{Runs, Tracer, Transport, Workspace},
};
use crossbeam_channel::Sender;
use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    sync::{PoisonError, atomic::Ordering},
};

/// Works until nothing is left, the render is cancelled, or something fails.
pub(super) fn work(shared: &Shared, ready: &Sender<TileReady>) {
    let result = catch_unwind(AssertUnwindSafe(|| {
        let mut workspace = Workspace::default();
        while let Some(work) = shared.schedule.take(&|| shared.cancel.load(Ordering::Relaxed)) {
            trace_block(shared, &work, &mut workspace, ready);
        }
    }));
    if let Err(panic) = result {
        let message = panic.downcast_ref::<&str>().map(ToString::to_string).or_else(|| panic.downcast_ref::<String>().cloned());
        *shared.failure.lock().unwrap_or_else(PoisonError::into_inner) = Some(message.unwrap_or_else(|| "unknown panic".into()));
        shared.cancel.store(true, Ordering::Relaxed);
    }
}

/// Traces a block, adds it and tells the host; nothing of it remains if it was cancelled on the way.
fn trace_block(shared: &Shared, work: &Work, workspace: &mut Workspace, ready: &Sender<TileReady>) {
    let tables = &shared.scene.tables;
    let area = shared.film.tile_area(work.tile);
    let cancelled = || shared.cancel.load(Ordering::Relaxed);
    let learned = || match &shared.source {
        Source::View(view) => {
            let (scene, settings, execution) = (&shared.scene, &shared.settings, view.transport.execution);
            let white = shared.film.looks_at_noise().then(|| meter(scene, settings, execution, &cancelled));
            Learned { known: learn(scene, settings, execution, &cancelled), white: white.unwrap_or(1.0) }
        }
        // Sensors have no view to learn from.
        Source::Sensors { .. } => Learned { known: None, white: 1.0 },
    };
    let Learned { known, white } = shared.learned.get_or_init(learned).clone();
    let transport = Transport { known, ..shared.source.transport().clone() };
    let zones = shared.film.state(work.tile).zones;
    let tracer = Tracer { tables, start: shared.source.start(), transport };
    workspace.prepare(tables, &tracer.transport, shared.film.layout.shows_lights());
    for runs in Runs::batches(zones, work.samples.clone()) {
        tracer.trace(area.min, area.max, &runs, workspace, &cancelled);
        if cancelled() {
            return;
        }
    }
    let statistics = std::mem::take(&mut workspace.statistics);
    shared.statistics.lock().unwrap_or_else(PoisonError::into_inner).add(&statistics);
    let origin = shared.scene.tables.origin;
    let block = Block::new(&shared.film, &workspace.first_hit, zones, origin);
    // Counted first, so that the last tile's news finds the progress complete.
    shared.schedule.finished(work);
    let state = shared.film.add(work.tile, work.block, block, white, |samples| {
        // A slow host misses intermediate news of a tile, never its data.
        let _ = ready.try_send(TileReady { tile: work.tile, samples });
    });
    shared.schedule.decided(work.tile, state);
}
