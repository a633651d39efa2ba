//! Words of a language: TOML whose texts have places to fill.

use serde::de::DeserializeOwned;
use toml::Value;

/// The words of a language's file, which a test has read before.
pub fn read<T: DeserializeOwned + Default>(text: &str) -> T {
    toml::from_str(text).unwrap_or_default()
}

/// A text with what stands between braces filled in.
pub fn fill(template: &str, values: &[(&str, &str)]) -> String {
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

/// For tests: in what the words of one language differ from those of another: keys, lengths of lists, places to fill, and empty texts.
pub fn differences(first: &str, other: &str) -> Vec<String> {
    let read = |text: &str| text.parse::<toml::Table>().map(Value::Table);
    match (read(first), read(other)) {
        (Ok(first), Ok(other)) => compared("", Some(&first), Some(&other)),
        (first, other) => [first.err(), other.err()].into_iter().flatten().map(|error| error.to_string()).collect(),
    }
}

fn compared(place: &str, first: Option<&Value>, other: Option<&Value>) -> Vec<String> {
    match (first, other) {
        (Some(Value::Table(first)), Some(Value::Table(other))) => {
            let mut keys: Vec<&String> = first.keys().chain(other.keys()).collect();
            keys.sort_unstable();
            keys.dedup();
            keys.into_iter().flat_map(|key| compared(&format!("{place}.{key}"), first.get(key), other.get(key))).collect()
        }
        (Some(Value::Array(first)), Some(Value::Array(other))) => {
            (0..first.len().max(other.len())).flat_map(|k| compared(&format!("{place}.{k}"), first.get(k), other.get(k))).collect()
        }
        (Some(Value::String(first)), Some(Value::String(other)))
            if holes(first) == holes(other) && first.is_empty() == other.is_empty() =>
        {
            Vec::new()
        }
        _ => vec![place.to_owned()],
    }
}

fn holes(text: &str) -> Vec<&str> {
    let mut found: Vec<&str> = text.split('{').skip(1).filter_map(|rest| Some(rest.split_once('}')?.0)).collect();
    found.sort_unstable();
    found.dedup();
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn braces_are_filled() {
        assert_eq!(fill("a {x} b {y}{x} {", &[("x", "1"), ("y", "{x}")]), "a 1 b {x}1 {");
    }

    #[test]
    fn differences_are_named() {
        assert_eq!(differences("a = \"{x} 1\"\n[b]\nc = [\"1\"]", "a = \"2 {x}\"\n[b]\nc = [\"2\"]"), Vec::<String>::new());
        assert_eq!(differences("a = \"{x}\"\nb = \"\"", "a = \"{y}\"\nc = \"\""), [".a", ".b", ".c"]);
    }
}
