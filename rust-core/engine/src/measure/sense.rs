//! From meters to sensors, and from their pixels to readings.

use super::{
    brought::{Brought, brought},
    disc::Disc,
    discs::Discs,
    missed::with_missed,
    reading::Reading,
    sensing::{Effort, Sensing, unlimited},
    vector::{across, add, cross, length, scaled, subtract, unit},
    watch::Watch,
};
use crate::{
    camera::Surroundings,
    compile::{CompiledScene, light_paths_measure},
    error::{Error, Result},
    render::{LightPaths, Progress},
    scene::{Measurand, Meter, Settings},
    transport::{Sensor, surroundings_at},
};
use gonio_simd::Execution;
use std::{f64::consts::PI, sync::Arc};

/// Rounding errors of a position by its coordinates: that of the rebased point and that of the surface it may lie on.
const POSITION_ERROR: f64 = 8.0 * f32::EPSILON as f64;
/// Errors of a position that are well before the surface it lies on.
const BEFORE: f64 = 16.0;

/// A meter in unit vectors, world space.
#[derive(Clone, Copy, Debug)]
pub(super) struct Probe {
    position: [f64; 3],
    normal: [f64; 3],
    side: [f64; 3],
    turn: f64,
    /// Where a cylinder stands up from what it stands on; zero for all else.
    up: [f64; 3],
    looks: bool,
    /// Metres within which light may be gathered that no path from the meter finds.
    reach: f64,
}

impl Probe {
    /// Where it is and which way it looks, to tell equal ones.
    pub(super) fn bits(&self) -> [u64; 6] {
        let ([x, y, z], [a, b, c]) = (self.position, self.normal);
        [x, y, z, a, b, c].map(f64::to_bits)
    }

    /// What stands for no more than `reach` metres about it.
    pub(super) fn within(self, reach: f64) -> Self {
        Self { reach, ..self }
    }

    /// # Errors
    /// Positions and directions that are not finite or have no length.
    pub(super) fn new(meter: &Meter) -> Result<Self> {
        let problem = |what: &str, v: [f64; 3]| format!("the meter's {what} is {v:?}, expected finite numbers and a direction");
        let wrong = |what: &str, v: [f64; 3]| Error::scene(&meter.origin, problem(what, v));
        let position = Some(meter.position).filter(|p| p.iter().all(|x| x.is_finite())).ok_or_else(|| wrong("position", meter.position))?;
        let direction = |what, v: [f64; 3]| unit(v).ok_or_else(|| wrong(what, v));
        let reach = f64::INFINITY;
        let plane = |normal, looks| Self { position, normal, side: across(normal, [1.0, 0.0, 0.0]), turn: 0.0, up: [0.0; 3], looks, reach };
        Ok(match meter.measurand {
            Measurand::Illuminance
            | Measurand::DaylightFactor
            | Measurand::Cct
            | Measurand::Duv
            | Measurand::Ra
            | Measurand::Rf
            | Measurand::Rg => plane(direction("normal", meter.normal)?, false),
            Measurand::Luminance => plane(direction("facing", meter.facing)?, true),
            // What comes to the eye; glare is rated by it.
            Measurand::Ugr | Measurand::MelanopicEdi => plane(direction("facing", meter.facing)?, false),
            Measurand::Cylindrical | Measurand::Semicylindrical => {
                let axis = direction("axis", meter.normal)?;
                if meter.measurand == Measurand::Semicylindrical && unit(cross(axis, direction("facing", meter.facing)?)).is_none() {
                    return Err(Error::scene(&meter.origin, "half a cylinder faces along its own axis, expected a direction across it"));
                }
                let normal = across(axis, meter.facing);
                let turn = if meter.measurand == Measurand::Cylindrical { PI } else { 0.5 * PI };
                Self { position, normal, side: cross(axis, normal), turn, up: axis, looks: false, reach }
            }
        })
    }

