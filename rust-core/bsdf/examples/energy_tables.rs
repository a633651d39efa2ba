//! Recomputes the directional-albedo tables of `bsdf/tables`: `cargo run --release -p gonio-bsdf --example energy_tables -- <folder>`.
//!
//! Each node is an integral over visible normals (Heitz 2018) by a midpoint rule in f64, written apart from the lanes code so that it also
//! serves as its oracle. Axes are uniform from 0 to 1: roughness `r` (alpha = r²), cosine `mu`, and for indices z = F0^(1/4).
//! Files hold little-endian `f32`, the last axis fastest: `mu` where it occurs.

use std::f64::consts::PI;
use std::path::Path;

/// Nodes of the two-axis tables.
const FINE: usize = 32;
/// Nodes of each axis of the three-axis tables.
const COARSE: usize = 16;
/// Midpoints along each side of the unit square of random numbers.
const POINTS: usize = 160;

/// Reflected and refracted albedo of a rough interface.
#[derive(Clone, Copy, Default)]
struct Albedo {
    reflected: f64,
    transmitted: f64,
}

fn main() -> std::io::Result<()> {
    let folder = std::env::args().nth(1).unwrap_or_else(|| "src/bsdf/tables".to_owned());
    let folder = Path::new(&folder);
    let white = grid([FINE, FINE], |[r, mu]| reflect_albedo(r, mu, |_| 1.0));
    write(folder, "reflect", &white)?;
    write(folder, "reflect_mean", &cosine_means(&white, FINE))?;
    write(folder, "schlick", &grid([FINE, FINE], |[r, mu]| share(r, mu, |c| (1.0 - c).powi(5))))?;
    write(folder, "charlie", &grid([FINE, FINE], |[r, mu]| charlie_albedo(r, mu)))?;
    let dielectric = cube(|r, z, mu| {
        let (eta, f0) = (index(z), z.powi(4));
        share(r, mu, |c| ((fresnel(c, eta) - f0) / (1.0 - f0)).clamp(0.0, 1.0))
    });
    write(folder, "dielectric", &dielectric)?;
    for (name, inverse) in [("glass", false), ("glass_inverse", true)] {
        let glass = cube(|r, z, mu| {
            let albedo = glass_albedo(r, mu, if inverse { 1.0 / index(z) } else { index(z) });
            albedo.reflected + albedo.transmitted
        });
        write(folder, name, &glass)?;
        write(folder, &format!("{name}_mean"), &cosine_means(&glass, COARSE))?;
    }
    Ok(())
}

/// Index of refraction whose normal reflectance is z⁴.
fn index(z: f64) -> f64 {
    (1.0 + z * z) / (1.0 - z * z)
}

/// The value of node `i` of `count`; the lower end is kept off the singular zero.
fn node(i: usize, count: usize) -> f64 {
    (i as f64 / (count - 1) as f64).max(1e-4)
}

fn grid(size: [usize; 2], value: impl Fn([f64; 2]) -> f64) -> Vec<f64> {
    let mut values = Vec::with_capacity(size[0] * size[1]);
    for i in 0..size[0] {
        for j in 0..size[1] {
            values.push(value([node(i, size[0]), node(j, size[1])]));
        }
    }
    values
}

/// A table over r, z, mu; the index stays finite at z = 0.99.
fn cube(value: impl Fn(f64, f64, f64) -> f64) -> Vec<f64> {
    let mut values = Vec::with_capacity(COARSE * COARSE * COARSE);
    for i in 0..COARSE {
        values.extend(grid([COARSE, COARSE], |[z, mu]| value(node(i, COARSE), z.min(0.99), mu)));
    }
    values
}

/// 2 ∫ value mu dmu of each row, the row being linear between its nodes.
fn cosine_means(values: &[f64], count: usize) -> Vec<f64> {
    let step = 1.0 / (count - 1) as f64;
    values.chunks_exact(count).map(|row| (0..count - 1).map(|j| cell_mean(row[j], row[j + 1], j as f64 * step, step)).sum()).collect()
}

/// 2 ∫ (linear from a to b) mu dmu over a cell that starts at `from`.
fn cell_mean(a: f64, b: f64, from: f64, step: f64) -> f64 {
    let slope = b - a;
    2.0 * step * (from * a + 0.5 * (from * slope + step * a) + step * slope / 3.0)
}

/// Exact unpolarised Fresnel reflectance; `eta` = far over near index.
fn fresnel(c: f64, eta: f64) -> f64 {
    let g = eta * eta - 1.0 + c * c;
    if g <= 0.0 {
        return 1.0;
    }
    let g = g.sqrt();
    let (a, b) = ((g - c) / (g + c), (c * (g + c) - 1.0) / (c * (g - c) + 1.0));
    0.5 * a * a * (1.0 + b * b)
}

/// Smith's Lambda of isotropic GGX.
fn lambda(alpha: f64, mu: f64) -> f64 {
    let tan2 = (1.0 - mu * mu).max(0.0) / (mu * mu);
    0.5 * ((1.0 + alpha * alpha * tan2).sqrt() - 1.0)
}

