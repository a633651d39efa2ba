//! Closed forms, mirrored roads, bad input. `tests/cli/test_road_cli.py` holds whole roads to a second program.

mod bad_input;
mod closed_forms;
mod glare;
mod mirrors;
mod surfaces;

use crate::{Reach, Road, Row, Side, Standard, Surface};
use gonio_formats::photometry::{Goniogram, ies};
use std::sync::Arc;

/// A luminaire whose intensity by C and γ in degrees is told by a function; planes every 15°, angles every 5°. C90 faces the carriageway.
fn luminaire(candela: impl Fn(f64, f64) -> f64) -> Arc<Goniogram> {
    let list = |count: u32, step: f64| (0..count).map(|index| f64::from(index) * step).collect::<Vec<_>>();
    let (planes, gammas) = (list(25, 15.0), list(37, 5.0));
    let line = |values: &[f64]| values.iter().map(ToString::to_string).collect::<Vec<_>>().join(" ");
    let rows: Vec<String> =
        planes.iter().map(|c| line(&gammas.iter().map(|gamma| candela(c % 360.0, *gamma)).collect::<Vec<_>>())).collect();
    let text = format!(
        "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 {} {} 1 2 0 0 0\n1 1 60\n{}\n{}\n{}\n",
        gammas.len(),
        planes.len(),
        line(&gammas),
        line(&planes),
        rows.join("\n")
    );
    Arc::new(ies::read(text.as_bytes()).expect("a luminaire"))
}

fn row(goniogram: Arc<Goniogram>, side: Side) -> Row {
    Row {
        luminaire: "lamp.ies".into(),
        goniogram,
        spacing: 30.0,
        height: 8.0,
        overhang: 1.0,
        tilt: 0.0,
        orientation: 0.0,
        front: 90.0,
        side,
        offset: 0.0,
        maintenance_factor: 0.8,
        power: Some(60.0),
    }
}

fn road(rows: Vec<Row>) -> Road {
    Road {
        carriageway_width: 7.0,
        lanes: 2,
        surface: Surface::lambert(0.2),
        wet: None,
        standard: Standard::En13201,
        observer_age: 23.0,
        edge_strip: 3.5,
        reach: Reach::default(),
        rows,
        footpaths: Vec::new(),
        required: Vec::new(),
        classes: Vec::new(),
        periods: Vec::new(),
        ranges: None,
    }
}

fn close(found: f64, expected: f64, relative: f64) {
    assert!((found - expected).abs() <= relative * expected.abs(), "{found} is not {expected}");
}
