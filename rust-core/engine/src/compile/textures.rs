//! Images of materials as mip maps, images of lights as plain arrays.

use super::kept::{KeptImages, Stamp, Tiles};
use super::light_images::{LightImages, light_images};
use crate::{
    colour::{ColourSpace, Stated},
    error::{Diagnostic, Result},
    scene::{Operation, Origin, Scene, Texture, TextureId, TextureSource, Tile},
    texture::{
        self, CacheFolder, Image, MipMap, Source, Texels, TextureError, TextureMemory, TextureRequest, TextureTable, find_tiles, is_udim,
        tile_path,
    },
    threads::available_threads,
};
use rayon::prelude::*;
use std::{
    sync::{Arc, atomic::AtomicBool},
    time::Instant,
};

/// Loaded images and where the scene's textures are among them.
#[derive(Debug)]
pub(super) struct CompiledTextures {
    pub(super) table: TextureTable,
    numbers: Vec<Option<u32>>,
    pub(super) of_lights: LightImages,
    /// For the next compilation.
    pub(super) kept: KeptImages,
    /// What reading, decoding and filtering took.
    pub(super) seconds: f64,
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

/// Loads all images that materials and lights use, side by side; those that fail are reported.
pub(super) fn compile(
    scene: &Scene,
    previous: &KeptImages,
    cancel: &AtomicBool,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<CompiledTextures> {
    let start = Instant::now();
    let used = used_by_materials(scene);
    let (mut wanted, mut pixels) = (Vec::new(), Vec::new());
    let mut maps: Vec<Tiles> = vec![Vec::new(); scene.textures.len()];
    let stamps: Vec<Stamp> = scene.textures.iter().map(Stamp::of).collect();
    let limit = scene.settings.texture_memory;
    let of_used = stamps.iter().zip(&used).filter(|(_, used)| **used).map(|(stamp, _)| stamp);
    let lends = previous.lends(limit, of_used);
    for (number, texture) in scene.textures.iter().enumerate().filter(|(number, _)| used[*number]) {
        match (previous.tiles(&stamps[number]).filter(|_| lends), &texture.source) {
            (Some(tiles), _) => maps[number].clone_from(tiles),
            (None, TextureSource::Pixels { .. }) if limit == 0 => pixels.push(number),
            (None, _) => wanted.extend(requests(number, texture, diagnostics)),
        }
    }
    let requests: Vec<TextureRequest> = wanted.iter().map(|w| w.request.clone()).collect();
    let build = |number: &usize| build(&scene.textures[*number], cancel);
    let (loaded, (built, lights)) = rayon::join(
        || load(&requests, scene, cancel),
        || rayon::join(|| pixels.par_iter().map(build).collect::<Vec<_>>(), || light_images(scene, &stamps, previous)),
    );
    super::cancel::check(cancel)?;
    let (loaded, trouble) = loaded;
    diagnostics.extend(trouble.map(|trouble| Diagnostic::warning(&Origin::new("texture cache"), trouble)));
    let loaded = wanted.iter().map(|w| (w.texture, w.tile.unwrap_or(0))).zip(loaded);
    for ((number, tile), result) in loaded.chain(pixels.iter().map(|number| (*number, 0)).zip(built)) {
        let texture = &scene.textures[number];
        match result {
            Ok(map) => {
                diagnostics.extend(map.note().map(|note| unusable(texture, note)));
                maps[number].push((tile, map));
            }
            Err(error) => report(texture, &error.to_string(), diagnostics),
        }
    }
    let mut kept = KeptImages::within(limit);
    for (number, tiles) in maps.iter().enumerate().filter(|(_, tiles)| !tiles.is_empty()) {
        kept.keep_tiles(stamps[number].clone(), tiles.clone());
    }
    let mut table = TextureTable::new();
    let numbers = maps.into_iter().map(|tiles| push(&mut table, tiles)).collect();
    let shortage = table.memory().and_then(|memory| memory.shortage());
    diagnostics.extend(shortage.map(|shortage| Diagnostic::warning(&Origin::new("texture memory"), shortage)));
    let of_lights = lights.finish(scene, &stamps, &mut kept, diagnostics);
    Ok(CompiledTextures { table, numbers, of_lights, kept, seconds: start.elapsed().as_secs_f64() })
}

/// What comes of requests.
type Loaded = Vec<std::result::Result<Arc<MipMap>, TextureError>>;

/// Loads images, within a memory limit tile by tile; what could not be written of the texture cache comes along.
fn load(requests: &[TextureRequest], scene: &Scene, cancel: &AtomicBool) -> (Loaded, Option<String>) {
    let settings = &scene.settings;
    if settings.texture_memory == 0 {
        return (texture::load_set(requests, cancel), None);
    }
    let threads = if settings.threads == 0 { available_threads() } else { settings.threads as usize };
    let memory = TextureMemory::new(settings.texture_memory, threads);
    let folder = Arc::new(CacheFolder::new(settings.texture_cache.as_deref()));
    let loaded = texture::load_paged(requests, &memory, &folder, cancel);
    (loaded, folder.take_trouble())
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

/// Tells the tiles that a set leaves out between others of a row of ten.
fn report_gaps(texture: &Texture, mut numbers: Vec<u32>, diagnostics: &mut Vec<Diagnostic>) {
    numbers.sort_unstable();
    let row = |number: u32| number.saturating_sub(1001) / 10;
    let between = |pair: &[u32]| if row(pair[0]) == row(pair[1]) { pair[0] + 1..pair[1] } else { 0..0 };
    let missing: Vec<String> = numbers.windows(2).flat_map(between).map(|number| number.to_string()).collect();
    if !missing.is_empty() {
        let message = format!("the UDIM set has no tile {}; the fallback value is used there", missing.join(", "));
        diagnostics.push(Diagnostic::warning(&texture.origin, message));
    }
}

/// What is told of a header that says of its colours what cannot be used.
pub(super) fn unusable(texture: &Texture, note: &str) -> Diagnostic {
    let name = match &texture.source {
        TextureSource::File(path) => path.display().to_string(),
        TextureSource::Encoded { name, .. } | TextureSource::Tiles { name, .. } => name.clone(),
        TextureSource::Pixels { .. } => String::new(),
    };
    Diagnostic::warning(&texture.origin, format!("{name} {note}; it is read as if its header said nothing of colours"))
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

pub(super) fn colour_space(texture: &Texture, diagnostics: &mut Vec<Diagnostic>) -> ColourSpace {
    ColourSpace::parse(&texture.colour_space).unwrap_or_else(|error| {
        diagnostics.push(Diagnostic::warning(&texture.origin, format!("{error}; read as 'auto'")));
        ColourSpace::Auto
    })
}

/// The mip map of pixels that are linear floats already.
fn build(texture: &Texture, cancel: &AtomicBool) -> std::result::Result<Arc<MipMap>, TextureError> {
    let TextureSource::Pixels { width, height, rgba } = &texture.source else { unreachable!("only pixels are built") };
    MipMap::build(&float_image(*width, *height, rgba.to_vec()), ColourSpace::Raw, cancel).map(Arc::new)
}

fn requests(number: usize, texture: &Texture, diagnostics: &mut Vec<Diagnostic>) -> Vec<Wanted> {
    let colour_space = colour_space(texture, diagnostics);
    let wanted = |tile: Option<u32>, source: Source| Wanted { texture: number, tile, request: TextureRequest { source, colour_space } };
    match &texture.source {
        TextureSource::Pixels { width, height, rgba } => {
            let name = Arc::from(texture.origin.to_string());
            let source = Source::Pixels { name, width: *width, height: *height, rgba: rgba.clone() };
            vec![Wanted { texture: number, tile: None, request: TextureRequest { source, colour_space: ColourSpace::Raw } }]
        }
        TextureSource::Encoded { name, bytes } => {
            vec![wanted(None, Source::Bytes { name: name.as_str().into(), bytes: bytes.clone() })]
        }
        TextureSource::Tiles { name, tiles } => {
            if tiles.is_empty() {
                report(texture, &format!("{name}: no tile of the UDIM set was found"), diagnostics);
            }
            report_gaps(texture, tiles.iter().map(|tile| tile.number).collect(), diagnostics);
            let source = |tile: &Tile| Source::Bytes { name: tile_path(name, tile.number).into(), bytes: tile.bytes.clone() };
            tiles.iter().map(|tile| wanted(Some(tile.number), source(tile))).collect()
        }
        TextureSource::File(path) if is_udim(&path.to_string_lossy()) => {
            let tiles = find_tiles(&path.to_string_lossy());
            if tiles.is_empty() {
                report(texture, &format!("{}: no tile of the UDIM set was found", path.display()), diagnostics);
            }
            report_gaps(texture, tiles.iter().map(|(number, _)| *number).collect(), diagnostics);
            tiles.into_iter().map(|(tile, path)| wanted(Some(tile), Source::Path(path))).collect()
        }
        TextureSource::File(path) => vec![wanted(None, Source::Path(path.clone()))],
    }
}

pub(super) fn float_image(width: u32, height: u32, rgba: Vec<f32>) -> Image {
    Image { width, height, channels: 4, texels: Texels::Float(rgba), stated: Stated::Nothing }
}
