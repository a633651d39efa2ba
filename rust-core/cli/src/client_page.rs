//! `gonio share`.

use super::{
    arguments::{Arguments, Command, ShareOptions},
    channel::picture_of,
    file::{check_ending, check_targets, ending, print_path, put},
    messages::say,
    relight::{find, groups_of, missing, tell_missing},
    render,
    share::share as share_of,
};
use clap::Parser;
use gonio::{
    Error, Result,
    light::blackbody_rgb,
    output::{Channels, Look, display_over_black, encode_jpeg, exposure_of_exr, log_average, read_exr},
    scene::{LIGHT_GROUP, OTHER_LIGHTS},
};
use gonio_page::Language;
use gonio_share::{Group, Page, Picture, Problem, Scene, Setting, Tints, page};
use gonio_simd::Execution;
use pyo3::Python;
use std::{path::Path, sync::atomic::AtomicBool};

/// Colour temperatures that groups can be tinted with, K: those that [`blackbody_rgb`] tells apart.
const KELVINS: [u32; 2] = [1000, 10_000];
const STEP: u32 = 50;
/// The greatest factor on a group's light that a page shows.
const MOST_LEVEL: f64 = 1.5;

/// Writes the page.
pub(super) fn share(py: Python<'_>, options: &ShareOptions, interrupted: &'static AtomicBool) -> Result<i32> {
    check_ending("output", &options.output, &["html", "htm"])?;
    check_targets([&options.output])?;
    if ending(&options.picture) == "exr" {
        return py.detach(|| write(options, &options.picture));
    }
    let path = options.output.with_extension("exr");
    let status = render_groups(py, options, &path, interrupted)?;
    if status == 0 { py.detach(|| write(options, &path)) } else { Ok(status) }
}

/// Renders a stage with light groups, each lamp one by itself where the stage names none.
fn render_groups(py: Python<'_>, options: &ShareOptions, path: &Path, interrupted: &'static AtomicBool) -> Result<i32> {
    let mut words: Vec<std::ffi::OsString> = vec!["gonio".into(), "render".into(), "--lamp-groups".into(), "-o".into(), path.into()];
    let mut add = |name: &str, value: Option<String>| words.extend(value.into_iter().flat_map(|value| [name.into(), value.into()]));
    add("--camera", options.camera.clone());
    add("--image-width", options.image_width.map(|width| width.to_string()));
    add("--spp", options.spp.map(|count| count.to_string()));
    words.extend(["--".into(), options.picture.clone().into()]);
    let parsed = Arguments::try_parse_from(words).map_err(|error| Error::setting("arguments", error.to_string()))?;
    let Command::Render(mut rendering) = parsed.command else {
        return Err(Error::Internal("gonio render was expected".into()));
    };
    rendering.settle();
    render::render(py, &rendering, interrupted)
}

/// Makes the page of an EXR file.
fn write(options: &ShareOptions, path: &Path) -> Result<i32> {
    let (channels, size) = read_exr(path)?;
    let names = groups_of(path, &channels)?;
    tell_missing(missing(&channels, &names));
    let exposure = exposure_of_exr(path)?;
    let picture = picture(options, &channels, &names, size, exposure)?;
    let wrong = |problem: Problem| Error::Format { path: path.to_owned(), line: None, problem: problem.to_string() };
    let look = Look { stops: options.exposure, adapted: Some(picture.average), ..Look::default() };
    let still = |light: &[f32], [width, height]: [usize; 2]| {
        let rgba = display_over_black(&picture_of(opaque(light), [width, height]), &look, Execution::detect());
        encode_jpeg(&rgba, width as u32, height as u32).map_err(|error| error.to_string())
    };
    let page = page(&picture, still).map_err(wrong)?;
    tell(options, &picture, &page);
    put(&options.output, page.html.as_bytes())?;
    print_path(&options.output);
    Ok(0)
}

