//! Opening stages and reading them into scenes.

use crate::context::{Context, UpAxis};
use crate::goniogram::LuminaireFile;
use crate::memory_limit::MemoryLimit;
use crate::options::{SampleTime, StageOptions};
use crate::prim::Prim;
use crate::pxr::{self, Module, Trap};
use crate::settings::{self, RenderSettings};
use crate::traverse::Walker;
use crate::{material, nesting, place, skeleton};
use gonio::scene::{Origin, Scene};
use gonio::{Diagnostic, Error, Result, Severity};
use pyo3::prelude::*;
use pyo3::types::PyList;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Metres in a unit where a stage does not say.
const FALLBACK_METRES_PER_UNIT: f64 = 0.01;
/// Most messages of `pxr` that are passed on.
const MAX_PXR_MESSAGES: usize = 50;

/// A camera of a stage.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CameraInfo {
    /// The prim's name.
    pub name: String,
    /// The prim's path.
    pub path: String,
}

/// What a stage says about itself.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StageInfo {
    /// The vertical axis.
    pub up_axis: UpAxis,
    /// Metres in a unit.
    pub metres_per_unit: f64,
    /// First and last time code, where authored.
    pub time_range: Option<[f64; 2]>,
    /// Time codes a second.
    pub time_codes_per_second: f64,
    /// The path of the camera to take where none is named: `main_cam`, or the first.
    pub default_camera: Option<String>,
    /// All cameras outside prototypes.
    pub cameras: Vec<CameraInfo>,
    /// Prims read, by type; filled by [`Stage::load`].
    pub prim_counts: BTreeMap<String, usize>,
    /// What could not be composed: missing references, cycles.
    pub composition_errors: Vec<Diagnostic>,
}

