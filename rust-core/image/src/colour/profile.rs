//! ICC profiles of displays and cameras: a curve a channel and a matrix (ICC.1:2022, 8.3.3 and 8.4.3).

use super::gamut::xyz_d50_to_rec709;
use super::{Curve, Encoding, Matrix3, Stated, product};
use moxcms::{ColorProfile, DataColorSpace, ToneReprCurve};

/// What the profile in an image file of `channels` values a texel says.
pub fn from_profile(profile: &[u8], channels: u32) -> Stated {
    encoding(profile, channels >= 3).map_or_else(|what| Stated::Unusable(format!("has an ICC profile that {what}")), Stated::Encoding)
}

fn encoding(bytes: &[u8], is_colour: bool) -> Result<Encoding, String> {
    let profile = ColorProfile::new_from_slice(bytes).map_err(|error| format!("is damaged ({error:?})"))?;
    match profile.color_space {
        DataColorSpace::Gray => {
            let grey = curve(profile.gray_trc.as_ref())?;
            Ok(Encoding::new([grey.clone(), grey.clone(), grey], None))
        }
        DataColorSpace::Rgb if profile.pcs == DataColorSpace::Xyz => {
            let curves = [curve(profile.red_trc.as_ref())?, curve(profile.green_trc.as_ref())?, curve(profile.blue_trc.as_ref())?];
            let matrix = if is_colour { Some(matrix(&profile)?) } else { None };
            Ok(Encoding::new(curves, matrix))
        }
        DataColorSpace::Rgb => Err("has tables in the place of primaries, which is not supported".to_owned()),
        other => Err(format!("is for {other:?}, not for RGB or grey")),
    }
}

fn curve(curve: Option<&ToneReprCurve>) -> Result<Curve, String> {
    let unusable = || "has no usable curves".to_owned();
    match curve.ok_or_else(unusable)? {
        ToneReprCurve::Lut(values) => Ok(match values.as_slice() {
            [] => Curve::Power(1.0),
            // A single value is an exponent of 8 bits before the point and 8 behind it.
            [exponent] => Curve::Power(f64::from(*exponent) / 256.0),
            _ => Curve::Table(values.clone()),
        }),
        ToneReprCurve::Parametric(parameters) => {
            let p: Vec<f64> = parameters.iter().map(|p| f64::from(*p)).collect();
            if p.iter().any(|p| !p.is_finite()) {
                return Err(unusable());
            }
            match *p.as_slice() {
                [g] => Ok(Curve::Power(g)),
                [g, a, b] if a != 0.0 => Ok(Curve::Parametric([g, a, b, 0.0, -b / a, 0.0, 0.0])),
                [g, a, b, c] if a != 0.0 => Ok(Curve::Parametric([g, a, b, 0.0, -b / a, c, c])),
                [g, a, b, c, d] => Ok(Curve::Parametric([g, a, b, c, d, 0.0, 0.0])),
                [g, a, b, c, d, e, f] => Ok(Curve::Parametric([g, a, b, c, d, e, f])),
                _ => Err(unusable()),
            }
        }
    }
}

fn matrix(profile: &ColorProfile) -> Result<Matrix3, String> {
    let [r, g, b] = [&profile.red_colorant, &profile.green_colorant, &profile.blue_colorant];
    let to_xyz = [[r.x, g.x, b.x], [r.y, g.y, b.y], [r.z, g.z, b.z]];
    let matrix = xyz_d50_to_rec709().map(|from_xyz| product(&from_xyz, &to_xyz));
    matrix.filter(|m| super::inverse(m).is_some()).ok_or_else(|| "has no usable primaries".to_owned())
}
