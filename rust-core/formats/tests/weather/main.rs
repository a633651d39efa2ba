//! EPW and WEA files, good and broken.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use gonio_formats::weather::{Hour, Quantities, read};

const WEA: &str = "place Oakland_USA\nlatitude 37.72\nlongitude 122.22\ntime_zone 120\nsite_elevation 2.0\nweather_data_file_units 1
6 21 11.500 830 95\n6 21 12.500 850 90.5\n";

fn epw() -> String {
    let mut text = String::from("LOCATION,Oakland,CA,USA,TMY3,724930,37.72,-122.22,-8.0,2.0\n");
    for name in ["DESIGN CONDITIONS,0", "TYPICAL/EXTREME PERIODS,0", "GROUND TEMPERATURES,0", "HOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0"] {
        text += &format!("{name}\n");
    }
    text += "COMMENTS 1,none\nCOMMENTS 2,none\nDATA PERIODS,1,1,Data,Sunday,6/21,6/21\n";
    for hour in 12..14 {
        text += &format!("1997,6,21,{hour},60,?9?9?9,21.0,12.5,58,101300,1321,1321,330,900,8{hour},95,1,2,3,4,5,6\n");
    }
    text
}

#[test]
fn a_wea_file_is_read() {
    let weather = read(WEA.replace('\n', "\r\n").as_bytes()).unwrap();
    assert_eq!((weather.place.as_str(), weather.latitude_deg, weather.longitude_deg), ("Oakland_USA", 37.72, -122.22));
    assert_eq!((weather.utc_offset_h, weather.elevation_m, weather.hours.len()), (-8.0, 2.0, 2));
    let found = weather.at(6, 21, 12.9).unwrap();
    assert_eq!((found.hour, found.direct_normal, found.diffuse_horizontal, found.dew_point_c), (12.5, 850.0, 90.5, None));
    assert!(weather.at(6, 22, 12.0).is_none());
}

#[test]
fn wea_files_say_what_their_numbers_are() {
    let of = |units: &str, sun: &str| read(WEA.replace("units 1", units).replace("850", sun).as_bytes());
    for (units, quantities) in
        [("units 1", Quantities::NormalIrradiance), ("units 2", Quantities::HorizontalIrradiance), ("units 3", Quantities::Illuminance)]
    {
        let found = of(units, "850").unwrap();
        assert_eq!((found.quantities, found.hours[1].direct_normal, found.hours[1].diffuse_horizontal), (quantities, 850.0, 90.5));
    }
    assert_eq!(of("units 3", "98000").unwrap().hours[1].direct_normal, 98_000.0);
    assert!(of("units 2", "98000").unwrap_err().to_string().starts_with("line 8: the direct horizontal irradiance is '98000'"));
}

#[test]
fn whole_hours_begin_or_end_their_intervals() {
    let day = |hours: std::ops::Range<u32>| {
        let header = WEA.split("6 21").next().unwrap();
        let lines: String = hours.map(|hour| format!("6 21 {hour} {} 10\n", 10 * hour)).collect();
        read((header.to_owned() + &lines).as_bytes()).unwrap().hours
    };
    let at = |hours: &[Hour], index: usize| (hours[index].hour, hours[index].direct_normal);
    assert_eq!(at(&day(0..24), 12), (12.5, 120.0));
    // Parts of hours from 1.000 to 24.917 in steps of five minutes, and middles of quarters up to 24.875.
    let parts = |per_hour: u32, offset: f64| {
        let (header, _) = WEA.split_at(WEA.find("6 21").unwrap());
        let record = |i: u32| format!("6 21 {:.3} {} 10\n", 1.0 + (f64::from(i) + offset) / f64::from(per_hour), i);
        read((header.to_owned() + &(0..24 * per_hour).map(record).collect::<String>()).as_bytes()).unwrap().hours
    };
    for (per_hour, offset) in [(12, 0.0), (4, 0.5)] {
        let hours = parts(per_hour, offset);
        let middle = |index: u32| (f64::from(index) + 0.5) / f64::from(per_hour);
        assert!((0..24 * per_hour).all(|i| (hours[i as usize].hour - middle(i)).abs() < 2e-3), "{per_hour}: {:?}", hours[0]);
        assert_eq!(hours.last().unwrap().direct_normal, f64::from(24 * per_hour - 1));
    }
    assert_eq!(at(&day(1..25), 12), (12.5, 130.0));
    // Whether they begin or end nobody can tell.
    assert_eq!(at(&day(8..18), 4), (12.0, 120.0));
}

