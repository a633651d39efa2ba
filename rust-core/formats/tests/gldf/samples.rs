//! Real files, which are no part of the project: `data/gldf` in the folder of real data.

use gonio_formats::gldf::{Gldf, looks_like};
use gonio_formats::l3d::L3d;
use std::path::{Path, PathBuf};

fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    for path in entries.flatten().map(|entry| entry.path()) {
        let ending = path.extension().unwrap_or_default().to_ascii_lowercase();
        if path.is_dir() {
            files(&path, found);
        } else if ending == "gldf" || ending == "l3d" {
            found.push(path);
        }
    }
    found.sort();
}

#[test]
fn real_products_say_their_variants_or_why_not() {
    let beside = || Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared");
    let folder = std::env::var_os("GONIO_SHARED").map_or_else(beside, PathBuf::from).join("data/gldf");
    let mut paths = Vec::new();
    files(&folder, &mut paths);
    if paths.is_empty() {
        eprintln!("skipped: no GLDF files under {}", folder.display());
    }
    for path in paths {
        let bytes = std::fs::read(&path).unwrap();
        eprintln!("{}", path.display());
        if path.extension().is_some_and(|ending| ending == "l3d") {
            model(&bytes);
            continue;
        }
        let product = match Gldf::read(&bytes) {
            Ok(product) => product,
            Err(problem) => {
                eprintln!("    {problem}");
                assert!(!looks_like(&bytes) || !problem.problem.is_empty());
                continue;
            }
        };
        product.warnings.iter().take(5).for_each(|warning| eprintln!("    {warning}"));
        for variant in product.variants.iter().take(5) {
            match product.goniogram(variant) {
                Ok(light) => {
                    eprintln!("    {}: {:.1} lm, {:?}", variant.name.shown(), light.flux(), light.figures().watts);
                    light.warnings.iter().for_each(|warning| eprintln!("        {warning}"));
                    assert!(light.flux() > 0.0);
                }
                Err(problem) => eprintln!("    {}: {problem}", variant.name.shown()),
            }
            if let Some(Ok(bytes)) = product.l3d(variant) {
                model(&bytes);
            }
        }
    }
}

fn model(bytes: &[u8]) {
    let model = match L3d::read(bytes) {
        Ok(model) => model,
        Err(problem) => return eprintln!("        model: {problem}"),
    };
    model.warnings.iter().for_each(|warning| eprintln!("        {warning}"));
    for light in &model.lights {
        eprintln!("        {} {:?} at {:?}", light.name, light.shape, light.place.point([0.0; 3]));
    }
    for mesh in &model.meshes {
        let faces = model.polygons(mesh).map(|mesh| mesh.face_counts.len());
        eprintln!("        {}: {faces:?} faces", mesh.path);
    }
}
