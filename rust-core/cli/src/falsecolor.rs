//! `gonio falsecolor`.

use super::{
    arguments::{FalsecolorOptions, ScaleArguments},
    channel::{Picture, colour_of, picture_of},
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
    FalseColourScale::of_values(values, arguments.max, arguments.steps, arguments.log, false)
}

/// The scale of a picture; figures of colour have no meaning at 0.
fn of_quantity(options: &FalsecolorOptions, values: &[f32]) -> Result<FalseColourScale> {
    let is_of_colour = ["cct", "duv", "ra", "rf", "rg"].iter().any(|name| options.quantity.eq_ignore_ascii_case(name));
    let ScaleArguments { max, steps, log } = options.scale;
    FalseColourScale::of_values(values, max, steps, log, is_of_colour)
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
    let [red, green, blue] = colour_of(path, &picture.channels, "--lines wants the colour channels R, G and B under the lines")?;
    let values = red.iter().zip(green).zip(blue).flat_map(|((r, g), b)| [*r, *g, *b, 1.0]).collect();
    let image = picture_of(values, picture.size);
    Ok(Canvas { rgba: display(&image, &Look::default(), Execution::detect()), size: picture.size })
}
