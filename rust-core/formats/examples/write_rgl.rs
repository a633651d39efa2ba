//! Writes an RGL measurement of a GGX surface, to compare with other readers of such files:
//! `cargo run --example write_rgl -- isotropic|anisotropic OUT.bsdf`.

use std::error::Error;

use gonio_formats::bsdf::{Rgl, RglGrid};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [kind, file] = &arguments[..] else {
        return Err("usage: write_rgl isotropic|anisotropic OUT.bsdf".into());
    };
    let (alpha, grid) = match kind.as_str() {
        "isotropic" => ([0.3, 0.3], RglGrid::isotropic(12, 1.45, [128, 64], 48)),
        "anisotropic" => ([0.25, 0.5], RglGrid::anisotropic(17, 8, 1.45, [64, 96], 32)),
        other => return Err(format!("\"{other}\", expected isotropic or anisotropic").into()),
    };
    let rgl = Rgl::from_function(&grid, "a GGX surface", |wi, wo| ggx(alpha, wi, wo))?;
    std::fs::write(file, rgl.write())?;
    Ok(())
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
