//! What a GDTF file holds, for machines.

use gonio_formats::gdtf::{Beam, BeamKind, Gdtf, Mode};
use serde_json::{Value, json};
use std::path::Path;

/// Everything in one object.
pub(super) fn as_json(file: &Path, fixture: &Gdtf) -> Value {
    json!({
        "file": file.display().to_string(),
        "gdtf_version": fixture.version,
        "id": fixture.id,
        "manufacturer": fixture.manufacturer,
        "name": fixture.name,
        "modes": fixture.modes.iter().map(|mode| mode_json(fixture, mode)).collect::<Vec<_>>(),
        "emitters": fixture.emitters.iter().map(|emitter| json!({
            "name": emitter.name,
            "chromaticity": emitter.chromaticity,
            "spectrum": emitter.spectrum,
        })).collect::<Vec<_>>(),
        "warnings": fixture.warnings.iter().map(ToString::to_string).collect::<Vec<_>>(),
    })
}

fn mode_json(fixture: &Gdtf, mode: &Mode) -> Value {
    let beams: Vec<Value> = mode.beams.iter().map(|beam| beam_json(fixture, beam)).collect();
    match fixture.goniogram(mode) {
        Ok(found) => {
            let figures = found.figures();
            json!({
                "name": mode.name,
                "flux_lm": figures.flux,
                "watts": figures.watts,
                "estimated_peak_cd": figures.peak,
                "beams": beams,
                "notes": found.warnings.iter().map(ToString::to_string).collect::<Vec<_>>(),
            })
        }
        Err(problem) => json!({ "name": mode.name, "beams": beams, "problem": problem.to_string() }),
    }
}

fn beam_json(fixture: &Gdtf, beam: &Beam) -> Value {
    json!({
        "name": beam.name,
        "type": beam.kind.word(),
        "rectangle_ratio": if let BeamKind::Rectangle(ratio) = beam.kind { Some(ratio) } else { None },
        "flux_lm": beam.flux,
        "beam_angle_deg": beam.beam_deg,
        "field_angle_deg": beam.field_deg,
        "radius_m": beam.radius,
        "cct_k": beam.temperature,
        "ra": beam.rendering,
        "watts": beam.watts,
        "emitter": beam.emitter.and_then(|emitter| fixture.emitters.get(emitter)).map(|emitter| &emitter.name),
        "direction": beam.direction,
        "unstated": beam.unstated,
    })
}