/// A stage as a scene.
#[derive(Debug)]
pub struct Loaded {
    /// What is to be rendered.
    pub scene: Scene,
    /// What is not as the stage asked for; composition errors among it.
    pub diagnostics: Vec<Diagnostic>,
    /// What the stage says about itself.
    pub info: StageInfo,
    /// What the stage's RenderSettings prim says; applied to the scene already.
    pub settings: Option<RenderSettings>,
    /// The IES and EULUMDAT files that its lights name.
    pub luminaires: Vec<LuminaireFile>,
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
    _documents: Option<material::Substitution>,
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
        let trap = Trap::set(py);
        let mut diagnostics = Vec::new();
        let opened = open_prepared(py, path, options, &mut diagnostics);
        let messages = trap.release();
        let Prepared { stage, baked, documents } = opened?;
        let mut info = read_info(&stage, path, &mut diagnostics).map_err(|error| unreadable(py, path, &error))?;
        info.composition_errors = composition_errors(&stage, path);
        diagnostics.extend(info.composition_errors.iter().cloned());
        diagnostics.extend(passed_on(messages, &info.composition_errors, path));
        Ok(Self { path: path.to_owned(), object: stage.unbind(), baked: baked.unbind(), info, diagnostics, _documents: documents })
    }

    /// What the stage says about itself.
    pub fn info(&self) -> &StageInfo {
        &self.info
    }

    /// The file it was opened from.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The `Usd.Stage`.
    pub fn object<'py>(&self, py: Python<'py>) -> &Bound<'py, PyAny> {
        self.object.bind(py)
    }

    /// Makes a prim a calculation grid, in the session layer; lengths are spacing, margin and height in metres.
    ///
    /// # Errors
    /// There is no such prim, or its attributes cannot be written.
    pub fn author_grid(&self, py: Python<'_>, prim: &str, quantity: &str, lengths: [f64; 3]) -> Result<()> {
        let problem = |text: String| Error::Setting { name: "grid".into(), problem: text };
        let author = || -> PyResult<bool> {
            let stage = self.object.bind(py);
            let found = Prim::new(stage.call_method1("GetPrimAtPath", (prim,))?);
            if !found.is_valid() {
                return Ok(false);
            }
            let types = Module::Sdf.item(py, "ValueTypeNames")?;
            let set = |name: &str, kind: &str, value: Bound<'_, PyAny>| -> PyResult<()> {
                let attribute = found.object().call_method1("CreateAttribute", (format!("gonio:grid:{name}"), types.getattr(kind)?))?;
                attribute.call_method1("Set", (value,)).map(drop)
            };
            set("quantity", "Token", quantity.into_pyobject(py)?.into_any())?;
            for (name, length) in ["spacing", "margin", "height"].into_iter().zip(lengths) {
                set(name, "Double", (length / self.info.metres_per_unit).into_pyobject(py)?.into_any())?;
            }
            Ok(true)
        };
        // Opinions go where a reading does not clear them.
        let stage = self.object.bind(py);
        let edit = |layer: Bound<'_, PyAny>| stage.call_method1("SetEditTarget", (layer,)).map(drop);
        let target = |name: &str| stage.call_method0(name);
        let written = target("GetSessionLayer").and_then(edit).and_then(|()| author());
        let restored = edit(self.baked.bind(py).clone().into_any());
        match written.and_then(|found| restored.map(|()| found)) {
            Ok(true) => Ok(()),
            Ok(false) => Err(problem(format!("there is no prim {prim}"))),
            Err(error) => Err(problem(pxr::message_of(py, &error))),
        }
    }

    /// Reads the stage at a time. `cancel` is looked at once a prim and inside subdivision.
    ///
    /// # Errors
    /// Cancellation, settings that do not exist, a stage with more instances than 2²⁵, and with `strict` any warning.
    pub fn load(&self, py: Python<'_>, options: &StageOptions, cancel: &AtomicBool) -> Result<Loaded> {
        let trap = Trap::set(py);
        let result = self.read(py, options, cancel);
        let messages = trap.release();
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

    /// What a reading gives by itself: without what opening the stage told, and what `pxr` says.
    fn read(&self, py: Python<'_>, options: &StageOptions, cancel: &AtomicBool) -> Result<Loaded> {
        let unreadable = |error: PyErr| unreadable(py, &self.path, &error);
        let _ = self.baked.bind(py).call_method0("Clear").map_err(unreadable)?;
        let time = time_code(py, self.info.time_range, options.time).map_err(unreadable)?;
        // What is shown depends on the settings, so they are read in a context of their own.
        let mut first = Context::new(self.object.bind(py).clone(), time.clone(), options, cancel);
        let settings = settings::render_settings(&mut first, options.render_settings.as_deref())?;
        let (_, mut diagnostics) = first.finish();
        let options = options.with_settings(settings.as_ref());
        let mut context = Context::new(self.object.bind(py).clone(), time, &options, cancel);
        context.metres_per_unit = self.info.metres_per_unit;
        context.up_axis = self.info.up_axis;
        let walker = Walker::new(&mut context).map_err(unreadable)?;
        let (world, failed) = walker.world()?;
        place::place_world(&mut context, &world, failed)?;
        if let Some(settings) = &settings {
            settings.apply(&mut context.scene);
        }
        let mut info = self.info.clone();
        info.prim_counts = context.prim_counts.iter().map(|(name, count)| (name.clone(), *count)).collect();
        let luminaires = std::mem::take(&mut context.luminaires);
        let (mut scene, of_world) = context.finish();
        diagnostics.extend(of_world);
        let wanted = settings.as_ref().and_then(|settings| settings.camera.clone()).or_else(|| info.default_camera.clone());
        let camera = wanted.and_then(|path| scene.cameras.iter().position(|camera| *camera.origin.name == *path));
        scene.settings.camera = camera.unwrap_or(0) as u32;
        Ok(Loaded { scene, diagnostics, info, settings, luminaires })
    }
}