    /// In a scene of a radius in metres, whose surfaces are as exact as that allows.
    fn sensor(&self, scene: &CompiledScene, radius: f64) -> Sensor {
        let origin = scene.tables.origin;
        let rebased = [0, 1, 2].map(|i| self.position[i] - origin[i]);
        let largest = rebased.iter().fold(radius, |most, x| most.max(x.abs()));
        let error = largest * POSITION_ERROR;
        // The side of a cylinder looks along the floor it stands on.
        let position = add(rebased, scaled(self.up, error)).map(|x| x as f32);
        let single = |v: [f64; 3]| v.map(|x| x as f32);
        Sensor {
            position,
            error: error as f32,
            normal: single(self.normal),
            side: single(self.side),
            turn: self.turn as f32,
            looks: self.looks,
            surroundings: Surroundings::OPEN,
        }
    }

    /// A place on the side that is measured, for sensors lie on surfaces; world space.
    fn before(&self, sensor: &Sensor) -> [f64; 3] {
        add(self.position, scaled(self.normal, BEFORE * f64::from(sensor.error)))
    }
}

/// Part of the work that light paths to meters are, as progress tells it.
const LIGHT_PATHS: f64 = 0.5;

/// What probes show.
pub(super) struct Sensed {
    /// In their order; not a number where light that no path from the meter finds has no room to be counted.
    pub(super) readings: Vec<Reading>,
    /// Least and greatest radius of the discs that such light was counted on, metres; none where there is no such light.
    pub(super) discs: Option<[f64; 2]>,
    /// Whether light that mirrors and clear glass send on is left out, as the settings have it.
    pub(super) in_part: bool,
    /// At how many probes light paths found more behind rough glass than the probes' own paths, and took their place.
    pub(super) missed: usize,
}

/// Sensors of probes, which know what they stand in, and places before them.
pub(super) fn placed(scene: &CompiledScene, probes: &[Probe]) -> (Vec<Sensor>, Vec<[f64; 3]>) {
    let radius = radius(scene);
    let mut sensors: Vec<Sensor> = probes.iter().map(|probe| probe.sensor(scene, radius)).collect();
    let places: Vec<[f64; 3]> = probes.iter().zip(&sensors).map(|(probe, sensor)| probe.before(sensor)).collect();
    sensors.iter_mut().zip(surroundings_at(&scene.tables, &places)).for_each(|(sensor, found)| sensor.surroundings = found);
    (sensors, places)
}

fn radius(scene: &CompiledScene) -> f64 {
    Some(scene.bounds.radius()).filter(|radius| radius.is_finite()).unwrap_or(0.0)
}

/// Measures at all probes; `settings.samples` a point, rounded up to what a block of pixels has room for.
pub(super) fn sense(
    scene: &Arc<CompiledScene>,
    probes: &[Probe],
    settings: &Settings,
    execution: Execution,
    watch: &mut Watch<'_>,
) -> Result<Sensed> {
    let plan = Plan::new(scene, probes, settings, watch);
    plan.follow(scene, Effort::WHOLE, settings, execution, watch)
}

/// How some probes are measured: what they stand in, and which light comes by light paths.
pub(super) struct Plan {
    sensors: Vec<Sensor>,
    /// Of those that light paths bring light to.
    discs: Discs,
    light_paths: Option<(LightPaths, Arc<[u32]>)>,
    rough: bool,
    in_part: bool,
}

