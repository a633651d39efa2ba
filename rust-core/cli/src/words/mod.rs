//! What reports and plots say, in their reader's language: a file of `rust-core/cli/words` for each.

mod light;
mod report;
mod year;

use gonio_page::{Language, Numbers, read};
pub(crate) use light::{FileWords, GlareWords, LightsWords, RatingWords, UgrWords};
pub(crate) use report::{ColourWords, GridsWords, HeadWords, LuminairesWords, NotesWords, PageWords, PicturesWords, PowerWords};
use serde::Deserialize;
use std::sync::LazyLock;
pub(crate) use year::YearWords;

/// All words of a language, and how it writes numbers. Names between braces are filled in.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Words {
    #[serde(skip)]
    pub(crate) language: Language,
    #[serde(skip)]
    pub(crate) numbers: Numbers,
    pub(crate) not_measured: String,
    pub(crate) head: HeadWords,
    pub(crate) page: PageWords,
    pub(crate) luminaires: LuminairesWords,
    pub(crate) power: PowerWords,
    pub(crate) pictures: PicturesWords,
    pub(crate) grids: GridsWords,
    pub(crate) colour: ColourWords,
    pub(crate) notes: NotesWords,
    pub(crate) lights: LightsWords,
    pub(crate) file: FileWords,
    pub(crate) ugr: UgrWords,
    pub(crate) glare: GlareWords,
    pub(crate) rating: RatingWords,
    pub(crate) year: YearWords,
}

impl Words {
    /// Those of a language.
    pub(crate) fn new(language: Language) -> Self {
        let words: Self = read(text(language));
        Self { language, numbers: language.numbers(), ..words }
    }

    /// Those of what has no language of its own.
    pub(crate) fn english() -> &'static Self {
        static ENGLISH: LazyLock<Words> = LazyLock::new(|| Words::new(Language::English));
        &ENGLISH
    }

    /// A place or a direction: three numbers, parted by what a number does not hold itself.
    pub(crate) fn place(&self, place: [f64; 3]) -> String {
        place.map(|number| self.numbers.fixed(number, 2)).join(if self.numbers.comma { "; " } else { ", " })
    }

    /// A value with its standard error and unit.
    pub(crate) fn figure(&self, value: f64, standard_error: f64, unit: &str) -> String {
        if value.is_nan() { self.not_measured.clone() } else { self.numbers.figure(value, Some(standard_error), unit) }
    }
}

fn text(language: Language) -> &'static str {
    match language {
        Language::English => include_str!("../../words/en.toml"),
        Language::German => include_str!("../../words/de.toml"),
        Language::French => include_str!("../../words/fr.toml"),
        Language::Spanish => include_str!("../../words/es.toml"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio_page::differences;

    #[test]
    fn all_languages_have_the_words_of_english() {
        for (code, language) in Language::CODES {
            assert_eq!(differences(text(Language::English), text(language)), Vec::<String>::new(), "{code}");
            // What cannot be read would be empty.
            assert!(!Words::new(language).head.place.is_empty(), "{code}");
        }
    }
}
