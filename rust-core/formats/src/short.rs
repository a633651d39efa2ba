//! Numbers and texts for readers.

/// Three digits that count, whole from 100 on, without zeros behind the point; a power of ten where that would be long.
pub fn short_number(value: f64) -> String {
    if !(1e-4..1e7).contains(&value.abs()) {
        return if value == 0.0 { "0".into() } else { format!("{value:.0e}") };
    }
    let digits = (2 - value.abs().log10().floor() as i32).clamp(0, 6) as usize;
    let text = format!("{value:.digits$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// Digits of a standard error.
const ERROR_DIGITS: i32 = 2;
/// Most digits of a value: no lamp and no eye knows more.
const VALUE_DIGITS: i32 = 4;

/// A value and its standard error without the digits that noise makes: as many places as the error has with two digits, and four digits at most; none
/// where there is no error to speak of.
pub fn rounded(value: f64, error: f64) -> Option<[String; 2]> {
    let after = |digits: i32, number: f64| digits - 1 - number.log10().floor() as i32;
    let of_error = (error.is_finite() && error > 1e-6).then(|| after(ERROR_DIGITS, error))?;
    let size = value.abs();
    let places = if size > error { of_error.min(after(VALUE_DIGITS, size)) } else { of_error };
    // What is too small to be seen is at most one in the last place.
    Some([fixed(value, places), fixed(error.max(10f64.powi(-places)), places)])
}

/// A number rounded to decimal places, to whole tens for −1.
fn fixed(value: f64, places: i32) -> String {
    if places >= 0 {
        return format!("{value:.*}", places as usize);
    }
    let tens = 10f64.powi(-places);
    format!("{:.0}", (value / tens).round() * tens)
}

/// Text that neither breaks a line nor reaches into a terminal: control characters are replaced.
pub fn tame(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { char::REPLACEMENT_CHARACTER } else { c }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_end_where_their_errors_do() {
        for (value, error, texts) in [
            (693.912_3, 0.314_15, Some(["693.9", "0.3"])),
            (48_613.2, 137.0, Some(["48610", "140"])),
            (0.012_346, 0.000_678, Some(["0.01235", "0.00068"])),
            (0.1, 12.4, Some(["0", "12"])),
            (500.0, 0.0, None),
            (500.0, f64::NAN, None),
        ] {
            assert_eq!(rounded(value, error), texts.map(|texts| texts.map(str::to_owned)), "{value} {error}");
        }
    }

    #[test]
    fn numbers_are_short() {
        for (value, text) in [
            (0.0, "0"),
            (500.0, "500"),
            (0.25, "0.25"),
            (12.5, "12.5"),
            (7.9577, "7.96"),
            (31.83, "31.8"),
            (1234.0, "1234"),
            (1e9, "1e9"),
            (0.0333, "0.0333"),
            (f64::from(0.0333_f32), "0.0333"),
            (-2.0, "-2"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(short_number(value), text);
        }
    }
}
