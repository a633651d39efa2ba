//! Real files, which are no part of the project.

use crate::{close, quadrature};
use gonio_formats::photometry::{Goniogram, PhotometricType, ies, ldt, read};
use std::path::{Path, PathBuf};

/// The folder of real data: `GONIO_SHARED`, or beside the checkout.
fn shared() -> PathBuf {
    let beside = || Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared");
    std::env::var_os("GONIO_SHARED").map_or_else(beside, PathBuf::from)
}

fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    for path in entries.flatten().map(|entry| entry.path()) {
        let ending = path.extension().unwrap_or_default().to_ascii_lowercase();
        if path.is_dir() {
            files(&path, found);
        } else if ending == "ies" || ending == "ldt" {
            found.push(path);
        }
    }
    found.sort();
}

fn goniograms() -> Vec<(PathBuf, Goniogram)> {
    let mut paths = Vec::new();
    for folder in ["data/photometry", "data/usd/luxtest"] {
        files(&shared().join(folder), &mut paths);
    }
    if paths.is_empty() {
        eprintln!("skipped: no photometric files under {}", shared().display());
    }
    let read = |path: PathBuf| {
        let goniogram = read(&std::fs::read(&path).unwrap(), &path.to_string_lossy());
        (path.clone(), goniogram.unwrap_or_else(|error| panic!("{}: {error}", path.display())))
    };
    paths.into_iter().map(read).collect()
}

#[test]
fn every_file_reads_and_keeps_its_tabulated_intensities() {
    for (path, goniogram) in goniograms() {
        eprintln!("{}: {:.1} lm, {:?}", path.display(), goniogram.flux(), goniogram.symmetry);
        goniogram.warnings.iter().for_each(|warning| eprintln!("    {warning}"));
        assert_eq!(goniogram.photometric_type, PhotometricType::C);
        let count = goniogram.vertical.len();
        for (h, c) in goniogram.horizontal.iter().enumerate().filter(|(_, c)| **c < 360.0) {
            for (v, gamma) in goniogram.vertical.iter().enumerate().filter(|(_, gamma)| **gamma > 0.0 && **gamma < 180.0) {
                let tabulated = goniogram.intensities[h * count + v];
                let found = goniogram.intensity(PhotometricType::C.direction(*c, *gamma));
                assert!((found - tabulated).abs() <= 1e-6 * tabulated.max(1e-3), "{}: {c} {gamma}", path.display());
            }
        }
    }
}

#[test]
fn the_closed_form_of_every_flux_agrees_with_a_quadrature() {
    for (_, goniogram) in goniograms() {
        close(goniogram.flux(), quadrature(&goniogram, false), 1e-3);
    }
}

#[test]
fn every_file_survives_both_writers() {
    for (path, goniogram) in goniograms() {
        for again in [ies::read(&ies::write(&goniogram)), ldt::read(&ldt::write(&goniogram))] {
            let again = again.unwrap_or_else(|error| panic!("{}: {error}", path.display()));
            close(again.flux(), goniogram.flux(), 1e-6);
            assert_eq!(again.symmetry, goniogram.symmetry);
        }
    }
}

#[test]
fn stripes_on_two_grids_are_the_same_light() {
    let all = goniograms();
    let named = |name: &str| all.iter().find(|(path, _)| path.ends_with(name)).map(|(_, goniogram)| goniogram);
    let Some((uniform, other)) = named("test_stripes_uniform.ies").zip(named("test_stripes_nonuniform.ies")) else { return };
    for tenth in 0..=1800 {
        let gamma = f64::from(tenth) / 10.0;
        assert!((uniform.intensity_at(0.0, gamma) - other.intensity_at(0.0, gamma)).abs() < 1e-9, "{gamma}");
    }
}
