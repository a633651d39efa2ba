//! Numbers as a planner reads them: no digits that the noise makes.

use gonio::measure::Reading;
use gonio_formats::{rounded, short_number};

/// A value with its standard error and unit: as many places as the error has with two digits, and four digits at most.
pub(super) fn with_error(reading: &Reading, unit: &str) -> String {
    let Reading { value, standard_error } = *reading;
    if value.is_nan() {
        return "not measured".into();
    }
    let text = rounded(value, standard_error).map_or_else(|| short_number(value), |[value, error]| format!("{value} ± {error}"));
    format!("{text} {unit}").trim_end().to_owned()
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
