//! The part of the OpenPBR surface (version 1.1) that a fit uses: a metal, and a diffuse base under a dielectric reflection, in proportion.
//!
//! As the engine computes it: GGX facets with height-correlated Smith masking, made up for what scatters between them (Turquin 2019), the
//! metal's reflectance by Schlick, the dielectric's by Fresnel, and the base dimmed by what the reflection takes at the view.

use core::f64::consts::PI;

use crate::bsdf::direction::{Direction, combination, dot, normalized};

/// Nodes of the albedo tables along the cosine.
const NODES: usize = 16;

/// Facets along each side of the square that a node averages over.
const FACETS: usize = 12;

/// The narrowest lobe's width: anything narrower is a mirror, which no table holds.
const LEAST_WIDTH: f64 = 1e-4;

/// What a fit moves but for the colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Shape {
    pub(super) roughness: f64,
    pub(super) anisotropy: f64,
    /// Turn of the tangent about the normal, counter-clockwise, radians.
    pub(super) rotation: f64,
    pub(super) ior: f64,
    pub(super) metalness: f64,
}

/// A shape with the albedos that follow from it.
pub(super) struct Model {
    shape: Shape,
    widths: [f64; 2],
    /// Sine and cosine of the rotation.
    turn: [f64; 2],
    /// Albedo of the facets when they reflect everything, by the view's cosine, and its mean.
    white: [f64; NODES],
    white_mean: f64,
    /// The same with Fresnel's reflectance.
    dielectric: [f64; NODES],
    /// The mean of Fresnel's reflectance.
    fresnel_mean: f64,
}

/// What two directions have to do with the colour: BSDF × cosine of `wi` is `constant + metal × c · (facets between) + diffuse × c`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Response {
    /// The dielectric reflection.
    constant: f64,
    /// The diffuse base of colour 1.
    diffuse: f64,
    /// The metal's facets when they reflect everything, once.
    metal: f64,
    /// Schlick's way from the colour to white.
    schlick: f64,
    /// (1 − E) / E of the facets at the view.
    missing: f64,
}

impl Model {
    pub(super) fn new(shape: Shape) -> Self {
        let alpha = (shape.roughness * shape.roughness).max(LEAST_WIDTH);
        let q = (1.0 - shape.anisotropy).max(1e-3);
        let x = alpha * (2.0 / (q * q + 1.0)).sqrt();
        let widths = [x, x * q].map(|width| width.max(LEAST_WIDTH));
        let mean_width = (widths[0] * widths[1]).sqrt();
        let mut model = Self {
            shape,
            widths,
            turn: [shape.rotation.sin(), shape.rotation.cos()],
            white: [0.0; NODES],
            white_mean: 0.0,
            dielectric: [0.0; NODES],
            fresnel_mean: mean(|mu| fresnel(mu, shape.ior)),
        };
        for node in 0..NODES {
            [model.white[node], model.dielectric[node]] = albedos(mean_width, cosine(node), shape.ior);
        }
        model.white_mean = mean(|mu| at(&model.white, mu));
        model
    }

    /// How BSDF × cosine of `wi` follows from the colour; both directions are at the front.
    pub(super) fn response(&self, wi: Direction, wo: Direction) -> Response {
        let [sine, cosine] = self.turn;
        let turned = |d: Direction| [cosine * d[0] + sine * d[1], cosine * d[1] - sine * d[0], d[2]];
        let (wi, wo) = (turned(wi), turned(wo));
        let half = normalized(combination(1.0, wi, 1.0, wo)).unwrap_or([0.0, 0.0, 1.0]);
        let facets = facets(self.widths, wi, wo, half);
        let between = dot(wi, half).clamp(0.0, 1.0);
        let white = at(&self.white, wo[2]).max(1e-4);
        let missing = (1.0 - white).max(0.0) / white;
        let bounce = self.fresnel_mean * self.white_mean / (1.0 - self.fresnel_mean * (1.0 - self.white_mean));
        let factor = 1.0 + bounce * missing;
        let base = 1.0 - self.shape.metalness;
        let taken = (at(&self.dielectric, wo[2]) * factor).min(1.0);
        Response {
            constant: base * facets * fresnel(between, self.shape.ior) * factor,
            diffuse: base * (1.0 - taken) * wi[2] / PI,
            metal: self.shape.metalness * facets,
            schlick: (1.0 - between).powi(5),
            missing,
        }
    }

