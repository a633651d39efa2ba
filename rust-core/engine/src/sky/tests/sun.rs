//! The sun's place and times.

use crate::sky::{Air, Moment, Place, sun_position, sun_times};

fn close(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{found} was found, expected {expected} ± {tolerance}");
}

#[test]
fn the_report_s_example_is_met() {
    let place = Place { latitude_deg: 39.742_476, longitude_deg: -105.1786, elevation_m: 1830.14 };
    let moment = Moment::parse("2003-10-17T12:30:30-07:00").expect("a moment");
    let air = Air { pressure_hpa: 820.0, temperature_c: 11.0 };
    let sun = sun_position(&place, &moment, &air).expect("a sun");
    // TP-560-34302, table A5.1; its ΔT of 67 s is not quite the one estimated for the month.
    close(90.0 - sun.elevation_deg, 50.111_62, 3e-4);
    close(sun.azimuth_deg, 194.340_24, 3e-4);
    let times = sun_times(&place, &moment).expect("times");
    close(times.sunrise_h.expect("a sunrise"), 6.0 + 12.0 / 60.0 + 43.46 / 3600.0, 3.0 / 3600.0);
    // The report takes the sunset of the day in Greenwich, where the 17th begins with that of the 16th.
    let before = sun_times(&place, &Moment { day: 16, ..moment }).expect("times");
    close(before.sunset_h.expect("a sunset"), 17.0 + 20.0 / 60.0 + 19.19 / 3600.0, 3.0 / 3600.0);
    close(times.sunset_h.expect("a sunset") - before.sunset_h.expect("a sunset"), -88.0 / 3600.0, 5.0 / 3600.0);
    close(times.transit_h.expect("a transit"), 11.0 + 46.0 / 60.0 + 4.97 / 3600.0, 2.0 / 3600.0);
}

#[test]
fn the_sun_goes_from_east_over_the_equator_s_side_to_west() {
    let moment = |hour| Moment { year: 2024, month: 3, day: 20, hour, utc_offset_h: 0.0 };
    for (latitude_deg, noon) in [(50.0, 180.0), (-50.0, 360.0)] {
        let place = Place { latitude_deg, longitude_deg: 0.0, elevation_m: 0.0 };
        let at = |hour| sun_position(&place, &moment(hour), &Air::standard(&place)).expect("a sun");
        let [morning, midday, evening] = [at(6.5), at(12.1), at(18.0)];
        close(morning.azimuth_deg, 90.0, 10.0);
        close(evening.azimuth_deg, 270.0, 10.0);
        // On the southern half the sun passes north, where azimuths begin anew.
        close((midday.azimuth_deg - noon + 180.0).rem_euclid(360.0), 180.0, 3.0);
        close(midday.elevation_deg, 40.0, 0.6);
        let [east, north, up] = midday.direction();
        assert!(east.abs() < 0.05 && north * latitude_deg < 0.0 && up > 0.6);
    }
}

#[test]
fn beyond_the_polar_circle_the_sun_may_stay() {
    let place = Place { latitude_deg: 80.0, longitude_deg: 20.0, elevation_m: 0.0 };
    for (month, day) in [(6, 21), (12, 21)] {
        let times = sun_times(&place, &Moment { year: 2024, month, day, hour: 12.0, utc_offset_h: 1.0 }).expect("times");
        assert_eq!((times.sunrise_h, times.sunset_h), (None, None));
        assert!(times.transit_h.is_some());
    }
}

#[test]
fn refraction_lifts_the_sun_at_the_horizon() {
    let place = Place { latitude_deg: 0.0, longitude_deg: 0.0, elevation_m: 0.0 };
    let moment = Moment { year: 2024, month: 3, day: 20, hour: 18.1, utc_offset_h: 0.0 };
    let thin = sun_position(&place, &moment, &Air { pressure_hpa: 1.0, temperature_c: 15.0 }).expect("a sun");
    let thick = sun_position(&place, &moment, &Air::standard(&place)).expect("a sun");
    close(thick.elevation_deg - thin.elevation_deg, 0.5, 0.15);
}
