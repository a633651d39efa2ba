//! The zones of a plan and their points.

use super::{
    patch::{Patch, Raster, usual_spacing},
    plan::{Plan, Room, Task},
};
use crate::Spot;

/// What is left out along walls (EN 12464-1): part of the narrower side, and metres at most.
const BORDER: [f64; 2] = [0.15, 0.5];
/// Rows of points across a surround, at least.
const ROWS: f64 = 2.0;

/// What a zone is of its room or its task.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Task,
    Surround,
    Background,
    Wall,
    Ceiling,
    /// Cylindrical illuminance, and that of level planes at the same points.
    Cylinder,
    Level,
}

/// A zone.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Part {
    pub(crate) kind: Kind,
    pub(crate) spots: Vec<Spot>,
    /// Where they lie on it.
    pub(crate) raster: Raster,
    /// m².
    pub(crate) size: f64,
}

impl Part {
    fn new(kind: Kind, raster: Raster, spot: impl Fn([f64; 2]) -> Spot) -> Self {
        Self { kind, spots: raster.cells.iter().map(|(_, at)| spot(*at)).collect(), raster, size: 1.0 }
    }

    fn on(patch: &Patch, kind: Kind, raster: Raster) -> Self {
        Self { size: patch.size(), ..Self::new(kind, raster, |at| patch.spot(at)) }
    }
}

/// A plan whose outlines lie in their planes.
#[derive(Debug)]
pub(crate) struct Laid<'a> {
    plan: &'a Plan,
    up: [f64; 3],
    rooms: Vec<Patch>,
    tasks: Vec<Patch>,
}

impl<'a> Laid<'a> {
    pub(crate) fn new(plan: &'a Plan, up: [f64; 3]) -> Self {
        // What is no plane was refused when the plan was read.
        let rooms = plan.rooms.iter().filter_map(|room| Patch::new(&room.floor, up)).collect();
        let tasks = plan.tasks.iter().filter_map(|task| Patch::new(&task.outline, up)).collect();
        Self { plan, up, rooms, tasks }
    }

    /// The number of a task's room.
    pub(crate) fn room_of(&self, task: usize) -> Option<usize> {
        if let Some(name) = &self.plan.tasks[task].room {
            return self.plan.rooms.iter().position(|room| room.name == *name);
        }
        let patch = &self.tasks[task];
        let count = patch.flat.len() as f64;
        let middle = patch.place([0, 1].map(|k| patch.flat.iter().map(|at| at[k]).sum::<f64>() / count), 0.0);
        let stands = |(room, floor): (&Room, &Patch)| {
            floor.holds(floor.flattened(middle), 0.0) && (-0.01..=room.height).contains(&floor.before(middle))
        };
        self.plan.rooms.iter().zip(&self.rooms).position(stands)
    }

    /// The zones of a room: background, walls, ceiling, cylindrical and level illuminance.
    pub(crate) fn of_room(&self, number: usize) -> Vec<Part> {
        let (room, floor) = (&self.plan.rooms[number], &self.rooms[number]);
        let mut parts = vec![Part::on(floor, Kind::Background, self.background(number))];
        for wall in Patch::walls(&room.floor, self.up, room.height) {
            parts.push(Part::on(&wall, Kind::Wall, wall.points(0.0, room.spacing)));
        }
        if let Some(ceiling) = Patch::lid(&room.floor, self.up, room.height) {
            parts.push(Part::on(&ceiling, Kind::Ceiling, ceiling.points(0.0, room.spacing)));
        }
        parts.extend(self.cylinders(number, floor, floor.points(border(room, floor), room.spacing)));
        parts
    }

    /// The zones of a task: itself, its surround, and over level ones in rooms cylindrical and level illuminance.
    pub(crate) fn of_task(&self, number: usize) -> Vec<Part> {
        let (task, patch) = (&self.plan.tasks[number], &self.tasks[number]);
        let points = patch.points(task.border, task.spacing);
        let mut parts = vec![Part::on(patch, Kind::Task, points.clone()), Part::on(patch, Kind::Surround, self.surround(number))];
        if let Some(room) = self.room_of(number).filter(|_| patch.is_level) {
            parts.extend(self.cylinders(room, patch, points));
        }
        parts
    }

    /// Over points of a patch that are within a room, at its eyes' height.
    fn cylinders(&self, room: usize, patch: &Patch, points: Raster) -> [Part; 2] {
        let (floor, height) = (&self.rooms[room], self.plan.rooms[room].eye_height);
        let over = |at: [f64; 2]| floor.flattened(patch.place(at, 0.0));
        let within = points.keep(|at| floor.holds(over(*at), 0.0));
        let level = within.clone();
        let place = |at: [f64; 2]| floor.place(over(at), height);
        [
            Part::new(Kind::Cylinder, within, |at| Spot::cylinder(place(at), self.up)),
            Part::new(Kind::Level, level, |at| Spot::plane(place(at), self.up)),
        ]
    }

    /// Points of the band about a task, in its plane: those of level ones within its room and off all other tasks.
    fn surround(&self, number: usize) -> Raster {
        let (task, patch) = (&self.plan.tasks[number], &self.tasks[number]);
        let width = task.surround(patch);
        if width <= 0.0 {
            return Raster::default();
        }
        let spacing = task.spacing.unwrap_or_else(|| usual_spacing(patch.sides().map(|side| side + 2.0 * width))).min(width / ROWS);
        let room = self.room_of(number).map(|room| &self.rooms[room]);
        let others = || self.tasks.iter().enumerate().filter(|(other, patch)| *other != number && patch.is_level);
        let is_free = |at: &[f64; 2]| {
            let away = patch.distance(*at);
            let place = patch.place(*at, 0.0);
            let open = |area: &Patch| area.distance(area.flattened(place)) > 0.0;
            away > 0.0
                && away <= width
                && (!patch.is_level || (room.is_none_or(|room| !open(room)) && others().all(|(_, other)| open(other))))
        };
        patch.raster(width, spacing).keep(is_free)
    }

    /// Points of a room's floor that are in no task's surround and not further from the nearest than the background reaches; those of a room without
    /// level tasks all over it.
    fn background(&self, number: usize) -> Raster {
        let (room, floor) = (&self.plan.rooms[number], &self.rooms[number]);
        let own: Vec<(&Task, &Patch)> = (0..self.tasks.len())
            .filter(|task| self.room_of(*task) == Some(number) && self.tasks[*task].is_level)
            .map(|task| (&self.plan.tasks[task], &self.tasks[task]))
            .collect();
        let beyond = |at: &[f64; 2]| {
            let place = floor.place(*at, 0.0);
            let away = own.iter().map(|(task, patch)| patch.distance(patch.flattened(place)) - task.surround(patch));
            away.min_by(f64::total_cmp).is_none_or(|away| away > 0.0 && away <= room.background)
        };
        floor.points(border(room, floor), room.spacing).keep(beyond)
    }
}

fn border(room: &Room, floor: &Patch) -> f64 {
    let [a, b] = floor.sides();
    room.border.unwrap_or((BORDER[0] * a.min(b)).min(BORDER[1]))
}
