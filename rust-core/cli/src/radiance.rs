//! Calibrated Radiance pictures: their luminances and how they were taken.

use gonio::{
    Error, Result,
    measure::glare::FisheyeProjection,
    output::Channels,
    texture::{RadianceHeader, Source, TextureError, load_image},
};
use std::path::Path;

/// Whether a file is a Radiance picture, by its first bytes.
pub(super) fn is_radiance(bytes: &[u8]) -> bool {
    bytes.starts_with(b"#?")
}

/// Linear Rec.709 with its luminance in cd/m², and the luminance, of a picture's bytes, with width and height; and its view.
pub(super) fn read(path: &Path, bytes: Vec<u8>) -> Result<(Channels, [usize; 2], Option<String>)> {
    let failed = |error: TextureError| Error::Format { path: path.to_owned(), line: None, problem: error.what };
    let header = RadianceHeader::read(&bytes).map_err(failed)?;
    let image = load_image(&Source::Bytes { name: path.to_string_lossy().into(), bytes: bytes.into() }).map_err(failed)?;
    let weights = header.luminance_weights();
    let efficacy: f64 = weights.iter().sum();
    let to_rec709 = header.primaries.and_then(|primaries| primaries.to_rec709());
    let mut channels: Channels = ["R", "G", "B", "Luminance"].map(|name| (name.to_owned(), Vec::with_capacity(image.len()))).into();
    for index in 0..image.len() {
        let [r, g, b, _] = image.rgba(index).map(f64::from);
        let colour = to_rec709.map_or([r, g, b], |matrix| gonio::colour::apply(&matrix, [r, g, b]));
        let luminance = weights[0] * r + weights[1] * g + weights[2] * b;
        let values = [colour[0] * efficacy, colour[1] * efficacy, colour[2] * efficacy, luminance];
        channels.iter_mut().zip(values).for_each(|((_, channel), value)| channel.push(value as f32));
    }
    Ok((channels, [image.width as usize, image.height as usize], header.view))
}

/// The fisheye that a view of Radiance is, and its full field of view in degrees.
///
/// # Errors
/// The view is none, in its own words.
pub(super) fn fisheye(view: &str) -> Result<(FisheyeProjection, f64), String> {
    let words: Vec<&str> = view.split_whitespace().collect();
    let projection = match words.iter().rev().find(|word| word.starts_with("-vt")) {
        Some(&"-vta") => FisheyeProjection::Equidistant,
        Some(&"-vth") => FisheyeProjection::Hemispherical,
        other => return Err(format!("the picture's view is {}, expected the fisheye -vta or -vth", other.unwrap_or(&"-vtv"))),
    };
    let angle = |name: &str| words.windows(2).rev().find(|pair| pair[0] == name).and_then(|pair| pair[1].parse::<f64>().ok());
    match (angle("-vh"), angle("-vv")) {
        (Some(across), Some(down)) if (across - down).abs() < 0.01 => Ok((projection, across)),
        _ => Err("the picture's view has no -vh and -vv that are alike".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fisheyes_are_told_from_other_views() {
        assert_eq!(fisheye("-vta -vp 1 2 3 -vd 0 1 0 -vh 180 -vv 180"), Ok((FisheyeProjection::Equidistant, 180.0)));
        assert_eq!(fisheye("-vtv -vta -vth -vh 120 -vv 120 -vo 0"), Ok((FisheyeProjection::Hemispherical, 120.0)));
        for other in ["-vtv -vh 45 -vv 45", "-vh 45 -vv 45", "-vta -vh 180 -vv 90", "-vta", "-vts -vh 180 -vv 180"] {
            assert!(fisheye(other).is_err(), "{other}");
        }
    }
}
