//! `gonio sensor`.

use super::{
    arguments::SensorOptions,
    channel::{empty_picture, picture_of},
    file::{self, check_ending, check_targets, print_path, write_or_keep},
    spectrum,
    wavelengths::Wavelengths,
};
use gonio::{
    Error, Result,
    output::{ExrOptions, Further, read_exr, view_of_exr, write_exr_with},
};
use gonio_spectrum::{CieObserver, Response, Spectrum, rec709_of_white};
use std::path::Path;

/// Sees a picture by wavelength as a sensor does.
pub(super) fn sensor(options: &SensorOptions) -> Result<i32> {
    check_ending("output", &options.output, &["exr"])?;
    check_targets([&options.output])?;
    let observer = observer(&options.response);
    let response = observer.map_or_else(|| of_file(&options.response), |observer| Ok(observed(observer)))?;
    let white = options.white.as_deref().filter(|name| *name != "none").map(spectrum::one).transpose()?;
    let (channels, size) = read_exr(&options.image)?;
    let found = Wavelengths::of(&options.image, &channels, "no picture by wavelength")?;
    let weights = weights(&found, &response, white.as_ref())?;
    let further: Further = response.names.iter().cloned().zip(weights.iter().map(|weights| found.sum(weights))).collect();
    let has_colour = observer.is_some() && white.is_some();
    let mut image = if has_colour { picture_of(colours(&further), size) } else { empty_picture(size) };
    image.frame.view = view_of_exr(&options.image)?;
    write_or_keep(&options.output, |path| write_exr_with(path, &image, &further, &ExrOptions::default()))?;
    if !options.quiet {
        print_path(&options.output);
    }
    Ok(0)
}

/// The observer that a name means, where there is no such file.
fn observer(name: &Path) -> Option<CieObserver> {
    name.to_str().filter(|_| !name.exists()).and_then(CieObserver::by_name)
}

fn of_file(path: &Path) -> Result<Response> {
    let bytes = file::read(path, spectrum::LONGEST, "sensor")?;
    Response::read(&bytes).map_err(|error| Error::in_file(path, &error))
}

/// An observer as a sensor.
fn observed(observer: CieObserver) -> Response {
    let wavelengths_nm: Vec<f64> = (360..=830).map(f64::from).collect();
    let curve = |k: usize| wavelengths_nm.iter().map(|nm| observer.at(*nm)[k]).collect();
    Response { names: ["X", "Y", "Z"].map(str::to_owned).to_vec(), curves: (0..3).map(curve).collect(), wavelengths_nm }
}

/// Linear Rec.709 and full coverage of X, Y and Z that are 1 for the white.
fn colours(seen: &Further) -> Vec<f32> {
    let [x, y, z] = [0, 1, 2].map(|k| &seen[k].1);
    let of_pixel = |((x, y), z): ((&f32, &f32), &f32)| {
        let [r, g, b] = rec709_of_white([*x, *y, *z].map(f64::from)).map(|part| part as f32);
        [r, g, b, 1.0]
    };
    x.iter().zip(y).zip(z).flat_map(of_pixel).collect()
}

/// By channel and band, what a radiance of 1 W/(m² sr nm) there adds to the channel. With a white, its light of 1 cd/m² is 1 in all channels.
fn weights(found: &Wavelengths<'_>, response: &Response, white: Option<&Spectrum>) -> Result<Vec<Vec<f64>>> {
    let widths = found.widths();
    let by_band: Vec<Vec<f64>> = found.nm.iter().map(|nm| response.at(*nm)).collect();
    let mut weights: Vec<Vec<f64>> =
        (0..response.names.len()).map(|channel| by_band.iter().zip(&widths).map(|(band, width)| band[channel] * width).collect()).collect();
    let Some(white) = white else { return Ok(weights) };
    let luminous = white.luminous();
    for (channel, weights) in response.names.iter().zip(&mut weights) {
        let of_white: f64 = found.nm.iter().zip(weights.iter()).map(|(nm, weight)| weight * white.at(*nm) / luminous).sum();
        if of_white.is_nan() || of_white <= 0.0 {
            return Err(Error::setting("white", format!("channel {channel} sees nothing of this white; --white none leaves it as it is")));
        }
        weights.iter_mut().for_each(|weight| *weight /= of_white);
    }
    Ok(weights)
}
