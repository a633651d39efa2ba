//! `gonio falsecolor`.

use super::{
    arguments::{FalsecolorOptions, ScaleArguments},
    channel::{Picture, picture_of},
    file::{check_ending, check_targets, print_path, put},
};
use gonio::{
    Error, Result,
    output::{Canvas, FalseColour, FalseColourScale, Look, display, encode_png},
};
use gonio_simd::Execution;
use std::path::Path;

/// Draws the picture.
pub(super) fn falsecolor(options: &FalsecolorOptions) -> Result<i32> {
    check_ending("output", &options.output, &["png"])?;
    check_targets([&options.output])?;
    let picture = Picture::read(&options.image, &options.quantity)?;
    let style = FalseColour {
        scale: of_quantity(options, picture.values())?,
        unit: Picture::unit(&options.quantity).into(),
        contours: options.contours || options.lines,
        smoothing: options.smooth,
        legend: !options.no_legend,
    };
    let canvas = if options.lines {
        style.draw_over(picture.values(), tone_mapped(&picture, &options.image)?)
    } else {
        style.draw(picture.values(), picture.size)
    };
    write(&options.output, &canvas)?;
    print_path(&options.output);
    Ok(0)
}

/// The steps that were asked for, up to what the values ask for where nothing is said.
pub(super) fn scale(arguments: &ScaleArguments, values: &[f32]) -> Result<FalseColourScale> {
    let max = arguments.max.unwrap_or_else(|| FalseColourScale::round_max(values));
    FalseColourScale::new(max, arguments.steps, arguments.log)
}

/// The scale of a picture; of CCT and Duv, whose 0 means nothing, from the least to the greatest unless a greatest is asked for.
fn of_quantity(options: &FalsecolorOptions, values: &[f32]) -> Result<FalseColourScale> {
    let is_of_colour = ["cct", "duv"].iter().any(|name| options.quantity.eq_ignore_ascii_case(name));
    let even = scale(&options.scale, values)?;
    Ok(if is_of_colour && options.scale.max.is_none() { FalseColourScale::around(values, options.scale.steps) } else { even })
}

/// A canvas as a PNG file's bytes, for the file at a path.
pub(super) fn encoded(path: &Path, canvas: &Canvas) -> Result<Vec<u8>> {
    let [width, height] = canvas.size.map(|side| side as u32);
    encode_png(&canvas.rgba, width, height).map_err(|error| Error::io(path, error))
}

/// Writes a canvas as PNG.
pub(super) fn write(path: &Path, canvas: &Canvas) -> Result<()> {
    put(path, &encoded(path, canvas)?)
}

/// The colour channels as the eye would see them, opaque.
fn tone_mapped(picture: &Picture, path: &Path) -> Result<Canvas> {
    let colour = |name: &str| {
        let found = picture.channels.iter().find(|(known, _)| known == name || known.ends_with(&format!("Combined.{name}")));
        let problem = || format!("--lines wants the colour channels R, G and B under the lines; there is no {name}");
        found.map(|(_, values)| values).ok_or_else(|| Error::Format { path: path.to_owned(), line: None, problem: problem() })
    };
    let [red, green, blue] = [colour("R")?, colour("G")?, colour("B")?];
    let values = red.iter().zip(green).zip(blue).flat_map(|((r, g), b)| [*r, *g, *b, 1.0]).collect();
    let image = picture_of(values, picture.size);
    Ok(Canvas { rgba: display(&image, &Look::default(), Execution::detect()), size: picture.size })
}
