//! Answers in numbers: meters at points and calculation grids, evaluated by the path tracer without a camera.

mod brought;
mod coefficients;
mod csv;
mod daylight_factor;
mod disc;
mod discs;
mod eye;
mod eyes;
pub mod glare;
mod grid_reading;
mod missed;
mod outline;
mod picture;
mod points;
mod reaching;
mod reading;
mod room;
mod sense;
mod sensing;
mod spectral;
mod straight;
mod ugr;
pub(crate) mod vector;
mod watch;

#[cfg(test)]
mod tests;

pub use coefficients::{DaylightCoefficients, Keeping, Kept, ROUNDS, Round, SkyTask, is_of, sun_coefficients, trace_rounds};
pub use csv::{csv, quoted};
pub use eyes::{EyeReadings, around};
pub use grid_reading::GridReading;
pub use picture::value_picture;
pub use points::{GridPoints, MOST_POINTS};
pub use reaching::Reaching;
pub use reading::{MeterReading, Reading, SensorGrid, SmallSources, Summary};
pub use room::Room;
pub use spectral::ColourReading;
pub(crate) use spectral::{SourceScene, by_spectrum, check_spectra, is_by_colours};
pub use straight::{StraightLight, straight_light};
pub use watch::{MOST_BOUNCES, Watch};

use crate::{
    compile::compile,
    error::{Diagnostic, Error, Result},
    scene::{Measurand, Meter, Scene},
};
use daylight_factor::{ExteriorSky, under_domes};
use glare::Coverage;
use gonio_simd::Execution;
use reading::Found;
use sense::Probe;
use std::sync::Arc;

/// What all meters and grids of a scene show.
#[derive(Clone, Debug, Default)]
pub struct Measurements {
    /// In the scene's order.
    pub meters: Vec<MeterReading>,
    /// In the scene's order.
    pub grids: Vec<GridReading>,
    /// What differs from what was asked for.
    pub diagnostics: Vec<Diagnostic>,
}

/// Evaluates a scene's meters and grids with the scene's settings, `samples` of them a point; cameras and passes do not matter.
///
/// # Errors
/// Grids that cannot be laid out, meters without a direction, more than [`MOST_POINTS`] points, what compiling finds, cancellation, and for
/// daylight factors a scene without domes.
pub fn measure(scene: &Scene, execution: Execution, watch: &mut Watch<'_>) -> Result<Measurements> {
    let grids = GridPoints::of_scene(scene)?;
    let at_grids = scene.grids.iter().zip(&grids).flat_map(|(grid, points)| {
        // Points stand for no more than their cells.
        let reach = 0.5 * points.spacing[0].min(points.spacing[1]);
        points.meters(grid).map(move |meter| (meter, reach))
    });
    let (meters, reaches): (Vec<Meter>, Vec<f64>) = scene.meters.iter().map(|meter| (meter.clone(), f64::INFINITY)).chain(at_grids).unzip();
    let mut diagnostics = Vec::new();
    let readings = read(scene, (&meters, &reaches), execution, watch, &mut diagnostics)?;
    tell_unknown(&meters, &readings, &mut diagnostics);
    let (single, mut rest) = readings.split_at(scene.meters.len());
    let meters = scene.meters.iter().zip(single).map(|(meter, found)| MeterReading::new(meter, found)).collect();
    let mut of_grid = |(grid, points): (&crate::scene::Grid, GridPoints)| {
        let (own, others) = rest.split_at(points.count());
        rest = others;
        GridReading::new(grid, points, own)
    };
    let grids = scene.grids.iter().zip(grids).map(&mut of_grid).collect();
    Ok(Measurements { meters, grids, diagnostics })
}

