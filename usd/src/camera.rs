//! UsdGeom cameras: apertures and focal lengths in tenths of a unit, the rest in units, exposure as a factor on the picture.

use crate::context::Context;
use crate::prim::Prim;
use crate::pxr::Module;
use gonio::scene::{Camera, CameraExposure, Origin, Projection, Transform};
use gonio::{Error, Result};
use pyo3::{intern, prelude::*};

/// Units in the unit of focal lengths and apertures.
const UNITS_PER_TENTH: f64 = 0.1;
/// The focal length of the schema, for those that no lens can have.
const DEFAULT_FOCAL_LENGTH: f64 = 50.0;
/// The apertures of the schema.
const DEFAULT_APERTURE: [f64; 2] = [20.955, 15.2908];

/// The camera at a prim; `transform` takes its local space to metres.
pub fn camera<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, transform: &Transform) -> Camera {
    let origin = prim.origin();
    let metres = context.metres_per_unit;
    let focal_length = positive(context, prim, "focalLength", DEFAULT_FOCAL_LENGTH);
    let mut aperture = [
        positive(context, prim, "horizontalAperture", DEFAULT_APERTURE[0]),
        positive(context, prim, "verticalAperture", DEFAULT_APERTURE[1]),
    ];
    let mut aperture_offset = ["horizontalApertureOffset", "verticalApertureOffset"].map(|name| finite(context, prim, name, 0.0));
    let is_orthographic = context.get::<String>(prim, "projection").is_some_and(|projection| projection == "orthographic");
    let projection = if let Some(fov_deg) = context.get_authored::<f64>(prim, "gonio:fisheye") {
        Projection::FisheyeEquidistant { fov_deg }
    } else if is_orthographic {
        let scale = UNITS_PER_TENTH * metres;
        aperture = aperture.map(|x| x * scale);
        aperture_offset = aperture_offset.map(|x| x * scale);
        Projection::Orthographic
    } else {
        Projection::Perspective { focal_length }
    };
    let (lens_radius, focus_distance) = lens(context, prim, focal_length);
    let [near, far] = context.get::<[f64; 2]>(prim, "clippingRange").unwrap_or([1.0, 1e6]);
    let planes: Vec<[f32; 4]> = context.get_authored(prim, "clippingPlanes").unwrap_or_default();
    Camera {
        projection,
        aperture,
        aperture_offset,
        lens_radius,
        focus_distance,
        clipping_planes: planes.iter().map(|plane| plane.map(f64::from)).map(|[a, b, c, d]| [a, b, c, d * metres]).collect(),
        clipping: clipping(context, &origin, [near * metres, far * metres]),
        transform: *transform,
        exposure: CameraExposure(exposure(context, prim)),
        origin,
        ..Camera::default()
    }
}

fn finite<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, name: &str, default: f64) -> f64 {
    context.get::<f64>(prim, name).filter(|x| x.is_finite()).unwrap_or(default)
}

fn positive<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, name: &str, default: f64) -> f64 {
    let found = context.get::<f64>(prim, name).unwrap_or(default);
    if found.is_finite() && found > 0.0 {
        return found;
    }
    context.warn(&prim.origin(), format!("{name} is {found}, expected a length above 0; {default} is used"));
    default
}

fn clipping(context: &mut Context<'_, '_>, origin: &Origin, [near, far]: [f64; 2]) -> [f64; 2] {
    if near >= 0.0 && far > near {
        return [near, far];
    }
    context.warn(origin, format!("the clipping range is [{near}, {far}] metres, expected 0 <= near < far; nothing is clipped"));
    [0.0, f64::MAX]
}

/// Radius of the lens and distance of focus in metres; a lens needs both an f-number and a distance.
fn lens<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, focal_length: f64) -> (f64, f64) {
    let f_number = finite(context, prim, "fStop", 0.0);
    let focus_distance = finite(context, prim, "focusDistance", 0.0) * context.metres_per_unit;
    if f_number <= 0.0 {
        return (0.0, if focus_distance > 0.0 { focus_distance } else { 1.0 });
    }
    if focus_distance <= 0.0 {
        context.warn(&prim.origin(), format!("fStop is {f_number} but focusDistance is not above 0; everything is sharp"));
        return (0.0, 1.0);
    }
    (0.5 * focal_length * UNITS_PER_TENTH * context.metres_per_unit / f_number, focus_distance)
}

