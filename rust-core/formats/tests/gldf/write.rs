//! Products that are written and read back.

use crate::{close, zip};
use gonio_formats::gldf::{Gldf, ProductColour, RatedFlux};
use gonio_formats::l3d::{L3d, L3dLight, L3dShape, NewModel, NewPart, Place, ShiningFaces};
use gonio_formats::photometry::measured::{Measurement, MeasurementHead, ProductParts, Reduced};
use gonio_formats::photometry::{Opening, OpeningShape};
use std::f64::consts::PI;

/// A lamp of 1000 lm of which 800.4 lm leave by Lambert's law.
fn measured(head: MeasurementHead, watts: Option<f64>) -> Reduced {
    let (planes, gammas): (Vec<f64>, Vec<f64>) =
        ((0..8).map(|c| f64::from(c) * 45.0).collect(), (0..=90).map(|gamma| f64::from(gamma) * 2.0).collect());
    let of = |gamma: &f64| if *gamma < 90.0 { 800.4 / PI * gamma.to_radians().cos() } else { 0.0 };
    let intensities: Vec<f64> = planes.iter().flat_map(|_| gammas.iter().map(of)).collect();
    let errors = intensities.iter().map(|value| value * 1e-3).collect();
    let opening = Opening::new(OpeningShape::Disk, [0.2, 0.2, 0.0]);
    let measurement = Measurement {
        planes,
        gammas,
        intensities,
        errors,
        source_flux: 1000.0,
        flux: 800.4,
        opening,
        watts,
        head,
        ..Measurement::default()
    };
    measurement.reduced(None).unwrap()
}

fn head() -> MeasurementHead {
    MeasurementHead {
        name: "Lamp <1> & \u{b0}".into(),
        manufacturer: "ACME".into(),
        date: "2026-03-31".into(),
        ..MeasurementHead::default()
    }
}

fn model() -> NewModel {
    let light = L3dLight {
        name: "light".into(),
        place: Place::new([0.0, 0.01, -0.05], [0.0; 3]),
        shape: L3dShape::Circle(0.2),
        heights: [0.0, 0.0, 0.0, 0.0],
    };
    let points = vec![[-0.1, -0.1, 0.0], [0.1, -0.1, 0.0], [0.1, 0.123_456_79, 0.0], [-0.1, 0.1, -0.0]];
    let plate = NewPart { name: "plate 1".into(), points, triangles: vec![[0, 1, 2], [0, 2, 3]], shining: 0 };
    let led = NewPart { shining: 2, ..plate.clone() };
    let one = NewPart { shining: 1, ..plate.clone() };
    NewModel { name: String::new(), program: String::new(), time: String::new(), parts: vec![plate, led, one], light }
}

fn parts() -> ProductParts {
    let colour = ProductColour {
        temperature: Some(3012.3),
        rendering: Some(92.4),
        chromaticity: Some([0.44, 0.4]),
        rendition: Some([90.2, 99.8]),
        melanopic: Some(0.45),
    };
    ProductParts {
        colour,
        spectrum: (0..41).map(|k| (380.0 + 10.0 * f64::from(k), if k == 17 { 1.0 } else { 0.25 })).collect(),
        model: Some(model()),
    }
}

#[test]
fn a_measured_luminaire_is_a_product_again() {
    let reduced = measured(head(), Some(10.0));
    let bytes = reduced.to_gldf(&parts()).unwrap();
    let product = Gldf::read(&bytes).unwrap();
    assert_eq!(product.warnings, []);
    assert_eq!((product.manufacturer.as_str(), product.version.as_str(), product.name.shown()), ("ACME", "1.0-rc.3", "Lamp <1> & \u{b0}"));
    let variant = &product.variants[0];
    let light = &product.emitters[0].lights[0];
    assert_eq!(
        (light.rated, light.watts, light.temperature, light.rendering),
        (Some(RatedFlux::Luminaire(800.0)), Some(10.0), Some(3012.0), Some(92.0))
    );
    let found = product.goniogram(variant).unwrap();
    assert_eq!(found.warnings, []);
    assert_eq!(
        (found.symmetry, &found.vertical, found.opening),
        (reduced.goniogram.symmetry, &reduced.goniogram.vertical, reduced.goniogram.opening)
    );
    // By the product's whole lumens.
    let factor = 800.0 / reduced.goniogram.flux();
    for (found, expected) in found.intensities.iter().zip(&reduced.goniogram.intensities) {
        assert!((found - factor * expected).abs() <= 1e-8 * expected, "{found} {expected}");
    }
    close(found.flux(), 800.0, 1e-8);
    assert!(product.file(product.spectra[0].file.unwrap()).unwrap().starts_with(b"380\t0.25\r\n390\t0.25\r\n"));
    let spectrum = found.spectrum.unwrap();
    let points: Vec<(f64, f64)> = spectrum.wavelengths_nm.into_iter().zip(spectrum.power).collect();
    assert_eq!(points, parts().spectrum);
}

