//! A look at a text layer before `pxr` parses it: its parser descends by recursion and ends the process on very deep brackets.

use std::io::{BufRead, BufReader, Read};
use std::path::Path;

/// Deepest brackets that are handed on.
const MAX_DEPTH: usize = 2000;

/// The line of a bracket that is nested too deep, in a text layer; `None` for sound ones, other formats and files that cannot be read.
pub(crate) fn too_deep_at(path: &Path) -> Option<u64> {
    let mut reader = BufReader::with_capacity(1 << 16, std::fs::File::open(path).ok()?);
    let mut magic = [0; 5];
    reader.read_exact(&mut magic).ok()?;
    if &magic != b"#usda" {
        return None;
    }
    let mut scan = Scan::default();
    loop {
        let block = reader.fill_buf().ok()?;
        if block.is_empty() {
            return None;
        }
        if block.iter().any(|&byte| scan.is_too_deep(byte)) {
            return Some(scan.line + 1);
        }
        let length = block.len();
        reader.consume(length);
    }
}

/// Brackets in strings count too where the string runs over lines: the limit is far beyond what sound files have.
#[derive(Default)]
struct Scan {
    line: u64,
    depth: usize,
    quote: Option<u8>,
}

impl Scan {
    fn is_too_deep(&mut self, byte: u8) -> bool {
        match (byte, self.quote) {
            (b'\n', _) => {
                self.line += 1;
                self.quote = None;
            }
            (b'"' | b'\'', None) => self.quote = Some(byte),
            (_, Some(quote)) if byte == quote => self.quote = None,
            (b'[' | b'(' | b'{', None) => self.depth += 1,
            (b']' | b')' | b'}', None) => self.depth = self.depth.saturating_sub(1),
            _ => {}
        }
        self.depth > MAX_DEPTH
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn depth_problem(text: &str) -> bool {
        let mut scan = Scan::default();
        text.bytes().any(|byte| scan.is_too_deep(byte))
    }

    #[test]
    fn only_deep_brackets_are_refused() {
        assert!(depth_problem(&"[".repeat(MAX_DEPTH + 1)));
        assert!(!depth_problem(&"[(1, 2)], ".repeat(MAX_DEPTH)));
        assert!(!depth_problem(&format!("string a = \"{}\"", "(".repeat(MAX_DEPTH * 2))));
    }
}
