//! View out of rooms as EN 17037 has it (2018, 5.2 and annex C): what eyes see of the outside, by rays without noise.
//!
//! [`view_out`] sends a fan of rays from each eye. `looks` follows them through panes and open holes, `met` finds what is in their way, `outdoors` tells inside
//! from outside, `ends` names the layers, `figures` makes sight angle and outside distance of them, `levels` judges these.

mod ends;
mod fan;
mod figures;
mod levels;
mod looks;
mod met;
mod outdoors;
mod prims;
mod task;
#[cfg(test)]
mod tests;

pub use figures::{FARTHEST_M, Layer};
pub use levels::{AreaView, Criterion, SHARE, ViewLevel};
pub use task::ViewTask;

use crate::{
    compile::{CompiledScene, compile},
    error::{Diagnostic, Error, Result},
    measure::{MOST_POINTS, Room, Watch},
    render::Progress,
    scene::{Origin, Scene},
    threads::in_pool,
};
use fan::Fan;
use figures::Outside;
use gonio_simd::Execution;
use looks::Looks;
use prims::Prims;
use rayon::prelude::*;
use std::{
    sync::atomic::Ordering,
    time::{Duration, Instant},
};

/// Degrees between rays: of least and of most.
const STEPS_DEG: [f64; 2] = [0.1, 5.0];
/// Azimuths whose rays are followed together.
const TOGETHER: usize = 16;

/// What an eye sees of the outside.
#[derive(Clone, Debug, PartialEq)]
pub struct View {
    /// Where it is, metres.
    pub position: [f64; 3],
    /// Degrees of azimuth in which any ray goes out.
    pub sight_angle_deg: f64,
    /// Degrees of the widest part without a break.
    pub widest_deg: f64,
    /// Metres from the openings, across them, to what stands in the way, over the azimuths of the sight angle: least, lower quartile, median, upper quartile,
    /// greatest. None without a view; [`FARTHEST_M`] where nothing stands there.
    pub distances_m: Option<[f64; 5]>,
    /// Steradians in which sky, landscape and ground are seen.
    pub layers_sr: [f64; 3],
    /// Whether any ray goes out without a pane.
    pub by_hole: bool,
    /// Whether rays above and below the horizon meet nothing.
    pub has_open_horizon: bool,
}

/// What eyes at some places see, and what is doubtful of it.
///
/// # Errors
/// Settings out of their range, prims that are not there or that nobody sees through, what compiling finds, cancellation.
pub fn view_out(
    scene: &Scene,
    eyes: &[[f64; 3]],
    task: &ViewTask,
    execution: Execution,
    watch: &mut Watch<'_>,
) -> Result<(Vec<View>, Vec<Diagnostic>)> {
    let fan = checked(task, eyes)?;
    let dark = Scene { lights: Vec::new(), ..scene.without_emission() };
    let compiled = compile(&dark, watch.previous, watch.cancel)?;
    let prims = Prims::find(scene, task, &compiled)?;
    let start = Instant::now();
    let mut rooms: Vec<Room> = Vec::new();
    let mut views = Vec::with_capacity(eyes.len());
    let mut without_room = 0;
    for (done, eye) in eyes.iter().enumerate() {
        let room = if prims.are_openings_named() { None } else { room_about(&mut rooms, &compiled, *eye, task.up) };
        let looks = Looks { scene: &compiled, task, prims: &prims, room, eye: *eye, axes: fan.axes, execution };
        let view = View::new(*eye, &fan, &ends(&looks, &fan));
        without_room += usize::from(view.by_hole && room.is_none());
        views.push(view);
        tell(watch, (done + 1, eyes.len()), (&fan, start))?;
    }
    let mut diagnostics = compiled.diagnostics;
    diagnostics.extend(doubts(&views, task, without_room));
    Ok((views, diagnostics))
}

