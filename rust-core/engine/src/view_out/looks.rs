//! The rays of an eye, followed through what is seen through to where they end.
//!
//! A ray goes out where it passes a pane behind which the sky is seen past everything else, or by an open hole of the room. What it meets then is outside.

use super::{
    figures::Outside,
    met::{Meeting, Met},
    outdoors::{Outdoors, Side},
    prims::Prims,
    task::ViewTask,
};
use crate::{
    compile::CompiledScene,
    measure::{
        Room,
        vector::{Vector, add, dot, scaled, unit},
    },
};
use gonio_simd::Execution;

/// Surfaces that a ray may pass.
const MOST_PANES: usize = 64;
/// Metres before and behind a surface at which the sky is looked for.
const BESIDE_M: f32 = 0.005;
/// Cosine of the angle between directions that are one.
const SAME: f64 = 1.0 - 1e-12;
/// Halvings of a way on which a ray leaves its room.
const HALVINGS: usize = 20;

/// An eye and what surrounds it.
#[derive(Debug)]
pub(super) struct Looks<'a> {
    pub(super) scene: &'a CompiledScene,
    pub(super) task: &'a ViewTask,
    pub(super) prims: &'a Prims,
    /// The closed room that it is in, where there is one.
    pub(super) room: Option<&'a Room>,
    pub(super) eye: Vector,
    /// Two level axes, and up; unit.
    pub(super) axes: [Vector; 3],
    pub(super) execution: Execution,
}

/// A ray under way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Way {
    /// Its number among those that are followed together.
    number: usize,
    /// Unit.
    pub(super) direction: Vector,
    /// Metres that it has come.
    pub(super) from: f32,
    opening: Option<Opening>,
}

/// Where a ray goes out.
#[derive(Clone, Copy, Debug)]
pub(super) struct Opening {
    /// Metres from the eye.
    pub(super) at: f64,
    /// The unit normal of what it goes out through, or of the wall above.
    pub(super) normal: Option<Vector>,
    pub(super) is_hole: bool,
}

/// What is found around an eye while its rays are followed.
struct Around<'a> {
    outdoors: Outdoors<'a>,
    meeting: Meeting,
    /// The level direction that was asked for last, and the normal of the wall there.
    wall: Option<(Vector, Option<Vector>)>,
}

/// What becomes of a ray.
enum Next {
    On(Option<Opening>),
    End(Option<Outside>),
}

impl Looks<'_> {
    /// Where rays end, in their order.
    pub(super) fn follow(&self, directions: Vec<Vector>) -> Vec<Option<Outside>> {
        let mut ends = vec![None; directions.len()];
        let mut ways: Vec<Way> = directions.into_iter().enumerate().map(|(number, direction)| Way::new(number, direction)).collect();
        let outdoors = Outdoors::new(self.scene, self.axes, self.execution);
        let mut around = Around { outdoors, meeting: Meeting::default(), wall: None };
        for _ in 0..MOST_PANES {
            if ways.is_empty() {
                break;
            }
            let mut behind = Vec::new();
            for (way, met) in ways.iter().zip(self.meet(&ways, &mut around.meeting)) {
                let next = met.map_or_else(|| self.nothing(way), |met| (self.next(way, &met, &mut around), met.t));
                match next {
                    (Next::End(end), _) => ends[way.number] = end,
                    (Next::On(opening), t) => behind.push(Way { from: (t * (1.0 + 1e-6)).next_up(), opening, ..*way }),
                }
            }
            ways = behind;
        }
        ends
    }

    /// A ray that meets nothing.
    fn nothing(&self, way: &Way) -> (Next, f32) {
        let is_out = way.opening.is_some() || !self.prims.are_openings_named();
        (Next::End(is_out.then(|| self.open(way.direction, way.opening.is_none()))), f32::INFINITY)
    }

    /// What becomes of a ray at what it meets.
    fn next(&self, way: &Way, met: &Met, around: &mut Around<'_>) -> Next {
        let at = f64::from(met.t);
        let here = || Opening { at, normal: Some(self.normal(met)), is_hole: false };
        if let Some(opening) = way.opening {
            return match at - opening.at < self.task.nearest_m {
                true if met.is_clear => Next::On(Some(opening)),
                true => Next::End(None),
                false => Next::End(Some(self.end(way.direction, met, opening))),
            };
        }
        if self.prims.are_openings_named() {
            let opening = self.prims.is_opening(met.set).then(here);
            return if met.is_clear { Next::On(opening) } else { Next::End(None) };
        }
        if let Some(opening) = self.left(way, met, around) {
            let is_far = at - opening.at >= self.task.nearest_m;
            return Next::End(is_far.then(|| self.end(way.direction, met, opening)));
        }
        if !met.is_clear {
            return Next::End(None);
        }
        let (side, place) = self.beside(way, met, BESIDE_M);
        Next::On(around.outdoors.is_outside(side, place).then(here))
    }

    /// Where a ray has left its room by a hole, if what it meets is outside.
    fn left(&self, way: &Way, met: &Met, around: &mut Around<'_>) -> Option<Opening> {
        let room = self.room?;
        let at = |t: f64| add(self.eye, scaled(way.direction, t));
        let whole = f64::from(met.t - BESIDE_M);
        if room.contains(at(whole)) {
            return None;
        }
        let (side, place) = self.beside(way, met, -BESIDE_M);
        if !around.outdoors.is_outside(side, place) {
            return None;
        }
        let (mut inside, mut outside) = (0.0, whole);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (inside + outside);
            if room.contains(at(middle)) { inside = middle } else { outside = middle }
        }
        Some(Opening { at: inside, normal: self.wall_above(room, way.direction, around), is_hole: true })
    }

    /// The unit normal of the wall that a room has in a direction, above its windows.
    fn wall_above(&self, room: &Room, direction: Vector, around: &mut Around<'_>) -> Option<Vector> {
        let [.., up] = self.axes;
        let level = unit(add(direction, scaled(up, -dot(direction, up))))?;
        // Rays of one azimuth come one after the other.
        if let Some((_, normal)) = around.wall.filter(|(known, _)| dot(*known, level) > SAME) {
            return normal;
        }
        let raised = Looks { eye: add(self.eye, scaled(up, room.section())), ..*self };
        let met = raised.meet(&[Way::new(0, level)], &mut around.meeting);
        let normal = met.first().and_then(|met| met.as_ref()).map(|met| self.normal(met));
        around.wall = Some((level, normal));
        normal
    }

    /// A place so far behind what is met, and the side of it that looks there.
    fn beside(&self, way: &Way, met: &Met, behind: f32) -> (Side, [f32; 3]) {
        let place = self.rebased(add(self.eye, scaled(way.direction, f64::from(met.t + behind))));
        let is_front = (dot(way.direction, self.normal(met)) > 0.0) == (behind > 0.0);
        (Side::new(met.surface, is_front, place), place)
    }
}

impl Way {
    fn new(number: usize, direction: Vector) -> Self {
        Self { number, direction, from: 0.0, opening: None }
    }
}
