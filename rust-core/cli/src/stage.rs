//! The door by which commands read what they are given: USD stages, honeybee's models, Radiance's scenes and IFC models.

use super::{
    ifc::{IfcStage, is_ifc},
    messages::say,
};
use gonio::map::FaceTable;
use gonio::scene::{HAZE_ANISOTROPY, Material, Medium, Origin, Transform, VISIBILITY_CONTRAST};
use gonio::{Error, Result, Severity};
use gonio_models::{DEFAULT_SKY_LUX, Model, Options, add_default_sky};
use gonio_usd::{CameraInfo, Loaded, LuminaireFile, SampleTime, StageInfo, StageOptions, context::UpAxis, volume::Flows};
use pyo3::Python;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use std::time::Duration;

/// What was opened.
pub(super) enum Stage {
    Usd(Box<gonio_usd::Stage>),
    Ifc(Box<IfcStage>),
    Model(Box<OpenModel>),
}

/// A model, which has one time.
pub(super) struct OpenModel {
    path: PathBuf,
    loaded: Loaded,
}

impl Stage {
    /// Opens a file by its ending; `states` are those of dynamic groups, `GROUP=N`.
    ///
    /// # Errors
    /// The file cannot be read, or an option is for files of another kind.
    pub(super) fn open(py: Python<'_>, path: &Path, states: &[String], options: &StageOptions) -> Result<Self> {
        let states = states.iter().map(|text| state(text)).collect::<Result<Vec<_>>>()?;
        if gonio_models::is_model(path) {
            refuse_usd_options(path, options)?;
            let model = py.detach(|| gonio_models::read(path, &Options { states }))?;
            return Ok(Self::Model(Box::new(OpenModel { path: path.into(), loaded: loaded(model) })));
        }
        match states.first() {
            Some((group, _)) => Err(Error::setting("state", format!("'{group}' was found; dynamic groups are those of honeybee's models"))),
            None if is_ifc(path) => IfcStage::open(py, path, options).map(|stage| Self::Ifc(Box::new(stage))),
            None => gonio_usd::Stage::open(py, path, options).map(|stage| Self::Usd(Box::new(stage))),
        }
    }

    /// What it says about itself.
    pub(super) fn info(&self) -> &StageInfo {
        match self {
            Self::Usd(stage) => stage.info(),
            Self::Ifc(model) => model.stage.info(),
            Self::Model(model) => &model.loaded.info,
        }
    }

    /// Reads it at a time.
    ///
    /// # Errors
    /// As [`gonio_usd::Stage::load`].
    pub(super) fn load(&self, py: Python<'_>, options: &StageOptions, cancel: &AtomicBool) -> Result<Loaded> {
        match self {
            Self::Usd(stage) => stage.load(py, options, cancel),
            Self::Ifc(model) => model.load(py, options, cancel),
            Self::Model(model) => model.load(options),
        }
    }

    /// The USD stage that an option is for.
    ///
    /// # Errors
    /// It is none.
    pub(super) fn usd(&self, option: &str) -> Result<&gonio_usd::Stage> {
        match self {
            Self::Usd(stage) => Ok(stage),
            // A layer over it would outlive it.
            Self::Ifc(model) if option == "output" => Err(for_usd(option, model.path())),
            Self::Ifc(model) => Ok(&model.stage),
            Self::Model(model) => Err(for_usd(option, &model.path)),
        }
    }

    /// Whether a file is one that it is made of.
    ///
    /// # Errors
    /// As [`gonio_usd::Stage::is_made_of`].
    pub(super) fn is_made_of(&self, py: Python<'_>, file: &Path) -> Result<bool> {
        match self {
            Self::Usd(stage) => stage.is_made_of(py, file),
            Self::Ifc(model) => model.stage.is_made_of(py, file),
            Self::Model(_) => Ok(false),
        }
    }

    /// As [`gonio_usd::Stage::placed`].
    ///
    /// # Errors
    /// As there, and that it is no USD stage.
    pub(super) fn placed(&self, py: Python<'_>, prim: &str, time: SampleTime, option: &str) -> Result<Transform> {
        self.usd(option)?.placed(py, prim, time, option)
    }

