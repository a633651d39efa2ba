//! Circles of files of a crate that import each other.

use std::{
    collections::{BTreeMap, BTreeSet},
    fs,
    path::Path,
};

type Module = Vec<String>;

/// The modules of a crate, with the text of each but comments and tests.
fn modules(source: &Path) -> BTreeMap<Module, String> {
    let mut files = Vec::new();
    super::sources(source, "rs", &mut files);
    let mut all = BTreeMap::new();
    for file in files {
        let inside = file.strip_prefix(source).expect("a file of the folder").with_extension("");
        let mut module: Module = inside.iter().map(|part| part.to_string_lossy().into_owned()).collect();
        if module.iter().any(|part| part == "tests") {
            continue;
        }
        if module.last().is_some_and(|last| last == "mod" || last == "lib") {
            module.pop();
        }
        let text = fs::read_to_string(&file).expect("a readable source");
        let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
        all.insert(module, code.lines().map(without_aside).collect::<Vec<_>>().join("\n"));
    }
    all
}

/// A line without comment, and without the modules that see what it declares.
fn without_aside(line: &str) -> String {
    let mut pieces = line.split("//").next().unwrap_or_default().split("pub(in ");
    let first = pieces.next().unwrap_or_default().to_owned();
    pieces.fold(first, |code, piece| code + "pub" + piece.split_once(')').map_or(piece, |(_, rest)| rest))
}

/// The paths that a tree of imports names.
fn leaves(prefix: &str, tree: &str, found: &mut Vec<String>) {
    let (mut depth, mut start) = (0, 0);
    for (at, byte) in tree.bytes().chain([b',']).enumerate() {
        match byte {
            b'{' => depth += 1,
            b'}' => depth -= 1,
            b',' if depth == 0 => {
                let item = tree[start..at].trim();
                start = at + 1;
                match item.split_once('{') {
                    Some((head, rest)) => leaves(&format!("{prefix}{head}"), rest.trim_end().trim_end_matches('}'), found),
                    None if !item.is_empty() => found.push(format!("{prefix}{item}")),
                    None => {}
                }
            }
            _ => {}
        }
    }
}

/// A path as seen from the crate's root, if it is one of this crate.
fn absolute(module: &Module, path: &str, all: &BTreeMap<Module, String>) -> Option<Module> {
    let mut parts: Vec<String> = path.split("::").map(|part| part.trim().split(" as ").next().unwrap_or_default().to_owned()).collect();
    let mut base = module.clone();
    match parts[0].as_str() {
        "crate" => base.clear(),
        "self" => {}
        "super" => {
            while parts.first().is_some_and(|part| part == "super") {
                base.pop();
                parts.remove(0);
            }
            base.extend(parts);
            return Some(base);
        }
        first => {
            let child: Module = module.iter().cloned().chain([first.to_owned()]).collect();
            all.contains_key(&child).then_some(())?;
            base.extend(parts);
            return Some(base);
        }
    }
    base.extend(parts.drain(1..));
    Some(base)
}

/// What each file imports, and what it hands on under names of its own.
fn imports(all: &BTreeMap<Module, String>) -> (BTreeMap<Module, Vec<Module>>, BTreeMap<Module, Module>) {
    let (mut uses, mut handed_on) = (BTreeMap::new(), BTreeMap::new());
    for (module, code) in all {
        let own: &mut Vec<Module> = uses.entry(module.clone()).or_default();
        for statement in code.split(';') {
            let Some(at) = statement.rfind("use ").filter(|at| statement[..*at].ends_with(['\n', ' ', '\t']) || *at == 0) else { continue };
            let is_handed_on = statement[..at].trim_end().lines().last().is_some_and(|line| line.trim().starts_with("pub"));
            let mut paths = Vec::new();
            leaves("", &statement[at + 4..], &mut paths);
            for path in paths {
                let Some(target) = absolute(module, &path, all) else { continue };
                match target.last().cloned().filter(|_| is_handed_on) {
                    Some(name) => {
                        handed_on.insert(module.iter().cloned().chain([name]).collect(), target);
                    }
                    None => own.push(target),
                }
            }
        }
        own.extend(named(code).filter_map(|path| absolute(module, path, all)));
    }
    (uses, handed_on)
}

