//! The guiding field (path guiding), where indirect light comes from. It is learned from small pictures of the view, which nobody sees; each follows
//! what those before have told. It is used where that pays.

use super::learn::reduced;
use crate::{
    camera::sampler::{Runs, TILE},
    compile::{CompiledScene, View},
    light::LightCache,
    scene::{Antialiasing, Guiding, Integrator, Settings},
    threads::{start, workers},
    transport::{GuidingField, GuidingNotes, Learning, Start, Tracer, Transport},
};
use std::{
    ops::Range,
    sync::{
        Arc, Mutex, PoisonError,
        atomic::{AtomicUsize, Ordering},
    },
};

/// The small picture's longer side.
const SIDE: u32 = 128;
/// Samples a pixel of the first picture; each has twice those of the one before, up to this many in all.
const FIRST_SAMPLES: u32 = 4;
const MOST_SAMPLES: u32 = 124;
/// Pictures that are taken at least, whatever the first shows.
const LEAST_PICTURES: u32 = 3;
/// Part of a picture's paths that may be spent on learning.
const PART: u64 = 24;
/// Where less of the light than this comes from other surfaces, noise is that of the lamps' light.
const LEAST_INDIRECT: f64 = 0.5;
/// A guided path takes longer, up to 1.5 times, and the estimate is high: the mean square has to fall by this factor.
const LEAST_GAIN: f64 = 2.0;

/// What is known of the view so far.
struct Pilot<'a> {
    scene: &'a CompiledScene,
    tracer: Tracer<'a>,
    notes: GuidingNotes,
    /// Corners of the tiles, and the picture's end.
    tiles: Vec<[u32; 2]>,
    end: [u32; 2],
    threads: usize,
}

/// The field, where following it pays, and what was learned, in words; none where guiding is off.
pub(super) fn learn_guiding(
    scene: &CompiledScene,
    settings: &Settings,
    view: &View,
    light_cache: Option<&Arc<LightCache>>,
    cancelled: &(dyn Fn() -> bool + Sync),
) -> (Option<Arc<GuidingField>>, Option<String>) {
    if settings.guiding == Guiding::Off {
        return (None, None);
    }
    let learned = match hindrance(scene, settings) {
        Some(reason) => Err(format!("not learned, {reason}")),
        None => learn(scene, settings, view, light_cache, cancelled),
    };
    match learned {
        Ok((field, words)) => (Some(field), Some(format!("path guiding: {words}"))),
        Err(reason) => (None, Some(format!("path guiding: {reason}"))),
    }
}

/// Why paths of a view cannot be guided.
fn hindrance(scene: &CompiledScene, settings: &Settings) -> Option<&'static str> {
    if settings.integrator != Integrator::Path || settings.antialiasing != Antialiasing::Sampled {
        Some("paths of this integrator go where its rule says")
    } else if scene.tables.lights.is_empty() {
        Some("there are no lights")
    } else if !scene.tables.geometry.set_catcher.is_empty() {
        // They follow two paths for a pixel, which must go the same ways.
        Some("shadow catchers compare paths that must go the same ways")
    } else {
        None
    }
}

/// Learns, as long as it pays. What goes against the field is told in words.
fn learn(
    scene: &CompiledScene,
    settings: &Settings,
    view: &View,
    light_cache: Option<&Arc<LightCache>>,
    cancelled: &(dyn Fn() -> bool + Sync),
) -> Result<(Arc<GuidingField>, String), String> {
    let always = settings.guiding == Guiding::On;
    let small = View::new(scene, &reduced(settings, SIDE, 1024), view.transport.execution).map_err(|error| error.to_string())?;
    let most = affordable(settings, view, &small, always).ok_or("not learned, samples are too few for it to pay")?;
    let mut pilot = Pilot::new(scene, &small, light_cache, settings.threads);
    let (mut samples, mut learning) = (0..FIRST_SAMPLES, None);
    while samples.end <= most {
        pilot.take_picture(&samples, cancelled).ok_or("cancelled")?;
        let indirect = pilot.notes.indirect();
        if indirect < LEAST_INDIRECT {
            return Err(format!("given up, only {:.0} % of the light comes from other surfaces", 100.0 * indirect));
        }
        learning = GuidingField::learn(&pilot.notes.notes).map(|Learning { field, gain, cells }| (Arc::new(field), gain, cells));
        pilot.tracer.transport.guiding = learning.as_ref().map(|(field, ..)| field.clone());
        samples = samples.end..samples.end + 2 * (samples.end - samples.start);
    }
    let (field, gain, [cells, followed]) = learning.ok_or("given up, no light comes from other surfaces")?;
    let words = format!("{} samples a pixel of a small picture, {followed} of {cells} cells are followed, gain {gain:.2}", samples.start);
    if gain < LEAST_GAIN {
        return Err(format!("given up, does not cover what it costs ({words})"));
    }
    Ok((field, words))
}

