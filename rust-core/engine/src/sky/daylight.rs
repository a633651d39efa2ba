//! From a place, a moment and the weather to luminances.

use super::{
    Air, CieSky, Clearness, HosekWilkie, Irradiance, Moment, PerezSky, Place, SkyModel, SunPosition, clear_sky_irradiance,
    colour::{self, SunlitAir},
    diffuse_efficacy, direct_efficacy,
    distribution::Distribution,
    extraterrestrial_irradiance, relative_air_mass, sun_position,
    weather::USUAL_DEW_POINT_C,
    within,
};
use crate::{Error, Result};
use gonio_formats::weather::Weather;
use std::f64::consts::PI;

/// Angle under which the sun's disc is seen, degrees.
pub const SUN_ANGLE_DEG: f64 = 0.533;
/// Kilometres within which a weather station stands for a place.
const FAR_KM: f64 = 100.0;
/// Degrees that the sun moves in an hour, at most.
const LOWEST_SUN_DEG: f64 = 15.0;
/// Usual turbidity of the country.
const USUAL_TURBIDITY: f64 = 3.0;

/// A place, a moment and the weather.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Daylight {
    /// Where.
    pub place: Place,
    /// When.
    pub moment: Moment,
    /// The air that bends the sun's rays; `None` is the standard atmosphere.
    pub air: Option<Air>,
    /// How luminance is spread.
    pub model: SkyModel,
    /// Haze, 1 to 10: Linke's turbidity; Hošek and Wilkie's model takes it for its own.
    pub turbidity: f64,
    /// What was measured; `None` is a cloudless sky of the turbidity, or under the skies that hide the sun 300 lx + 21 klx · sin(sun's height).
    pub irradiance: Option<Irradiance>,
    /// Degrees Celsius; tells how much water is in the air, which the luminous efficacies depend on.
    pub dew_point_c: f64,
    /// Albedo of the ground, 0 to 1. The lower half of the picture shows it, evenly lit by sun and sky; at 0 it is black.
    pub ground: f64,
    /// Whether sun and sky have colours; else both are white, with the same luminances.
    pub is_coloured: bool,
}

impl Daylight {
    /// Perez's sky of a cloudless day.
    pub fn new(place: Place, moment: Moment) -> Self {
        Self {
            place,
            moment,
            air: None,
            model: SkyModel::default(),
            turbidity: USUAL_TURBIDITY,
            irradiance: None,
            dew_point_c: USUAL_DEW_POINT_C,
            ground: 0.0,
            is_coloured: true,
        }
    }

    /// Takes irradiances and dew point of the hour from a weather file in irradiances ([`super::in_irradiances`]); its year does not matter.
    ///
    /// # Errors
    /// The file has no record within an hour of the moment.
    pub fn take_weather(&mut self, weather: &Weather) -> Result<()> {
        let Moment { month, day, hour, .. } = self.moment.checked()?.with_offset(weather.utc_offset_h);
        let nothing = || Error::setting("weather", format!("there is no record within an hour of {} on the {day}.{month}.", clock(hour)));
        let found = weather.at(month, day, hour).ok_or_else(nothing)?;
        self.irradiance = Some(Irradiance { direct_normal: found.direct_normal, diffuse_horizontal: found.diffuse_horizontal });
        self.dew_point_c = found.dew_point_c.unwrap_or(USUAL_DEW_POINT_C);
        Ok(())
    }

    /// What makes one doubt that a weather file, whose hour was taken, is of this place, one sentence each.
    ///
    /// # Errors
    /// As [`sun_position`].
    pub fn doubts_about(&self, weather: &Weather) -> Result<Vec<String>> {
        let at = |latitude_deg: f64, longitude_deg: f64| Place { latitude_deg, longitude_deg, ..self.place };
        let station = at(weather.latitude_deg, weather.longitude_deg);
        let distance = self.place.distance_km(&station);
        let mut doubts = Vec::new();
        if distance > FAR_KM {
            let name = if weather.place.is_empty() { "a station" } else { &weather.place };
            let is_mirrored = |[north, east]: [f64; 2]| at(north, east).distance_km(&station) <= FAR_KM;
            let Place { latitude_deg, longitude_deg, .. } = self.place;
            let mirrored = [[latitude_deg, -longitude_deg], [-latitude_deg, longitude_deg], [-latitude_deg, -longitude_deg]];
            let hint = if mirrored.into_iter().any(is_mirrored) { "; north and east are positive" } else { "" };
            doubts.push(format!(
                "the weather is that of {name} at {:.2}, {:.2}, {distance:.0} km from {latitude_deg:.2}, {longitude_deg:.2}{hint}",
                station.latitude_deg, station.longitude_deg
            ));
        }
        let (sun, direct) = (self.sun()?, self.irradiance.unwrap_or_default().direct_normal);
        // An hour's mean has some sun where the sun stands below the horizon for a part of it.
        if sun.elevation_deg < -LOWEST_SUN_DEG && direct > 0.0 {
            doubts.push(format!(
                "the weather has {direct:.0} W/m² of sun, which is {:.0}° below the horizon here; is the offset from UTC right?",
                -sun.elevation_deg
            ));
        }
        Ok(doubts)
    }

