//! Doors of light with wavelengths on lanes, against the scalar forms of `gonio-spectrum`.

use gonio::{compile::compile, scene::Scene};
use gonio_simd::{Execution, Lanes, Rgb, Spectrum, WavelengthTable, Wavelengths, dispatch};
use gonio_spectrum::{REC709_TO_REC2020, Triples, triples, upsampling};
use std::sync::{Arc, atomic::AtomicBool};

fn table() -> Arc<WavelengthTable> {
    let mut scene = Scene::default();
    scene.settings.spectral = true;
    let compiled = compile(&scene, None, &AtomicBool::new(false)).expect("an empty scene");
    compiled.tables.wavelengths.clone().expect("light with wavelengths")
}

/// Colours of all kinds: saturated, dark, bright, grey, and such as no reflectance has.
fn colours() -> Vec<[f32; 3]> {
    let steps = [0.0, 0.003, 0.05, 0.3, 0.5, 0.97, 1.0];
    let pairs = |r: f32| steps.into_iter().flat_map(move |g| steps.into_iter().map(move |b| [r, g, b]));
    steps.into_iter().flat_map(pairs).collect()
}

/// The largest difference of a door's reflectances from the scalar ones, over rotations.
#[inline(always)]
fn worst<L: Lanes>(l: L, table: &WavelengthTable, rotation: u32, colour: [f32; 3]) -> f32 {
    let found = Wavelengths::new(Some(table), l.u(rotation)).reflectance(Rgb::splat(l, colour)).to_rgb();
    let centres = triples().centres()[rotation as usize];
    let wide = REC709_TO_REC2020.map(|row| row.iter().zip(colour).map(|(part, value)| part * value).sum());
    let expected = centres.map(|nm| upsampling().reflectance(wide, nm));
    let found = [found.r, found.g, found.b].map(|lanes| lanes.to_array()[0]);
    found.iter().zip(expected).map(|(found, expected)| (found - expected).abs()).fold(0.0, f32::max)
}

#[test]
fn colours_become_the_same_spectra_on_lanes() {
    let table = table();
    for execution in Execution::all() {
        for colour in colours() {
            for rotation in [0, 77, 256, 511] {
                let worst = dispatch!(execution, l => worst(l, &table, rotation, colour));
                // Close to 1 the table is read by what is left to 1, which has few digits.
                let is_bright = colour.iter().any(|part| *part > 0.99);
                assert!(worst < if is_bright { 5e-3 } else { 2e-4 }, "{}: {colour:?} at {rotation} differs by {worst}", execution.name());
            }
        }
    }
}

/// What even light of 1 and a spectrum of components show at a rotation.
#[inline(always)]
fn seen<L: Lanes>(l: L, table: &WavelengthTable, rotation: u32) -> [f32; 3] {
    let colour = Wavelengths::new(Some(table), l.u(rotation)).to_rgb(Spectrum::one(l));
    [colour.r, colour.g, colour.b].map(|lanes| lanes.to_array()[0])
}

#[test]
fn daylight_is_white_at_each_rotation() {
    let table = table();
    for execution in Execution::all() {
        for rotation in 0..Triples::COUNT as u32 {
            let colour = dispatch!(execution, l => seen(l, &table, rotation));
            assert!(colour.iter().all(|part| (part - 1.0).abs() < 1e-5), "{}: {colour:?} at {rotation}", execution.name());
        }
    }
}
