//! What a sheet says, in its reader's language.

use crate::{bound::Verdict, number::Numbers};
use serde::Deserialize;
use std::collections::BTreeMap;

/// A language that sheets are to be had in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Language {
    /// English.
    #[default]
    English,
    /// German.
    German,
    /// French.
    French,
    /// Spanish.
    Spanish,
}

/// All words of a language. Names between braces are filled in.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Words {
    pub(crate) decimal_comma: bool,
    pub(crate) met: String,
    pub(crate) within_error: String,
    pub(crate) not_met: String,
    pub(crate) not_measured: String,
    pub(crate) all_met: String,
    pub(crate) some_not_met: String,
    pub(crate) some_within_error: String,
    pub(crate) of: String,
    pub(crate) verdict: String,
    pub(crate) area: String,
    pub(crate) quantity: String,
    pub(crate) required: String,
    pub(crate) reached: String,
    pub(crate) sheet: String,
    pub(crate) project: String,
    pub(crate) place: String,
    pub(crate) author: String,
    pub(crate) date: String,
    pub(crate) program: String,
    pub(crate) requirements: String,
    pub(crate) plans: String,
    pub(crate) least_point: String,
    pub(crate) blocks: String,
    pub(crate) for_lines: String,
    pub(crate) reading: String,
    pub(crate) explained: Vec<String>,
    pub(crate) files: String,
    pub(crate) file: String,
    pub(crate) no_certificate: String,
    pub(crate) maintained: String,
    pub(crate) least_is_low: String,
    pub(crate) greatest_is_high: String,
    pub(crate) no_error: String,
    pub(crate) calculated: String,
    pub(crate) errors_added: String,
    pub(crate) ratio_of_means: String,
    pub(crate) left_out: String,
    pub(crate) covered: String,
    pub(crate) missing_points: String,
    pub(crate) share_target: String,
    pub(crate) interval: String,
    pub(crate) more_samples: String,
    pub(crate) never_settled: String,
    pub(crate) no_area: String,
    pub(crate) no_quantity: String,
    pub(crate) did_you_mean: String,
    pub(crate) no_number: String,
    /// Quantities by the names that files have for them; others stand as they are.
    pub(crate) quantities: BTreeMap<String, String>,
}

impl Language {
    /// All of them, with the codes that name them (ISO 639-1).
    pub const CODES: [(&'static str, Self); 4] = [("en", Self::English), ("de", Self::German), ("fr", Self::French), ("es", Self::Spanish)];

    /// The language's code.
    pub fn code(self) -> &'static str {
        Self::CODES.iter().find(|(_, language)| *language == self).map_or("en", |(code, _)| code)
    }

    /// Its words, and how it writes numbers.
    pub(crate) fn words(self) -> (Words, Numbers) {
        // A test reads all of them.
        let words: Words = toml::from_str(self.text()).unwrap_or_default();
        let numbers = Numbers { comma: words.decimal_comma };
        (words, numbers)
    }

    /// The file of its words.
    pub(crate) fn text(self) -> &'static str {
        match self {
            Self::English => include_str!("../words/en.toml"),
            Self::German => include_str!("../words/de.toml"),
            Self::French => include_str!("../words/fr.toml"),
            Self::Spanish => include_str!("../words/es.toml"),
        }
    }
}

impl Words {
    pub(crate) fn of_verdict(&self, verdict: Verdict) -> &str {
        match verdict {
            Verdict::Met => &self.met,
            Verdict::WithinError => &self.within_error,
            Verdict::NotMet => &self.not_met,
            Verdict::NotMeasured => &self.not_measured,
        }
    }

    /// The verdict on all lines.
    pub(crate) fn of_all(&self, verdict: Verdict) -> &str {
        match verdict {
            Verdict::Met => &self.all_met,
            Verdict::WithinError => &self.some_within_error,
            _ => &self.some_not_met,
        }
    }

    /// A quantity, with what it is of.
    pub(crate) fn of_quantity(&self, quantity: &str, of: Option<&str>) -> String {
        let known = |name: &str| self.quantities.get(&name.replace('-', "_").to_lowercase()).map_or(name, String::as_str).to_owned();
        match of {
            Some(of) => fill(&self.of, &[("quantity", &known(quantity)), ("of", &known(of))]),
            None => known(quantity),
        }
    }
}

/// A text with what stands between braces filled in.
pub(crate) fn fill(template: &str, values: &[(&str, &str)]) -> String {
    let mut text = String::new();
    let mut rest = template;
    while let Some((before, name, after)) = rest.split_once('{').and_then(|(before, tail)| {
        let (name, after) = tail.split_once('}')?;
        Some((before, name, after))
    }) {
        text.push_str(before);
        text.push_str(values.iter().find(|(known, _)| *known == name).map_or("", |(_, value)| value));
        rest = after;
    }
    text.push_str(rest);
    text
}