    /// Faces of a mesh as the stage has them.
    pub(super) fn faces(&self, py: Python<'_>, prim: &str, frame: Option<f64>) -> Option<FaceTable> {
        match self {
            Self::Usd(stage) => stage.faces(py, prim, frame),
            Self::Ifc(model) => model.stage.faces(py, prim, frame),
            Self::Model(_) => None,
        }
    }
}

impl OpenModel {
    fn load(&self, options: &StageOptions) -> Result<Loaded> {
        if matches!(options.time, SampleTime::Code(_)) {
            return Err(for_usd("frame", &self.path));
        }
        let mut loaded = self.loaded.clone();
        if let Some(worst) = loaded.diagnostics.iter().find(|found| options.strict && found.severity == Severity::Warning) {
            return Err(Error::scene(&worst.origin, format!("{} (warnings are errors)", worst.message)));
        }
        if let Some(visibility) = options.haze {
            let extinction = Medium::extinction_of(visibility, VISIBILITY_CONTRAST);
            loaded.scene.atmosphere = Medium::haze(extinction, [1.0; 3], HAZE_ANISOTROPY);
        }
        let shapes = loaded.scene.lights.iter_mut().filter(|light| !light.shape.is_at_infinity());
        shapes.for_each(|light| light.visibility.camera &= !options.hide_lights);
        loaded.scene.settings.spectral |= options.spectral;
        Ok(loaded)
    }
}

/// Whether a file is a model of a building, which need not have light of its own: honeybee's, Radiance's or IFC's.
pub(super) fn is_model(path: &Path) -> bool {
    gonio_models::is_model(path) || is_ifc(path)
}

/// Lights a model that has no light by the overcast sky, and says so; stages stay as they are.
pub(super) fn light_model(path: &Path, loaded: &mut Loaded, is_quiet: bool) {
    let scene = &mut loaded.scene;
    if !is_model(path) || !scene.lights.is_empty() || scene.materials.iter().any(Material::shines) {
        return;
    }
    add_default_sky(scene);
    if !is_quiet {
        say(&format!("there is no light; the CIE's overcast sky of {DEFAULT_SKY_LUX} lx lights it (--sun gives sun and sky)"));
    }
}

/// A model as commands have stages.
fn loaded(model: Model) -> Loaded {
    let cameras: Vec<CameraInfo> = model.scene.cameras.iter().map(|camera| camera.origin.name.to_string()).map(camera_info).collect();
    let info = StageInfo {
        up_axis: UpAxis::Z,
        metres_per_unit: model.metres_per_unit,
        time_codes_per_second: 24.0,
        default_camera: cameras.first().map(|camera| camera.path.clone()),
        cameras,
        prim_counts: model.counts,
        ..StageInfo::default()
    };
    let luminaires = model.luminaires.into_iter().map(|found| LuminaireFile::new(found.name, found.photometry, found.goniogram)).collect();
    Loaded {
        scene: model.scene,
        diagnostics: model.diagnostics,
        info,
        settings: None,
        waited_for_meshes: Duration::ZERO,
        kept_shapes: 0,
        luminaires,
        flows: Flows::default(),
    }
}

fn camera_info(name: String) -> CameraInfo {
    CameraInfo { path: name.clone(), name }
}

/// A group and its state.
fn state(text: &str) -> Result<(String, usize)> {
    let parsed = text.rsplit_once('=').and_then(|(group, number)| Some((group.to_owned(), number.parse().ok()?)));
    parsed.ok_or_else(|| Error::setting("state", format!("'{text}' was found, expected GROUP=N with N from 0")))
}

fn for_usd(option: &str, path: &Path) -> Error {
    let what = Origin::new(path.file_name().unwrap_or_default().to_string_lossy());
    Error::setting(option, format!("it is for USD stages; {what} is a model without prims, variants and frames"))
}

/// Refuses what only USD stages have.
fn refuse_usd_options(path: &Path, options: &StageOptions) -> Result<()> {
    let asked = [
        ("mask", !options.population_mask.is_empty()),
        ("variant", !options.variants.is_empty()),
        ("session-layer", options.session_layer.is_some()),
        ("settings", options.render_settings.is_some()),
        ("render-pass", options.render_pass.is_some()),
        ("prim", options.subtree.is_some()),
    ];
    asked.iter().find(|(_, is_asked)| *is_asked).map_or(Ok(()), |(option, _)| Err(for_usd(option, path)))
}
