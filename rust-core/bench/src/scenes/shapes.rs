//! Meshes as images of the unit square, with smooth normals and texture coordinates.

use gonio::scene::{Mesh, Primvar, PrimvarInterpolation};
use std::{f32::consts::TAU, sync::Arc};

/// `n` × `m` quads, two triangles each; `point` maps the unit square, and the front is where u × v points to.
pub(super) fn patch(n: u32, m: u32, point: impl Fn(f32, f32) -> [f32; 3]) -> Mesh {
    let mut points = Vec::new();
    let mut st = Vec::new();
    for j in 0..=m {
        for i in 0..=n {
            let (u, v) = (i as f32 / n as f32, j as f32 / m as f32);
            points.push(point(u, v));
            st.extend([u, v]);
        }
    }
    let mut triangles = Vec::new();
    for j in 0..m {
        for i in 0..n {
            let a = j * (n + 1) + i;
            triangles.extend([[a, a + 1, a + n + 2], [a, a + n + 2, a + n + 1]]);
        }
    }
    let normals = primvar("normals", 3, normals(&points, &triangles));
    Mesh {
        points: points.into(),
        triangles: triangles.into(),
        normals: Some(normals),
        primvars: vec![primvar("st", 2, st)],
        ..Mesh::default()
    }
}

/// A parallelogram from a corner and two edges, its front where u × v points to.
pub(super) fn quad(corner: [f32; 3], u: [f32; 3], v: [f32; 3]) -> Mesh {
    patch(1, 1, |s, t| [0, 1, 2].map(|axis| corner[axis] + s * u[axis] + t * v[axis]))
}

/// An ellipsoid with the exponents' powers on its trigonometric functions: 1 is round, less is boxy.
pub(super) fn superellipsoid(n: u32, m: u32, radii: [f32; 3], exponents: [f32; 2]) -> Mesh {
    let power = |x: f32, exponent: f32| x.abs().powf(exponent).copysign(x);
    let [along, around] = exponents;
    patch(n, m, |u, v| {
        let (longitude, latitude) = (-u * TAU, (v - 0.5) * 0.5 * TAU);
        let ring = power(latitude.cos(), along);
        [
            radii[0] * ring * power(longitude.cos(), around),
            radii[1] * power(latitude.sin(), along),
            radii[2] * ring * power(longitude.sin(), around),
        ]
    })
}

/// A ring about the z axis.
pub(super) fn torus(n: u32, m: u32, ring: f32, tube: f32) -> Mesh {
    patch(n, m, |u, v| {
        let (phi, theta) = (u * TAU, v * TAU);
        let r = ring + tube * theta.cos();
        [r * phi.cos(), r * phi.sin(), tube * theta.sin()]
    })
}

/// A body of revolution about the y axis; `profile` gives radius and height along the outline, from below to above on the outside.
pub(super) fn lathe(n: u32, m: u32, profile: impl Fn(f32) -> [f32; 2]) -> Mesh {
    patch(n, m, |u, v| {
        let ([radius, height], phi) = (profile(v), -u * TAU);
        [radius * phi.cos(), height, radius * phi.sin()]
    })
}

fn primvar(name: &str, components: u8, values: Vec<f32>) -> Primvar {
    Primvar { name: name.into(), interpolation: PrimvarInterpolation::Vertex, components, values: Arc::from(values), indices: None }
}

/// Normals of the points: the sum of the triangles' around them, weighed by area.
fn normals(points: &[[f32; 3]], triangles: &[[u32; 3]]) -> Vec<f32> {
    let mut sums = vec![[0.0f32; 3]; points.len()];
    for triangle in triangles {
        let [a, b, c] = triangle.map(|i| points[i as usize]);
        let [u, v] = [b, c].map(|corner| [0, 1, 2].map(|axis| corner[axis] - a[axis]));
        let normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        for corner in triangle {
            (0..3).for_each(|axis| sums[*corner as usize][axis] += normal[axis]);
        }
    }
    let unit = |v: [f32; 3]| v.map(|x| x / v.iter().map(|x| x * x).sum::<f32>().sqrt().max(f32::MIN_POSITIVE));
    sums.into_iter().flat_map(unit).collect()
}
