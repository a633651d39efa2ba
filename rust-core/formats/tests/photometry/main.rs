//! Goniograms: files written here, read, judged by closed forms, written and read again.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod bad_input;
mod data;
mod diagrams;
mod ies;
mod ldt;
mod measured;
mod plausible;
mod quantities;
mod round_trip;
mod tm33;
mod ugr;
mod zones;

use gonio_formats::photometry::{Goniogram, Symmetry, ies as ies_format};

/// An IES file with these numbers after a TILT=NONE line, under a version line.
fn ies_text(version: &str, head: &str, factors: &str, vertical: &[f64], horizontal: &[f64], candela: impl Fn(f64, f64) -> f64) -> String {
    let list = |values: &[f64]| values.iter().map(f64::to_string).collect::<Vec<_>>().join(" ");
    let mut text = format!("{version}\n[MANUFAC] test\n[LUMINAIRE] lamp\nTILT=NONE\n");
    let (v, h) = (vertical.len(), horizontal.len());
    text += &format!("{}\n{factors}\n{}\n{}\n", head.replace("V H", &format!("{v} {h}")), list(vertical), list(horizontal));
    for c in horizontal {
        text += &(list(&vertical.iter().map(|gamma| candela(*c, *gamma)).collect::<Vec<_>>()) + "\n");
    }
    text
}

/// A type C file of LM-63-2002, absolute, of a point.
fn type_c(vertical: &[f64], horizontal: &[f64], candela: impl Fn(f64, f64) -> f64) -> Goniogram {
    let text = ies_text("IESNA:LM-63-2002", "1 -1 1 V H 1 2 0 0 0", "1 1 20", vertical, horizontal, candela);
    ies_format::read(text.as_bytes()).unwrap()
}

/// Angles from one to another.
fn steps(from: f64, to: f64, count: usize) -> Vec<f64> {
    (0..=count).map(|index| from + (to - from) * index as f64 / count as f64).collect()
}

/// The flux by the midpoint rule over directions: independent of the closed form.
fn quadrature(goniogram: &Goniogram, below: bool) -> f64 {
    const ROWS: usize = 1800;
    // One plane repeated needs no more than a few.
    let columns = if goniogram.symmetry == Symmetry::Rotational { 4 } else { 720 };
    let step = std::f64::consts::PI / ROWS as f64;
    let mut sum = 0.0;
    for row in 0..if below { ROWS / 2 } else { ROWS } {
        let (r, z) = ((row as f64 + 0.5) * step).sin_cos();
        for column in 0..columns {
            let phi = (f64::from(column) + 0.5) * std::f64::consts::TAU / f64::from(columns);
            sum += r * goniogram.intensity([r * phi.cos(), r * phi.sin(), -z]);
        }
    }
    sum * step * std::f64::consts::TAU / f64::from(columns)
}

fn close(found: f64, expected: f64, relative: f64) {
    let difference = (found - expected).abs();
    assert!(difference <= relative * expected.abs().max(1e-12), "found {found}, expected {expected} within {relative}");
}
