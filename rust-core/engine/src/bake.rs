//! Baking: pixels of a texture in place of a camera's. Each lies on a surface, and its paths start there; all passes of pictures may be asked for.

use crate::{
    accel::NONE,
    compile::{CompiledScene, is_diced, window},
    error::{Error, Result},
    render::Render,
    scene::{Antialiasing, Aov, Integrator, Projection, Scene, Settings},
    transport::{Place, PlaceTable, Viewpoint},
};
use gonio_simd::Execution;
use std::sync::Arc;

/// From where a texture's places are seen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ViewFrom {
    /// From right above each place, along the shading normal.
    #[default]
    Above,
    /// From the settings' camera. What faces away from it is seen as from its rim.
    Camera,
}

/// What is baked: a picture whose pixels lie on one instance.
#[derive(Clone, Debug, Default)]
pub struct BakeTarget {
    /// Number of the instances' element in the scene, and of the placement in it.
    pub instance: u32,
    /// See `instance`.
    pub placement: u32,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// The triangle of each pixel, rows from the top; [`NONE`] where nothing lies.
    pub triangles: Vec<u32>,
    /// Barycentric coordinates of corners 1 and 2 in the middle of each pixel.
    pub places: Vec<[f32; 2]>,
    /// How they change to the next column, and to the next row; empty for points without extent.
    pub steps: Vec<[[f32; 2]; 2]>,
    /// From where it is seen.
    pub view: ViewFrom,
}

/// Starts baking with the samples and passes of the settings, whose resolution does not matter.
///
/// # Errors
/// Targets whose numbers do not fit together or to the scene.
pub fn bake(scene: &Scene, compiled: Arc<CompiledScene>, target: &BakeTarget, settings: &Settings, execution: Execution) -> Result<Render> {
    let settings = Settings {
        resolution: target.size,
        crop: None,
        sample_range: None,
        tile_range: None,
        noise_threshold: 0.0,
        antialiasing: Antialiasing::Sampled,
        integrator: match settings.integrator {
            Integrator::Whitted | Integrator::Light => Integrator::Path,
            integrator => integrator,
        },
        ..settings.clone()
    };
    if settings.aovs.contains(&Aov::Deep) {
        return Err(Error::setting("deep", "what is baked has no depth"));
    }
    window(&settings)?;
    let instance = instance_of(scene, &compiled, target)?;
    let places = places(scene, target, instance)?;
    let viewpoint = viewpoint(&compiled, target.view, &settings)?;
    let measures = settings.aovs.contains(&Aov::Illuminance);
    let looks = !measures || settings.aovs.iter().any(|aov| *aov != Aov::Illuminance);
    let table = PlaceTable::new(target.size, &places, viewpoint, [looks, measures]);
    Render::at_places(compiled, table, &settings, execution)
}

/// The compiled instance that is baked.
fn instance_of(scene: &Scene, compiled: &CompiledScene, target: &BakeTarget) -> Result<u32> {
    let rows = &compiled.tables.geometry.instances[..compiled.tables.first_light_instance as usize];
    let found = rows.iter().position(|row| (row.set, row.number) == (target.instance, target.placement));
    found.map(|number| number as u32).ok_or_else(|| {
        let count = scene.instances.len();
        let problem =
            format!("number {} of placement {} was asked for, the scene shows none such among {count}", target.instance, target.placement);
        Error::setting("instance", problem)
    })
}

/// A place for each pixel that has one.
fn places(scene: &Scene, target: &BakeTarget, instance: u32) -> Result<Vec<Option<Place>>> {
    let count = target.size[0] as usize * target.size[1] as usize;
    let fits = |name: &str, found: usize| {
        let problem = || format!("there are {found} for {} x {} pixels", target.size[0], target.size[1]);
        if found == count { Ok(()) } else { Err(Error::setting(name, problem())) }
    };
    fits("triangles", target.triangles.len())?;
    fits("places", target.places.len())?;
    if !target.steps.is_empty() {
        fits("steps", target.steps.len())?;
    }
    let Some(mesh) = scene.instances[target.instance as usize].geometry.mesh().map(|mesh| &scene.meshes[mesh.index()]) else {
        return Err(Error::setting("instance", "curves and points have no triangles to bake".to_owned()));
    };
    if is_diced(scene, scene.instances[target.instance as usize].geometry) {
        return Err(Error::setting("instance", format!("'{}' is diced to pixels, and has no triangles to bake before", mesh.origin)));
    }
    if let Some(wrong) = target.triangles.iter().find(|triangle| **triangle != NONE && **triangle as usize >= mesh.triangles.len()) {
        let problem = format!("number {wrong} was found, '{}' has {}", mesh.origin, mesh.triangles.len());
        return Err(Error::setting("triangles", problem));
    }
    let place = |number: usize| {
        let (triangle, at) = (target.triangles[number], target.places[number]);
        let steps = target.steps.get(number).copied().unwrap_or_default();
        let known = triangle != NONE && at.iter().chain(steps.iter().flatten()).all(|x| x.is_finite());
        known.then_some(Place { instance, triangle, at, steps })
    };
    Ok((0..count).map(place).collect())
}

fn viewpoint(compiled: &CompiledScene, view: ViewFrom, settings: &Settings) -> Result<Viewpoint> {
    if view == ViewFrom::Above {
        return Ok(Viewpoint::Above);
    }
    let number = settings.camera;
    let camera = compiled.cameras.get(number as usize).filter(|camera| camera.transform.is_finite());
    let camera =
        camera.ok_or_else(|| Error::setting("camera", format!("there is none of number {number} that places could be seen from")))?;
    let [_, _, back, position] = camera.transform.columns;
    if matches!(camera.projection, Projection::Orthographic) {
        let length = back.iter().map(|x| x * x).sum::<f64>().sqrt();
        return Ok(Viewpoint::Direction(back.map(|x| (x / length) as f32)));
    }
    let origin = compiled.tables.origin;
    Ok(Viewpoint::Point([0, 1, 2].map(|k| (position[k] - origin[k]) as f32)))
}
