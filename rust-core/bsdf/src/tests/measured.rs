//! Measurements on lanes against the reference in double precision; sampling against density; energy against the measurement's own.

use super::harness::{View, spread};
use super::measurements::{self, ggx, uniform};
use super::rows::surface;
use super::{chi_square, rows};
use crate::{Closure, Distribution, MeasuredBsdf, Surface, Switches, parameter as p};
use core::f64::consts::{PI, TAU};
use gonio_formats::bsdf::{Axis, Channels, Coordinates, Direction, Hemispheres, Layout, Measured, Mode, Resolution, Sampler, Table};
use gonio_simd::{Column, Execution, Lanes, Vec3, WavelengthTable, Wavelengths, dispatch};
use std::sync::{Arc, LazyLock};

/// A measurement of each kind, and it as a surface.
static ALL: LazyLock<Vec<(&str, Measured, Surface)>> = LazyLock::new(|| {
    let with_surface = |(name, measured)| {
        let surface = showing(&measured, &[]);
        (name, measured, surface)
    };
    measurements::all().into_iter().map(with_surface).collect()
});

fn showing(measured: &Measured, values: rows::Values) -> Surface {
    let mut all: Vec<(usize, &[f32])> = vec![(p::BASE_COLOR, &[1.0; 3])];
    all.extend_from_slice(values);
    let laid_out = MeasuredBsdf::new(measured).expect("a measurement of ordinary size");
    let Surface { constants, switches, .. } = surface(Switches::single(Closure::Measured), &all);
    let varying = [false; p::COUNT];
    Surface::measured(constants, &varying, switches, Arc::new(laid_out))
}

/// A direction of the measurement's frame as a viewer of its back has it, whose y and z point the other way; its own inverse.
fn behind(d: [f32; 3]) -> [f32; 3] {
    [d[0], -d[1], -d[2]]
}

fn view(surface: &Surface, wo: [f32; 3]) -> View {
    let entering = wo[2] > 0.0;
    View::of(surface, if entering { wo } else { behind(wo) }, entering)
}

fn any_direction(number: u64) -> [f32; 3] {
    let (z, turn) = (2.0 * uniform(2 * number) - 1.0, TAU * uniform(2 * number + 1));
    let ring = (1.0 - z * z).sqrt();
    [(ring * turn.cos()) as f32, (ring * turn.sin()) as f32, z as f32]
}

/// Both at full precision, with exactly unit length.
fn widened(d: [f32; 3]) -> Direction {
    let d = d.map(f64::from);
    let length = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt();
    d.map(|x| x / length)
}

fn is_one_sided(measured: &Measured) -> bool {
    Hemispheres::ALL.into_iter().all(|pair| measured.has(pair) == (pair == Hemispheres::ReflectionFront))
}

fn is_isotropic(surface: &Surface) -> bool {
    surface.measured.as_ref().is_some_and(|laid_out| laid_out.is_isotropic())
}

/// Evaluations that differ from the reference: their share, and the largest difference of the others.
fn differences(measured: &Measured, sampler: &Sampler<'_>, surface: &Surface, execution: Execution) -> (f64, f64) {
    const VIEWS: u64 = 60;
    const LIGHTS: u64 = 64;
    let (mut odd, mut largest) = (0, 0.0_f64);
    for number in 0..VIEWS {
        let mut wo = any_direction(900_000 + number);
        let lights: Vec<[f32; 3]> = (0..LIGHTS).map(|light| any_direction(number * LIGHTS + light)).collect();
        let flip = wo[2] < 0.0;
        let seen: Vec<[f32; 3]> = lights.iter().map(|wi| if flip { behind(*wi) } else { *wi }).collect();
        let values = view(surface, wo).eval_at(execution, &seen);
        // What has no back shows its front there.
        let shown = flip && is_one_sided(measured);
        wo = if shown { behind(wo) } else { wo };
        for ((wi, seen), (value, pdf)) in lights.iter().zip(&seen).zip(values) {
            let (wi, wo) = (widened(if shown { *seen } else { *wi }), widened(wo));
            let (expected, density) = (measured.eval_rgb(wi, wo), sampler.pdf(wo, wi));
            let pairs = [(value[0], expected[0]), (value[1], expected[1]), (value[2], expected[2]), (pdf, density)];
            let near = |(found, expected): (f32, f64)| (f64::from(found) - expected).abs() / (expected.abs() + 1e-2);
            let difference = pairs.into_iter().map(near).fold(0.0, f64::max);
            if difference > 2e-3 {
                odd += 1;
            } else {
                largest = largest.max(difference);
            }
        }
    }
    (f64::from(odd) / (VIEWS * LIGHTS) as f64, largest)
}

