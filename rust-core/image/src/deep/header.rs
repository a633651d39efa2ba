//! Headers of deep files (OpenEXR File Layout, "Header").

use std::io::{Result, Write};

/// Names of the channels, as files sort them.
pub(super) const CHANNELS: [&str; 6] = ["A", "B", "G", "R", "Z", "ZBack"];
/// OpenEXR's number for its second version, and the bit of single deep parts.
const VERSION: u32 = 2 | 0x800;
const MAGIC: u32 = 20_000_630;
/// OpenEXR's numbers of types and methods.
const FLOAT: i32 = 2;
const ZIPS: u8 = 2;

/// What headers say beside the samples.
#[derive(Clone, Debug, PartialEq)]
pub struct DeepHeader {
    /// Width and height of the picture proper, whose corner is at 0.
    pub display: [i32; 2],
    /// Where the pixels' corner is.
    pub corner: [i32; 2],
    /// Width of a pixel over its height.
    pub pixel_aspect: f32,
    /// Luminance in cd/m² of white.
    pub white_luminance: f32,
    /// Chromaticities of red, green, blue and white; `None` is Rec.709.
    pub chromaticities: Option<[[f32; 2]; 4]>,
    /// Further text attributes.
    pub texts: Vec<(String, String)>,
}

impl DeepHeader {
    /// Writes the magic number and all attributes, for a picture of this size and most samples of a pixel.
    pub(super) fn write(&self, [width, height]: [i32; 2], most_samples: i32, out: &mut impl Write) -> Result<()> {
        out.write_all(&MAGIC.to_le_bytes())?;
        out.write_all(&VERSION.to_le_bytes())?;
        let [left, top] = self.corner;
        let window = [left, top, left + width - 1, top + height - 1];
        let display = [0, 0, self.display[0] - 1, self.display[1] - 1];
        attribute(out, "channels", "chlist", &channel_list())?;
        attribute(out, "compression", "compression", &[ZIPS])?;
        attribute(out, "dataWindow", "box2i", &integers(&window))?;
        attribute(out, "displayWindow", "box2i", &integers(&display))?;
        attribute(out, "lineOrder", "lineOrder", &[0])?;
        attribute(out, "pixelAspectRatio", "float", &self.pixel_aspect.to_le_bytes())?;
        attribute(out, "screenWindowCenter", "v2f", &floats(&[0.0, 0.0]))?;
        attribute(out, "screenWindowWidth", "float", &1_f32.to_le_bytes())?;
        attribute(out, "type", "string", b"deepscanline")?;
        attribute(out, "version", "int", &1_i32.to_le_bytes())?;
        attribute(out, "chunkCount", "int", &height.to_le_bytes())?;
        attribute(out, "maxSamplesPerPixel", "int", &most_samples.to_le_bytes())?;
        attribute(out, "whiteLuminance", "float", &self.white_luminance.to_le_bytes())?;
        if let Some(places) = &self.chromaticities {
            attribute(out, "chromaticities", "chromaticities", &floats(places.as_flattened()))?;
        }
        for (name, text) in &self.texts {
            attribute(out, name, "string", text.as_bytes())?;
        }
        out.write_all(&[0])
    }
}

fn attribute(out: &mut impl Write, name: &str, kind: &str, value: &[u8]) -> Result<()> {
    for word in [name, kind] {
        out.write_all(word.as_bytes())?;
        out.write_all(&[0])?;
    }
    out.write_all(&(value.len() as i32).to_le_bytes())?;
    out.write_all(value)
}

/// Names, types, whether perceived as linear with three unused bytes, and how many pixels share a value each way.
fn channel_list() -> Vec<u8> {
    let mut list = Vec::new();
    for name in CHANNELS {
        list.extend(name.as_bytes());
        list.push(0);
        list.extend(integers(&[FLOAT, 0, 1, 1]));
    }
    list.push(0);
    list
}

fn integers(values: &[i32]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_le_bytes()).collect()
}

fn floats(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_le_bytes()).collect()
}
