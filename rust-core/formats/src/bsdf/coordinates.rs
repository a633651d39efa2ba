//! The angles that a table's axes stand for. Both directions are at the front here (see [`super::Hemispheres`]).

use core::f64::consts::{FRAC_PI_2, PI};

use super::direction::{Direction, azimuth, combination, cross, dot, elevation, normalized, spherical, wrapped};

/// What the axes are, the slowest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coordinates {
    /// θi, θo, Δφ = φo − φi.
    Isotropic,
    /// θi, φi, θo, φo.
    Anisotropic,
    /// θh, θd, φd of half vector and difference vector (Rusinkiewicz, A New Change of Variables for Efficient BRDF Representation, 1998).
    HalfDifference,
    /// Rotation of the sample ψ, angle of incidence θ, and the azimuth and the radial angle of the scattered direction about the specular one
    /// (for transmission: about the straight one). Azimuth 0 points from there to the normal and increases counter-clockwise for who looks
    /// at the surface; light of rotation ψ comes from azimuth ψ − 90°, so that the normal of its plane of incidence is at ψ.
    Specular,
}

/// A table has up to that many axes.
pub(crate) const MOST_AXES: usize = 4;

impl Coordinates {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Isotropic, Self::Anisotropic, Self::HalfDifference, Self::Specular];

    /// Its name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Isotropic => "isotropic",
            Self::Anisotropic => "anisotropic",
            Self::HalfDifference => "half-difference",
            Self::Specular => "specular",
        }
    }

    /// The kind with that name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }

    /// The axes' names in files.
    pub fn axis_names(self) -> &'static [&'static str] {
        match self {
            Self::Isotropic => &["theta_i", "theta_o", "delta_phi"],
            Self::Anisotropic => &["theta_i", "phi_i", "theta_o", "phi_o"],
            Self::HalfDifference => &["theta_h", "theta_d", "phi_d"],
            Self::Specular => &["rotation", "theta_i", "azimuth", "radial"],
        }
    }

    /// Which axes are angles about something, so that a whole turn changes nothing.
    pub(crate) fn is_azimuth(self, axis: usize) -> bool {
        match self {
            Self::Isotropic | Self::HalfDifference => axis == 2,
            Self::Anisotropic => axis == 1 || axis == 3,
            Self::Specular => axis == 0 || axis == 2,
        }
    }

    /// Where a pair of directions lies. Of a material with a plane of symmetry (`bilateral`) only half is asked for: Δφ, φi, φd or the
    /// azimuth in [0, π].
    pub(crate) fn of(self, wi: Direction, wo: Direction, bilateral: bool) -> [f64; MOST_AXES] {
        let folded = |phi: f64| if bilateral { phi.abs() } else { phi };
        match self {
            Self::Isotropic => [elevation(wi), elevation(wo), folded(turn(azimuth(wo) - azimuth(wi))), 0.0],
            Self::Anisotropic => {
                let mirror = |d: Direction| if bilateral && wi[1] < 0.0 { [d[0], -d[1], d[2]] } else { d };
                let (wi, wo) = (mirror(wi), mirror(wo));
                [elevation(wi), azimuth(wi), elevation(wo), azimuth(wo)]
            }
            Self::HalfDifference => {
                let [theta_h, theta_d, phi_d] = half_difference(wi, wo);
                [theta_h, theta_d, folded(phi_d), 0.0]
            }
            Self::Specular => {
                let (about, radial) = about_specular(wi, wo);
                [azimuth(wi) + FRAC_PI_2, elevation(wi), folded(about), radial]
            }
        }
    }

    /// The directions (wi, wo) at a place of the axes. They may be below the surface where the coordinates reach there.
    pub(crate) fn directions(self, x: &[f64]) -> (Direction, Direction) {
        match self {
            Self::Isotropic => (spherical(x[0], 0.0), spherical(x[1], x[2])),
            Self::Anisotropic => (spherical(x[0], x[1]), spherical(x[2], x[3])),
            Self::HalfDifference => {
                let half = spherical(x[0], 0.0);
                let tangent = [x[0].cos(), 0.0, -x[0].sin()];
                let across = combination(x[2].cos(), tangent, x[2].sin(), [0.0, 1.0, 0.0]);
                (combination(x[1].cos(), half, x[1].sin(), across), combination(x[1].cos(), half, -x[1].sin(), across))
            }
            Self::Specular => {
                let wi = spherical(x[1], x[0] - FRAC_PI_2);
                let (specular, toward, aside) = specular_frame(wi);
                let across = combination(x[2].cos(), toward, x[2].sin(), aside);
                (wi, combination(x[3].cos(), specular, x[3].sin(), across))
            }
        }
    }
}

/// An angle moved by a whole turn into [−π, π].
fn turn(phi: f64) -> f64 {
    wrapped(phi, -PI, 2.0 * PI)
}

/// θh, θd, φd: wi turned by −φh about the normal and by −θh about y.
fn half_difference(wi: Direction, wo: Direction) -> [f64; 3] {
    let half = normalized(combination(1.0, wi, 1.0, wo)).unwrap_or([0.0, 0.0, 1.0]);
    let (theta, phi) = (elevation(half), azimuth(half));
    let across = [-phi.sin(), phi.cos(), 0.0];
    let tangent = [theta.cos() * phi.cos(), theta.cos() * phi.sin(), -theta.sin()];
    let (x, y) = (dot(tangent, wi), dot(across, wi));
    [theta, x.hypot(y).atan2(dot(half, wi)), y.atan2(x)]
}

/// The specular direction of `wi`, and at it the directions to the normal and, counter-clockwise, aside.
fn specular_frame(wi: Direction) -> (Direction, Direction, Direction) {
    let phi = azimuth(wi);
    let specular = [-wi[0], -wi[1], wi[2]];
    let theta = elevation(specular);
    let toward = [theta.cos() * phi.cos(), theta.cos() * phi.sin(), theta.sin()];
    (specular, toward, cross(specular, toward))
}

/// Azimuth and radial angle of `wo` about the specular direction of `wi`.
fn about_specular(wi: Direction, wo: Direction) -> (f64, f64) {
    let (specular, toward, aside) = specular_frame(wi);
    let (x, y) = (dot(toward, wo), dot(aside, wo));
    (y.atan2(x), x.hypot(y).atan2(dot(specular, wo)))
}
