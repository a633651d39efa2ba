//! Opening stages and reading them into scenes.

mod clips;
mod dimmed;
mod faces;
mod grid;
mod info;
mod multiplied;
mod open;
mod placed;
mod problem;

pub use info::{CameraInfo, StageInfo};

use crate::context::Context;
use crate::kept::Kept;
use crate::luminaire_file::LuminaireFile;
use crate::options::{SampleTime, StageOptions};
use crate::prim::Prim;
use crate::pxr::{Module, Trap};
use crate::render_settings::RenderSettings;
use crate::settings;
use crate::traverse::Walker;
use crate::volume::{self, Flows, GridCache};
use crate::watch::Reading;
use crate::{material, motion, place, pxr, render_pass, skeleton};
use gonio::scene::{HAZE_ANISOTROPY, Medium, Scene, VISIBILITY_CONTRAST};
use gonio::{Diagnostic, Error, Result, Severity};
use info::read_info;
use open::{Prepared, check_file, open_prepared};
use problem::{composition_errors, counted, passed_on, unreadable};
use pyo3::prelude::*;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// A stage as a scene.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// What is to be rendered.
    pub scene: Scene,
    /// What is not as the stage asked for; composition errors among it.
    pub diagnostics: Vec<Diagnostic>,
    /// What the stage says about itself.
    pub info: StageInfo,
    /// What the stage's RenderSettings prim says; [`crate::view::complete`] follows it.
    pub settings: Option<RenderSettings>,
    /// How much of the reading was waiting for meshes to be built, which goes on beside it.
    pub waited_for_meshes: Duration,
    /// How many meshes, curves and points were taken over from the last reading.
    pub kept_shapes: usize,
    /// The IES and EULUMDAT files that its lights name.
    pub luminaires: Vec<LuminaireFile>,
    /// Fields of the scene that have velocities.
    pub flows: Flows,
}

/// An open stage; it can be read at many times.
#[derive(Debug)]
pub struct Stage {
    path: PathBuf,
    object: Py<PyAny>,
    /// Where skinned points are written, cleared for each reading.
    baked: Py<PyAny>,
    info: StageInfo,
    diagnostics: Vec<Diagnostic>,
    /// Layers that stand in for MaterialX documents for as long as the stage is open.
    documents: Option<material::Substitution>,
    /// Instances that show what another is skinned to.
    alike: Arc<skeleton::Alike>,
    /// What the last reading left.
    kept: Mutex<Option<Kept>>,
    /// The grids of volumes that the last reading used.
    grids: Mutex<GridCache>,
}

/// Opens a stage and reads it: [`Stage::open`], then [`Stage::load`].
///
/// # Errors
/// As those.
pub fn load_stage(py: Python<'_>, path: &Path, options: &StageOptions, cancel: &AtomicBool) -> Result<Loaded> {
    Stage::open(py, path, options)?.load(py, options, cancel)
}

impl Stage {
    /// Opens the stage. Population mask, variants, session layer and payloads are fixed here; time, purposes and complexity at [`Stage::load`].
    ///
    /// # Errors
    /// The file is missing or broken, or an option names what the stage does not have: one line with the place.
    pub fn open(py: Python<'_>, path: &Path, options: &StageOptions) -> Result<Self> {
        pxr::ensure(py)?;
        check_file(path)?;
        let _reading = Reading::start(py);
        let trap = Trap::set(py);
        let mut diagnostics = Vec::new();
        let opened = open_prepared(py, path, options, &mut diagnostics);
        let mut messages = trap.release();
        let Prepared { stage, baked, documents, alike } = opened?;
        if let Some(documents) = &documents {
            messages.retain(|message| !documents.explains(message));
        }
        let mut info = read_info(&stage, path, &mut diagnostics).map_err(|error| unreadable(py, path, &error))?;
        info.composition_errors = composition_errors(&stage, path);
        diagnostics.extend(counted(&info.composition_errors));
        diagnostics.extend(passed_on(messages, &info.composition_errors, path));
        Ok(Self {
            path: path.to_owned(),
            object: stage.unbind(),
            baked: baked.unbind(),
            info,
            diagnostics,
            documents,
            alike,
            kept: Mutex::default(),
            grids: Mutex::default(),
        })
    }

    /// What the stage says about itself.
    pub fn info(&self) -> &StageInfo {
        &self.info
    }