fn picture(options: &ShareOptions, channels: &Channels, names: &[String], size: [usize; 2], exposure: f32) -> Result<Picture> {
    let mut groups: Vec<Group> =
        names.iter().map(|name| Group { name: name.clone(), light: light_of(channels, name, size), watts: None }).collect();
    // The group of all lamps without one stands in every file, also where there are none.
    groups.retain(|group| group.name != OTHER_LIGHTS || names.len() == 1 || group.light.iter().any(|value| *value != 0.0));
    for text in &options.watts {
        let (name, watts) = text.rsplit_once('=').ok_or_else(|| setting("watts", text, "GROUP=W"))?;
        let place = place("watts", &groups, name)?;
        let watts = watts.trim().parse::<f64>().ok().filter(|watts| watts.is_finite() && *watts >= 0.0);
        groups[place].watts = Some(watts.ok_or_else(|| setting("watts", text, "GROUP=W with W from 0 on"))?);
    }
    let mut sum = vec![0.0; 3 * size[0] * size[1]];
    groups.iter().for_each(|group| sum.iter_mut().zip(&group.light).for_each(|(sum, light)| *sum += light));
    let stem = || options.picture.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    Ok(Picture {
        title: options.title.clone().unwrap_or_else(stem),
        size,
        exposure,
        average: log_average(&picture_of(opaque(&sum), size), Execution::detect()),
        white: Look::default().white,
        stops: options.exposure,
        tints: Tints {
            first: KELVINS[0],
            step: STEP,
            colours: (KELVINS[0]..=KELVINS[1]).step_by(STEP as usize).map(|kelvin| blackbody_rgb(kelvin as f32)).collect(),
        },
        scenes: options.scene.iter().map(|text| scene(&groups, text)).collect::<Result<_>>()?,
        groups,
        hours: options.hours,
        language: Language::of_code(&options.language),
        limit: (options.max_size * 1e6) as usize,
    })
}

/// A group's light, three values a pixel.
fn light_of(channels: &Channels, name: &str, [width, height]: [usize; 2]) -> Vec<f32> {
    let mut light = vec![0.0; 3 * width * height];
    for (k, channel) in ["R", "G", "B"].into_iter().enumerate() {
        let values = find(channels, &format!("{LIGHT_GROUP}{name}.{channel}")).unwrap_or_default();
        light.iter_mut().skip(k).step_by(3).zip(values).for_each(|(light, value)| *light = *value);
    }
    light
}

fn opaque(light: &[f32]) -> Vec<f32> {
    light.as_chunks::<3>().0.iter().flat_map(|[r, g, b]| [*r, *g, *b, 1.0]).collect()
}

fn setting(name: &str, text: &str, expected: &str) -> Error {
    Error::setting(name, format!("'{text}' was found, expected {expected}"))
}

/// The place of a group of a name.
fn place(option: &str, groups: &[Group], name: &str) -> Result<usize> {
    let known = || groups.iter().map(|group| group.name.as_str()).collect::<Vec<_>>().join(", ");
    let unknown = || Error::setting(option, format!("there is no light group '{}', expected one of {}", name.trim(), known()));
    groups.iter().position(|group| group.name == name.trim()).ok_or_else(unknown)
}

/// A scene: `Evening:Ceiling=0,Pendant=40%@2200`.
fn scene(groups: &[Group], text: &str) -> Result<Scene> {
    let wrong = || setting("scene", text, "NAME:GROUP=VALUE[@KELVIN],... with values from 0 to 1.5 or 150%, and 1000 to 10000 K");
    let (name, rest) = text.split_once(':').filter(|(name, _)| !name.trim().is_empty()).ok_or_else(wrong)?;
    let setting = |text: &str| -> Result<Setting> {
        let (group, value) = text.rsplit_once('=').ok_or_else(wrong)?;
        let (level, kelvin) = value.split_once('@').map_or((value, None), |(level, kelvin)| (level, Some(kelvin)));
        let level = share_of("scene", level).ok().filter(|level| (0.0..=MOST_LEVEL).contains(level)).ok_or_else(wrong)?;
        let within = |kelvin: &f64| (f64::from(KELVINS[0])..=f64::from(KELVINS[1])).contains(kelvin);
        let kelvin = kelvin.map(|kelvin| kelvin.trim().parse().ok().filter(within).ok_or_else(wrong)).transpose()?;
        // Places that the page's sliders have.
        let kelvin = kelvin.map(|kelvin| (kelvin / f64::from(STEP)).round() * f64::from(STEP));
        Ok(Setting { group: place("scene", groups, group)?, level, kelvin })
    };
    Ok(Scene { name: name.trim().to_owned(), settings: rest.split(',').map(setting).collect::<Result<_>>()? })
}

/// Says what became of the picture where it was too large for a page.
fn tell(options: &ShareOptions, picture: &Picture, page: &Page) {
    let ([width, height], [columns, rows]) = (page.size, picture.size);
    let fewer = || format!("the picture has {width} × {height} pixels in place of {columns} × {rows}, and its ");
    if page.size != picture.size || page.error > Page::FINE {
        let fewer = if page.size == picture.size { "the picture's ".to_owned() } else { fewer() };
        let (percent, limit) = (100.0 * page.error, options.max_size);
        say(&format!("{fewer}light is kept to {percent:.1} %, so that the page stays below {limit} MB; --max-size allows more"));
    }
}
