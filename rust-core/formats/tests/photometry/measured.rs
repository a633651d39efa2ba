//! What a goniophotometer counted: symmetries by errors, files, figures.

use crate::{close, steps};
use gonio_formats::photometry::measured::{Measurement, MeasurementHead};
use gonio_formats::photometry::{Opening, OpeningShape, PhotometricType, Symmetry, ies, ldt, read};
use std::f64::consts::PI;

/// Numbers without visible order (SplitMix64).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Normally distributed (Box and Muller).
    fn normal(&mut self) -> f64 {
        (-2.0 * (1.0 - self.next()).ln()).sqrt() * (2.0 * PI * self.next()).cos()
    }
}

/// Every 15 and 2.5 degrees, with errors of a share of the intensity's root, as counts have them.
fn measured(intensity: impl Fn(f64, f64) -> f64, noise: f64, seed: u64) -> Measurement {
    let planes: Vec<f64> = steps(0.0, 360.0, 24)[..24].to_vec();
    let gammas = steps(0.0, 180.0, 72);
    let mut random = Random(seed);
    let (mut intensities, mut errors) = (Vec::new(), Vec::new());
    for c in &planes {
        for gamma in &gammas {
            let exact = intensity(*c, *gamma);
            let error = noise * exact.sqrt();
            intensities.push((exact + error * random.normal()).max(0.0));
            errors.push(error);
        }
    }
    let mut measurement = Measurement { planes, gammas, intensities, errors, source_flux: 5000.0, ..Measurement::default() };
    measurement.flux = measurement.reduced(Some(Symmetry::None)).unwrap().goniogram.flux();
    measurement.flux_error = 0.5;
    measurement
}

/// A cosine to the fourth power, with more to one side, or in one plane.
fn lobe(gamma: f64) -> f64 {
    1000.0 * gamma.to_radians().cos().max(0.0).powi(4)
}

#[test]
fn symmetries_are_found_by_the_errors() {
    let side = |c: f64, of: f64| (c - of).to_radians().cos();
    for seed in 0..5 {
        let cases: [(Symmetry, Measurement); 5] = [
            (Symmetry::Rotational, measured(|_, g| lobe(g), 0.3, seed)),
            (Symmetry::Quadrants, measured(|c, g| lobe(g) * (1.0 + 0.3 * (2.0 * c).to_radians().cos()), 0.3, seed)),
            (Symmetry::AboutC0, measured(|c, g| lobe(g) * (1.0 + 0.1 * side(c, 0.0)), 0.3, seed)),
            (Symmetry::AboutC90, measured(|c, g| lobe(g) * (1.0 + 0.1 * side(c, 90.0)), 0.3, seed)),
            (Symmetry::None, measured(|c, g| lobe(g) * (1.0 + 0.1 * side(c, 40.0)), 0.3, seed)),
        ];
        for (symmetry, measurement) in cases {
            let reduced = measurement.reduced(None).unwrap();
            assert_eq!(reduced.goniogram.symmetry, symmetry, "{:?}", reduced.tests);
            assert_eq!(reduced.goniogram.warnings, []);
            assert_eq!(reduced.errors.len(), reduced.goniogram.intensities.len());
            if let Some(test) = reduced.tests.last().filter(|test| test.holds) {
                assert!((0.7..1.3).contains(&test.chi_square), "{test:?}");
            }
            close(reduced.goniogram.flux(), measurement.flux, 1e-9);
        }
    }
}

#[test]
fn a_tilt_below_the_noise_of_each_direction_shows_in_the_planes() {
    // Each direction has an error of about a tenth, the tilt is 3 %.
    let tilted = measured(|c, g| lobe(g) * (1.0 + 0.03 * c.to_radians().cos()), 2.0, 3);
    assert_eq!(tilted.reduced(None).unwrap().goniogram.symmetry, Symmetry::AboutC0);
}

