//! ISO 8601 and the calendar.

use crate::sky::Moment;

#[test]
fn iso_8601_is_read_and_written() {
    for (text, written) in [
        ("2003-10-17T12:30:30-07:00", "2003-10-17T12:30:30-07:00"),
        ("2024-02-29 06:05Z", "2024-02-29T06:05:00+00:00"),
        ("2024-12-31T23:59:59.4+0530", "2024-12-31T23:59:59+05:30"),
        ("2000-01-01T00:00+01", "2000-01-01T00:00:00+01:00"),
    ] {
        assert_eq!(Moment::parse(text).expect(text).to_string(), written);
    }
}

#[test]
fn julian_dates_are_the_published_ones() {
    // Reda and Andreas, table A4.1.
    for (text, expected) in [
        ("2000-01-01T12:00Z", 2_451_545.0),
        ("1999-01-01T00:00Z", 2_451_179.5),
        ("1987-01-27T00:00Z", 2_446_822.5),
        ("1987-06-19T12:00Z", 2_446_966.0),
        ("1988-01-27T00:00Z", 2_447_187.5),
        ("1900-01-01T00:00Z", 2_415_020.5),
        ("1600-12-31T00:00Z", 2_305_812.5),
        ("2003-10-17T12:30:30-07:00", 2_452_930.312_847),
    ] {
        let found = Moment::parse(text).expect(text).julian_date();
        assert!((found - expected).abs() < 1e-6, "{text}: {found}, expected {expected}");
    }
}

#[test]
fn days_of_the_year_count_the_leap_day() {
    let day = |text| Moment::parse(text).expect(text).day_of_year();
    assert_eq!(
        [day("2023-12-31T00:00Z"), day("2024-12-31T00:00Z"), day("2024-03-01T00:00Z"), day("1900-03-01T00:00Z")],
        [365, 366, 61, 60]
    );
}

#[test]
fn clocks_differ_and_moments_do_not() {
    let moment = Moment::parse("2024-02-28T23:30+01:00").expect("a moment");
    for (offset, written) in [(0.0, "2024-02-28T22:30:00+00:00"), (2.0, "2024-02-29T00:30:00+02:00"), (-23.0, "2024-02-27T23:30:00-23:00")]
    {
        let moved = moment.with_offset(offset);
        assert_eq!(moved.to_string(), written);
        assert!((moved.julian_date() - moment.julian_date()).abs() < 1e-9);
    }
    assert_eq!(Moment::parse("2024-01-01T00:30+01:00").expect("a moment").with_offset(0.0).to_string(), "2023-12-31T23:30:00+00:00");
    assert_eq!(Moment::parse("2023-12-31T23:30-01:00").expect("a moment").with_offset(0.0).to_string(), "2024-01-01T00:30:00+00:00");
}

#[test]
fn what_is_no_moment_is_told() {
    for (text, word) in [
        ("2024-06-21", "no time of day"),
        ("2024-06-21T12:00", "no offset"),
        ("2024-06-31T12:00Z", "day: 31"),
        ("2023-02-29T12:00Z", "day: 29"),
        ("2024-13-01T12:00Z", "month: 13"),
        ("9999-01-01T12:00Z", "year: 9999"),
        ("24-6-21-5T12:00Z", "year-month-day"),
        ("2024-06-21T25:00Z", "hours:minutes"),
        ("2024-06-21T12:61Z", "hours:minutes"),
        ("2024-06-21T12:00:nanZ", "hours:minutes"),
        ("2024-06-21T12:00+1", "offset is not"),
        ("2024-06-21T12:00+05:99", "offset is not"),
        ("2024-06-21T12:00Zulu", "offset is not"),
        ("", "no time of day"),
        ("99999999999999999999-01-01T00:00Z", "year-month-day"),
        ("ä-01-01Tö:00Z", "year-month-day"),
    ] {
        let problem = Moment::parse(text).expect_err(text).to_string();
        assert!(problem.contains(word), "{text}: {problem}");
    }
}
