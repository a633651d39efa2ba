//! `gonio glare`.

use super::{
    arguments::GlareArguments,
    channel::Picture,
    falsecolor::write,
    file::{check_ending, check_targets},
    messages::print,
    rating_words,
    words::Words,
};
use gonio::{
    Error, Result,
    film::PictureView,
    measure::glare::{Coverage, EyeView, Glare, GlareOptions, GlareSource, Threshold},
    output::{Canvas, FalseColourScale},
};
use gonio_page::fill;
use serde_json::{Value, json};

/// Colours that sources take in turn.
const COLOURS: u32 = 8;

/// Finds the sources and rates them.
pub(super) fn glare(options: &GlareArguments) -> Result<i32> {
    if let Some(path) = &options.output {
        check_ending("output", path, &["png"])?;
        check_targets([path])?;
    }
    let picture = Picture::read(&options.image, &options.quantity)?;
    let view = EyeView::new(view(options, &picture)?, picture.size)?;
    let found = Glare::new(picture.values(), &view, &glare_options(options)?)?;
    if let Some(path) = &options.output {
        write(path, &drawn(&picture, &found)?)?;
    }
    if options.json {
        print(&as_json(&found).to_string());
    } else {
        as_text(&found, Words::english()).iter().for_each(|line| print(line));
    }
    Ok(0)
}

/// How the picture was taken: as the options say, else as the picture does.
fn view(options: &GlareArguments, picture: &Picture) -> Result<PictureView> {
    let Some(name) = &options.projection else {
        let how = "--projection says it: perspective with --fov across, equidistant, equisolid or hemispherical";
        let problem = match &picture.view {
            Ok(Some(view)) => return Ok(*view),
            Ok(None) => format!("{} does not say how it was taken; {how}", options.image.display()),
            Err(problem) => format!("{problem}; {how}"),
        };
        return Err(Error::setting("projection", problem));
    };
    let fov = match options.fov {
        Some(fov) => fov,
        None if name == "perspective" => return Err(Error::setting("fov", "a perspective wants its field of view across, degrees")),
        None => 180.0,
    };
    PictureView::by_name(name, fov, picture.size[0] as f64 / picture.size[1].max(1) as f64)
}

fn glare_options(options: &GlareArguments) -> Result<GlareOptions> {
    let threshold = match options.threshold.strip_suffix('x') {
        Some(times) => times.parse().map(Threshold::TimesMean),
        None => options.threshold.parse().map(Threshold::Luminance),
    };
    let wrong =
        |_| Error::setting("threshold", format!("'{}' was found, expected cd/m², or 5x for five times the mean", options.threshold));
    let peak = (options.peak != 0.0).then_some(options.peak);
    Ok(GlareOptions { threshold: threshold.map_err(wrong)?, radius: options.radius, peak, illuminance: options.illuminance })
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
        "seen_illuminance_lx": glare.seen_illuminance,
        "share_seen": glare.seen,
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
        "behind_covers": coverage.covered,
    })
}

/// The rating, or why there is none, and what it leaves out.
fn ugr_line(glare: &Glare, words: &Words) -> String {
    let (coverage, say) = (glare.coverage(), &words.glare);
    let rating = match glare.ugr() {
        Some(ugr) => fill(&say.ugr, &[("value", &words.numbers.fixed(ugr, 1))]),
        None if coverage.sources > coverage.left_out() => say.black.clone(),
        None => say.no_source.clone(),
    };
    let part = (glare.seen < 1.0).then(|| fill(&say.part, &[("percent", &format!("{:.0}", 100.0 * glare.seen))]));
    let notes: Vec<String> = part.into_iter().chain(rating_words::coverage(&coverage, words)).collect();
    if notes.is_empty() { rating } else { format!("{rating} ({})", notes.join("; ")) }
}

/// The probability and the light at the eye, or why they are not known.
fn eye_lines(glare: &Glare, words: &Words) -> [String; 2] {
    let (say, numbers) = (&words.glare, words.numbers);
    match (glare.dgp(), glare.dgp_low_light(), glare.eye_illuminance) {
        (Some(dgp), Some(low), Some(illuminance)) => [
            fill(&say.dgp, &[("value", &numbers.fixed(dgp, 3)), ("low", &numbers.fixed(low, 3))]),
            fill(&say.at_eye, &[("illuminance", &numbers.fixed(illuminance, 1))]),
        ],
        _ => [say.no_dgp.clone(), fill(&say.no_light, &[("illuminance", &numbers.fixed(glare.seen_illuminance, 1))])],
    }
}

/// The rating, line by line.
pub(super) fn as_text(glare: &Glare, words: &Words) -> Vec<String> {
    let (say, numbers) = (&words.glare, words.numbers);
    let [dgp, eye] = eye_lines(glare, words);
    let [background, mean] = [glare.background_luminance, glare.mean_luminance].map(|value| numbers.fixed(value, 2));
    let (threshold, count) = (format!("{:.0}", glare.threshold), glare.sources.len().to_string());
    let mut lines = vec![
        ugr_line(glare, words),
        dgp,
        eye,
        fill(&say.background, &[("background", &background), ("mean", &mean)]),
        fill(&say.sources, &[("threshold", &threshold), ("count", &count)]),
    ];
    lines.extend(glare.sources.iter().map(|source| {
        let [right, up] = angles(source).map(|angle| numbers.fixed(angle, 1));
        let index = numbers.fixed(source.position_index, 2);
        let of_ugr = |index: f64| fill(&say.of_ugr, &[("index", &numbers.fixed(index, 2))]);
        let of_ugr = source.cie_position_index().map_or(say.left_out.clone(), of_ugr);
        let (luminance, solid_angle) = (format!("{:.0}", source.luminance), numbers.fixed(source.solid_angle, 5));
        let values = [("luminance", luminance.as_str()), ("solid_angle", &solid_angle), ("right", &right), ("up", &up)];
        fill(&say.source, &[&values[..], &[("index", &index), ("of_ugr", &of_ugr)]].concat())
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
