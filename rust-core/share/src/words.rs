//! What a page says, in its reader's language.

use std::collections::BTreeMap;

/// A language that pages are to be had in.
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

impl Language {
    /// All of them, with the codes that name them (ISO 639-1).
    pub const CODES: [(&'static str, Self); 4] = [("en", Self::English), ("de", Self::German), ("fr", Self::French), ("es", Self::Spanish)];

    /// The language's code.
    pub fn code(self) -> &'static str {
        Self::CODES.iter().find(|(_, language)| *language == self).map_or("en", |(code, _)| code)
    }

    /// Its words by their keys.
    pub(super) fn words(self) -> BTreeMap<String, String> {
        let text = match self {
            Self::English => include_str!("../web/words/en.json"),
            Self::German => include_str!("../web/words/de.json"),
            Self::French => include_str!("../web/words/fr.json"),
            Self::Spanish => include_str!("../web/words/es.json"),
        };
        // A test reads all of them.
        serde_json::from_str(text).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_languages_have_the_same_words() {
        let keys = |language: Language| language.words().into_keys().collect::<Vec<_>>();
        let english = keys(Language::English);
        assert!(english.len() > 20);
        for (code, language) in Language::CODES {
            assert_eq!(keys(language), english, "{code}");
            assert_eq!(language.code(), code);
        }
    }

    #[test]
    fn placeholders_are_those_of_english() {
        let holes = |text: &str| {
            let mut found: Vec<String> = text.split('{').skip(1).filter_map(|rest| Some(rest.split_once('}')?.0.to_owned())).collect();
            found.sort();
            found
        };
        let english = Language::English.words();
        for (code, language) in Language::CODES {
            for (key, text) in language.words() {
                assert_eq!(holes(&text), holes(&english[&key]), "{key} in {code}");
            }
        }
    }
}