/// Mean of `value` over the visible normals of a view at cosine `mu`; `value` gets the half vector and the view.
fn visible_normals(alpha: f64, mu: f64, value: impl Fn([f64; 3], [f64; 3]) -> Albedo) -> Albedo {
    let view = [(1.0 - mu * mu).max(0.0).sqrt(), 0.0, mu];
    let length = ((alpha * view[0]).powi(2) + mu * mu).sqrt();
    let stretched = [alpha * view[0] / length, 0.0, mu / length];
    let mut sum = Albedo::default();
    for i in 0..POINTS {
        let phi = 2.0 * PI * (i as f64 + 0.5) / POINTS as f64;
        for j in 0..POINTS {
            let z = 1.0 - (j as f64 + 0.5) / POINTS as f64 * (1.0 + stretched[2]);
            let sin = (1.0 - z * z).max(0.0).sqrt();
            let h = [alpha * (sin * phi.cos() + stretched[0]), alpha * sin * phi.sin(), z + stretched[2]];
            let inverse = (h[0] * h[0] + h[1] * h[1] + h[2] * h[2]).sqrt().recip();
            let part = value(h.map(|x| x * inverse), view);
            sum.reflected += part.reflected;
            sum.transmitted += part.transmitted;
        }
    }
    let count = (POINTS * POINTS) as f64;
    Albedo { reflected: sum.reflected / count, transmitted: sum.transmitted / count }
}

/// Height-correlated G2 over G1 of the view.
fn masking(alpha: f64, mu: f64, light: f64) -> f64 {
    (1.0 + lambda(alpha, mu)) / (1.0 + lambda(alpha, mu) + lambda(alpha, light.abs()))
}

fn reflect_albedo(r: f64, mu: f64, reflectance: impl Fn(f64) -> f64) -> f64 {
    glass_like(r, mu, |c| (reflectance(c), None)).reflected
}

/// Albedo with `reflectance` over the white albedo.
fn share(r: f64, mu: f64, reflectance: impl Fn(f64) -> f64) -> f64 {
    reflect_albedo(r, mu, reflectance) / reflect_albedo(r, mu, |_| 1.0)
}

fn glass_albedo(r: f64, mu: f64, eta: f64) -> Albedo {
    glass_like(r, mu, |c| (fresnel(c, eta), Some(eta)))
}

/// An interface whose reflectance at the half angle comes with the index of what passes, if anything does.
fn glass_like(r: f64, mu: f64, interface: impl Fn(f64) -> (f64, Option<f64>)) -> Albedo {
    let alpha = r * r;
    visible_normals(alpha, mu, |h, view| {
        let c = h[0] * view[0] + h[2] * view[2];
        let (reflectance, eta) = interface(c.clamp(0.0, 1.0));
        let mirrored = 2.0 * c * h[2] - view[2];
        let reflected = if mirrored > 0.0 { reflectance * masking(alpha, mu, mirrored) } else { 0.0 };
        let transmitted = eta.map_or(0.0, |eta| {
            let cos2 = 1.0 - (1.0 - c * c) / (eta * eta);
            let refracted = (c / eta - cos2.max(0.0).sqrt()) * h[2] - view[2] / eta;
            if cos2 > 0.0 && refracted < 0.0 { (1.0 - reflectance) * masking(alpha, mu, refracted) } else { 0.0 }
        });
        Albedo { reflected, transmitted }
    })
}

/// Albedo of the Charlie distribution with Ashikhmin's visibility (Estevez, Kulla 2017).
fn charlie_albedo(r: f64, mu: f64) -> f64 {
    let power = 1.0 / (r * r).max(1e-3);
    let view = [(1.0 - mu * mu).max(0.0).sqrt(), 0.0, mu];
    let points = 4 * POINTS;
    let mut sum = 0.0;
    for i in 0..points {
        let phi = PI * (i as f64 + 0.5) / points as f64;
        for j in 0..points {
            let z = (j as f64 + 0.5) / points as f64;
            let sin = (1.0 - z * z).sqrt();
            let h = [view[0] + sin * phi.cos(), sin * phi.sin(), mu + z];
            let h_z = h[2] / (h[0] * h[0] + h[1] * h[1] + h[2] * h[2]).sqrt();
            let density = (2.0 + power) * (1.0 - h_z * h_z).max(0.0).powf(0.5 * power) / (2.0 * PI);
            sum += density / (4.0 * (z + mu - z * mu)) * z;
        }
    }
    sum * 2.0 * PI / (points * points) as f64
}

#[allow(clippy::cast_possible_truncation, reason = "tables are kept in single precision")]
fn write(folder: &Path, name: &str, values: &[f64]) -> std::io::Result<()> {
    let bytes: Vec<u8> = values.iter().flat_map(|v| (*v as f32).to_le_bytes()).collect();
    std::fs::write(folder.join(format!("{name}.f32")), bytes)
}
