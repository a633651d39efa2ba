//! What the readings come to.

use super::{
    parts::{Kind, Laid, Part},
    patch::Raster,
    plan::Plan,
};
use crate::lit::{Lit, Reading, Spot};
use serde_json::{Map, Value, json};

/// A zone's light.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Zone {
    pub(crate) name: &'static str,
    pub(crate) lit: Lit,
    /// Where its points lie; none of all walls together.
    raster: Option<Raster>,
}

/// A part's light.
#[derive(Clone, Debug)]
struct Measured {
    kind: Kind,
    size: f64,
    lit: Lit,
    raster: Raster,
}

/// A room or a task with its zones.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Zones {
    pub(crate) name: String,
    /// The room of a task.
    pub(crate) room: Option<String>,
    pub(crate) zones: Vec<Zone>,
    /// Each wall, in the order of the floor's corners.
    pub(crate) walls: Vec<Zone>,
    /// Cylindrical over horizontal illuminance, of their means.
    pub(crate) modelling: Option<[f64; 2]>,
}

/// Everything that a plan asks for.
#[derive(Clone, Debug, PartialEq)]
pub struct Figures {
    pub(crate) rooms: Vec<Zones>,
    pub(crate) tasks: Vec<Zones>,
    pub(crate) factor: f64,
    /// What the figures leave out.
    pub(crate) notes: Vec<String>,
}

impl Plan {
    /// All points, in the order of rooms and then of tasks. `up` is a unit vector along an axis.
    pub fn spots(&self, up: [f64; 3]) -> Vec<Spot> {
        let laid = Laid::new(self, up);
        let rooms = (0..self.rooms.len()).flat_map(|room| laid.of_room(room));
        let tasks = (0..self.tasks.len()).flat_map(|task| laid.of_task(task));
        rooms.chain(tasks).flat_map(|part| part.spots).collect()
    }
}

impl Figures {
    /// Of readings at a plan's spots with new lamps, in their order.
    pub fn new(plan: &Plan, up: [f64; 3], readings: &[Reading]) -> Self {
        let laid = Laid::new(plan, up);
        let mut readings = readings.iter().map(|reading| reading.times(plan.maintenance_factor));
        let mut lit = |part: Part| {
            let own: Vec<Reading> = readings.by_ref().take(part.spots.len()).collect();
            Measured { kind: part.kind, size: part.size, lit: Lit::new((&part.spots, &own)), raster: part.raster }
        };
        let mut of = |parts: Vec<Part>| parts.into_iter().map(&mut lit).collect::<Vec<_>>();
        let rooms = (0..plan.rooms.len()).map(|room| Zones::new(&plan.rooms[room].name, None, of(laid.of_room(room)))).collect();
        let tasks = (0..plan.tasks.len()).map(|task| {
            let room = laid.room_of(task).map(|room| plan.rooms[room].name.clone());
            Zones::new(&plan.tasks[task].name, room, of(laid.of_task(task)))
        });
        let tasks = tasks.collect();
        Self { rooms, tasks, factor: plan.maintenance_factor, notes: Vec::new() }
    }

    /// With what the figures leave out.
    pub fn with_notes(self, notes: Vec<String>) -> Self {
        Self { notes, ..self }
    }

    /// What is worth saying of the plan: tasks in no room, zones without a point.
    pub fn doubts(&self) -> Vec<String> {
        let lost = self.tasks.iter().filter(|task| task.room.is_none()).map(|task| {
            format!("task '{}' lies in no room of the plan: no wall ends its surround, and it has no cylindrical illuminance", task.name)
        });
        let all = self.rooms.iter().map(|room| ("room", room)).chain(self.tasks.iter().map(|task| ("task", task)));
        let empty = all.flat_map(|(what, owner)| {
            let needed = owner.zones.iter().filter(|zone| zone.lit.readings.is_empty() && !["surround", "background"].contains(&zone.name));
            needed.map(move |zone| {
                format!("{what} '{}': no point lies within '{}', a smaller border or spacing has some", owner.name, zone.name)
            })
        });
        lost.chain(empty).collect()
    }

    /// For machines; `docs/zones.md` lists the keys.
    pub fn json(&self) -> Value {
        json!({
            "maintenance_factor": self.factor,
            "notes": self.notes,
            "rooms": self.rooms.iter().map(|room| room.json(false)).collect::<Vec<_>>(),
            "tasks": self.tasks.iter().map(|task| task.json(true)).collect::<Vec<_>>(),
        })
    }
}

impl Zones {
    fn new(name: &str, room: Option<String>, parts: Vec<Measured>) -> Self {
        let of = |wanted: Kind| parts.iter().filter(move |part| part.kind == wanted);
        let zone = |name: &'static str, part: &Measured| Zone { name, lit: part.lit.clone(), raster: Some(part.raster.clone()) };
        let one = |kind: Kind, name: &'static str| of(kind).next().map(|part| zone(name, part));
        let mut zones: Vec<Zone> = [(Kind::Task, "task"), (Kind::Surround, "surround"), (Kind::Background, "background")]
            .into_iter()
            .filter_map(|(kind, name)| one(kind, name))
            .collect();
        let walls: Vec<Zone> = of(Kind::Wall).map(|part| zone("wall", part)).collect();
        if !walls.is_empty() {
            zones.push(Zone { name: "walls", lit: Lit::joined(of(Kind::Wall).map(|part| (&part.lit, part.size))), raster: None });
        }
        zones.extend(one(Kind::Ceiling, "ceiling"));
        zones.extend(one(Kind::Cylinder, "cylindrical"));
        let mean = |kind: Kind| of(kind).next().and_then(|part| part.lit.ends()).map(|[.., mean]| mean);
        let modelling = mean(Kind::Cylinder).zip(mean(Kind::Level)).and_then(|(cylinder, level)| cylinder.over(level));
        Self { name: name.to_owned(), room, zones, walls, modelling }
    }

    fn json(&self, is_task: bool) -> Value {
        let mut found = Map::new();
        found.insert("name".into(), json!(self.name));
        if is_task {
            found.insert("room".into(), json!(self.room));
        }
        for zone in self.zones.iter().filter(|zone| !zone.lit.readings.is_empty()) {
            found.insert(zone.name.into(), zone.json());
        }
        if !self.walls.is_empty() {
            found.insert("each_wall".into(), self.walls.iter().map(Zone::json).collect());
        }
        found.insert("modelling".into(), json!(self.modelling.map(|[ratio, _]| ratio)));
        found.insert("modelling_error".into(), json!(self.modelling.map(|[_, error]| error)));
        Value::Object(found)
    }
}

impl Zone {
    fn json(&self) -> Value {
        let [u0, ud] = self.lit.uniformities();
        let mut found = self.lit.json(&[("u0", u0), ("ud", ud)]);
        if let Some(Raster { size, spacing, cells }) = &self.raster {
            found.insert("size".into(), json!(size));
            found.insert("spacing_m".into(), json!(spacing));
            found.insert("cells".into(), cells.iter().map(|(cell, _)| json!(cell)).collect());
        }
        Value::Object(found)
    }
}
