//! Rendering: worker threads take blocks of tiles, the host pulls what is ready; progress and cancelling live here.

mod covered;
mod guide;
mod learn;
mod light_paths;
mod meter;
mod photons;
mod progress;
mod schedule;
mod seen;
mod source;
mod worker;

pub use progress::Progress;
pub use schedule::TileReady;

use crate::{
    compile::{CompiledScene, View, picture_view, transport},
    error::{Error, Result},
    film::Film,
    light::LightCache,
    scene::{Aov, Crop, Integrator, Settings},
    threads::workers,
    transport::{Estimator, FirstLight, GuidingField, PlaceTable, SensorTable, Statistics, Transport},
};
pub(crate) use light_paths::LightPaths;
use photons::PhotonMaps;
use schedule::Schedule;
use source::Source;
use std::{
    mem::forget,
    process,
    sync::{
        Arc, OnceLock,
        atomic::{AtomicBool, Ordering},
    },
    thread::{Builder, JoinHandle},
    time::Duration,
};

/// A render under way; dropping it cancels and waits for the workers.
#[derive(Debug)]
pub struct Render {
    shared: Arc<Shared>,
    workers: Vec<JoinHandle<()>>,
    ready: crossbeam_channel::Receiver<usize>,
    /// Whose threads the workers are.
    process: u32,
}

/// What host and workers share.
#[derive(Debug)]
pub(crate) struct Shared {
    pub(crate) scene: Arc<CompiledScene>,
    pub(crate) source: Source,
    pub(crate) settings: Settings,
    /// What the first worker learns.
    pub(crate) learned: OnceLock<Learned>,
    pub(crate) film: Film,
    pub(crate) light_paths: Option<LightPaths>,
    photons: Option<PhotonMaps>,
    pub(crate) schedule: Schedule,
    /// Tiles that have news for the host, which it has not taken yet.
    pub(crate) news: Vec<AtomicBool>,
    pub(crate) cancel: AtomicBool,
    pub(crate) failure: std::sync::Mutex<Option<String>>,
    pub(crate) statistics: std::sync::Mutex<Statistics>,
}

/// What small pictures of the view have told, which nobody sees.
#[derive(Clone, Debug)]
pub(crate) struct Learned {
    /// The learned light cache: which lights arrive where.
    pub(crate) light_cache: Option<Arc<LightCache>>,
    /// The guiding field: where indirect light comes from.
    pub(crate) guiding: Option<Arc<GuidingField>>,
    /// What was learned of it and whether it is followed, in words.
    pub(crate) of_guiding: Option<String>,
    /// The value of the colour pass that is shown as white.
    pub(crate) white: f32,
}

impl Render {
    /// Starts rendering; settings are those of the compiled view.
    pub fn start(scene: Arc<CompiledScene>, settings: &Settings, execution: gonio_simd::Execution) -> Result<Self> {
        let (view, light_paths) = view(&scene, settings, execution)?;
        let power = light_paths.as_ref().map(LightPaths::power);
        let film = film_of(&scene, settings, view.window, view.exposure).with_splats(power);
        Self::run(scene, settings, Source::View(view), film, light_paths, 0)
    }

    /// Goes on with a film that the same render has left; see [`crate::checkpoint`].
    pub fn resume(scene: Arc<CompiledScene>, settings: &Settings, execution: gonio_simd::Execution, film: Film) -> Result<Self> {
        let (view, light_paths) = view(&scene, settings, execution)?;
        Self::run(scene, settings, Source::View(view), film, light_paths, 0)
    }