/// Paths of two parts or more that code names outside of its imports.
fn named(code: &str) -> impl Iterator<Item = &str> {
    let bodies =
        code.split(';').filter(|statement| !statement.lines().any(|line| IMPORTS.iter().any(|word| line.trim().starts_with(word))));
    let tokens = bodies.flat_map(|statement| statement.split(|c: char| !c.is_alphanumeric() && c != '_' && c != ':'));
    tokens.map(|token| token.trim_end_matches(':')).filter(|token| token.contains("::") && !token.starts_with(':'))
}

/// How lines begin that import.
const IMPORTS: [&str; 4] = ["use ", "pub use ", "pub(crate) use ", "pub(super) use "];

/// The file that a path leads to.
fn file_of(path: &Module, all: &BTreeMap<Module, String>, handed_on: &BTreeMap<Module, Module>, left: u32) -> Module {
    for end in (0..=path.len()).rev() {
        if all.contains_key(&path[..end]) {
            return match path.get(end).and_then(|name| handed_on.get(&[&path[..end], std::slice::from_ref(name)].concat())) {
                Some(target) if left > 0 => file_of(&[target, &path[end + 1..]].concat(), all, handed_on, left - 1),
                _ => path[..end].to_vec(),
            };
        }
    }
    Module::new()
}

/// The circles of a crate's files, the crate's root left out.
pub(super) fn of(source: &Path) -> Vec<Vec<String>> {
    let all = modules(source);
    let (uses, handed_on) = imports(&all);
    let arrows: BTreeMap<&Module, BTreeSet<Module>> = uses
        .iter()
        .map(|(module, paths)| {
            let targets = paths.iter().map(|path| file_of(path, &all, &handed_on, 6));
            (module, targets.filter(|target| target != module && !target.is_empty()).collect())
        })
        .collect();
    let reached: BTreeMap<&Module, BTreeSet<Module>> = arrows.keys().map(|module| (*module, reach(module, &arrows))).collect();
    let mut found: Vec<Vec<String>> = Vec::new();
    for (module, targets) in &reached {
        if targets.contains(*module) {
            let circle = targets.iter().filter(|other| reached.get(*other).is_some_and(|back| back.contains(*module)));
            found.push(circle.map(|other| other.join("/")).collect());
        }
    }
    found.sort();
    found.dedup();
    found
}

/// All files that a file's imports lead to.
fn reach(module: &Module, arrows: &BTreeMap<&Module, BTreeSet<Module>>) -> BTreeSet<Module> {
    let mut reached = BTreeSet::new();
    let mut waiting = vec![module.clone()];
    while let Some(next) = waiting.pop() {
        for target in arrows.get(&next).into_iter().flatten() {
            if reached.insert(target.clone()) {
                waiting.push(target.clone());
            }
        }
    }
    reached
}

#[test]
fn a_circle_is_found() {
    let folder = std::env::temp_dir().join(format!("gonio-circles-{}", std::process::id()));
    fs::create_dir_all(&folder).expect("a folder");
    for (name, text) in [
        ("lib", "mod a;\nmod b;\nmod c;\npub use c::C;\n"),
        ("a", "use super::b::{B};\n"),
        ("b", "use crate::C;\n"),
        ("c", "use super::a::A;\n"),
    ] {
        fs::write(folder.join(name).with_extension("rs"), text).expect("a file");
    }
    let circles = of(&folder);
    fs::remove_dir_all(&folder).expect("a folder to remove");
    assert_eq!(circles, [["a", "b", "c"]]);
}
