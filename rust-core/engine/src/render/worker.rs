//! A worker: takes blocks, traces them, adds them to the film; a panic becomes the render's failure.

use super::{Learned, Shared, guide::learn_guiding, learn::learn, meter, schedule::Work, source::Source};
use crate::{
    antialias::{Antialiaser, Rule, TileTask},
    camera::sampler::Runs,
    film::{Block, SplatBlock},
    scene::{Antialiasing, Aov, Crop, Integrator},
    threads::panic_message,
    transport::{PathFilter, Photons, Tracer, Transport, Workspace},
};
use crossbeam_channel::Sender;
use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    sync::{Arc, PoisonError, atomic::Ordering},
    time::Instant,
};

/// Camera rays a pixel that show denoisers enough of what is seen in mirrors and smooth glass.
const SPECULAR_RAYS: u32 = 32;

/// What a worker keeps from block to block.
struct Room {
    workspace: Workspace,
    antialiaser: Antialiaser,
}

/// Works until nothing is left, the render is cancelled, or something fails.
pub(super) fn work(shared: &Shared, ready: &Sender<usize>) {
    let result = catch_unwind(AssertUnwindSafe(|| {
        let mut room = Room { workspace: shared.scene.workspaces.take(), antialiaser: Antialiaser::default() };
        while let Some(work) = shared.schedule.take(&|| shared.cancel.load(Ordering::Relaxed)) {
            trace_block(shared, &work, &mut room, ready);
        }
        // What was cancelled may have left paths on their way.
        if !shared.cancel.load(Ordering::Relaxed) {
            shared.scene.workspaces.leave(room.workspace);
        }
    }));
    if let Err(panic) = result {
        *shared.failure.lock().unwrap_or_else(PoisonError::into_inner) = Some(panic_message(&*panic));
        shared.cancel.store(true, Ordering::Relaxed);
    }
}

/// Traces a block, adds it and tells the host; nothing of it remains if it was cancelled on the way.
fn trace_block(shared: &Shared, work: &Work, room: &mut Room, ready: &Sender<usize>) {
    let (tables, start) = (&shared.scene.tables, Instant::now());
    let cancelled = || shared.cancel.load(Ordering::Relaxed);
    let Learned { light_cache, guiding, white, .. } = shared.learned.get_or_init(|| learned(shared, &cancelled)).clone();
    let specular_rays = specular_rays(shared);
    let path_filter = if specular_rays.is_some() { PathFilter::ExceptSpecular } else { PathFilter::All };
    let photons = photons(shared, work, room, &cancelled);
    let transport = Transport { light_cache, guiding, path_filter, photons, ..shared.source.transport().clone() };
    let zones = shared.film.state(work.tile).zones;
    let tracer = Tracer { tables, start: shared.source.start(), transport };
    let workspace = &mut room.workspace;
    workspace.prepare(tables, &tracer.transport, shared.film.layout.shows_lights());
    let area = shared.film.tile_area(work.tile);
    let rule = shared.source.rule();
    match rule {
        Some(rule) => antialias(shared, &tracer, rule, area, white, room),
        None => Runs::batches(zones, work.samples.clone())
            .take_while(|_| !cancelled())
            .for_each(|runs| tracer.trace(area.min, area.max, &runs, workspace, &cancelled)),
    }
    if let Some(rays) = specular_rays {
        tracer.trace_specular([area.min, area.max], zones, work.samples.clone(), rays, &mut room.workspace, &cancelled);
    }
    let mut splats = SplatBlock::default();
    let layout = shared.film.splats().map(|film| film.layout().clone());
    if let (Some(light_paths), Source::View(view), Some(layout)) = (&shared.light_paths, &shared.source, layout) {
        let of_block = (work.tile, work.samples.clone());
        splats = light_paths.trace(shared, (view, &tracer.transport), of_block, &layout, &mut room.workspace, &cancelled);
    }
    if cancelled() {
        return;
    }
    let workspace = &mut room.workspace;
    let statistics = std::mem::take(&mut workspace.statistics);
    shared.statistics.lock().unwrap_or_else(PoisonError::into_inner).add(&statistics);
    let origin = shared.scene.tables.origin;
    // Where samples follow discontinuities every pixel has its own slot.
    let packed = if rule.is_some() { u64::MAX } else { zones };
    let mut block = Block { splats, ..Block::new(&shared.film, &workspace.deposits.sums, zones, packed, origin) };
    block.share_out(&shared.film, start.elapsed().as_secs_f64());
    // Counted first, so that the last tile's news finds the progress complete.
    shared.schedule.finished(work);
    let state = shared.film.add(work.tile, work.block, block, white, || {
        // A slow host finds a tile's news once, with all that has come since.
        if !shared.news[work.tile].swap(true, Ordering::AcqRel) {
            let _ = ready.try_send(work.tile);
        }
    });
    shared.schedule.decided(work.tile, state);
}

/// The photons that the block's paths take up.
fn photons(shared: &Shared, work: &Work, room: &mut Room, cancelled: &dyn Fn() -> bool) -> Option<Arc<Photons>> {
    let (maps, light_paths) = (shared.photons.as_ref()?, shared.light_paths.as_ref()?);
    let block = (work.block, work.samples.end - work.samples.start);
    maps.of_block(block, &shared.scene, shared.source.transport(), light_paths, &mut room.workspace, cancelled)
}

/// For each sample, camera rays of their own for what is seen in mirrors and smooth glass, where denoisers ask for them and samples are drawn at random.
fn specular_rays(shared: &Shared) -> Option<u32> {
    let wanted = shared.film.layout.offset(Aov::DenoisingLight).is_some();
    let settings = &shared.settings;
    let drawn = !matches!(settings.integrator, Integrator::Whitted | Integrator::Light) && settings.antialiasing == Antialiasing::Sampled;
    // What shadow catchers hide is compared path by path.
    let possible = wanted && drawn && shared.film.layout.catchers.is_none();
    possible.then(|| SPECULAR_RAYS.div_ceil(settings.samples.max(1)))
}

/// What is to be known before the first block.
fn learned(shared: &Shared, cancelled: &(dyn Fn() -> bool + Sync)) -> Learned {
    let light_cache = learn(&shared.scene, &shared.settings, &shared.source, cancelled);
    let (guiding, of_guiding) = match &shared.source {
        Source::View(view) => learn_guiding(&shared.scene, &shared.settings, view, light_cache.as_ref(), cancelled),
        _ => (None, None),
    };
    let white = match &shared.source {
        Source::View(view) if shared.film.looks_at_noise() || view.rule.is_some() => {
            let samples = if shared.film.looks_at_noise() { meter::FOR_NOISE } else { meter::FOR_EDGES };
            meter::meter(&shared.scene, &shared.settings, samples, view.transport.execution, cancelled)
        }
        _ => 1.0,
    };
    Learned { light_cache, guiding, of_guiding, white }
}

/// Traces a tile where it needs samples.
fn antialias(shared: &Shared, tracer: &Tracer<'_>, rule: Rule, area: Crop, white: f32, room: &mut Room) {
    let layout = &shared.film.layout;
    let passes =
        layout.holes.is_some() || layout.aovs.iter().any(|aov| !matches!(aov, Aov::Color | Aov::Alpha | Aov::Luminance | Aov::SampleCount));
    let scale = shared.film.exposure() / white;
    let task = TileTask { tracer, rule, scale, min: area.min, max: area.max, passes };
    room.antialiaser.trace(&task, &mut room.workspace, &|| shared.cancel.load(Ordering::Relaxed));
}
