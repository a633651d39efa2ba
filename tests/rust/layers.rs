//! The house's order: which module may import which, and what no source may hold.

mod circles;

use std::{
    fs,
    path::{Path, PathBuf},
};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("tests stand in the project's root").to_owned()
}

fn sources(folder: &Path, ending: &str, out: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        if path.is_dir() && !path.ends_with("target") {
            sources(&path, ending, out);
        } else if path.extension().is_some_and(|e| e == ending) {
            out.push(path);
        }
    }
}

/// Lines of the folder's sources that hold `needle`, with their places.
fn lines_with(folder: &str, needle: &str) -> Vec<String> {
    let mut files = Vec::new();
    sources(&root().join(folder), "rs", &mut files);
    let mut found = Vec::new();
    for file in files {
        let text = fs::read_to_string(&file).expect("a readable source");
        let hits = text.lines().enumerate().filter(|(_, line)| line.contains(needle));
        found.extend(hits.map(|(number, line)| format!("{}:{}: {}", file.display(), number + 1, line.trim())));
    }
    found
}

/// Crates of the engine from the ground up, and which others of gonio each may use.
const CRATES: [(&str, &[&str]); 24] = [
    ("simd", &[]),
    ("formats", &[]),
    ("spectrum", &["formats"]),
    ("volume", &[]),
    ("mesh", &[]),
    ("norms", &["formats"]),
    ("road", &["formats"]),
    ("sky", &[]),
    ("annual", &["formats", "simd", "sky"]),
    ("page", &["formats"]),
    ("share", &["page"]),
    ("dimming", &["spectrum"]),
    ("verdict", &["formats", "page"]),
    ("accel", &["simd"]),
    ("image", &["simd"]),
    ("table", &["simd"]),
    ("camera", &["simd"]),
    ("bsdf", &["simd", "formats", "table"]),
    ("light", &["simd", "image", "table"]),
    ("nodes", &["simd"]),
    ("scene", &["formats", "image", "nodes", "spectrum", "volume"]),
    ("models", &["formats", "scene"]),
    ("transport", &["simd", "accel", "image", "bsdf", "light", "camera", "nodes"]),
    (
        "engine",
        &[
            "simd",
            "formats",
            "spectrum",
            "sky",
            "annual",
            "dimming",
            "mesh",
            "accel",
            "image",
            "table",
            "camera",
            "bsdf",
            "light",
            "nodes",
            "scene",
            "transport",
        ],
    ),
];

#[test]
fn crates_use_those_below_them_alone() {
    for (name, allowed) in CRATES {
        let manifest = fs::read_to_string(root().join("rust-core").join(name).join("Cargo.toml")).expect("a crate's manifest");
        let dependencies = manifest.split("[dependencies]").nth(1).unwrap_or_default().split("\n[").next().unwrap_or_default();
        let used = dependencies.lines().filter_map(|line| line.strip_prefix("gonio-")?.split('.').next());
        let wrong: Vec<&str> = used.filter(|used| !allowed.contains(used)).collect();
        assert_eq!(wrong, Vec::<&str>::new(), "{name}");
    }
}

#[test]
fn stages_compute_and_know_no_scene() {
    for needle in ["gonio_scene", "crate::scene"] {
        for folder in ["accel", "bsdf", "light", "transport", "camera", "table", "image", "nodes"] {
            assert_eq!(lines_with(&format!("rust-core/{folder}/src"), needle), Vec::<String>::new(), "{folder}");
        }
    }
}

#[test]
fn the_core_knows_no_host() {
    for needle in ["pyo3", "pxr::", "bpy"] {
        for (folder, _) in CRATES {
            assert_eq!(lines_with(&format!("rust-core/{folder}/src"), needle), Vec::<String>::new(), "{needle} in {folder}");
        }
    }
}

