//! Measured materials as `.gbsdf`, matrices and tensor trees as XML.

use super::{BsdfOptions, ending, put};
use gonio::{Error, Result};
use gonio_formats::bsdf::{
    Direction, Grid, Measured,
    gbsdf::{self, Encoding},
    xml,
};
use serde_json::{Value, json};
use std::path::Path;

/// Pairs of directions that a resampled file is compared with its source at.
const PAIRS: u32 = 2000;

/// Writes the file; tables as they are unless a grid was asked for, everything else evaluated on one. Says how.
pub(super) fn convert(options: &BsdfOptions, measured: &Measured, title: &str, path: &Path) -> Result<Value> {
    if ending(path) == "xml" {
        let text = match measured {
            Measured::Patches(patches) => xml::write_patches(patches, title),
            Measured::Tree(tree) => xml::write_tree(tree, title),
            _ => return Err(Error::setting("output", "only matrices and tensor trees are written as XML, expected .gbsdf")),
        };
        put(path, text.as_bytes())?;
        return Ok(json!({ "format": "xml" }));
    }
    let encoding = if options.text { Encoding::Text } else { Encoding::Binary };
    let (tables, report) = match (measured, &options.grid) {
        (Measured::Tables(tables), None) => (tables.clone(), json!({ "resampled": false })),
        (_, grid) => {
            let asked = |place: usize| grid.as_ref().and_then(|grid| grid.get(place)).map(|count| *count as usize);
            let grid = Grid::new(measured, asked(0), asked(1));
            let tables = measured.resampled(grid).map_err(|error| Error::setting("grid", error.problem))?;
            let difference = mean_difference(measured, &Measured::Tables(tables.clone()));
            (tables, json!({ "resampled": true, "theta": grid.theta, "phi": grid.phi, "mean_difference": difference }))
        }
    };
    put(path, &gbsdf::write(&tables, title, encoding))?;
    Ok(report)
}

/// How far the one is from the other: the sum of differences of luminance over the sum of luminances, at directions spread evenly over both
/// hemispheres (Roberts' R₄).
fn mean_difference(source: &Measured, copy: &Measured) -> f64 {
    let direction = |u: f64, v: f64| -> Direction {
        let z = 2.0 * u - 1.0;
        let (sine, phi) = ((1.0 - z * z).max(0.0).sqrt(), std::f64::consts::TAU * v);
        [sine * phi.cos(), sine * phi.sin(), z]
    };
    let (mut difference, mut sum) = (0.0, f64::MIN_POSITIVE);
    for i in 1..=PAIRS {
        let u = [0.856_674_9, 0.733_891_9, 0.628_706_7, 0.538_597_3].map(|step: f64| (step * f64::from(i)).fract());
        let (wi, wo) = (direction(u[0], u[1]), direction(u[2], u[3]));
        let luminance = source.eval_luminance(wi, wo);
        difference += (copy.eval_luminance(wi, wo) - luminance).abs();
        sum += luminance;
    }
    difference / sum
}

/// The conversion in a line.
pub(super) fn as_text(report: &Value) -> Option<String> {
    let difference = report["mean_difference"].as_f64();
    match report["resampled"].as_bool()? {
        false => Some("converted: the file's own tables".into()),
        true => {
            let difference = 100.0 * difference.unwrap_or(0.0);
            let (theta, phi) = (&report["theta"], &report["phi"]);
            Some(format!("converted: evaluated at {theta} polar angles and {phi} azimuths, {difference:.2} % of difference on average"))
        }
    }
}
