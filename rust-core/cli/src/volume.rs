//! `gonio info` of volume files.

use super::{arguments::InfoOptions, file, messages::print};
use gonio::{Error, Result};
use gonio_formats::tame;
use gonio_volume::{GridInfo, Metadata, VolumeError, VolumeFile};
use serde_json::{Map, Value, json};
use std::path::Path;

/// Whether a file holds volume grids, by its content or, where that tells nothing, its name.
pub(super) fn is_volume(path: &Path) -> bool {
    file::start(path, 8).is_ok_and(|start| gonio_volume::is_volume_file(&start) || matches!(file::ending(path).as_str(), "vdb" | "nvdb"))
}

/// Says what grids a file holds, without reading their voxels.
pub(super) fn info(options: &InfoOptions) -> Result<i32> {
    let path = &options.stage.stage;
    if options.explain.is_some() || options.frame.is_some() {
        let option = if options.frame.is_some() { "--frame" } else { "--explain" };
        return Err(Error::setting(option, format!("{} holds volume grids, expected a USD stage", path.display())));
    }
    let wrong = |error: VolumeError| Error::Format { path: path.into(), line: None, problem: error.in_file() };
    let volume = gonio_volume::open(path).map_err(wrong)?;
    if options.json {
        print(&as_json(&volume).to_string());
    } else {
        // Names are the file's, and must not break the line.
        as_text(&volume).iter().for_each(|line| print(&tame(line)));
    }
    Ok(0)
}

/// Bytes of all grids that can be read, those that share their voxels counted once.
fn memory(volume: &VolumeFile) -> u64 {
    volume.grids().iter().filter(|grid| grid.refused.is_none() && grid.instance_of.is_none()).map(|grid| grid.memory).sum()
}

fn as_json(volume: &VolumeFile) -> Value {
    json!({
        "format": volume.format(),
        "memory_bytes": memory(volume),
        "grids": volume.grids().iter().map(grid_json).collect::<Vec<_>>(),
        "metadata": metadata_json(volume.metadata()),
        "notes": volume.notes(),
    })
}

fn grid_json(grid: &GridInfo) -> Value {
    json!({
        "name": grid.name,
        "type": grid.value_type,
        "class": grid.class.name(),
        "active_voxels": grid.active_voxels,
        "index_bounds": grid.bounds,
        "world_bounds": grid.world_bounds(),
        "voxel_size": grid.transform.map(|transform| transform.voxel_size()),
        "transform": grid.transform.map(|transform| transform.0),
        "bricks": grid.bricks,
        "tiles": grid.tiles,
        "memory_bytes": grid.memory,
        "compression": grid.compression,
        "instance_of": grid.instance_of,
        "metadata": metadata_json(&grid.metadata),
        "refused": grid.refused,
    })
}

fn metadata_json(metadata: &[(String, Metadata)]) -> Value {
    let value = |value: &Metadata| match value {
        Metadata::Text(text) => json!(text),
        Metadata::Flag(flag) => json!(flag),
        Metadata::Integer(integer) => json!(integer),
        Metadata::Real(real) => json!(real),
        Metadata::Integers(all) => json!(all),
        Metadata::Reals(all) => json!(all),
        Metadata::Other(kind, bytes) => json!(format!("{bytes} bytes of {kind}")),
    };
    Value::Object(metadata.iter().map(|(name, entry)| (name.clone(), value(entry))).collect::<Map<_, _>>())
}

fn as_text(volume: &VolumeFile) -> Vec<String> {
    let grids = volume.grids();
    let mut lines = vec![
        volume.format(),
        format!("{} grid{}, memory: {:.1} MB", grids.len(), if grids.len() == 1 { "" } else { "s" }, memory(volume) as f64 / 1e6),
    ];
    grids.iter().for_each(|grid| lines.extend(grid_lines(grid)));
    lines.extend(volume.notes().iter().map(|note| format!("note: {note}")));
    lines
}

fn grid_lines(grid: &GridInfo) -> Vec<String> {
    let shared = grid.instance_of.as_ref().map(|other| format!(", shares the voxels of {other}")).unwrap_or_default();
    let mut lines =
        vec![format!("grid {}: {}, {}, compression {}{shared}", grid.name, grid.value_type, grid.class.name(), grid.compression)];
    if let Some(problem) = &grid.refused {
        lines.push(format!("warning: grid {} cannot be read: {problem}", grid.name));
    }
    let counts = format!("{} active voxels, {} bricks, {} tiles", grid.active_voxels, grid.bricks, grid.tiles);
    lines.push(format!("  {counts}, memory: {:.1} MB", grid.memory as f64 / 1e6));
    if let Some([min, max]) = grid.bounds {
        lines.push(format!("  voxels {min:?} to {max:?}"));
    }
    if let (Some(transform), Some([min, max])) = (grid.transform, grid.world_bounds()) {
        lines.push(format!("  voxels of {:.4?}, bounds: {min:.4?} to {max:.4?}", transform.voxel_size()));
    }
    lines
}
