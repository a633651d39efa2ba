//! Images by asset path: files, tiles, and files inside packages; each is in the scene once a colour space.

use super::network::{Network, Shader};
use super::neutral::{NodeIndex, Said, Source, Value};
use crate::asset;
use crate::context::Context;
use crate::frame_name::{for_frame, has_frame};
use crate::prim::Attribute;
use crate::pxr::Module;
use crate::vt::AssetPath;
use gonio::colour::ColourSpace;
use gonio::scene::{Input, Origin, Texture, TextureId, TextureSource, Tile};
use pyo3::{intern, prelude::*};
use std::{path::Path, sync::Arc};

/// Time codes beyond this mean no time, as the earliest one does.
pub(super) const LATEST: f64 = 1e12;
/// What stands for the tile number in a file name.
const UDIM: &str = "<UDIM>";
/// The tiles that UsdShade's own search looks for.
const TILES: std::ops::RangeInclusive<u32> = 1001..=1100;

/// The path of a tiled image with the tile number's place kept; empty if there is no tile.
pub(super) fn resolve_tiles(attribute: &Attribute<'_>, authored: &str) -> String {
    if !authored.contains(UDIM) {
        return String::new();
    }
    let py = attribute.object().py();
    let resolve = || -> PyResult<String> {
        let time = Module::Usd.item(py, "TimeCode")?.call_method0(intern!(py, "EarliestTime"))?;
        let specs = attribute.object().call_method1(intern!(py, "GetPropertyStack"), (time,))?;
        let Some(spec) = specs.try_iter()?.next() else {
            return Ok(String::new());
        };
        let layer = spec?.getattr(intern!(py, "layer"))?;
        Module::UsdShade.item(py, "UdimUtils")?.call_method1(intern!(py, "ResolveUdimPath"), (authored, layer))?.extract()
    };
    resolve().unwrap_or_default()
}

/// Where a file lies whose name is text, relative to the layer that says it; empty if there is none.
pub(super) fn resolve_text(attribute: &Attribute<'_>, authored: &str) -> String {
    let py = attribute.object().py();
    let resolve = || -> PyResult<String> {
        let time = Module::Usd.item(py, "TimeCode")?.call_method0(intern!(py, "EarliestTime"))?;
        let specs = attribute.object().call_method1(intern!(py, "GetPropertyStack"), (time,))?;
        let anchored = match specs.try_iter()?.next() {
            Some(spec) => {
                let layer = spec?.getattr(intern!(py, "layer"))?;
                Module::Sdf.item(py, "ComputeAssetPathRelativeToLayer")?.call1((layer, authored))?.extract()?
            }
            None => authored.to_owned(),
        };
        let resolver = Module::Ar.item(py, "GetResolver")?.call0()?;
        resolver.call_method1(intern!(py, "Resolve"), (anchored,))?.str()?.extract()
    };
    resolve().unwrap_or_default()
}

/// Where the file of a sequence lies for a time, 1 where that is none; empty where the name has no place for the frame, or there is no file.
pub(super) fn resolve_of_frame(attribute: &Attribute<'_>, authored: &str, time: &Bound<'_, PyAny>) -> String {
    if !has_frame(Path::new(authored)) {
        return String::new();
    }
    let value = || time.call_method0(intern!(time.py(), "GetValue"))?.extract::<f64>();
    let frame = value().ok().filter(|frame| frame.abs() < LATEST).unwrap_or(1.0);
    resolve_text(attribute, &for_frame(Path::new(authored), frame).to_string_lossy())
}

/// The content of what a resolved path names.
fn open(py: Python<'_>, place: &str) -> Result<TextureSource, String> {
    if place.contains(UDIM) && place.ends_with(']') {
        let tile = |number| Some(Tile { number, bytes: asset::bytes(py, &place.replace(UDIM, &format!("{number}"))).ok()?.into() });
        return Ok(TextureSource::Tiles { name: place.to_owned(), tiles: TILES.filter_map(tile).collect() });
    }
    if place.contains(UDIM) || Path::new(place).is_file() {
        return Ok(TextureSource::File(place.into()));
    }
    // Inside a package, or behind a resolver of its own: only the asset system can open it.
    let bytes = asset::bytes(py, place).map_err(|problem| format!("the image '{place}' {problem}"))?;
    let name = place.trim_end_matches(']').rsplit(['/', '[']).next().unwrap_or(place).to_owned();
    Ok(TextureSource::Encoded { name, bytes: Arc::from(bytes) })
}

