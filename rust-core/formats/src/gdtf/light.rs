//! The light of a mode: an estimate by its beams' two angles.

use super::shape::Shape;
use super::{Beam, BeamKind, Gdtf, Mode};
use crate::error::{FormatError, Result};
use crate::photometry::text::{number, one_line, quote};
use crate::photometry::{Goniogram, HeaderLine, LampSet, Opening, OpeningShape, PhotometricType, Stated, Symmetry};

/// A turn below this, as the difference of a direction's parts, is rounding.
const TURNED: f64 = 1e-3;

/// Beams of different angles in one mode: all of their angles come together.
const MOST_SHAPES: usize = 64;

impl Gdtf {
    /// The light of a mode with all of its beams at their flux: each is round about its axis, with half its peak at its beam angle, a tenth at its field
    /// angle and a super-Gaussian through both. All beams look down, as they hang.
    ///
    /// # Errors
    /// A mode without beams, or without light, or with beams of too many different angles.
    pub fn goniogram(&self, mode: &Mode) -> Result<Goniogram> {
        let shining: Vec<&Beam> = mode.beams.iter().filter(|beam| beam.flux > 0.0).collect();
        let Some(first) = shining.first() else {
            let found = if mode.beams.is_empty() { "no beam" } else { "no beam that has a flux" };
            return Err(FormatError::whole(format!("the mode {} has {found}", quote(&mode.name))));
        };
        let mut shapes: Vec<(&Beam, f64)> = Vec::new();
        for beam in &shining {
            match shapes
                .iter_mut()
                .find(|(known, _)| (known.beam_deg, known.field_deg, known.radius) == (beam.beam_deg, beam.field_deg, beam.radius))
            {
                Some((_, flux)) => *flux += beam.flux,
                None => shapes.push((beam, beam.flux)),
            }
        }
        if shapes.len() > MOST_SHAPES {
            return Err(FormatError::whole(format!(
                "the mode {} has beams of {} kinds, at most {MOST_SHAPES} are summed",
                quote(&mode.name),
                shapes.len()
            )));
        }
        let parts: Vec<Goniogram> = shapes.iter().map(|(beam, flux)| self.beam(beam, *flux)).collect();
        let mut total = Goniogram::sum(&parts.iter().map(|part| (part, 1.0)).collect::<Vec<_>>())?;
        total.lamp_sets = vec![lamps(first, &shining)];
        total.warnings = told(mode, &shining, shapes.len());
        Ok(total)
    }

    /// A beam of a flux in lm.
    fn beam(&self, beam: &Beam, flux: f64) -> Goniogram {
        let (vertical, intensities) = Shape::new(beam.beam_deg, beam.field_deg).table();
        let diameter = 2.0 * beam.radius;
        let shape = if diameter > 0.0 { OpeningShape::Disk } else { OpeningShape::Point };
        let line = |keyword: &str, text: &str| HeaderLine { keyword: keyword.into(), text: one_line(text) };
        let unit = Goniogram {
            photometric_type: PhotometricType::C,
            symmetry: Symmetry::Rotational,
            horizontal: vec![0.0],
            vertical,
            intensities,
            opening: Opening::new(shape, [diameter, diameter, 0.0]),
            body: [0.0; 3],
            lamp_sets: vec![LampSet { count: 1, absolute: true, ..LampSet::default() }],
            lamp_set: 0,
            tilt: None,
            stated: Stated::default(),
            header: vec![line("MANUFAC", &self.manufacturer), line("LUMINAIRE", &self.name)],
            spectrum: None,
            warnings: Vec::new(),
        };
        let own = unit.flux();
        unit.times(flux / own)
    }
}

/// The lamps of a mode: its power, and the colour that all of its beams have.
fn lamps(first: &Beam, shining: &[&Beam]) -> LampSet {
    let same = |of: fn(&Beam) -> Option<f64>| of(first).filter(|value| shining.iter().all(|beam| of(beam) == Some(*value)));
    let watts: Option<f64> = shining.iter().map(|beam| beam.watts).sum();
    LampSet {
        count: 1,
        absolute: true,
        watts: watts.unwrap_or(0.0),
        colour: same(|beam| Some(beam.temperature)).map(|kelvin| format!("{} K", number(kelvin))).unwrap_or_default(),
        colour_rendering: same(|beam| beam.rendering).map(number).unwrap_or_default(),
        ..LampSet::default()
    }
}

/// What a reader should know of the estimate.
fn told(mode: &Mode, shining: &[&Beam], shapes: usize) -> Vec<FormatError> {
    let mut told = vec![
        "GDTF holds no measured light distribution: this is an estimate, round about the beam's axis, with half the peak at the beam angle, a tenth at the \
         field angle, a super-Gaussian through both, and the file's flux"
            .to_owned(),
    ];
    if shining.len() > 1 {
        let words = if shapes > 1 { format!(", of {shapes} kinds") } else { String::new() };
        told.push(format!("the light is the sum of {} beams{words}, and leaves at one place", shining.len()));
    }
    let direction = shining[0].direction;
    if shining.iter().any(|beam| (0..3).any(|k| (beam.direction[k] - direction[k]).abs() > TURNED)) {
        told.push("the beams look in different directions: all are taken along the first one's axis".into());
    }
    let mut unstated: Vec<&str> = shining.iter().flat_map(|beam| beam.unstated.iter().copied()).collect();
    unstated.sort_unstable();
    unstated.dedup();
    if !unstated.is_empty() {
        told.push(format!("the mode {} does not state {}: the format's own values are taken", quote(&mode.name), unstated.join(", ")));
    }
    let any = |is_meant: fn(&Beam) -> bool| shining.iter().find(|beam| is_meant(beam));
    if let Some(beam) = any(|beam| matches!(beam.kind, BeamKind::Rectangle(_))) {
        told.push(format!("the beam {} is a rectangle, and round here", quote(&beam.name)));
    }
    if let Some(beam) = any(|beam| matches!(beam.kind, BeamKind::None | BeamKind::Glow)) {
        told.push(format!("the beam {} is drawn by nothing but its own glow: its angles are taken all the same", quote(&beam.name)));
    }
    if let Some(beam) = any(|beam| Shape::is_hard(beam.beam_deg, beam.field_deg)) {
        let [beam_deg, field_deg] = [beam.beam_deg, beam.field_deg].map(number);
        told.push(format!("the field angle {field_deg}° is not beyond the beam angle {beam_deg}°: the edge is hard, 2 % wide"));
    }
    told.into_iter().map(FormatError::whole).collect()
}
