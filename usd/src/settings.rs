//! UsdRender: the settings prim of a stage with its products and variables, and what they change in the scene.

use crate::context::Context;
use crate::framing::ConformPolicy;
use crate::options::Purpose;
use crate::prim::Prim;
use gonio::scene::{Aov, Crop, Origin, Scene};
use gonio::{Error, Result};
use pyo3::{intern, prelude::*};

/// A picture file that the settings ask for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Product {
    /// Where it came from.
    pub origin: Origin,
    /// The file's name; never empty.
    pub name: String,
    /// The passes in it.
    pub aovs: Vec<Aov>,
}

/// What a `RenderSettings` prim says.
#[derive(Clone, Debug, PartialEq)]
pub struct RenderSettings {
    /// Where it came from.
    pub origin: Origin,
    /// Width and height in pixels.
    pub resolution: [u32; 2],
    /// Width of a pixel over its height.
    pub pixel_aspect: f64,
    /// Path of the camera.
    pub camera: Option<String>,
    /// What gives way when aperture and picture differ in shape.
    pub conform: ConformPolicy,
    /// Lower left and upper right of what is rendered, 0 to 1 over the picture.
    pub data_window: [f64; 4],
    /// Purposes that are shown.
    pub purposes: Vec<Purpose>,
    /// Purposes of material bindings in the order in which they are tried.
    pub material_binding_purposes: Vec<String>,
    /// Whether nothing moves while the shutter is open.
    pub disable_motion_blur: bool,
    /// Whether all lenses are pinholes.
    pub disable_depth_of_field: bool,
    /// The files wanted.
    pub products: Vec<Product>,
}

/// The settings at `path`, or those that the stage's metadata names, or the only settings prim; `None` where there are none.
///
/// # Errors
/// There is no settings prim at `path`.
pub fn render_settings(context: &mut Context<'_, '_>, path: Option<&str>) -> Result<Option<RenderSettings>> {
    let prim = match path {
        Some(path) => Some(context.prim_at(path).filter(|prim| prim.type_name() == "RenderSettings").ok_or_else(|| Error::Setting {
            name: "render settings".into(),
            problem: format!("there is no RenderSettings prim at '{path}'"),
        })?),
        None => named_by_metadata(context).or_else(|| only_settings_prim(context)),
    };
    Ok(prim.map(|prim| read(context, &prim)))
}

fn named_by_metadata<'py>(context: &mut Context<'_, 'py>) -> Option<Prim<'py>> {
    let py = context.py;
    let metadata = context.stage.call_method1(intern!(py, "GetMetadata"), (intern!(py, "renderSettingsPrimPath"),));
    let path = metadata.ok()?.extract::<String>().ok().filter(|path| !path.is_empty())?;
    let found = context.prim_at(&path).filter(|prim| prim.type_name() == "RenderSettings");
    if found.is_none() {
        context.warn(&Origin::new(&path), "the stage's renderSettingsPrimPath names no RenderSettings prim; it is ignored");
    }
    found
}

fn only_settings_prim<'py>(context: &mut Context<'_, 'py>) -> Option<Prim<'py>> {
    let py = context.py;
    let find = || -> PyResult<Vec<Prim<'py>>> {
        let mut found = Vec::new();
        for prim in context.stage.call_method0(intern!(py, "Traverse"))?.try_iter()? {
            let prim = Prim::new(prim?);
            if prim.type_name() == "RenderSettings" {
                found.push(prim);
            }
        }
        Ok(found)
    };
    let mut found = find().ok()?;
    if let [first, _, ..] = found.as_slice() {
        let message = format!("the stage has {} RenderSettings prims and names none as its own; none is used", found.len());
        context.note(&first.origin(), message);
        return None;
    }
    found.pop()
}

/// A setting of the first product if it has an opinion, else of the settings.
fn setting<'p, 'py>(settings: &'p Prim<'py>, product: Option<&'p Prim<'py>>, name: &str) -> &'p Prim<'py> {
    product.filter(|product| product.has_authored(name)).unwrap_or(settings)
}

