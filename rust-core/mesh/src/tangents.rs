//! Tangent frames of triangles from texture coordinates.

use super::vector::{Vec3, add, angle_between, cross, dot, normalized, perpendicular, scale, sub};

/// Tangent and handedness per triangle corner, as (x, y, z, sign) with bitangent = sign × (normal × tangent); three per
/// triangle. Corners that share their point, normal and texture coordinates, on triangles of one handedness, get the same
/// tangent: the mean weighted by angle (as MikkTSpace does). Where the texture coordinates have no area any unit vector
/// perpendicular to the normal is given, with sign +1. `normals` (unit) and `uvs` have three entries per triangle;
/// missing ones count as degenerate.
#[must_use]
pub fn corner_tangents(points: &[[f32; 3]], triangles: &[[u32; 3]], normals: &[[f32; 3]], uvs: &[[f32; 2]]) -> Vec<[f32; 4]> {
    let mut keyed: Vec<([u32; 7], u32)> = Vec::with_capacity(3 * triangles.len());
    let mut tangents = vec![[0.0; 4]; 3 * triangles.len()];
    let mut raw = vec![[0.0; 3]; 3 * triangles.len()];
    for (triangle, vertices) in triangles.iter().enumerate() {
        let first = 3 * triangle;
        let frame = triangle_frame(points, vertices, uvs.get(first..first + 3));
        for k in 0..3 {
            let corner = first + k;
            let normal = normals.get(corner).copied().unwrap_or([0.0, 0.0, 1.0]);
            let uv = uvs.get(corner).copied().unwrap_or_default();
            let Some((tangent, sign)) = frame else {
                tangents[corner] = fallback(normal);
                continue;
            };
            tangents[corner][3] = sign;
            raw[corner] = weighted(points, vertices, k, in_plane(tangent, normal));
            let bits = |x: f32| (x + 0.0).to_bits();
            let key = [vertices[k], bits(normal[0]), bits(normal[1]), bits(normal[2]), bits(uv[0]), bits(uv[1]), bits(sign)];
            keyed.push((key, corner as u32));
        }
    }
    keyed.sort_unstable();
    for run in keyed.chunk_by(|a, b| a.0 == b.0) {
        let total = run.iter().fold([0.0; 3], |total, &(_, corner)| add(total, raw[corner as usize]));
        for &(_, corner) in run {
            let corner = corner as usize;
            let normal = normals.get(corner).copied().unwrap_or([0.0, 0.0, 1.0]);
            let sign = tangents[corner][3];
            let mean = normalized(in_plane(total, normal));
            tangents[corner] = mean.map_or_else(|| fallback(normal), |[x, y, z]| [x, y, z, sign]);
        }
    }
    tangents
}

/// Direction of growing u, and whether (u, v) turn the same way as the triangle's corners.
fn triangle_frame(points: &[Vec3], vertices: &[u32; 3], uvs: Option<&[[f32; 2]]>) -> Option<(Vec3, f32)> {
    let uvs = uvs?;
    let at = |k: usize| points.get(vertices[k] as usize).copied();
    let origin = at(0)?;
    let (edge1, edge2) = (sub(at(1)?, origin), sub(at(2)?, origin));
    let (du1, dv1) = (uvs[1][0] - uvs[0][0], uvs[1][1] - uvs[0][1]);
    let (du2, dv2) = (uvs[2][0] - uvs[0][0], uvs[2][1] - uvs[0][1]);
    let area = du1 * dv2 - du2 * dv1;
    if area == 0.0 || !area.is_finite() {
        return None;
    }
    let sign = area.signum();
    let tangent = normalized(scale(sub(scale(edge1, dv2), scale(edge2, dv1)), sign))?;
    Some((tangent, sign))
}

fn weighted(points: &[Vec3], vertices: &[u32; 3], k: usize, tangent: Vec3) -> Vec3 {
    let at = |k: usize| points[vertices[k % 3] as usize];
    let angle = angle_between(sub(at(k + 1), at(k)), sub(at(k + 2), at(k)));
    normalized(tangent).map_or([0.0; 3], |unit| scale(unit, angle))
}

fn in_plane(vector: Vec3, normal: Vec3) -> Vec3 {
    sub(vector, scale(normal, dot(vector, normal)))
}

fn fallback(normal: Vec3) -> [f32; 4] {
    let normal = normalized(normal).unwrap_or([0.0, 0.0, 1.0]);
    let tangent = perpendicular(normal);
    debug_assert!(dot(cross(normal, tangent), tangent).abs() < 1e-3, "the fallback is perpendicular");
    [tangent[0], tangent[1], tangent[2], 1.0]
}
