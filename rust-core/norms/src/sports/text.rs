//! The figures as text.

use super::{
    figures::{Figures, OfField, uniformities},
    glare::Rating,
    gradient::Gradient,
};
use crate::lit::Lit;

/// Lines for a terminal.
pub fn lines(found: &Figures) -> Vec<String> {
    let mut lines = vec![format!("illuminances times {:.3} for maintenance, glare of new lamps", found.factor)];
    for field in &found.fields {
        let [columns, rows] = field.counts;
        lines.push(format!("field {}, {columns} by {rows} points", field.name));
        let over = found.gradient_over;
        lines.extend(of_lit("horizontal", field, &field.ground, over));
        for (name, lit) in &field.filmed {
            lines.extend(of_lit(&format!("towards camera {name}"), field, lit, over));
            lines.extend(to_vertical(&field.ground, lit));
        }
        if let Some(([x, y, z], rating)) = field.worst() {
            lines.push(format!("  glare, worst of its points at {x:.2}, {y:.2}, {z:.2}: {}", told(rating)));
        }
    }
    lines.extend(found.observers.iter().map(|(name, rating)| format!("observer {name}: {}", told(rating))));
    lines
}

fn of_lit(name: &str, field: &OfField, lit: &Lit, over: f64) -> Vec<String> {
    let Some([least, most, mean]) = lit.ends() else { return Vec::new() };
    let told = |ratio: Option<[f64; 2]>| ratio.map_or("unknown".to_owned(), |[ratio, error]| format!("{ratio:.3} ± {error:.3}"));
    let [u1, u2] = uniformities(lit);
    let Gradient { ratio, percent } = field.gradient(lit, over);
    let percent = percent.map_or("unknown".to_owned(), |[percent, error]| format!("{percent:.1} ± {error:.1} %"));
    vec![
        format!("  {name}: mean {}, least {}, greatest {}", mean.told(), least.told(), most.told()),
        format!("    U1, least to greatest: {}; U2, least to mean: {}", told(u1), told(u2)),
        format!("    steepest between neighbours: {} to 1, a change of {percent} in {over} m", told(ratio)),
    ]
}

/// The mean on the ground over that towards a camera, which EN 12193 wants between 0.5 and 2.
fn to_vertical(ground: &Lit, filmed: &Lit) -> Option<String> {
    let ([.., level], [.., upright]) = (ground.ends()?, filmed.ends()?);
    let [ratio, _] = level.over(upright)?;
    Some(format!("    horizontal to this, in the mean: {ratio:.2}"))
}

fn told(rating: &Rating) -> String {
    match rating.gr {
        Some(gr) => format!("GR {gr:.1} ± {:.1}, looking {}° from the first field's side", rating.error, rating.look_deg),
        None => "no rating: no luminaire within 60° of a line of sight, or no light on the field".to_owned(),
    }
}
