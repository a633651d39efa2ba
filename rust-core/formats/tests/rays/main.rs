//! Ray files: written here byte by byte from their layouts, read, written and read again.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod light_tools;
mod tm25;
mod zemax;

use gonio_formats::rays::{FluxUnit, RayColour, RayFile, RayFormat, read};

/// Three rays: position in the file's unit, direction, flux.
const RAYS: [[f32; 7]; 3] =
    [[1.0, 2.0, 3.0, 0.0, 0.0, 1.0, 2.0], [-1.0, 0.5, 0.0, 0.6, 0.0, 0.8, 1.0], [0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 5.0]];

fn close(found: f64, expected: f64, relative: f64) {
    assert!((found - expected).abs() <= relative * expected.abs().max(1e-3), "found {found}, expected {expected}");
}

/// The three rays in metres with a flux of `total`.
fn are_the_rays(file: &RayFile, metres: f32, total: f64) {
    assert_eq!(file.len(), 3);
    close(file.total, total, 1e-6);
    close(file.fluxes.iter().map(|flux| f64::from(*flux)).sum(), total, 1e-6);
    for (index, ray) in RAYS.iter().enumerate() {
        for axis in 0..3 {
            close(file.origins[index][axis].into(), f64::from(ray[axis] * metres), 1e-6);
            close(file.directions[index][axis].into(), ray[3 + axis].into(), 1e-6);
        }
    }
}

#[test]
fn other_files_are_refused_by_name() {
    let problem = |name: &str| read(b"whatever this is", name, false).unwrap_err().problem;
    assert!(problem("lamp.ray").contains("SPEOS, LucidShape, TracePro"));
    assert!(problem("lamp.DIS").contains("ASAP") && problem("lamp.dis").ends_with("export TM-25"));
    assert!(problem("lamp").starts_with("not a ray file that we know"));
    assert!(read(&[], "", true).is_err());
}

#[test]
fn rays_move_and_get_another_flux() {
    let file = read(&zemax::binary(&RAYS, 0, 1, 4), "", false).unwrap();
    let turned = file.clone().moved([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]], [0.0, 0.0, 0.5]);
    assert_eq!(turned.origins[0], [-0.002, 0.001, 0.503]);
    assert_eq!(turned.directions[2], [1.0, 0.0, 0.0]);
    let bright = file.with_lumens(1000.0).unwrap();
    assert_eq!((bright.unit, bright.fluxes[0], bright.total), (FluxUnit::Lumens, 250.0, 1000.0));
    assert!(bright.with_lumens(f64::NAN).is_err());
}

#[test]
fn one_format_becomes_another() {
    let first = read(&zemax::binary(&RAYS, 0, 1, 4), "", false).unwrap();
    let second = read(&gonio_formats::rays::tm25::write(&first).unwrap(), "", false).unwrap();
    assert_eq!((second.format, second.unit, &second.colour), (RayFormat::Tm25, FluxUnit::Lumens, &RayColour::Unknown));
    are_the_rays(&second, 1e-3, 8.0);
    let third = read(&gonio_formats::rays::zemax::write(&second).unwrap(), "", false).unwrap();
    assert_eq!((&third.origins, &third.directions, &third.description), (&first.origins, &first.directions, &first.description));
    are_the_rays(&third, 1e-3, 8.0);
}
