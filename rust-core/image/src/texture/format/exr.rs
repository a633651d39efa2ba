//! OpenEXR: the first part, flat, of half, float or integer channels; scan lines or tiles (the finest level).

use crate::colour::{Primaries, Stated};
use crate::texture::error::{TextureError, TextureErrorKind};
use crate::texture::image::{Image, Texels};
use crate::texture::limits::check_size;
use exr::image::read::image::ReadLayers;
use exr::image::read::{layers::ReadChannels, read};
use exr::image::{AnyChannels, FlatSamples};
use exr::math::Vec2;
use exr::meta::attribute::Chromaticities;
use exr::meta::header::Header;
use half::f16;
use std::io::Cursor;

/// Names of the channels that make one texel; grey is tried behind RGB and XYZ.
const SETS: [&[&str]; 4] = [&["R", "G", "B"], &["r", "g", "b"], &["X", "Y", "Z"], &["Y"]];

/// The first part's image within its display window: RGB(A), Y(A), XYZ as RGB, else its first layer or its only channel as grey.
pub(crate) fn decode(bytes: &[u8]) -> Result<Image, TextureError> {
    let chunks = exr::block::read(Cursor::new(bytes), false).map_err(from_decoder)?;
    let header = chunks.meta_data().headers.first().ok_or_else(|| TextureError::malformed("the file has no part"))?;
    check_header(header, bytes.len())?;
    let names: Vec<String> = header.channels.list.iter().map(|channel| channel.name.to_string()).collect();
    let window = Window::of(header);
    let stated = header.shared_attributes.chromaticities.map_or(Stated::Nothing, |stated| Stated::linear(&primaries_of(stated)));
    let chosen = choose_channels(&names);
    // Decoding in this thread: a damaged block must not panic in a thread of the crate's own pool.
    let reader = read().no_deep_data().largest_resolution_level().all_channels().first_valid_layer().all_attributes().non_parallel();
    let image = reader.from_chunks(chunks).map_err(from_decoder)?;
    let texels = interleave(&image.layer_data.channel_data, &chosen, &window)?;
    Ok(Image { width: window.size.0 as u32, height: window.size.1 as u32, channels: chosen.len() as u32, texels, stated })
}

fn from_decoder(error: exr::error::Error) -> TextureError {
    match error {
        exr::error::Error::NotSupported(what) => TextureError::new(TextureErrorKind::Unsupported, format!("OpenEXR: {what}")),
        other => TextureError::malformed(format!("OpenEXR: {other}")),
    }
}

fn check_header(header: &Header, file_len: usize) -> Result<(), TextureError> {
    let unsupported = |what: &str| Err(TextureError::new(TextureErrorKind::Unsupported, what).hint("save it as flat RGB"));
    if header.deep {
        return unsupported("the file's first part holds deep samples");
    }
    if header.channels.list.iter().any(|channel| channel.sampling != Vec2(1, 1)) {
        return unsupported("the file's channels are subsampled (luminance and chroma)");
    }
    // All channels are decoded before some are chosen, and the chosen ones are copied.
    let texel_bytes: usize = header.channels.list.iter().map(|channel| channel.sample_type.bytes_per_sample()).sum();
    check_size(header.layer_size.0 as u64, header.layer_size.1 as u64, texel_bytes as u64, file_len)?;
    let display = header.shared_attributes.display_window.size;
    check_size(display.0 as u64, display.1 as u64, 16, file_len)
}

fn primaries_of(stated: Chromaticities) -> Primaries {
    let [red, green, blue, white] = [stated.red, stated.green, stated.blue, stated.white].map(|xy| [f64::from(xy.0), f64::from(xy.1)]);
    Primaries { red, green, blue, white }
}

/// Where the data lie in the picture.
struct Window {
    /// The display window's width and height.
    size: (usize, usize),
    data_size: (usize, usize),
    /// The data window's corner, seen from the display window's.
    offset: (i64, i64),
}

impl Window {
    fn of(header: &Header) -> Self {
        let (display, data) = (header.shared_attributes.display_window, header.own_attributes.layer_position);
        let offset = |data: i32, display: i32| i64::from(data) - i64::from(display);
        Self {
            size: (display.size.0, display.size.1),
            data_size: (header.layer_size.0, header.layer_size.1),
            offset: (offset(data.0, display.position.0), offset(data.1, display.position.1)),
        }
    }

    /// The sample that fills a texel; nothing outside the data.
    fn sample(&self, texel: usize) -> Option<usize> {
        let x = usize::try_from((texel % self.size.0) as i64 - self.offset.0).ok().filter(|x| *x < self.data_size.0)?;
        let y = usize::try_from((texel / self.size.0) as i64 - self.offset.1).ok().filter(|y| *y < self.data_size.1)?;
        Some(y * self.data_size.0 + x)
    }
}

/// Indices of the channels of a texel; a colour channel that the file lacks is `None`.
fn choose_channels(names: &[String]) -> Vec<Option<usize>> {
    let mut layers: Vec<&str> = names.iter().map(|name| name.rsplit_once('.').map_or("", |(layer, _)| layer)).collect();
    layers.sort_unstable();
    layers.dedup();
    let find = |layer: &str, channel: &str| {
        let full = if layer.is_empty() { channel.to_owned() } else { format!("{layer}.{channel}") };
        names.iter().position(|name| *name == full)
    };
    for layer in layers {
        for set in SETS {
            let mut found: Vec<_> = set.iter().map(|channel| find(layer, channel)).collect();
            let present = found.iter().flatten().count();
            // X, Y, Z count only together: a lone Y is luminance.
            if present == 0 || (set[0] == "X" && present < 3) {
                continue;
            }
            // A single colour channel is a grey image, whatever its name.
            if present == 1 {
                found.retain(Option::is_some);
            }
            if let Some(alpha) = find(layer, "A").or_else(|| find(layer, "a")) {
                found.push(Some(alpha));
            }
            return found;
        }
    }
    vec![(!names.is_empty()).then_some(0)]
}

fn interleave(channels: &AnyChannels<FlatSamples>, chosen: &[Option<usize>], window: &Window) -> Result<Texels, TextureError> {
    let samples: Vec<Option<&FlatSamples>> = chosen.iter().map(|index| Some(&channels.list.get((*index)?)?.sample_data)).collect();
    let expected = window.data_size.0 * window.data_size.1;
    if samples.iter().flatten().any(|samples| samples.len() != expected) {
        return Err(TextureError::malformed("OpenEXR: a channel's samples do not fill the data window"));
    }
    let texels = window.size.0 * window.size.1;
    let all_half = samples.iter().flatten().all(|samples| matches!(samples, FlatSamples::F16(_)));
    Ok(if all_half {
        Texels::Half(gather(&samples, texels, window, |samples, at| match samples {
            FlatSamples::F16(values) => values[at],
            _ => f16::ZERO,
        }))
    } else {
        Texels::Float(gather(&samples, texels, window, |samples, at| match samples {
            FlatSamples::F16(values) => values[at].to_f32(),
            FlatSamples::F32(values) => values[at],
            FlatSamples::U32(values) => values[at] as f32,
        }))
    })
}

fn gather<T: Copy + Default>(
    samples: &[Option<&FlatSamples>],
    texels: usize,
    window: &Window,
    value: impl Fn(&FlatSamples, usize) -> T,
) -> Vec<T> {
    let mut out = Vec::with_capacity(texels * samples.len());
    for texel in 0..texels {
        let at = window.sample(texel);
        out.extend(samples.iter().map(|channel| match (channel, at) {
            (Some(channel), Some(at)) => value(channel, at),
            _ => T::default(),
        }));
    }
    out
}
