//! Daylight coefficients: what light each patch of an even sky brings to points, and each sun straight from its place.
//!
//! Paths start at the points. What escapes is added to the patch that it came from, so that one pass serves all skies (Tregenza and Waters 1983). What
//! nothing scatters comes by shadow rays instead, spread evenly over each patch. Rounds have seeds of their own: they are independent estimates, of whose
//! products with skies standard errors are made.

mod kept;
mod openings;
mod rounds;
mod straight;
mod work;

pub use kept::{Keeping, Kept, Round};
pub use openings::is_of;

use super::{
    sense::{Probe, placed},
    sensing::unlimited,
    watch::Watch,
};
use crate::{
    compile::{CompiledScene, compile, light_paths_measure, transport},
    error::{Diagnostic, Error, Result},
    light::LightTexture,
    scene::{Emission, Light, LightShape, Measurand, Meter, Origin, Scene, Settings, Transform},
    transport::{Openings, Sensor, Transport},
};
use gonio_simd::Execution;
use std::{
    f32::consts::{PI, TAU},
    sync::Arc,
};
use work::Work;

/// Pixels of the picture of how bright patches are: the finest have five and more.
const BRIGHTNESS: [usize; 2] = [256, 128];
/// Independent estimates.
pub const ROUNDS: usize = 16;

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
    /// How bright a patch is beside others, in the hours that coefficients are for: paths look there more often.
    pub brightness: &'a (dyn Fn(usize) -> f64 + Sync),
    /// Centres of suns' discs.
    pub suns: &'a [[f64; 3]],
    /// Radians under which their discs are seen.
    pub sun_angle: f64,
    /// The zenith: what is below the horizon shines on nothing.
    pub up: [f64; 3],
    /// Groups of prims, with all below them. Light is told apart by the group of the first that it goes through, seen from the point; that which goes
    /// through none comes first. Without groups it is all together.
    pub openings: &'a [Vec<String>],
}

impl SkyTask<'_> {
    /// Parts that light is told apart in.
    pub fn parts(&self) -> usize {
        if self.openings.is_empty() { 1 } else { self.openings.len() + 1 }
    }
}

/// What light each patch and each sun brings: lx for 1 cd/m². Points are rows; where openings tell light apart, all points for each part, one after the other.
#[derive(Clone, Debug, Default)]
pub struct DaylightCoefficients {
    /// All light, by round: points × patches.
    pub all: Vec<Vec<f32>>,
    /// The part that anything scattered on its way: glass that light goes straight through does not.
    pub scattered: Vec<Vec<f32>>,
    /// Straight from the suns' discs: points × suns.
    pub suns: Vec<f32>,
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

/// Finds what is asked for and not there yet of the coefficients of points that lie on planes, with the scene's settings: `samples` paths a point. Its lamps
/// are dark, its skies and suns give way to the patches. Tells what differs from what was asked for.
///
/// # Errors
/// Points that measure anything but illuminance and luminance, what compiling finds, cancellation.
pub fn trace_rounds(
    scene: &Scene,
    points: &[Meter],
    task: &SkyTask<'_>,
    execution: Execution,
    watch: &mut Watch<'_>,
    keeping: &mut Keeping<'_>,
) -> Result<Vec<Diagnostic>> {
    let is_known = |of: Measurand| matches!(of, Measurand::Illuminance | Measurand::Luminance);
    if let Some(other) = points.iter().find(|point| !is_known(point.measurand)) {
        let problem = format!("daylight coefficients are of illuminances and luminances, {} was asked for", other.measurand.name());
        return Err(Error::scene(&other.origin, problem));
    }
    let laid = Laid::out(scene, points, task, watch)?;
    let mut diagnostics = laid.compiled.diagnostics.clone();
    if let (true, Some(first)) = (light_paths_measure::bends_light(&laid.compiled), points.first()) {
        diagnostics.push(Diagnostic::warning(&first.origin, BY_PATCHES));
    }
    let tracing = laid.tracing(task, execution);
    let work = Work::new();
    let total = keeping.batches(&tracing);
    work.watched(total, tracing.settings.samples, watch, || keeping.trace(&tracing, &work))?;
    Ok(diagnostics)
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
    let nothing = |_: usize| 0.0;
    let (solid_angle, brightness) = (&nothing, &nothing);
    let task = SkyTask { patches: 0, patch_of: &|_| 0, place: &|_, _| None, solid_angle, brightness, suns, sun_angle, up, openings: &[] };
    let laid = Laid::out(scene, points, &task, watch)?;
    let tracing = laid.tracing(&task, execution);
    let work = Work::new();
    let found = work.watched(straight::batches_of_suns(&tracing), 1, watch, || straight::suns(&tracing, &work))?;
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
    openings: Option<Arc<Openings>>,
}

impl Laid {
    fn out(scene: &Scene, points: &[Meter], task: &SkyTask<'_>, watch: &Watch<'_>) -> Result<Self> {
        let probes = points.iter().map(Probe::new).collect::<Result<Vec<_>>>()?;
        let scene = under_even_sky(scene);
        let mut compiled = compile(&scene, watch.previous, watch.cancel)?;
        if task.patches > 0 {
            Arc::make_mut(&mut compiled.tables.lights).look_at_dome_by(0, &brightness(task));
        }
        let compiled = Arc::new(compiled);
        let (sensors, _) = placed(&compiled, &probes);
        let openings = openings::openings(&scene, &compiled, task.openings);
        Ok(Self { compiled, sensors, settings: unlimited(&scene.settings), openings })
    }

    fn tracing<'a>(&'a self, task: &'a SkyTask<'a>, execution: Execution) -> Tracing<'a> {
        let Self { compiled: scene, sensors, settings, openings } = self;
        Tracing { scene, sensors, settings, execution, task, openings: openings.as_ref() }
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

/// A picture of how bright the patches are.
fn brightness(task: &SkyTask<'_>) -> LightTexture {
    let [width, height] = BRIGHTNESS;
    let value = |pixel: usize| {
        let (across, down) = ((pixel % width) as f32 + 0.5, (pixel / width) as f32 + 0.5);
        let (sine, cosine) = (PI * down / height as f32).sin_cos();
        let (sin_longitude, cos_longitude) = (TAU * (0.5 - across / width as f32)).sin_cos();
        (task.brightness)((task.patch_of)([sine * sin_longitude, cosine, sine * cos_longitude])) as f32
    };
    LightTexture { width, height, rgb: (0..width * height).flat_map(|pixel| [value(pixel); 3]).collect() }
}

/// What is traced how.
struct Tracing<'a> {
    scene: &'a Arc<CompiledScene>,
    sensors: &'a [Sensor],
    settings: &'a Settings,
    execution: Execution,
    task: &'a SkyTask<'a>,
    openings: Option<&'a Arc<Openings>>,
}

impl Tracing<'_> {
    /// How light is followed: with the openings that it comes through, and with no expressions, which would be noted in their place.
    fn transport(&self) -> Transport {
        let mut transport = transport(self.scene, self.settings, self.execution, [0.0; 3], [0.0; 3]);
        (transport.passes.openings, transport.passes.expressions) = (self.openings.cloned(), None);
        transport
    }

    /// Rows: all points for each part that light is told apart in.
    fn rows(&self) -> usize {
        self.task.parts() * self.sensors.len()
    }
}
