//! Calibrated Radiance pictures: their luminances and how they were taken.

use gonio::{
    Error, Result,
    film::{PictureProjection, PictureView},
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

/// How a picture with a view in Radiance's words was taken.
///
/// # Errors
/// The view is of another kind, or does not say how much it sees, in its own words.
pub(super) fn view(words: &str) -> std::result::Result<PictureView, String> {
    let words: Vec<&str> = words.split_whitespace().collect();
    // Radiance's own default is a perspective; of several words the last one counts.
    let kind = words.iter().rev().find(|word| word.starts_with("-vt")).copied().unwrap_or("-vtv");
    let numbers = |name: &str, count: usize| -> Option<Vec<f64>> {
        let at = words.iter().rposition(|word| *word == name)?;
        words.get(at + 1..at + 1 + count)?.iter().map(|word| word.parse().ok().filter(|x: &f64| x.is_finite())).collect()
    };
    let number = |name: &str| numbers(name, 1).map(|numbers| numbers[0]);
    let (Some(across), Some(down)) = (number("-vh").filter(|x| *x > 0.0), number("-vv").filter(|x| *x > 0.0)) else {
        return Err("the picture's view has no -vh and -vv".to_owned());
    };
    let most = across.max(down);
    let halves = [across, down].map(|degrees| 0.5 * degrees.to_radians());
    let half = 0.5 * most.to_radians();
    let (projection, sides, widest) = match kind {
        "-vtv" => (PictureProjection::Perspective, halves.map(f64::tan), 179.9),
        "-vtl" => (PictureProjection::Orthographic, [0.5 * across, 0.5 * down], f64::MAX),
        "-vta" => (PictureProjection::Equidistant { limit: half }, halves, 360.0),
        "-vth" => (PictureProjection::Hemispherical { limit: half.sin() }, halves.map(f64::sin), 180.0),
        other => return Err(format!("the picture's view is {other}, expected -vtv, -vta or -vth")),
    };
    if most > widest {
        return Err(format!("the picture's view {kind} sees {most}°, expected {widest}° at most"));
    }
    let edges = |side: f64, shift: &str| {
        let shift = 2.0 * side * number(shift).unwrap_or(0.0);
        [shift - side, shift + side]
    };
    let ([left, right], [bottom, top]) = (edges(sides[0], "-vs"), edges(sides[1], "-vl"));
    let vector = |name: &str| -> Option<[f64; 3]> { numbers(name, 3)?.try_into().ok() };
    let placed = match (vector("-vp"), vector("-vd"), vector("-vu")) {
        (Some(position), Some(direction), Some(up)) => Some([position, direction, up]),
        _ => None,
    };
    Ok(PictureView { projection, window: [left, right, bottom, top], placed })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn views_say_what_pictures_show() {
        let fov = |words: &str| view(words).map(|view| (view.name(), view.fov_deg().iter().map(|x| x.round()).collect::<Vec<_>>()));
        assert_eq!(fov("-vta -vp 1 2 3 -vd 0 1 0 -vh 180 -vv 180"), Ok(("equidistant", vec![180.0])));
        assert_eq!(fov("-vtv -vta -vth -vh 120 -vv 120 -vo 0"), Ok(("hemispherical", vec![120.0])));
        assert_eq!(fov("-vh 45 -vv 45"), Ok(("perspective", vec![45.0, 45.0])));
        assert_eq!(fov("-vtv -vh 90 -vv 60 -vh 50"), Ok(("perspective", vec![50.0, 60.0])));
        assert_eq!(fov("-vtl -vh 4 -vv 3").map(|view| view.0), Ok("orthographic"));
        for other in
            ["-vta", "-vts -vh 180 -vv 180", "-vtv -vh 180 -vv 90", "-vth -vh 190 -vv 190", "-vta -vh 400 -vv 90", "-vta -vh x -vv 1"]
        {
            assert!(view(other).is_err(), "{other}");
        }
        let placed = view("-vtv -vp 1 2 3 -vd 0 1 0 -vu 0 0 1 -vh 90 -vv 90 -vs .5 -vl 0").expect("a view");
        assert_eq!(placed.placed, Some([[1.0, 2.0, 3.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]));
        let near = |found: [f64; 4], expected: [f64; 4]| found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9);
        assert!(near(placed.window, [0.0, 2.0, -1.0, 1.0]), "{:?}", placed.window);
    }
}
