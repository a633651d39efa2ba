//! Answers in numbers: meters at points and calculation grids, evaluated by the path tracer without a camera.

mod csv;
mod daylight_factor;
mod eye;
pub mod glare;
mod outline;
mod picture;
mod points;
mod reading;
mod room;
mod sense;
mod ugr;
mod vector;

#[cfg(test)]
mod tests;

pub use csv::csv;
pub use picture::value_picture;
pub use points::{GridPoints, MOST_POINTS};
pub use reading::{GridReading, MeterReading, Reading, SmallSources, Summary};
pub use room::Room;

use crate::{
    compile::{CompiledScene, compile},
    error::{Diagnostic, Error, Result},
    render::Progress,
    scene::{Measurand, Meter, Scene},
};
use daylight_factor::{ExteriorSky, under_domes};
use glare::Coverage;
use gonio_simd::Execution;
use reading::Found;
use sense::Probe;
use std::sync::{Arc, atomic::AtomicBool};

/// Bounces of measurements that no limit was asked for: in white rooms the late ones are many lux together, and roulette ends what does not matter.
pub const MOST_BOUNCES: u32 = 255;

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

/// What stands around a measurement.
pub struct Watch<'a> {
    /// Lends what did not change.
    pub previous: Option<&'a CompiledScene>,
    /// Ends compiling.
    pub cancel: &'a AtomicBool,
    /// Is told how far it is, now and then; false ends it.
    pub progress: &'a mut dyn FnMut(&Progress) -> bool,
}

impl std::fmt::Debug for Watch<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Watch").field("previous", &self.previous.is_some()).field("cancel", self.cancel).finish_non_exhaustive()
    }
}

/// Evaluates a scene's meters and grids with the scene's settings, `samples` of them a point; cameras and passes do not matter.
///
/// # Errors
/// Grids that cannot be laid out, meters without a direction, more than [`MOST_POINTS`] points, what compiling finds, cancellation, and for
/// daylight factors a scene without domes.
pub fn measure(scene: &Scene, execution: Execution, watch: &mut Watch<'_>) -> Result<Measurements> {
    let mut count = scene.meters.len();
    let laid_out = |grid| {
        let points = GridPoints::new(scene, grid)?;
        count += points.known().count();
        if count > MOST_POINTS {
            return Err(Error::setting("grids", format!("more than {MOST_POINTS} points in all; take a wider spacing")));
        }
        Ok(points)
    };
    let grids = scene.grids.iter().map(laid_out).collect::<Result<Vec<_>>>()?;
    let at_grids = scene.grids.iter().zip(&grids).flat_map(|(grid, points)| {
        points.known().map(|position| Meter {
            origin: grid.origin.clone(),
            position,
            normal: points.normal,
            facing: grid.facing,
            measurand: grid.measurand,
        })
    });
    let meters: Vec<Meter> = scene.meters.iter().cloned().chain(at_grids).collect();
    let mut diagnostics = Vec::new();
    let readings = read(scene, &meters, execution, watch, &mut diagnostics)?;
    let (single, mut rest) = readings.split_at(scene.meters.len());
    let of_meter = |(meter, (reading, rated)): (&Meter, &Found)| MeterReading {
        meter: meter.clone(),
        reading: *reading,
        coverage: rated.map(|(coverage, _)| coverage),
        small: rated.map(|(_, small)| small),
    };
    let meters = scene.meters.iter().zip(single).map(of_meter).collect();
    let mut of_grid = |(grid, points): (&crate::scene::Grid, GridPoints)| {
        let (own, others) = rest.split_at(points.known().count());
        rest = others;
        GridReading::new(grid, points, own)
    };
    let grids = scene.grids.iter().zip(grids).map(&mut of_grid).collect();
    Ok(Measurements { meters, grids, diagnostics })
}

/// Readings of all meters: those under all lights in one go, daylight factors and glare in others.
fn read(
    scene: &Scene,
    meters: &[Meter],
    execution: Execution,
    watch: &mut Watch<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<Vec<Found>> {
    let mut readings = vec![Found::default(); meters.len()];
    let of = |measurand: Measurand| (0..meters.len()).filter(move |i| meters[*i].measurand == measurand);
    let (daylit, rated): (Vec<usize>, Vec<usize>) = (of(Measurand::DaylightFactor).collect(), of(Measurand::Ugr).collect());
    let is_lit = |i: &usize| !matches!(meters[*i].measurand, Measurand::DaylightFactor | Measurand::Ugr);
    let lit: Vec<usize> = (0..meters.len()).filter(is_lit).collect();
    let chosen = |numbers: &[usize]| numbers.iter().map(|i| Probe::new(&meters[*i])).collect::<Result<Vec<_>>>();
    let (daylit_probes, lit_probes) = (chosen(&daylit)?, chosen(&lit)?);
    let mut sense = |scene: &Scene, probes: &[Probe], diagnostics: &mut Vec<Diagnostic>| {
        let compiled = Arc::new(compile(scene, watch.previous, watch.cancel)?);
        diagnostics.extend(compiled.diagnostics.iter().cloned());
        sense::sense(compiled, probes, &scene.settings, execution, watch.progress)
    };
    if !lit.is_empty() {
        let values = sense(scene, &lit_probes, diagnostics)?;
        lit.iter().zip(values).for_each(|(i, reading)| readings[*i].0 = reading);
    }
    if let Some(first) = daylit.first() {
        let sky = under_domes(scene, &meters[*first].origin)?;
        let exterior = ExteriorSky::new(&sky)?;
        let outside = sense(&exterior.scene, &[exterior.probe], &mut Vec::new())?[0];
        if outside.value <= 0.0 {
            return Err(Error::scene(&meters[*first].origin, "a daylight factor wants a sky that shines; the scene's domes are dark"));
        }
        let values = sense(&sky, &daylit_probes, diagnostics)?;
        daylit.iter().zip(values).for_each(|(i, reading)| readings[*i].0 = reading.percent_of(&outside));
    }
    if !rated.is_empty() {
        let observers: Vec<&Meter> = rated.iter().map(|i| &meters[*i]).collect();
        let values = ugr::ratings(scene, &observers, execution, watch, diagnostics)?;
        rated.iter().zip(values).for_each(|(i, (reading, coverage, small))| readings[*i] = (reading, Some((coverage, small))));
    }
    Ok(readings)
}