/// Readings of all meters: those under all lights in one go, by wavelengths, daylight factors and glare in others.
fn read(
    scene: &Scene,
    (meters, reaches): (&[Meter], &[f64]),
    execution: Execution,
    watch: &mut Watch<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<Vec<Found>> {
    let mut readings = vec![Found::default(); meters.len()];
    let of = |wanted: &dyn Fn(Measurand) -> bool| (0..meters.len()).filter(|i| wanted(meters[*i].measurand)).collect::<Vec<usize>>();
    let [daylit, rated, melanopic] =
        [Measurand::DaylightFactor, Measurand::Ugr, Measurand::MelanopicEdi].map(|measurand| of(&|found| found == measurand));
    let coloured = of(&Measurand::is_of_colour);
    let is_apart = |measurand| matches!(measurand, Measurand::DaylightFactor | Measurand::Ugr | Measurand::MelanopicEdi);
    let lit = of(&|measurand| !is_apart(measurand) && !measurand.is_of_colour());
    let probe = |i: &usize| Probe::new(&meters[*i]).map(|probe| probe.within(reaches[*i]));
    let chosen = |numbers: &[usize]| numbers.iter().map(probe).collect::<Result<Vec<_>>>();
    let [daylit_probes, lit_probes, melanopic_probes, coloured_probes] =
        [chosen(&daylit)?, chosen(&lit)?, chosen(&melanopic)?, chosen(&coloured)?];
    let mut sense = |scene: &Scene, probes: &[Probe], diagnostics: &mut Vec<Diagnostic>| {
        let compiled = Arc::new(compile(scene, watch.previous, watch.cancel)?);
        diagnostics.extend(compiled.diagnostics.iter().cloned());
        let sensed = sense::sense(&compiled, probes, &scene.settings, execution, watch)?;
        tell_around(&sensed, meters, diagnostics);
        Ok::<_, Error>(sensed.readings)
    };
    if !lit.is_empty() {
        let values = sense(scene, &lit_probes, diagnostics)?;
        lit.iter().zip(values).for_each(|(i, reading)| readings[*i] = reading.into());
    }
    if let Some(first) = melanopic.first() {
        let values = sense(&spectral::melanopic::seen(scene, &meters[*first].origin, diagnostics)?, &melanopic_probes, diagnostics)?;
        melanopic.iter().zip(values).for_each(|(i, reading)| readings[*i] = reading.into());
    }
    if let Some(first) = daylit.first() {
        let sky = under_domes(scene, &meters[*first].origin)?;
        let exterior = ExteriorSky::new(&sky)?;
        let outside = sense(&exterior.scene, &[exterior.probe], &mut Vec::new())?[0];
        if outside.value <= 0.0 {
            return Err(Error::scene(&meters[*first].origin, "a daylight factor wants a sky that shines; the scene's domes are dark"));
        }
        let values = sense(&sky, &daylit_probes, diagnostics)?;
        daylit.iter().zip(values).for_each(|(i, reading)| readings[*i] = reading.percent_of(&outside).into());
    }
    let these = |numbers: &[usize]| numbers.iter().map(|i| &meters[*i]).collect::<Vec<&Meter>>();
    if !rated.is_empty() {
        let values = ugr::ratings(scene, &these(&rated), execution, watch, diagnostics)?;
        let found = |(reading, coverage, small)| Found { rated: Some((coverage, small)), ..Found::from(reading) };
        rated.iter().zip(values).for_each(|(i, rating)| readings[*i] = found(rating));
    }
    if !coloured.is_empty() {
        let found = spectral::colour::colours(scene, (&these(&coloured), &coloured_probes), execution, watch, diagnostics)?;
        tell_around(&found.first, meters, diagnostics);
        coloured.iter().zip(found.readings).for_each(|(i, colour)| readings[*i] = Found::of_colour(meters[*i].measurand, colour));
    }
    Ok(readings)
}

/// Tells what stands around readings.
fn tell_around(sensed: &sense::Sensed, meters: &[Meter], diagnostics: &mut Vec<Diagnostic>) {
    let Some(Meter { origin, .. }) = meters.first() else { return };
    if let Some(radii) = sensed.discs {
        diagnostics.push(Diagnostic::info(origin, on_discs(radii)));
    }
    if sensed.in_part {
        diagnostics.push(Diagnostic::warning(origin, IN_PART));
    }
    if sensed.missed > 0 {
        diagnostics.push(Diagnostic::info(origin, behind_rough_glass(sensed.missed)));
    }
}

/// Said where settings leave out what meters exist to find.
pub const IN_PART: &str = "the figures leave out light that mirrors and glass send on: it comes by light paths, which these settings do without; they run \
    with the integrator path and two bounces at least";

/// Said where a glare rating knows none of the sources.
const COVERED: &str = "the luminaires are seen through glass or covers of the scene alone, which are not rated; give luminaires with their covers by IES or \
    EULUMDAT files";

/// Says over what the light is a mean that light paths bring.
fn on_discs([least, most]: [f64; 2]) -> String {
    let size = |radius: f64| format!("{:.1} mm", 1000.0 * radius);
    let sizes = if size(least) == size(most) { size(most) } else { format!("{} to {}", size(least), size(most)) };
    format!(
        "what mirrors and clear glass send on is brought by light paths: its part of a reading is the mean over a disc of radius {sizes}"
    )
}

/// Says where light paths alone have measured.
fn behind_rough_glass(missed: usize) -> String {
    format!(
        "paths from {missed} of the points miss light that comes by rough glass, or by clear glass and then through fog; all but their direct light is the mean over their discs, by light paths"
    )
}

/// Says at which meters and grids there is no figure.
fn tell_unknown(meters: &[Meter], readings: &[Found], diagnostics: &mut Vec<Diagnostic>) {
    let mut told: Vec<&Meter> = Vec::new();
    for (meter, found) in meters.iter().zip(readings).filter(|(_, found)| !found.reading.is_known()) {
        if told.iter().any(|other| other.origin == meter.origin && other.measurand == meter.measurand) {
            continue;
        }
        told.push(meter);
        let [x, y, z] = meter.position;
        let is_covered = found.rated.is_some_and(|(coverage, _)| coverage.covered > 0);
        let problem = match found.colour.as_ref().filter(|colour| colour.is_known()) {
            Some(colour) => colour.why_undefined(),
            None if is_covered => COVERED.to_owned(),
            None => "light comes by mirrors or clear glass, and is counted on a disc about the meter, for which a surface leaves no room; move it off"
                .to_owned(),
        };
        diagnostics.push(Diagnostic::warning(&meter.origin, format!("no figure at {x:.4}, {y:.4}, {z:.4} m: {problem}")));
    }
}
