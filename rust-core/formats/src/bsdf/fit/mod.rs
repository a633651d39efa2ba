//! The OpenPBR surface that comes nearest to a measured reflection, for programs that take no measurements.
//!
//! Nearness is the root mean square of differences between cube roots of BSDF × cosine, which comes close to what the eye sees (Fores,
//! Ferwerda and Gu, Toward a Perceptually Based Metric for BRDF Modeling, 2012). For given roughness, index and anisotropy the colour is
//! solved for directly, everything else by simplex from several places.

mod model;
mod observations;
mod simplex;

use core::f64::consts::PI;

use super::direction::spherical;
use super::hemispheres::Hemispheres;
use super::measured::Measured;
use super::quadrature::quadrature;
use crate::error::{FormatError, Result};
use model::{Model, Shape};
use observations::Observations;
use simplex::minimise;

/// A mixture of metal and dielectric has to be better than either by that factor to be taken for one.
const MIXTURE_GAIN: f64 = 0.9;

/// Indices of refraction that are tried.
const IOR: [f64; 2] = [1.0, 3.0];

/// The most anisotropic lobe that is tried.
const MOST_ANISOTROPY: f64 = 0.97;

/// Strata of the fitted albedo's quadrature.
const STRATA: usize = 64;

/// Angles that the albedos of measurement and fit are compared at, degrees.
const THETA_DEG: [f64; 4] = [0.0, 45.0, 60.0, 75.0];

/// The albedo of light at an angle, in linear Rec.709.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FittedAlbedo {
    /// The light's angle from the normal, degrees, at azimuth 0.
    pub theta_deg: f64,
    /// What the measurement reflects.
    pub measured: [f64; 3],
    /// What the fit reflects.
    pub fitted: [f64; 3],
}

/// Parameters of the OpenPBR surface; those that are not here have their defaults.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// `base_color`, linear Rec.709.
    pub base_color: [f64; 3],
    /// `base_metalness`.
    pub base_metalness: f64,
    /// `specular_roughness`.
    pub specular_roughness: f64,
    /// `specular_roughness_anisotropy`.
    pub specular_roughness_anisotropy: f64,
    /// `specular_ior`; 1.5 for a metal, which does not use it.
    pub specular_ior: f64,
    /// From the tangent counter-clockwise to the direction of the wider lobe, degrees from 0 to 180.
    pub rotation_deg: f64,
    /// Root mean square of differences between cube roots of BSDF × cosine, over the root mean square of the measured cube roots.
    pub residual: f64,
    /// Albedos beside each other.
    pub albedo: Vec<FittedAlbedo>,
}

impl Measured {
    /// The nearest OpenPBR surface to the reflection at the front.
    ///
    /// # Errors
    /// When nothing is reflected there.
    pub fn fit(&self) -> Result<Fit> {
        if !self.has(Hemispheres::ReflectionFront) {
            return Err(FormatError::whole("nothing is reflected at the front, which a surface could be fitted to"));
        }
        let observations = Observations::of(self);
        if observations.is_black() {
            return Err(FormatError::whole("the front reflects nothing, which a surface could be fitted to"));
        }
        let isotropic = self.is_isotropic();
        let [dielectric, metal] = [0.0, 1.0].map(|metalness| pure(&observations, metalness, isotropic));
        let purest = if metal.1 < dielectric.1 { metal } else { dielectric };
        let mixed = mixture(&observations, purest.0, isotropic);
        let (shape, _) = if mixed.1 < MIXTURE_GAIN * purest.1 { mixed } else { purest };
        let model = Model::new(shape);
        let (base_color, residual) = observations.solve(&model);
        Ok(Fit {
            base_color,
            base_metalness: shape.metalness,
            specular_roughness: shape.roughness,
            specular_roughness_anisotropy: shape.anisotropy,
            specular_ior: if shape.metalness < 1.0 { shape.ior } else { 1.5 },
            rotation_deg: if shape.anisotropy > 0.0 { shape.rotation.to_degrees().rem_euclid(180.0) } else { 0.0 },
            residual,
            albedo: THETA_DEG.map(|theta_deg| self.albedos(&model, base_color, theta_deg)).to_vec(),
        })
    }

    /// Albedos of measurement and fit at an angle.
    fn albedos(&self, model: &Model, colour: [f64; 3], theta_deg: f64) -> FittedAlbedo {
        let wi = spherical(theta_deg.to_radians(), 0.0);
        let weights = self.channels().rgb_weights();
        let [mut measured, mut fitted] = [[0.0; 3]; 2];
        for node in quadrature(wi, STRATA) {
            let weight = node.solid_angle * node.direction[2] / wi[2];
            let value = self.rgb(&weights, wi, node.direction);
            let response = model.response(wi, node.direction);
            for c in 0..3 {
                measured[c] += weight * value[c];
                fitted[c] += weight * response.value(colour[c], model.white_mean())[0];
            }
        }
        FittedAlbedo { theta_deg, measured, fitted }
    }
}

/// The best shape of a metal or of a dielectric, and its residual.
fn pure(observations: &Observations, metalness: f64, isotropic: bool) -> (Shape, f64) {
    let iors: &[f64] = if metalness < 1.0 { &[1.2, 1.5, 1.9] } else { &[1.5] };
    let lobes: &[[f64; 2]] =
        if isotropic { &[[0.0; 2]] } else { &[[0.0; 2], [0.5, 0.0], [0.5, 0.25 * PI], [0.5, 0.5 * PI], [0.5, 0.75 * PI]] };
    let mut starts = Vec::new();
    for roughness in [0.05, 0.1, 0.2, 0.3, 0.45, 0.6, 0.8] {
        for &ior in iors {
            for &[anisotropy, rotation] in lobes {
                let shape = Shape { roughness, anisotropy, rotation, ior, metalness };
                starts.push((shape, observations.solve(&Model::new(shape)).1));
            }
        }
    }
    starts.sort_by(|a, b| a.1.total_cmp(&b.1));
    let refined = starts.into_iter().take(2).map(|(shape, _)| refine(observations, shape, isotropic, false));
    refined
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .unwrap_or((Shape { roughness: 0.3, anisotropy: 0.0, rotation: 0.0, ior: 1.5, metalness }, f64::INFINITY))
}

/// The best shape with any share of metal, from that of one or the other.
fn mixture(observations: &Observations, shape: Shape, isotropic: bool) -> (Shape, f64) {
    let starts = [0.2, 0.5, 0.8].map(|metalness| refine(observations, Shape { metalness, ..shape }, isotropic, true));
    starts.into_iter().min_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((shape, f64::INFINITY))
}

/// The best shape near one.
fn refine(observations: &Observations, shape: Shape, isotropic: bool, mixed: bool) -> (Shape, f64) {
    let start = [shape.roughness, shape.ior, shape.anisotropy, shape.rotation, shape.metalness];
    let ior_step = if shape.metalness < 1.0 { 0.1 } else { 0.0 };
    let [narrow, turn] = if isotropic { [0.0; 2] } else { [0.15, 0.3] };
    let steps = [0.08, ior_step, narrow, turn, if mixed { 0.1 } else { 0.0 }];
    let held = |[roughness, ior, anisotropy, rotation, metalness]: [f64; 5]| Shape {
        roughness: roughness.clamp(0.01, 1.0),
        anisotropy: anisotropy.clamp(0.0, MOST_ANISOTROPY),
        rotation,
        ior: ior.clamp(IOR[0], IOR[1]),
        metalness: metalness.clamp(0.0, 1.0),
    };
    let (place, residual) = minimise(start, steps, |place| observations.solve(&Model::new(held(place))).1);
    (held(place), residual)
}
