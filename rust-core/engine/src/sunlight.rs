//! When the sun shines on points on a day: its way over the sky, past what stands before it.

use crate::{
    error::{Diagnostic, Error, Result},
    measure::{Watch, sun_coefficients},
    scene::{Meter, Scene},
    sky::{Air, Frame, Moment, Place, SunPosition, sun_position},
};
use gonio_annual::SUN_ANGLE_DEG;
use gonio_simd::Execution;

/// Minutes of a step: of least and of most.
const STEPS_MIN: [f64; 2] = [0.25, 60.0];

/// What is asked.
#[derive(Clone, Copy, Debug)]
pub struct SunlightTask {
    /// Where on Earth.
    pub place: Place,
    /// The day, by any time of it.
    pub day: Moment,
    /// Where up and north are in the scene.
    pub frame: Frame,
    /// Degrees above the horizon from which on the sun counts.
    pub least_elevation_deg: f64,
    /// Minutes from one place of the sun to the next.
    pub step_min: f64,
}

/// The sun on a day, and what points get of it.
#[derive(Clone, Debug)]
pub struct Sunlight {
    /// Hours of a step.
    pub step_h: f64,
    /// Steps in which the sun is high enough: the hour of their middle on the place's clock, and where it stands.
    pub suns: Vec<(f64, SunPosition)>,
    /// By point, in which of them any of its disc is seen.
    pub seen: Vec<Vec<bool>>,
}

impl Sunlight {
    /// Hours of sun at a point.
    pub fn hours(&self, point: usize) -> f64 {
        self.seen[point].iter().filter(|seen| **seen).count() as f64 * self.step_h
    }

    /// Hours in which the sun is high enough.
    pub fn possible_hours(&self) -> f64 {
        self.suns.len() as f64 * self.step_h
    }

    /// From when to when a point has sun, in hours of the place's clock.
    pub fn spans(&self, point: usize) -> Vec<[f64; 2]> {
        let mut spans: Vec<[f64; 2]> = Vec::new();
        for ((middle, _), _) in self.suns.iter().zip(&self.seen[point]).filter(|(_, seen)| **seen) {
            let [from, to] = [middle - 0.5 * self.step_h, middle + 0.5 * self.step_h];
            match spans.last_mut() {
                Some(last) if from - last[1] < 0.5 * self.step_h => last[1] = to,
                _ => spans.push([from, to]),
            }
        }
        spans
    }
}

/// Follows the sun over a day. Points get sun on the side of their normal; thin panes let it through.
///
/// # Errors
/// Places, days and steps out of their range, what compiling finds, cancellation.
pub fn sunlight(
    scene: &Scene,
    points: &[Meter],
    task: &SunlightTask,
    execution: Execution,
    watch: &mut Watch<'_>,
) -> Result<(Sunlight, Vec<Diagnostic>)> {
    let [least, most] = STEPS_MIN;
    if !(least..=most).contains(&task.step_min) {
        return Err(Error::setting("step", format!("{} min was found, expected {least} to {most}", task.step_min)));
    }
    if !(0.0..90.0).contains(&task.least_elevation_deg) {
        return Err(Error::setting("least-elevation", format!("{}° was found, expected 0 to less than 90", task.least_elevation_deg)));
    }
    let suns = way(task)?;
    let directions: Vec<[f64; 3]> = suns.iter().map(|(_, sun)| task.frame.to_scene(sun.direction())).collect();
    let up = task.frame.to_scene([0.0, 0.0, 1.0]);
    let angle = SUN_ANGLE_DEG.to_radians();
    let step_h = 24.0 / steps(task) as f64;
    if suns.is_empty() {
        return Ok((Sunlight { step_h, suns, seen: vec![Vec::new(); points.len()] }, Vec::new()));
    }
    let (found, diagnostics) = sun_coefficients(scene, points, (&directions, angle, up), execution, watch)?;
    let seen = found.chunks_exact(suns.len()).map(|row| row.iter().map(|lux| *lux > 0.0).collect()).collect();
    Ok((Sunlight { step_h, suns, seen }, diagnostics))
}

/// Steps of the day, as long as asked for or nearly so.
fn steps(task: &SunlightTask) -> usize {
    (24.0 * 60.0 / task.step_min).round() as usize
}

/// The sun's places in the middles of the day's steps, those that are high enough.
fn way(task: &SunlightTask) -> Result<Vec<(f64, SunPosition)>> {
    let air = Air::standard(&task.place.checked()?);
    let steps = steps(task);
    let mut suns = Vec::new();
    for step in 0..steps {
        let hour = (step as f64 + 0.5) * 24.0 / steps as f64;
        let sun = sun_position(&task.place, &Moment { hour, ..task.day }, &air)?;
        if sun.elevation_deg > task.least_elevation_deg {
            suns.push((hour, sun));
        }
    }
    Ok(suns)
}
