//! Commands whose plans are TOML files and whose figures are those of norms: what they have in common.

mod emergency;
mod sports;

pub(super) use {emergency::emergency, sports::sports};

use crate::file;
use gonio::{
    Diagnostic, Error, Result,
    measure::Measurements,
    scene::{Light, Meter, Origin, Scene},
};
use gonio_formats::FormatError;
use gonio_norms::{Reading, Spot};
use std::path::Path;

/// The longest plan in bytes.
const LONGEST_PLAN: u64 = 1 << 24;

/// Reads a plan; what is wrong with it is told with its file.
fn plan<T>(name: &Path, read: impl Fn(&str) -> std::result::Result<T, FormatError>) -> Result<T> {
    let bytes = file::read(name, LONGEST_PLAN, "plan")?;
    read(&String::from_utf8_lossy(&bytes)).map_err(|error| Error::in_file(name, &error))
}

/// Has illuminances measured at these points and nowhere else.
fn measure_at(scene: &mut Scene, spots: &[Spot]) {
    let meter = |spot: &Spot| {
        let [x, y, z] = spot.position;
        let origin = Origin::new(format!("{x:.3},{y:.3},{z:.3}"));
        Meter { origin, position: spot.position, normal: spot.normal, ..Meter::default() }
    };
    scene.meters = spots.iter().map(meter).collect();
    scene.grids.clear();
}

/// Says at how many of these places luminaires are seen through glass or covers of the stage alone.
fn not_counted(covered: &[bool], places: &str, what: &str) -> Option<Diagnostic> {
    let count = covered.iter().filter(|covered| **covered).count();
    let message = format!(
        "{count} of {} {places} see luminaires through glass or covers of the stage alone, whose light is not {what}; give luminaires with their covers by \
         IES or EULUMDAT files",
        covered.len()
    );
    (count > 0).then(|| Diagnostic::warning(&Origin::new("luminaires"), message))
}

/// What was found there, in their order.
fn readings(found: &Measurements) -> Vec<Reading> {
    found.meters.iter().map(|found| Reading { lx: found.reading.value, error: found.reading.standard_error }).collect()
}

/// Leaves the lights of some groups, and those at or under some prims, burning, puts out all others and gives their numbers. Without both all that have a
/// place burn. `when` is the end of a sentence.
fn leave_burning(scene: &mut Scene, names: &[String], paths: &[String], when: &str) -> Result<Vec<usize>> {
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
        } else {
            light.dimming = 0.0;
        }
    }
    if burning.is_empty() {
        return Err(Error::setting("plan", format!("no light of the stage shines {when}; lights at infinity do not count")));
    }
    Ok(burning)
}
