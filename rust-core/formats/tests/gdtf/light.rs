//! Fixtures and their light: what the file states comes back, and closed forms.

use crate::{DESCRIPTION, fixture, packed};
use gonio_formats::gdtf::{BeamKind, Gdtf};
use gonio_formats::photometry::{Goniogram, ies, ldt, read};
use std::f64::consts::{LN_2, PI};

fn close(found: f64, expected: f64, relative: f64) {
    assert!((found / expected - 1.0).abs() <= relative, "found {found}, expected {expected} within {relative}");
}

fn light(mode: usize) -> Goniogram {
    let fixture = fixture();
    fixture.goniogram(&fixture.modes[mode]).unwrap()
}

fn told(found: &Goniogram) -> String {
    found.warnings.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
}

/// A fixture of one beam.
fn beam(attributes: &str) -> Goniogram {
    let text = format!(
        "<GDTF><FixtureType><Geometries><Geometry Name=\"g\"><Beam Name=\"b\" {attributes}/></Geometry></Geometries>\
         <DMXModes><DMXMode Name=\"m\" Geometry=\"g\"/></DMXModes></FixtureType></GDTF>"
    );
    read(&packed(&text), "a.gdtf").unwrap()
}

#[test]
fn a_fixture_says_what_it_has() {
    let fixture = fixture();
    assert_eq!((fixture.manufacturer.as_str(), fixture.name.as_str(), fixture.version.as_str()), ("ACME", "Moving Head 20", "1.2"));
    assert_eq!((fixture.warnings.as_slice(), fixture.modes.len()), (&[][..], 4));
    let beam = &fixture.modes[0].beams[0];
    assert_eq!((beam.kind, beam.flux, beam.beam_deg, beam.field_deg, beam.radius), (BeamKind::Fresnel, 12_000.0, 20.0, 40.0, 0.025));
    assert_eq!((beam.temperature, beam.rendering, beam.watts, beam.emitter), (6500.0, Some(75.0), Some(350.0), Some(0)));
    assert_eq!((beam.direction, beam.unstated.as_slice()), ([0.0, 0.0, -1.0], &[][..]));
    // The greatest drive counts, and wavelengths are in order.
    assert_eq!(fixture.emitters[0].spectrum, [(380.0, 0.5), (780.0, 1.0)]);
    assert_eq!((fixture.emitters[0].chromaticity, fixture.emitters[1].spectrum.len()), (Some([0.3127, 0.329]), 0));
    let [panel, tube] = [1, 0].map(|beam| &fixture.modes[2].beams[beam]);
    assert_eq!((panel.kind, tube.kind, panel.flux), (BeamKind::Rectangle(1.5), BeamKind::Glow, 10_000.0));
}

#[test]
fn flux_and_both_angles_are_the_files() {
    let found = light(0);
    let figures = found.figures();
    close(figures.flux, 12_000.0, 1e-12);
    for plane in 0..2 {
        close(figures.beam[plane].angle(), 20.0, 1e-9);
        close(figures.field[plane].angle(), 40.0, 1e-9);
    }
    assert_eq!((figures.watts, found.lamps().unwrap().colour.as_str(), found.opening.size), (Some(350.0), "6500 K", [0.05, 0.05, 0.0]));
    assert_eq!(found.warnings.len(), 1, "{}", told(&found));
    assert!(told(&found).starts_with("GDTF holds no measured light distribution: this is an estimate"), "{}", told(&found));
    for again in [ies::read(&ies::write(&found)).unwrap(), ldt::read(&ldt::write(&found)).unwrap()] {
        close(again.flux(), 12_000.0, 1e-5);
    }
}

#[test]
fn a_gaussian_has_its_closed_peak() {
    // exp(−ln 2 (θ/θ½)²) of small angles has the flux π I θ½² / ln 2; a field angle of √(log₂ 10) beam angles makes it one.
    let field = 4.0 * (10f64.ln() / LN_2).sqrt();
    let found = beam(&format!("LuminousFlux=\"1000\" BeamAngle=\"4\" FieldAngle=\"{field}\""));
    close(found.peak(), 1000.0 * LN_2 / (PI * 2f64.to_radians().powi(2)), 2e-3);
}

