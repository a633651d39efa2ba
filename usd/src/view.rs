//! What a picture needs beside the stage: which camera, how many pixels, light where there is none.

use crate::camera::choose;
use crate::context::UpAxis;
use crate::framing::{CAMERA_LIT_CLAMP, ConformPolicy, aperture_aspect, auto_camera, camera_light, dome_light};
use crate::render_settings::Framing;
use crate::settings::conform_cameras;
use crate::stage::Loaded;
use crate::{data_window, render_variable};
use gonio::compile::Bounds;
use gonio::scene::{Material, Origin};
use gonio::{Diagnostic, Error, Result};

/// Width of pictures where nothing says otherwise, as usdrecord has it.
const DEFAULT_WIDTH: u32 = 960;
/// Shape of pictures where there is no camera.
const DEFAULT_ASPECT: f64 = 16.0 / 9.0;

/// How many pixels a picture has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Resolution {
    /// The render settings' size, or a width of 960 with the camera's shape.
    #[default]
    Stage,
    /// This width, the height by the camera's shape.
    Width(u32),
    /// This width and height.
    Exact([u32; 2]),
}

/// The light of stages without any.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Headlight {
    /// One at the camera.
    #[default]
    Camera,
    /// An even sky.
    Dome,
}

/// What the caller wants of the view.
#[derive(Clone, Debug)]
pub struct ViewOptions {
    /// Camera by path or name; `None` leaves it to the stage.
    pub camera: Option<String>,
    /// Pixels.
    pub resolution: Resolution,
    /// Factor on both sides.
    pub scale: f64,
    /// Width of a pixel over its height; `None` leaves it to the stage.
    pub pixel_aspect: Option<f64>,
    /// Whether stages without light get one.
    pub camera_light: bool,
    /// Which light that is.
    pub headlight: Headlight,
    /// Whether the settings' data window counts; else the whole picture is rendered.
    pub data_window: bool,
    /// Which of the settings' products the picture is for; without it the passes of all are in one picture, framed as the first says.
    pub product: Option<usize>,
}

impl Default for ViewOptions {
    fn default() -> Self {
        Self {
            camera: None,
            resolution: Resolution::Stage,
            scale: 1.0,
            pixel_aspect: None,
            camera_light: true,
            headlight: Headlight::default(),
            data_window: true,
            product: None,
        }
    }
}

/// Chooses the camera and the size, adds what is missing, and makes the cameras fit the picture; gives notes on what was added.
///
/// # Errors
/// The camera does not exist, or the scale is not a number above zero.
pub fn complete(loaded: &mut Loaded, primary_camera: &str, options: &ViewOptions) -> Result<Vec<Diagnostic>> {
    let mut notes = Vec::new();
    let product = options.product.and_then(|number| loaded.settings.as_ref()?.products.get(number));
    let framing = product.map(|product| &product.framing).or(loaded.settings.as_ref().map(|settings| &settings.framing)).cloned();
    let variables = match (product, &loaded.settings) {
        (Some(product), _) => product.variables.clone(),
        (None, settings) => settings.as_ref().map(|settings| settings.variables()).unwrap_or_default(),
    };
    if let Some(framing) = &framing {
        framing.apply(&mut loaded.scene);
    }
    render_variable::ask_for_passes(&mut loaded.scene.settings, &variables);
    let of_settings = framing.as_ref().and_then(|framing| framing.camera.clone());
    let chosen = choose(&loaded.scene.cameras, options.camera.as_deref(), of_settings.as_deref(), primary_camera)?;
    loaded.scene.settings.camera = chosen.unwrap_or(0);
    set_resolution(loaded, options)?;
    let note = |message: &str| Diagnostic::info(&Origin::new("stage"), message);
    let scene = &mut loaded.scene;
    if scene.instances.is_empty() && scene.lights.is_empty() {
        notes.push(note("nothing of it can be seen: there are no surfaces and no lights among what is read"));
    }
    if scene.cameras.is_empty() {
        notes.push(note("there is no camera; one that sees everything is used"));
        let Bounds { min, max } = Bounds::of_scene(scene);
        let [width, height] = scene.settings.resolution.map(f64::from);
        scene.cameras.push(auto_camera(
            [min, max],
            loaded.info.up_axis == UpAxis::Z,
            width * scene.settings.pixel_aspect / height.max(1.0),
        ));
    }
    if scene.lights.is_empty() && options.camera_light && !scene.materials.iter().any(|material| material.shines() || glows(material)) {
        let (light, words) = match options.headlight {
            Headlight::Camera => (camera_light(&scene.cameras[scene.settings.camera as usize]), "one at the camera"),
            Headlight::Dome => (dome_light(), "an even sky"),
        };
        notes.push(note(&format!("there is no light; {words} lights it (--disable-camera-light takes it away)")));
        scene.lights.push(light);
        // Such pictures tell no quantities: the sparks that a light without size throws from metal and glass would.
        if options.headlight == Headlight::Camera {
            scene.settings.clamp_indirect = CAMERA_LIT_CLAMP;
        }
    }
    conform_cameras(scene, framing.as_ref().map_or(ConformPolicy::default(), |framing| framing.conform));
    let window = framing.filter(|_| options.data_window).and_then(|Framing { data_window, .. }| data_window::apply(scene, data_window));
    notes.extend(window.map(|problem| Diagnostic::warning(&Origin::new("render settings"), problem)));
    Ok(notes)
}

fn set_resolution(loaded: &mut Loaded, options: &ViewOptions) -> Result<()> {
    if !(options.scale > 0.0 && options.scale.is_finite()) {
        let problem = format!("{} was found, expected a number above 0", options.scale);
        return Err(Error::Setting { name: "res-scale".into(), problem });
    }
    let has_settings = loaded.settings.is_some();
    let scene = &mut loaded.scene;
    if let Some(aspect) = options.pixel_aspect {
        if !(aspect > 0.0 && aspect.is_finite()) {
            return Err(Error::setting("pixel-aspect", format!("{aspect} was found, expected a number above 0")));
        }
        scene.settings.pixel_aspect = aspect;
    }
    let aspect = scene.cameras.get(scene.settings.camera as usize).map_or(DEFAULT_ASPECT, aperture_aspect);
    let pixel_aspect = scene.settings.pixel_aspect;
    let by_width = |width: u32| [width, ((f64::from(width) * pixel_aspect / aspect).round() as u32).max(1)];
    let resolution = match options.resolution {
        Resolution::Exact(resolution) => resolution,
        Resolution::Width(width) => by_width(width),
        Resolution::Stage if has_settings => scene.settings.resolution,
        Resolution::Stage => by_width(DEFAULT_WIDTH),
    };
    scene.settings.resolution = resolution.map(|side| ((f64::from(side) * options.scale).round() as u32).max(u32::from(side > 0)));
    Ok(())
}

/// Whether what is within a material shines by itself.
fn glows(material: &Material) -> bool {
    material.medium.emission.iter().any(|x| *x > 0.0)
}
