//! Numbers as a planner reads them, in the form of a language.

use gonio_formats::{rounded, short_number};

/// The most decimals that tell a figure from its limit.
const DECIMALS: usize = 6;

/// How a language writes numbers.
#[derive(Clone, Copy, Debug, Default)]
pub struct Numbers {
    /// Whether a comma parts the decimals.
    pub comma: bool,
}

impl Numbers {
    /// A number's text in this form.
    pub fn form(self, text: &str) -> String {
        if self.comma { text.replace('.', ",") } else { text.to_owned() }
    }

    /// A number with three digits that count.
    pub fn short(self, value: f64) -> String {
        self.form(&short_number(value))
    }

    /// A number with so many decimals.
    pub fn fixed(self, value: f64, decimals: usize) -> String {
        self.form(&format!("{value:.decimals$}"))
    }

    /// A figure with its error and unit.
    pub fn figure(self, value: f64, error: Option<f64>, unit: &str) -> String {
        self.with_error(value, error, unit, &short_number)
    }

    /// The same; one without an error has digits enough to be told from a limit beside it.
    pub fn beside(self, value: f64, error: Option<f64>, limit: f64, unit: &str) -> String {
        self.with_error(value, error, unit, &|value| apart(value, limit))
    }

    fn with_error(self, value: f64, error: Option<f64>, unit: &str, without: &dyn Fn(f64) -> String) -> String {
        let text = match error.and_then(|error| rounded(value, error)) {
            Some([value, error]) => format!("{value} ± {error}"),
            None => without(value),
        };
        with_unit(&self.form(&text), unit)
    }

    /// The end of an interval, as finely as its figure's error.
    pub fn end(self, value: f64, error: f64) -> String {
        self.form(&rounded(value, error).map_or_else(|| short_number(value), |[value, _]| value))
    }

    /// A limit as it was written.
    pub fn limit(self, value: f64, unit: &str) -> String {
        with_unit(&self.form(&value.to_string()), unit)
    }
}

fn with_unit(text: &str, unit: &str) -> String {
    // A number does not part from its unit at a line's end.
    if unit.is_empty() { text.to_owned() } else { format!("{text}\u{a0}{unit}") }
}

fn apart(value: f64, limit: f64) -> String {
    let hides = |text: &str| text.parse() == Ok(limit) && (value - limit).abs() > 1e-9 * limit.abs();
    let short = short_number(value);
    let longer = || (0..=DECIMALS).map(|decimals| format!("{value:.decimals$}"));
    if hides(&short) { longer().find(|text| !hides(text)).unwrap_or(short) } else { short }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_end_where_their_errors_do() {
        let numbers = Numbers::default();
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
            assert_eq!(numbers.figure(value, Some(standard_error), "lx").replace('\u{a0}', " "), text);
        }
        assert_eq!(numbers.figure(18.64, Some(0.021), ""), "18.64 ± 0.02");
        assert_eq!(Numbers { comma: true }.figure(18.64, Some(0.021), "%"), "18,64 ± 0,02\u{a0}%");
        assert_eq!((Numbers { comma: true }.short(0.25), Numbers { comma: true }.fixed(2.0, 2)), ("0,25".into(), "2,00".into()));
    }
}