/// Samples a pixel of the small pictures that a render can afford.
fn affordable(settings: &Settings, view: &View, small: &View, always: bool) -> Option<u32> {
    let pixels = |view: &View| u64::from(view.window.max[0] - view.window.min[0]) * u64::from(view.window.max[1] - view.window.min[1]);
    let budget = pixels(view) * u64::from(settings.samples) / PART;
    let most = u32::try_from(budget / pixels(small).max(1)).unwrap_or(u32::MAX).min(MOST_SAMPLES);
    let at_least = (0..LEAST_PICTURES).map(|picture| FIRST_SAMPLES << picture).sum();
    if always { Some(most.max(at_least)) } else { (most >= at_least).then_some(most) }
}

impl<'a> Pilot<'a> {
    fn new(scene: &'a CompiledScene, view: &'a View, light_cache: Option<&Arc<LightCache>>, threads: u32) -> Self {
        let transport = Transport { light_cache: light_cache.cloned(), ..view.transport.clone() };
        let tracer = Tracer { tables: &scene.tables, start: Start::Camera(&view.camera, &view.placement), transport };
        let [min, end] = [view.window.min, view.window.max];
        let corners = |axis: usize| (min[axis]..end[axis]).step_by(TILE);
        let tiles = corners(1).flat_map(|y| corners(0).map(move |x| [x, y])).collect();
        Self { scene, tracer, notes: GuidingNotes::default(), tiles, end, threads: workers(threads) }
    }

    /// Traces some samples of the picture; notes come in one order for any number of threads. `None` where that was cancelled.
    fn take_picture(&mut self, samples: &Range<u32>, cancelled: &(dyn Fn() -> bool + Sync)) -> Option<()> {
        let count = samples.len() * self.tiles.len();
        let parts: Vec<Mutex<GuidingNotes>> = (0..count).map(|_| Mutex::default()).collect();
        let next = AtomicUsize::new(0);
        std::thread::scope(|scope| {
            let work = || self.trace_parts(samples.start, &parts, &next, cancelled);
            (1..self.threads.min(count)).for_each(|_| drop(start(scope, work)));
            work();
        });
        if cancelled() {
            return None;
        }
        for part in parts {
            self.notes.append(&mut part.into_inner().unwrap_or_else(PoisonError::into_inner));
        }
        Some(())
    }

    fn trace_parts(&self, first: u32, parts: &[Mutex<GuidingNotes>], next: &AtomicUsize, cancelled: &dyn Fn() -> bool) {
        let mut workspace = self.scene.workspaces.take();
        workspace.prepare(&self.scene.tables, &self.tracer.transport, false);
        loop {
            let number = next.fetch_add(1, Ordering::Relaxed);
            let Some(part) = parts.get(number) else { break };
            let (tile, sample) = (number % self.tiles.len(), first + (number / self.tiles.len()) as u32);
            let min = self.tiles[tile];
            let max = [0, 1].map(|axis| (min[axis] + TILE as u32).min(self.end[axis]));
            workspace.deposits.guiding = Some(GuidingNotes::new(sample << 8 | tile as u32));
            self.tracer.trace(min, max, &Runs::whole(sample), &mut workspace, cancelled);
            if cancelled() {
                return;
            }
            *part.lock().unwrap_or_else(PoisonError::into_inner) = workspace.deposits.guiding.take().unwrap_or_default();
        }
        self.scene.workspaces.leave(workspace);
    }
}