#[test]
fn what_is_far_from_every_record_has_none() {
    let weather = read(WEA.as_bytes()).unwrap();
    assert!(weather.at(6, 21, 13.4).is_some() && weather.at(6, 21, 13.6).is_none() && weather.at(6, 21, 20.0).is_none());
}

#[test]
fn decimal_commas_are_refused_by_their_line() {
    let wea = |from: &str, to: &str| read(WEA.replacen(from, to, 1).as_bytes()).unwrap_err().to_string();
    assert!(wea("37.72", "37,72").starts_with("line 2: latitude is '37,72'"));
    assert!(wea("11.500", "11,500").starts_with("line 7: the hour is '11,500'"));
    assert!(wea(" 90.5", " 90,5").starts_with("line 8: the diffuse horizontal irradiance is '90,5'"));
}

#[test]
fn an_epw_file_is_read() {
    let weather = read(epw().as_bytes()).unwrap();
    assert_eq!((weather.latitude_deg, weather.longitude_deg, weather.utc_offset_h, weather.elevation_m), (37.72, -122.22, -8.0, 2.0));
    let expected =
        Hour { year: Some(1997), month: 6, day: 21, hour: 11.5, direct_normal: 812.0, diffuse_horizontal: 95.0, dew_point_c: Some(12.5) };
    assert_eq!(weather.hours[0], expected);
    let quarters = epw().replace("DATA PERIODS,1,1", "DATA PERIODS,1,4").replace("21,12,60", "21,12,15");
    assert_eq!(read(quarters.as_bytes()).unwrap().hours[0].hour, 11.125);
}

#[test]
fn what_is_broken_is_told_with_its_line() {
    let wea = |from: &str, to: &str| read(WEA.replace(from, to).as_bytes()).unwrap_err().to_string();
    assert!(wea("latitude 37.72", "latitude 97.72").starts_with("line 2: latitude is '97.72', expected"));
    assert!(wea("850", "8x0").starts_with("line 8: the direct normal irradiance is '8x0'"));
    assert!(wea(" 90.5", "").starts_with("line 8: the diffuse horizontal irradiance is missing"));
    assert!(wea(" 90.5", " -1").contains("expected a number from 0 to 1500"));
    assert!(wea(" 90.5", " nan").contains("expected a number"));
    assert!(wea("units 1", "units 4").starts_with("line 6: weather_data_file_units is '4', expected 1"));
    assert!(wea("time_zone", "timezone").starts_with("line 4: "));
    assert!(read(WEA.lines().take(6).collect::<Vec<_>>().join("\n").as_bytes()).unwrap_err().to_string().contains("no hours"));
    let of_epw = |from: &str, to: &str| read(epw().replace(from, to).as_bytes()).unwrap_err().to_string();
    assert!(of_epw("812", "9999").contains("line 9: the direct normal irradiance was not measured"));
    assert!(of_epw("813", "2000").contains("line 10: the direct normal irradiance is '2000'"));
    assert!(of_epw("DATA PERIODS", "PERIODS").contains("DATA PERIODS"));
    assert!(of_epw("1,1,Data", "1,0,Data").starts_with("line 8: "));
    assert!(of_epw("-8.0", "west").starts_with("line 1: the time zone"));
    assert!(of_epw("21,13,60", "21,25,60").starts_with("line 10: the hour is '25'"));
    for rubbish in [&b""[..], b"\0\0\0", b"\x89PNG\r\n\x1a\n", b"place", b"LOCATION,", b"\xff\xfe"] {
        assert!(read(rubbish).is_err());
    }
}