    /// Where the sun stands.
    ///
    /// # Errors
    /// As [`sun_position`].
    pub fn sun(&self) -> Result<SunPosition> {
        sun_position(&self.place, &self.moment, &self.air.unwrap_or_else(|| Air::standard(&self.place)))
    }

    /// Sun and sky with their luminances.
    ///
    /// # Errors
    /// As [`Self::sun`], and what of the weather is out of its range.
    pub fn sky(&self) -> Result<Sky> {
        self.sky_under(self.sun()?)
    }

    /// The same weather under a sun that stands elsewhere; the moment tells its distance alone.
    ///
    /// # Errors
    /// What of the weather is out of its range.
    pub fn sky_under(&self, sun: SunPosition) -> Result<Sky> {
        self.check()?;
        if sun.elevation_deg <= 0.0 {
            return Ok(Sky::dark(sun, self.ground));
        }
        let normal = extraterrestrial_irradiance(&self.moment);
        let pressure_ratio = self.place.standard_pressure_hpa() / 1013.25;
        let irradiance = self.irradiance.unwrap_or_else(|| clear_sky_irradiance(sun.elevation_deg, self.turbidity, normal, pressure_ratio));
        let (zenith_angle, air_mass) = (sun.zenith_angle(), relative_air_mass(sun.elevation_deg));
        let clearness = Clearness::new(&irradiance, zenith_angle, air_mass, normal);
        let blue = HosekWilkie::new(sun.elevation_deg.min(90.0), self.turbidity, self.ground)?;
        let air = self.is_coloured.then_some(SunlitAir { mass: air_mass * pressure_ratio, turbidity: self.turbidity });
        let mut distribution = match self.model {
            SkyModel::Perez => Distribution::Perez(PerezSky::new(&clearness, zenith_angle)),
            SkyModel::HosekWilkie => Distribution::HosekWilkie(blue),
            SkyModel::Cie(kind) => Distribution::Cie(CieSky::new(kind, zenith_angle).ok_or_else(|| Error::setting("sky", "no such type"))?),
        };
        let mut unscaled = distribution.horizontal(zenith_angle);
        if unscaled <= 0.0 {
            // Perez' formula is negative all over for a few skies darker than those it was fitted to.
            distribution = Distribution::Cie(CieSky::of_clearness(clearness.clearness, zenith_angle));
            unscaled = distribution.horizontal(zenith_angle);
        }
        let [direct_lux, diffuse_lux] = self.illuminances(&irradiance, &clearness, zenith_angle, unscaled);
        Ok(Sky {
            sun,
            direct_lux,
            diffuse_lux,
            irradiance,
            clearness,
            ground: self.ground,
            distribution,
            scale: diffuse_lux / unscaled,
            blue: self.is_coloured.then_some((blue, self.clear_share(&clearness))),
            sun_colour: air.map_or([1.0; 3], colour::of_sun),
            air,
        })
    }

    /// Of a surface that faces the sun by its disc, and of a level one by the sky, lx; `unscaled` is the latter in the distribution's unit.
    fn illuminances(&self, irradiance: &Irradiance, clearness: &Clearness, zenith_angle: f64, unscaled: f64) -> [f64; 2] {
        let direct = irradiance.direct_normal * direct_efficacy(clearness, zenith_angle, self.dew_point_c);
        let diffuse = irradiance.diffuse_horizontal * diffuse_efficacy(clearness, zenith_angle, self.dew_point_c);
        match self.model {
            _ if self.irradiance.is_some() => [direct, diffuse],
            SkyModel::HosekWilkie => [direct, unscaled],
            model if model.hides_sun() => [0.0, 300.0 + 21_000.0 * zenith_angle.cos()],
            _ => [direct, diffuse],
        }
    }

    /// How much of the sky's light has the blue of clear air.
    fn clear_share(&self, clearness: &Clearness) -> f64 {
        match self.model {
            SkyModel::HosekWilkie => 1.0,
            SkyModel::Perez => ((clearness.clearness - 1.0) / 3.5).min(1.0),
            SkyModel::Cie(11..=15) => 1.0,
            SkyModel::Cie(7..=10) => 0.5,
            SkyModel::Cie(_) => 0.0,
        }
    }

