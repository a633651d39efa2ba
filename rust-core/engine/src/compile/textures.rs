//! Images of materials as mip maps, images of lights as plain arrays.

use super::kept::{KeptImages, Stamp, Tiles};
use crate::{
    colour::{ColourSpace, file_rule},
    error::{Diagnostic, Error, Result},
    light::LightTexture,
    scene::{DomeFormat, LightShape, Operation, Scene, Texture, TextureId, TextureSource},
    texture::{self, Image, LatLong, MipMap, Source, Texels, TextureRequest, TextureTable, find_tiles, is_udim},
};
use std::{
    path::Path,
    sync::{Arc, atomic::AtomicBool},
};

/// Loaded images and where the scene's textures are among them.
#[derive(Debug)]
pub(super) struct CompiledTextures {
    pub(super) table: TextureTable,
    numbers: Vec<Option<u32>>,
    /// Images of lights, and which of them each light of the scene has.
    pub(super) of_lights: Vec<Arc<LightTexture>>,
    pub(super) light_numbers: Vec<Option<u32>>,
    /// For the next compilation.
    pub(super) kept: KeptImages,
}

impl CompiledTextures {
    /// A scene texture's number in the table; `None` if it could not be had.
    pub(super) fn number(&self, id: TextureId) -> Option<u32> {
        self.numbers.get(id.index()).copied().flatten()
    }
}

/// One tile to load for a texture.
struct Wanted {
    texture: usize,
    tile: Option<u32>,
    request: TextureRequest,
}

