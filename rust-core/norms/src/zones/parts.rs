//! The zones of a plan and their points.

use super::{
    patch::{Patch, usual_spacing},
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
    /// m².
    pub(crate) size: f64,
}

impl Part {
    fn new(kind: Kind, spots: Vec<Spot>) -> Self {
        Self { kind, spots, size: 1.0 }
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
        let on = |patch: &Patch, at: Vec<[f64; 2]>| at.into_iter().map(|at| patch.spot(at)).collect::<Vec<_>>();
        let mut parts = vec![Part::new(Kind::Background, on(floor, self.background(number)))];
        for wall in Patch::walls(&room.floor, self.up, room.height) {
            parts.push(Part { size: wall.size(), ..Part::new(Kind::Wall, on(&wall, wall.points(0.0, room.spacing))) });
        }
        if let Some(ceiling) = Patch::lid(&room.floor, self.up, room.height) {
            parts.push(Part::new(Kind::Ceiling, on(&ceiling, ceiling.points(0.0, room.spacing))));
        }
        let at = floor.points(border(room, floor), room.spacing);
        parts.extend(self.cylinders(number, at.into_iter().map(|at| floor.place(at, room.eye_height))));
        parts
    }

    /// The zones of a task: itself, its surround, and over level ones in rooms cylindrical and level illuminance.
    pub(crate) fn of_task(&self, number: usize) -> Vec<Part> {
        let (task, patch) = (&self.plan.tasks[number], &self.tasks[number]);
        let points = patch.points(task.border, task.spacing);
        let spots = |at: &[[f64; 2]]| at.iter().map(|at| patch.spot(*at)).collect();
        let mut parts = vec![Part::new(Kind::Task, spots(&points)), Part::new(Kind::Surround, spots(&self.surround(number)))];
        if let Some(room) = self.room_of(number).filter(|_| patch.is_level) {
            let (floor, height) = (&self.rooms[room], self.plan.rooms[room].eye_height);
            let over = points.into_iter().map(|at| floor.place(floor.flattened(patch.place(at, 0.0)), height));
            parts.extend(self.cylinders(room, over));
        }
        parts
    }

    fn cylinders(&self, room: usize, places: impl Iterator<Item = [f64; 3]>) -> [Part; 2] {
        let floor = &self.rooms[room];
        let places: Vec<[f64; 3]> = places.filter(|place| floor.holds(floor.flattened(*place), 0.0)).collect();
        let of = |spot: fn([f64; 3], [f64; 3]) -> Spot| places.iter().map(|place| spot(*place, self.up)).collect();
        [Part::new(Kind::Cylinder, of(Spot::cylinder)), Part::new(Kind::Level, of(Spot::plane))]
    }

    /// Points of the band about a task, in its plane: those of level ones within its room and off all other tasks.
    fn surround(&self, number: usize) -> Vec<[f64; 2]> {
        let (task, patch) = (&self.plan.tasks[number], &self.tasks[number]);
        let width = task.surround(patch);
        if width <= 0.0 {
            return Vec::new();
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
        patch.raster(width, spacing).into_iter().filter(is_free).collect()
    }

    /// Points of a room's floor that are in no task's surround and not further from the nearest than the background reaches; those of a room without
    /// level tasks all over it.
    fn background(&self, number: usize) -> Vec<[f64; 2]> {
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
        floor.points(border(room, floor), room.spacing).into_iter().filter(beyond).collect()
    }
}

fn border(room: &Room, floor: &Patch) -> f64 {
    let [a, b] = floor.sides();
    room.border.unwrap_or((BORDER[0] * a.min(b)).min(BORDER[1]))
}
