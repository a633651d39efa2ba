//! A function or closure on lanes that is not inlined loses its level's instructions without a warning; this test reads the sources for such.

use std::path::{Path, PathBuf};

const BOUNDS: [&str; 2] = ["L: Lanes", "S: Simd"];

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    for path in entries.filter_map(|entry| entry.ok().map(|entry| entry.path())) {
        if path.is_dir() && !path.ends_with("target") {
            sources(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

/// The text up to the brace or semicolon that ends a signature, and what stands behind it; no body means a declaration.
fn split_signature(text: &str) -> (&str, Option<&str>) {
    let mut depth = 0;
    for (at, byte) in text.bytes().enumerate() {
        match byte {
            b'(' | b'[' => depth += 1,
            b')' | b']' => depth -= 1,
            b'{' if depth == 0 => return (&text[..at], Some(&text[at + 1..])),
            b';' if depth == 0 => return (&text[..at], None),
            _ => {}
        }
    }
    (text, None)
}

/// Whether the attributes and comments right above a line, or the line itself, ask for inlining.
fn is_inlined(lines: &[&str], at: usize) -> bool {
    let above = lines[..at].iter().rev().take_while(|line| !(line.trim().is_empty() || line.ends_with(['{', '}', ';'])));
    above.chain([&lines[at]]).any(|line| line.contains("#[inline(always)]"))
}

/// Whether a line opens a function: `fn` as a word, outside comments and strings.
fn opens_function(line: &str) -> bool {
    let code = line.trim_start();
    let mut words = code.split_whitespace().take_while(|word| !word.starts_with("//"));
    let prefixes = ["pub", "pub(crate)", "pub(super)", "const", "unsafe", "#[inline(always)]"];
    words.find(|word| !prefixes.contains(word)) == Some("fn")
}

/// Lines (from 1) and signatures of the functions on lanes that are not inlined.
fn offenders(text: &str) -> Vec<(usize, String)> {
    let lines: Vec<&str> = text.lines().collect();
    let starts = lines.iter().scan(0, |at, line| Some(std::mem::replace(at, *at + line.len() + 1)));
    let starts: Vec<usize> = starts.collect();
    let mut implementation_of_lanes = false;
    let mut found = Vec::new();
    for (at, line) in lines.iter().enumerate() {
        if line.starts_with("impl") {
            implementation_of_lanes = BOUNDS.iter().any(|bound| line.contains(bound)) && !line.contains("Debug for");
        } else if *line == "}" {
            implementation_of_lanes = false;
        }
        if !opens_function(line) {
            continue;
        }
        let (signature, body) = split_signature(&text[starts[at]..]);
        let on_lanes = implementation_of_lanes || BOUNDS.iter().any(|bound| signature.contains(bound));
        // The token may have any name: in macros it is an argument.
        let enters =
            |body: &str| body.trim_start().split_once(".vectorize(").is_some_and(|(token, _)| !token.contains(char::is_whitespace));
        let enters_level = body.is_some_and(enters);
        if on_lanes && body.is_some() && !enters_level && !is_inlined(&lines, at) {
            found.push((at + 1, signature.trim().to_owned()));
        }
    }
    found
}

/// Whether a line has a closure that takes lanes; bind a function instead, which can ask to be inlined.
fn opens_closure_on_lanes(line: &str) -> bool {
    let Some((_, behind)) = line.split_once("= |") else { return false };
    behind.split_once('|').is_some_and(|(parameters, _)| parameters.contains("<L>") || parameters.contains("<S>"))
}

#[test]
fn no_closure_takes_lanes() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut files = Vec::new();
    sources(&root, &mut files);
    let mut report = String::new();
    for file in files.iter().filter(|file| !file.components().any(|part| part.as_os_str() == "tests")) {
        let Ok(text) = std::fs::read_to_string(file) else { continue };
        for (at, line) in text.lines().enumerate().filter(|(_, line)| opens_closure_on_lanes(line)) {
            report += &format!("{}:{}: {}\n", file.strip_prefix(&root).unwrap_or(file).display(), at + 1, line.trim());
        }
    }
    assert!(report.is_empty(), "closures on lanes, which may stay calls:\n{report}");
    assert!(
        opens_closure_on_lanes("    let part = |centre: F<L>, half: F<L>| {") && !opens_closure_on_lanes("    let at = |i: usize| x[i];")
    );
}

#[test]
fn every_function_on_lanes_is_inlined() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut files = Vec::new();
    sources(&root, &mut files);
    assert!(files.len() > 10, "the sources were not found");
    let mut report = String::new();
    for file in files {
        let Ok(text) = std::fs::read_to_string(&file) else { continue };
        for (line, signature) in offenders(&text) {
            report += &format!("{}:{line}: {signature}\n", file.strip_prefix(&root).unwrap_or(&file).display());
        }
    }
    assert!(report.is_empty(), "functions on lanes without #[inline(always)]:\n{report}");
}

#[test]
fn the_reader_finds_what_it_looks_for() {
    let bad = "pub fn bad<L: Lanes>(l: L, x: [f32; 3]) {\n    work()\n}\n";
    assert_eq!(offenders(bad).len(), 1);
    let method = "impl<L: Lanes> Lobe<L> {\n    /// Text.\n    fn eval(self) -> F<L> {\n    }\n}\nfn free() {}\n";
    assert_eq!(offenders(method), [(3, "fn eval(self) -> F<L>".to_owned())]);
    let several_lines = "fn bad<\n    T: Copy,\n    L: Lanes,\n>(\n    l: L,\n) {\n}\n";
    assert_eq!(offenders(several_lines).len(), 1);
    let good = [
        "#[inline(always)]\n#[allow(dead_code)]\nfn good<L: Lanes>(l: L) {\n}\n",
        "    fn declared<L: Lanes>(l: L, x: [f32; 3]) -> F<L>;\n",
        "fn entry<L: Lanes>(l: L) {\n    l.vectorize(|| work(l))\n}\n",
        "/// fn in_a_comment<L: Lanes>(l: L) {\n",
        "fn scalar(x: f32) {\n}\n",
    ];
    for text in good {
        assert_eq!(offenders(text), [], "{text}");
    }
}
