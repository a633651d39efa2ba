//! Settings by keyword.

use crate::error::exception;
use gonio::scene::{Antialiasing, Background, Caustics, Crop, Filter, Guiding, Integrator, MOST_MATTE_RANKS, Mist, Settings, parse_bytes};
use pyo3::{prelude::*, types::PyDict};
use std::path::PathBuf;

fn wrong(name: &str, problem: String) -> PyErr {
    exception(gonio::Error::Setting { name: name.into(), problem })
}

/// Applies every keyword, or fails at the first that is not understood.
pub(crate) fn change(settings: &mut Settings, changes: &Bound<'_, PyDict>) -> PyResult<()> {
    for (key, value) in changes {
        let key: String = key.extract()?;
        change_one(settings, &key, &value)?;
    }
    Ok(())
}

fn change_one(s: &mut Settings, key: &str, value: &Bound<'_, PyAny>) -> PyResult<()> {
    // None leaves a setting as it is, but for the crop and the ranges, which it takes away.
    if value.is_none() && !matches!(key, "crop" | "sample_range" | "tile_range" | "clear_roughness") {
        return Ok(());
    }
    match key {
        "camera" => s.camera = value.extract()?,
        "width" => s.resolution[0] = value.extract()?,
        "height" => s.resolution[1] = value.extract()?,
        "pixel_aspect" => s.pixel_aspect = within(key, value, 1e-3, 1e3)?,
        "crop" => s.crop = crop(value)?,
        "samples" => match value.extract()? {
            0 => return Err(wrong(key, "0 was found, expected 1 or more".into())),
            samples => s.samples = samples,
        },
        "noise_threshold" => s.noise_threshold = within(key, value, 0.0, f64::MAX)? as f32,
        "min_samples" => s.min_samples = value.extract()?,
        "noise_white" => s.noise_white = within(key, value, 0.0, f64::from(f32::MAX))? as f32,
        "sample_range" => s.sample_range = value.extract()?,
        "tile_range" => s.tile_range = value.extract()?,
        "seed" => s.seed = value.extract()?,
        "threads" => s.threads = value.extract()?,
        "integrator" => s.integrator = named(key, value, &Integrator::NAMES)?,
        "caustics" => s.caustics = named(key, value, &Caustics::NAMES)?,
        "guiding" => s.guiding = named(key, value, &Guiding::NAMES)?,
        "spectral" => s.spectral = value.extract()?,
        "reflective_caustics" => s.caustic_paths[0] = value.extract()?,
        "refractive_caustics" => s.caustic_paths[1] = value.extract()?,
        "clear_roughness" => s.clear_roughness = value.extract()?,
        "max_bounces" => s.max_bounces = value.extract()?,
        "light_samples" => s.light_samples = value.extract()?,
        "max_diffuse_bounces" => s.kind_bounces[0] = value.extract()?,
        "max_glossy_bounces" => s.kind_bounces[1] = value.extract()?,
        "max_transmission_bounces" => s.kind_bounces[2] = value.extract()?,
        "max_transparent_bounces" => s.kind_bounces[3] = value.extract()?,
        "max_volume_bounces" => s.volume_bounces = value.extract()?,
        "antialiasing" => s.set_antialiasing(antialiasing(value)?),
        "filter" => s.filter = filter(value)?,
        "filter_width" => s.filter_width = within(key, value, 0.0, 16.0)? as f32,
        "clamp_direct" => s.clamp_direct = within(key, value, 0.0, f64::MAX)? as f32,
        "clamp_indirect" => s.clamp_indirect = within(key, value, 0.0, f64::MAX)? as f32,
        "cryptomatte_depth" => match value.extract()? {
            ranks if (2..=MOST_MATTE_RANKS).contains(&ranks) && ranks % 2 == 0 => s.set_cryptomatte_depth(ranks),
            ranks => return Err(wrong(key, format!("{ranks} was found, expected an even number from 2 to {MOST_MATTE_RANKS}"))),
        },
        "occlusion_distance" => s.occlusion_distance = within(key, value, 0.0, f64::from(f32::MAX))? as f32,
        "deep_tolerance" => s.deep_tolerance = within(key, value, 1e-6, 1.0)? as f32,
        "time_limit" => {
            let limit: f64 = value.extract()?;
            if !(limit.is_finite() && limit >= 0.0) {
                return Err(wrong(key, format!("{limit} was found, expected seconds from 0 (no limit) on")));
            }
            s.time_limit_s = limit;
        }
        "texture_memory" => s.texture_memory = bytes(key, value)?,
        "displacement_memory" => s.displacement_memory = bytes(key, value)?,
        "texture_cache" => {
            let folder: PathBuf = value.extract()?;
            s.texture_cache = (!folder.as_os_str().is_empty()).then_some(folder);
        }
        "passes" => {
            let names: Vec<String> = value.extract()?;
            s.set_passes(&names).map_err(|name| wrong(key, format!("there is no pass '{name}'")))?;
        }
        _ => return change_shutter(s, key, value),
    }
    Ok(())
}

