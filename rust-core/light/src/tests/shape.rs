//! The emitters in double precision, by their parametric surfaces: the oracle of the sampling code.

use crate::vector::{Vector, add, cross, dot, length, scale, unit_or, widen};
use crate::{LightKind, LightRecord};
use std::f64::consts::{PI, TAU};

/// A surface element at `(s, t)` in the unit square: place, and outward normal times area per unit of `s t`.
pub(super) fn element(record: &LightRecord, s: f64, t: f64) -> (Vector, Vector) {
    let [x, y, z, origin] = record.to_world.map(widen);
    let at = |a: f64, b: f64, c: f64| add(origin, add(scale(x, a), add(scale(y, b), scale(z, c))));
    let flat = |n: Vector| if dot(n, z) > 0.0 { scale(n, -1.0) } else { n };
    match record.kind {
        LightKind::Rectangle => (at(2.0 * s - 1.0, 2.0 * t - 1.0, 0.0), flat(scale(cross(x, y), 4.0))),
        LightKind::Disk => {
            let r = s.sqrt();
            (at(r * (TAU * t).cos(), r * (TAU * t).sin(), 0.0), flat(scale(cross(x, y), PI)))
        }
        LightKind::Triangle => {
            let r = s.sqrt();
            (at(1.0 - r, t * r, 0.0), scale(cross(x, y), 0.5))
        }
        LightKind::Cylinder => {
            let (sine, cosine) = (TAU * t).sin_cos();
            let around = scale(add(scale(y, -sine), scale(z, cosine)), TAU);
            let n = cross(around, scale(x, 2.0));
            let place = at(2.0 * s - 1.0, cosine, sine);
            let out = add(scale(y, cosine), scale(z, sine));
            (place, if dot(n, out) < 0.0 { scale(n, -1.0) } else { n })
        }
        LightKind::Sphere => {
            let height = 2.0 * s - 1.0;
            let r = (1.0 - height * height).max(0.0).sqrt();
            let (sine, cosine) = (TAU * t).sin_cos();
            // The normal of a linear image of the unit sphere: the cofactor matrix times the sphere's normal.
            let q = [r * cosine, r * sine, height];
            let cofactor = [cross(y, z), cross(z, x), cross(x, y)];
            let n = add(scale(cofactor[0], q[0]), add(scale(cofactor[1], q[1]), scale(cofactor[2], q[2])));
            let out = add(scale(x, q[0]), add(scale(y, q[1]), scale(z, q[2])));
            let n = scale(n, 4.0 * PI);
            (add(origin, out), if dot(n, out) < 0.0 { scale(n, -1.0) } else { n })
        }
        LightKind::Distant | LightKind::Dome | LightKind::Point | LightKind::FacingDisk => panic!("no surface of its own"),
    }
}

/// The factor of the beam's shaping, per channel.
pub(super) fn shaping(record: &LightRecord, direction: Vector) -> Vector {
    let axis = unit_or(scale(widen(record.to_world[2]), -1.0), [0.0; 3]);
    let cosine = dot(axis, direction).clamp(-1.0, 1.0);
    let s = &record.shaping;
    let mut factor = [1.0; 3];
    if s.focus > 0.0 {
        let power = cosine.abs().powf(f64::from(s.focus));
        factor = widen(s.focus_tint).map(|tint| tint + (1.0 - tint) * power);
    }
    if s.cone_angle.is_finite() {
        let cutoff = f64::from(s.cone_angle);
        let start = cutoff * (1.0 - f64::from(s.softness));
        let angle = cosine.acos();
        let t = if cutoff > start { ((angle - start) / (cutoff - start)).clamp(0.0, 1.0) } else { 0.0 };
        factor = scale(factor, if angle > cutoff { 0.0 } else { 1.0 - t * t * (3.0 - 2.0 * t) });
    }
    scale(factor, spot(record, direction) * spread(record, direction))
}