#[test]
fn unsafe_code_has_few_homes() {
    let found: Vec<_> = CRATES
        .iter()
        .map(|(name, _)| format!("rust-core/{name}/src"))
        .filter(|folder| !["rust-core/simd/src", "rust-core/accel/src", "rust-core/formats/src"].contains(&folder.as_str()))
        .chain(["rust-core/python/src", "rust-core/cli/src", "rust-core/bench/src", "usd/src"].map(String::from))
        .flat_map(|folder| lines_with(&folder, "unsafe "))
        // The buffer protocol of passes and arrays, and memory from the kernel.
        .filter(|line| !["src/view.rs", "src/pass.rs", "src/array.rs", "src/memory.rs", "//"].iter().any(|home| line.contains(home)))
        .collect();
    assert_eq!(found, Vec::<String>::new());
}

#[test]
fn no_circle_has_more_than_four_files() {
    let crates = CRATES
        .iter()
        .map(|(name, _)| format!("rust-core/{name}"))
        .chain(["rust-core/bench", "rust-core/cli", "rust-core/python"].map(str::to_owned));
    // Places of a stage's prims and the nodes of materials are read through each other.
    for (name, most) in crates.map(|name| (name, 4)).chain([("usd".to_owned(), 5)]) {
        let circles = circles::of(&root().join(&name).join("src"));
        let large: Vec<_> = circles.into_iter().filter(|circle| circle.len() > most).collect();
        assert_eq!(large, Vec::<Vec<String>>::new(), "{name}");
    }
}

/// The most lines of a function.
const LONGEST_FUNCTION: usize = 73;

/// A line's indentation and the name of the function that begins there, in code as the formatter leaves it.
fn function_of(line: &str) -> Option<(&str, &str)> {
    let code = line.trim_start();
    let indentation = &line[..line.len() - code.len()];
    let (before, after) = code.strip_prefix("fn ").map_or_else(|| code.split_once(" fn "), |after| Some(("", after)))?;
    let is_modifier =
        |word: &str| matches!(word, "pub" | "const" | "unsafe" | "extern" | "\"C\"") || word.starts_with("pub(") || word.ends_with(')');
    before.split_whitespace().all(is_modifier).then(|| (indentation, after.split(['(', '<']).next().unwrap_or_default()))
}

/// Functions of a source that are too long. What macros make of a pattern has no end of its own and is left out.
fn long_functions(text: &str) -> Vec<String> {
    let lines: Vec<&str> = text.lines().collect();
    let length = |(start, line): (usize, &&str)| {
        let (indentation, name) = function_of(line)?;
        let first = lines[start..].iter().position(|line| line.ends_with(['{', ';', '}']))?;
        if !lines[start + first].ends_with('{') || name.contains('$') {
            return None;
        }
        let end = format!("{indentation}}}");
        let count = lines[start..].iter().position(|line| *line == end)? + 1;
        (count > LONGEST_FUNCTION).then(|| format!("{name} ({count} lines)"))
    };
    lines.iter().enumerate().filter_map(length).collect()
}

#[test]
fn no_function_is_longer_than_a_page() {
    let body =
        |count: usize| format!("    pub(super) const fn long(\n        a: u32,\n    ) -> u32 {{\n{}    }}\n", "        a;\n".repeat(count));
    assert_eq!(long_functions(&body(69)), Vec::<String>::new());
    assert_eq!(long_functions(&body(70)), ["long (74 lines)"]);
    let mut files = Vec::new();
    ["rust-core", "usd", "tests"].iter().for_each(|folder| sources(&root().join(folder), "rs", &mut files));
    let mut found = Vec::new();
    for file in files {
        let text = fs::read_to_string(&file).expect("a readable source");
        found.extend(long_functions(&text).into_iter().map(|function| format!("{}: {function}", file.display())));
    }
    assert!(found.is_empty(), "too long: {}", found.join(", "));
}

