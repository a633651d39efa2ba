//! What cannot be used is told with its place.

use super::{group, made_up, made_up_weather, settings};
use crate::{
    Coefficients, Group, Schedule, Year, evaluate,
    sky::{Light, Model, SkyMatrix, SkyOptions},
    to_npy,
};
use gonio_formats::weather::Weather;
use std::path::Path;

fn problem(weather: &Weather) -> String {
    let lines: Vec<u64> = (9..).take(weather.hours.len()).collect();
    Year::new(weather, &lines).expect_err("no year").to_string()
}

#[test]
fn a_year_has_every_hour_once() {
    let mut missing = made_up_weather();
    missing.hours.remove(1000);
    assert!(problem(&missing).contains("line 1009: the record is of 11.2. 17.50 h, expected 11.2. 16.50 h"));
    let mut double = made_up_weather();
    double.hours.insert(30, double.hours[30]);
    assert!(problem(&double).contains("line 40: the record is of 2.1. 6.50 h, expected 2.1. 7.50 h"));
    let mut first = made_up_weather();
    first.hours.remove(3);
    assert!(problem(&first).contains("line 12: the record is of 1.1. 4.50 h, expected 1.1. 3.50 h"));
    let mut short = made_up_weather();
    short.hours.truncate(5000);
    assert!(problem(&short).contains("line 5008: the file ends after 5000 records, expected 8760"));
    let mut odd = made_up_weather();
    odd.hours[5].day = 32;
    assert!(problem(&odd).contains("line 14: there is no day 32.1."));
    assert!(problem(&Weather::default()).contains("expected 8760"));
}

#[test]
fn leap_years_have_a_day_more() {
    let mut leap = made_up_weather();
    let day: Vec<_> = leap.hours[58 * 24..59 * 24].iter().map(|hour| gonio_formats::weather::Hour { day: 29, ..*hour }).collect();
    leap.hours.splice(59 * 24..59 * 24, day);
    let year = Year::new(&leap, &[]).expect("a leap year");
    assert_eq!((year.steps.len(), year.steps[8783].day_of_year), (8784, 366));
    leap.hours.truncate(8760);
    assert!(problem(&leap).contains("expected 8784"));
}

#[test]
fn the_sun_is_right_in_the_south_and_beyond_the_circles() {
    let noon = |latitude_deg: f64, step: usize| {
        let weather = Weather { latitude_deg, longitude_deg: 15.0, ..made_up_weather() };
        Year::new(&weather, &[]).expect("a year").steps[step].sun
    };
    // At noon on the 21st of June the sun stands 90 - |latitude - 23.4| degrees high: in the north of southern places.
    let june = 171 * 24 + 12;
    let sydney = noon(-33.9, june);
    assert!((sydney.altitude.to_degrees() - 32.7).abs() < 1.0 && sydney.direction()[1] > 0.8, "{sydney:?}");
    let rome = noon(41.9, june);
    assert!((rome.altitude.to_degrees() - 71.5).abs() < 1.5 && rome.direction()[1] < -0.2, "{rome:?}");
    let svalbard = Weather { latitude_deg: 78.2, longitude_deg: 15.6, ..made_up_weather() };
    let year = Year::new(&svalbard, &[]).expect("a year");
    let up = |days: std::ops::Range<usize>| year.steps[days.start * 24..days.end * 24].iter().filter(|step| step.sun.is_up()).count();
    assert_eq!((up(0..30), up(150..180)), (0, 30 * 24));
    assert!(year.doubts[0].contains("direct light while the sun is below the horizon"));
}

