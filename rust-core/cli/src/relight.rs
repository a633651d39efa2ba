//! `gonio relight`.

use super::{
    arguments::RelightOptions,
    file::{check_ending, check_targets, print_path, write_or_keep},
    messages::say,
    spectrum,
};
use gonio::{
    Error, Result,
    colour::luminance_of_pixel,
    film::{Image, Layer},
    light::blackbody_rgb,
    output::{Channels, ExrOptions, exposure_of_exr, read_exr, spectral_of_exr, view_of_exr, write_exr, write_spectral},
    scene::{Aov, LIGHT_GROUP},
    spectral_picture::NewLamp,
};
use std::path::Path;

/// Share of a picture's light that its groups may lack: rounding to half precision and denoising stay below.
const MOST_MISSING: f64 = 0.01;

/// Sums the groups of an image, each times its factor and colour.
pub(super) fn relight(options: &RelightOptions) -> Result<i32> {
    check_ending("output", &options.output, &["exr"])?;
    check_targets([&options.output])?;
    let asked = options.group.iter().map(|text| parse(text)).collect::<Result<Vec<_>>>()?;
    let (channels, size) = read_exr(&options.image)?;
    if channels.iter().any(|(name, _)| name.starts_with(LIGHT_GROUP) && name.contains(".S0.")) {
        return by_wavelength(options, &channels, size);
    }
    if let Some(asked) = options.spectrum.first() {
        let problem = format!("'{asked}' wants groups by wavelength, which gonio render --by-wavelength FILE.exr --light-groups writes");
        return Err(Error::setting("spectrum", problem));
    }
    let exposure = exposure_of_exr(&options.image)?;
    let names = groups_of(&options.image, &channels)?;
    if let Some((unknown, _)) = asked.iter().find(|(name, _)| !names.contains(name)) {
        let problem = format!("there is no light group '{unknown}', expected one of {}", names.join(", "));
        return Err(Error::Setting { name: "group".into(), problem });
    }
    tell_missing(missing(&channels, &names));
    let factor = |name: &String| asked.iter().rev().find(|(asked, _)| asked == name).map_or([1.0; 3], |(_, factor)| *factor);
    let mut image = relit(&channels, size, exposure, &names, factor);
    image.frame.view = view_of_exr(&options.image)?;
    write_or_keep(&options.output, |path| write_exr(path, &image, &ExrOptions { exposure, ..ExrOptions::default() }))?;
    print_path(&options.output);
    Ok(0)
}

/// Relights a picture by wavelength.
fn by_wavelength(options: &RelightOptions, channels: &Channels, size: [usize; 2]) -> Result<i32> {
    let lamps = new_lamps(options)?;
    let (found, notes) = spectral_of_exr(&options.image, channels, size)?.relit(&lamps)?;
    notes.iter().for_each(|note| say(&format!("note: {note}")));
    write_or_keep(&options.output, |path| write_spectral(path, &found, &ExrOptions::default()))?;
    print_path(&options.output);
    Ok(0)
}

/// What was asked for, group by group; the last word on a group counts.
fn new_lamps(options: &RelightOptions) -> Result<Vec<NewLamp>> {
    let mut lamps: Vec<NewLamp> = Vec::new();
    let mut at = |group: &str| {
        let known = lamps.iter().position(|lamp| lamp.group == group);
        known.unwrap_or_else(|| {
            lamps.push(NewLamp { group: group.to_owned(), factor: 1.0, spectrum: None });
            lamps.len() - 1
        })
    };
    let wrong = |name: &str, text: &str, expected: &str| Error::setting(name, format!("'{text}' was found, expected {expected}"));
    let mut words = Vec::new();
    for text in &options.group {
        let expected = "NAME=FACTOR for a picture by wavelength; --spectrum NAME=2700K gives it a colour temperature";
        let (group, factor) = text.rsplit_once('=').ok_or_else(|| wrong("group", text, expected))?;
        let factor = factor.trim().parse::<f64>().ok().filter(|x| x.is_finite() && *x >= 0.0);
        words.push((at(group), Some(factor.ok_or_else(|| wrong("group", text, expected))?), None));
    }
    for text in &options.spectrum {
        let (group, source) = text.split_once('=').ok_or_else(|| wrong("spectrum", text, "NAME=LAMP"))?;
        words.push((at(group), None, Some(spectrum::one(source)?)));
    }
    for (number, factor, spectrum) in words {
        lamps[number].factor = factor.unwrap_or(lamps[number].factor);
        lamps[number].spectrum = spectrum.or_else(|| lamps[number].spectrum.take());
    }
    Ok(lamps)
}

