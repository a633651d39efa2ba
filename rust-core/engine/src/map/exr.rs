//! A map as an OpenEXR texture.

use super::{
    dilate::dilate,
    gather::{Chart, SurfaceMap},
    side::{PartColour, SideMap},
};
use crate::{
    error::{Error, Result},
    output::write_atomically,
};
use exr::prelude::{AnyChannel, AnyChannels, AttributeValue, Encoding, FlatSamples, Layer, LayerAttributes, Text, WritableImage};
use std::path::Path;

/// Texels by which values go beyond the borders of charts.
const DILATION: u32 = 8;
/// Channels of the figures of colour.
const NAMES: [&str; 6] = ["CCT", "Duv", "Ra", "Rf", "Rg", "MelanopicEDI"];

/// Writes a map on texels as 32-bit floats, lux: R, G and B (all the illuminance where no colours were kept), `Illuminance`, `Direct` and
/// `StandardError` of the front, and where figures of colour were asked for `CCT`, `Duv`, `Ra`, `Rf`, `Rg` and `MelanopicEDI` with a `.StandardError` each; those
/// of the back begin with `Back.`. Values go 8 texels beyond the surface, all others are 0.
///
/// # Errors
/// Maps on divided triangles, and what the system refuses.
pub fn write_map_exr(path: &Path, map: &SurfaceMap) -> Result<()> {
    let Chart::Texels(chart) = &map.chart else {
        return Err(Error::setting("output", "a texture wants texture coordinates: --uv st"));
    };
    let [width, height] = chart.size();
    let none = SideMap::default();
    let sides = [("", map.sides[0].as_ref().unwrap_or(&none)), ("Back.", map.sides[1].as_ref().unwrap_or(&none))];
    let mut list = Vec::new();
    let maps_figures = sides.iter().any(|(_, side)| !side.figures.is_empty());
    // The front is always there, as textures are read by their names.
    for (prefix, side) in sides.into_iter().filter(|(prefix, side)| prefix.is_empty() || !side.illuminance.is_empty()) {
        let mut add = |name: &str, values: Vec<f32>| {
            let mut values = if values.is_empty() { vec![0.0; chart.len()] } else { values };
            dilate(&mut values, chart.size(), DILATION);
            values.iter_mut().filter(|value| value.is_nan()).for_each(|value| *value = 0.0);
            list.push(AnyChannel::new(Text::from(format!("{prefix}{name}").as_str()), FlatSamples::F32(values)));
        };
        for (channel, name) in ["R", "G", "B"].into_iter().enumerate() {
            let colour: Vec<f32> = side.colour.iter().map(|colour| colour[channel]).collect();
            add(name, if colour.is_empty() { side.illuminance.clone() } else { colour });
        }
        add("Illuminance", side.illuminance.clone());
        add("Direct", side.direct.clone());
        add("StandardError", side.standard_error.clone());
        for (name, figure) in NAMES.iter().zip(PartColour::FIGURES).filter(|_| maps_figures) {
            let of = |which: usize| side.figures.iter().map(|colour| colour.of(figure)[which]).collect();
            add(name, of(0));
            add(&format!("{name}.StandardError"), of(1));
        }
    }
    let mut attributes =
        LayerAttributes { software_name: Some(Text::from(concat!("gonio ", env!("CARGO_PKG_VERSION")))), ..LayerAttributes::default() };
    attributes.other.insert(Text::from("gonio:unit:Illuminance"), AttributeValue::Text(Text::from("lx")));
    let layer =
        Layer::new((width as usize, height as usize), attributes, Encoding::FAST_LOSSLESS, AnyChannels::sort(list.into_iter().collect()));
    write_atomically(path, true, |file| {
        exr::image::Image::from_layer(layer).write().to_buffered(file).map_err(|error| match error {
            exr::error::Error::Io(error) => error,
            other => std::io::Error::other(other.to_string()),
        })
    })
}