impl Plan {
    pub(super) fn new(scene: &CompiledScene, probes: &[Probe], settings: &Settings, watch: &Watch<'_>) -> Self {
        let (sensors, places) = placed(scene, probes);
        let settings = unlimited(settings);
        // Meters may stand far off the scene: from there its lamps are small.
        let middle = scene.bounds.centre();
        let reaches = places.iter().map(|place| length(subtract(*place, middle))).filter(|reach| reach.is_finite());
        let reach = reaches.fold(radius(scene), f64::max);
        let starts = light_paths_measure::for_meters(scene, &settings, reach, watch.cancel);
        let light_paths = starts.and_then(|starts| LightPaths::bringing(scene, &starts));
        let rough = light_paths_measure::may_be_missed(scene, &settings);
        let left_out =
            || light_paths_measure::has_rough_glass(scene) || light_paths_measure::is_left_out(scene, &settings, reach, watch.cancel);
        let in_part = !light_paths_measure::are_followed(&settings) && left_out();
        let of = |(probe, sensor): (&Probe, &Sensor)| if probe.looks { Disc::default() } else { Disc::of(sensor, probe.reach, scene) };
        let are_wanted = light_paths.is_some() || rough;
        let discs = if are_wanted { probes.iter().zip(&sensors).map(of).collect() } else { Vec::new() };
        Self { sensors, discs: Discs::new(discs), light_paths, rough, in_part }
    }

    /// Measures in the scene that the plan was made for, or as that is in a band of wavelengths.
    pub(super) fn follow(
        &self,
        scene: &Arc<CompiledScene>,
        effort: Effort,
        settings: &Settings,
        execution: Execution,
        watch: &mut Watch<'_>,
    ) -> Result<Sensed> {
        let settings = unlimited(settings);
        let sensing = Sensing { scene, sensors: &self.sensors, settings: &settings, execution, effort };
        let readings = match &self.light_paths {
            None => sensing.readings(watch.progress)?,
            Some(light_paths) => with_light_paths(&sensing, &self.discs, light_paths.clone(), watch)?,
        };
        let (readings, missed) = if self.rough { with_missed(&sensing, &self.discs, readings, watch)? } else { (readings, 0) };
        let radii = || self.discs.all().iter().map(|disc| disc.radius).filter(|radius| *radius > 0.0);
        let discs = radii().reduce(f64::max).map(|widest| [radii().fold(widest, f64::min), widest]);
        Ok(Sensed { readings, discs, in_part: self.in_part, missed })
    }
}

/// With the light that light paths bring: to all surfaces as photons, and to the meters on discs.
fn with_light_paths(
    sensing: &Sensing<'_>,
    discs: &Discs,
    light_paths: (LightPaths, Arc<[u32]>),
    watch: &mut Watch<'_>,
) -> Result<Vec<Reading>> {
    let mut progress = |all: f64, of_part: &Progress| {
        let fraction = (1.0 - LIGHT_PATHS) * all;
        (watch.progress)(&Progress { fraction, ..*of_part })
    };
    let rounds = sensing.effort.rounds;
    let mut values = vec![Vec::with_capacity(rounds as usize); sensing.sensors.len()];
    for round in 0..rounds {
        let done = |within: f64| (f64::from(round) + within) / f64::from(rounds);
        let found = sensing.round(light_paths.clone(), round, &mut |of_round| progress(done(of_round.fraction), of_round))?;
        values.iter_mut().zip(found).for_each(|(values, value)| values.push(value));
    }
    let own: Vec<Reading> = values.iter().map(|values| Reading::of_parts(values.iter().copied())).collect();
    let mut progress = |of_part: &Progress| {
        let fraction = 1.0 - LIGHT_PATHS * (1.0 - of_part.fraction);
        (watch.progress)(&Progress { fraction, ..*of_part })
    };
    let mut watch = Watch { previous: None, cancel: watch.cancel, progress: &mut progress };
    let brought = brought(sensing, discs, &own, &Brought { sampler: light_paths.0.sampler(), whole: false }, &mut watch)?;
    let all = sensing.sensors.iter().zip(discs.all()).zip(own.iter().zip(&brought));
    let readings = all.map(|((sensor, disc), (own, brought))| match (sensor.looks, disc.radius > 0.0) {
        (true, _) => *own,
        (false, true) => own.plus(&brought.times(f64::from(sensor.surroundings.squared_index))),
        (false, false) => Reading::UNKNOWN,
    });
    Ok(readings.collect())
}
