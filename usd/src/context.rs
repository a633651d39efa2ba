//! What a stage's reader carries along: the scene under construction, what is to be reported, caches, and the time.

use crate::kept::Kept;
use crate::luminaire_file::LuminaireFile;
use crate::material::{Library, Shaded, VolumeShading};
use crate::options::StageOptions;
use crate::prim::{Attribute, Prim};
use crate::pxr;
use crate::roles::Roles;
use crate::volume::{Flows, GridCache};
use crate::vt::FromValue;
use gonio::scene::{Goniogram, MaterialId, MeasuredId, Origin, Scene, TextureId};
use gonio::{Diagnostic, Error, Result};
use pyo3::prelude::*;
use std::collections::HashMap;
use std::rc::Rc;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// The stage's vertical axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum UpAxis {
    /// +Y.
    #[default]
    Y,
    /// +Z.
    Z,
}

/// How often something was met that is reported once.
#[derive(Debug)]
struct Tally {
    diagnostic: usize,
    count: usize,
}

/// Everything that reading a stage needs at hand.
pub struct Context<'a, 'py> {
    /// The interpreter.
    pub py: Python<'py>,
    /// The `Usd.Stage`.
    pub stage: Bound<'py, PyAny>,
    /// The `Usd.TimeCode` at which attributes are read.
    pub time: Bound<'py, PyAny>,
    /// What is read, and how.
    pub options: &'a StageOptions,
    /// The scene so far; its transforms are in metres, its up axis is the stage's.
    pub scene: Scene,
    /// What prims are in the render pass.
    pub roles: Roles<'py>,
    /// Instances that show what another is skinned to, see [`crate::skeleton::Alike`].
    pub alike: Arc<HashMap<String, String>>,
    /// Metres in a unit of the stage; all transforms handed on contain it already.
    pub metres_per_unit: f64,
    /// The stage's vertical axis.
    pub up_axis: UpAxis,
    /// Materials by the path of their prim; `None` for those that could not be read.
    pub material_ids: HashMap<String, Option<MaterialId>>,
    /// Names of primvars whose text materials have asked for, by the path of the material.
    pub asked_of_prims: HashMap<String, Vec<String>>,
    /// The prim that the material under way is for.
    pub shaded: Shaded<'py>,
    /// What materials say of volumes, by the path of their prim; `None` for those that say nothing.
    pub(crate) volume_shadings: HashMap<String, Option<Rc<VolumeShading>>>,
    /// Grids of volumes.
    pub(crate) grids: GridCache,
    /// Fields of the scene that have velocities.
    pub(crate) flows: Flows,
    /// Textures by a key of the material reader's choice.
    pub texture_ids: HashMap<String, TextureId>,
    /// What MaterialX documents of the stage define for themselves.
    pub material_definitions: Vec<Arc<Library>>,
    /// Measured BSDFs by the path of their file; `None` for those that could not be read.
    pub measured_ids: HashMap<String, Option<MeasuredId>>,
    /// Goniograms by a key of their reader's choice; `None` for those that could not be read.
    pub goniograms: HashMap<String, Option<Arc<Goniogram>>>,
    /// The files that goniograms were read from, in the order of their reading.
    pub luminaires: Vec<LuminaireFile>,
    /// Time that reading has waited for meshes to be built.
    pub waited_for_meshes: Duration,
    /// Prims met, by type.
    pub prim_counts: HashMap<String, usize>,
    /// What other readings of the stage left.
    pub(crate) kept: Kept,
    told: usize,
    diagnostics: Vec<Diagnostic>,
    refused: Option<Error>,
    tallies: HashMap<(&'static str, String), Tally>,
    cancel: &'a AtomicBool,
}

impl std::fmt::Debug for Context<'_, '_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Context").field("stage", &self.stage).field("time", &self.time).finish_non_exhaustive()
    }
}

