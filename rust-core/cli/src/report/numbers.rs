//! Numbers as a planner reads them: no digits that the noise makes.

use gonio::measure::Reading;
use gonio_formats::short_number;

/// Digits of a standard error.
const ERROR_DIGITS: i32 = 2;

/// A value with its standard error and unit: the error with two digits, the value with as many places.
pub(super) fn with_error(reading: &Reading, unit: &str) -> String {
    let Reading { value, standard_error } = *reading;
    let text = match places(standard_error) {
        Some(places) => format!("{} ± {}", fixed(value, places), fixed(standard_error, places)),
        None => short_number(value),
    };
    format!("{text} {unit}").trim_end().to_owned()
}

/// Decimal places that an error of two digits ends with, negative before the point; none where there is no error to speak of.
fn places(error: f64) -> Option<i32> {
    (error.is_finite() && error > 1e-6).then(|| ERROR_DIGITS - 1 - error.log10().floor() as i32)
}

/// A number rounded to decimal places, to whole tens for −1.
fn fixed(value: f64, places: i32) -> String {
    if places >= 0 {
        return format!("{value:.*}", places as usize);
    }
    let tens = 10f64.powi(-places);
    format!("{:.0}", (value / tens).round() * tens)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_end_where_their_errors_do() {
        for (value, standard_error, text) in [
            (693.912_3, 0.314_15, "693.91 ± 0.31 lx"),
            (3199.9998, 12.4, "3200 ± 12 lx"),
            (48_613.2, 137.0, "48610 ± 140 lx"),
            (0.012_345, 0.000_678, "0.01234 ± 0.00068 lx"),
            (500.0, 0.0, "500 lx"),
            (3199.9998, 1e-9, "3200 lx"),
        ] {
            assert_eq!(with_error(&Reading { value, standard_error }, "lx"), text);
        }
        assert_eq!(with_error(&Reading { value: 18.64, standard_error: 0.021 }, ""), "18.640 ± 0.021");
    }
}
