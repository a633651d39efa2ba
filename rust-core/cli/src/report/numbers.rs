//! Numbers as a planner reads them: no digits that the noise makes.

use gonio::measure::Reading;
use gonio_formats::short_number;

/// Digits of a standard error.
const ERROR_DIGITS: i32 = 2;

/// Most digits of a value: no lamp and no eye knows more.
const VALUE_DIGITS: i32 = 4;

/// A value with its standard error and unit: as many places as the error has with two digits, and four digits at most.
pub(super) fn with_error(reading: &Reading, unit: &str) -> String {
    let Reading { value, standard_error } = *reading;
    if value.is_nan() {
        return "not measured".into();
    }
    let text = match places(standard_error, value.abs()) {
        // What is too small to be seen is at most one in the last place.
        Some(places) => format!("{} ± {}", fixed(value, places), fixed(standard_error.max(10f64.powi(-places)), places)),
        None => short_number(value),
    };
    format!("{text} {unit}").trim_end().to_owned()
}

/// Decimal places of a value with its error, negative before the point; none where there is no error to speak of.
fn places(error: f64, value: f64) -> Option<i32> {
    let after = |digits: i32, number: f64| digits - 1 - number.log10().floor() as i32;
    let of_error = (error.is_finite() && error > 1e-6).then(|| after(ERROR_DIGITS, error))?;
    Some(if value > error { of_error.min(after(VALUE_DIGITS, value)) } else { of_error })
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
            (693.912_3, 0.314_15, "693.9 ± 0.3 lx"),
            (250.204, 0.003, "250.2 ± 0.1 lx"),
            (3199.9998, 12.4, "3200 ± 12 lx"),
            (48_613.2, 137.0, "48610 ± 140 lx"),
            (48_613.2, 2.0, "48610 ± 10 lx"),
            (0.012_346, 0.000_678, "0.01235 ± 0.00068 lx"),
            (0.1, 12.4, "0 ± 12 lx"),
            (500.0, 0.0, "500 lx"),
            (3199.9998, 1e-9, "3200 lx"),
        ] {
            assert_eq!(with_error(&Reading { value, standard_error }, "lx"), text);
        }
        assert_eq!(with_error(&Reading { value: 18.64, standard_error: 0.021 }, ""), "18.64 ± 0.02");
    }
}