#[test]
fn settings_have_ranges() {
    let year = made_up();
    let wrong = |options: SkyOptions| SkyMatrix::new(&year, options).expect_err("out of range").to_string();
    assert!(wrong(SkyOptions { factor: 7, ..SkyOptions::default() }).contains("7 was found, expected 1 to 6"));
    assert!(wrong(SkyOptions { ground: f64::NAN, ..SkyOptions::default() }).contains("ground: NaN was found, expected 0 to 1"));
    assert!(wrong(SkyOptions { rotation_deg: f64::INFINITY, ..SkyOptions::default() }).contains("rotation"));
    assert!(wrong(SkyOptions { light: Light::All { sun_patches: 5 }, ..SkyOptions::default() }).contains("expected 1 to 4"));
    assert!(wrong(SkyOptions { model: Model::Cie(17), ..SkyOptions::default() }).contains("expected 1 to 16"));
    for (from, to) in [(18.0, 8.0), (8.0, 25.0), (f64::NAN, 8.0), (8.1, 8.2)] {
        assert!(Schedule::daily(&year, from, to).is_err());
    }
}

#[test]
fn matrices_fit_each_other_and_the_year() {
    let year = made_up();
    let schedule = Schedule::daily(&year, 8.0, 18.0).expect("a schedule");
    let wrong = |groups: &[Group]| evaluate(&year, &schedule, groups, &settings(), &mut |_| true).expect_err("does not fit").to_string();
    let of = |points: usize, columns: usize| Coefficients::new(points, columns, vec![vec![0.0; points * columns]]).expect("coefficients");
    let plain = || Group { open: of(2, 146), direct: None, sun: None, scattered: None, blinds: None, closed: None };
    assert!(wrong(&[Group { open: of(2, 145), ..plain() }]).contains("145 columns, expected those of a sky with its ground: 146, 578"));
    assert!(wrong(&[Group { direct: Some(of(3, 146)), ..plain() }]).contains("3 rows, expected 2"));
    assert!(wrong(&[Group { direct: Some(of(2, 7)), ..plain() }]).contains("7 columns, expected 146 (patches) or 4"));
    assert!(wrong(&[Group { sun: Some(of(2, 146)), ..plain() }]).contains("146 columns, expected 4"));
    assert!(wrong(&[Group { blinds: Some(crate::Blinds::Share(0.02)), ..plain() }]).contains("direct coefficients are missing"));
    assert!(wrong(&[]).contains("there are none"));
    let stopped = evaluate(&year, &schedule, &[group(&[vec![0.0; 146]])], &settings(), &mut |_| false);
    assert!(stopped.is_ok_and(|grid| grid.is_none()));
}

fn read(bytes: &[u8]) -> Result<Coefficients, String> {
    Coefficients::read(Path::new("a.mtx"), bytes).map_err(|error| error.to_string())
}

#[test]
fn matrices_are_read_in_all_their_formats() {
    let text = b"#?RADIANCE\nrcontrib\nNROWS=2\nNCOLS=2\nNCOMP=3\nFORMAT=ascii\n\n1 1 1\t2 2 2\n3 3 3\t4 4 4\n";
    let mut float = b"#?RADIANCE\nNCOLS=2\nNCOMP=1\nBigEndian=0\nFORMAT=float\n\n".to_vec();
    [1.0_f32, 2.0, 3.0, 4.0].iter().for_each(|value| float.extend(value.to_le_bytes()));
    let mut double = b"#?RADIANCE\nNROWS=2\nNCOLS=2\nNCOMP=1\nBigEndian=1\nFORMAT=double\n\n".to_vec();
    [1.0_f64, 2.0, 3.0, 4.0].iter().for_each(|value| double.extend(value.to_be_bytes()));
    for bytes in [text.to_vec(), float, double, to_npy(2, 2, &[1.0, 2.0, 3.0, 4.0])] {
        let found = read(&bytes).expect("a matrix");
        assert_eq!((found.points, found.columns), (2, 2));
        found.blocks[0].iter().zip([1.0, 2.0, 3.0, 4.0]).for_each(|(value, expected)| assert!((value - expected).abs() < 1e-6));
    }
}