#[test]
fn dim_directions_do_not_hide_the_beam() {
    // A beam of a few directions that leans by about two standard errors each, in much dim light without noise.
    let beam = |c: f64, g: f64| if g < 8.0 { 900.0 + if g > 0.0 { 12.0 * (7.0 * c).to_radians().cos() } else { 0.0 } } else { 0.01 };
    assert_eq!(measured(beam, 0.15, 3).reduced(None).unwrap().goniogram.symmetry, Symmetry::AboutC0);
    // What has no errors may differ by what facets do, and no more.
    let facets = |of: f64| measured(move |c, g| lobe(g) * (1.0 + of * (5.0 * c + 20.0).to_radians().cos()), 0.0, 3);
    assert_eq!(facets(1e-3).reduced(None).unwrap().goniogram.symmetry, Symmetry::Rotational);
    assert_eq!(facets(2e-2).reduced(None).unwrap().goniogram.symmetry, Symmetry::None);
}

#[test]
fn one_spot_breaks_a_symmetry() {
    let spot = measured(|c, g| lobe(g) + if c == 15.0 && g == 60.0 { 30.0 } else { 0.0 }, 0.2, 3);
    let reduced = spot.reduced(None).unwrap();
    assert_eq!(reduced.goniogram.symmetry, Symmetry::None);
    assert!(reduced.tests.iter().all(|test| test.largest > 6.0), "{:?}", reduced.tests);
}

#[test]
fn a_named_symmetry_is_given_and_doubted() {
    let side = measured(|c, g| lobe(g) * (1.0 + 0.2 * c.to_radians().cos()), 0.3, 3);
    let reduced = side.reduced(Some(Symmetry::Quadrants)).unwrap();
    assert_eq!((reduced.goniogram.symmetry, reduced.goniogram.horizontal.len()), (Symmetry::Quadrants, 7));
    assert!(reduced.goniogram.warnings[0].problem.starts_with("Quadrants symmetry is not what was measured"));
    close(reduced.goniogram.flux(), side.flux, 1e-9);
    // Errors: C0 is one of two planes, C15 one of four.
    let at = |plane: usize| plane * side.gammas.len() + 10;
    let [zero, half] = [side.errors[at(0)], side.errors[at(12)]];
    close(reduced.errors[at(0)], (zero * zero + half * half).sqrt() / 2.0, 1e-12);
    let four = [1, 11, 13, 23].map(|plane| side.errors[at(plane)].powi(2)).iter().sum::<f64>().sqrt() / 4.0;
    close(reduced.errors[at(1)], four, 1e-12);
    let mut odd = side.clone();
    odd.planes = (0..23).map(|index| f64::from(index) * 360.0 / 23.0).collect();
    odd.intensities.truncate(23 * 73);
    odd.errors.truncate(23 * 73);
    let problem = odd.reduced(Some(Symmetry::AboutC0)).unwrap_err().problem;
    assert!(problem.contains("23 C planes cannot be AboutC0"), "{problem}");
    assert_eq!(odd.reduced(Some(Symmetry::None)).unwrap().goniogram.horizontal.len(), 23);
}

#[test]
fn poles_are_one_direction() {
    let mut one = measured(|_, g| lobe(g), 0.3, 5);
    for plane in 0..24 {
        (one.intensities[plane * 73], one.errors[plane * 73]) = (1003.0, 7.0);
    }
    let reduced = one.reduced(None).unwrap();
    assert_eq!((reduced.goniogram.intensities[0], reduced.errors[0]), (1003.0, 7.0));
}

/// A wide luminaire with light up and all that a file can hold.
fn whole() -> Measurement {
    let wide = |c: f64, g: f64| lobe(g) * (1.0 + 0.3 * (2.0 * c).to_radians().cos()) + 0.2 * lobe(180.0 - g);
    Measurement {
        opening: Opening::new(OpeningShape::Box, [1.2, 0.3, 0.05]),
        body: Some([1.25, 0.35, 0.08]),
        watts: Some(42.5),
        colour_temperature: Some(3987.0),
        head: MeasurementHead {
            name: "Lamp <1>".into(),
            manufacturer: "maker & sons".into(),
            catalogue_number: "4711".into(),
            report: "R 12".into(),
            date: "2025-03-31".into(),
        },
        ..measured(wide, 0.2, 11)
    }
}

