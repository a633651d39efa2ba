//! Weather files in irradiances, whatever quantities they hold.

use super::{
    Air, Clearness, Irradiance, Moment, Place, diffuse_efficacy, direct_efficacy, extraterrestrial_irradiance, relative_air_mass,
    sun_position,
};
use gonio_formats::weather::{Hour, Quantities, Weather};

/// A leap year: records may be of its 29th of February, and say no year.
const YEAR: i32 = 2024;
/// Dew point where a file has none, °C: two centimetres of water in the air, Perez's usual value.
pub(super) const USUAL_DEW_POINT_C: f64 = 10.97;
/// Lumens in a watt, to begin with.
const USUAL_EFFICACY: f64 = 110.0;
/// Turns of the search: each halves what a turn before it changed too much.
const TURNS: usize = 60;
/// Efficacies below this are none, lm/W: the sun's formula has zeros near the horizon.
const LEAST_EFFICACY: f64 = 1.0;

/// Turns all records into direct normal and diffuse horizontal irradiances, W/m².
///
/// Direct light on a level surface is divided by the sine of the sun's height in the middle of the interval at the file's place; while the sun is
/// down there is none. Illuminances become the irradiances that give them by Perez's efficacies.
#[must_use]
pub fn in_irradiances(mut weather: Weather) -> Weather {
    let quantities = std::mem::take(&mut weather.quantities);
    if quantities == Quantities::NormalIrradiance {
        return weather;
    }
    let place = Place { latitude_deg: weather.latitude_deg, longitude_deg: weather.longitude_deg, elevation_m: weather.elevation_m };
    let utc_offset_h = weather.utc_offset_h;
    for record in weather.hours.iter_mut().filter(|record| record.direct_normal > 0.0 || record.diffuse_horizontal > 0.0) {
        let moment = Moment { year: YEAR, month: record.month, day: record.day, hour: record.hour, utc_offset_h };
        // Days that there are not, such as the 31st of June, have no sun.
        let elevation_deg = sun_position(&place, &moment, &Air::standard(&place)).map_or(-90.0, |sun| sun.elevation_deg);
        let found = match quantities {
            Quantities::NormalIrradiance => continue,
            Quantities::HorizontalIrradiance => from_level(record, elevation_deg, &moment),
            Quantities::Illuminance => from_illuminances(record, elevation_deg, &moment),
        };
        (record.direct_normal, record.diffuse_horizontal) = (found.direct_normal, found.diffuse_horizontal);
    }
    weather
}

fn from_level(record: &Hour, elevation_deg: f64, moment: &Moment) -> Irradiance {
    let sine = elevation_deg.to_radians().sin();
    // An hour's mean over the sine of its middle may be more than there is when the sun rises or sets.
    let most = extraterrestrial_irradiance(moment);
    let direct_normal = if sine > 0.0 { (record.direct_normal / sine).min(most) } else { 0.0 };
    Irradiance { direct_normal, diffuse_horizontal: record.diffuse_horizontal }
}

/// The efficacies depend on the irradiances that are looked for, with steps between the classes of clearness: the best of a damped search.
fn from_illuminances(record: &Hour, elevation_deg: f64, moment: &Moment) -> Irradiance {
    let wanted = [record.direct_normal, record.diffuse_horizontal];
    let height = elevation_deg.max(0.0);
    let (zenith_angle, air_mass) = ((90.0 - height).to_radians(), relative_air_mass(height));
    let (normal, dew_point) = (extraterrestrial_irradiance(moment), record.dew_point_c.unwrap_or(USUAL_DEW_POINT_C));
    let mut found = wanted.map(|lux| lux / USUAL_EFFICACY);
    let mut best = (f64::INFINITY, found);
    for _ in 0..TURNS {
        let clearness =
            Clearness::new(&Irradiance { direct_normal: found[0], diffuse_horizontal: found[1] }, zenith_angle, air_mass, normal);
        let efficacies = [direct_efficacy(&clearness, zenith_angle, dew_point), diffuse_efficacy(&clearness, zenith_angle, dew_point)]
            .map(|efficacy| efficacy.max(LEAST_EFFICACY));
        let off = (found[0] * efficacies[0] - wanted[0]).abs() + (found[1] * efficacies[1] - wanted[1]).abs();
        if off < best.0 {
            best = (off, found);
        }
        found = [0, 1].map(|i| 0.5 * (found[i] + wanted[i] / efficacies[i]));
    }
    let [direct_normal, diffuse_horizontal] = best.1;
    Irradiance { direct_normal, diffuse_horizontal }
}
