//! Flat outlines with holes, cut into triangles.

use crate::vector::{Vec3, across, along, cross, dot, length, newell, sub, unit};
use earcut::Earcut;

/// Corners that lie off the plane by more than this part of the outline's size are told.
const FLATNESS: f64 = 1e-3;
/// Parts of the area by which the triangles of a sound outline may differ from it.
const AREA_ERROR: f64 = 1e-4;

/// A flat outline that is cut into triangles.
#[derive(Debug)]
pub(crate) struct Cut {
    /// Corners, those of holes after those of the boundary.
    pub(crate) points: Vec<Vec3>,
    /// Counter-clockwise about the normal of the boundary's sense.
    pub(crate) triangles: Vec<[u32; 3]>,
    /// What is doubtful about it.
    pub(crate) doubt: Option<&'static str>,
}

/// Cuts a boundary with holes into triangles.
///
/// # Errors
/// What makes it no surface.
pub(crate) fn cut(boundary: &[Vec3], holes: &[Vec<Vec3>]) -> Result<Cut, String> {
    if let Some(problem) = corner_problem(boundary) {
        return Err(problem);
    }
    let twice = newell(boundary);
    let size = boundary.iter().map(|&p| length(sub(p, boundary[0]))).fold(0.0, f64::max);
    let normal = unit(twice).filter(|_| length(twice) > 1e-12 * size * size);
    let Some(normal) = normal else { return Err("its corners lie on a line".into()) };
    let mut points = boundary.to_vec();
    let mut starts: Vec<u32> = Vec::new();
    for hole in holes {
        if let Some(problem) = corner_problem(hole) {
            return Err(format!("a hole: {problem}"));
        }
        starts.push(u32::try_from(points.len()).map_err(|_| "it has too many corners")?);
        points.extend(hole);
    }
    let x = across(normal);
    let y = cross(normal, x);
    let flat: Vec<[f64; 2]> = points.iter().map(|&p| sub(p, boundary[0])).map(|p| [dot(p, x), dot(p, y)]).collect();
    let mut corners: Vec<u32> = Vec::new();
    Earcut::new().earcut(flat.iter().copied(), &starts, &mut corners);
    let triangles: Vec<[u32; 3]> = corners.chunks_exact(3).map(|c| upright(&flat, [c[0], c[1], c[2]])).collect();
    let off = points.iter().map(|&p| dot(sub(p, boundary[0]), normal).abs()).fold(0.0, f64::max);
    let outer = 0.5 * length(twice);
    let expected = outer - holes.iter().map(|hole| 0.5 * length(newell(hole))).sum::<f64>();
    let found: f64 = triangles.iter().map(|&triangle| area(&flat, triangle)).sum();
    let doubt = if off > FLATNESS * size {
        Some("its corners do not lie in a plane")
    } else if (found - expected).abs() > AREA_ERROR * outer {
        Some("its outline crosses itself or its holes; what of it is there is uncertain")
    } else {
        None
    };
    Ok(Cut { points, triangles, doubt })
}

fn corner_problem(corners: &[Vec3]) -> Option<String> {
    if corners.len() < 3 {
        return Some(format!("{} corners were found, expected three or more", corners.len()));
    }
    corners.iter().flatten().any(|x| x.is_nan() || x.abs() >= 1e15).then(|| "a coordinate is not a finite number".into())
}

fn signed(flat: &[[f64; 2]], [a, b, c]: [u32; 3]) -> f64 {
    let [a, b, c] = [a, b, c].map(|i| flat[i as usize]);
    0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
}

fn area(flat: &[[f64; 2]], triangle: [u32; 3]) -> f64 {
    signed(flat, triangle).abs()
}

fn upright(flat: &[[f64; 2]], triangle: [u32; 3]) -> [u32; 3] {
    let [a, b, c] = triangle;
    if signed(flat, triangle) < 0.0 { [a, c, b] } else { triangle }
}

/// The outline moved along a vector.
pub(crate) fn moved(outline: &[Vec3], by: Vec3) -> Vec<Vec3> {
    outline.iter().map(|&point| along(point, by, 1.0)).collect()
}