    /// Starts measuring at sensors, whose picture has the resolution of the settings. Of the light that light paths bring what falls on meters
    /// themselves is left out; `round` is the number of the render among those that are to be independent of each other.
    pub(crate) fn sense(
        scene: Arc<CompiledScene>,
        sensors: SensorTable,
        settings: &Settings,
        execution: gonio_simd::Execution,
        brought: Option<(LightPaths, Arc<[u32]>)>,
        round: u32,
    ) -> Result<Self> {
        let mut transport = transport(&scene, settings, execution, [0.0; 3], [0.0; 3]);
        transport.passes.illuminance = false;
        let light_paths = bring(&mut transport, brought, FirstLight::Discs);
        let window = Crop { min: [0; 2], max: settings.resolution };
        let film = film_of(&scene, settings, window, 1.0);
        Self::run(scene, settings, Source::Sensors { sensors: Box::new(sensors), transport }, film, light_paths, round)
    }

    /// Starts baking at places, whose picture has the resolution of the settings.
    pub(crate) fn at_places(
        scene: Arc<CompiledScene>,
        places: PlaceTable,
        settings: &Settings,
        execution: gonio_simd::Execution,
    ) -> Result<Self> {
        let mut transport = transport(&scene, settings, execution, [0.0; 3], [0.0, 0.0, -1.0]);
        // Places are measured themselves, whatever they are made of.
        transport.passes.illuminance = false;
        let light_paths = bring(&mut transport, light_paths::plan(&scene, settings), FirstLight::Photons);
        let window = Crop { min: [0; 2], max: settings.resolution };
        let film = film_of(&scene, settings, window, 1.0);
        Self::run(scene, settings, Source::Places { places, transport }, film, light_paths, 0)
    }

    fn run(
        scene: Arc<CompiledScene>,
        settings: &Settings,
        source: Source,
        film: Film,
        light_paths: Option<LightPaths>,
        round: u32,
    ) -> Result<Self> {
        let tiles = (0..film.tile_count()).map(|tile| film.state(tile));
        let schedule = Schedule::new(tiles, settings);
        let tiles = film.tile_count();
        let view = match &source {
            Source::View(view) => Some(view),
            Source::Sensors { .. } | Source::Places { .. } => None,
        };
        let photons = light_paths.as_ref().filter(|paths| paths.caustics()).map(|_| PhotonMaps::new(&scene, view, round));
        let shared = Arc::new(Shared {
            scene,
            source,
            settings: settings.clone(),
            learned: OnceLock::new(),
            film,
            photons,
            light_paths,
            schedule,
            news: (0..tiles).map(|_| AtomicBool::new(false)).collect(),
            cancel: AtomicBool::new(false),
            failure: std::sync::Mutex::new(None),
            statistics: std::sync::Mutex::default(),
        });
        let (send, ready) = crossbeam_channel::bounded(tiles.max(1));
        let spawn = |_| {
            let (shared, send) = (shared.clone(), send.clone());
            Builder::new().spawn(move || worker::work(&shared, &send)).ok()
        };
        // Fewer where the system has no more to give.
        let workers: Vec<_> = (0..workers(settings.threads)).map_while(spawn).collect();
        if workers.is_empty() {
            return Err(Error::setting("threads", "the system gives this process no thread; its limit on processes may be reached"));
        }
        Ok(Self { shared, workers, ready, process: process::id() })
    }

    /// The next tile with new samples; `None` when the time is out or the render has ended (see [`Render::is_finished`]).
    pub fn next_tile(&self, timeout: Duration) -> Option<TileReady> {
        let tile = self.ready.recv_timeout(timeout).ok()?;
        // From here on more news are sent again, so that none are missed.
        self.shared.news[tile].store(false, Ordering::Release);
        Some(TileReady { tile, samples: self.shared.film.state(tile).samples })
    }

    /// Whether its workers are threads of this process. One that was split off (`fork`) meanwhile has none of them, and nothing goes on there.
    pub fn is_of_this_process(&self) -> bool {
        self.process == process::id()
    }

    /// Whether all workers have ended.
    pub fn is_finished(&self) -> bool {
        !self.is_of_this_process() || self.workers.iter().all(JoinHandle::is_finished)
    }

    /// How far it is.
    pub fn progress(&self) -> Progress {
        let statistics = self.statistics();
        self.shared.schedule.progress(statistics.rays + statistics.shadow_rays)
    }

