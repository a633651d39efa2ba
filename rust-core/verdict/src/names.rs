//! Names that people write, and those that were meant.

/// Letters that a wrong name may share with a known one to be taken for a slip, of 1.
const ALIKE: f64 = 0.66;
/// Names that a message lists.
const MOST: usize = 12;
/// Letters of a name that a message quotes.
const LETTERS: usize = 60;

/// The known name that is most like another, where one is like it.
pub(crate) fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let small = last(name).to_lowercase();
    let alike = |other: &str| {
        let other = last(other).to_lowercase();
        // Letters that changed places count little in one, missing ones in the other.
        strsim::normalized_damerau_levenshtein(&small, &other).max(strsim::jaro_winkler(&small, &other))
    };
    let rated = known.into_iter().map(|other| (alike(other), other));
    rated.filter(|(rate, _)| *rate >= ALIKE).max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, other)| other)
}

/// Names for a message, each once, and how many more there are.
pub(crate) fn listed<'a>(names: impl IntoIterator<Item = &'a str>) -> String {
    let mut each: Vec<&str> = Vec::new();
    names.into_iter().for_each(|name| {
        if !each.contains(&name) {
            each.push(name);
        }
    });
    let rest = each.len().saturating_sub(MOST);
    let more = if rest > 0 { format!("; … (+{rest})") } else { String::new() };
    each.iter().take(MOST).map(|name| shown(name)).collect::<Vec<_>>().join("; ") + &more
}

/// A name as messages quote it.
pub(crate) fn shown(name: &str) -> String {
    let short: String = name.chars().take(LETTERS).collect();
    if short.len() < name.len() { short + "…" } else { short }
}

/// The last part of a path.
fn last(name: &str) -> &str {
    name.rsplit_once('/').map_or(name, |(_, last)| last)
}

/// The fit of a name whose capitals are others.
pub(crate) const OTHER_CAPITALS: u8 = 2;

/// How well a written name fits a known one, best first: 0 the same, 1 the end of its path, 2 either but for capitals; `None` not at all.
pub(crate) fn fit(written: &str, known: &str) -> Option<u8> {
    let ends = |written: &str, known: &str| {
        let rest = known.strip_suffix(written.trim_start_matches('/'));
        !written.is_empty() && rest.is_some_and(|rest| rest.is_empty() || rest.ends_with('/'))
    };
    if written == known {
        Some(0)
    } else if ends(written, known) {
        Some(1)
    } else if ends(&written.to_lowercase(), &known.to_lowercase()) {
        Some(OTHER_CAPITALS)
    } else {
        None
    }
}

/// A quantity as files spell it.
pub(crate) fn spelt(name: &str) -> String {
    name.trim().replace('-', "_").to_lowercase()
}