/// The directions of a task that makes sense.
fn checked(task: &ViewTask, eyes: &[[f64; 3]]) -> Result<Fan> {
    let [least, most] = STEPS_DEG;
    let wrong = |name, problem: String| Err(Error::setting(name, problem));
    if !(least..=most).contains(&task.step_deg) {
        return wrong("step", format!("{}° was found, expected {least} to {most}", task.step_deg));
    }
    if !(task.step_deg..=90.0).contains(&task.field_deg) {
        return wrong("field", format!("{}° was found, expected the step to 90", task.field_deg));
    }
    if !(0.0..=task.field_deg).contains(&task.horizon_deg) {
        return wrong("horizon", format!("{}° was found, expected 0 to the field of {}", task.horizon_deg, task.field_deg));
    }
    if !(0.0..=FARTHEST_M).contains(&task.nearest_m) {
        return wrong("nearest", format!("{} m was found, expected 0 to {FARTHEST_M}", task.nearest_m));
    }
    if let Some([x, y, z]) = eyes.iter().find(|eye| eye.iter().any(|x| !x.is_finite())) {
        return wrong("points", format!("an eye at {x}, {y}, {z} was found, expected finite numbers"));
    }
    if eyes.len() > MOST_POINTS {
        return wrong("points", format!("{} were found, expected at most {MOST_POINTS}; take a wider spacing", eyes.len()));
    }
    let fan = Fan::new(task.up, task.step_deg.to_radians(), task.field_deg.to_radians());
    fan.ok_or_else(|| Error::setting("up", "it has no direction"))
}

/// The closed room that an eye is in, one of those that are known where it can be.
fn room_about<'a>(rooms: &'a mut Vec<Room>, scene: &CompiledScene, eye: [f64; 3], up: [f64; 3]) -> Option<&'a Room> {
    let known = rooms.iter().position(|room| room.contains(eye));
    let number = known.or_else(|| {
        rooms.push(Room::about(scene, eye, up)?);
        Some(rooms.len() - 1)
    })?;
    rooms.get(number)
}

/// Where the rays of a fan end, azimuth by azimuth.
fn ends(looks: &Looks<'_>, fan: &Fan) -> Vec<Option<Outside>> {
    let parts: Vec<usize> = (0..fan.azimuths).step_by(TOGETHER).collect();
    let of_part = |first: &usize| {
        let azimuths = *first..(first + TOGETHER).min(fan.azimuths);
        let elevations = 0..fan.elevations.len();
        let directions = azimuths.flat_map(|azimuth| elevations.clone().map(move |elevation| fan.direction(azimuth, elevation)));
        looks.follow(directions.collect())
    };
    let found: Vec<_> = in_pool(|| parts.par_iter().map(of_part).collect());
    found.concat()
}

/// Says how far it is; an error where that is enough.
fn tell(watch: &mut Watch<'_>, (done, all): (usize, usize), (fan, start): (&Fan, Instant)) -> Result<()> {
    let (fraction, elapsed) = (done as f64 / all as f64, start.elapsed());
    let remaining = Some(elapsed.mul_f64(1.0 / fraction - 1.0)).filter(|left| *left > Duration::ZERO);
    let rays = (done * fan.azimuths * fan.elevations.len()) as u64;
    let progress = Progress { fraction, samples: done as u32, samples_total: all as u32, elapsed, remaining, rays };
    let goes_on = !watch.cancel.load(Ordering::Relaxed) && (watch.progress)(&progress);
    if goes_on { Ok(()) } else { Err(Error::Cancelled) }
}

/// What to say of figures that a model without surroundings or rooms gives.
fn doubts(views: &[View], task: &ViewTask, without_room: usize) -> Vec<Diagnostic> {
    let (origin, all) = (Origin::new("view out"), views.len());
    let mut found = Vec::new();
    let bare = views.iter().filter(|view| view.has_open_horizon && !view.sees(Layer::Landscape)).count();
    if bare > 0 && task.horizon_deg <= 0.0 {
        let problem = format!(
            "{bare} of {all} eyes see an open horizon and no landscape: only what is modelled is landscape; --horizon takes what lies near the horizon for it"
        );
        found.push(Diagnostic::warning(&origin, problem));
    }
    if without_room > 0 {
        let problem = format!(
            "{without_room} of {all} eyes look out by open holes and have no closed room about them: what stands before holes is taken for the room's own; \
             name the windows with --openings"
        );
        found.push(Diagnostic::warning(&origin, problem));
    }
    found
}
