//! Glare as CIE 112 rates it: GR = 27 + 24 log₁₀(L_vl / L_ve^0.9).
//!
//! L_vl = 10 Σ E θ⁻² is the veil of the luminaires, E what each brings to the eye's plane, lx, and θ its angle to the line of sight, degrees, from 1.5 to 60.
//! L_ve = 0.035 ρ E_h / π is that of the ground, whose reflectance is ρ and mean illuminance E_h.

use crate::Reading;
use std::f64::consts::{LN_10, PI};

/// Degrees off the line of sight within which the veil's formula holds.
const ANGLES: [f64; 2] = [1.5, 60.0];

/// Light that comes straight from a luminaire, or from a part of one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Source {
    /// Unit, from the eye.
    pub direction: [f64; 3],
    /// What it brings to a plane across its way, lx.
    pub lx: f64,
}

/// A rating.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rating {
    /// None where no luminaire is within the formula's angles, or the ground is dark.
    pub(crate) gr: Option<f64>,
    pub(crate) error: f64,
    /// The direction in which the eye looks, degrees from the first field's side.
    pub(crate) look_deg: f64,
    /// Luminaires nearer to the line of sight than the formula holds: they count as at its end.
    pub(crate) nearer: bool,
}

impl Rating {
    /// By which ratings are compared: none is the best.
    pub(crate) fn order(&self) -> f64 {
        self.gr.unwrap_or(f64::NEG_INFINITY)
    }
}

/// The worst of the directions in which an eye looks.
pub(crate) fn worst(sources: &[Source], looks: &[(f64, [f64; 3])], reflectance: f64, ground: Reading) -> Rating {
    let none = Rating { gr: None, error: 0.0, look_deg: 0.0, nearer: false };
    let rated = looks.iter().map(|(look_deg, look)| {
        let (veil, nearer) = veil(sources, *look);
        let (gr, error) = rating(veil, reflectance, ground);
        Rating { gr, error, look_deg: *look_deg, nearer }
    });
    rated.fold(none, |worst, next| if next.order() > worst.order() { next } else { worst })
}

/// Of the luminaires, and whether any is nearer than the formula holds.
fn veil(sources: &[Source], look: [f64; 3]) -> (f64, bool) {
    let mut nearer = false;
    let veil = sources.iter().map(|source| {
        let cosine: f64 = (0..3).map(|k| source.direction[k] * look[k]).sum::<f64>().clamp(-1.0, 1.0);
        let angle = cosine.acos().to_degrees();
        nearer |= angle < ANGLES[0] && source.lx > 0.0;
        if angle > ANGLES[1] { 0.0 } else { 10.0 * source.lx * cosine / angle.max(ANGLES[0]).powi(2) }
    });
    (veil.sum(), nearer)
}

fn rating(veil: f64, reflectance: f64, ground: Reading) -> (Option<f64>, f64) {
    let own = 0.035 * reflectance * ground.lx / PI;
    if veil <= 0.0 || own <= 0.0 {
        return (None, 0.0);
    }
    (Some(27.0 + 24.0 * (veil / own.powf(0.9)).log10()), 24.0 * 0.9 / LN_10 * ground.error / ground.lx)
}
