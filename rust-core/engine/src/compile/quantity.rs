//! Lights' quantities as the radiance or intensity that the light table takes.

use super::goniograms::CompiledGoniograms;
use crate::{
    error::Diagnostic,
    light::{FarField, LightKind, LightRecord, Shaping, size_factor},
    scene::{LUMENS_PER_WATT, Light, LightQuantity},
};
use std::f64::consts::PI;

/// Luminance by Rec.709's weights.
fn luminance(c: [f32; 3]) -> f64 {
    let [r, g, b] = c.map(f64::from);
    0.2126 * r + 0.7152 * g + 0.0722 * b
}

/// Gives the records of one light their strength.
pub(super) fn apply(light: &Light, records: &mut [LightRecord], goniograms: &mut CompiledGoniograms, diagnostics: &mut Vec<Diagnostic>) {
    let dimming = if light.dimming.is_finite() { f64::from(light.dimming.max(0.0)) } else { 1.0 };
    let factor = match light.quantity {
        None => Ok(1.0),
        Some(quantity) => {
            let colour = luminance(light.emission.radiance);
            let unit = if colour > 0.0 { 1.0 / colour } else { 0.0 };
            for record in records.iter_mut() {
                record.radiance = light.emission.radiance.map(|x| (f64::from(x) * unit) as f32);
            }
            strength(light, quantity, records, goniograms)
        }
    };
    let factor = factor.unwrap_or_else(|problem| {
        diagnostics.push(Diagnostic::warning(&light.origin, format!("{problem}; the light stays dark")));
        0.0
    });
    for record in records.iter_mut() {
        record.radiance = record.radiance.map(|x| (f64::from(x) * factor * dimming) as f32);
    }
}

/// Radiance in cd/m² (cd for points and openings) that gives records of luminance 1 the quantity.
fn strength(light: &Light, quantity: LightQuantity, records: &[LightRecord], goniograms: &mut CompiledGoniograms) -> Result<f64, String> {
    let Some(first) = records.first() else { return Ok(0.0) };
    if first.kind.is_infinite() {
        return at_infinity(first, quantity);
    }
    let lumens = |flux: f64, goniograms: &mut CompiledGoniograms| per(flux, self::flux(records, goniograms), "sends no light");
    let peaks = |goniograms: &CompiledGoniograms| FarField::new(records, &goniograms.tables).peaks();
    match quantity {
        LightQuantity::Lumens(flux) => lumens(flux, goniograms),
        LightQuantity::Watts(watts) => lumens(watts * LUMENS_PER_WATT, goniograms),
        LightQuantity::LampLumens(flux) => {
            let stated = light.goniogram.as_ref().and_then(|goniogram| goniogram.lamp_flux).unwrap_or(0.0);
            per(flux, stated, "has no goniogram that states its lamps' flux")
        }
        LightQuantity::Candela(intensity) => per(intensity, peaks(goniograms)[0], "sends no light"),
        LightQuantity::Lux { illuminance, distance } => per(illuminance * distance * distance, peaks(goniograms)[0], "sends no light"),
        LightQuantity::Nits(luminance) => per(luminance, peaks(goniograms)[1], "has no surface, and so no luminance"),
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

/// Flux in lm of the records; a goniogram's own is found once for all lights that have it.
fn flux(records: &[LightRecord], goniograms: &mut CompiledGoniograms) -> f64 {
    let first = &records[0];
    let is_measured_alone = first.spot.is_none() && first.shaping == Shaping::default();
    match first.goniogram.filter(|_| is_measured_alone && (first.opening.is_some() || first.kind == LightKind::Point)) {
        Some(number) => goniograms.flux(number),
        None => FarField::new(records, &goniograms.tables).flux(),
    }
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
