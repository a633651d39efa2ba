//! Images of rectangles and domes, each decoded once a layout.

use super::kept::{KeptImages, Stamp};
use super::textures::{colour_space, float_image, unusable};
use crate::{
    colour::{ColourSpace, Stated},
    error::Diagnostic,
    light::LightTexture,
    scene::{DomeFormat, Light, LightShape, Scene, Texture, TextureSource},
    texture::{self, LatLong, Source, TextureError},
};
use rayon::prelude::*;
use std::sync::Arc;

/// Images, and which of them each light of the scene has.
#[derive(Debug)]
pub(crate) struct LightImages {
    pub(super) images: Vec<Arc<LightTexture>>,
    pub(super) numbers: Vec<Option<u32>>,
}

impl LightImages {
    /// By light that has a place, the mean of the picture over it, where there is one.
    pub(crate) fn means(&self, scene: &Scene) -> Vec<Option<[f32; 3]>> {
        // Each once, however many lights have it.
        let mut means: Vec<Option<[f32; 3]>> = vec![None; self.images.len()];
        let mut of_light = |(light, number): (&Light, &Option<u32>)| {
            let number = number.filter(|_| light.is_luminaire())? as usize;
            Some(*means[number].get_or_insert_with(|| mean(&self.images[number])))
        };
        scene.lights.iter().zip(&self.numbers).map(&mut of_light).collect()
    }
}

fn mean(image: &LightTexture) -> [f32; 3] {
    let mut sum = [0.0; 3];
    image.rgb.chunks_exact(3).for_each(|pixel| (0..3).for_each(|k| sum[k] += f64::from(pixel[k])));
    sum.map(|sum| (sum / (image.rgb.len() / 3).max(1) as f64) as f32)
}

/// By light that has a place, the mean of the picture over it: read for that alone, where there is one.
pub(super) fn picture_means(scene: &Scene) -> Vec<Option<[f32; 3]>> {
    let lights: Vec<Light> = scene.lights.iter().filter(|light| light.is_luminaire() && light.texture.is_some()).cloned().collect();
    if lights.is_empty() {
        return vec![None; scene.lights.len()];
    }
    let pictures = Scene { lights, textures: scene.textures.clone(), ..Scene::default() };
    let stamps: Vec<Stamp> = scene.textures.iter().map(Stamp::of).collect();
    let loaded = light_images(&pictures, &stamps, &KeptImages::default());
    let images = loaded.finish(scene, &stamps, &mut KeptImages::default(), &mut Vec::new());
    images.means(scene)
}

/// A texture in a layout, and what came of it.
struct Loaded {
    texture: usize,
    format: texture::DomeFormat,
    image: Result<Arc<LightTexture>, TextureError>,
    diagnostics: Vec<Diagnostic>,
}

/// All images that lights want.
pub(super) struct LoadedImages(Vec<Loaded>);

/// Loads the images of all lights, side by side.
pub(super) fn light_images(scene: &Scene, stamps: &[Stamp], previous: &KeptImages) -> LoadedImages {
    let mut wanted: Vec<(usize, texture::DomeFormat)> = Vec::new();
    for place in scene.lights.iter().filter_map(|light| wanted_by(light, scene)) {
        if !wanted.contains(&place) {
            wanted.push(place);
        }
    }
    let load = |(texture, format): (usize, texture::DomeFormat)| {
        let mut diagnostics = Vec::new();
        let image = match previous.light(&stamps[texture], format) {
            Some(image) => Ok(image),
            None => light_image(&scene.textures[texture], format, &mut diagnostics).map(Arc::new),
        };
        Loaded { texture, format, image, diagnostics }
    };
    LoadedImages(wanted.into_par_iter().map(load).collect())
}

/// The texture of a light and its layout.
fn wanted_by(light: &Light, scene: &Scene) -> Option<(usize, texture::DomeFormat)> {
    let texture = light.texture.map(|id| id.index()).filter(|texture| *texture < scene.textures.len())?;
    let format = match light.shape {
        LightShape::Dome { format } => dome_format(format),
        _ => texture::DomeFormat::LatLong,
    };
    Some((texture, format))
}

impl LoadedImages {
    /// Keeps what was loaded for the next compilation, and reports the lights whose image could not be had.
    pub(super) fn finish(self, scene: &Scene, stamps: &[Stamp], kept: &mut KeptImages, diagnostics: &mut Vec<Diagnostic>) -> LightImages {
        let mut images = Vec::new();
        let mut places = Vec::with_capacity(self.0.len());
        for loaded in self.0 {
            diagnostics.extend(loaded.diagnostics);
            let found = loaded.image.map(|image| {
                kept.keep_light(stamps[loaded.texture].clone(), loaded.format, image.clone());
                images.push(image);
                images.len() as u32 - 1
            });
            places.push(((loaded.texture, loaded.format), found));
        }
        let number = |light: &Light| {
            let wanted = wanted_by(light, scene)?;
            match &places.iter().find(|(place, _)| *place == wanted)?.1 {
                Ok(number) => Some(*number),
                Err(error) => {
                    diagnostics.push(Diagnostic::warning(&light.origin, format!("{error}; the light shines without its texture")));
                    None
                }
            }
        };
        LightImages { numbers: scene.lights.iter().map(number).collect(), images }
    }
}

fn dome_format(format: DomeFormat) -> texture::DomeFormat {
    match format {
        DomeFormat::Automatic | DomeFormat::LatLong => texture::DomeFormat::LatLong,
        DomeFormat::MirroredBall => texture::DomeFormat::MirroredBall,
        DomeFormat::Angular => texture::DomeFormat::Angular,
        DomeFormat::CubeMapVerticalCross => texture::DomeFormat::CubeMapVerticalCross,
    }
}

fn light_image(texture: &Texture, format: texture::DomeFormat, diagnostics: &mut Vec<Diagnostic>) -> Result<LightTexture, TextureError> {
    let source = match &texture.source {
        TextureSource::File(path) => Source::Path(path.clone()),
        TextureSource::Tiles { name, .. } => return Err(TextureError::unsupported(name, "lights show no sets of UDIM tiles")),
        TextureSource::Encoded { name, bytes } => Source::Bytes { name: name.as_str().into(), bytes: bytes.clone() },
        TextureSource::Pixels { width, height, rgba } => {
            let image = float_image(*width, *height, rgba.to_vec());
            return Ok(light_texture(LatLong::from_image(&image, format, ColourSpace::Raw)?));
        }
    };
    let image = texture::load_image(&source)?;
    let space = colour_space(texture, diagnostics);
    if let (ColourSpace::Auto, Stated::Unusable(note)) = (space, &image.stated) {
        diagnostics.push(unusable(texture, note));
    }
    let image = LatLong::from_image(&image, format, space).map_err(|error| TextureError { path: source.name().into(), ..error })?;
    Ok(light_texture(image))
}

fn light_texture(image: LatLong) -> LightTexture {
    LightTexture { width: image.width, height: image.height, rgb: image.rgb.into_iter().flatten().collect() }
}