/// A group's name and factors of red, green and blue.
fn parse(text: &str) -> Result<(String, [f32; 3])> {
    let wrong =
        || Error::Setting { name: "group".into(), problem: format!("'{text}' was found, expected NAME=FACTOR or NAME=FACTOR,KELVIN") };
    let (name, values) = text.rsplit_once('=').ok_or_else(wrong)?;
    let (factor, kelvin) = values.split_once(',').map_or((values, None), |(factor, kelvin)| (factor, Some(kelvin)));
    let number = |text: &str| text.trim().parse::<f32>().ok().filter(|x| x.is_finite() && *x >= 0.0).ok_or_else(wrong);
    let factor = number(factor)?;
    let colour = kelvin.map(number).transpose()?.map_or([1.0; 3], blackbody_rgb);
    Ok((name.to_owned(), colour.map(|x| x * factor)))
}

/// Names of the groups of a file's channels, of which there must be some.
pub(super) fn groups_of(path: &Path, channels: &Channels) -> Result<Vec<String>> {
    let names = groups(channels);
    if names.is_empty() {
        let problem = "it has no light groups; gonio render --light-groups writes them".into();
        return Err(Error::Format { path: path.to_owned(), line: None, problem });
    }
    Ok(names)
}

/// Warns if a share of the light is in none of the groups.
pub(super) fn tell_missing(share: f64) {
    if share > MOST_MISSING {
        let percent = 100.0 * share;
        say(&format!(
            "warning: {percent:.0} % of the light belongs to no group of the file and is left out; gonio render --light-groups writes all"
        ));
    }
}

/// Names of the groups that the channels hold.
fn groups(channels: &Channels) -> Vec<String> {
    channels.iter().filter_map(|(name, _)| Some(name.strip_prefix(LIGHT_GROUP)?.strip_suffix(".R")?.to_owned())).collect()
}

pub(super) fn find<'a>(channels: &'a Channels, name: &str) -> Option<&'a [f32]> {
    channels.iter().find(|(known, _)| known == name).map(|(_, values)| values.as_slice())
}

/// The share of the colour's light that is in none of the groups.
pub(super) fn missing(channels: &Channels, names: &[String]) -> f64 {
    let light = |prefix: &str| -> f64 {
        let values = ["R", "G", "B"].into_iter().filter_map(|channel| find(channels, &format!("{prefix}{channel}"))).flatten();
        values.copied().filter(|value| value.is_finite()).map(f64::from).sum()
    };
    let of_groups: f64 = names.iter().map(|name| light(&format!("{LIGHT_GROUP}{name}."))).sum();
    let colour = light("");
    if colour > 0.0 { 1.0 - of_groups / colour } else { 0.0 }
}

fn relit(channels: &Channels, [width, height]: [usize; 2], exposure: f32, names: &[String], factor: impl Fn(&String) -> [f32; 3]) -> Image {
    let pixels = width * height;
    let mut colour = vec![0.0; 4 * pixels];
    for (pixel, alpha) in colour.chunks_exact_mut(4).zip(find(channels, "A").into_iter().flatten().copied().chain(std::iter::repeat(1.0))) {
        pixel[3] = alpha;
    }
    let mut layers = Vec::new();
    for (number, name) in names.iter().enumerate() {
        let factors = factor(name);
        let mut values = vec![0.0; 3 * pixels];
        for (k, channel) in ["R", "G", "B"].into_iter().enumerate() {
            let from = find(channels, &format!("{LIGHT_GROUP}{name}.{channel}")).unwrap_or_default();
            for (pixel, value) in from.iter().enumerate().take(pixels) {
                values[3 * pixel + k] = value * factors[k];
                colour[4 * pixel + k] += value * factors[k];
            }
        }
        layers.push(Layer { aov: Aov::LightGroup(number as u16), name: format!("{LIGHT_GROUP}{name}"), values, channels: 3 });
    }
    if find(channels, "Luminance").is_some() {
        let luminance = |c: &[f32]| luminance_of_pixel([c[0], c[1], c[2]]) / exposure;
        let values = colour.chunks_exact(4).map(luminance).collect();
        layers.push(Layer { aov: Aov::Luminance, name: "luminance".into(), values, channels: 1 });
    }
    layers.insert(0, Layer { aov: Aov::Color, name: "color".into(), values: colour, channels: 4 });
    Image { layers, ..Image::empty([width, height]) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_of_no_group_is_missing() {
        let grey = |prefix: &str, value: f32| ["R", "G", "B"].map(|channel| (format!("{prefix}{channel}"), vec![value; 4]));
        let some: Channels = [grey("", 2.0), grey("lightgroup:Kitchen.", 0.5)].concat();
        assert!((missing(&some, &groups(&some)) - 0.75).abs() < 1e-12);
        let all: Channels = [some, grey("lightgroup:other.", 1.5).to_vec()].concat();
        assert!(missing(&all, &groups(&all)).abs() < 1e-12);
        let without_colour: Channels = grey("lightgroup:Kitchen.", 0.5).to_vec();
        assert_eq!(missing(&without_colour, &groups(&without_colour)), 0.0);
    }
}