#[test]
fn what_is_no_matrix_is_told() {
    let head = "#?RADIANCE\nNROWS=1\nNCOLS=2\nNCOMP=1\nFORMAT=ascii\n\n";
    let text = |rest: &str| read(format!("{head}{rest}").as_bytes()).expect_err("no matrix");
    assert!(text("1 x").contains(":7: 'x' was found, expected a coefficient"));
    assert!(text("1\nnan").contains(":8: 'nan' was found"));
    assert!(text("1\n-1").contains(":8: '-1' was found"));
    assert!(text("1 2 3").contains("3 numbers of 1 components were found, expected 1 × 2"));
    assert!(read(b"hello").expect_err("no matrix").contains("no matrix"));
    assert!(read(b"#?RADIANCE\nNROWS=1").expect_err("no matrix").contains("no empty line"));
    assert!(read(b"#?RADIANCE\nNROWS=x\n\n").expect_err("no matrix").contains(":2: NROWS is 'x'"));
    assert!(read(b"#?RADIANCE\nNCOMP=2\n\n").expect_err("no matrix").contains(":2: NCOMP is 2"));
    assert!(read(b"#?RADIANCE\nNROWS=1\n\n1 2").expect_err("no matrix").contains("no NCOLS="));
    assert!(read(format!("#?RADIANCE\nNROWS={0}\nNCOLS={0}\n\n", usize::MAX).as_bytes()).is_err());
    assert!(read(b"#?RADIANCE\nNCOLS=1\nFORMAT=32-bit_rle_rgbe\n\n").expect_err("no matrix").contains("expected ascii, float or double"));
    assert!(read(&to_npy(1, 2, &[1.0, f32::NAN])).expect_err("no matrix").contains("NaN in row 1, column 2"));
    let array = to_npy(2, 2, &[1.0; 4]);
    assert!((0..array.len()).all(|length| read(&array[..length]).is_err()));
    let place = array.windows(5).position(|word| word == b"False").expect("the order");
    let mut order = array.clone();
    order[place..place + 5].copy_from_slice(b"True ");
    assert!(read(&order).expect_err("no matrix").contains("not in C's order"));
}

#[test]
fn schedules_have_a_number_for_each_step() {
    let year = made_up();
    let schedule = |text: String| Schedule::read(Path::new("used.txt"), text.as_bytes(), &year).map_err(|error| error.to_string());
    assert_eq!(schedule("# used\n".to_owned() + &"1\n".repeat(8760)).expect("a schedule").count(), 8760);
    assert!(schedule("1\n0\nhalf\n".into()).expect_err("no schedule").contains(":3: 'half' was found, expected 0 or 1"));
    assert!(
        schedule("1\n".repeat(8784))
            .expect_err("no schedule")
            .contains("8784 numbers were found, expected one for each of the weather's 8760")
    );
    assert!(schedule("0\n".repeat(8760)).expect_err("no schedule").contains("no step of the year is used"));
}

#[test]
fn weather_files_tell_file_and_line() {
    let header = "LOCATION,A,B,C,D,1,49.5,8.5,1,96\nDATA PERIODS,1,1,Data,Sunday,1/1,12/31\n";
    let row = |hour: u32, direct: &str| format!("2023,1,1,{hour},0,x,1,1,1,1,1,1,1,1,{direct},50,0\n");
    let wrong = |text: String| Year::read(Path::new("weather.epw"), text.as_bytes()).expect_err("no year").to_string();
    let of = |text: String| wrong(format!("{header}{text}"));
    assert!(of(row(1, "0") + &row(2, "9999")).contains("weather.epw:4: the direct normal irradiance was not measured (9999)"));
    assert!(of(row(1, "0") + &row(2, "nan")).contains("weather.epw:4: the direct normal irradiance is 'nan'"));
    assert!(of(row(1, "0") + "\n" + &row(3, "0")).contains("weather.epw:5: the record is of 1.1. 2.50 h, expected 1.1. 1.50 h"));
}
