//! What UsdRender's settings, products and variables say.

use crate::framing::ConformPolicy;
use crate::options::Purpose;
use gonio::colour::Gamut;
use gonio::scene::{Aov, MatteKind, Origin, ShaderValue};

/// The data window that is the picture itself.
pub const WHOLE_PICTURE: [f64; 4] = [0.0, 0.0, 1.0, 1.0];

/// A picture file that the settings ask for.
#[derive(Clone, Debug, PartialEq)]
pub struct Product {
    /// Where it came from.
    pub origin: Origin,
    /// The file's name; never empty.
    pub name: String,
    /// Whether it is a deep picture.
    pub deep: bool,
    /// What is in it, in order; deep pictures have the colour and its coverage, whatever is asked for.
    pub variables: Vec<RenderVariable>,
    /// How it is framed: its own opinions over those of the settings.
    pub framing: Framing,
}

/// What settings and products alike say about a picture (`UsdRenderSettingsBase`).
#[derive(Clone, Debug, PartialEq)]
pub struct Framing {
    /// Width and height in pixels.
    pub resolution: [u32; 2],
    /// Width of a pixel over its height.
    pub pixel_aspect: f64,
    /// Path of the camera.
    pub camera: Option<String>,
    /// What gives way when aperture and picture differ in shape.
    pub conform: ConformPolicy,
    /// Lower left and upper right of what is rendered, 0 to 1 over the picture; beyond that is overscan.
    pub data_window: [f64; 4],
    /// Whether all lenses are pinholes.
    pub disable_depth_of_field: bool,
    /// Whether nothing moves while the shutter is open.
    pub disable_motion_blur: bool,
}

/// What a `RenderSettings` prim says.
#[derive(Clone, Debug, PartialEq)]
pub struct RenderSettings {
    /// Where it came from.
    pub origin: Origin,
    /// How the picture is framed; the first product's opinions count.
    pub framing: Framing,
    /// Purposes that are shown.
    pub purposes: Vec<Purpose>,
    /// Purposes of material bindings in the order in which they are tried.
    pub material_binding_purposes: Vec<String>,
    /// The gamut in which EXR files have their colours; gonio itself renders in linear Rec.709.
    pub gamut: Gamut,
    /// Whether light has wavelengths in place of red, green and blue (`gonio:spectral`).
    pub spectral: bool,
    /// Whether the camera does not see the shapes of lamps (`gonio:hideLights`).
    pub hide_lights: bool,
    /// The files wanted.
    pub products: Vec<Product>,
}

/// What a variable shows.
#[derive(Clone, Debug, PartialEq)]
pub enum Source {
    /// A pass.
    Pass(Aov),
    /// Light of an expression that gonio can show.
    LightPath(String),
    /// A value of the first surface that shading nodes compute: a primvar, or a vector in the camera's space.
    Shader(ShaderValue, String),
    /// All layers of a cryptomatte.
    Cryptomatte(MatteKind),
}

/// A `RenderVar` prim.
#[derive(Clone, Debug, PartialEq)]
pub struct RenderVariable {
    /// The name of its layer in files.
    pub name: String,
    /// What it shows.
    pub source: Source,
    /// Whether files have it in half floats.
    pub half: bool,
}