/// The factor of the spot's cone.
pub(super) fn spot(record: &LightRecord, direction: Vector) -> f64 {
    let Some(spot) = record.spot else { return 1.0 };
    let [x, y, z] = [0, 1, 2].map(|k| dot(unit_or(widen(record.to_world[k]), [0.0; 3]), direction));
    let local = unit_or([x / f64::from(spot.stretch[0]), y / f64::from(spot.stretch[1]), z], [0.0; 3]);
    let edge = (f64::from(spot.angle) / 2.0).cos();
    let range = (1.0 - edge) * f64::from(spot.blend);
    let inside = -local[2] - edge;
    let t = if range > 0.0 { (inside / range).clamp(0.0, 1.0) } else { f64::from(u8::from(inside > 0.0)) };
    t * t * (3.0 - 2.0 * t)
}

/// The factor of a flat light's spread.
pub(super) fn spread(record: &LightRecord, direction: Vector) -> f64 {
    if !record.kind.is_flat() || record.spread >= std::f32::consts::PI {
        return 1.0;
    }
    let half = f64::from(record.spread) / 2.0;
    let normal = unit_or(element(record, 0.5, 0.5).1, [0.0; 3]);
    let tangent = length(cross(normal, direction)) / dot(normal, direction).abs();
    (half.tan() - tangent).max(0.0) / (half.tan() - half)
}

/// Two directions across the way from a facing disk to a point.
pub(super) fn facing_axes(record: &LightRecord, p: Vector) -> [Vector; 2] {
    let away = unit_or(add(widen(record.to_world[3]), scale(p, -1.0)), [0.0, 0.0, 1.0]);
    let first = unit_or(cross(away, if away[0].abs() < 0.5 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] }), [0.0; 3]);
    [first, cross(away, first)]
}

fn element_seen(record: &LightRecord, p: Vector, s: f64, t: f64) -> (Vector, Vector) {
    if record.kind != LightKind::FacingDisk {
        return element(record, s, t);
    }
    let origin = widen(record.to_world[3]);
    let radius = length(widen(record.to_world[0]));
    let (sine, cosine) = (TAU * t).sin_cos();
    let [a, b] = facing_axes(record, p);
    let place = add(origin, add(scale(a, radius * s.sqrt() * cosine), scale(b, radius * s.sqrt() * sine)));
    (place, scale(unit_or(add(p, scale(origin, -1.0)), [0.0; 3]), PI * radius * radius))
}

/// What one element of the surface sends to a point: unit direction to it, distance, solid angle per unit of `s t` (0 from behind).
pub(super) fn seen(record: &LightRecord, p: Vector, s: f64, t: f64) -> (Vector, f64, f64) {
    let (place, normal) = element_seen(record, p, s, t);
    let v = add(place, scale(p, -1.0));
    let distance = length(v);
    let wi = scale(v, 1.0 / distance);
    let facing = -dot(normal, wi);
    let facing = if record.two_sided { facing.abs() } else { facing.max(0.0) };
    (wi, distance, facing / (distance * distance))
}

/// Illuminance per channel at `p` on a surface of normal `n`, by the midpoint rule on `count`² elements.
pub(super) fn illuminance(record: &LightRecord, p: Vector, n: Vector, count: usize) -> Vector {
    let mut sum = [0.0; 3];
    let radiance = widen(record.radiance);
    for i in 0..count {
        for j in 0..count {
            let (wi, _, solid) = seen(record, p, (i as f64 + 0.5) / count as f64, (j as f64 + 0.5) / count as f64);
            let cosine = dot(n, wi).max(0.0);
            if cosine > 0.0 && solid > 0.0 {
                let factor = shaping(record, scale(wi, -1.0));
                for k in 0..3 {
                    sum[k] += radiance[k] * factor[k] * cosine * solid;
                }
            }
        }
    }
    scale(sum, 1.0 / (count * count) as f64)
}