/// The largest exposure scale: it shows starlight in full daylight's place, and leaves colours within single precision.
const MOST_EXPOSURE: f32 = 1e8;

/// The camera's linear exposure scale; versions of the package without it know `exposure` alone.
fn exposure<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> f32 {
    if !prim.has_authored("exposure") && !prim.has_authored_prefix("exposure:") {
        return 1.0;
    }
    let py = context.py;
    let time = context.time.clone();
    let computed = || -> PyResult<Option<f32>> {
        let camera = Module::UsdGeom.wrap("Camera", prim.object())?;
        match camera.getattr_opt(intern!(py, "ComputeLinearExposureScale"))? {
            Some(function) => function.call1((time,))?.extract().map(Some),
            None => Ok(None),
        }
    };
    let scale = context.attempt(&prim.origin(), "the exposure cannot be evaluated", computed()).flatten();
    let scale = scale.unwrap_or_else(|| context.get::<f32>(prim, "exposure").unwrap_or(0.0).exp2());
    if (0.0..=MOST_EXPOSURE).contains(&scale) {
        return scale;
    }
    let held = if scale > MOST_EXPOSURE { MOST_EXPOSURE } else { 1.0 };
    context.warn(&prim.origin(), format!("the exposure scale is {scale}, expected a number from 0 to {MOST_EXPOSURE:e}; {held:e} is used"));
    held
}

/// The name that USD gives the main one of a stage's cameras; empty where there are no two to choose from.
pub fn primary_camera_name(py: Python<'_>, cameras: usize) -> String {
    // The module takes a while to import.
    if cameras < 2 {
        return String::new();
    }
    let name = || -> PyResult<String> { Module::UsdUtils.item(py, "GetPrimaryCameraName")?.call0()?.extract() };
    name().unwrap_or_else(|_| "main_cam".to_owned())
}

/// Which of the cameras is looked through: the `wanted` one (path or name), else that of the render settings, else the one called `primary`,
/// else the first. `None` where there is no camera and none is wanted.
///
/// # Errors
/// The wanted camera does not exist; the message lists those that do.
pub fn choose(cameras: &[Camera], wanted: Option<&str>, of_settings: Option<&str>, primary: &str) -> Result<Option<u32>> {
    let position = |name: &str| {
        let by_path = cameras.iter().position(|camera| &*camera.origin.name == name);
        let by_name = || cameras.iter().position(|camera| camera.origin.name.rsplit('/').next() == Some(name));
        by_path.or_else(by_name).and_then(|index| u32::try_from(index).ok())
    };
    if let Some(wanted) = wanted {
        return position(wanted).map(Some).ok_or_else(|| {
            let known: Vec<&str> = cameras.iter().map(|camera| &*camera.origin.name).collect();
            let known =
                if known.is_empty() { "the stage has no cameras".to_owned() } else { format!("the stage has {}", known.join(", ")) };
            Error::Setting { name: "camera".into(), problem: format!("there is no camera '{wanted}'; {known}") }
        });
    }
    Ok(of_settings.and_then(position).or_else(|| position(primary)).or(if cameras.is_empty() { None } else { Some(0) }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cameras_are_chosen_by_path_name_settings_and_convention() {
        let camera = |name: &str| Camera::perspective(Origin::new(name), Transform::IDENTITY, 40.0, 1.0);
        let cameras = [camera("/a/left"), camera("/a/main_cam"), camera("/b/right")];
        let chosen = |wanted, settings| choose(&cameras, wanted, settings, "main_cam").expect("exists");
        assert_eq!(chosen(Some("/b/right"), Some("/a/left")), Some(2));
        assert_eq!(chosen(Some("left"), None), Some(0));
        assert_eq!(chosen(None, Some("/b/right")), Some(2));
        assert_eq!(chosen(None, None), Some(1));
        assert_eq!(choose(&cameras[..1], None, None, "main_cam").expect("first"), Some(0));
        assert_eq!(choose(&[], None, None, "main_cam").expect("none"), None);
        let error = choose(&cameras, Some("nope"), None, "main_cam").expect_err("unknown").to_string();
        assert!(error.contains("'nope'") && error.contains("/b/right"), "{error}");
    }
}