    /// Albedo of facets that reflect everything, averaged.
    pub(super) fn white_mean(&self) -> f64 {
        self.white_mean
    }
}

impl Response {
    /// BSDF × cosine for a channel's colour, and how it changes with the colour; what scatters between facets is held for that.
    pub(super) fn value(&self, colour: f64, white_mean: f64) -> [f64; 2] {
        let mean = colour + (1.0 - colour) / 21.0;
        let factor = 1.0 + self.missing * mean * white_mean / (1.0 - mean * (1.0 - white_mean));
        let metal = self.metal * factor;
        let slope = self.diffuse + metal * (1.0 - self.schlick);
        [self.constant + metal * self.schlick + slope * colour, slope]
    }
}

/// D G F of facets that reflect everything, over 4 cos θo.
fn facets([x, y]: [f64; 2], wi: Direction, wo: Direction, half: Direction) -> f64 {
    let slope = (half[0] / x).powi(2) + (half[1] / y).powi(2) + half[2] * half[2];
    let density = 1.0 / (PI * x * y * slope * slope);
    density * wi[2] / (2.0 * (stretch([x, y], wo) * wi[2] + stretch([x, y], wi) * wo[2]))
}

/// √(αx² x² + αy² y² + z²).
fn stretch([x, y]: [f64; 2], d: Direction) -> f64 {
    ((x * d[0]).powi(2) + (y * d[1]).powi(2) + d[2] * d[2]).sqrt()
}

/// Unpolarised reflectance of a smooth dielectric from the outside.
fn fresnel(cosine: f64, ior: f64) -> f64 {
    let g = ior * ior - 1.0 + cosine * cosine;
    if g <= 0.0 {
        return 1.0;
    }
    let (g, c) = (g.sqrt(), cosine);
    if g + c <= 0.0 {
        return 1.0;
    }
    let ratio = (c * (g + c) - 1.0) / (c * (g - c) + 1.0);
    0.5 * ((g - c) / (g + c)).powi(2) * (1.0 + ratio * ratio)
}

/// Albedos of white facets and of a dielectric's at a view, by visible normals (Dupuy and Benyoub, Sampling Visible GGX Normals with Spherical
/// Caps, 2023).
fn albedos(width: f64, mu: f64, ior: f64) -> [f64; 2] {
    let wo = [(1.0 - mu * mu).max(0.0).sqrt(), 0.0, mu];
    let stretched = normalized([wo[0] * width, 0.0, mu]).unwrap_or([0.0, 0.0, 1.0]);
    let view = stretch([width; 2], wo);
    let mut sums = [0.0; 2];
    for i in 0..FACETS * FACETS {
        let [u, v] = [i % FACETS, i / FACETS].map(|i| (i as f64 + 0.5) / FACETS as f64);
        let z = 1.0 - v * (1.0 + stretched[2]);
        let (sine, phi) = ((1.0 - z * z).max(0.0).sqrt(), 2.0 * PI * u);
        let cap = [sine * phi.cos() + stretched[0], sine * phi.sin(), z + stretched[2]];
        let Some(half) = normalized([cap[0] * width, cap[1] * width, cap[2]]) else { continue };
        let wi = combination(2.0 * dot(wo, half), half, -1.0, wo);
        if wi[2] > 0.0 {
            // Masking of both directions over the view's alone.
            let seen = wi[2] * (view + mu) / (view * wi[2] + stretch([width; 2], wi) * mu);
            sums[0] += seen;
            sums[1] += seen * fresnel(dot(wo, half).clamp(0.0, 1.0), ior);
        }
    }
    sums.map(|sum| sum / (FACETS * FACETS) as f64)
}

/// A node's cosine.
fn cosine(node: usize) -> f64 {
    (node as f64 / (NODES - 1) as f64).max(1e-3)
}

/// A table's value at a cosine.
fn at(table: &[f64; NODES], mu: f64) -> f64 {
    let place = mu.clamp(0.0, 1.0) * (NODES - 1) as f64;
    let low = (place as usize).min(NODES - 2);
    let t = place - low as f64;
    table[low] * (1.0 - t) + table[low + 1] * t
}

/// The mean over the hemisphere in proportion to the cosine.
fn mean(value: impl Fn(f64) -> f64) -> f64 {
    const POINTS: usize = 64;
    (0..POINTS).map(|i| value(((i as f64 + 0.5) / POINTS as f64).sqrt())).sum::<f64>() / POINTS as f64
}