impl<'a, 'py> Context<'a, 'py> {
    /// For an open stage at a time.
    pub fn new(stage: Bound<'py, PyAny>, time: Bound<'py, PyAny>, options: &'a StageOptions, cancel: &'a AtomicBool) -> Self {
        Self {
            py: stage.py(),
            stage,
            time,
            options,
            scene: Scene::default(),
            roles: Roles::default(),
            alike: Arc::default(),
            metres_per_unit: 0.01,
            up_axis: UpAxis::Y,
            material_ids: HashMap::new(),
            asked_of_prims: HashMap::new(),
            shaded: Shaded::default(),
            volume_shadings: HashMap::new(),
            grids: GridCache::default(),
            flows: Flows::default(),
            texture_ids: HashMap::new(),
            material_definitions: Vec::new(),
            measured_ids: HashMap::new(),
            goniograms: HashMap::new(),
            luminaires: Vec::new(),
            waited_for_meshes: Duration::ZERO,
            prim_counts: HashMap::new(),
            kept: Kept::default(),
            told: 0,
            diagnostics: Vec::new(),
            refused: None,
            tallies: HashMap::new(),
            cancel,
        }
    }

    /// Fails when the caller asked to stop.
    ///
    /// # Errors
    /// [`Error::Cancelled`].
    pub fn check_cancel(&self) -> Result<()> {
        if self.cancel.load(Ordering::Relaxed) { Err(Error::Cancelled) } else { Ok(()) }
    }