    /// Rays, lanes and the time of each stage so far, over all workers.
    pub fn statistics(&self) -> Statistics {
        *self.shared.statistics.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
    }

    /// Asks the workers to stop after the stage under way.
    pub fn cancel(&self) {
        self.shared.cancel.store(true, Ordering::Relaxed);
    }

    /// Whether a stop was asked for.
    pub fn is_cancelled(&self) -> bool {
        self.shared.cancel.load(Ordering::Relaxed)
    }

    /// What the guiding field has learned and whether it is followed, in words; none where guiding is off, or before.
    pub fn guiding(&self) -> Option<&str> {
        self.shared.learned.get()?.of_guiding.as_deref()
    }

    /// The film so far.
    pub fn film(&self) -> &Film {
        &self.shared.film
    }

    /// The scene.
    pub fn scene(&self) -> &CompiledScene {
        &self.shared.scene
    }

    /// Waits for the end; a worker's failure comes out as an error, a cancelled render as [`Error::Cancelled`].
    pub fn finish(&mut self) -> Result<()> {
        if !self.is_of_this_process() {
            return Err(Error::Internal(
                "a render goes on in the process that started it alone, not in one split off from that (fork)".into(),
            ));
        }
        for worker in self.workers.drain(..) {
            if worker.join().is_err() {
                return Err(Error::Internal("a worker ended unexpectedly".into()));
            }
        }
        let failure = self.shared.failure.lock().unwrap_or_else(std::sync::PoisonError::into_inner).take();
        match failure {
            Some(message) => Err(Error::Internal(message)),
            None if self.is_cancelled() => Err(Error::Cancelled),
            None => Ok(()),
        }
    }
}

/// A view, and the light paths that go with it.
fn view(scene: &CompiledScene, settings: &Settings, execution: gonio_simd::Execution) -> Result<(View, Option<LightPaths>)> {
    let mut view = View::new(scene, settings, execution)?;
    if settings.integrator == Integrator::Light {
        by_light_alone(scene, settings)?;
        view.transport.estimator = Estimator::Seen;
    }
    let light_paths = bring(&mut view.transport, light_paths::plan(scene, settings), FirstLight::Splats);
    Ok((view, light_paths))
}

/// Leaves to light paths what they bring.
fn bring(transport: &mut Transport, planned: Option<(LightPaths, Arc<[u32]>)>, first_light: FirstLight) -> Option<LightPaths> {
    let (light_paths, started) = planned?;
    transport.light_paths = light_paths.caustics().then_some(started);
    transport.first_light = first_light;
    Some(light_paths)
}

/// Refuses what no light path brings.
fn by_light_alone(scene: &CompiledScene, settings: &Settings) -> Result<()> {
    let problem = if settings.aovs.contains(&Aov::Illuminance) {
        "light brings no illuminance pass; `gonio map` keeps lux on surfaces, or choose path"
    } else if !scene.tables.geometry.set_catcher.is_empty() {
        "light knows no shadow catchers; choose path"
    } else if settings.noise_threshold > 0.0 {
        "light reaches all pixels at once; leave out the noise threshold, or choose path"
    } else {
        return Ok(());
    };
    Err(Error::setting("integrator", problem))
}

fn film_of(scene: &CompiledScene, settings: &Settings, window: Crop, exposure: f32) -> Film {
    let film = Film::new(settings, window, exposure, scene.besides);
    let camera = scene.cameras.get(settings.camera as usize);
    film.with_manifests(scene.manifests.clone()).with_view(camera.and_then(|camera| picture_view(camera, settings, window)))
}

impl Drop for Render {
    fn drop(&mut self) {
        if !self.is_of_this_process() {
            // Threads that are not there cannot be waited for.
            return forget(std::mem::take(&mut self.workers));
        }
        self.cancel();
        for worker in self.workers.drain(..) {
            // A panic was already turned into a failure; there is nobody left to tell.
            let _ = worker.join();
        }
    }
}
