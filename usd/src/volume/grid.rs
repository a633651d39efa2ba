//! Grids of files as lattices, each read once; those of the last reading are taken over by the next.

use super::Field;
use crate::asset;
use gonio::memory::room_for;
use gonio::scene::{Lattice, Transform};
use gonio_volume::{BRICK_VOXELS, GridClass, GridInfo, Storage, VolumeError, VolumeFile, from_bytes, open};
use pyo3::prelude::*;
use std::collections::HashMap;
use std::path::Path;
use std::sync::Arc;
use std::time::SystemTime;

/// A grid in memory.
#[derive(Debug)]
pub(crate) struct Grid {
    pub(super) lattice: Lattice,
    /// From the lattice to the file's space.
    pub(super) to_file: Transform,
}

/// The place of a file, its length and time, the grid's name and number.
type Key = (String, Option<(u64, SystemTime)>, String, usize);

/// A grid, or why it cannot be used.
type Outcome = Result<Arc<Grid>, String>;

/// The grids of this reading and of the last.
#[derive(Debug, Default)]
pub(crate) struct GridCache {
    now: HashMap<Key, Outcome>,
    last: HashMap<Key, Outcome>,
}

impl GridCache {
    /// For the next reading.
    pub(crate) fn next(self) -> Self {
        Self { now: HashMap::new(), last: self.now }
    }

    /// The grid of a field, whose numbers are densities or the like. The message names the file and says what is wrong with it.
    pub(super) fn grid(&mut self, py: Python<'_>, field: &Field) -> Outcome {
        let place = &field.file.resolved;
        let state = std::fs::metadata(place).ok().and_then(|found| Some((found.len(), found.modified().ok()?)));
        let key = (place.clone(), state, field.grid.clone(), field.index);
        if let Some(known) = self.now.get(&key) {
            return known.clone();
        }
        let outcome = self.last.remove(&key).unwrap_or_else(|| read(py, field).map(Arc::new));
        self.now.insert(key, outcome.clone());
        outcome
    }
}

/// The file of a field, and the number of its grid there.
fn located(py: Python<'_>, field: &Field) -> Result<(VolumeFile, usize), String> {
    let (authored, place) = (&field.file.authored, &field.file.resolved);
    if place.is_empty() {
        return Err(format!("the file '{authored}' does not exist"));
    }
    let listed = if Path::new(place).is_file() {
        py.detach(|| open(place))
    } else {
        // Within a package, or where the resolver has it.
        let bytes = asset::bytes(py, place).map_err(|problem| format!("the file '{place}' {problem}"))?;
        from_bytes(bytes, place)
    };
    let file = listed.map_err(|error| error.to_string())?;
    let number = number(&file, field)?;
    Ok((file, number))
}

/// The grid of a field as it is in its file.
pub(super) fn open_grid(py: Python<'_>, field: &Field) -> Result<gonio_volume::Grid, String> {
    let (file, number) = located(py, field)?;
    let info = &file.grids()[number];
    room_for(info.memory).map_err(|shortage| format!("{}: grid '{}' does not fit: {shortage}", file.name(), info.name))?;
    py.detach(|| file.read(number).map_err(|error| error.to_string()))
}

fn read(py: Python<'_>, field: &Field) -> Result<Grid, String> {
    let place = &field.file.resolved;
    let in_file = |error: VolumeError| error.to_string();
    let (file, number) = located(py, field)?;
    let info = &file.grids()[number];
    let wrong = |problem: String| format!("{place}: grid '{}' {problem}", info.name);
    if info.storage == Storage::Vector {
        return Err(wrong(format!("holds vectors ({}), expected numbers", info.value_type)));
    }
    if info.class == GridClass::LevelSet {
        return Err(wrong("is a level set, which holds distances; expected a fog volume, as vdb_tool and Houdini make of it".into()));
    }
    // The grid and the lattice, whose voxels have four bytes, are there together.
    room_for(info.memory.saturating_add(info.bricks.saturating_mul(4 * BRICK_VOXELS as u64)))
        .map_err(|shortage| wrong(format!("does not fit: {shortage}")))?;
    py.detach(|| {
        let grid = file.read(number).map_err(in_file)?;
        let lattice = Lattice::of_grid(&grid, None).map_err(|problem| format!("{place}: {problem}"))?;
        Ok(Grid { lattice, to_file: Transform::from_row_vector_matrix(&grid.transform.0) })
    })
}

/// The place of the grid that a field means.
fn number(file: &VolumeFile, field: &Field) -> Result<usize, String> {
    let named = |(_, info): &(usize, &GridInfo)| field.grid.is_empty() || info.name == field.grid;
    let found: Vec<usize> = file.grids().iter().enumerate().filter(named).map(|(number, _)| number).collect();
    found.get(field.index).copied().ok_or_else(|| {
        let names: Vec<&str> = file.grids().iter().map(|info| info.name.as_str()).collect();
        let wanted = match (field.grid.as_str(), field.index) {
            ("", index) => format!("no grid {index}"),
            (name, _) if found.is_empty() => format!("no grid '{name}'"),
            (name, index) => format!("no grid {index} of the name '{name}'"),
        };
        format!("{}: there is {wanted}; it has {}", file.name(), if names.is_empty() { "none".to_owned() } else { names.join(", ") })
    })
}