/// What can be said about the file without `pxr`.
fn check_file(path: &Path) -> Result<()> {
    let text = path.to_string_lossy();
    // Addresses of other asset systems, and files inside packages, are the resolver's business.
    if text.contains("://") || text.ends_with(']') {
        return Ok(());
    }
    let metadata = std::fs::metadata(path).map_err(|error| Error::io(path, error))?;
    if metadata.is_dir() {
        return Err(format_error(path, "a folder was found, expected a USD file"));
    }
    let extension = path.extension().map(|extension| extension.to_string_lossy().to_lowercase()).unwrap_or_default();
    if !matches!(extension.as_str(), "usd" | "usda" | "usdc" | "usdz") {
        return Err(format_error(path, format!("the file's ending is '{extension}', expected usd, usda, usdc or usdz")));
    }
    if metadata.len() == 0 {
        return Err(format_error(path, "the file is empty"));
    }
    match nesting::too_deep_at(path) {
        Some(line) => {
            Err(Error::Format { path: path.to_owned(), line: Some(line), problem: "brackets are nested too deep to be read".into() })
        }
        None => Ok(()),
    }
}

fn format_error(path: &Path, problem: impl Into<String>) -> Error {
    Error::Format { path: path.to_owned(), line: None, problem: problem.into() }
}

/// An exception of `pxr` about a layer, with the place in the file where it has one.
fn unreadable(py: Python<'_>, path: &Path, error: &PyErr) -> Error {
    let message = pxr::message_of(py, error);
    match pxr::place_in(&message) {
        Some(place) => Error::Format {
            path: place.file.into(),
            line: Some(place.line),
            problem: format!("column {}: {}", place.column, place.problem),
        },
        None if message.starts_with("Failed to open layer") => format_error(path, "the file cannot be read as a USD layer"),
        None => format_error(path, message),
    }
}

/// A stage with its layer for skinned points.
struct Prepared<'py> {
    stage: Bound<'py, PyAny>,
    baked: Bound<'py, PyAny>,
    documents: Option<material::Substitution>,
}

/// The stage with variants chosen and skeletons' instances taken apart, and the layer for skinned points, which is the edit target.
fn open_prepared<'py>(py: Python<'py>, path: &Path, options: &StageOptions, diagnostics: &mut Vec<Diagnostic>) -> Result<Prepared<'py>> {
    let unreadable = |error: PyErr| unreadable(py, path, &error);
    let anonymous = |name: &str| Module::Sdf.item(py, "Layer")?.call_method1("CreateAnonymous", (name,));
    let session = anonymous("session.usda").map_err(unreadable)?;
    let baked = anonymous("skinned.usda").map_err(unreadable)?;
    let add = || session.getattr("subLayerPaths")?.call_method1("append", (baked.getattr("identifier")?,));
    add().map_err(unreadable)?;
    let stage = open_layers(py, path, options, &session)?;
    select_variants(&stage, options)?;
    let documents = material::substitute_documents(&stage, diagnostics);
    let apart = skeleton::take_instances_apart(&stage).map_err(unreadable)?;
    if let Some(first) = apart.first() {
        diagnostics.push(Diagnostic::info(first, format!("{} instances hold skeletons and are read one by one", apart.len())));
    }
    stage.call_method1("SetEditTarget", (&baked,)).map_err(unreadable)?;
    Ok(Prepared { stage, baked, documents })
}

