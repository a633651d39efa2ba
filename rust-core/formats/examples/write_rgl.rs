//! Writes an RGL measurement of a GGX surface, and its BRDF × cosine at random directions, to compare with other readers of such files:
//! `cargo run --example write_rgl -- isotropic|anisotropic OUT.bsdf OUT.pairs COUNT`.
//!
//! The pairs are little-endian doubles, nine each: `wi`, `wo` and the three channels.

use std::error::Error;

use gonio_formats::bsdf::{Measured, Rgl, RglGrid};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [kind, file, pairs, count] = &arguments[..] else {
        return Err("usage: write_rgl isotropic|anisotropic OUT.bsdf OUT.pairs COUNT".into());
    };
    let (alpha, grid) = match kind.as_str() {
        "isotropic" => ([0.3, 0.3], RglGrid::isotropic(12, 1.45, [128, 64], 48)),
        "anisotropic" => ([0.25, 0.5], RglGrid::anisotropic(17, 8, 1.45, [64, 96], 32)),
        other => return Err(format!("\"{other}\", expected isotropic or anisotropic").into()),
    };
    let rgl = Rgl::from_function(&grid, "a GGX surface", |wi, wo| ggx(alpha, wi, wo))?;
    let bytes = rgl.write();
    std::fs::write(file, &bytes)?;
    let material = Measured::Rgl(Box::new(Rgl::read(&bytes)?));
    std::fs::write(pairs, evaluations(&material, count.parse()?))?;
    Ok(())
}

/// The material at quasi-random directions (Roberts' R₄), uniform over the hemisphere down to 3° above the surface.
fn evaluations(material: &Measured, count: u32) -> Vec<u8> {
    let direction = |u: f64, v: f64| {
        let z = 0.05 + 0.95 * u;
        let (sine, phi) = ((1.0 - z * z).max(0.0).sqrt(), std::f64::consts::TAU * v);
        [sine * phi.cos(), sine * phi.sin(), z]
    };
    let mut bytes = Vec::new();
    let mut values = [0.0; 3];
    for i in 1..=count {
        let u = [0.856_674_9, 0.733_891_9, 0.628_706_7, 0.538_597_3].map(|step: f64| (step * f64::from(i)).fract());
        let (wi, wo) = (direction(u[0], u[1]), direction(u[2], u[3]));
        material.eval(wi, wo, &mut values);
        [wi, wo, values].as_flattened().iter().for_each(|x| bytes.extend(x.to_le_bytes()));
    }
    bytes
}

/// GGX with height-correlated Smith shadowing × cosine of `wi`, coloured by Schlick's Fresnel term.
fn ggx([ax, ay]: [f64; 2], wi: [f64; 3], wo: [f64; 3]) -> [f64; 3] {
    let sum = [wi[0] + wo[0], wi[1] + wo[1], wi[2] + wo[2]];
    let length = sum.iter().map(|x| x * x).sum::<f64>().sqrt();
    if wi[2] <= 0.0 || wo[2] <= 0.0 || length == 0.0 {
        return [0.0; 3];
    }
    let h = sum.map(|x| x / length);
    let slope = (h[0] / ax).powi(2) + (h[1] / ay).powi(2) + h[2] * h[2];
    let lambda = |d: [f64; 3]| 0.5 * ((1.0 + ((d[0] * ax).powi(2) + (d[1] * ay).powi(2)) / (d[2] * d[2])).sqrt() - 1.0);
    let value = 1.0 / (std::f64::consts::PI * ax * ay * slope * slope * (1.0 + lambda(wi) + lambda(wo)) * 4.0 * wo[2]);
    let cosine = wi[0] * h[0] + wi[1] * h[1] + wi[2] * h[2];
    [0.9, 0.6, 0.3].map(|f| value * (f + (1.0 - f) * (1.0 - cosine).powi(5)))
}
