//! One view of a compiled scene: camera, filter, window and transport, which change without compiling anything.

use super::CompiledScene;
use crate::{
    camera::CameraTable,
    error::{Error, Result},
    film::FilterTable,
    integrator::Transport,
    scene::{Aov, Camera, Crop, Integrator, Projection, Settings},
};
use gonio_simd::Execution;

/// What a render needs beside the scene.
#[derive(Clone, Debug)]
pub struct View {
    /// Ray generation.
    pub camera: CameraTable,
    /// Pixel filter.
    pub filter: FilterTable,
    /// Light transport.
    pub transport: Transport,
    /// Factor on the colour pass.
    pub exposure: f32,
    /// The part of the image that is rendered.
    pub window: Crop,
}

/// Largest image side.
const MOST_PIXELS: u32 = 65_536;

impl View {
    /// Checks the settings and lays the view out.
    pub fn new(scene: &CompiledScene, settings: &Settings, execution: Execution) -> Result<Self> {
        let window = window(settings)?;
        if settings.samples == 0 || settings.time_limit_s.is_nan() || settings.time_limit_s < 0.0 {
            let problem =
                format!("{} samples and a limit of {} s, expected 1 or more and 0 or more", settings.samples, settings.time_limit_s);
            return Err(Error::Setting { name: "samples".into(), problem });
        }
        let camera = scene.cameras.get(settings.camera as usize).ok_or_else(|| Error::Setting {
            name: "camera".into(),
            problem: format!("the scene has {} cameras, number {} was asked for", scene.cameras.len(), settings.camera),
        })?;
        if !camera.transform.is_finite() {
            return Err(Error::scene(&camera.origin, "the camera's transform is not finite"));
        }
        let table = camera_table(camera, settings, scene.tables.origin)?;
        let transport = Transport {
            execution,
            max_bounces: if settings.integrator == Integrator::Direct { 0 } else { settings.max_bounces },
            kind_bounces: settings.kind_bounces.map(|bounces| bounces.min(255)),
            shows_surroundings: !settings.film_transparent,
            measure: settings.aovs.contains(&Aov::Illuminance),
            clamps: [settings.clamp_direct, settings.clamp_indirect],
            eye: table.position,
            forward: table.axes[2].map(|x| -x),
            seed: settings.seed,
            samples: settings.samples,
        };
        let filter = FilterTable::new(settings.filter, settings.filter_width.clamp(0.0, 16.0));
        Ok(Self { camera: table, filter, transport, exposure: camera.exposure.0, window })
    }
}

fn window(settings: &Settings) -> Result<Crop> {
    let [width, height] = settings.resolution;
    if width == 0 || height == 0 || width > MOST_PIXELS || height > MOST_PIXELS {
        return Err(Error::Setting {
            name: "resolution".into(),
            problem: format!("{width} x {height} pixels, expected 1 to {MOST_PIXELS} each way"),
        });
    }
    let whole = Crop { min: [0, 0], max: settings.resolution };
    let Some(crop) = settings.crop else { return Ok(whole) };
    let crop = Crop { min: crop.min, max: [crop.max[0].min(width), crop.max[1].min(height)] };
    if crop.min[0] >= crop.max[0] || crop.min[1] >= crop.max[1] {
        return Err(Error::Setting { name: "crop".into(), problem: "the cropped window holds no pixel".into() });
    }
    Ok(crop)
}

fn camera_table(camera: &Camera, settings: &Settings, origin: [f64; 3]) -> Result<CameraTable> {
    let columns = camera.transform.columns;
    let orthographic = matches!(camera.projection, Projection::Orthographic);
    let unit = |v: [f64; 3]| {
        let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
        v.map(|x| x / length)
    };
    let axes = [columns[0], columns[1], columns[2]].map(unit);
    let plane = match camera.projection {
        Projection::Perspective { focal_length } => 1.0 / focal_length,
        Projection::Orthographic => 1.0,
    };
    let size = camera.aperture.map(|a| a * plane);
    let shift = camera.aperture_offset.map(|a| a * plane);
    let [width, height] = settings.resolution.map(f64::from);
    let usable = size.iter().chain(&shift).chain(axes.iter().flatten()).all(|x| x.is_finite()) && size.iter().all(|x| *x > 0.0);
    if !usable {
        return Err(Error::scene(&camera.origin, "the camera's aperture, focal length or axes are not usable (zero or not finite)"));
    }
    let position: [f32; 3] = std::array::from_fn(|i| (columns[3][i] - origin[i]) as f32);
    Ok(CameraTable {
        axes: axes.map(|axis| axis.map(|x| x as f32)),
        position,
        corner: [(shift[0] - 0.5 * size[0]) as f32, (shift[1] + 0.5 * size[1]) as f32],
        pixel: [(size[0] / width) as f32, (size[1] / height) as f32],
        orthographic,
        lens_radius: camera.lens_radius.max(0.0) as f32,
        focus_distance: if camera.focus_distance > 0.0 { camera.focus_distance as f32 } else { 1.0 },
        clipping: [camera.clipping[0].max(0.0) as f32, camera.clipping[1].min(f64::from(f32::MAX)) as f32],
    })
}
