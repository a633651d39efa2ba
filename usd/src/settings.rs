//! UsdRender: the settings prim of a stage with its products and variables, and what they change in the scene.

use crate::context::Context;
use crate::framing::ConformPolicy;
use crate::options::Purpose;
use crate::prim::Prim;
use crate::render_settings::{Framing, Product, RenderSettings, RenderVariable, Source, WHOLE_PICTURE};
use crate::render_variable;
use gonio::colour::{ColourSpace, Gamut, Transfer};
use gonio::scene::{Aov, Origin, Scene};
use gonio::{Error, Result};
use pyo3::{intern, prelude::*};

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
    let product_prims: Vec<Prim<'py>> = context.targets(prim, "products").iter().filter_map(|path| context.prim_at(path)).collect();
    RenderSettings {
        framing: framing(context, prim, product_prims.first()),
        purposes: purposes(context, prim),
        material_binding_purposes: binding_purposes(context, prim),
        gamut: gamut(context, prim),
        spectral: context.get_authored(prim, "gonio:spectral").unwrap_or(false),
        hide_lights: context.get_authored(prim, "gonio:hideLights").unwrap_or(false),
        products: product_prims.iter().filter_map(|product| read_product(context, prim, product)).collect(),
        origin: prim.origin(),
    }
}

fn framing<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, product: Option<&Prim<'py>>) -> Framing {
    let of = |name: &str| setting(prim, product, name);
    let resolution = context.get::<[f64; 2]>(of("resolution"), "resolution").unwrap_or([2048.0, 1080.0]);
    let pixel_aspect = context.get::<f64>(of("pixelAspectRatio"), "pixelAspectRatio").filter(|aspect| aspect.is_finite() && *aspect > 0.0);
    let policy: String = context.get(of("aspectRatioConformPolicy"), "aspectRatioConformPolicy").unwrap_or_default();
    let conform = ConformPolicy::from_token(&policy).unwrap_or_else(|| {
        let message = || format!("aspectRatioConformPolicy is '{policy}', which is not known; expandAperture is used");
        context.once("conform policy", &policy, &prim.origin(), message);
        ConformPolicy::default()
    });
    Framing {
        resolution: resolution.map(|pixels| pixels.clamp(1.0, 65_536.0) as u32),
        pixel_aspect: pixel_aspect.unwrap_or(1.0),
        camera: context.targets(of("camera"), "camera").into_iter().next(),
        conform,
        data_window: context.get(of("dataWindowNDC"), "dataWindowNDC").unwrap_or(WHOLE_PICTURE),
        disable_depth_of_field: context.get(of("disableDepthOfField"), "disableDepthOfField").unwrap_or(false),
        disable_motion_blur: is_instantaneous(context, prim, product),
    }
}

/// Whether nothing moves while the shutter is open, by the name of today or the one before it.
fn is_instantaneous<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, product: Option<&Prim<'py>>) -> bool {
    let mut says = |name: &str| context.get(setting(prim, product, name), name).unwrap_or(false);
    says("disableMotionBlur") || says("instantaneousShutter")
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

/// The gamut of `renderingColorSpace`; spaces that are not linear are told.
fn gamut<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> Gamut {
    let space: String = context.get_authored(prim, "renderingColorSpace").unwrap_or_default();
    match ColourSpace::parse(&space) {
        Ok(ColourSpace::Colour { transfer: Transfer::Linear, gamut }) => return gamut,
        Ok(ColourSpace::Auto) => {}
        _ => context.warn(&prim.origin(), format!("renderingColorSpace is '{space}', expected a linear space such as lin_rec709_scene or lin_ap1_scene; files are in linear Rec.709")),
    }
    Gamut::Rec709
}

fn read_product<'py>(context: &mut Context<'_, 'py>, settings: &Prim<'py>, prim: &Prim<'py>) -> Option<Product> {
    let origin = prim.origin();
    let kind: String = context.get(prim, "productType").unwrap_or_default();
    if !matches!(kind.as_str(), "" | "raster" | "deepRaster") {
        context.unsupported(&format!("a render product of type '{kind}'"), &origin);
        return None;
    }
    let stated: String = context.get(prim, "productName").unwrap_or_default();
    let mut variables: Vec<RenderVariable> = Vec::new();
    for path in context.targets(prim, "orderedVars") {
        let read = context.prim_at(&path).and_then(|var| render_variable::read(context, &var));
        variables.extend(read.filter(|read| variables.iter().all(|known| known.name != read.name)));
    }
    let name = if stated.is_empty() { prim.name() } else { stated };
    let name = if has_ending(&name) { name } else { format!("{name}.exr") };
    Some(Product { framing: framing(context, settings, Some(prim)), origin, name, deep: kind == "deepRaster", variables })
}

/// Whether a name tells a format: places for the frame number do not.
fn has_ending(name: &str) -> bool {
    let ending = std::path::Path::new(name).extension().map(|ending| ending.to_string_lossy().into_owned()).unwrap_or_default();
    ending.starts_with(|c: char| c.is_ascii_alphabetic())
}

impl RenderSettings {
    /// Whether a variable shows a pass.
    pub fn shows(&self, aov: Aov) -> bool {
        self.products.iter().flat_map(|product| &product.variables).any(|variable| variable.source == Source::Pass(aov))
    }

    /// The variables of all products, each name once.
    pub fn variables(&self) -> Vec<RenderVariable> {
        let mut variables: Vec<RenderVariable> = Vec::new();
        for variable in self.products.iter().flat_map(|product| &product.variables) {
            if variables.iter().all(|known| known.name != variable.name) {
                variables.push(variable.clone());
            }
        }
        variables
    }
}

impl Framing {
    /// Writes size and lens switches into the scene. The cameras' apertures are conformed apart, by [`conform_cameras`].
    pub fn apply(&self, scene: &mut Scene) {
        scene.settings.resolution = self.resolution;
        scene.settings.pixel_aspect = self.pixel_aspect;
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
    use super::has_ending;

    #[test]
    fn frame_numbers_are_no_endings() {
        assert!(has_ending("a.exr") && has_ending("a.####.tif"));
        assert!(!has_ending("a") && !has_ending("a.####") && !has_ending("a.$F4") && !has_ending("a.0001"));
    }
}
