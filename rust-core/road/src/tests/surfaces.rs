//! r-tables and measured materials.

use super::{close, luminaire, road, row};
use crate::{Material, Side, Standard, Surface, Table};
use std::f64::consts::PI;

/// The table of a Lambertian surface.
fn diffuse(reflectance: f64, tangents: &[f64]) -> Table {
    let r = |tangent: f64| 1e4 * reflectance / PI * (1.0 + tangent * tangent).powf(-1.5);
    let rows: String = tangents.iter().map(|tangent| format!("{tangent} {0} {0} {0}\n", r(*tangent))).collect();
    Table::read(format!("# diffuse\ntan 0 90 180\n{rows}").as_bytes()).expect("a table")
}

#[test]
fn a_table_of_a_diffuse_surface_is_one() {
    let tangents: Vec<f64> = (0..=900).map(|index| 20.0 * (f64::from(index) / 900.0).powi(2)).collect();
    let mut road = road(vec![row(luminaire(|_, _| 1000.0), Side::Right)]);
    let exact = road.evaluate();
    for standard in [Standard::En13201, Standard::Cie140] {
        road.surface = Surface::table("diffuse", diffuse(0.2, &tangents));
        road.standard = standard;
        let found = road.evaluate();
        close(found.l_av, exact.l_av, 1e-4);
        close(found.uo.expect("light"), exact.uo.expect("light"), 1e-4);
    }
    close(road.surface.figures.q0, 0.2 / PI, 1e-4);
    close(exact.surface.q0, 0.2 / PI, 1e-12);
}

#[test]
fn between_nodes_values_are_linear_or_parabolas() {
    let text = "0;30;90;180\n0;100;80;40;20\n1;60;50;30;-\n2;30;20;10;5\n4;10;8;4;1\n";
    let table = Table::read(text.as_bytes()).expect("a table");
    for standard in [Standard::En13201, Standard::Cie140] {
        close(table.reduced(30.0, 1.0, standard), 50e-4, 1e-12);
        close(table.reduced(-90.0, 2.0, standard), 10e-4, 1e-12);
        assert_eq!(table.reduced(0.0, 4.01, standard), 0.0);
    }
    close(table.reduced(60.0, 0.5, Standard::En13201), 50e-4, 1e-12);
    // tan γ 0.5 lies as near to 0 as to 1: the parabola through 0, 1, 2 at β 0 is 100 − 45 t + 5 t².
    close(table.reduced(0.0, 0.5, Standard::Cie140), 78.75e-4, 1e-12);
    close(table.reduced(0.0, 0.2, Standard::Cie140), 91.2e-4, 1e-12);
}

#[test]
fn a_factor_sets_the_mean() {
    let table = diffuse(0.2, &[0.0, 1.0, 2.0, 4.0, 14.0]);
    let before = Surface::table("d", table.clone()).figures.q0;
    close(Surface::table("d", table.times(0.07 / before)).figures.q0, 0.07, 1e-12);
}

#[test]
fn a_table_that_ends_early_is_told() {
    let mut road = road(vec![row(luminaire(|_, _| 1000.0), Side::Right)]);
    road.surface = Surface::table("short.txt", diffuse(0.2, &[0.0, 1.0, 5.0]));
    assert!(road.evaluate().notes.iter().any(|note| note.contains("short.txt: the table ends at tan γ 5")));
}

#[test]
fn a_measured_material_is_seen_at_one_degree() {
    let read = |text: &str| Surface::material("m", Material::read(text.as_bytes(), "m").expect("a format").expect("a material"));
    let lambert = read(
        "gbsdf 1\ntable reflection-front isotropic\naxis theta_i linear 2\n0 90\naxis theta_o linear 2\n0 90\naxis delta_phi linear 1\n0\nvalues text\n0.1 0.1 0.1 0.1\nend\n",
    );
    let expected = Surface::lambert(0.1 * PI);
    for (beta, tangent) in [(0.0, 0.0), (30.0, 1.5), (180.0, 12.0)] {
        close(lambert.reduced(beta, tangent, Standard::Cie140), expected.reduced(beta, tangent, Standard::Cie140), 1e-6);
    }
    close(lambert.figures.q0, 0.1, 1e-6);
    // β = 0 is light from beyond the point, which goes on to the eye: φo − φi = 180°. The eye's θo is 89°.
    let glossy = read(
        "gbsdf 1\ntable reflection-front isotropic\nbilateral yes\naxis theta_i linear 1\n0\naxis theta_o linear 2\n0 90\naxis delta_phi linear 2\n0 180\nvalues text\n0 0 0.9 9\nend\n",
    );
    for (beta, value) in [(0.0, 9.0), (180.0, 0.9), (90.0, 4.95)] {
        close(glossy.reduced(beta, 2.0, Standard::En13201), value * 89.0 / 90.0 / 5.0_f64.powf(1.5), 1e-6);
    }
}
