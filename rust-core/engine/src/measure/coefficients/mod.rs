//! Daylight coefficients: what light each patch of an even sky brings to points, and each sun straight from its place.
//!
//! Paths start at the points. What escapes is added to the patch that it came from, so that one pass serves all skies (Tregenza and Waters 1983). What
//! nothing scatters comes by shadow rays instead, spread evenly over each patch. Rounds have seeds of their own: they are independent estimates, of whose
//! products with skies standard errors are made.

mod rounds;
mod straight;

use super::{
    sense::{Probe, placed},
    sensing::unlimited,
    watch::Watch,
};
use crate::{
    compile::{CompiledScene, compile, light_paths_measure},
    error::{Diagnostic, Error, Result},
    render::Progress,
    scene::{Emission, Light, LightShape, Measurand, Meter, Origin, Scene, Settings, Transform},
    threads::{panic_message, start, workers},
    transport::{Sensor, Workspace},
};
use gonio_simd::Execution;
use std::{
    any::Any,
    sync::{
        Arc,
        atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering},
    },
    time::{Duration, Instant},
};

/// Independent estimates.
pub const ROUNDS: usize = 16;
/// How often progress is told.
const TELL_EVERY: Duration = Duration::from_millis(50);

/// How the sky is divided, and where suns stand. Directions are unit vectors in the scene.
#[derive(Clone, Copy)]
pub struct SkyTask<'a> {
    /// Patches.
    pub patches: usize,
    /// The patch of a direction.
    pub patch_of: &'a (dyn Fn([f32; 3]) -> usize + Sync),
    /// A place in a patch for two numbers from 0 to 1, even by solid angle; none in patches that paths alone are to find.
    pub place: &'a (dyn Fn(usize, [f64; 2]) -> Option<[f32; 3]> + Sync),
    /// Steradians of a patch.
    pub solid_angle: &'a (dyn Fn(usize) -> f64 + Sync),
    /// Centres of suns' discs.
    pub suns: &'a [[f64; 3]],
    /// Radians under which their discs are seen.
    pub sun_angle: f64,
    /// The zenith: what is below the horizon shines on nothing.
    pub up: [f64; 3],
}

/// What light each patch and each sun brings: lx for 1 cd/m².
#[derive(Clone, Debug, Default)]
pub struct DaylightCoefficients {
    /// All light, by round: points × patches.
    pub all: Vec<Vec<f32>>,
    /// The part that anything scattered on its way: glass that light goes straight through does not.
    pub scattered: Vec<Vec<f32>>,
    /// Straight from the suns' discs: points × suns.
    pub suns: Vec<f32>,
    /// What differs from what was asked for.
    pub diagnostics: Vec<Diagnostic>,
}

impl std::fmt::Debug for SkyTask<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("SkyTask").field("patches", &self.patches).field("suns", &self.suns.len()).finish_non_exhaustive()
    }
}

/// Said where light of the sun comes by what shadow rays do not pass.
const BY_PATCHES: &str = "the sun's light by mirrors and clear solid glass is spread over patches of the sky, and is no direct light; glaze windows with \
    thin panes, which it goes straight through";

/// Said where clear glass hides what stands straight behind it.
const HIDDEN: &str =
    "clear solid glass and mirrors count as what hides the sun; glaze windows with thin panes, which it goes straight through";

/// Finds the coefficients of points that lie on planes, with the scene's settings: `samples` paths a point. Its lamps are dark, its skies and suns give
/// way to the patches.
///
/// # Errors
/// Points that measure anything but illuminance, what compiling finds, cancellation.
pub fn daylight_coefficients(
    scene: &Scene,
    points: &[Meter],
    task: &SkyTask<'_>,
    execution: Execution,
    watch: &mut Watch<'_>,
) -> Result<DaylightCoefficients> {
    if let Some(other) = points.iter().find(|point| point.measurand != Measurand::Illuminance) {
        let problem = format!("daylight coefficients are of illuminances, {} was asked for", other.measurand.name());
        return Err(Error::scene(&other.origin, problem));
    }
    let laid = Laid::out(scene, points, watch)?;
    let (settings, mut diagnostics) = (laid.settings, laid.compiled.diagnostics.clone());
    if let (true, Some(first)) = (light_paths_measure::bends_light(&laid.compiled), points.first()) {
        diagnostics.push(Diagnostic::warning(&first.origin, BY_PATCHES));
    }
    let tracing = Tracing { scene: &laid.compiled, sensors: &laid.sensors, settings: &settings, execution, task };
    let work = Work::new();
    let total = rounds::batches(&tracing) + straight::batches(&tracing);
    let found = work.watched(total, tracing.settings.samples, watch, || {
        let [mut all, scattered] = rounds::trace(&tracing, &work)?;
        for (all, straight) in all.iter_mut().zip(straight::patches(&tracing, &work)?) {
            all.iter_mut().zip(straight).for_each(|(all, straight)| *all += straight);
        }
        Ok((all, scattered, straight::suns(&tracing, &work)?))
    });
    let (all, scattered, suns) = found?;
    Ok(DaylightCoefficients { all, scattered, suns, diagnostics })
}

