//! Commands whose plans are TOML files and whose figures are those of norms: what they have in common.

mod emergency;
mod floors;
mod sports;
mod zones;

pub(super) use {emergency::emergency, sports::sports, zones::zones};

use crate::{
    arguments::NormArguments,
    file,
    measure::{apply_settings, evaluated},
    messages::{print, tell},
    progress::Reporter,
    render::stage_options,
    stage::Stage,
};
use gonio::{
    Diagnostic, Error, Result,
    compile::compile,
    measure::{MeterReading, StraightLight, straight_light},
    scene::{Integrator, Light, Measurand, Meter, Origin, Scene},
};
use gonio_formats::FormatError;
use gonio_norms::{Reading, Spot};
use gonio_usd::{Loaded, meter::axes};
use pyo3::prelude::*;
use serde_json::Value;
use std::{path::Path, sync::atomic::AtomicBool};

/// The longest plan in bytes.
const LONGEST_PLAN: u64 = 1 << 24;

/// Reads a plan; what is wrong with it is told with its file.
fn plan<T>(name: &Path, read: impl Fn(&str) -> std::result::Result<T, FormatError>) -> Result<T> {
    let bytes = file::read(name, LONGEST_PLAN, "plan")?;
    read(&String::from_utf8_lossy(&bytes)).map_err(|error| Error::in_file(name, &error))
}

/// The stage, and its way up.
fn loaded(py: Python<'_>, options: &NormArguments, interrupted: &'static AtomicBool) -> Result<(Loaded, [f64; 3])> {
    let stage_options = stage_options(&options.stage)?;
    let stage = Stage::open(py, &options.stage.stage, &options.stage.state, &stage_options)?;
    let loaded = stage.load(py, &stage_options, interrupted)?;
    tell(&options.stage, options.quiet, &loaded.diagnostics);
    let [up, _] = axes(loaded.info.up_axis);
    Ok((loaded, up))
}

/// What was found at a plan's points, and what comes straight to some eyes.
struct Found {
    readings: Vec<Reading>,
    straight: Vec<StraightLight>,
    told: Vec<Diagnostic>,
}

/// Measures illuminances at these points and nowhere else, of the lights alone that burn.
fn measured(
    py: Python<'_>,
    scene: &mut Scene,
    (spots, eyes): (&[Spot], &[[f64; 3]]),
    (options, integrator): (&NormArguments, Integrator),
    interrupted: &'static AtomicBool,
) -> Result<Found> {
    let meter = |spot: &Spot| {
        let [x, y, z] = spot.position;
        let origin = Origin::new(format!("{x:.3},{y:.3},{z:.3}"));
        let measurand = if spot.is_cylinder { Measurand::Cylindrical } else { Measurand::Illuminance };
        Meter { origin, position: spot.position, normal: spot.normal, measurand, ..Meter::default() }
    };
    scene.meters = spots.iter().map(meter).collect();
    scene.grids.clear();
    apply_settings(scene, (options.spp, None), integrator, (&options.work, &options.textures));
    let lit = scene.without_emission();
    py.detach(|| {
        let compiled = compile(&lit, None, interrupted)?;
        let found = evaluated(&lit, Some(&compiled), Reporter::new(options.quiet), interrupted)?;
        let reading = |found: &MeterReading| Reading { lx: found.reading.value, error: found.reading.standard_error };
        let straight = straight_light(&lit, &compiled, eyes, interrupted)?;
        Ok(Found { readings: found.meters.iter().map(reading).collect(), straight, told: found.diagnostics })
    })
}

/// Prints figures, for machines or for people.
fn show(options: &NormArguments, json: impl FnOnce() -> Value, lines: impl FnOnce() -> Vec<String>) {
    if options.json {
        print(&json().to_string());
    } else {
        lines().iter().for_each(|line| print(line));
    }
}

/// Says at how many of these places luminaires are seen through glass or covers of the stage alone.
fn not_counted(straight: &[StraightLight], places: &str, what: &str) -> Option<Diagnostic> {
    let count = straight.iter().filter(|light| light.sees_covered).count();
    let message = format!(
        "{count} of {} {places} see luminaires through glass or covers of the stage alone, whose light is not {what}; give luminaires with their covers by \
         IES or EULUMDAT files",
        straight.len()
    );
    (count > 0).then(|| Diagnostic::warning(&Origin::new("luminaires"), message))
}

/// Says what shines by itself, which counts for none of these figures.
fn surfaces_left_out(scene: &Scene) -> Option<Diagnostic> {
    let mut surfaces = scene.instances.iter().filter(|set| set.materials.iter().any(|material| scene.shines(*material)));
    let first = surfaces.next()?;
    let (count, name) = (1 + surfaces.count(), &first.origin.name);
    let message = format!(
        "{count} surfaces that shine are left out, '{name}' the first of them: make lights of them, or give luminaires by IES or EULUMDAT files"
    );
    Some(Diagnostic::warning(&first.origin, message))
}

/// Leaves the lights of some groups, and those at or under some prims, burning, puts out all others and gives their numbers. Without both all that have a
/// place burn. A maintenance factor of the plan takes the place of their own. `when` is the end of a sentence.
fn leave_burning(scene: &mut Scene, (names, paths): (&[String], &[String]), maintenance_factor: f64, when: &str) -> Result<Vec<usize>> {
    let everything = names.is_empty() && paths.is_empty();
    let burns = |light: &Light| {
        let is_lamp = !light.portal && !light.shape.is_at_infinity();
        is_lamp && (everything || names.contains(&light.group) || paths.iter().any(|path| light.origin.is_below(path)))
    };
    let groups = scene.light_groups();
    if let Some(unknown) = names.iter().find(|group| !groups.contains(group)) {
        return Err(Error::setting("plan", format!("there is no light group '{unknown}', expected one of {}", groups.join(", "))));
    }
    if let Some(unknown) = paths.iter().find(|path| !scene.lights.iter().any(|light| light.origin.is_below(path))) {
        return Err(Error::setting("plan", format!("no light of the stage is at or under '{unknown}'")));
    }
    let mut burning = Vec::new();
    for (number, light) in scene.lights.iter_mut().enumerate() {
        if burns(light) {
            burning.push(number);
            if maintenance_factor != 1.0 {
                light.maintenance = 1.0;
            }
        } else {
            light.dimming = 0.0;
        }
    }
    if burning.is_empty() {
        return Err(Error::setting("plan", format!("no light of the stage shines {when}; lights at infinity do not count")));
    }
    Ok(burning)
}
