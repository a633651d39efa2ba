//! Colours of sun and sky, of luminance 1.
//!
//! The clear part of a sky has the chromaticity of Hošek and Wilkie's model in the same direction; what clouds scatter is taken as D65, as
//! measured overcast skies are within 500 K. The sun's disc is a black body of 5778 K behind air (Rayleigh) and haze (Ångström's law, with Preetham's
//! relation of turbidity to its β; Preetham, Shirley and Smits, SIGGRAPH 1999).

use super::HosekWilkie;
use crate::colour::{Gamut, apply, luminance};
use gonio_formats::bsdf::cie_1931;

/// Temperature of the sun's surface, K.
const SUN_KELVIN: f64 = 5778.0;
/// Of the sun's disc, sr.
const SUN_SOLID_ANGLE: f64 = 6.790_167e-5;

/// The triple without negative parts, scaled to a luminance of 1; white where there is nothing.
fn normalized(rgb: [f64; 3]) -> [f64; 3] {
    let inside = rgb.map(|value| value.max(0.0));
    let total = luminance(inside);
    if total > 0.0 { inside.map(|value| value / total) } else { [1.0; 3] }
}

/// The colour of a sky of which `clear` (0 to 1) is blue.
pub(super) fn of_sky(model: &HosekWilkie, clear: f64, up: f64, angle: f64) -> [f64; 3] {
    let blue = normalized(model.radiance(up, angle));
    blue.map(|value| 1.0 + clear * (value - 1.0))
}

/// The air that the sun shines through.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SunlitAir {
    /// 1 at the zenith at sea level.
    pub(super) mass: f64,
    /// Preetham's, 1 is clean air.
    pub(super) turbidity: f64,
}

impl SunlitAir {
    /// What air and haze let through at a wavelength, without ozone and water.
    pub(super) fn transmittance(self, nanometres: f64) -> f64 {
        let beta = (0.046_08 * self.turbidity - 0.045_86).max(0.0);
        let micrometres = nanometres * 1e-3;
        let thickness = 0.008_735 * micrometres.powf(-4.08) + beta * micrometres.powf(-1.3);
        (-thickness * self.mass).exp()
    }

    /// The colour of the sun behind it, of luminance 1; low suns lie beyond Rec.709.
    pub(super) fn sun_colour(self) -> [f64; 3] {
        let rgb = self.unscaled_sun_colour();
        rgb.map(|value| value / luminance(rgb))
    }

    fn unscaled_sun_colour(self) -> [f64; 3] {
        let mut xyz = [0.0; 3];
        for nanometres in (380..=780).step_by(5).map(f64::from) {
            let strength = planck(nanometres) * self.transmittance(nanometres);
            let seen = cie_1931(nanometres);
            xyz = std::array::from_fn(|i| xyz[i] + strength * seen[i]);
        }
        to_rec709(xyz)
    }
}

/// The colour of the sun behind air.
pub(super) fn of_sun(air: SunlitAir) -> [f64; 3] {
    normalized(air.unscaled_sun_colour())
}

/// Irradiance outside the atmosphere by a black body as hot as the sun and seen as large, W/(m² nm).
pub(super) fn planck(nanometres: f64) -> f64 {
    let metres = nanometres * 1e-9;
    SUN_SOLID_ANGLE * 1.191_043e-16 / (metres.powi(5) * ((1.438_777e-2 / (metres * SUN_KELVIN)).exp() - 1.0)) * 1e-9
}

/// Tristimulus values (D65 is white) to linear Rec.709.
pub(super) fn to_rec709(xyz: [f64; 3]) -> [f64; 3] {
    let matrix = Gamut::Rec709.primaries().to_xyz().and_then(|matrix| crate::colour::inverse(&matrix));
    matrix.map_or([0.0; 3], |matrix| apply(&matrix, xyz))
}