#[test]
fn files_come_back() {
    let measurement = whole();
    let reduced = measurement.reduced(None).unwrap();
    let ratio = measurement.flux / 5000.0;
    let eulumdat = ldt::read(&reduced.to_ldt()).unwrap();
    assert_eq!((eulumdat.symmetry, &eulumdat.warnings[..]), (Symmetry::Quadrants, &[][..]));
    assert_eq!(eulumdat.opening.shape, OpeningShape::Box);
    eulumdat.opening.size.iter().zip([1.2, 0.3, 0.05]).for_each(|(found, expected)| close(*found, expected, 1e-12));
    eulumdat.body.iter().zip([0.35, 1.25, 0.08]).for_each(|(found, expected)| close(*found, expected, 1e-12));
    let lamps = eulumdat.lamps().unwrap();
    assert_eq!((lamps.flux, lamps.watts, lamps.colour.as_str(), lamps.absolute), (Some(5000.0), 42.5, "3987 K", false));
    close(eulumdat.stated.light_output_ratio.unwrap(), ratio, 1e-9);
    close(eulumdat.stated.downward_fraction.unwrap(), reduced.figures().downward_fraction.value, 1e-9);
    assert_eq!(eulumdat.text("LUMINAIRE"), Some("Lamp <1>"));
    let absolute = ies::read(&reduced.to_ies()).unwrap();
    assert_eq!(absolute.warnings, []);
    assert!(absolute.lamps().unwrap().absolute && absolute.lamps().unwrap().flux.is_none());
    assert_eq!(absolute.opening.size, [1.2, 0.3, 0.05]);
    assert_eq!(absolute.text("TESTLAB"), Some("gonio virtual goniophotometer"));
    assert_eq!(absolute.text("ISSUEDATE"), Some("2025-03-31"));
    let text = String::from_utf8(reduced.to_ies()).unwrap();
    assert!(text.starts_with("IES:LM-63-2019\n") && text.contains("\n1 -1 1 73 7 1 2 0.3 1.2 0.05\n1 1.00010 42.5\n"), "{text}");
    let xml = read(&reduced.to_tm33(), "").unwrap();
    assert_eq!((xml.text("LUMINAIRE"), xml.text("MANUFAC"), xml.warnings.len()), (Some("Lamp <1>"), Some("maker & sons"), 0));
    for again in [&eulumdat, &absolute, &xml] {
        for c in steps(0.0, 355.0, 71) {
            for gamma in steps(0.0, 180.0, 90) {
                let direction = PhotometricType::C.direction(c, gamma);
                let (found, expected) = (again.intensity(direction), reduced.goniogram.intensity(direction));
                assert!((found - expected).abs() <= 1e-8 * expected + 1e-6, "{found} {expected}");
            }
        }
    }
}

#[test]
fn figures_have_errors_that_hold() {
    let exact = |_: f64, g: f64| lobe(g) + 0.2 * lobe(180.0 - g);
    let runs: Vec<_> = (0..200).map(|seed| measured(exact, 0.3, 1000 + seed).reduced(Some(Symmetry::None)).unwrap().figures()).collect();
    let spread = |values: Vec<f64>, stated: Vec<f64>, least: f64, most: f64| {
        let stated = (stated.iter().map(|error| error * error).sum::<f64>() / stated.len() as f64).sqrt();
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let deviation = (values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / (values.len() - 1) as f64).sqrt();
        assert!((least..most).contains(&(stated / deviation)), "{stated} stated, {deviation} found");
    };
    let first = &runs[0];
    spread(
        runs.iter().map(|run| run.downward_fraction.value).collect(),
        runs.iter().map(|run| run.downward_fraction.error).collect(),
        0.85,
        1.15,
    );
    // The greatest of several noisy values varies less than each of them.
    spread(
        runs.iter().map(|run| run.beam[0].spread.angle()).collect(),
        runs.iter().map(|run| run.beam[0].error.unwrap()).collect(),
        0.85,
        1.6,
    );
    spread(
        runs.iter().map(|run| run.field[1].spread.angle()).collect(),
        runs.iter().map(|run| run.field[1].error.unwrap()).collect(),
        0.85,
        1.15,
    );
    let ratio = first.light_output_ratio.unwrap();
    close(ratio.error, 0.5 / 5000.0, 1e-12);
    close(first.upward_fraction.value + first.downward_fraction.value, 1.0, 1e-12);
    // cos⁴ is a half at acos(0.5^¼); the greatest of noisy values is a little more than the peak.
    close(runs.iter().map(|run| run.beam[0].spread.angle()).sum::<f64>() / 200.0, 2.0 * 0.5_f64.powf(0.25).acos().to_degrees(), 5e-3);
}

