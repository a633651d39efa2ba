//! Files from elsewhere, where they are beside the checkout.

use std::path::Path;

use super::super::direction::spherical;
use super::super::{Channels, Hemispheres, Measured, read};

/// A file's bytes; none with a word about it when it is not there.
fn file(name: &str) -> Option<Vec<u8>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/bsdf").join(name);
    let bytes = std::fs::read(&path).ok();
    if bytes.is_none() {
        eprintln!("skipped: {} is not there", path.display());
    }
    bytes
}

#[test]
fn a_klems_matrix_of_a_shade() {
    let Some(bytes) = file("klems_aniso_high.xml") else { return };
    let material = read(&bytes, "klems_aniso_high.xml").unwrap();
    let Measured::Patches(patches) = &material else { panic!("expected patches") };
    assert_eq!(patches.bases().len(), 1);
    assert_eq!(patches.bases()[0].count(), 145);
    for pair in Hemispheres::ALL {
        let matrix = patches.main(pair).unwrap();
        let totals = patches.totals(matrix);
        assert!(totals.iter().all(|&t| t > 0.0 && t < 1.0), "{pair:?}: {totals:?}");
    }
    // A dark fabric with open gaps: at normal incidence more goes straight through than anywhere else.
    let straight = material.eval_luminance([0.0, 0.0, -1.0], [0.0, 0.0, 1.0]);
    assert!((straight - 0.5351).abs() < 1e-6, "{straight}");
    assert!(material.eval_luminance([0.0, 0.0, -1.0], spherical(0.3, 0.0)) < 0.1);
}

#[test]
fn a_white_standard() {
    let Some(bytes) = file("spectralon_lowres.pbsdf") else { return };
    let material = read(&bytes, "spectralon_lowres.pbsdf").unwrap();
    let Measured::Tables(tables) = &material else { panic!("expected a table") };
    assert_eq!(tables[0].layout().axes.iter().map(|a| a.knots().len()).collect::<Vec<_>>(), [9, 9, 22]);
    assert_eq!(material.channels(), &Channels::bands(vec![450.0, 500.0, 550.0, 600.0, 650.0]).unwrap());
    assert!(tables[0].invalid_cells() > 0);
    // A white standard: what it reflects in all bands is the same, and at 1/5 of a steradian most of what there is.
    let albedo = material.albedo(spherical(0.3, 0.0)).reflected;
    assert!(albedo.iter().all(|a| (a / albedo[2] - 1.0).abs() < 0.1 && *a > 0.5 && *a < 1.0), "{albedo:?}");
}
