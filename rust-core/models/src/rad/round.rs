//! Round surfaces as meshes of many triangles with smooth normals.

use crate::builder::Triangles;
use crate::vector::{Vec3, across, along, cross};
use std::f64::consts::{PI, TAU};

/// Around an axis.
const SEGMENTS: usize = 96;
/// From pole to pole.
const LATITUDES: usize = 48;

/// One circle of a surface of revolution: radius, height, and its outward normal along both.
#[derive(Clone, Copy)]
struct Circle {
    radius: f64,
    height: f64,
    normal: [f64; 2],
}

impl Triangles {
    /// The same surface with its other side outwards.
    pub(super) fn inside_out(mut self) -> Self {
        self.triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        for normal in self.normals.iter_mut().flatten() {
            *normal = normal.map(|x| -x);
        }
        self
    }
}

/// Circles about an axis, from the first to the last, joined by triangles.
fn revolved(centre: Vec3, axis: Vec3, circles: &[Circle]) -> Triangles {
    let x = across(axis);
    let y = cross(axis, x);
    // Corners lie a little outside, so that the polygon has the circle's area.
    let step = TAU / SEGMENTS as f64;
    let wider = (step / step.sin()).sqrt();
    let mut shape = Triangles { normals: Some(Vec::new()), ..Triangles::default() };
    for circle in circles {
        for segment in 0..SEGMENTS {
            let (s, c) = (segment as f64 * step).sin_cos();
            let outwards = along(x.map(|x| x * c), y, s);
            shape.points.push(along(along(centre, axis, circle.height), outwards, circle.radius * wider));
            let normal = along(outwards.map(|x| x * circle.normal[0]), axis, circle.normal[1]);
            shape.normals.iter_mut().for_each(|normals| normals.push(normal));
        }
    }
    for ring in 1..circles.len() {
        let corner = |ring: usize, segment: usize| (ring * SEGMENTS + segment % SEGMENTS) as u32;
        for segment in 0..SEGMENTS {
            let [a, b] = [corner(ring - 1, segment), corner(ring - 1, segment + 1)];
            let [d, c] = [corner(ring, segment), corner(ring, segment + 1)];
            if circles[ring - 1].radius > 0.0 {
                shape.triangles.push([a, b, c]);
            }
            if circles[ring].radius > 0.0 {
                shape.triangles.push([a, c, d]);
            }
        }
    }
    shape
}

pub(super) fn sphere(centre: Vec3, radius: f64) -> Triangles {
    let circle = |latitude: usize| {
        let (s, c) = (latitude as f64 / LATITUDES as f64 * PI).sin_cos();
        let is_pole = latitude == 0 || latitude == LATITUDES;
        Circle { radius: if is_pole { 0.0 } else { radius * s }, height: -radius * c, normal: [s, -c] }
    };
    revolved(centre, [0.0, 0.0, 1.0], &(0..=LATITUDES).map(circle).collect::<Vec<_>>())
}

/// The side of a cone or a cylinder.
///
/// # Errors
/// It has no width.
pub(super) fn lathe(bottom: Vec3, axis: Vec3, height: f64, [first, last]: [f64; 2]) -> Result<Triangles, String> {
    if first <= 0.0 && last <= 0.0 {
        return Err("both radii are 0".into());
    }
    let slope = (first - last) / height;
    let long = slope.hypot(1.0);
    let normal = [1.0 / long, slope / long];
    let circles = [Circle { radius: first, height: 0.0, normal }, Circle { radius: last, height, normal }];
    Ok(revolved(bottom, axis, &circles))
}

/// A flat ring that faces along its axis.
///
/// # Errors
/// It has no width.
pub(super) fn disc(centre: Vec3, axis: Vec3, [inner, outer]: [f64; 2]) -> Result<Triangles, String> {
    if outer <= inner {
        return Err("both radii are the same".into());
    }
    let circle = |radius| Circle { radius, height: 0.0, normal: [0.0, 1.0] };
    Ok(revolved(centre, axis, &[circle(outer), circle(inner)]))
}