#[test]
fn lanes_agree_with_the_reference() {
    let mut failures = Vec::new();
    for (name, measured, surface) in ALL.iter() {
        let sampler = Sampler::new(measured, &if is_isotropic(surface) { Resolution::ISOTROPIC } else { Resolution::ANISOTROPIC });
        for execution in Execution::all() {
            let (odd, largest) = differences(measured, &sampler, surface, execution);
            // Where cells are constant, rounding may choose the one beside.
            let allowed = if matches!(measured, Measured::Patches(_) | Measured::Tree(_)) { 2e-3 } else { 5e-4 };
            if odd > allowed {
                failures.push(format!("{name} on {}: {odd:.2e} of all differ, the others by {largest:.1e} at most", execution.name()));
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// Between wavelengths a spectrum is linear, and beyond the file's constant.
fn at_wavelength(measured: &Measured, wi: Direction, wo: Direction, nm: f64) -> f64 {
    let Channels::Bands { wavelengths_nm } = measured.channels() else { return f64::NAN };
    let mut values = vec![0.0; wavelengths_nm.len()];
    measured.eval(wi, wo, &mut values);
    let above = wavelengths_nm.partition_point(|known| *known <= nm).clamp(1, wavelengths_nm.len() - 1);
    let share = ((nm - wavelengths_nm[above - 1]) / (wavelengths_nm[above] - wavelengths_nm[above - 1])).clamp(0.0, 1.0);
    values[above - 1] + share * (values[above] - values[above - 1])
}

#[test]
fn adaptive_measurements_keep_their_spectra() {
    const NANOMETRES: [[f64; 3]; 4] = [[700.0, 540.0, 450.0], [380.0, 780.0, 581.3], [620.5, 533.25, 401.0], [555.0, 555.0, 555.0]];
    let places: Vec<f32> = NANOMETRES.iter().flat_map(|nm| [nm[0], nm[1], nm[2], 380.0]).map(|nm| ((nm - 380.0) / 400.0) as f32).collect();
    let mut column = Column::new(places.len());
    column[..places.len()].copy_from_slice(&places);
    let table = WavelengthTable { rotations: 4, places: column, ..WavelengthTable::default() };
    for measured in [measurements::adaptive(), measurements::adaptive_anisotropic()].map(measurements::by_wavelength) {
        let laid_out = MeasuredBsdf::with_wavelengths(&measured).expect("a measurement of ordinary size");
        assert!(laid_out.spectral_error() < 2e-3, "{}", laid_out.spectral_error());
        let (mut odd, mut all) = (0, 0);
        for (number, nanometres) in (0..600_u64).zip(NANOMETRES.iter().enumerate().cycle()) {
            let up = |d: [f32; 3]| widened([d[0], d[1], d[2].abs().max(0.05)]).map(|x| x as f32);
            let (wi, wo) = (up(any_direction(2 * number)), up(any_direction(2 * number + 1)));
            for execution in Execution::all() {
                let found = dispatch!(execution, l => {
                    let light = Wavelengths::new(Some(&table), l.u(nanometres.0 as u32)).nanometres().expect("wavelengths");
                    let found = laid_out.eval_at(l, light, Vec3::splat(l, wi), Vec3::splat(l, wo)).expect("a spectrum").0.to_rgb();
                    [found.r, found.g, found.b].map(|x| x.to_array()[0])
                });
                for (found, nm) in found.into_iter().zip(nanometres.1) {
                    let expected = at_wavelength(&measured, widened(wi), widened(wo), *nm);
                    all += 1;
                    odd += u32::from((f64::from(found) - expected).abs() > 5e-3 * expected.abs() + 1e-5);
                }
            }
        }
        assert!(f64::from(odd) < 5e-4 * f64::from(all), "{odd} of {all} differ");
        assert!(MeasuredBsdf::new(&measured).is_ok());
    }
}

#[test]
fn samples_follow_their_density() {
    let angles = [8.0_f32, 40.0, 75.0];
    let tests = (2 * ALL.len() * angles.len()) as f64;
    let threshold = 1.0 - (1.0 - 1e-3_f64).powf(1.0 / tests);
    let mut failures = Vec::new();
    for (row, (name, measured, surface)) in ALL.iter().enumerate() {
        for (column, angle) in angles.into_iter().enumerate() {
            for entering in [true, false] {
                if !entering && is_one_sided(measured) {
                    continue;
                }
                let seed = 1000 + (row * 8 + column * 2 + usize::from(entering)) as u64;
                let (chance, integral, usable) = chi_square::test(&View::new(surface, angle, entering), seed);
                // Four standard errors of the share, and the midpoint rule's error.
                let error = 4.0 * (usable * (1.0 - usable) / chi_square::SAMPLES as f64).sqrt() + 4e-3;
                if chance < threshold || (integral - usable).abs() > error {
                    failures
                        .push(format!("{name} at {angle}, front {entering}: p {chance:.2e}, integral {integral:.5}, usable {usable:.5}"));
                }
            }
        }
    }
    assert!(failures.is_empty(), "threshold {threshold:.2e}\n{}", failures.join("\n"));
}

/// The share of light that leaves to a view, from the reference.
fn reference_albedo(measured: &Measured, wo: Direction) -> [f64; 3] {
    const ROWS: usize = 160;
    let mut sum = [0.0; 3];
    for row in 0..2 * ROWS {
        let z = (row as f64 + 0.5) / ROWS as f64 - 1.0;
        let ring = (1.0 - z * z).sqrt();
        for column in 0..2 * ROWS {
            let turn = PI * (column as f64 + (0.618_034 * row as f64).fract()) / ROWS as f64;
            let value = measured.eval_rgb([ring * turn.cos(), ring * turn.sin(), z], wo);
            sum.iter_mut().zip(value).for_each(|(sum, value)| *sum += value * 2.0 * PI / (2 * ROWS * ROWS) as f64);
        }
    }
    sum
}

#[test]
fn a_furnace_loses_what_the_measurement_loses() {
    let mut failures = Vec::new();
    for (name, measured, surface) in ALL.iter() {
        for angle in [20.0_f32, 60.0] {
            let view = View::new(surface, angle, true);
            let [reflected, transmitted] = view.albedo(1 << 15);
            let expected = reference_albedo(measured, widened(view.wo));
            for channel in 0..3 {
                let found = reflected[channel] + transmitted[channel];
                if (found / expected[channel] - 1.0).abs() > 1e-2 {
                    failures.push(format!("{name} at {angle}, channel {channel}: {found:.4} for {:.4}", expected[channel]));
                }
            }
            // What the choice of lobes and the albedo pass know is the mean over azimuths, linear between some views.
            let estimate = view.summary().albedo[1];
            if is_isotropic(surface) && (f64::from(estimate) / expected[1] - 1.0).abs() > 6e-2 {
                failures.push(format!("{name} at {angle}: estimate {estimate:.4} for {:.4}", expected[1]));
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn levels_agree() {
    let numbers = spread(1 << 10);
    for (name, _, surface) in ALL.iter() {
        let view = View::new(surface, 50.0, true);
        let scalar = view.sample_at(Execution::Scalar, &numbers);
        for execution in Execution::all() {
            let near = |a: f32, b: f32| (a - b).abs() <= 5e-3 * a.abs().max(b.abs()) + 1e-4;
            let samples = view.sample_at(execution, &numbers);
            let pairs = samples.iter().zip(&scalar);
            let odd = pairs.filter(|(a, b)| !near(a.pdf, b.pdf) || a.wi.iter().zip(b.wi).any(|(a, b)| (a - b).abs() > 1e-3)).count();
            // A number at the border between two choices may fall on either side.
            assert!(odd <= numbers.len() / 100, "{name} on {}: {odd} samples differ", execution.name());
        }
    }
}

#[test]
fn tint_scale_and_turn_are_as_asked() {
    let measured = measurements::adaptive_anisotropic();
    let plain = showing(&measured, &[]);
    let changed = showing(&measured, &[(p::BASE_COLOR, &[0.5, 1.0, 0.25]), (p::SPECULAR_SCALE, &[2.0]), (p::ROTATION, &[0.25])]);
    let wi = any_direction(5);
    let wi = [wi[0], wi[1], wi[2].abs()];
    // A quarter of a turn on, the tangent is where y was.
    let quarter = |d: [f32; 3]| [-d[1], d[0], d[2]];
    let wo = [0.5_f32, 0.2, 0.71_f32.sqrt()];
    let expected = View::of(&plain, wo, true).eval(&[wi])[0].0;
    let found = View::of(&changed, quarter(wo), true).eval(&[quarter(wi)])[0].0;
    for channel in 0..3 {
        let factor = [1.0, 2.0, 0.5][channel];
        assert!((found[channel] - factor * expected[channel]).abs() < 1e-3 * expected[channel], "{found:?} for {expected:?}");
    }
}

/// The same in all directions.
fn lambert(albedo: f64) -> Measured {
    let axis = |last: f64| Axis::uniform(0.0, last, 2, Mode::Linear).expect("increasing");
    let layout = Layout {
        coordinates: Coordinates::Isotropic,
        axes: vec![axis(1.5), axis(1.5), axis(PI)],
        channels: Channels::Luminance,
        hemispheres: Hemispheres::ReflectionFront,
        reciprocal: true,
        bilateral: true,
    };
    let table = Table::from_function(layout, |_, _, out| out[0] = (albedo / PI) as f32).expect("a value for each cell");
    Measured::Tables(vec![table])
}

#[test]
fn a_coat_lies_over_a_measurement_as_over_a_base() {
    let coat: rows::Values =
        &[(p::BASE_COLOR, &[1.0; 3]), (p::SPECULAR_WEIGHT, &[0.0]), (p::COAT_WEIGHT, &[1.0]), (p::COAT_ROUGHNESS, &[0.3])];
    let over_base = surface(Switches::default(), coat);
    let laid_out = Arc::new(MeasuredBsdf::new(&lambert(1.0)).expect("a small measurement"));
    let over_measured = Surface::measured(over_base.constants, &[false; p::COUNT], Switches::default(), laid_out);
    for angle in [10.0_f32, 60.0] {
        let albedo = |surface: &Surface| View::new(surface, angle, true).albedo(1 << 15)[0][1];
        let (found, expected) = (albedo(&over_measured), albedo(&over_base));
        assert!((found / expected - 1.0).abs() < 1e-2, "at {angle}: {found:.4} for {expected:.4}");
    }
}

/// The grid is finer where the lobe is narrow; the image of a sphere is a sum of such values over its normals.
#[test]
fn a_table_of_ggx_is_ggx() {
    let axis = |last: f64, count: usize| Axis::uniform(0.0, last, count, Mode::Linear).expect("increasing");
    let layout = Layout {
        coordinates: Coordinates::HalfDifference,
        axes: vec![axis(PI / 2.0, 180), axis(PI / 2.0, 180), axis(PI, 90)],
        channels: Channels::Luminance,
        hemispheres: Hemispheres::ReflectionFront,
        reciprocal: true,
        bilateral: true,
    };
    let table = Table::from_function(layout, |wi, wo, out| out[0] = ggx([0.25; 2], wi, wo) as f32).expect("a value for each cell");
    let measured = showing(&Measured::Tables(vec![table]), &[]);
    let model = rows::glossy([1.0; 3], 0.5, 0.0, Distribution::Ggx);
    for angle in [0.0_f32, 30.0, 60.0, 75.0] {
        let albedo = |surface: &Surface| View::new(surface, angle, true).albedo(1 << 16)[0][1];
        let (found, expected) = (albedo(&measured), albedo(&model));
        assert!((found / expected - 1.0).abs() < 1e-2, "at {angle}: {found:.4} for {expected:.4}");
    }
}