#[test]
fn its_model_has_its_meshes_and_its_opening() {
    let bytes = measured(head(), None).to_gldf(&parts()).unwrap();
    let product = Gldf::read(&bytes).unwrap();
    let bytes = product.l3d(&product.variants[0]).unwrap().unwrap();
    let found = L3d::read(&bytes).unwrap();
    assert_eq!((found.warnings.len(), found.meshes.len(), found.parts.len(), found.name.as_str()), (0, 3, 3, "Lamp <1> & \u{b0}"));
    for (mesh, part) in found.meshes.iter().zip(model().parts) {
        let polygons = found.polygons(mesh).unwrap();
        assert_eq!((mesh.metres, &polygons.points), (1.0, &part.points));
        assert_eq!(polygons.corners, part.triangles.as_flattened());
    }
    let faces = |faces: [u32; 2]| vec![ShiningFaces { light: "light".into(), group: None, faces }];
    assert_eq!(found.parts.iter().map(|part| part.shining.clone()).collect::<Vec<_>>(), [vec![], faces([0, 1]), faces([1, 1])]);
    assert_eq!(found.lights, [model().light]);
    assert_eq!(found.parts[1].name, "part2-plate_1");
}

#[test]
fn the_same_luminaire_makes_the_same_bytes() {
    let bytes = measured(head(), Some(10.0)).to_gldf(&parts()).unwrap();
    assert_eq!(bytes, measured(head(), Some(10.0)).to_gldf(&parts()).unwrap());
    let other = measured(head(), Some(11.0)).to_gldf(&parts()).unwrap();
    let ids = [&bytes, &other].map(|bytes| Gldf::read(bytes).unwrap().id);
    assert_ne!(ids[0], ids[1]);
    // RFC 9562: version 8, variant 10.
    assert!(ids.iter().all(|id| id.len() == 36 && id.as_bytes()[14] == b'8' && b"89ab".contains(&id.as_bytes()[19])));
}

#[test]
fn a_luminaire_without_anything_known_is_its_photometry() {
    let bytes = measured(MeasurementHead::default(), None).to_gldf(&ProductParts::default()).unwrap();
    let product = Gldf::read(&bytes).unwrap();
    assert_eq!((product.files.len(), product.spectra.len(), product.warnings.len()), (1, 0, 0));
    let found = product.goniogram(&product.variants[0]).unwrap();
    assert_eq!(found.figures().watts, None);
}

#[test]
fn a_model_without_a_part_is_refused() {
    let parts = ProductParts { model: Some(NewModel { parts: Vec::new(), ..model() }), ..parts() };
    assert_eq!(measured(head(), None).to_gldf(&parts).unwrap_err().problem, "the model has no part");
}

#[test]
fn whole_lumens_of_weak_lights_are_their_own() {
    // 0.3 lm off is rounding, 0.7 lm off is another flux.
    for (flux, expected) in [(10.3, 10.3), (10.7, 10.0)] {
        let product = crate::product(crate::GENERAL, crate::VARIANTS).replacen(">1000<", ">10<", 1);
        let bytes = zip::archive(&[("product.xml", product.as_bytes()), ("ldc/down.ies", &crate::downlight(flux))]);
        let product = Gldf::read(&bytes).unwrap();
        let found = product.goniogram(&product.variants[0]).unwrap();
        close(found.flux(), expected, 1e-3);
        let of_flux = found.warnings.iter().filter(|warning| warning.problem.contains("flux"));
        assert_eq!(of_flux.count(), usize::from(expected == 10.0), "{:?}", found.warnings);
    }
}
