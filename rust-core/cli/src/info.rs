//! `gonio info`.

use super::{
    arguments::InfoOptions, explain, lamps_in_view, light_numbers, light_words::describe, messages::diagnostics_json, messages::print,
    photometry, render::stage_options, stage::Stage, volume, words::Words,
};
use gonio::{
    Diagnostic, Result,
    compile::{CompiledScene, compile},
    scene::{Field, Scene},
};
use gonio_usd::SampleTime;
use pyo3::prelude::*;
use serde_json::{Value, json};
use std::sync::atomic::AtomicBool;

/// Reads the stage, lays it out, and says what would be rendered; of a volume file, what grids it holds; of a GLDF or GDTF file, what its product is.
pub(super) fn info(py: Python<'_>, options: &InfoOptions, interrupted: &AtomicBool) -> Result<i32> {
    if volume::is_volume(&options.stage.stage) {
        return py.detach(|| volume::info(options));
    }
    if photometry::is_product(&options.stage.stage) {
        return py.detach(|| photometry::info(&options.stage.stage, options.json));
    }
    let mut stage_options = stage_options(&options.stage)?;
    // What is wrong is what is asked for here.
    stage_options.lenient = true;
    if let Some(frame) = options.frame {
        stage_options.time = SampleTime::Code(frame);
    }
    let stage = Stage::open(py, &options.stage.stage, &options.stage.state, &stage_options)?;
    let loaded = stage.load(py, &stage_options, interrupted)?;
    if let Some(path) = &options.explain {
        return explain::tell(py, &stage, &stage_options, &loaded, path);
    }
    let compiled = py.detach(|| compile(&loaded.scene, None, interrupted))?;
    let in_view = lamps_in_view::notes(py, &loaded, &compiled, interrupted)?;
    let diagnostics: Vec<&Diagnostic> = loaded.diagnostics.iter().chain(&compiled.diagnostics).chain(&in_view).collect();
    if options.json {
        print(&as_json(&loaded, &compiled, &diagnostics).to_string());
    } else {
        as_text(&loaded, &compiled, &diagnostics).iter().for_each(|line| print(line));
    }
    Ok(0)
}

fn as_json(loaded: &gonio_usd::Loaded, compiled: &CompiledScene, diagnostics: &[&Diagnostic]) -> Value {
    let s = &compiled.statistics;
    json!({
        "metres_per_unit": loaded.info.metres_per_unit,
        "up_axis": format!("{:?}", loaded.info.up_axis),
        "time_range": loaded.info.time_range,
        "cameras": loaded.info.cameras.iter().map(|camera| &camera.path).collect::<Vec<_>>(),
        "prims": loaded.info.prim_counts,
        "meshes": loaded.scene.meshes.len(),
        "triangles": s.triangles,
        "instances": s.instances,
        "materials": loaded.scene.materials.len(),
        "textures": loaded.scene.textures.len(),
        "volumes": loaded.scene.fields.iter().map(|field| &field.origin.name).collect::<Vec<_>>(),
        "geometry_bytes": s.geometry_bytes,
        "texture_bytes": s.texture_bytes,
        "bounds": if compiled.bounds.is_empty() { Value::Null } else { json!([compiled.bounds.min, compiled.bounds.max]) },
        "lights": light_numbers::lights(&loaded.scene),
        "emissive_materials": light_numbers::emissive_materials(&loaded.scene),
        "diagnostics": diagnostics_json(diagnostics.iter().copied()),
    })
}

fn as_text(loaded: &gonio_usd::Loaded, compiled: &CompiledScene, diagnostics: &[&Diagnostic]) -> Vec<String> {
    let (info, s) = (&loaded.info, &compiled.statistics);
    let mut lines = vec![format!("{} m a unit, {:?} up", info.metres_per_unit, info.up_axis)];
    if let Some([first, last]) = info.time_range {
        lines.push(format!("time codes {first} to {last}, {} a second", info.time_codes_per_second));
    }
    let prims: Vec<String> = info.prim_counts.iter().map(|(name, count)| format!("{count} {name}")).collect();
    lines.push(format!("prims: {}", if prims.is_empty() { "none".into() } else { prims.join(", ") }));
    lines.push(format!(
        "{} triangles in {} meshes, {} placed ({} triangles)",
        s.triangles,
        loaded.scene.meshes.len(),
        s.instances,
        s.instanced_triangles
    ));
    lines.push(format!("{} materials, {} textures", loaded.scene.materials.len(), loaded.scene.textures.len()));
    lines.push(format!("memory: {:.1} MB of geometry, {:.1} MB of textures", s.geometry_bytes as f64 / 1e6, s.texture_bytes as f64 / 1e6));
    if !compiled.bounds.is_empty() {
        lines.push(format!("bounds: {:.4?} to {:.4?} m", compiled.bounds.min, compiled.bounds.max));
    }
    lines.extend(volumes(&loaded.scene));
    lines.extend(info.cameras.iter().map(|camera| format!("camera {}", camera.path)));
    lines.extend(loaded.scene.lights.iter().map(|light| format!("light {}: {}", light.origin.name, describe(light, Words::english()))));
    lines.extend(emissive(&loaded.scene));
    lines.extend(diagnostics.iter().map(|d| format!("{}: {d}", if d.severity == gonio::Severity::Warning { "warning" } else { "note" })));
    lines
}

fn volumes(scene: &Scene) -> Vec<String> {
    let line = |field: &Field| {
        let heat = if field.heat.is_some() { ", with heat" } else { "" };
        let (bricks, blocks) = (field.density.bricks.len(), field.density.blocks.len());
        format!(
            "volume {}: {bricks} bricks and {blocks} even blocks of 8³ voxels, at most {:.4}{heat}",
            field.origin.name,
            field.density.most()
        )
    };
    scene.fields.iter().map(line).collect()
}

fn emissive(scene: &Scene) -> Vec<String> {
    let shining = scene.materials.iter().filter(|material| material.shines());
    shining.map(|material| format!("emissive material {}", material.origin.name)).collect()
}