    /// What the caller sets to stop.
    pub fn cancel_flag(&self) -> &'a AtomicBool {
        self.cancel
    }

    /// How much has been told; what is read without telling anything can be kept for other readings.
    pub(crate) fn told(&self) -> usize {
        self.told
    }

    /// Reports something that changes the picture.
    pub fn warn(&mut self, origin: &Origin, message: impl Into<String>) {
        self.told += 1;
        self.diagnostics.push(Diagnostic::warning(origin, message));
    }

    /// Reports something that ends the reading unless it is to be lenient: what is done `instead` is then a warning.
    pub fn refuse(&mut self, origin: &Origin, problem: &str, instead: &str) {
        self.told += 1;
        if self.options.lenient {
            self.warn(origin, format!("{problem}; {instead}"));
        } else if self.refused.is_none() {
            self.refused = Some(Error::scene(origin, format!("{problem}; with --lenient {instead}")));
        }
    }

    /// Fails where something was met that ends the reading.
    ///
    /// # Errors
    /// The first of what [`Context::refuse`] was told.
    pub fn check_refused(&mut self) -> Result<()> {
        self.refused.take().map_or(Ok(()), Err)
    }

    /// Reports something worth knowing.
    pub fn note(&mut self, origin: &Origin, message: impl Into<String>) {
        self.told += 1;
        self.diagnostics.push(Diagnostic::info(origin, message));
    }

    /// Reports a diagnostic.
    pub fn report(&mut self, diagnostic: Diagnostic) {
        self.told += 1;
        self.diagnostics.push(diagnostic);
    }

    /// Warns once for each `kind` and `name`, however often it is met; the message gets the number of places at the end.
    pub fn once(&mut self, kind: &'static str, name: &str, origin: &Origin, message: impl FnOnce() -> String) {
        self.told += 1;
        let next = self.diagnostics.len();
        let tally = self.tallies.entry((kind, name.to_owned())).or_insert(Tally { diagnostic: next, count: 0 });
        tally.count += 1;
        if tally.count == 1 {
            self.diagnostics.push(Diagnostic::warning(origin, message()));
        }
    }

    /// Says once for each `feature` that it is not supported.
    pub fn unsupported(&mut self, feature: &str, origin: &Origin) {
        self.once("unsupported", feature, origin, || format!("{feature} is not supported, it is left out"));
    }

    /// The value of a prim's attribute at the time, converted; `None` where there is no value. A value that cannot be read or is of another
    /// type is reported with the attribute's path.
    pub fn get<T: FromValue>(&mut self, prim: &Prim<'py>, name: &str) -> Option<T> {
        let attribute = prim.attribute(name)?;
        self.get_attribute(&attribute)
    }

    /// As [`Context::get`], without asking for the schema's fallback: `None` at once where nothing is authored.
    pub fn get_authored<T: FromValue>(&mut self, prim: &Prim<'py>, name: &str) -> Option<T> {
        if prim.has_authored(name) { self.get(prim, name) } else { None }
    }

    /// As [`Context::get`] with a value for where there is none.
    pub fn get_or<T: FromValue>(&mut self, prim: &Prim<'py>, name: &str, otherwise: T) -> T {
        self.get(prim, name).unwrap_or(otherwise)
    }

    /// Whether faces wind the other way: `orientation` is `leftHanded`.
    pub fn left_handed(&mut self, prim: &Prim<'py>) -> bool {
        self.get_authored::<String>(prim, "orientation").is_some_and(|orientation| orientation == "leftHanded")
    }

    /// The value of an attribute at the time, converted; see [`Context::get`].
    pub fn get_attribute<T: FromValue>(&mut self, attribute: &Attribute<'py>) -> Option<T> {
        let value = self.get_value(attribute)?;
        let converted = T::from_value(&value);
        if converted.is_none() {
            let found = value.get_type().name().map_or_else(|_| attribute.type_name(), |name| name.to_string());
            self.warn(&Origin::new(attribute.path()), format!("value of type {found}, expected {}; it is ignored", T::EXPECTED));
        }
        converted
    }

    /// The Python value of an attribute at the time; what `Get` raises is reported.
    pub fn get_value(&mut self, attribute: &Attribute<'py>) -> Option<Bound<'py, PyAny>> {
        match attribute.get(&self.time) {
            Ok(value) => value,
            Err(error) => {
                let message = pxr::message_of(self.py, &error);
                self.warn(&Origin::new(attribute.path()), format!("the value cannot be read: {message}"));
                None
            }
        }
    }

    /// The prim at a path.
    pub fn prim_at(&self, path: &str) -> Option<Prim<'py>> {
        let prim = Prim::new(self.stage.call_method1(pyo3::intern!(self.py, "GetPrimAtPath"), (path,)).ok()?);
        prim.is_valid().then_some(prim)
    }

    /// What a prim's relationship names; prims that are not there are told.
    pub fn targets(&mut self, prim: &Prim<'py>, relationship: &str) -> Vec<String> {
        let targets = prim.targets(relationship);
        let missing: Vec<&String> = targets.iter().filter(|path| !path.contains('.') && self.prim_at(path).is_none()).collect();
        for path in missing {
            let message = || format!("its {relationship} names <{path}>, which is not there");
            self.once("missing target", &format!("{relationship} {path}"), &prim.origin(), message);
        }
        targets
    }

    /// The shader that an output of a material leads to, if any; outputs that lead nowhere are told.
    pub fn connected(
        &mut self,
        material: &Prim<'py>,
        output: &str,
        found: PyResult<(Option<Prim<'py>>, Vec<String>)>,
    ) -> Option<Prim<'py>> {
        let origin = Origin::new(material.path());
        let (shader, dangling) = self.attempt(&origin, &format!("the material's {output} cannot be found"), found)?;
        for end in dangling.iter().filter(|_| shader.is_none()) {
            self.warn(&origin, format!("its {output} is connected to {end}"));
        }
        shader
    }

    /// `Some` of what a call into `pxr` gave, or a warning at `origin` that says what could not be done.
    pub fn attempt<T>(&mut self, origin: &Origin, what: &str, result: PyResult<T>) -> Option<T> {
        match result {
            Ok(value) => Some(value),
            Err(error) => {
                let message = pxr::message_of(self.py, &error);
                self.warn(origin, format!("{what}: {message}"));
                None
            }
        }
    }

    /// As [`Context::attempt`] with the prim as the place, whose path is asked for only where it is needed.
    pub fn attempt_at<T>(&mut self, prim: &Prim<'py>, what: &str, result: PyResult<T>) -> Option<T> {
        match result {
            Ok(value) => Some(value),
            error => self.attempt(&prim.origin(), what, error),
        }
    }

    /// The scene and the diagnostics, with the numbers of places written in.
    pub fn finish(mut self) -> (Scene, Vec<Diagnostic>) {
        for Tally { diagnostic, count } in self.tallies.values().filter(|tally| tally.count > 1) {
            self.diagnostics[*diagnostic].message.push_str(&format!(" ({count} places, this is the first)"));
        }
        (self.scene, self.diagnostics)
    }
}
