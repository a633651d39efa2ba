//! Lights' quantities as the radiance or intensity that the light table takes.

use super::goniograms::CompiledGoniograms;
use crate::{
    bsdf::parameter::LIGHT,
    colour::luminance,
    error::Diagnostic,
    light::{FarField, LightKind, LightRecord, Shaping, size_factor},
    scene::{Light, LightQuantity, lumens_per_watt},
};
use std::f64::consts::PI;

/// What lights send in all, once for all that are alike but for their place.
#[derive(Debug, Default)]
pub(super) struct FarFields {
    known: Vec<Known>,
}

#[derive(Debug)]
struct Known {
    records: Vec<LightRecord>,
    flux: Option<f64>,
    peaks: Option<[f64; 2]>,
}

impl FarFields {
    /// What is known of a light's records, whose places and colour do not matter.
    fn of(&mut self, records: &[LightRecord]) -> &mut Known {
        let placeless = |record: &LightRecord| {
            let [x, y, z, _] = record.to_world;
            LightRecord { to_world: [x, y, z, [0.0; 3]], radiance: [1.0; 3], texture: None, ..*record }
        };
        let records: Vec<LightRecord> = records.iter().map(placeless).collect();
        let place = self.known.iter().position(|known| known.records == records).unwrap_or_else(|| {
            self.known.push(Known { records, flux: None, peaks: None });
            self.known.len() - 1
        });
        &mut self.known[place]
    }
}

impl Known {
    /// Flux in lm.
    fn flux(&mut self, goniograms: &CompiledGoniograms) -> f64 {
        let records = &self.records;
        *self.flux.get_or_insert_with(|| FarField::new(records, &goniograms.tables).flux())
    }
    /// Greatest intensity in cd and luminance in cd/m².
    fn peaks(&mut self, goniograms: &CompiledGoniograms) -> [f64; 2] {
        let records = &self.records;
        *self.peaks.get_or_insert_with(|| FarField::new(records, &goniograms.tables).peaks())
    }
}

/// Gives the records of one light their strength.
pub(super) fn apply(
    light: &Light,
    records: &mut [LightRecord],
    goniograms: &mut CompiledGoniograms,
    far_fields: &mut FarFields,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let share = light.share();
    let dimming = if share.is_finite() { f64::from(share.max(0.0)) } else { 1.0 };
    let factor = match light.quantity {
        None => Ok(1.0),
        Some(quantity) => {
            // Its sign says whether the light is taken away.
            let colour = luminance(light.emission.radiance.map(f64::from)).abs();
            let unit = if colour > 0.0 { 1.0 / colour } else { 0.0 };
            for record in records.iter_mut() {
                record.radiance = light.emission.radiance.map(|x| (f64::from(x) * unit) as f32);
            }
            strength(light, quantity, records, goniograms, far_fields)
        }
    };
    let factor = factor.unwrap_or_else(|problem| {
        diagnostics.push(Diagnostic::warning(&light.origin, format!("{problem}; the light stays dark")));
        0.0
    });
    let mut most = 0.0f64;
    for record in records.iter_mut() {
        record.radiance = record.radiance.map(|x| {
            let strength = f64::from(x) * factor * dimming;
            most = if strength.is_finite() { most.max(strength.abs()) } else { f64::INFINITY };
            held(strength)
        });
    }
    let [_, limit] = LIGHT;
    if most > f64::from(limit) {
        let problem = format!("its strength is {most:e} or no number, where sums end at {limit:e}; it is held there, or stays dark");
        diagnostics.push(Diagnostic::warning(&light.origin, problem));
    }
}

/// Strength within what sums can hold; none where it is no number.
fn held(strength: f64) -> f32 {
    let [_, limit] = LIGHT;
    if strength.is_nan() { 0.0 } else { (strength as f32).clamp(-limit, limit) }
}

/// Radiance in cd/m² (cd for points and openings) that gives records of luminance 1 the quantity.
fn strength(
    light: &Light,
    quantity: LightQuantity,
    records: &[LightRecord],
    goniograms: &mut CompiledGoniograms,
    far_fields: &mut FarFields,
) -> Result<f64, String> {
    let Some(first) = records.first() else { return Ok(0.0) };
    if first.kind.is_infinite() {
        return at_infinity(first, quantity);
    }
    let known = far_fields.of(records);
    let mut lumens = |flux: f64| per(flux, self::flux(first, known, goniograms), "sends no light");
    match quantity {
        LightQuantity::Lumens(flux) => lumens(flux),
        LightQuantity::Watts(watts) => lumens(watts * lumens_per_watt(light.spectrum.as_deref())),
        LightQuantity::LampLumens(flux) => {
            let stated = light.goniogram.as_ref().and_then(|goniogram| goniogram.lamp_flux).unwrap_or(0.0);
            per(flux, stated, "has no goniogram that states its lamps' flux")
        }
        LightQuantity::Candela(intensity) => per(intensity, known.peaks(goniograms)[0], "sends no light"),
        LightQuantity::Lux { illuminance, distance } => {
            per(illuminance * distance * distance, known.peaks(goniograms)[0], "sends no light")
        }
        LightQuantity::Nits(luminance) => per(luminance, known.peaks(goniograms)[1], "has no surface, and so no luminance"),
        LightQuantity::Measured if first.goniogram.is_none() => Err("the light has no goniogram to take its intensities from".into()),
        LightQuantity::Measured => Ok(1.0),
    }
}

fn per(quantity: f64, unit: f64, problem: &str) -> Result<f64, String> {
    if !(quantity.is_finite() && quantity >= 0.0) {
        return Err(format!("its quantity is {quantity}, expected a number of zero or more"));
    }
    if unit > 0.0 && unit.is_finite() { Ok(quantity / unit) } else { Err(format!("the light {problem}")) }
}

/// Flux in lm of a light whose first record this is; a goniogram's own is found once for all lights that have it.
fn flux(first: &LightRecord, known: &mut Known, goniograms: &mut CompiledGoniograms) -> f64 {
    let is_measured_alone = first.spot.is_none() && first.shaping == Shaping::default();
    match first.goniogram.filter(|_| is_measured_alone && (first.opening.is_some() || first.kind == LightKind::Point)) {
        Some(number) => goniograms.flux(number),
        None => known.flux(goniograms),
    }
}

/// Flux in lm of a light's records as they are, none of them at infinity.
pub(super) fn flux_of(records: &[LightRecord], goniograms: &mut CompiledGoniograms, far_fields: &mut FarFields) -> f64 {
    let Some(first) = records.first() else { return 0.0 };
    luminance(first.radiance.map(f64::from)) * flux(first, far_fields.of(records), goniograms)
}

fn at_infinity(record: &LightRecord, quantity: LightQuantity) -> Result<f64, String> {
    let is_dome = record.kind == LightKind::Dome;
    let solid_angle = if is_dome { PI } else { size_factor(record.kind, [[0.0; 3]; 3], f64::from(record.angle)) };
    match quantity {
        LightQuantity::Lux { illuminance, .. } => per(illuminance, solid_angle, "has no solid angle"),
        LightQuantity::Nits(_) if !is_dome && record.angle <= 0.0 => Err("parallel light has no luminance".into()),
        LightQuantity::Nits(luminance) => per(luminance, 1.0, ""),
        _ => Err("a light at infinity has no flux and no intensity, expected lx or cd/m²".into()),
    }
}
