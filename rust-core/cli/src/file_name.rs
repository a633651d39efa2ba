//! Output names with a place for the frame number: `$F`, `$F4`, `####`, `###.###`.

use std::path::{Path, PathBuf};

/// Whether a name has a place for the frame.
pub(super) fn has_frame(path: &Path) -> bool {
    let text = path.to_string_lossy();
    text.contains('#') || text.contains("$F")
}

/// The name for a frame.
pub(super) fn for_frame(path: &Path, frame: f64) -> PathBuf {
    let text = path.to_string_lossy();
    PathBuf::from(hashes(&dollars(&text, frame), frame))
}

fn dollars(text: &str, frame: f64) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once("$F") {
        out.push_str(before);
        let digits = after.len() - after.trim_start_matches(|c: char| c.is_ascii_digit()).len();
        let width = after[..digits].parse().unwrap_or(1);
        out.push_str(&number(frame, width, 0));
        rest = &after[digits..];
    }
    out + rest
}

fn hashes(text: &str, frame: f64) -> String {
    let Some(first) = text.find('#') else { return text.to_owned() };
    let run = |at: usize| text[at..].bytes().take_while(|b| *b == b'#').count();
    let whole = run(first);
    let point = first + whole;
    let decimals = if text[point..].starts_with(".#") { run(point + 1) } else { 0 };
    let end = point + if decimals > 0 { decimals + 1 } else { 0 };
    format!("{}{}{}", &text[..first], number(frame, whole, decimals), &text[end..])
}

/// A frame padded with zeros to `width` digits before the point.
fn number(frame: f64, width: usize, decimals: usize) -> String {
    // A fraction is shown even where no place was left for it, so that two frames never share a file.
    let decimals = if decimals == 0 && frame.fract() != 0.0 { 3 } else { decimals };
    let width = width.min(32) + if decimals > 0 { decimals + 1 } else { 0 };
    let sign = if frame < 0.0 { "-" } else { "" };
    format!("{sign}{:0width$.decimals$}", frame.abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_take_their_places() {
        let name = |text: &str, frame| for_frame(Path::new(text), frame).to_string_lossy().into_owned();
        assert_eq!(name("a.####.exr", 12.0), "a.0012.exr");
        assert_eq!(name("a.$F4.exr", 12.0), "a.0012.exr");
        assert_eq!(name("a.$F.exr", 7.0), "a.7.exr");
        assert_eq!(name("a.###.###.exr", 1.5), "a.001.500.exr");
        assert_eq!(name("a.##.exr", -3.0), "a.-03.exr");
        assert_eq!(name("a.####.exr", 1.25), "a.0001.250.exr");
        assert!(has_frame(Path::new("x$F4.exr")) && !has_frame(Path::new("x.exr")));
    }
}