#[test]
fn colour_becomes_light_by_doors_alone() {
    let found = |needle: &str| -> Vec<String> {
        let folders = CRATES.iter().map(|(name, _)| *name).filter(|name| *name != "simd").chain(["python", "cli", "bench"]);
        let lines = folders.flat_map(|name| lines_with(&format!("rust-core/{name}/src"), needle)).filter(|line| !line.contains("/tests/"));
        let mut files: Vec<String> =
            lines.filter_map(|line| Some(line.split_once("rust-core/")?.1.split_once(':')?.0.to_owned())).collect();
        files.sort();
        files
    };
    let door = |name: &str| {
        let mut files: Vec<String> =
            ["wavelengths", "wavelengths.load(l, at)", "wavelengths(l, point.core.slot)", "Wavelengths::rgb(l)", "rgb"]
                .iter()
                .flat_map(|knows| found(&format!("{knows}.{name}(")))
                .collect();
        files.sort();
        files.dedup();
        files
    };
    assert_eq!(
        door("reflectance"),
        ["bsdf/src/measured/lobe.rs", "bsdf/src/surface.rs", "transport/src/media/set.rs", "transport/src/state/mix_weights.rs"]
    );
    assert_eq!(
        door("coefficient"),
        [
            "bsdf/src/film.rs",
            "bsdf/src/measured/lobe.rs",
            "bsdf/src/surface.rs",
            "transport/src/media/set.rs",
            "transport/src/tables/media/coefficients.rs"
        ]
    );
    assert_eq!(
        door("radiance"),
        [
            "bench/src/stages/light.rs",
            "light/src/spectra.rs",
            "transport/src/stage/light/merge.rs",
            "transport/src/state/queue/light_samples.rs",
            "transport/src/tables/media/coefficients.rs"
        ]
    );
    assert_eq!(door("lamp"), ["bsdf/src/surface.rs", "light/src/spectra.rs", "transport/src/tables/material.rs"]);
    let mut named = lines_with("rust-core/transport/src/stage", "Rgb");
    named.retain(|line| !line.contains("//"));
    assert!(named.is_empty(), "stages know light, not colour: {named:#?}");
}

#[test]
fn schedules_alone_know_the_workspace() {
    let mut named = lines_with("rust-core/transport/src", "Workspace");
    named.retain(|line| !["/schedule/", "/state/workspace", "src/lib.rs", "//"].iter().any(|known| line.contains(known)));
    assert!(named.is_empty(), "stages take what they read and write: {named:#?}");
}

#[test]
fn what_paths_carry_is_written_out_at_one_place() {
    for needle in ["PathLanes {", "Vertex {", "PathLanes::<L> {"] {
        let mut literals = lines_with("rust-core/transport/src", needle);
        literals.retain(|line| !["/state/paths.rs:", "/state/vertex.rs:", "impl<L: Lanes>"].iter().any(|known| line.contains(known)));
        assert!(literals.is_empty(), "paths are made by `PathLanes::start`, `Vertex::go_on` and `Vertex::straight_on`: {literals:#?}");
    }
    // Whoever spells out a core takes over the rest, lest what is added to it gets lost on the way.
    let cores = lines_with("rust-core/transport/src", "unguided: l.f(1.0)");
    assert_eq!(cores.len(), 1, "{cores:#?}");
}

#[test]
fn few_files_name_a_medium() {
    let mut named = Vec::new();
    for needle in ["media::set", "media::track", "media::field", "media::shadow", "tables::media", "MediumContext"] {
        let mut lines = lines_with("rust-core/transport/src", needle);
        // The crate root gives them to others.
        let home = ["/media/", "/stage/medium/", "/tables/media.rs", "src/lib.rs", "//"];
        lines.retain(|line| !home.iter().any(|known| line.contains(known)));
        named.extend(lines.iter().filter_map(|line| Some(line.split_once(".rs")?.0.to_owned())));
    }
    named.sort_unstable();
    named.dedup();
    assert!(named.len() <= 9, "what lies between surfaces is asked of paths, vertices and stages: {named:#?}");
}

#[test]
fn no_build_is_tied_to_one_machine() {
    let config = fs::read_to_string(root().join(".cargo/config.toml")).expect("the build's configuration");
    assert!(!config.lines().any(|line| !line.starts_with('#') && line.contains("native")));
}
