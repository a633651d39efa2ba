//! Closed forms, Radiance's own numbers, metrics by hand, bad input.

mod bad_input;
mod division;
mod gendaymtx;
mod metrics;
mod product;
mod skies;

use crate::{Coefficients, Group, Settings, Year, sky::SkyOptions, sun::MONTHS};
use gonio_formats::weather::{Hour, Quantities, Weather};

/// Records of a common year at 49.52° north, 8.55° east, UTC+1: light from 8 to 17 by a rule, the same that Radiance was given.
fn made_up_weather() -> Weather {
    let days = (1..).zip(MONTHS).flat_map(|(month, days)| (1..=days).map(move |day| (month, day)));
    let hours = days.flat_map(|(month, day)| (0..24_u32).map(move |hour| (month, day, hour)));
    let record = |(index, (month, day, hour)): (u32, (u32, u32, u32))| {
        let is_light = (8..17).contains(&hour);
        let number = |value: u32| if is_light { f64::from(value) } else { 0.0 };
        Hour {
            year: None,
            month,
            day,
            hour: f64::from(hour) + 0.5,
            direct_normal: number(index * 37 % 13 * 70),
            diffuse_horizontal: number(30 + index * 53 % 11 * 35),
            dew_point_c: Some(f64::from(index * 7 % 19) - 6.0),
        }
    };
    Weather {
        place: "Made up".into(),
        latitude_deg: 49.52,
        longitude_deg: 8.55,
        utc_offset_h: 1.0,
        elevation_m: 96.0,
        quantities: Quantities::NormalIrradiance,
        hours: (0..).zip(hours).map(record).collect(),
    }
}

fn made_up() -> Year {
    Year::new(&made_up_weather(), &[]).expect("a year")
}

/// One group without blinds.
fn group(rows: &[Vec<f32>]) -> Group {
    let open = Coefficients::new(rows.len(), rows[0].len(), vec![rows.concat()]).expect("coefficients");
    Group { open, direct: None, sun: None, scattered: None, blinds: None, closed: None }
}

fn settings() -> Settings {
    Settings { sky: SkyOptions::default(), memory: 1 << 24, threads: 2, electric: None }
}
