//! From meters to sensors, and from their pixels to readings.

use super::{
    MOST_BOUNCES,
    reading::Reading,
    vector::{across, add, cross, scaled, unit},
};
use crate::{
    compile::CompiledScene,
    error::{Error, Result},
    film::Image,
    render::{Progress, Render},
    scene::{Aov, Background, Measurand, Meter, Settings},
    transport::{Sensor, SensorTable, medium_at},
};
use gonio_simd::Execution;
use std::{f64::consts::PI, sync::Arc, time::Duration};

/// How often progress is told.
const TELL_EVERY: Duration = Duration::from_millis(50);
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
}

impl Probe {
    /// # Errors
    /// Positions and directions that are not finite or have no length.
    pub(super) fn new(meter: &Meter) -> Result<Self> {
        let problem = |what: &str, v: [f64; 3]| format!("the meter's {what} is {v:?}, expected finite numbers and a direction");
        let wrong = |what: &str, v: [f64; 3]| Error::scene(&meter.origin, problem(what, v));
        let position = Some(meter.position).filter(|p| p.iter().all(|x| x.is_finite())).ok_or_else(|| wrong("position", meter.position))?;
        let direction = |what, v: [f64; 3]| unit(v).ok_or_else(|| wrong(what, v));
        let plane = |normal, looks| Self { position, normal, side: across(normal, [1.0, 0.0, 0.0]), turn: 0.0, up: [0.0; 3], looks };
        Ok(match meter.measurand {
            Measurand::Illuminance | Measurand::DaylightFactor => plane(direction("normal", meter.normal)?, false),
            Measurand::Luminance => plane(direction("facing", meter.facing)?, true),
            // The eye's illuminance, of which a rating is made.
            Measurand::Ugr => plane(direction("facing", meter.facing)?, false),
            Measurand::Cylindrical | Measurand::Semicylindrical => {
                let axis = direction("axis", meter.normal)?;
                if meter.measurand == Measurand::Semicylindrical && unit(cross(axis, direction("facing", meter.facing)?)).is_none() {
                    return Err(Error::scene(&meter.origin, "half a cylinder faces along its own axis, expected a direction across it"));
                }
                let normal = across(axis, meter.facing);
                let turn = if meter.measurand == Measurand::Cylindrical { PI } else { 0.5 * PI };
                Self { position, normal, side: cross(axis, normal), turn, up: axis, looks: false }
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
            // On the side that is measured, for sensors lie on surfaces.
            medium: medium_at(&scene.tables, add(self.position, scaled(self.normal, BEFORE * error))),
        }
    }
}

/// Measures at all probes; `settings.samples` a point, rounded up to what a block of pixels has room for.
pub(super) fn sense(
    scene: Arc<CompiledScene>,
    probes: &[Probe],
    settings: &Settings,
    execution: Execution,
    progress: &mut dyn FnMut(&Progress) -> bool,
) -> Result<Vec<Reading>> {
    let radius = Some(scene.bounds.radius()).filter(|radius| radius.is_finite()).unwrap_or(0.0);
    let sensors: Vec<Sensor> = probes.iter().map(|probe| probe.sensor(&scene, radius)).collect();
    let table = SensorTable::new(&sensors);
    let side = table.side();
    let blocks: Vec<[usize; 2]> = (0..probes.len()).map(|sensor| table.block(sensor)).collect();
    let settings = Settings {
        resolution: table.resolution(),
        crop: None,
        sample_range: None,
        tile_range: None,
        noise_threshold: 0.0,
        samples: settings.samples.div_ceil((side * side) as u32).max(1),
        // Limits are for pictures' sake.
        kind_bounces: [MOST_BOUNCES; 4],
        clamp_direct: 0.0,
        clamp_indirect: 0.0,
        caustic_paths: [true; 2],
        time_limit_s: 0.0,
        aovs: vec![Aov::Luminance, Aov::Illuminance],
        shader_passes: Vec::new(),
        background: Background::Seen,
        ..settings.clone()
    };
    let mut render = Render::sense(scene, table, &settings, execution);
    while !render.is_finished() {
        // Which tile it was does not matter; waiting for one keeps the loop quiet.
        let _ = render.next_tile(TELL_EVERY);
        if !progress(&render.progress()) {
            render.cancel();
        }
    }
    render.finish()?;
    let image = render.film().develop();
    Ok(probes.iter().zip(blocks).map(|(probe, block)| pooled(&image, probe, block, side)).collect())
}

/// Parts of a block along its side; each is a net of the sampler's sequence itself.
const PARTS: usize = 4;

/// The reading of a block of pixels.
fn pooled(image: &Image, probe: &Probe, [left, top]: [usize; 2], side: usize) -> Reading {
    let aov = if probe.looks { Aov::Luminance } else { Aov::Illuminance };
    let values = image.layer(aov).map_or(&[][..], |layer| &layer.values);
    let (width, part) = (image.size()[0], side / PARTS);
    let mean = |number: usize| {
        let [first_x, first_y] = [left + number % PARTS * part, top + number / PARTS * part];
        let rows = (first_y..first_y + part).filter_map(|row| values.get(row * width + first_x..row * width + first_x + part));
        rows.flatten().map(|value| f64::from(*value)).sum::<f64>() / (part * part) as f64
    };
    Reading::of_parts((0..PARTS * PARTS).map(mean))
}
