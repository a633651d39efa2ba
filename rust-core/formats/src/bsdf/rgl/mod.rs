//! RGL's adaptive measurements with the warps that they bring (Dupuy and Jakob 2018): evaluation and exact importance sampling.
//!
//! The data's first direction (its `i`, where the parameters `phi_i` and `theta_i` are) is our `wo`, the sampled one is our `wi`: the
//! cosine in the data is the one of `wi`.

mod build;
mod read;
mod write;

use core::f64::consts::TAU;

pub use build::RglGrid;

use super::colour::Channels;
use super::direction::{
    Direction, angles_of, azimuth, combination, dot, elevation, normalized, reflected, solid_angle_per_square, spherical, square_of,
};
use super::warp::{Interpolant, Warp};

/// A measurement of the RGL kind. Arrays are flat and as in the file, cumulative sums beside the two densities.
#[derive(Clone, Debug, PartialEq)]
pub struct Rgl {
    /// What the file says of itself.
    pub description: String,
    /// Whether values are to be multiplied by `ndf / (4 sigma)`.
    pub jacobian: bool,
    /// RGB, or bands with wavelengths in nm.
    pub channels: Channels,
    /// Distribution of normals over the square of normals (columns: `√(2θ/π)`, rows: `(φ + π)/2π`).
    pub ndf: Interpolant,
    /// Projected area of the surface's facets over the square of directions.
    pub sigma: Interpolant,
    /// Distribution of visible normals, with parameters φo, θo in radians.
    pub vndf: Warp,
    /// Luminance over the square that the visible normals are warped from.
    pub luminance: Warp,
    /// BSDF × cosine over that square (times `4 sigma / ndf` if `jacobian`), with parameters φo, θo and the channel.
    pub spectra: Interpolant,
}

/// A pair of directions in the file's coordinates.
struct Query {
    wo: Direction,
    normal: Direction,
    /// φo and θo.
    parameters: [f64; 2],
    /// The normal in the square.
    square: [f64; 2],
}

/// Below this the measure of normals counts as this: the pole has none.
const LEAST_JACOBIAN: f64 = 1e-6;

impl Rgl {
    /// φo's knots, radians; up to two for an isotropic material.
    pub fn phi_knots(&self) -> &[f32] {
        &self.vndf.density.parameters[0]
    }

    /// θo's knots, radians.
    pub fn theta_knots(&self) -> &[f32] {
        &self.vndf.density.parameters[1]
    }

    /// Whether only the difference of azimuths counts.
    pub fn is_isotropic(&self) -> bool {
        self.phi_knots().len() <= 2
    }

    /// Into how many equal parts a turn falls of which the file holds one: 1 for all of it.
    pub fn reduction(&self) -> u32 {
        let phi = self.phi_knots();
        let span = f64::from(phi[phi.len() - 1]) - f64::from(phi[0]);
        if self.is_isotropic() || span <= 0.0 { 1 } else { (TAU / span).round() as u32 }
    }

    /// BSDF × |cos| of `wi` for each channel; zero below the surface.
    pub(crate) fn eval(&self, wi: Direction, wo: Direction, out: &mut [f64]) {
        out.fill(0.0);
        if wi[2] <= 0.0 || wo[2] <= 0.0 {
            return;
        }
        let Some(query) = self.query(wi, wo) else { return };
        let (place, _) = self.vndf.invert(query.square, &self.vndf.density.blend(&query.parameters));
        let scale = if self.jacobian {
            let still = self.ndf.blend(&[]);
            let [theta, phi] = [elevation(query.wo), azimuth(query.wo)];
            self.ndf.eval(query.square, &still) / (4.0 * self.sigma.eval(square_of(theta, phi), &still))
        } else {
            1.0
        };
        for (channel, value) in out.iter_mut().enumerate() {
            let blend = self.spectra.blend(&[query.parameters[0], query.parameters[1], channel as f64]);
            *value = (self.spectra.eval(place, &blend) * scale).max(0.0);
        }
    }

    /// The probability density of [`Rgl::sample`], per solid angle; zero below the surface.
    pub(crate) fn pdf(&self, wo: Direction, wi: Direction) -> f64 {
        if wi[2] <= 0.0 || wo[2] <= 0.0 {
            return 0.0;
        }
        let Some(query) = self.query(wi, wo) else { return 0.0 };
        let (place, visible) = self.vndf.invert(query.square, &self.vndf.density.blend(&query.parameters));
        let luminance = self.luminance.density.eval(place, &self.luminance.density.blend(&query.parameters));
        visible * luminance / jacobian(&query.wo, &query.normal, query.square[0])
    }

    /// A direction in proportion to luminance × cosine, from two uniform numbers; none where it falls below the surface.
    pub(crate) fn sample(&self, wo: Direction, u: [f64; 2]) -> Option<(Direction, f64)> {
        if wo[2] <= 0.0 {
            return None;
        }
        let [sx, sy] = self.signs(wo);
        let turned = turn(wo, [sx, sy]);
        let parameters = [azimuth(turned), elevation(turned)];
        let (place, luminance) = self.luminance.sample(u, &self.luminance.density.blend(&parameters));
        let (square, visible) = self.vndf.sample(place, &self.vndf.density.blend(&parameters));
        let (theta, phi) = angles_of(square);
        let normal = spherical(theta, phi + if self.is_isotropic() { parameters[0] } else { 0.0 });
        let wi = turn(reflected(turned, normal), [sx, sy]);
        let pdf = visible * luminance / jacobian(&turned, &normal, square[0]);
        (wi[2] > 0.0 && pdf > 0.0 && pdf.is_finite()).then_some((wi, pdf))
    }

    /// A pair of directions where the file has it.
    fn query(&self, wi: Direction, wo: Direction) -> Option<Query> {
        let signs = self.signs(wo);
        let (wi, wo) = (turn(wi, signs), turn(wo, signs));
        let normal = normalized(combination(1.0, wi, 1.0, wo))?;
        let (theta, phi) = (elevation(wo), azimuth(wo));
        let about = azimuth(normal) - if self.is_isotropic() { phi } else { 0.0 };
        Some(Query { wo, normal, parameters: [phi, theta], square: square_of(elevation(normal), about) })
    }

    /// Factors of x and y that bring `wo` into the part of the turn that the file holds: the quarter or the half with negative y.
    fn signs(&self, wo: Direction) -> [f64; 2] {
        let reduction = self.reduction();
        if reduction < 2 {
            return [1.0, 1.0];
        }
        let negative = |x: f64| if x < 0.0 || (x == 0.0 && x.is_sign_negative()) { 1.0 } else { -1.0 };
        [negative(if reduction == 4 { wo[0] } else { wo[1] }), negative(wo[1])]
    }
}

/// `d` with x and y multiplied.
fn turn(d: Direction, signs: [f64; 2]) -> Direction {
    [d[0] * signs[0], d[1] * signs[1], d[2]]
}

/// Solid angle of `wi` for an area of the normals' square.
fn jacobian(wo: &Direction, normal: &Direction, u: f64) -> f64 {
    solid_angle_per_square(u).max(LEAST_JACOBIAN) * 4.0 * dot(*wo, *normal)
}
