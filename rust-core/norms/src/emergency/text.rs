//! The figures as text.

use super::figures::{Figures, Lamp, max_to_min};
use crate::lit::Lit;

/// Lines for a terminal.
pub fn lines(found: &Figures) -> Vec<String> {
    let mut lines = vec![format!("direct light alone, times {:.3} for flux and maintenance", found.factor)];
    for (name, centre, band) in &found.routes {
        lines.push(format!("escape route {name}"));
        lines.extend(of_lit("centre line", centre));
        lines.extend(of_lit("central band", band));
    }
    for (name, lit) in &found.areas {
        lines.push(format!("open area {name}"));
        lines.extend(of_lit("within its border", lit));
    }
    lines.extend(found.places.iter().map(|(name, reading)| format!("place {name}: {}", reading.told())));
    let [from, to] = found.glare_deg;
    if !found.lamps.is_empty() {
        lines.push(format!("greatest intensity from {from}° to {to}° above nadir, with all flux"));
    }
    let peak = |lamp: &Lamp| lamp.peak_cd.map_or("unknown (a picture lies over it)".to_owned(), |peak| format!("{peak:.0} cd"));
    let height = |lamp: &Lamp| {
        lamp.height.map_or("no route or area of the plan lies below it".to_owned(), |height| format!("{height:.2} m above the floor"))
    };
    lines.extend(found.lamps.iter().map(|lamp| format!("  {}: {}, {}", lamp.name, peak(lamp), height(lamp))));
    lines
}

fn of_lit(name: &str, lit: &Lit) -> Vec<String> {
    let Some([least, most, mean]) = lit.ends() else { return vec![format!("  {name}: no point lies within")] };
    let ratio = max_to_min(lit)
        .map_or(if least.lx.is_nan() { "unknown" } else { "without light at a point" }.to_owned(), |[ratio, error]| {
            format!("{ratio:.1} : 1 (± {error:.1})")
        });
    vec![
        format!("  {name}, {} points: least {}, greatest {}, mean {}", lit.readings.len(), least.told(), most.told(), mean.told()),
        format!("    greatest to least: {ratio}"),
    ]
}