#[test]
fn nonsense_is_refused() {
    let good = whole();
    let problem = |change: &dyn Fn(&mut Measurement)| {
        let mut bad = good.clone();
        change(&mut bad);
        bad.reduced(None).unwrap_err().problem
    };
    assert!(problem(&|bad| bad.intensities[7] = f64::NAN).contains("NaN cd was found among the intensities"));
    assert!(problem(&|bad| bad.errors.truncate(3)).contains("3 standard errors were given for 24 C planes of 73 angles"));
    assert!(problem(&|bad| bad.planes[3] = 50.0).contains("C plane 4 of 24 is 50, expected 45"));
    assert!(problem(&|bad| bad.gammas[3] = 50.0).contains("increase"));
    assert!(problem(&|bad| bad.flux = 5100.0).contains("its sources emit 5000 lm"));
    assert!(problem(&|bad| bad.opening.size[0] = -1.0).contains("an extent is -1 m"));
    let mut closed = good.clone();
    closed.planes.push(360.0);
    closed.intensities.extend_from_slice(&good.intensities[..73]);
    closed.errors.extend_from_slice(&good.errors[..73]);
    assert_eq!(closed.reduced(None).unwrap().goniogram, good.reduced(None).unwrap().goniogram);
    let mut coarse = good;
    coarse.flux *= 1.1;
    assert!(coarse.reduced(None).unwrap().goniogram.warnings[0].problem.contains("finer angles are needed"));
    coarse.source_flux = 0.0;
    let dark = coarse.reduced(None).unwrap();
    assert!(dark.figures().light_output_ratio.is_none() && dark.goniogram.lamps().unwrap().absolute);
}

#[test]
fn direct_ratios_are_those_of_makers() {
    // Two makers' tables with their stated ratios: every 5 degrees, cd/klm.
    let wide = [
        413.78, 411.03, 402.95, 389.88, 372.49, 351.32, 327.30, 300.65, 272.20, 242.28, 209.79, 175.55, 140.76, 106.42, 72.95, 41.91,
        16.06, 3.77, 1.30,
    ];
    let stated = [0.30, 0.40, 0.48, 0.57, 0.63, 0.71, 0.76, 0.81, 0.85, 0.88];
    let goniogram = crate::type_c(&steps(0.0, 90.0, 18), &[0.0], |_, gamma| wide[(gamma / 5.0).round() as usize]);
    for (found, expected) in goniogram.direct_ratios().into_iter().zip(stated) {
        assert!((found - expected).abs() <= 0.025, "{found} {expected}");
    }
    // All that goes straight down arrives; of a Lambertian source's the form factor of two squares does.
    let beam = crate::type_c(&[0.0, 0.1, 0.2, 90.0], &[0.0], |_, gamma| if gamma < 0.15 { 1e4 } else { 0.0 });
    assert!(beam.direct_ratios().iter().all(|ratio| *ratio > 0.99));
    let lambertian = crate::type_c(&steps(0.0, 90.0, 90), &[0.0], |_, gamma| 100.0 * gamma.to_radians().cos().max(0.0));
    // Two squares of side 2 a distance 1 apart (room index 1).
    close(lambertian.direct_ratios()[2], 0.4153, 2e-3);
}

#[test]
fn noise_does_not_raise_the_peak() {
    let runs = |intensity: fn(f64, f64) -> f64, symmetry: Symmetry| {
        let all = (0..50).map(|seed| {
            let reduced = measured(intensity, 0.5, seed).reduced(Some(symmetry)).unwrap();
            let figures = reduced.figures();
            [figures.peak.value, reduced.goniogram.peak(), figures.peak.error, figures.beam[0].spread.angle()]
        });
        all.fold([0.0; 4], |sum, one| std::array::from_fn(|k| sum[k] + one[k] / 50.0))
    };
    // 5 % of noise in each of 1728 directions.
    let [peak, greatest, error, _] = runs(|_, _| 100.0, Symmetry::None);
    assert!((peak - 100.0).abs() < 4.0 * error / 50.0_f64.sqrt() && greatest > 115.0, "{peak} ± {error}, {greatest}");
    let [peak, _, error, _] = runs(|_, _| 100.0, Symmetry::Rotational);
    assert!((peak - 100.0).abs() < 4.0 * error / 50.0_f64.sqrt(), "{peak} ± {error}");
    // A beam of 1000 cd: no more than an error below, never above.
    let [peak, greatest, error, beam] = runs(|_, gamma| lobe(gamma), Symmetry::None);
    assert!(peak < 1000.0 + error && peak > 1000.0 - 1.5 * error && greatest > 1000.0 + error, "{peak} ± {error}, {greatest}");
    close(beam, 2.0 * 0.5_f64.powf(0.25).acos().to_degrees(), 0.01);
}