    /// The file it was opened from.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The `Usd.TimeCode` of a time.
    pub(crate) fn time<'py>(&self, py: Python<'py>, time: SampleTime) -> Result<Bound<'py, PyAny>> {
        time_code(py, self.info.time_range, time).map_err(|error| unreadable(py, &self.path, &error))
    }

    /// The `Usd.Stage`.
    pub fn object<'py>(&self, py: Python<'py>) -> &Bound<'py, PyAny> {
        self.object.bind(py)
    }

    /// Whether a file is a layer that the stage is made of.
    ///
    /// # Errors
    /// Exceptions of the USD library.
    pub fn is_made_of(&self, py: Python<'_>, file: &Path) -> Result<bool> {
        let Ok(file) = file.canonicalize() else { return Ok(false) };
        let is_one = || -> PyResult<bool> {
            for layer in self.object(py).call_method0("GetUsedLayers")?.try_iter()? {
                let path: String = layer?.getattr("realPath")?.extract()?;
                if Path::new(&path).canonicalize().is_ok_and(|path| path == file) {
                    return Ok(true);
                }
            }
            Ok(false)
        };
        is_one().map_err(|error| unreadable(py, &self.path, &error))
    }

    /// Reads the stage at a time. `cancel` is looked at once a prim and inside subdivision.
    ///
    /// # Errors
    /// Cancellation, settings that do not exist, a stage with more instances than 2²⁵, photometric files that cannot be read unless `lenient` is
    /// set, and with `strict` any warning.
    pub fn load(&self, py: Python<'_>, options: &StageOptions, cancel: &AtomicBool) -> Result<Loaded> {
        let _reading = Reading::start(py);
        let trap = Trap::set(py);
        let result = self.read(py, options, cancel).and_then(|loaded| self.blurred(py, options, cancel, loaded));
        let messages = trap.release();
        if !options.kept {
            self.forget();
        }
        let mut loaded = result?;
        let mut all = self.diagnostics.clone();
        all.append(&mut loaded.diagnostics);
        all.extend(passed_on(messages, &[], &self.path));
        if options.strict
            && let Some(worst) = all.iter().find(|diagnostic| diagnostic.severity == Severity::Warning)
        {
            let count = all.iter().filter(|diagnostic| diagnostic.severity == Severity::Warning).count();
            return Err(Error::scene(&worst.origin, format!("{} ({count} warnings, and warnings are errors)", worst.message)));
        }
        Ok(Loaded { diagnostics: all, ..loaded })
    }

    /// What was read, with how it moves while the shutter of its camera is open.
    /// Where nothing is blurred and motion vectors are asked for, with where it is at the frames before and after.
    fn blurred(&self, py: Python<'_>, options: &StageOptions, cancel: &AtomicBool, mut loaded: Loaded) -> Result<Loaded> {
        let asked = options.with_settings(loaded.settings.as_ref());
        let shutter = if asked.disable_motion_blur { Ok(None) } else { self.shutter(py, options, &loaded) };
        let mut shutter = shutter.map_err(|error| unreadable(py, &self.path, &error))?;
        if shutter.is_none() && asked.motion_vectors {
            loaded.scene.settings.shutter.blur = false;
            let time = self.time(py, options.time)?;
            shutter = motion::neighbours(self.object.bind(py), &time).map_err(|error| unreadable(py, &self.path, &error))?;
        }
        let Some(shutter) = shutter else { return Ok(loaded) };
        let mut keys = Vec::new();
        for time in shutter.times() {
            let at_key = StageOptions { time: SampleTime::Code(time), kept: true, ..options.clone() };
            keys.push(self.read(py, &at_key, cancel)?.scene);
        }
        loaded.diagnostics.extend(motion::put(&mut loaded.scene, &keys));
        if loaded.scene.settings.shutter.blur && !loaded.flows.is_empty() {
            let exposure = shutter.exposure(self.info.time_codes_per_second);
            loaded.diagnostics.extend(volume::put_flows(py, &mut loaded.scene, &loaded.flows, exposure));
        }
        Ok(loaded)
    }

    fn shutter(&self, py: Python<'_>, options: &StageOptions, Loaded { scene, flows, .. }: &Loaded) -> PyResult<Option<motion::Shutter>> {
        let Some(camera) = scene.cameras.get(scene.settings.camera as usize) else { return Ok(None) };
        let time = time_code(py, self.info.time_range, options.time)?;
        let stage = self.object.bind(py);
        let prim = Prim::new(stage.call_method1("GetPrimAtPath", (&*camera.origin.name,))?);
        if !time.call_method0("IsNumeric")?.is_truthy()? || !prim.is_valid() {
            return Ok(None);
        }
        motion::shutter(stage, &prim, time.call_method0("GetValue")?.extract()?, !flows.is_empty())
    }

    fn take_kept(&self) -> Option<Kept> {
        self.kept.lock().unwrap_or_else(PoisonError::into_inner).take()
    }

    fn keep(&self, kept: Kept) {
        *self.kept.lock().unwrap_or_else(PoisonError::into_inner) = Some(kept);
    }

    /// Lets go of what readings left.
    fn forget(&self) {
        drop(self.take_kept());
        drop(self.take_grids());
    }

    fn take_grids(&self) -> GridCache {
        std::mem::take(&mut *self.grids.lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// What a reading gives by itself: without what opening the stage told, and what `pxr` says.
    fn read(&self, py: Python<'_>, options: &StageOptions, cancel: &AtomicBool) -> Result<Loaded> {
        let unreadable = |error: PyErr| unreadable(py, &self.path, &error);
        if self.info.has_skeletons {
            let _ = self.baked.bind(py).call_method0("Clear").map_err(unreadable)?;
        }
        let time = time_code(py, self.info.time_range, options.time).map_err(unreadable)?;
        // What is shown depends on the settings, so they are read in a context of their own.
        let mut first = Context::new(self.object.bind(py).clone(), time.clone(), options, cancel);
        let pass = options.render_pass.as_deref().map(|path| render_pass::read(&mut first, path)).transpose()?.unwrap_or_default();
        let of_settings = options.render_settings.as_deref().or(pass.source.as_deref());
        let settings = settings::render_settings(&mut first, of_settings)?;
        let (_, mut diagnostics) = first.finish();
        let options = options.with_settings(settings.as_ref());
        let mut context = Context::new(self.object.bind(py).clone(), time, &options, cancel);
        let last = self.take_kept();
        if options.kept {
            context.kept = Kept::for_reading(last, &options, &self.info.skeleton_roots);
        }
        context.metres_per_unit = self.info.metres_per_unit;
        context.up_axis = self.info.up_axis;
        context.roles = pass.roles;
        context.alike = self.alike.clone();
        context.grids = self.take_grids().next();
        context.material_definitions = self.documents.as_ref().map(|documents| documents.definitions().to_vec()).unwrap_or_default();
        if self.info.has_skeletons {
            skeleton::bake(&mut context);
        }
        let walker = Walker::new(&mut context).map_err(unreadable)?;
        let (world, failed) = walker.world()?;
        place::place_world(&mut context, &world, failed)?;
        context.check_refused()?;
        let kept_shapes = context.kept.shapes;
        if options.kept {
            self.keep(std::mem::take(&mut context.kept));
        }
        // The keys of a shutter use them again.
        *self.grids.lock().unwrap_or_else(PoisonError::into_inner) = std::mem::take(&mut context.grids);
        let mut info = self.info.clone();
        info.prim_counts = context.prim_counts.iter().map(|(name, count)| (name.clone(), *count)).collect();
        let luminaires = std::mem::take(&mut context.luminaires);
        let (waited_for_meshes, flows) = (context.waited_for_meshes, std::mem::take(&mut context.flows));
        let (mut scene, of_world) = context.finish();
        diagnostics.extend(of_world);
        if let Some(visibility) = options.haze {
            let extinction = Medium::extinction_of(visibility, VISIBILITY_CONTRAST);
            scene.atmosphere = Medium::haze(extinction, [1.0; 3], HAZE_ANISOTROPY);
        }
        let wanted = settings.as_ref().and_then(|settings| settings.framing.camera.clone()).or_else(|| info.default_camera.clone());
        let camera = wanted.and_then(|path| scene.cameras.iter().position(|camera| *camera.origin.name == *path));
        scene.settings.camera = camera.unwrap_or(0) as u32;
        scene.settings.spectral = options.spectral;
        Ok(Loaded { scene, diagnostics, info, settings, waited_for_meshes, kept_shapes, luminaires, flows })
    }
}

fn time_code<'py>(py: Python<'py>, range: Option<[f64; 2]>, time: SampleTime) -> PyResult<Bound<'py, PyAny>> {
    let class = Module::Usd.item(py, "TimeCode")?;
    match (time, range) {
        (SampleTime::Code(code), _) => class.call1((code,)),
        (SampleTime::Default, _) => class.call_method0("Default"),
        (SampleTime::Start, Some([start, _])) => class.call1((start,)),
        // Without a range, attributes may still have samples and no default.
        (SampleTime::Start, None) => class.call_method0("EarliestTime"),
    }
}
