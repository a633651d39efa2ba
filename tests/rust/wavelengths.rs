//! Doors of light with wavelengths on lanes, against the scalar forms of `gonio-spectrum`.

use gonio::{
    compile::compile,
    scene::{ColourSpectra, Light, Scene},
};
use gonio_simd::{Execution, FIRST_COLOUR_SPECTRA, Lanes, Rgb, Spectrum, WavelengthTable, Wavelengths, dispatch};
use gonio_spectrum::{REC709_TO_REC2020, Triples, named, triples, upsampling};
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

/// The greatest number of a coefficient's spectrum, over rotations.
#[inline(always)]
fn greatest<L: Lanes>(l: L, table: &WavelengthTable, colour: [f32; 3]) -> f32 {
    let at = |rotation| Wavelengths::new(Some(table), l.u(rotation)).coefficient(Rgb::splat(l, colour)).max_component();
    (0..table.rotations).map(|rotation| at(rotation).to_array()[0]).fold(0.0, f32::max)
}

#[test]
fn coefficients_stay_below_twice_their_colour() {
    // Media that vary are tracked by that bound.
    let table = table();
    for execution in Execution::all() {
        let mut most = 0.0_f32;
        for colour in colours() {
            let component = colour.into_iter().fold(0.0, f32::max);
            let greatest = dispatch!(execution, l => greatest(l, &table, colour));
            assert!(greatest <= 2.0 * component, "{}: {colour:?} comes to {greatest}", execution.name());
            most = most.max(greatest / component.max(f32::MIN_POSITIVE));
        }
        assert!(most > 1.5, "{}: saturated colours are above their components, by {most}", execution.name());
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

/// What lights of a colour send at a rotation: the first lane by the first number of a spectrum, the others by the second.
#[inline(always)]
fn sent<L: Lanes>(l: L, table: &WavelengthTable, rotation: u32, [first, others]: [u32; 2], colour: [f32; 3]) -> [[f32; 3]; 2] {
    let numbers = l.iota().lt(1).select(l.u(first), l.u(others));
    let light = Wavelengths::new(Some(table), l.u(rotation)).lamp(numbers, Rgb::splat(l, colour)).to_rgb();
    let lanes = [light.r, light.g, light.b].map(|part| part.to_array());
    [0, L::COUNT - 1].map(|lane| lanes.map(|part| part[lane]))
}

/// Skies beside lamps: the sum of their colours' spectra, of which nothing is below zero.
#[test]
fn lights_send_the_spectra_of_their_colours() {
    let daylight = ColourSpectra::daylight();
    let sky = Light { colour_spectra: Some(Arc::new(daylight.clone())), ..Light::default() };
    let lamp = named("LED-B3").expect("a name").expect("a spectrum");
    let lamp = Light { spectrum: Some(Arc::new(lamp.into())), ..Light::default() };
    let mut scene = Scene { lights: vec![lamp, sky], ..Scene::default() };
    scene.settings.spectral = true;
    let compiled = compile(&scene, None, &AtomicBool::new(false)).expect("two lights");
    let table = compiled.tables.wavelengths.clone().expect("light with wavelengths");
    let parts = [0, 1, 2].map(|part| triples().filter(|nm| daylight.at(nm)[part]));
    for execution in Execution::all() {
        for colour in [[1.0, 1.0, 1.0], [0.7, 0.9, 1.6], [2.8, 0.6, 0.0], [-2.8, -0.6, 0.0]] {
            for rotation in [0, 77, 256, 511] {
                let [first, last] = dispatch!(execution, l => sent(l, &table, rotation, [FIRST_COLOUR_SPECTRA, 1], colour));
                let [lamp, _] = dispatch!(execution, l => sent(l, &table, rotation, [1, 1], colour));
                let sign = if colour[0] < 0.0 { -1.0 } else { 1.0 };
                for k in 0..3 {
                    let sum: f32 = (0..3).map(|part| colour[part] * parts[part][rotation as usize][k]).sum();
                    let expected = (sign * sum).max(0.0) * sign;
                    assert!(
                        (first[k] - expected).abs() < 1e-5,
                        "{}: {colour:?} at {rotation}: {first:?}, expected {expected}",
                        execution.name()
                    );
                }
                assert!(last == lamp || last == first, "{}: {last:?}, expected {lamp:?}", execution.name());
            }
        }
    }
}
