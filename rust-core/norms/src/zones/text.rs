//! The figures as text.

use super::figures::{Figures, Zones};
use crate::lit::Lit;

/// Lines for a terminal.
pub fn lines(found: &Figures) -> Vec<String> {
    let mut lines = vec![format!("illuminances times {:.3} for maintenance", found.factor)];
    for room in &found.rooms {
        lines.push(format!("room {}", room.name));
        lines.extend(of_zones(room));
    }
    for task in &found.tasks {
        let room = task.room.as_ref().map_or(String::new(), |room| format!(" in {room}"));
        lines.push(format!("task {}{room}", task.name));
        lines.extend(of_zones(task));
    }
    lines
}

fn of_zones(owner: &Zones) -> Vec<String> {
    let mut lines = Vec::new();
    for zone in &owner.zones {
        lines.extend(of_lit(zone.name, &zone.lit));
        if zone.name == "walls" {
            lines.extend(owner.walls.iter().enumerate().flat_map(|(number, wall)| of_lit(&format!("  wall {}", number + 1), &wall.lit)));
        }
    }
    lines.extend(owner.modelling.map(|[ratio, error]| format!("  modelling, cylindrical to horizontal: {ratio:.3} ± {error:.3}")));
    lines
}

fn of_lit(name: &str, lit: &Lit) -> Option<String> {
    let [least, most, mean] = lit.ends()?;
    let [u0, _] = lit.uniformities();
    let u0 = u0.map_or("unknown".to_owned(), |[ratio, error]| format!("{ratio:.3} ± {error:.3}"));
    let count = lit.readings.len();
    Some(format!("  {name}, {count} points: mean {}, least {}, greatest {}, U0 {u0}", mean.told(), least.told(), most.told()))
}
