//! What a measured material's file holds, for machines and for people.

use super::Loaded;
use gonio_formats::bsdf::{Axis, Channels, Figures, FromDirection, Measured, Mode, Patches, Reciprocity, Rgl, Share, Table, TensorTree};
use serde_json::{Value, json};
use std::path::Path;

/// Everything about the file. The text is made of it.
pub(super) fn as_json(path: &Path, loaded: &Loaded) -> Value {
    let measured = &loaded.measured;
    let Figures { albedo, reciprocity, problems } = measured.figures();
    let wavelengths = match measured.channels() {
        Channels::Bands { wavelengths_nm } => json!(wavelengths_nm),
        _ => Value::Null,
    };
    let (kind, parts) = match measured {
        Measured::Tables(tables) => ("tables", tables.iter().map(table).collect()),
        Measured::Rgl(rgl) => ("adaptive measurement", vec![adaptive(rgl)]),
        Measured::Patches(patches) => ("matrices over patches", matrices(patches)),
        Measured::Tree(tree) => ("tensor trees", trees(tree)),
    };
    json!({
        "file": path.to_string_lossy(),
        "format": loaded.format.name(),
        "kind": kind,
        "isotropic": measured.is_isotropic(),
        "channels": measured.channels().name(),
        "wavelengths_nm": wavelengths,
        "parts": parts,
        "albedo": albedo.iter().map(from_direction).collect::<Vec<_>>(),
        "reciprocity": reciprocity.map(exchanged),
        "problems": problems,
    })
}

fn table(table: &Table) -> Value {
    let layout = table.layout();
    let axes = layout.coordinates.axis_names().iter().zip(&layout.axes);
    json!({
        "hemispheres": layout.hemispheres.name(),
        "coordinates": layout.coordinates.name(),
        "axes": axes.map(|(name, found)| axis(name, found)).collect::<Vec<_>>(),
        "reciprocal": layout.reciprocal,
        "bilateral": layout.bilateral,
        "cells": table.values().len() / layout.channels.count(),
        "cells_without_value": table.invalid_cells(),
    })
}

fn axis(name: &str, axis: &Axis) -> Value {
    let mode = match axis.mode() {
        Mode::Linear => "linear",
        Mode::Nearest => "nearest",
        Mode::Periodic { .. } => "periodic",
    };
    knots(name, mode, axis.knots().iter().copied())
}

/// An axis of angles in radians, told by their number and their ends.
fn knots(name: &str, mode: &str, radians: impl ExactSizeIterator<Item = f64> + Clone) -> Value {
    let rounded = |x: f64| (x.to_degrees() * 1e6).round() / 1e6;
    let (first, last) = (radians.clone().next().unwrap_or(0.0), radians.clone().last().unwrap_or(0.0));
    json!({ "name": name, "mode": mode, "count": radians.len(), "first_deg": rounded(first), "last_deg": rounded(last) })
}

fn adaptive(rgl: &Rgl) -> Value {
    let angles = |name: &str, found: &[f32]| knots(name, "linear", found.iter().map(|x| f64::from(*x)));
    json!({
        "hemispheres": "reflection-front",
        "description": rgl.description,
        "axes": [angles("phi_o", rgl.phi_knots()), angles("theta_o", rgl.theta_knots())],
        "symmetry": rgl.reduction(),
        "nodes": [rgl.spectra.columns, rgl.spectra.rows],
        "nodes_of_normals": [rgl.vndf.density.columns, rgl.vndf.density.rows],
    })
}

fn matrices(patches: &Patches) -> Vec<Value> {
    let part = |matrix: &gonio_formats::bsdf::Matrix| {
        let [incident, outgoing] = [matrix.incident, matrix.outgoing].map(|basis| &patches.bases()[basis]);
        json!({
            "hemispheres": matrix.hemispheres.name(),
            "band": format!("{:?}", matrix.band),
            "incident_basis": incident.name,
            "outgoing_basis": outgoing.name,
            "patches": [incident.count(), outgoing.count()],
            "totals": patches.totals(matrix),
        })
    };
    patches.matrices().iter().map(part).collect()
}

fn trees(tree: &TensorTree) -> Vec<Value> {
    let part = |component: &gonio_formats::bsdf::Component| {
        json!({
            "hemispheres": component.hemispheres.name(),
            "band": format!("{:?}", component.band),
            "rank": component.tree.rank,
            "nodes": component.tree.first.len(),
            "cells": component.tree.values.len(),
        })
    };
    tree.components().iter().map(part).collect()
}

