//! Suns of a year against formulas that share nothing with theirs: Meeus' of low accuracy (Astronomical Algorithms, chapter 25), as NOAA's calculator has them.

use super::SunPositions;
use gonio_annual::{Sun, Year};
use std::{fmt::Write, path::Path};

const MONTHS: [u32; 12] = [31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31];

/// An EPW file of a year as its records tell it: places in degrees, west negative, and one sun and sky in all hours.
fn epw([latitude, longitude, utc_offset]: [f64; 3], year: i32) -> String {
    let mut text = format!("LOCATION,A,B,C,D,1,{latitude},{longitude},{utc_offset},0\nDATA PERIODS,1,1,Data,Sunday,1/1,12/31\n");
    for (month, days) in (1..).zip(MONTHS) {
        for (day, hour) in (1..=days).flat_map(|day| (1..=24).map(move |hour| (day, hour))) {
            let _ = writeln!(text, "{year},{month},{day},{hour},0,x,1,1,1,1,1,1,1,1,500,100,0");
        }
    }
    text
}

fn suns(place: [f64; 3], year: i32, positions: SunPositions) -> Year {
    positions.read(Path::new("weather.epw"), epw(place, year).as_bytes()).expect("a year")
}

/// Degrees above the horizon, lifted by refraction, and clockwise from north, at so many days after noon of the first of January 2000 in universal time.
fn noaa(days: f64, [latitude, longitude, _]: [f64; 3]) -> [f64; 2] {
    let century = days / 36_525.0;
    let mean_longitude = 280.46646 + century * (36_000.769_83 + 0.000_303_2 * century);
    let anomaly = (357.529_11 + century * (35_999.050_29 - 0.000_153_7 * century)).to_radians();
    let centre = anomaly.sin() * (1.914_602 - century * 0.004_817) + (2.0 * anomaly).sin() * 0.019_993 + (3.0 * anomaly).sin() * 0.000_289;
    let node = (125.04 - 1934.136 * century).to_radians();
    let ecliptic = (mean_longitude + centre - 0.005_69 - 0.004_78 * node.sin()).to_radians();
    let tilt = (23.439_291 - 0.013_004 * century + 0.002_56 * node.cos()).to_radians();
    let declination = (tilt.sin() * ecliptic.sin()).asin();
    let ascension = (tilt.cos() * ecliptic.sin()).atan2(ecliptic.cos()).to_degrees();
    let sidereal = 280.460_618_37 + 360.985_647_366_29 * days;
    let hour_angle = (sidereal + longitude - ascension).to_radians();
    let (latitude, (sin, cos)) = (latitude.to_radians(), hour_angle.sin_cos());
    let height = (latitude.sin() * declination.sin() + latitude.cos() * declination.cos() * cos).asin();
    let south = (cos * latitude.sin() - declination.tan() * latitude.cos(), sin);
    [height.to_degrees() + refraction(height), (180.0 + south.1.atan2(south.0).to_degrees()).rem_euclid(360.0)]
}

/// Degrees, by Saemundsson's formula at the height of the sea.
fn refraction(height: f64) -> f64 {
    let degrees = height.to_degrees();
    if degrees < -0.833 { 0.0 } else { 1.02 / 60.0 / (degrees + 10.3 / (degrees + 5.11)).to_radians().tan() }
}

/// Days from noon of the first of January 2000 to an hour of a common year.
fn days(year: i32, day_of_year: u32, hour: f64, utc_offset: f64) -> f64 {
    let before: i32 = (2000..year).map(|year| 365 + i32::from(year % 4 == 0)).sum();
    f64::from(before) + f64::from(day_of_year) - 1.5 + (hour - utc_offset) / 24.0
}

const MANNHEIM: [f64; 3] = [49.52, 8.55, 1.0];
const SYDNEY: [f64; 3] = [-33.95, 151.18, 10.0];
const QUITO: [f64; 3] = [-0.15, -78.48, -5.0];
const SVALBARD: [f64; 3] = [78.25, 15.47, 1.0];

