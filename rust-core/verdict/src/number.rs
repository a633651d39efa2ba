//! Numbers as a planner reads them, in the form of a language.

use crate::estimate::Estimate;
use gonio_formats::{rounded, short_number};

/// The most decimals that tell a figure from its limit.
const DECIMALS: usize = 6;

/// How a language writes numbers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Numbers {
    /// Whether a comma parts the decimals.
    pub(crate) comma: bool,
}

impl Numbers {
    /// A number's text in this form.
    pub(crate) fn form(self, text: &str) -> String {
        if self.comma { text.replace('.', ",") } else { text.to_owned() }
    }

    /// A figure with its error and unit; one without an error has digits enough to be told from the limit beside it.
    pub(crate) fn figure(self, figure: Estimate, limit: f64, unit: &str) -> String {
        let text = match figure.error.and_then(|error| rounded(figure.value, error)) {
            Some([value, error]) => format!("{value} ± {error}"),
            None => apart(figure.value, limit),
        };
        with_unit(&self.form(&text), unit)
    }

    /// The end of an interval, as finely as its figure's error.
    pub(crate) fn end(self, value: f64, error: f64) -> String {
        self.form(&rounded(value, error).map_or_else(|| short_number(value), |[value, _]| value))
    }

    /// A limit as it was written.
    pub(crate) fn limit(self, value: f64, unit: &str) -> String {
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
