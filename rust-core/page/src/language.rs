//! The languages of pages.

use crate::{number::Numbers, words::read};
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

    /// The language of a code; English where it is none of [`Self::CODES`].
    pub fn of_code(code: &str) -> Self {
        Self::CODES.iter().find(|(known, _)| *known == code).map_or(Self::English, |(_, language)| *language)
    }

    /// How it writes numbers.
    pub fn numbers(self) -> Numbers {
        Numbers { comma: self != Self::English }
    }

    /// Names of quantities, by those that files have for them.
    pub fn quantities(self) -> BTreeMap<String, String> {
        read(self.text())
    }

    /// The name of a quantity; its own where the language has none for it.
    pub fn quantity(self, name: &str) -> String {
        self.quantities().remove(&name.replace('-', "_").to_lowercase()).unwrap_or_else(|| name.to_owned())
    }

    fn text(self) -> &'static str {
        match self {
            Self::English => include_str!("../words/en.toml"),
            Self::German => include_str!("../words/de.toml"),
            Self::French => include_str!("../words/fr.toml"),
            Self::Spanish => include_str!("../words/es.toml"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::differences;

    #[test]
    fn all_languages_have_the_quantities_of_english() {
        for (code, language) in Language::CODES {
            assert_eq!((language.code(), Language::of_code(code)), (code, language));
            assert_eq!(differences(Language::English.text(), language.text()), Vec::<String>::new(), "{code}");
            assert!(language.quantities().len() > 30, "{code}");
        }
        assert_eq!(Language::German.quantity("daylight-factor"), "Tageslichtquotient");
        assert_eq!(Language::German.quantity("of-my-own"), "of-my-own");
    }
}