    fn check(&self) -> Result<()> {
        self.place.checked()?;
        self.moment.checked()?;
        within("turbidity", "", self.turbidity, 1.0..=10.0)?;
        within("ground", "", self.ground, 0.0..=1.0)?;
        within("dew_point", " °C", self.dew_point_c, -90.0..=60.0)?;
        if let Some(Irradiance { direct_normal, diffuse_horizontal }) = self.irradiance {
            within("direct_normal", " W/m²", direct_normal, 0.0..=1500.0)?;
            within("diffuse_horizontal", " W/m²", diffuse_horizontal, 0.0..=1500.0)?;
        }
        Ok(())
    }
}

/// Hours since midnight as a clock shows them.
fn clock(hour: f64) -> String {
    let minutes = (hour * 60.0).round() as i64;
    format!("{}:{:02}", minutes / 60, minutes % 60)
}

/// Sun and sky with their luminances. Below the horizon there is no sun and no light: twilight is not modelled.
#[derive(Clone, Copy, Debug)]
pub struct Sky {
    /// Where the sun stands.
    pub sun: SunPosition,
    /// Illuminance by the sun's disc of a surface that faces it, lx.
    pub direct_lux: f64,
    /// Illuminance by the sky alone of a level surface, lx.
    pub diffuse_lux: f64,
    /// What was measured, or the irradiances of a cloudless day.
    pub irradiance: Irradiance,
    /// Perez's figures of these irradiances.
    pub clearness: Clearness,
    pub(super) ground: f64,
    pub(super) distribution: Distribution,
    /// cd/m² in the distribution's unit.
    scale: f64,
    /// The model that gives the blue, and the share of it.
    blue: Option<(HosekWilkie, f64)>,
    /// Linear Rec.709 of luminance 1.
    pub(super) sun_colour: [f64; 3],
    /// What the sun shines through, where sun and sky have colours.
    pub(super) air: Option<SunlitAir>,
}

impl Sky {
    fn dark(sun: SunPosition, ground: f64) -> Self {
        Self {
            sun,
            direct_lux: 0.0,
            diffuse_lux: 0.0,
            irradiance: Irradiance::default(),
            clearness: Clearness { clearness: 1.0, brightness: Clearness::LEAST_BRIGHTNESS },
            ground,
            distribution: Distribution::Dark,
            scale: 0.0,
            blue: None,
            sun_colour: [1.0; 3],
            air: None,
        }
    }

    /// Illuminance of a level surface by sun and sky, lx.
    pub fn global_lux(&self) -> f64 {
        self.diffuse_lux + self.direct_lux * self.sun.direction()[2].max(0.0)
    }

    /// Luminance of the zenith, cd/m².
    pub fn zenith_luminance(&self) -> f64 {
        self.luminance([0.0, 0.0, 1.0])
    }

    /// Mean luminance of the sun's disc, cd/m².
    pub fn sun_luminance(&self) -> f64 {
        let half = (0.5 * SUN_ANGLE_DEG).to_radians();
        self.direct_lux / (PI * half.sin().powi(2))
    }

    /// Luminance without the sun's disc towards a unit direction (east, north, up), cd/m²; below the horizon that of the ground.
    pub fn luminance(&self, direction: [f64; 3]) -> f64 {
        let up = direction[2];
        if up < 0.0 {
            self.ground_luminance()
        } else {
            self.scale * self.distribution.luminance(up.min(1.0), self.angle_from_sun(direction))
        }
    }

    /// Radiance without the sun's disc towards a unit direction (east, north, up): linear Rec.709, luminance in cd/m².
    pub fn radiance(&self, direction: [f64; 3]) -> [f64; 3] {
        let luminance = self.luminance(direction);
        match &self.blue {
            Some((blue, share)) if direction[2] >= 0.0 && *share > 0.0 => {
                colour::of_sky(blue, *share, direction[2].min(1.0), self.angle_from_sun(direction)).map(|value| value * luminance)
            }
            _ => [luminance; 3],
        }
    }

    /// Irradiance by the disc of a surface that faces it: linear Rec.709, luminance in lx.
    pub fn sun_irradiance(&self) -> [f64; 3] {
        self.sun_colour.map(|value| value * self.direct_lux)
    }

    fn ground_luminance(&self) -> f64 {
        self.ground * self.global_lux() / PI
    }

    fn angle_from_sun(&self, direction: [f64; 3]) -> f64 {
        let sun = self.sun.direction();
        let cosine: f64 = direction.iter().zip(sun).map(|(a, b)| a * b).sum();
        cosine.clamp(-1.0, 1.0).acos()
    }
}
