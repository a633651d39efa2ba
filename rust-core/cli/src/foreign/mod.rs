//! Command lines of usdrecord and husk, said anew in gonio's own words.

pub(crate) mod table;

#[cfg(test)]
mod page;
#[cfg(test)]
mod tests;

use gonio::{Error, Result};
use table::{Row, State, find};

/// Words for gonio, and what is to be said about those that went.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Translated {
    /// The command line.
    pub(super) words: Vec<String>,
    /// A line each.
    pub(super) notes: Vec<String>,
}

/// The words of `gonio render`, the program's name first; those of other commands stay as they are.
pub(super) fn translate(words: &[String]) -> Result<Translated> {
    let is_render = words.get(1).is_some_and(|word| word == "render");
    let kept = if is_render { 2 } else { words.len() };
    let mut out = Translated { words: words[..kept].to_vec(), notes: Vec::new() };
    let mut rest = words[kept..].iter().map(String::as_str).peekable();
    while let Some(word) = rest.next() {
        if word == "--" {
            out.words.push(word.to_owned());
            out.words.extend(rest.by_ref().map(str::to_owned));
            break;
        }
        let (name, attached) = parted(word);
        let Some(row) = find(name) else {
            out.words.push(word.to_owned());
            continue;
        };
        let mut values: Vec<&str> = attached.into_iter().collect();
        let is_flag = row.names[0] == "--verbose" && attached.is_none() && rest.peek().is_none_or(|next| level(next).is_none());
        let wanted = if is_flag { 0 } else { row.takes };
        while values.len() < wanted
            && let Some(value) = rest.next()
        {
            values.push(value);
        }
        if name == "-r" && is_number(values.first()) && is_number(rest.peek()) {
            values.extend(rest.next());
        }
        while row.names[0] == "--frame-list" && is_number(rest.peek()) {
            values.extend(rest.next());
        }
        out.take(row, name, &values, attached.is_some())?;
    }
    Ok(out)
}

/// An option's name, and a value that is attached: `--frames=1:3`, `-V2`.
fn parted(word: &str) -> (&str, Option<&str>) {
    if let Some(level) = word.strip_prefix("-V").filter(|text| level(text).is_some()) {
        return ("-V", Some(level));
    }
    match word.split_once('=') {
        Some((name, value)) if name.starts_with('-') && find(name).is_some_and(|row| row.takes > 0) => (name, Some(value)),
        _ => (word, None),
    }
}

fn is_number(word: Option<&&str>) -> bool {
    word.is_some_and(|word| word.parse::<f64>().is_ok())
}

/// husk's level of detail, a digit among letters: `2`, `a3`, `3a`.
fn level(text: &str) -> Option<u32> {
    let mut digits = text.chars().filter(char::is_ascii_digit);
    let level = digits.next()?.to_digit(10)?;
    (digits.next().is_none() && text.len() <= 4 && text.chars().all(|c| c.is_ascii_alphanumeric())).then_some(level)
}

impl Translated {
    /// Says an option in gonio's words.
    fn take(&mut self, row: &Row, name: &str, values: &[&str], is_attached: bool) -> Result<()> {
        let from = row.program.name();
        match (row.state, values) {
            // What begins with a dash is taken for a value where it is attached, and there alone.
            (State::Works(own), [value]) if value.starts_with('-') && is_attached => self.words.push(format!("{own}={value}")),
            (State::Works(own), _) => self.push(own, values),
            (State::Read(own), _) => self.read(row, own, name, values)?,
            (State::Idle, _) => self.notes.push(format!("{name} ({from}) changes nothing: {}", row.note)),
            (State::Refused, _) => return Err(refusal(name, from, row.note)),
        }
        Ok(())
    }

    fn push(&mut self, own: &str, values: &[&str]) {
        self.words.push(own.to_owned());
        self.words.extend(values.iter().map(|value| (*value).to_owned()));
    }

    /// Options whose values tell what they are.
    fn read(&mut self, row: &Row, own: &str, name: &str, values: &[&str]) -> Result<()> {
        let from = row.program.name();
        match (row.names[0], values) {
            ("-c", ["low" | "medium" | "high" | "veryhigh"]) => self.push("--complexity", values),
            ("-r", [_]) => self.notes.push(format!("-r (usdrecord) changes nothing: {}", row.note)),
            ("--frame-list", numbers) => self.push(own, &[numbers.join(",").as_str()]),
            ("--usd-input", [stage]) => self.words.push((*stage).to_owned()),
            ("--output", [files]) if are_pictures(files) => files.split(',').for_each(|file| self.push(own, &[file])),
            ("--colorCorrectionMode", [mode]) => match *mode {
                "sRGB" => {}
                "disabled" => self.notes.push(format!("{name} ({from}): {}", row.note)),
                "openColorIO" => return Err(refusal(name, from, row.note)),
                other => {
                    return Err(Error::setting(
                        "colorCorrectionMode",
                        format!("'{other}' was found, expected disabled, sRGB or openColorIO"),
                    ));
                }
            },
            ("--verbose", [text]) => match level(text) {
                Some(0) => self.push("--quiet", &[]),
                Some(1 | 2) => {}
                _ => self.push(own, &[]),
            },
            _ => self.push(own, values),
        }
        Ok(())
    }
}

/// Whether this is a list of pictures' names, and not one name with a comma in it.
fn are_pictures(files: &str) -> bool {
    let is_picture = |file: &str| [".exr", ".png", ".jpg", ".jpeg"].iter().any(|ending| file.to_ascii_lowercase().ends_with(ending));
    files.split(',').all(is_picture)
}

fn refusal(name: &str, from: &str, note: &str) -> Error {
    Error::setting(name.trim_start_matches('-'), format!("{name} of {from} is not supported: {note}"))
}