/// The stage, with the session layer as the edit target.
fn open_layers<'py>(py: Python<'py>, path: &Path, options: &StageOptions, session: &Bound<'py, PyAny>) -> Result<Bound<'py, PyAny>> {
    let _limit = MemoryLimit::new(py);
    let root = find_layer(py, path)?;
    if let Some(layer) = &options.session_layer {
        check_file(layer)?;
        let found = find_layer(py, layer)?;
        let add = || session.getattr("subLayerPaths")?.call_method1("append", (found.getattr("identifier")?,));
        add().map_err(|error| unreadable(py, layer, &error))?;
    }
    let mask = population_mask(py, options)?;
    let open = || -> PyResult<Bound<'py, PyAny>> {
        let class = Module::Usd.item(py, "Stage")?;
        let load = class.getattr(if options.load_payloads { "LoadAll" } else { "LoadNone" })?;
        let stage = match mask {
            Some(mask) => class.call_method1("OpenMasked", (&root, session, mask, load))?,
            None => class.call_method1("Open", (&root, session, load))?,
        };
        stage.call_method1("SetEditTarget", (session,))?;
        Ok(stage)
    };
    open().map_err(|error| unreadable(py, path, &error))
}

fn find_layer<'py>(py: Python<'py>, path: &Path) -> Result<Bound<'py, PyAny>> {
    let find = || Module::Sdf.item(py, "Layer")?.call_method1("FindOrOpen", (path.to_string_lossy().as_ref(),));
    let layer = find().map_err(|error| unreadable(py, path, &error))?;
    if layer.is_none() { Err(format_error(path, "the file cannot be read as a USD layer")) } else { Ok(layer) }
}

fn population_mask<'py>(py: Python<'py>, options: &StageOptions) -> Result<Option<Bound<'py, PyAny>>> {
    if options.population_mask.is_empty() {
        return Ok(None);
    }
    let failed = |problem: String| Error::Setting { name: "mask".into(), problem };
    for path in &options.population_mask {
        let is_valid = Module::Sdf.item(py, "Path").and_then(|class| class.call_method1("IsValidPathString", (path,))?.is_truthy());
        if !path.starts_with('/') || !is_valid.unwrap_or(false) {
            return Err(failed(format!("'{path}' was found, expected a prim path such as /World/Chair")));
        }
    }
    let mask = || Module::Usd.item(py, "StagePopulationMask")?.call1((PyList::new(py, &options.population_mask)?,));
    mask().map(Some).map_err(|error| failed(pxr::message_of(py, &error)))
}

fn select_variants(stage: &Bound<'_, PyAny>, options: &StageOptions) -> Result<()> {
    let py = stage.py();
    for selection in &options.variants {
        let failed = |problem: String| Error::Setting { name: "variant".into(), problem };
        let names = || -> PyResult<Option<Vec<String>>> {
            let prim = Prim::new(stage.call_method1("GetPrimAtPath", (&selection.prim,))?);
            if !prim.is_valid() {
                return Ok(None);
            }
            let set = prim.object().call_method1("GetVariantSet", (&selection.set,))?;
            let names: Vec<String> = set.call_method0("GetVariantNames")?.extract()?;
            if names.contains(&selection.variant) {
                set.call_method1("SetVariantSelection", (&selection.variant,))?;
            }
            Ok(Some(names))
        };
        match names().map_err(|error| failed(pxr::message_of(py, &error)))? {
            None => return Err(failed(format!("there is no prim {}", selection.prim))),
            Some(names) if names.is_empty() => return Err(failed(format!("{} has no variant set '{}'", selection.prim, selection.set))),
            Some(names) if !names.contains(&selection.variant) => {
                let (prim, set, variant) = (&selection.prim, &selection.set, &selection.variant);
                return Err(failed(format!("{prim}{{{set}}} has no variant '{variant}'; it has {}", names.join(", "))));
            }
            Some(_) => {}
        }
    }
    Ok(())
}