/// What comes straight from the discs of suns alone, seen under an angle in radians, `up` being the zenith: points × suns, lx for 1 cd/m²; and what differs
/// from what was asked for. Thin panes let it through.
///
/// # Errors
/// What compiling finds, cancellation.
pub fn sun_coefficients(
    scene: &Scene,
    points: &[Meter],
    (suns, sun_angle, up): (&[[f64; 3]], f64, [f64; 3]),
    execution: Execution,
    watch: &mut Watch<'_>,
) -> Result<(Vec<f32>, Vec<Diagnostic>)> {
    let laid = Laid::out(scene, points, watch)?;
    let task = SkyTask { patches: 0, patch_of: &|_| 0, place: &|_, _| None, solid_angle: &|_| 0.0, suns, sun_angle, up };
    let tracing = Tracing { scene: &laid.compiled, sensors: &laid.sensors, settings: &laid.settings, execution, task: &task };
    let work = Work::new();
    let found = work.watched(straight::batches(&tracing), 1, watch, || straight::suns(&tracing, &work))?;
    let mut diagnostics = laid.compiled.diagnostics.clone();
    if let (true, Some(first)) = (light_paths_measure::bends_light(&laid.compiled), points.first()) {
        diagnostics.push(Diagnostic::warning(&first.origin, HIDDEN));
    }
    Ok((found, diagnostics))
}

/// Points in a scene under an even sky.
struct Laid {
    compiled: Arc<CompiledScene>,
    sensors: Vec<Sensor>,
    settings: Settings,
}

impl Laid {
    fn out(scene: &Scene, points: &[Meter], watch: &Watch<'_>) -> Result<Self> {
        let probes = points.iter().map(Probe::new).collect::<Result<Vec<_>>>()?;
        let scene = under_even_sky(scene);
        let compiled = Arc::new(compile(&scene, watch.previous, watch.cancel)?);
        let (sensors, _) = placed(&compiled, &probes);
        Ok(Self { compiled, sensors, settings: unlimited(&scene.settings) })
    }
}

/// The scene with an even sky of 1 cd/m² for its only light; portals stay, which only tell where to look for it.
fn under_even_sky(scene: &Scene) -> Scene {
    let shape = LightShape::Dome { format: crate::scene::DomeFormat::default() };
    let emission = Emission { radiance: [1.0; 3], ..Emission::default() };
    let sky = Light { emission, ..Light::new(Origin::new("sky"), shape, Transform::default()) };
    let lights = std::iter::once(sky).chain(scene.lights.iter().filter(|light| light.portal).cloned()).collect();
    Scene { lights, ..scene.without_emission() }
}

/// What is traced how.
struct Tracing<'a> {
    scene: &'a Arc<CompiledScene>,
    sensors: &'a [Sensor],
    settings: &'a Settings,
    execution: Execution,
    task: &'a SkyTask<'a>,
}

/// How far workers are, and whether they are to stop.
struct Work {
    done: AtomicU64,
    rays: AtomicU64,
    cancel: AtomicBool,
}

impl Work {
    fn new() -> Self {
        Self { done: AtomicU64::new(0), rays: AtomicU64::new(0), cancel: AtomicBool::new(false) }
    }

    /// Does so many pieces of work on threads of their own, each with a workspace, in any order.
    fn share_out(&self, tracing: &Tracing<'_>, pieces: usize, piece: impl Fn(usize, &mut Workspace) + Sync) -> Result<()> {
        let next = AtomicUsize::new(0);
        let run = || {
            let mut workspace = tracing.scene.workspaces.take();
            while let Some(number) = Some(next.fetch_add(1, Ordering::Relaxed)).filter(|number| *number < pieces && !self.is_cancelled()) {
                piece(number, &mut workspace);
            }
            workspace.deposits.sky = None;
            if !self.is_cancelled() {
                tracing.scene.workspaces.leave(workspace);
            }
        };
        std::thread::scope(|scope| {
            let helpers: Vec<_> = (1..workers(tracing.settings.threads)).map_while(|_| start(scope, run)).collect();
            run();
            helpers.into_iter().try_for_each(|helper| helper.join().map_err(failed))
        })?;
        if self.is_cancelled() { Err(Error::Cancelled) } else { Ok(()) }
    }

    fn is_cancelled(&self) -> bool {
        self.cancel.load(Ordering::Relaxed)
    }

    /// Does something on other threads while this one tells how far it is.
    fn watched<T: Send>(&self, total: u64, samples: u32, watch: &mut Watch<'_>, work: impl FnOnce() -> Result<T> + Send) -> Result<T> {
        let start = Instant::now();
        std::thread::scope(|scope| {
            let working = scope.spawn(work);
            while !working.is_finished() {
                std::thread::sleep(TELL_EVERY.min(start.elapsed() / 4 + Duration::from_millis(1)));
                let fraction = self.done.load(Ordering::Relaxed) as f64 / total.max(1) as f64;
                let elapsed = start.elapsed();
                let remaining = (fraction > 0.0).then(|| elapsed.mul_f64((1.0 - fraction).max(0.0) / fraction));
                let done = (fraction * f64::from(samples)) as u32;
                let rays = self.rays.load(Ordering::Relaxed);
                let progress = Progress { fraction, samples: done, samples_total: samples, elapsed, remaining, rays };
                if watch.cancel.load(Ordering::Relaxed) || !(watch.progress)(&progress) {
                    self.cancel.store(true, Ordering::Relaxed);
                }
            }
            working.join().unwrap_or_else(|panic| Err(failed(panic)))
        })
    }
}

fn failed(panic: Box<dyn Any + Send>) -> Error {
    Error::Internal(panic_message(&*panic))
}