fn read<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> RenderSettings {
    let origin = prim.origin();
    let product_prims: Vec<Prim<'py>> = prim.targets("products").iter().filter_map(|path| context.prim_at(path)).collect();
    let products = product_prims.iter().filter_map(|product| read_product(context, product)).collect();
    let first = product_prims.first();
    let of = |name: &str| setting(prim, first, name);
    let camera = of("camera").targets("camera").into_iter().next();
    let resolution = context.get::<[f64; 2]>(of("resolution"), "resolution").unwrap_or([2048.0, 1080.0]);
    let pixel_aspect = context.get::<f64>(of("pixelAspectRatio"), "pixelAspectRatio").filter(|aspect| aspect.is_finite() && *aspect > 0.0);
    let policy: String = context.get(of("aspectRatioConformPolicy"), "aspectRatioConformPolicy").unwrap_or_default();
    let conform = ConformPolicy::from_token(&policy).unwrap_or_else(|| {
        context.warn(&origin, format!("aspectRatioConformPolicy is '{policy}', which is not known; expandAperture is used"));
        ConformPolicy::default()
    });
    report_left_out(context, prim, &product_prims);
    RenderSettings {
        resolution: resolution.map(|pixels| pixels.clamp(1.0, 65_536.0) as u32),
        pixel_aspect: pixel_aspect.unwrap_or(1.0),
        camera,
        conform,
        data_window: context.get(of("dataWindowNDC"), "dataWindowNDC").unwrap_or([0.0, 0.0, 1.0, 1.0]),
        purposes: purposes(context, prim),
        material_binding_purposes: binding_purposes(context, prim),
        disable_motion_blur: context.get(of("disableMotionBlur"), "disableMotionBlur").unwrap_or(false),
        disable_depth_of_field: context.get(of("disableDepthOfField"), "disableDepthOfField").unwrap_or(false),
        products,
        origin,
    }
}

/// The all-purpose binding's token is empty; some exporters write its name.
fn binding_purposes<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> Vec<String> {
    let tokens: Vec<String> = context.get(prim, "materialBindingPurposes").unwrap_or_else(|| vec!["full".to_owned(), String::new()]);
    tokens.into_iter().map(|token| if token == "allPurpose" { String::new() } else { token }).collect()
}

fn purposes<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> Vec<Purpose> {
    let tokens: Vec<String> = context.get(prim, "includedPurposes").unwrap_or_else(|| vec!["default".into(), "render".into()]);
    let mut purposes = Vec::with_capacity(tokens.len());
    for token in tokens {
        match Purpose::from_token(&token) {
            Some(purpose) => purposes.push(purpose),
            None => context.warn(&prim.origin(), format!("includedPurposes has '{token}', expected default, render, proxy or guide")),
        }
    }
    purposes
}

fn report_left_out<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, products: &[Prim<'py>]) {
    const OVERRIDES: [&str; 4] = ["resolution", "camera", "dataWindowNDC", "pixelAspectRatio"];
    if let Some(other) = products.iter().skip(1).find(|product| OVERRIDES.iter().any(|name| product.has_authored(name))) {
        context.unsupported("resolution, camera or window of a second render product", &other.origin());
    }
    let space: Option<String> = context.get_authored(prim, "renderingColorSpace");
    if let Some(space) = space.filter(|space| !space.is_empty() && !is_linear_rec709(space)) {
        context.warn(&prim.origin(), format!("renderingColorSpace is '{space}'; gonio renders in linear Rec.709"));
    }
}

fn is_linear_rec709(space: &str) -> bool {
    gonio::colour::ColourSpace::parse(space) == Ok(gonio::colour::ColourSpace::LINEAR_REC709)
}

fn read_product<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> Option<Product> {
    let origin = prim.origin();
    let kind: String = context.get(prim, "productType").unwrap_or_default();
    if !matches!(kind.as_str(), "" | "raster") {
        context.unsupported(&format!("a render product of type '{kind}'"), &origin);
        return None;
    }
    let stated: String = context.get(prim, "productName").unwrap_or_default();
    let mut aovs = Vec::new();
    for path in prim.targets("orderedVars") {
        if let Some(aov) = context.prim_at(&path).and_then(|var| read_variable(context, &var)).filter(|aov| !aovs.contains(aov)) {
            aovs.push(aov);
        }
    }
    let name = if stated.is_empty() { format!("{}.exr", prim.name()) } else { stated };
    Some(Product { origin, name, aovs })
}

fn read_variable<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> Option<Aov> {
    let source: String = context.get(prim, "sourceName").unwrap_or_default();
    let kind: String = context.get(prim, "sourceType").unwrap_or_default();
    let source = if source.is_empty() { prim.name() } else { source };
    let aov = if kind == "lpe" { light_path(&source) } else { aov_by_name(&source) };
    if aov.is_none() {
        context.unsupported(&format!("the render variable '{source}' ({})", if kind.is_empty() { "raw" } else { &kind }), &prim.origin());
    }
    aov
}

