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
            let model = HosekWilkie::new(elevation, turbidity, ground)?;
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
    Ok((Pass::new([image.width as usize, image.height as usize], 4, &["R", "G", "B", "A"], image.rgba.to_vec()), sun))
}
