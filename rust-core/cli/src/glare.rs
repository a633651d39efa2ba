//! `gonio glare`.

use super::{arguments::GlareArguments, channel::Picture, falsecolor::write, file::check_ending, print, radiance};
use gonio::{
    Error, Result,
    measure::glare::{Coverage, FisheyeProjection, FisheyeView, Glare, GlareOptions, GlareSource, Threshold},
    output::{Canvas, FalseColourScale},
};
use serde_json::{Value, json};

/// Colours that sources take in turn.
const COLOURS: u32 = 8;

/// Finds the sources and rates them.
pub(super) fn glare(options: &GlareArguments) -> Result<i32> {
    if let Some(path) = &options.output {
        check_ending("output", path, &["png"])?;
    }
    let picture = Picture::read(&options.image, &options.quantity)?;
    let (projection, fov) = projection(options, &picture)?;
    let view = FisheyeView::new(projection, fov, picture.size)?;
    let found = Glare::new(picture.values(), &view, &glare_options(options))?;
    if let Some(path) = &options.output {
        write(path, &drawn(&picture, &found)?)?;
    }
    if options.json {
        print(&as_json(&found).to_string());
    } else {
        as_text(&found).iter().for_each(|line| print(line));
    }
    Ok(0)
}

/// How the picture was taken: as the options say, else as the picture does, else an even half of the world.
fn projection(options: &GlareArguments, picture: &Picture) -> Result<(FisheyeProjection, f64)> {
    let asked = options.projection.as_ref().map(|name| {
        FisheyeProjection::by_name(name).ok_or_else(|| {
            let expected = FisheyeProjection::NAMES.map(|(_, name)| name).join(", ");
            Error::setting("projection", format!("'{name}' was found, expected one of {expected}"))
        })
    });
    let asked = asked.transpose()?;
    let own = match &picture.view {
        Some(view) if asked.is_none() || options.fov.is_none() => radiance::fisheye(view).map(Some),
        _ => Ok(None),
    };
    let own = own.or_else(|problem| if asked.is_some() { Ok(None) } else { Err(Error::setting("projection", problem)) })?;
    let (projection, fov) = own.unwrap_or((FisheyeProjection::Equidistant, 180.0));
    Ok((asked.unwrap_or(projection), options.fov.unwrap_or(fov)))
}

fn glare_options(options: &GlareArguments) -> GlareOptions {
    let threshold = options.threshold.map_or(GlareOptions::default().threshold, Threshold::Luminance);
    GlareOptions { threshold, radius: options.radius }
}

/// Degrees to the right and up.
fn angles(source: &GlareSource) -> [f64; 2] {
    let [right, up, ahead] = source.direction;
    [right.atan2(ahead).to_degrees(), up.clamp(-1.0, 1.0).asin().to_degrees()]
}

fn as_json(glare: &Glare) -> Value {
    let source = |source: &GlareSource| {
        json!({
            "luminance_cd_m2": source.luminance,
            "solid_angle_sr": source.solid_angle,
            "position_index": source.position_index,
            "cie_position_index": source.cie_position_index(),
            "eye_illuminance_lx": source.illuminance,
            "direction_deg": angles(source),
        })
    };
    json!({
        "ugr": glare.ugr(),
        "ugr_coverage": coverage_json(&glare.coverage()),
        "dgp": glare.dgp(),
        "dgp_low_light": glare.dgp_low_light(),
        "eye_illuminance_lx": glare.eye_illuminance,
        "background_luminance_cd_m2": glare.background_luminance,
        "mean_luminance_cd_m2": glare.mean_luminance,
        "threshold_cd_m2": glare.threshold,
        "sources": glare.sources.iter().map(source).collect::<Vec<_>>(),
    })
}

/// What a rating leaves out, for machines.
pub(super) fn coverage_json(coverage: &Coverage) -> Value {
    json!({
        "sources": coverage.sources,
        "left_out": coverage.left_out(),
        "too_high": coverage.high,
        "too_far_aside": coverage.aside,
        "below": coverage.below,
        "larger_than_0_1_sr": coverage.large,
        "share_left_out": coverage.share_left_out(),
    })
}

/// The rating, or why there is none, and what it leaves out.
fn ugr_line(glare: &Glare) -> String {
    let coverage = glare.coverage();
    let rating = match glare.ugr() {
        Some(ugr) => format!("UGR: {ugr:.1}"),
        None if coverage.sources > coverage.left_out() => "UGR: not defined, the background is black".to_owned(),
        None => "UGR: no source of glare ahead".to_owned(),
    };
    coverage.note().map_or(rating.clone(), |note| format!("{rating} ({note})"))
}

/// The rating, line by line.
pub(super) fn as_text(glare: &Glare) -> Vec<String> {
    let mut lines = vec![
        ugr_line(glare),
        format!("DGP: {:.3} ({:.3} with the correction for little light)", glare.dgp(), glare.dgp_low_light()),
        format!("at the eye: {:.1} lx", glare.eye_illuminance),
        format!("background: {:.2} cd/m², mean: {:.2} cd/m²", glare.background_luminance, glare.mean_luminance),
        format!("sources from {:.0} cd/m²: {}", glare.threshold, glare.sources.len()),
    ];
    lines.extend(glare.sources.iter().map(|source| {
        let [right, up] = angles(source);
        let (luminance, solid_angle, index) = (source.luminance, source.solid_angle, source.position_index);
        let of_ugr = source.cie_position_index().map_or("left out of UGR".to_owned(), |index| format!("UGR's {index:.2}"));
        format!("  {luminance:.0} cd/m², {solid_angle:.5} sr, {right:.1}° right, {up:.1}° up, position index {index:.2} ({of_ugr})")
    }));
    lines
}

/// The picture in grey with the sources in colours.
fn drawn(picture: &Picture, glare: &Glare) -> Result<Canvas> {
    let colours = FalseColourScale::new(1.0, COLOURS, None)?;
    let white = 4.0 * glare.mean_luminance.max(f64::MIN_POSITIVE);
    let mut canvas = Canvas::new(picture.size, [0, 0, 0, 255]);
    for (index, value) in picture.values().iter().enumerate() {
        let grey = (255.0 * (f64::from(*value).max(0.0) / white).min(1.0).powf(1.0 / 2.2)) as u8;
        let [r, g, b] = match glare.source_of[index] {
            0 => [grey; 3],
            source => colours.colour(((source - 1) % COLOURS) as usize),
        };
        canvas.set([index % picture.size[0], index / picture.size[0]], [r, g, b, 255]);
    }
    Ok(canvas)
}