/// Of light path expressions, only those for all of the light are passes of gonio.
fn light_path(expression: &str) -> Option<Aov> {
    matches!(expression.trim_start_matches("lpe:"), "C.*" | "C.*[LO]" | "C.*[<L.>O]" | "C[LO]|C.*[LO]").then_some(Aov::Color)
}

/// The pass by the names that renderers give it.
pub fn aov_by_name(name: &str) -> Option<Aov> {
    Some(match name {
        "color" | "Color" | "Ci" | "C" | "rgba" | "RGBA" | "beauty" => Aov::Color,
        "a" | "A" | "alpha" | "Alpha" => Aov::Alpha,
        "z" | "Z" | "depth" | "Depth" | "cameraDepth" => Aov::Depth,
        "N" | "Nn" | "normal" | "Normal" => Aov::Normal,
        "P" | "position" | "Position" => Aov::P,
        other => return Aov::by_name(other),
    })
}

impl RenderSettings {
    /// The pixels that the data window leaves, or `None` for all; what lies outside the picture is cut off.
    pub fn crop(&self) -> Option<Crop> {
        let [left, bottom, right, top] = self.data_window.map(|x| if x.is_finite() { x.clamp(0.0, 1.0) } else { 0.0 });
        if left >= right || bottom >= top || [left, bottom, right, top] == [0.0, 0.0, 1.0, 1.0] {
            return None;
        }
        let [width, height] = self.resolution.map(f64::from);
        // A pixel belongs to the window if its centre does; rows are counted from the top.
        let pixel = |x: f64| (x - 0.5).ceil().max(0.0) as u32;
        let min = [pixel(left * width), pixel((1.0 - top) * height)];
        let max = [pixel(right * width), pixel((1.0 - bottom) * height)];
        (min[0] < max[0] && min[1] < max[1]).then_some(Crop { min, max })
    }

    /// Writes size, window, passes and lens switches into the scene. The cameras' apertures are conformed apart, by [`conform_cameras`].
    pub fn apply(&self, scene: &mut Scene) {
        scene.settings.resolution = self.resolution;
        scene.settings.pixel_aspect = self.pixel_aspect;
        scene.settings.crop = self.crop();
        let mut aovs: Vec<Aov> = Vec::new();
        for aov in self.products.iter().flat_map(|product| &product.aovs) {
            if !aovs.contains(aov) {
                aovs.push(*aov);
            }
        }
        if !aovs.is_empty() {
            scene.settings.aovs = aovs;
        }
        if self.disable_depth_of_field {
            for camera in &mut scene.cameras {
                camera.lens_radius = 0.0;
            }
        }
    }
}

/// Makes the apertures of all cameras and the picture's shape agree; to be called when the resolution is final.
pub fn conform_cameras(scene: &mut Scene, policy: ConformPolicy) {
    let (resolution, pixel_aspect) = (scene.settings.resolution, scene.settings.pixel_aspect);
    for (index, camera) in scene.cameras.iter_mut().enumerate() {
        let conformed = policy.conform(&mut camera.aperture, resolution, pixel_aspect);
        if index == scene.settings.camera as usize {
            scene.settings.pixel_aspect = conformed;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn data_window_counts_rows_from_the_top() {
        let mut settings = RenderSettings {
            origin: Origin::default(),
            resolution: [200, 100],
            pixel_aspect: 1.0,
            camera: None,
            conform: ConformPolicy::default(),
            data_window: [0.5, 0.75, 1.5, 1.0],
            purposes: Vec::new(),
            material_binding_purposes: Vec::new(),
            disable_motion_blur: false,
            disable_depth_of_field: false,
            products: Vec::new(),
        };
        assert_eq!(settings.crop(), Some(Crop { min: [100, 0], max: [200, 25] }));
        settings.data_window = [-0.1, 0.0, 1.1, 1.0];
        assert_eq!(settings.crop(), None);
        settings.data_window = [0.6, 0.0, 0.4, 1.0];
        assert_eq!(settings.crop(), None);
    }

    #[test]
    fn passes_have_the_names_of_other_renderers() {
        assert_eq!(aov_by_name("Ci"), Some(Aov::Color));
        assert_eq!(aov_by_name("cameraDepth"), Some(Aov::Depth));
        assert_eq!(aov_by_name("Neye"), None);
        assert_eq!(light_path("C.*[LO]"), Some(Aov::Color));
        assert_eq!(light_path("C<RD>L"), None);
    }
}