#[test]
fn angles_without_an_end_have_no_error() {
    // Without a fall there is none, and what noise hides is not defined: never thousands of degrees.
    for (intensity, noise, seeds) in [((|_, _| 100.0) as fn(f64, f64) -> f64, 0.3, 5), (|_, gamma| 100.0 + 0.01 * gamma, 0.5, 5)] {
        for seed in 0..seeds {
            let figures = measured(intensity, noise, seed).reduced(None).unwrap().figures();
            for found in figures.beam.iter().chain(&figures.field) {
                assert!(found.error.is_none_or(|error| error <= 0.5 * found.spread.angle()), "{found:?}");
                assert_eq!((found.spread.open, found.error), ([true; 2], None), "{found:?}");
            }
        }
    }
    let figures = measured(|_, gamma| lobe(gamma), 0.3, 1).reduced(None).unwrap().figures();
    assert!(figures.beam.iter().all(|found| found.spread.open == [false; 2] && found.error.is_some_and(|error| error < 5.0)));
}

#[test]
fn beams_aside_are_told() {
    // A beam at C 60°, γ 40°, and one straight down.
    let towards = |c: f64, gamma: f64| {
        move |at: f64, g: f64| {
            let [a, b] = [(c, gamma), (at, g)].map(|(c, gamma)| PhotometricType::C.direction(c, gamma));
            1000.0 * (0..3).map(|k| a[k] * b[k]).sum::<f64>().max(0.0).powi(8)
        }
    };
    let reduced = measured(towards(60.0, 40.0), 0.1, 1).reduced(None).unwrap();
    let aside = reduced.figures().aside.unwrap();
    assert_eq!(aside.c, 60.0);
    // cos⁸ is a half at 23.5°.
    close(aside.beam.angle(), 2.0 * 0.5_f64.powf(0.125).acos().to_degrees(), 0.03);
    assert!(reduced.goniogram.figures().aside.is_some());
    for c in [0.0, 90.0, 270.0] {
        assert_eq!(measured(towards(c, 40.0), 0.1, 1).reduced(None).unwrap().figures().aside, None, "{c}");
    }
    assert_eq!(measured(|_, _| 100.0, 3.0, 1).reduced(None).unwrap().figures().aside, None);
}

#[test]
fn light_is_counted_apart_below_and_above() {
    let mut counted = whole();
    counted.flux_up = Some([0.25 * counted.flux, 0.001 * counted.flux]);
    let reduced = counted.reduced(None).unwrap();
    close(reduced.figures().downward_fraction.value, 0.75, 1e-12);
    close(reduced.figures().downward_fraction.error, 0.001, 1e-12);
    // The intensities have 1/6 of it above.
    let told: Vec<_> = reduced.goniogram.warnings.iter().map(|warning| warning.problem.as_str()).collect();
    assert!(told.len() == 1 && told[0].starts_with("75.0 % of the light was counted below the horizon"), "{told:?}");
}

#[test]
fn intensities_hold_no_more_than_was_sent() {
    let mut full = whole();
    full.source_flux = 0.999 * full.flux;
    full.flux = full.source_flux;
    let reduced = full.reduced(None).unwrap();
    close(reduced.goniogram.flux(), full.source_flux, 1e-12);
    assert_eq!(reduced.goniogram.stated.light_output_ratio, Some(1.0));
    assert!(ldt::read(&reduced.to_ldt()).unwrap().figures().light_output_ratio.unwrap() <= 1.0 + 1e-9);
}
