//! What a reader should know beside a figure.

use crate::{estimate::Estimate, words::Words};
use gonio_page::{Numbers, fill};

/// A remark on a line of the sheet.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Note {
    /// The measured figure was multiplied with a maintenance factor.
    Maintained { factor: f64, measured: Estimate, unit: String },
    /// A least point is noisy by so much of its value, which moves it down.
    LeastIsLow(f64),
    /// A greatest point is noisy by so much of its value, which moves it up.
    GreatestIsHigh(f64),
    /// The file states no error of a figure that has noise.
    NoError,
    /// The figure was calculated without noise.
    Calculated,
    /// The points' errors were added up.
    ErrorsAdded,
    /// The modelling is the ratio of two grids' means.
    RatioOfMeans,
    /// A rating of glare leaves sources out, with this share of their light.
    LeftOut { count: u64, share: f64 },
    /// Luminaires behind glass or covers are not rated at so many points.
    Covered(usize),
    /// A share is that of points that reach this value.
    Target { value: f64, unit: String },
    /// What the command said of its figures, in its words.
    Told(String),
    /// So many points were not measured.
    Missing(usize),
    /// So many times the samples would settle it; infinite where the figure is on the limit.
    MoreSamples { times: f64, interval: [f64; 2], error: f64, unit: String },
    /// There is no such area.
    NoArea { place: String, written: String, nearest: Option<String>, known: String },
    /// The area has no such figure.
    NoQuantity { place: String, written: String, nearest: Option<String>, known: String },
    /// The file has no number for it.
    NoNumber,
}

/// Times as many samples beyond which nobody waits.
const FAR: f64 = 10_000.0;

impl Note {
    /// In a language's words.
    pub(crate) fn told(&self, words: &Words, numbers: Numbers) -> String {
        let of_share = |share: f64| numbers.short(100.0 * share);
        let not_found = |template: &str, place: &str, written: &str, nearest: &Option<String>, known: &str| {
            let hint = nearest.as_ref().map_or(String::new(), |nearest| fill(&words.did_you_mean, &[("name", nearest)]));
            fill(template, &[("place", place), ("name", written), ("hint", &hint), ("known", known)])
        };
        match self {
            Self::Maintained { factor, measured, unit } => {
                let measured = numbers.figure(measured.value, measured.error, unit);
                fill(&words.maintained, &[("measured", &measured), ("factor", &numbers.form(&factor.to_string()))])
            }
            Self::LeastIsLow(share) => fill(&words.least_is_low, &[("percent", &of_share(*share))]),
            Self::GreatestIsHigh(share) => fill(&words.greatest_is_high, &[("percent", &of_share(*share))]),
            Self::NoError => words.no_error.clone(),
            Self::Calculated => words.calculated.clone(),
            Self::ErrorsAdded => words.errors_added.clone(),
            Self::RatioOfMeans => words.ratio_of_means.clone(),
            Self::LeftOut { count, share } => fill(&words.left_out, &[("count", &count.to_string()), ("percent", &of_share(*share))]),
            Self::Covered(count) => fill(&words.covered, &[("count", &count.to_string())]),
            Self::Target { value, unit } => {
                let value = numbers.form(&value.to_string());
                fill(&words.share_target, &[("value", &format!("{value} {unit}"))])
            }
            Self::Told(words) => words.clone(),
            Self::Missing(count) => fill(&words.missing_points, &[("count", &count.to_string())]),
            Self::MoreSamples { times, interval, error, unit } => {
                let told = if *times > FAR {
                    words.never_settled.clone()
                } else {
                    fill(&words.more_samples, &[("times", &numbers.form(&times_told(*times)))])
                };
                let unit = if unit.is_empty() { String::new() } else { format!("\u{a0}{unit}") };
                let [low, high] = interval.map(|end| numbers.end(end, *error));
                format!("{} {told}", fill(&words.interval, &[("low", &low), ("high", &high), ("unit", &unit)]))
            }
            Self::NoArea { place, written, nearest, known } => not_found(&words.no_area, place, written, nearest, known),
            Self::NoQuantity { place, written, nearest, known } => not_found(&words.no_quantity, place, written, nearest, known),
            Self::NoNumber => words.no_number.clone(),
        }
    }
}

/// Rounded up: fewer would not do.
fn times_told(times: f64) -> String {
    if times < 10.0 { format!("{:.1}", (10.0 * times).ceil() / 10.0) } else { format!("{:.0}", times.ceil()) }
}
