//! `gonio render --sun`.

use super::{arguments::DaylightArguments, file, messages::say};
use gonio::sky::{DEFAULT_ROWS, Daylight, Frame, Irradiance, Moment, Place, SkyModel, in_irradiances};
use gonio::{Diagnostic, Error, Result, scene::Origin};
use gonio_formats::weather;
use gonio_usd::{Loaded, daylight::up_axis};
use std::path::Path;

/// The longest weather file in bytes: ten times a year in steps of a minute.
const LONGEST: u64 = 1 << 30;

/// Adds the sun and the sky that were asked for, and says how bright they are; what is doubtful goes to the diagnostics, or is an error.
pub(super) fn add(arguments: &DaylightArguments, loaded: &mut Loaded, is_strict: bool, is_quiet: bool) -> Result<()> {
    let Some(text) = &arguments.sun else { return Ok(()) };
    let (daylight, doubts) = read(arguments, text)?;
    let origin = Origin { name: "--weather".into(), file: arguments.weather.as_deref().unwrap_or(Path::new("")).to_string_lossy().into() };
    if let Some(doubt) = doubts.first().filter(|_| is_strict) {
        return Err(Error::scene(&origin, doubt.clone()));
    }
    loaded.diagnostics.extend(doubts.into_iter().map(|doubt| Diagnostic::warning(&origin, doubt)));
    if !arguments.north.is_finite() {
        return Err(Error::setting("north", format!("{} was found, expected degrees", arguments.north)));
    }
    let frame = Frame { up_axis: up_axis(loaded.info.up_axis), north_deg: arguments.north };
    let sky = daylight.add_to(&mut loaded.scene, &frame, DEFAULT_ROWS)?;
    if !is_quiet {
        let sun = sky.sun;
        say(&format!("sun {:.2}° high at an azimuth of {:.2}°", sun.elevation_deg, sun.azimuth_deg));
        let night = if sun.elevation_deg > 0.0 { "" } else { "; there is no daylight while the sun is down" };
        say(&format!(
            "{} sky: {:.0} lx of the sun, facing it, {:.0} lx of the sky, level{night}",
            daylight.model, sky.direct_lux, sky.diffuse_lux
        ));
    }
    Ok(())
}

/// A place and a time as `--sun` takes them.
pub(super) fn place_and_time(text: &str, elevation_m: f64) -> Result<(Place, Moment)> {
    let parts: Vec<&str> = text.splitn(3, ',').collect();
    let [latitude, longitude, time] = parts[..] else {
        return Err(Error::setting("sun", format!("'{text}' was found, expected latitude, longitude and time, separated by commas")));
    };
    let place = Place { latitude_deg: number("sun", latitude)?, longitude_deg: number("sun", longitude)?, elevation_m };
    Ok((place, Moment::parse(time)?))
}

/// What was asked for, and what makes one doubt it.
fn read(arguments: &DaylightArguments, text: &str) -> Result<(Daylight, Vec<String>)> {
    let (place, moment) = place_and_time(text, arguments.elevation)?;
    let mut daylight = Daylight::new(place, moment);
    daylight.model = SkyModel::parse(&arguments.sky)?;
    daylight.turbidity = arguments.turbidity;
    daylight.ground = arguments.ground;
    daylight.is_coloured = !arguments.white_daylight;
    let mut doubts = Vec::new();
    if let Some(text) = &arguments.irradiance {
        let problem = || {
            Error::setting(
                "irradiance",
                format!("'{text}' was found, expected direct normal and diffuse horizontal irradiance, separated by a comma"),
            )
        };
        let (direct, diffuse) = text.split_once(',').ok_or_else(problem)?;
        daylight.irradiance =
            Some(Irradiance { direct_normal: number("irradiance", direct)?, diffuse_horizontal: number("irradiance", diffuse)? });
    }
    if let Some(path) = &arguments.weather {
        let bytes = file::read(path, LONGEST, "weather file")?;
        let found = in_irradiances(weather::read(&bytes).map_err(|error| Error::in_file(path, &error))?);
        daylight.take_weather(&found).map_err(|error| Error::Format { path: path.clone(), line: None, problem: error.to_string() })?;
        doubts = daylight.doubts_about(&found)?;
    }
    Ok((daylight, doubts))
}

/// A finite number of an option.
pub(super) fn number(name: &str, text: &str) -> Result<f64> {
    let value = text.trim().parse().ok().filter(|value: &f64| value.is_finite());
    value.ok_or_else(|| Error::setting(name, format!("'{text}' was found, expected a number")))
}