/// Sets one of what the shutter, the mist and the film do.
fn change_shutter(s: &mut Settings, key: &str, value: &Bound<'_, PyAny>) -> PyResult<()> {
    match key {
        "mist" => {
            let (start, depth, falloff) = value.extract()?;
            s.mist = Mist { start, depth, falloff };
        }
        "motion_blur" => s.shutter.blur = value.extract()?,
        "shutter" => {
            let (open, close): (f32, f32) = value.extract()?;
            if !(0.0 <= open && open <= close && close <= 1.0) {
                return Err(wrong(key, format!("{open} to {close} was found, expected a part of 0 to 1")));
            }
            s.shutter.interval = [open, close];
        }
        "shutter_curve" => s.shutter.curve = value.extract()?,
        "row_exposure" => s.shutter.row_exposure = within(key, value, 0.0, 1.0)? as f32,
        "motion_interpolation" => s.shutter.linear = named(key, value, &[(false, "decomposed"), (true, "linear")])?,
        "film_transparent" => s.background = if value.extract()? { Background::Transparent } else { Background::Covering },
        _ => return Err(pyo3::exceptions::PyTypeError::new_err(format!("set() got an unexpected keyword argument '{key}'"))),
    }
    Ok(())
}

fn within(key: &str, value: &Bound<'_, PyAny>, least: f64, most: f64) -> PyResult<f64> {
    let found: f64 = value.extract()?;
    if (least..=most).contains(&found) { Ok(found) } else { Err(wrong(key, format!("{found} was found, expected {least} or more"))) }
}

/// Bytes, or a text with a unit.
fn bytes(key: &str, value: &Bound<'_, PyAny>) -> PyResult<u64> {
    match value.extract::<String>() {
        Ok(text) => parse_bytes(&text).map_err(|problem| wrong(key, problem)),
        Err(_) => value.extract(),
    }
}

fn crop(value: &Bound<'_, PyAny>) -> PyResult<Option<Crop>> {
    let bounds: Option<[u32; 4]> = value.extract()?;
    Ok(bounds.map(|[x0, y0, x1, y1]| Crop { min: [x0, y0], max: [x1, y1] }))
}

fn named<T: Copy>(key: &str, value: &Bound<'_, PyAny>, names: &[(T, &str)]) -> PyResult<T> {
    let found: String = value.extract()?;
    let known = names.iter().find(|(_, name)| *name == found);
    let all = || names.iter().map(|(_, name)| *name).collect::<Vec<_>>().join(", ");
    known.map(|(known, _)| *known).ok_or_else(|| wrong(key, format!("'{found}' was found, expected {}", all())))
}

/// A name, or the number of places along a pixel's side.
fn antialiasing(value: &Bound<'_, PyAny>) -> PyResult<Antialiasing> {
    let found = value.str()?.to_string();
    let expected = || wrong("antialiasing", format!("'{found}' was found, expected sampled, adaptive, high, paper, or 1 to 32"));
    Antialiasing::by_name(&found).ok_or_else(expected)
}

fn filter(value: &Bound<'_, PyAny>) -> PyResult<Filter> {
    match value.extract::<String>()?.as_str() {
        "box" => Ok(Filter::Box),
        "tent" => Ok(Filter::Tent),
        "gaussian" => Ok(Filter::Gaussian),
        "blackman-harris" => Ok(Filter::BlackmanHarris),
        other => Err(wrong("filter", format!("'{other}' was found, expected box, tent, gaussian or blackman-harris"))),
    }
}
