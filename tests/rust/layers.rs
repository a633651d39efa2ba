//! The house's order: which module may import which, and what no source may hold.

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

#[test]
fn the_description_knows_nothing_of_its_layout() {
    assert_eq!(lines_with("rust-core/engine/src/scene", "crate::compile"), Vec::<String>::new());
}

#[test]
fn kernels_see_compiled_tables_alone() {
    for folder in ["accel", "bsdf", "light", "integrator", "graph", "geometry", "sampler", "camera", "table", "texture", "colour"] {
        let found = lines_with(&format!("rust-core/engine/src/{folder}"), "crate::scene");
        assert_eq!(found, Vec::<String>::new(), "{folder}");
    }
}

#[test]
fn the_core_knows_no_host() {
    for needle in ["pyo3", "pxr::", "bpy"] {
        for folder in ["rust-core/simd/src", "rust-core/formats/src", "rust-core/engine/src"] {
            assert_eq!(lines_with(folder, needle), Vec::<String>::new(), "{needle} in {folder}");
        }
    }
}

#[test]
fn unsafe_code_has_few_homes() {
    let found: Vec<_> = ["rust-core/engine/src", "rust-core/python/src", "usd/src"]
        .iter()
        .flat_map(|folder| lines_with(folder, "unsafe "))
        // Traversal, the buffer protocol of passes and arrays, and memory from the kernel.
        .filter(|line| {
            !["/accel/", "src/view.rs", "src/pass.rs", "src/array.rs", "src/memory.rs", "//"].iter().any(|home| line.contains(home))
        })
        .collect();
    assert_eq!(found, Vec::<String>::new());
}

#[test]
fn no_build_is_tied_to_one_machine() {
    let config = fs::read_to_string(root().join(".cargo/config.toml")).expect("the build's configuration");
    assert!(!config.lines().any(|line| !line.starts_with('#') && line.contains("native")));
}
