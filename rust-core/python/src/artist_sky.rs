//! Skies by their sun's height alone, as artists' tools have them.

use crate::{error::exception, pass::Pass};
use gonio::sky::{self, Atmosphere, HosekWilkie, Preetham, Scattering, SkyImage};
use pyo3::prelude::*;

/// A sky under a sun in the east, `elevation` degrees high, as a latitude-longitude picture (linear RGBA, the zenith on top, south in the middle,
/// east left of it) and the irradiance by the sun's disc of a surface that faces it.
///
/// model: "preetham" and "hosek-wilkie" in cd/m², by turbidity and ground (its albedo), without a disc; "single-scattering" and
/// "multiple-scattering" in W/m² weighed by the eye, by altitude in metres, amounts of air, dust and ozone, and the disc's diameter in degrees.
#[pyfunction]
#[pyo3(signature = (model, elevation, *, turbidity = 2.2, ground = 0.0, altitude = 0.0, air = 1.0, dust = 1.0, ozone = 1.0, diameter = 0.545, rows = 512))]
#[expect(clippy::too_many_arguments, reason = "keyword arguments")]
pub(crate) fn artist_sky(
    py: Python<'_>,
    model: &str,
    elevation: f64,
    turbidity: f64,
    ground: f64,
    altitude: f64,
    air: f64,
    dust: f64,
    ozone: f64,
    diameter: f64,
    rows: u32,
) -> PyResult<(Pass, [f64; 3])> {
    let scattered = |scattering| {
        let atmosphere = Atmosphere { scattering, altitude_m: altitude, air, dust, ozone };
        Ok((atmosphere.image(elevation, rows)?, atmosphere.sun_irradiance(elevation, diameter)?))
    };
    let drawn: gonio::Result<(SkyImage, [f64; 3])> = py.detach(|| match model {
        "single-scattering" => scattered(Scattering::Single),
        "multiple-scattering" => scattered(Scattering::Multiple),
        "hosek-wilkie" => {
            let model = HosekWilkie::tristimulus(elevation, turbidity, ground)?;
            Ok((sky::draw_by_angle(elevation, rows, |up, angle| model.radiance(up, angle))?, [0.0; 3]))
        }
        "preetham" => {
            let model = Preetham::new((90.0 - elevation).to_radians(), turbidity);
            Ok((sky::draw_by_angle(elevation, rows, |up, angle| model.radiance(up, angle))?, [0.0; 3]))
        }
        other => {
            let expected = "preetham, hosek-wilkie, single-scattering or multiple-scattering";
            Err(gonio::Error::setting("model", format!("'{other}' was found, expected {expected}")))
        }
    });
    let (image, sun) = drawn.map_err(exception)?;
    Ok((pass(&image, &["R", "G", "B", "A"]), sun))
}

/// The sky of "single-scattering", "multiple-scattering", or "nishita", Blender 4's, as the table that Blender keeps of it: X, Y and Z in W/(m² sr) weighed by the eye,
/// 512 columns around, the sun in the middle, and 256 rows, the zenith on top, of which the one at a share y of the height shows the elevation
/// ±(2 y − 1)² of a right angle. And the irradiance of a sun as bright as its disc's foot and as its top.
#[pyfunction]
#[pyo3(signature = (model, elevation, *, altitude = 0.0, air = 1.0, dust = 1.0, ozone = 1.0, diameter = 0.545))]
#[expect(clippy::too_many_arguments, reason = "keyword arguments")]
pub(crate) fn sky_table(
    py: Python<'_>,
    model: &str,
    elevation: f64,
    altitude: f64,
    air: f64,
    dust: f64,
    ozone: f64,
    diameter: f64,
) -> PyResult<(Pass, [[f64; 3]; 2])> {
    let scattering = match model {
        "single-scattering" => Scattering::Single,
        "nishita" => Scattering::SingleInPieces,
        "multiple-scattering" => Scattering::Multiple,
        other => return Err(unknown(other, "nishita, single-scattering or multiple-scattering")),
    };
    let atmosphere = Atmosphere { scattering, altitude_m: altitude, air, dust, ozone };
    let made = py.detach(|| Ok((atmosphere.table(elevation)?, atmosphere.sun_limbs(elevation, diameter)?)));
    let (image, limbs) = made.map_err(exception)?;
    Ok((pass(&image, &["X", "Y", "Z", "A"]), limbs))
}

/// Parameters and scale of each of the three values of "preetham" (Y, x and y; Y in cd/m²) or "hosek-wilkie" (X, Y and Z in W/(m² sr) weighed by
/// the eye).
#[pyfunction]
#[pyo3(signature = (model, elevation, *, turbidity = 2.2, ground = 0.0))]
pub(crate) fn sky_formula(model: &str, elevation: f64, turbidity: f64, ground: f64) -> PyResult<Vec<(Vec<f64>, f64)>> {
    match model {
        "hosek-wilkie" => {
            let model = HosekWilkie::tristimulus(elevation, turbidity, ground).map_err(exception)?;
            Ok(model.channels().iter().map(|channel| (channel.parameters.to_vec(), channel.radiance)).collect())
        }
        "preetham" => {
            let model = Preetham::new((90.0 - elevation).to_radians(), turbidity);
            Ok(model.shapes().iter().zip(model.scales()).map(|(shape, scale)| (shape.to_vec(), scale)).collect())
        }
        other => Err(unknown(other, "preetham or hosek-wilkie")),
    }
}

fn unknown(model: &str, expected: &str) -> PyErr {
    exception(gonio::Error::setting("model", format!("'{model}' was found, expected {expected}")))
}

fn pass(image: &SkyImage, channels: &[&'static str]) -> Pass {
    Pass::new([image.width as usize, image.height as usize], 4, channels, image.rgba.to_vec())
}