#[test]
fn suns_stand_where_an_almanac_has_them() {
    for (place, year) in [(MANNHEIM, 2009), (SYDNEY, 2013), (QUITO, 2021), (SVALBARD, 2025)] {
        let found = suns(place, year, SunPositions::True);
        let mut worst = [0.0_f64; 2];
        for step in &found.steps {
            let [height, azimuth] = noaa(days(year, step.day_of_year, step.hour, place[2]), place);
            if !(8.0..=89.0).contains(&height) {
                continue;
            }
            let off = (step.sun.azimuth.to_degrees() - azimuth + 180.0).rem_euclid(360.0) - 180.0;
            worst = [worst[0].max((step.sun.altitude.to_degrees() - height).abs()), worst[1].max((off * height.to_radians().cos()).abs())];
        }
        assert!(worst[0] < 0.012 && worst[1] < 0.012, "{place:?}: {worst:?}");
    }
}

#[test]
fn a_sun_that_rises_stands_in_the_middle_of_its_part_of_the_hour() {
    let found = suns(MANNHEIM, 2009, SunPositions::True);
    let height = |day: u32, hour: f64| noaa(days(2009, day, hour, 1.0), MANNHEIM)[0];
    let mut part = 0;
    for step in &found.steps {
        // Minutes of the hour in which the upper limb is over the horizon.
        let up: Vec<f64> = (0..60)
            .map(|minute| step.hour - 0.5 + (f64::from(minute) + 0.5) / 60.0)
            .filter(|hour| height(step.day_of_year, *hour) > -0.2665)
            .collect();
        assert!(step.sun.is_up() || up.len() < 2, "{}.{}. {}", step.day, step.month, step.hour);
        if (2..59).contains(&up.len()) {
            let middle = 0.5 * (up[0] + up[up.len() - 1]);
            let off = step.sun.altitude.to_degrees() - height(step.day_of_year, middle);
            assert!(off.abs() < 0.15, "{}.{}. {}: {off}", step.day, step.month, step.hour);
            part += 1;
        }
    }
    assert!((680..=730).contains(&part), "{part}");
    // The direct light of such hours is none that comes from below the horizon.
    let told = |year: &Year| year.doubts[0].split("in ").nth(1).and_then(|text| text.split(' ').next()?.parse::<usize>().ok());
    let with_radiance = suns(MANNHEIM, 2009, SunPositions::Radiance);
    assert!(told(&found).is_some_and(|count| told(&with_radiance).is_some_and(|more| count + 300 < more)));
}

#[test]
fn nights_of_the_pole_have_no_sun_and_its_days_no_night() {
    let found = suns(SVALBARD, 2025, SunPositions::True);
    let up = |days: std::ops::Range<usize>| found.steps[days.start * 24..days.end * 24].iter().filter(|step| step.sun.is_up()).count();
    assert_eq!((up(0..40), up(325..365), up(125..225)), (0, 0, 2400));
    // At noon the sun stands in the north of southern places.
    let noon = suns(SYDNEY, 2025, SunPositions::True).steps[171 * 24 + 11].sun;
    assert!((noon.altitude.to_degrees() - 32.6).abs() < 0.5 && noon.direction()[1] > 0.8, "{noon:?}");
}

#[test]
fn records_have_the_sun_of_their_year() {
    let equinox = 79 * 24 + 12;
    let sun = |year| suns(MANNHEIM, year, SunPositions::True).steps[equinox].sun;
    // Three years after a leap year the sun is three quarters of a day later: 0.3° in March.
    assert!((sun(2000).altitude - sun(2003).altitude).to_degrees() > 0.25);
    let unknown = suns(MANNHEIM, 9999, SunPositions::True);
    assert_eq!((unknown.steps[0].calendar_year, unknown.steps[equinox].sun), (None, sun(2025)));
    let radiances: Sun = suns(MANNHEIM, 2000, SunPositions::Radiance).steps[equinox].sun;
    assert_eq!(radiances, suns(MANNHEIM, 2003, SunPositions::Radiance).steps[equinox].sun);
    assert!(SunPositions::parse("true").is_ok_and(|positions| positions == SunPositions::True));
    assert!(SunPositions::parse("noaa").is_err_and(|error| error.to_string().contains("expected true or radiance")));
}