fn read_info(stage: &Bound<'_, PyAny>, path: &Path, diagnostics: &mut Vec<Diagnostic>) -> PyResult<StageInfo> {
    let geom = Module::UsdGeom.import(stage.py())?;
    let origin = file_origin(path);
    let mut warn = |message: String| diagnostics.push(Diagnostic::warning(&origin, message));
    let axis: String = geom.call_method1("GetStageUpAxis", (stage,))?.extract()?;
    if axis != "Y" && axis != "Z" {
        warn(format!("upAxis is '{axis}', expected Y or Z; Y is used"));
    }
    let mut metres_per_unit: f64 = geom.call_method1("GetStageMetersPerUnit", (stage,))?.extract()?;
    if !(metres_per_unit > 0.0 && metres_per_unit.is_finite()) {
        warn(format!("metersPerUnit is {metres_per_unit}, expected a number above 0; {FALLBACK_METRES_PER_UNIT} is used"));
        metres_per_unit = FALLBACK_METRES_PER_UNIT;
    }
    let mut time_codes_per_second: f64 = stage.call_method0("GetTimeCodesPerSecond")?.extract()?;
    if !(time_codes_per_second > 0.0 && time_codes_per_second.is_finite()) {
        warn(format!("timeCodesPerSecond is {time_codes_per_second}, expected a number above 0; 24 is used"));
        time_codes_per_second = 24.0;
    }
    let mut time_range = None;
    if stage.call_method0("HasAuthoredTimeCodeRange")?.is_truthy()? {
        let range: [f64; 2] = [stage.call_method0("GetStartTimeCode")?.extract()?, stage.call_method0("GetEndTimeCode")?.extract()?];
        if range.iter().all(|code| code.is_finite()) && range[0] <= range[1] {
            time_range = Some(range);
        } else {
            warn(format!(
                "the time range is {} to {}, expected a finite one that begins before it ends; it is ignored",
                range[0], range[1]
            ));
        }
    }
    let cameras = cameras(stage)?;
    let primary: String = Module::UsdUtils.import(stage.py())?.call_method0("GetPrimaryCameraName")?.extract()?;
    let default_camera = cameras.iter().find(|camera| camera.name == primary).or(cameras.first()).map(|camera| camera.path.clone());
    Ok(StageInfo {
        up_axis: if axis == "Z" { UpAxis::Z } else { UpAxis::Y },
        metres_per_unit,
        time_range,
        time_codes_per_second,
        default_camera,
        cameras,
        ..StageInfo::default()
    })
}

fn cameras(stage: &Bound<'_, PyAny>) -> PyResult<Vec<CameraInfo>> {
    let class = Module::UsdGeom.item(stage.py(), "Camera")?;
    let mut cameras = Vec::new();
    for prim in stage.call_method0("Traverse")?.try_iter()? {
        let prim = Prim::new(prim?);
        if prim.is_a(&class) {
            cameras.push(CameraInfo { name: prim.name(), path: prim.path() });
        }
    }
    Ok(cameras)
}

fn file_origin(path: &Path) -> Origin {
    Origin { name: Arc::from(""), file: Arc::from(path.to_string_lossy().as_ref()) }
}

fn composition_errors(stage: &Bound<'_, PyAny>, path: &Path) -> Vec<Diagnostic> {
    let py = stage.py();
    let list = stage.call_method0("GetCompositionErrors").and_then(|list| list.try_iter()?.collect::<PyResult<Vec<_>>>());
    let text = |error: Bound<'_, PyAny>| match error.str().and_then(|text| text.extract::<String>()) {
        Ok(text) => pxr::one_line(&text),
        Err(problem) => pxr::message_of(py, &problem),
    };
    let origin = file_origin(path);
    list.unwrap_or_default().into_iter().map(|error| Diagnostic::warning(&origin, text(error))).collect()
}

/// Messages of `pxr` that say something new.
fn passed_on(messages: Vec<String>, known: &[Diagnostic], path: &Path) -> Vec<Diagnostic> {
    let origin = file_origin(path);
    let mut passed: Vec<Diagnostic> = Vec::new();
    for message in messages {
        let is_known = known.iter().any(|diagnostic| message.contains(diagnostic.message.as_str()));
        if !is_known && !passed.iter().any(|earlier| earlier.message == message) && passed.len() < MAX_PXR_MESSAGES {
            passed.push(Diagnostic::info(&origin, message));
        }
    }
    passed
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