/// Loads all images that materials and lights use; those that fail are reported.
pub(super) fn compile(
    scene: &Scene,
    previous: &KeptImages,
    cancel: &AtomicBool,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<CompiledTextures> {
    let used = used_by_materials(scene);
    let mut wanted = Vec::new();
    let mut maps: Vec<Tiles> = vec![Vec::new(); scene.textures.len()];
    let mut kept = KeptImages::default();
    let stamps: Vec<Stamp> = scene.textures.iter().map(Stamp::of).collect();
    for (number, texture) in scene.textures.iter().enumerate().filter(|(number, _)| used[*number]) {
        if let Some(tiles) = previous.tiles(&stamps[number]) {
            maps[number].clone_from(tiles);
            continue;
        }
        match &texture.source {
            TextureSource::Pixels { width, height, rgba } => {
                let image = float_image(*width, *height, rgba.to_vec());
                match MipMap::build(&image, ColourSpace::Raw, None, cancel) {
                    Ok(map) => maps[number].push((0, Arc::new(map))),
                    Err(error) => report(texture, &error.to_string(), diagnostics),
                }
            }
            _ => wanted.extend(requests(number, texture, diagnostics)),
        }
    }
    let requests: Vec<TextureRequest> = wanted.iter().map(|w| w.request.clone()).collect();
    let loaded = texture::load_set(&requests, cancel);
    super::check(cancel)?;
    for (w, result) in wanted.iter().zip(loaded) {
        match result {
            Ok(map) => maps[w.texture].push((w.tile.unwrap_or(0), map)),
            Err(error) => report(&scene.textures[w.texture], &error.to_string(), diagnostics),
        }
    }
    for (number, tiles) in maps.iter().enumerate().filter(|(_, tiles)| !tiles.is_empty()) {
        kept.keep_tiles(stamps[number].clone(), tiles.clone());
    }
    let mut table = TextureTable::new();
    let numbers = maps.into_iter().map(|tiles| push(&mut table, tiles)).collect();
    let (of_lights, light_numbers) = light_images(scene, &stamps, previous, &mut kept, diagnostics)?;
    Ok(CompiledTextures { table, numbers, of_lights, light_numbers, kept })
}

fn push(table: &mut TextureTable, mut tiles: Tiles) -> Option<u32> {
    match tiles.as_slice() {
        [] => None,
        [(0, _)] => tiles.pop().map(|(_, map)| table.push(map)),
        _ => Some(table.push_tiles(tiles)),
    }
}

fn report(texture: &Texture, what: &str, diagnostics: &mut Vec<Diagnostic>) {
    diagnostics.push(Diagnostic::warning(&texture.origin, format!("{what}; the fallback value is used")));
}

fn used_by_materials(scene: &Scene) -> Vec<bool> {
    let mut used = vec![false; scene.textures.len()];
    for node in scene.materials.iter().flat_map(|material| &material.graph.nodes) {
        if let Operation::Image { texture, .. } = &node.operation
            && let Some(used) = used.get_mut(texture.index())
        {
            *used = true;
        }
    }
    used
}

fn colour_space(texture: &Texture, diagnostics: &mut Vec<Diagnostic>) -> ColourSpace {
    ColourSpace::parse(&texture.colour_space).unwrap_or_else(|error| {
        diagnostics.push(Diagnostic::warning(&texture.origin, format!("{error}; read as 'auto'")));
        ColourSpace::Auto
    })
}

fn requests(number: usize, texture: &Texture, diagnostics: &mut Vec<Diagnostic>) -> Vec<Wanted> {
    let space = colour_space(texture, diagnostics);
    let request = |source: Source, name: &str| {
        let mut request = match source {
            Source::Path(path) => TextureRequest::path(path, space),
            Source::Bytes { name, bytes } => TextureRequest::bytes(&name, bytes, space),
        };
        request.fallback = file_rule(name);
        request
    };
    let name_of = |path: &Path| path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    match &texture.source {
        TextureSource::Pixels { .. } => Vec::new(),
        TextureSource::Encoded { name, bytes } => {
            let source = Source::Bytes { name: name.as_str().into(), bytes: bytes.clone() };
            vec![Wanted { texture: number, tile: None, request: request(source, name) }]
        }
        TextureSource::File(path) if is_udim(&path.to_string_lossy()) => {
            let tiles = find_tiles(&path.to_string_lossy());
            if tiles.is_empty() {
                report(texture, &format!("{}: no tile of the UDIM set was found", path.display()), diagnostics);
            }
            let wanted = |(tile, path): (u32, std::path::PathBuf)| {
                let name = name_of(&path);
                Wanted { texture: number, tile: Some(tile), request: request(Source::Path(path), &name) }
            };
            tiles.into_iter().map(wanted).collect()
        }
        TextureSource::File(path) => {
            vec![Wanted { texture: number, tile: None, request: request(Source::Path(path.clone()), &name_of(path)) }]
        }
    }
}

fn float_image(width: u32, height: u32, rgba: Vec<f32>) -> Image {
    Image { width, height, channels: 4, texels: Texels::Float(rgba), primaries: None }
}

/// Images, and which of them each light of the scene has.
type LightImages = (Vec<Arc<LightTexture>>, Vec<Option<u32>>);

/// The images of rectangles and domes.
fn light_images(
    scene: &Scene,
    stamps: &[Stamp],
    previous: &KeptImages,
    kept: &mut KeptImages,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<LightImages> {
    let mut images = Vec::new();
    let mut numbers = Vec::with_capacity(scene.lights.len());
    for light in &scene.lights {
        let Some(id) = light.texture.filter(|id| id.index() < scene.textures.len()) else {
            numbers.push(None);
            continue;
        };
        let (texture, stamp) = (&scene.textures[id.index()], &stamps[id.index()]);
        let format = match light.shape {
            LightShape::Dome { format } => dome_format(format),
            _ => texture::DomeFormat::LatLong,
        };
        let image = match previous.light(stamp, format) {
            Some(image) => Ok(image),
            None => light_image(texture, format, diagnostics).map(Arc::new),
        };
        match image {
            Ok(image) => {
                kept.keep_light(stamp.clone(), format, image.clone());
                numbers.push(Some(images.len() as u32));
                images.push(image);
            }
            Err(Error::Cancelled) => return Err(Error::Cancelled),
            Err(error) => {
                diagnostics.push(Diagnostic::warning(&light.origin, format!("{error}; the light shines without its texture")));
                numbers.push(None);
            }
        }
    }
    Ok((images, numbers))
}

fn dome_format(format: DomeFormat) -> texture::DomeFormat {
    match format {
        DomeFormat::Automatic | DomeFormat::LatLong => texture::DomeFormat::LatLong,
        DomeFormat::MirroredBall => texture::DomeFormat::MirroredBall,
        DomeFormat::Angular => texture::DomeFormat::Angular,
        DomeFormat::CubeMapVerticalCross => texture::DomeFormat::CubeMapVerticalCross,
    }
}

fn light_image(texture: &Texture, format: texture::DomeFormat, diagnostics: &mut Vec<Diagnostic>) -> Result<LightTexture> {
    let failed = |error: texture::TextureError| Error::scene(&texture.origin, error.to_string());
    let (source, name) = match &texture.source {
        TextureSource::File(path) => (Source::Path(path.clone()), path.to_string_lossy().into_owned()),
        TextureSource::Encoded { name, bytes } => (Source::Bytes { name: name.as_str().into(), bytes: bytes.clone() }, name.clone()),
        TextureSource::Pixels { width, height, rgba } => {
            let image = float_image(*width, *height, rgba.to_vec());
            let latlong = LatLong::from_image(&image, format, ColourSpace::Raw, None).map_err(failed)?;
            return Ok(light_texture(latlong));
        }
    };
    let image = texture::load_image(&source).map_err(failed)?;
    let space = colour_space(texture, diagnostics);
    Ok(light_texture(LatLong::from_image(&image, format, space, file_rule(&name)).map_err(failed)?))
}

fn light_texture(image: LatLong) -> LightTexture {
    LightTexture { width: image.width, height: image.height, rgb: image.rgb.into_iter().flatten().collect() }
}
