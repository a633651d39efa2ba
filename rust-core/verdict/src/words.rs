//! What a sheet says, in its reader's language.

use crate::bound::Verdict;
use gonio_page::{Language, Numbers, fill, read};
use serde::Deserialize;
use std::collections::BTreeMap;

/// All words of a language. Names between braces are filled in.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Words {
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
    #[serde(skip)]
    pub(crate) quantities: BTreeMap<String, String>,
}

/// The words of a language, and how it writes numbers.
pub(crate) fn words(language: Language) -> (Words, Numbers) {
    let words: Words = read(text(language));
    (Words { quantities: language.quantities(), ..words }, language.numbers())
}

/// The file of its words.
pub(crate) fn text(language: Language) -> &'static str {
    match language {
        Language::English => include_str!("../words/en.toml"),
        Language::German => include_str!("../words/de.toml"),
        Language::French => include_str!("../words/fr.toml"),
        Language::Spanish => include_str!("../words/es.toml"),
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
