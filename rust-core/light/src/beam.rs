//! What narrows a light's beam, as rows keep it.

use super::light_kind::LightKind;
use super::record::{LightRecord, Shaping};
use super::row::field;
use super::vector::{Vector, cross, length, narrow, principal_axes, scale, unit_or};
use std::f32::consts::PI;
use std::f64::consts::FRAC_PI_2;

/// Cosines bound the cone less this.
const SLACK: f32 = 1e-4;
/// Beams of a smaller full angle, in radians, are widened to it: their directions could not be told from one another.
pub(super) const SMALLEST_SPREAD: f32 = 2e-3;
/// Steepness of a hard edge.
const HARD: f64 = 1e30;
/// Reach of lights without spread.
const EVERYWHERE: f32 = 1e18;

/// Fills in the shaping; true where it does anything.
pub(super) fn fill_shaping(shaping: &Shaping, row: &mut [f32]) -> bool {
    let softness = shaping.softness.clamp(0.0, 1.0);
    // A hard cone of 180° holds every direction; a soft one falls off before.
    let hard_and_full = softness == 0.0 && shaping.cone_angle >= PI;
    let angle = if hard_and_full || !shaping.cone_angle.is_finite() { f32::INFINITY } else { shaping.cone_angle.max(0.0) };
    let focus = if shaping.focus > 0.0 { shaping.focus } else { 0.0 };
    row[field::CUTOFF] = angle;
    row[field::SMOOTH_START] = if angle.is_finite() { angle * (1.0 - softness) } else { f32::INFINITY };
    row[field::FOCUS] = focus;
    row[field::TINT..field::TINT + 3].copy_from_slice(&shaping.focus_tint);
    row[field::CONE_COSINE] = if angle < PI { angle.cos() - SLACK } else { -2.0 };
    angle.is_finite() || focus > 0.0
}

/// Fills in the spot's cone; true where there is one.
pub(super) fn fill_spot(record: &LightRecord, axes: [Vector; 3], row: &mut [f32]) -> bool {
    let Some(spot) = record.spot.filter(|spot| spot.angle.is_finite()) else { return false };
    let half = (f64::from(spot.angle) / 2.0).clamp(0.0, std::f64::consts::PI);
    // 1 − cos without its cancellation.
    let fall = 2.0 * (half / 2.0).sin().powi(2);
    let blend = f64::from(spot.blend).clamp(0.0, 1.0);
    let stretch = spot.stretch.map(|s| if s > 0.0 && s.is_finite() { f64::from(s) } else { 1.0 });
    let side = |axis: Vector, stretch: f64, fallback| narrow(scale(unit_or(axis, fallback), 1.0 / stretch));
    row[field::SPOT_X..field::SPOT_X + 3].copy_from_slice(&side(axes[0], stretch[0], [1.0, 0.0, 0.0]));
    row[field::SPOT_Y..field::SPOT_Y + 3].copy_from_slice(&side(axes[1], stretch[1], [0.0, 1.0, 0.0]));
    row[field::SPOT_COSINE] = half.cos() as f32;
    row[field::SPOT_STEEPNESS] = (1.0 / (fall * blend)).min(HARD) as f32;
    let widest = stretch[0].max(stretch[1]).max(1.0);
    if half < FRAC_PI_2 {
        let bound = (half.tan() * widest).atan().cos() as f32 - SLACK;
        row[field::CONE_COSINE] = row[field::CONE_COSINE].max(bound);
    }
    true
}

/// Fills in the spread of a flat light; true where it does anything.
pub(super) fn fill_spread(record: &LightRecord, axes: [Vector; 3], row: &mut [f32]) -> bool {
    row[field::SPREAD_TANGENT] = 1.0;
    row[field::SPREAD_GAIN] = 1.0;
    row[field::REACH] = EVERYWHERE;
    if !record.kind.is_flat() || record.spread.is_nan() || record.spread >= PI {
        return false;
    }
    let half = f64::from(record.spread.max(SMALLEST_SPREAD)) / 2.0;
    let tangent = half.tan();
    row[field::SPREAD_TANGENT] = tangent as f32;
    row[field::SPREAD_GAIN] = (1.0 / (tangent - half)) as f32;
    row[field::SPREAD_COSINE] = half.cos() as f32 - SLACK;
    let area = length(cross(axes[0], axes[1]));
    // The beam's circle about the foot, in the frame: in units of length for rectangles, of radii for disks.
    let reach = match record.kind {
        LightKind::Rectangle => tangent * length(axes[0]) * length(axes[1]) / area,
        LightKind::Disk => {
            let [a, b, _] = principal_axes([axes[0], axes[1], [0.0; 3]]);
            tangent * area.sqrt() / a.min(b)
        }
        _ => f64::from(EVERYWHERE),
    };
    // Rounding must not cut the beam's edge.
    row[field::REACH] = ((reach * 1.0001) as f32).min(EVERYWHERE);
    true
}
