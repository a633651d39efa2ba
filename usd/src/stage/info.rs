//! What a stage says about itself.

use super::problem::file_origin;
use crate::camera::primary_camera_name;
use crate::context::UpAxis;
use crate::prim::Prim;
use crate::pxr::Module;
use crate::skeleton;
use gonio::Diagnostic;
use pyo3::prelude::*;
use std::collections::BTreeMap;
use std::path::Path;

/// Metres in a unit where a stage does not say.
const FALLBACK_METRES_PER_UNIT: f64 = 0.01;

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
    /// Whether meshes are skinned.
    pub has_skeletons: bool,
    /// Paths of the prims that hold skinned meshes, outside prototypes.
    pub skeleton_roots: Vec<String>,
    /// What could not be composed: missing references, cycles.
    pub composition_errors: Vec<Diagnostic>,
}

/// Asks the stage, and reports what it says wrongly.
pub(super) fn read_info(stage: &Bound<'_, PyAny>, path: &Path, diagnostics: &mut Vec<Diagnostic>) -> PyResult<StageInfo> {
    let geom = Module::UsdGeom.import(stage.py())?;
    let origin = file_origin(path);
    let mut warn = |message: String| diagnostics.push(Diagnostic::warning(&origin, message));
    let axis: String = geom.call_method1("GetStageUpAxis", (stage,))?.extract()?;
    if axis != "Y" && axis != "Z" {
        warn(format!("upAxis is '{axis}', expected Y or Z; Y is used"));
    }
    // Old exporters write a number of single precision there, for which the function of `pxr` fails.
    let told = geom.call_method1("GetStageMetersPerUnit", (stage,)).and_then(|metres| metres.extract());
    let mut metres_per_unit: f64 = told.or_else(|_: PyErr| stage.call_method1("GetMetadata", ("metersPerUnit",))?.extract())?;
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
    let (cameras, skeleton_roots) = survey(stage)?;
    let primary = primary_camera_name(stage.py(), cameras.len());
    let default_camera = cameras.iter().find(|camera| camera.name == primary).or(cameras.first()).map(|camera| camera.path.clone());
    Ok(StageInfo {
        up_axis: if axis == "Z" { UpAxis::Z } else { UpAxis::Y },
        metres_per_unit,
        time_range,
        time_codes_per_second,
        default_camera,
        cameras,
        has_skeletons: !skeleton_roots.is_empty(),
        skeleton_roots,
        ..StageInfo::default()
    })
}

/// The cameras, and the paths of the prims that hold skinned meshes.
fn survey(stage: &Bound<'_, PyAny>) -> PyResult<(Vec<CameraInfo>, Vec<String>)> {
    let camera = Module::UsdGeom.item(stage.py(), "Camera")?;
    let mut cameras = Vec::new();
    let mut skeleton_roots = Vec::new();
    for prim in stage.call_method0("Traverse")?.try_iter()? {
        let prim = Prim::new(prim?);
        match prim.type_name().as_str() {
            "" | "Xform" | "Scope" | "Mesh" => {}
            _ if prim.is_a(&camera) => cameras.push(CameraInfo { name: prim.name(), path: prim.path() }),
            _ if skeleton::is_root(&prim) => skeleton_roots.push(prim.path()),
            _ => {}
        }
    }
    Ok((cameras, skeleton_roots))
}
