//! What a page says, in its reader's language.

use gonio_page::Language;
use std::collections::BTreeMap;

/// A language's words by their keys.
pub(super) fn words(language: Language) -> BTreeMap<String, String> {
    let text = match language {
        Language::English => include_str!("../web/words/en.json"),
        Language::German => include_str!("../web/words/de.json"),
        Language::French => include_str!("../web/words/fr.json"),
        Language::Spanish => include_str!("../web/words/es.json"),
    };
    // A test reads all of them.
    serde_json::from_str(text).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_languages_have_the_same_words() {
        let keys = |language: Language| words(language).into_keys().collect::<Vec<_>>();
        let english = keys(Language::English);
        assert!(english.len() > 20);
        for (code, language) in Language::CODES {
            assert_eq!(keys(language), english, "{code}");
        }
    }

    #[test]
    fn placeholders_are_those_of_english() {
        let holes = |text: &str| {
            let mut found: Vec<String> = text.split('{').skip(1).filter_map(|rest| Some(rest.split_once('}')?.0.to_owned())).collect();
            found.sort();
            found
        };
        let english = words(Language::English);
        for (code, language) in Language::CODES {
            for (key, text) in words(language) {
                assert_eq!(holes(&text), holes(&english[&key]), "{key} in {code}");
            }
        }
    }
}
