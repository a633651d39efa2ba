//! What a GDTF file holds, for readers: a stage fixture with the beams of its modes.

use gonio_formats::{
    gdtf::{Beam, Gdtf, Mode},
    photometry::Figures,
    short_number, tame,
};

/// The fixture, line by line; texts of the file do not reach into the terminal.
pub(super) fn as_text(fixture: &Gdtf) -> Vec<String> {
    let mut lines = Vec::new();
    if !fixture.manufacturer.is_empty() {
        lines.push(format!("manufacturer: {}", fixture.manufacturer));
    }
    if !fixture.name.is_empty() {
        lines.push(format!("fixture: {}", fixture.name));
    }
    let version = if fixture.version.is_empty() { "of no stated version".to_owned() } else { fixture.version.clone() };
    lines.push(format!("file: GDTF {version}, {} modes, {} emitters", fixture.modes.len(), fixture.emitters.len()));
    for (index, mode) in fixture.modes.iter().enumerate() {
        lines.extend(mode_lines(fixture, index, mode));
    }
    for emitter in &fixture.emitters {
        let colour = emitter.chromaticity.map(|[x, y]| format!("x {x:.4}, y {y:.4}")).unwrap_or_else(|| "no colour".into());
        let spectrum = if emitter.spectrum.is_empty() { String::new() } else { format!(", spectrum of {} points", emitter.spectrum.len()) };
        lines.push(format!("emitter {}: {colour}{spectrum}", emitter.name));
    }
    lines.extend(fixture.warnings.iter().map(|warning| format!("warning: {warning}")));
    lines.iter().map(|line| tame(line)).collect()
}

fn mode_lines(fixture: &Gdtf, index: usize, mode: &Mode) -> Vec<String> {
    let head = format!("mode {}: {}", index + 1, mode.name);
    let found = match fixture.goniogram(mode) {
        Ok(found) => found,
        Err(problem) => return vec![head, format!("    no light: {problem}")],
    };
    let Figures { flux, watts, efficacy, peak, .. } = found.figures();
    let power = watts.zip(efficacy).map(|(watts, efficacy)| format!(", {watts} W, {efficacy:.1} lm/W")).unwrap_or_default();
    let mut lines = vec![format!("{head}: {flux:.1} lm{power}, about {peak:.0} cd")];
    lines.extend(counted(fixture, &mode.beams).into_iter().map(|line| format!("    {line}")));
    lines.extend(found.warnings.iter().map(|warning| format!("    note: {warning}")));
    lines
}

/// Beams that are the same but for their place, once with their number.
fn counted(fixture: &Gdtf, beams: &[Beam]) -> Vec<String> {
    let mut found: Vec<(String, usize)> = Vec::new();
    for beam in beams {
        let words = words(fixture, beam);
        match found.iter_mut().find(|(known, _)| *known == words) {
            Some((_, count)) => *count += 1,
            None => found.push((words, 1)),
        }
    }
    found.into_iter().map(|(words, count)| if count == 1 { words } else { format!("{count} × {words}") }).collect()
}

fn words(fixture: &Gdtf, beam: &Beam) -> String {
    let emitter = beam.emitter.and_then(|emitter| fixture.emitters.get(emitter));
    let parts = [
        Some(format!("beam {}: {}, {} lm", beam.name, beam.kind.word(), short_number(beam.flux))),
        Some(format!("beam angle {}°, field angle {}°", short_number(beam.beam_deg), short_number(beam.field_deg))),
        Some(format!("{} K", short_number(beam.temperature))),
        beam.rendering.map(|index| format!("Ra {}", short_number(index))),
        beam.watts.map(|watts| format!("{watts} W")),
        Some(format!("radius {} m", short_number(beam.radius))),
        emitter.map(|emitter| format!("spectrum of {}", emitter.name)),
    ];
    parts.into_iter().flatten().collect::<Vec<_>>().join(", ")
}