#[test]
fn the_flux_is_that_of_the_curve_by_another_sum() {
    // The table's peak against the curve's own, by the midpoint rule on 200 000 rings.
    for (beam_deg, field_deg) in [(20.0f64, 40.0), (8.0, 9.0), (60.0, 100.0), (5.0, 30.0)] {
        let found = beam(&format!("LuminousFlux=\"1000\" BeamAngle=\"{beam_deg}\" FieldAngle=\"{field_deg}\""));
        let exponent = (10f64.ln() / LN_2).ln() / (field_deg / beam_deg).ln();
        let step = PI / 200_000.0;
        let ring = |theta: f64| 2.0 * PI * theta.sin() * step * (-LN_2 * (2.0 * theta.to_degrees() / beam_deg).powf(exponent)).exp();
        let unit: f64 = (0..200_000).map(|place| ring((f64::from(place) + 0.5) * step)).sum();
        close(found.peak(), 1000.0 / unit, 2e-3);
    }
}

#[test]
fn beams_without_a_field_have_hard_edges() {
    let found = beam("LuminousFlux=\"1000\" BeamAngle=\"30\" FieldAngle=\"30\"");
    // Even within the cone: Φ / 2π(1 − cos θ½), but for the edge.
    close(found.peak(), 1000.0 / (2.0 * PI * (1.0 - 15f64.to_radians().cos())), 0.01);
    close(found.figures().beam[0].angle(), 30.0, 1e-9);
    assert!(told(&found).contains("the field angle 30° is not beyond the beam angle 30°"), "{}", told(&found));
}

#[test]
fn wide_and_narrow_beams_keep_their_flux() {
    for angles in [
        "BeamAngle=\"0.1\" FieldAngle=\"0.2\"",
        "BeamAngle=\"180\" FieldAngle=\"180\"",
        "BeamAngle=\"360\" FieldAngle=\"360\"",
        "BeamAngle=\"90\" FieldAngle=\"175\"",
    ] {
        let found = beam(&format!("LuminousFlux=\"500\" {angles}"));
        close(found.flux(), 500.0, 1e-9);
        assert!(found.intensities.iter().all(|value| value.is_finite() && *value >= 0.0), "{angles}");
    }
}

#[test]
fn references_add_up() {
    let bar = light(1);
    close(bar.flux(), 36_000.0, 1e-9);
    assert_eq!(bar.figures().watts, Some(1050.0));
    let told = told(&bar);
    assert!(told.contains("the sum of 3 beams, and leaves at one place") && told.contains("look in different directions"), "{told}");
    // The third is turned by 90° about x: −z becomes y.
    let direction = fixture().modes[1].beams[2].direction;
    assert!(direction.iter().zip([0.0, 1.0, 0.0]).all(|(found, expected)| (found - expected).abs() < 1e-12), "{direction:?}");
}

#[test]
fn what_is_not_stated_is_the_formats_own() {
    let sign = light(2);
    close(sign.flux(), 10_000.0, 1e-9);
    let told = told(&sign);
    assert!(told.contains("does not state BeamAngle, BeamRadius, ColorTemperature, FieldAngle, LuminousFlux"), "{told}");
    assert!(told.contains("the beam 'Panel' is a rectangle, and round here"), "{told}");
    assert_eq!(sign.figures().watts, None);
}

#[test]
fn beams_of_several_kinds_are_summed() {
    let text = DESCRIPTION.replace(
        "<Geometry Name=\"Dark\"/>",
        "<Geometry Name=\"Dark\"><Beam Name=\"a\" LuminousFlux=\"100\" BeamAngle=\"10\" FieldAngle=\"12\"/>\
        <Beam Name=\"b\" LuminousFlux=\"300\" BeamAngle=\"50\" FieldAngle=\"80\"/></Geometry>",
    );
    let found = read(&packed(&text), "a.gdtf#dark").unwrap();
    close(found.flux(), 400.0, 1e-6);
    assert!(told(&found).contains("the sum of 2 beams, of 2 kinds"), "{}", told(&found));
}

#[test]
fn modes_are_chosen_by_name_or_number() {
    let fixture = fixture();
    for (asked, expected) in [(None, 0), (Some("bar"), 1), (Some("3"), 2), (Some(" Dark "), 3)] {
        assert_eq!(fixture.mode(asked), Ok(expected));
    }
    let problem = fixture.mode(Some("7")).unwrap_err().problem;
    assert!(problem.starts_with("no mode '7' was found among 4: 'Standard', 'Bar', 'Sign', 'Dark'"), "{problem}");
    close(read(&packed(DESCRIPTION), "lamp.gdtf#bar").unwrap().flux(), 36_000.0, 1e-9);
    assert!(Gdtf::read(&packed("<GDTF><FixtureType/></GDTF>")).unwrap().mode(None).unwrap_err().problem.contains("no mode"));
}