fn from_direction(row: &FromDirection) -> Value {
    let share = |share: Share| json!({ "luminance": share.luminance, "rgb": share.rgb });
    json!({
        "from": if row.from_front { "front" } else { "back" },
        "theta_deg": row.theta_deg,
        "phi_deg": row.phi_deg,
        "reflected": share(row.reflected),
        "transmitted": share(row.transmitted),
    })
}

fn exchanged(found: Reciprocity) -> Value {
    json!({ "pairs": found.pairs, "mean_difference": found.mean_difference, "largest_difference": found.largest_difference })
}

/// The description in lines.
pub(super) fn as_text(description: &Value) -> Vec<String> {
    let isotropic = if description["isotropic"] == true { "isotropic" } else { "anisotropic" };
    let word = |key: &str| description[key].as_str().unwrap_or_default().to_owned();
    let mut lines = vec![format!("{}: {}, {isotropic}, {}", word("format"), word("kind"), word("channels"))];
    lines.extend(list(&description["parts"]).iter().flat_map(part));
    lines.extend(albedo(list(&description["albedo"])));
    let found = &description["reciprocity"];
    if let (Some(mean), Some(largest)) = (found["mean_difference"].as_f64(), found["largest_difference"].as_f64()) {
        let pairs = &found["pairs"];
        let (mean, largest) = (100.0 * mean, 100.0 * largest);
        lines.push(format!("light and view exchanged: {mean:.2} % of difference on average, {largest:.1} % at most ({pairs} pairs)"));
    }
    lines.extend(list(&description["problems"]).iter().filter_map(|problem| Some(format!("problem: {}", problem.as_str()?))));
    lines
}

fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

/// A table, a matrix or a tree, and its axes.
fn part(part: &Value) -> Vec<String> {
    let word = |key: &str| part[key].as_str().unwrap_or_default();
    let flag = |key: &str| if part[key] == true { format!(", {key}") } else { String::new() };
    let mut lines = Vec::new();
    let head = word("hemispheres");
    if let Some(cells) = part["cells_without_value"].as_u64() {
        let flags = flag("reciprocal") + &flag("bilateral");
        lines.push(format!("{head}: {}{flags}, {} cells, {cells} of them without a value", word("coordinates"), part["cells"]));
    } else if part["rank"].is_u64() {
        lines.push(format!("{head}, {}: rank {}, {} cells in {} nodes", word("band"), part["rank"], part["cells"], part["nodes"]));
    } else if let [incident, outgoing] = list(&part["patches"]) {
        let totals = list(&part["totals"]).iter().filter_map(Value::as_f64);
        let [least, most] = [totals.clone().fold(f64::INFINITY, f64::min), totals.fold(0.0, f64::max)];
        let bases = format!("{} ({incident}) to {} ({outgoing})", word("incident_basis"), word("outgoing_basis"));
        lines.push(format!("{head}, {}: {bases}, totals {least:.4} to {most:.4}", word("band")));
    } else if let [columns, rows] = list(&part["nodes"]) {
        lines.push(format!("{head}: {columns} × {rows} nodes for each angle of view; {}", word("description").trim()));
    }
    lines.extend(list(&part["axes"]).iter().map(|axis| {
        let (name, mode) = (axis["name"].as_str().unwrap_or_default(), axis["mode"].as_str().unwrap_or_default());
        let [first, last] = ["first_deg", "last_deg"].map(|end| axis[end].as_f64().unwrap_or(0.0));
        format!("  {name}: {} angles, {first}° to {last}°, {mode}", axis["count"])
    }));
    lines
}

/// Albedo, a line for each side and azimuth.
fn albedo(rows: &[Value]) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for kind in ["reflected", "transmitted"] {
        let luminance = |row: &Value| row[kind]["luminance"].as_f64().unwrap_or(0.0);
        let mut keys: Vec<(&str, f64)> = Vec::new();
        for row in rows {
            let key = (row["from"].as_str().unwrap_or_default(), row["phi_deg"].as_f64().unwrap_or(0.0));
            if !keys.contains(&key) {
                keys.push(key);
            }
        }
        for (from, phi) in keys {
            let of = rows.iter().filter(|row| row["from"] == from && row["phi_deg"].as_f64() == Some(phi));
            if of.clone().any(|row| luminance(row) > 0.0) {
                let shares = of.map(|row| format!("{}° {:.3}", row["theta_deg"].as_f64().unwrap_or(0.0), luminance(row)));
                lines.push(format!("{kind} of light from the {from} at φ {phi}°: {}", shares.collect::<Vec<_>>().join(", ")));
            }
        }
    }
    lines
}
