//! Names of files with a place for the frame number: `$F`, `$F4`, `####`, `###.###`, `%04d`, `{04frame}`.

use std::path::{Path, PathBuf};

/// Whether a name has a place for the frame.
pub fn has_frame(path: &Path) -> bool {
    for_frame(path, 0.0) != path
}

/// The name for a frame.
pub fn for_frame(path: &Path, frame: f64) -> PathBuf {
    let text = path.to_string_lossy();
    let named = PLACES.iter().fold(text.into_owned(), |text, (start, end)| filled(&text, start, end, frame));
    PathBuf::from(hashes(&named, frame))
}

/// What the places begin and end with, around their width: Houdini's `$F4` and `<F4>`, C's `%04d`, MaterialX's `{04frame}`. The longer go first.
const PLACES: [(&str, &str); 6] = [("$FF", ""), ("<FF", ">"), ("$F", ""), ("<F", ">"), ("%", "d"), ("{", "frame}")];

/// Where a place begins, and its width and length behind that.
fn place<'t>(text: &'t str, start: &str) -> Option<(usize, &'t str)> {
    text.find(start).map(|at| (at, &text[at + start.len()..]))
}

fn filled(text: &str, start: &str, end: &str, frame: f64) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some((at, after)) = place(rest, start) {
        let digits = after.len() - after.trim_start_matches(|c: char| c.is_ascii_digit()).len();
        if let Some(behind) = after[digits..].strip_prefix(end) {
            out.push_str(&rest[..at]);
            out.push_str(&number(frame, after[..digits].parse().unwrap_or(1), 0));
            rest = behind;
        } else {
            out.push_str(&rest[..at + start.len()]);
            rest = after;
        }
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
        assert_eq!(
            (name("a.<F4>.exr", 7.0), name("a.%04d.exr", 7.0), name("a.%d.exr", 7.0)),
            ("a.0007.exr".into(), "a.0007.exr".into(), "a.7.exr".into())
        );
        assert_eq!(
            (name("a.$FF.exr", 1.5), name("50%.exr", 7.0), name("a<Fold.exr", 7.0)),
            ("a.1.500.exr".into(), "50%.exr".into(), "a<Fold.exr".into())
        );
        assert!(!has_frame(Path::new("50%.exr")) && has_frame(Path::new("a.%04d.exr")));
        assert!(has_frame(Path::new("x$F4.exr")) && !has_frame(Path::new("x.exr")));
        assert_eq!((name("a.{frame}.png", 7.0), name("a.{04frame}.png", 7.0)), ("a.7.png".into(), "a.0007.png".into()));
    }
}
