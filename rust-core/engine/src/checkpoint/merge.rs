//! From parts of a render, some samples of some tiles each, to the whole.

use super::{Checkpoint, Identity};
use crate::{
    error::{Error, Result},
    film::Film,
};
use std::{
    ops::Range,
    path::{Path, PathBuf},
};

/// Joins finished parts of one render, given in any order; samples and tiles must follow one another without gap or overlap, and all tiles be there.
///
/// From the first sample on, the sums are those of one render to the bit. Two films are in memory at a time, those so far and one part's.
pub fn merge(parts: &[PathBuf]) -> Result<Checkpoint> {
    let mut all = parts.iter().map(|path| Ok((path.as_path(), Checkpoint::read_identity(path)?))).collect::<Result<Vec<_>>>()?;
    let first_tile = |identity: &Identity| identity.stamp.settings.tile_range.map_or(0, |[first, _]| first);
    all.sort_by_key(|(_, identity)| (first_tile(identity), identity.stamp.settings.range().start));
    let mut whole: Option<Checkpoint> = None;
    for run in all.chunk_by(|(_, a), (_, b)| first_tile(a) == first_tile(b)) {
        let run: Vec<&Path> = run.iter().map(|(path, _)| *path).collect();
        let joined = join_samples(&run)?;
        match &mut whole {
            Some(whole) => join_tiles(whole, joined, run[0])?,
            None => whole = Some(joined),
        }
    }
    let mut whole = whole.ok_or_else(|| Error::setting("parts", "none were given"))?;
    check_all_tiles(&whole.film)?;
    whole.identity.stamp.settings.tile_range = None;
    Ok(whole)
}

/// Joins parts of the same tiles, in the order of their samples; there is at least one.
fn join_samples(parts: &[&Path]) -> Result<Checkpoint> {
    let mut whole = complete(parts[0])?;
    for path in &parts[1..] {
        let part = complete(path)?;
        whole.identity.stamp.check(&part.identity.stamp, path, &["sample_range"])?;
        check_follows("samples", &whole.film.range(), &part.film.range(), path)?;
        whole.film.join_samples(part.film);
    }
    let range = whole.film.range();
    whole.identity.stamp.settings.sample_range = Some([range.start, range.end]);
    Ok(whole)
}

/// Adds the tiles of `part`, whose first file is `path`.
fn join_tiles(whole: &mut Checkpoint, part: Checkpoint, path: &Path) -> Result<()> {
    whole.identity.stamp.check(&part.identity.stamp, path, &["tile_range", "sample_range"])?;
    let (before, after) = (whole.film.range(), part.film.range());
    if before != after {
        let problem = format!("samples {before:?} of the tiles before and {after:?} of these were found, expected the same");
        return Err(Error::Format { path: path.to_owned(), line: None, problem });
    }
    check_follows("tiles", &whole.film.tiles(), &part.film.tiles(), path)?;
    whole.film.join_tiles(part.film);
    Ok(())
}

/// A picture with holes is none; fewer samples than were asked for make one.
fn check_all_tiles(film: &Film) -> Result<()> {
    let (tiles, count) = (film.tiles(), film.tile_count() as u32);
    let missing = if tiles.start > 0 { 0..tiles.start } else { tiles.end..count };
    if missing.is_empty() {
        return Ok(());
    }
    Err(Error::setting("parts", format!("tiles {}:{} of {count} are missing", missing.start, missing.end)))
}

fn check_follows(what: &str, before: &Range<u32>, after: &Range<u32>, path: &Path) -> Result<()> {
    let (end, start) = (before.end, after.start);
    if start == end {
        return Ok(());
    }
    let found = if start > end { format!("{what} {end}:{start} are missing") } else { format!("{what} {start}:{end} are there twice") };
    Err(Error::Format { path: path.to_owned(), line: None, problem: format!("its {what} start at {start}: {found}") })
}

/// Reads a part that has all its samples.
fn complete(path: &Path) -> Result<Checkpoint> {
    let part = Checkpoint::read(path)?;
    if part.film.is_complete() {
        return Ok(part);
    }
    let problem = "this part of the render is not finished; gonio render --resume goes on with it".to_owned();
    Err(Error::Format { path: path.to_owned(), line: None, problem })
}