/// The content of the file that an attribute names, by a path or by text; an error that names it where there is none.
pub(crate) fn image_source(py: Python<'_>, path: &AssetPath, attribute: &Attribute<'_>) -> Result<TextureSource, String> {
    let place = if path.resolved.is_empty() { resolve_text(attribute, &path.authored) } else { path.resolved.clone() };
    if place.is_empty() { Err(format!("the image '{}' does not exist", path.authored)) } else { open(py, &place) }
}

/// The image that an asset-valued attribute names, added to the scene once for each file and colour space; `None`, with a warning that names
/// the prim and the file, where there is no such image.
pub(crate) fn texture(
    context: &mut Context<'_, '_>,
    origin: &Origin,
    path: &AssetPath,
    attribute: &Attribute<'_>,
    colour_space: &str,
) -> Option<TextureId> {
    let AssetPath { authored, resolved } = path;
    let place = if resolved.is_empty() { resolve_tiles(attribute, authored) } else { resolved.clone() };
    texture_at(context, origin, authored, &place, colour_space)
}

/// The image `authored` that lies at a place, which is empty where there is none; see [`texture`].
pub(super) fn texture_at(
    context: &mut Context<'_, '_>,
    origin: &Origin,
    authored: &str,
    place: &str,
    colour_space: &str,
) -> Option<TextureId> {
    let key = format!("{place}\n{colour_space}");
    if let Some(id) = context.texture_ids.get(&key) {
        return Some(*id);
    }
    let source = if place.is_empty() { Err(format!("the image '{authored}' does not exist")) } else { open(context.py, place) };
    match source {
        Ok(source) => {
            let id = context.scene.add_texture(Texture { origin: origin.clone(), source, colour_space: colour_space.to_owned() });
            context.texture_ids.insert(key, id);
            Some(id)
        }
        Err(problem) => {
            let file = if place.is_empty() { authored } else { place };
            context.once("image", file, origin, || format!("{problem}; a constant value takes its place"));
            None
        }
    }
}

impl Network<'_> {
    /// The image in a shader's `file` input; see [`Network::texture_of`].
    pub(in crate::material) fn texture(&mut self, shader: &Shader, stated: Option<&str>, unstated: &str) -> Option<TextureId> {
        self.texture_of(shader, "file", stated, unstated)
    }

    /// The image in a shader's input; `stated` is the colour space that the shader says, `unstated` what holds where nobody says one.
    /// `None`, with a warning, where there is no image.
    pub(in crate::material) fn texture_of(
        &mut self,
        shader: &Shader,
        input: &str,
        stated: Option<&str>,
        unstated: &str,
    ) -> Option<TextureId> {
        let said = match self.source(shader, input) {
            Source::Output(node, _) => self.text_of_primvar(node),
            Source::Value(value, said) => Some((value, said)),
            Source::Nothing | Source::Geometric(_) | Source::Unreadable(_) => None,
        };
        let (path, said) = match said {
            Some((Value::Asset(path), said)) if !path.authored.is_empty() => (path, said),
            Some((Value::Text(authored), said)) if !authored.is_empty() => (AssetPath { authored, resolved: said.resolved.clone() }, said),
            _ => {
                self.warn(shader, "no image file is named; the fallback value is used");
                return None;
            }
        };
        let own = stated.unwrap_or(&said.space);
        let mut space = if own.is_empty() { unstated } else { own };
        if ColourSpace::parse(space).is_err() {
            self.warn(shader, format!("the image '{}' has the unknown colour space '{space}'; '{unstated}' is used", path.authored));
            space = unstated;
        }
        self.host.texture(&shader.path, &path, space)
    }

    /// The file that a primvar of the shaded prim names, through a shader that reads it.
    fn text_of_primvar(&mut self, reader: NodeIndex) -> Option<(Value, Said)> {
        let reader = self.shader(reader);
        let input = match &*reader.id {
            "UsdPrimvarReader_string" => "varname",
            "ND_geompropvalue_string"
            | "ND_geompropvalue_filename"
            | "ND_geompropvalueuniform_string"
            | "ND_geompropvalueuniform_filename" => "geomprop",
            "arnold:user_data_string" => "attribute",
            _ => {
                self.warn(&reader, format!("shader node '{}' gives no file name", reader.id));
                return None;
            }
        };
        let name = self.text(&reader, input).filter(|name| !name.is_empty())?;
        self.host.text_of_primvar(&name)
    }

    /// The texture coordinates of the given set: `st`, `st1`, …
    pub(in crate::material) fn texture_coordinates(&mut self, set: u32) -> Input {
        let name = if set == 0 { "st".to_owned() } else { format!("st{set}") };
        self.primvar(name, [0.0; 4])
    }
}
