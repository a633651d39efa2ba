//! UDIM sets: one path with `<UDIM>` in it stands for the files with a tile's number in its place.

use std::path::{Path, PathBuf};

const TOKENS: [&str; 2] = ["<UDIM>", "<udim>"];

/// Whether a path names a set of tiles.
pub fn is_udim(pattern: &str) -> bool {
    split(pattern).is_some()
}

/// The path of one tile (1001 …); a path without the token as it is.
pub fn tile_path(pattern: &str, tile: u32) -> String {
    match split(pattern) {
        Some((before, after)) => format!("{before}{tile}{after}"),
        None => pattern.to_owned(),
    }
}

/// The tiles of a set that exist as files, by number. Empty where the folder cannot be read or the pattern has no token in its file name.
pub fn find_tiles(pattern: &str) -> Vec<(u32, PathBuf)> {
    let path = Path::new(pattern);
    let name = path.file_name().and_then(|name| name.to_str());
    let Some((before, after)) = name.and_then(split) else { return Vec::new() };
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or_else(|| Path::new("."));
    let Ok(entries) = std::fs::read_dir(folder) else { return Vec::new() };
    let mut tiles: Vec<_> = entries
        .filter_map(|entry| {
            let entry = entry.ok()?;
            let name = entry.file_name();
            let tile = tile_number(name.to_str()?.strip_prefix(before)?.strip_suffix(after)?)?;
            Some((tile, entry.path()))
        })
        .collect();
    tiles.sort();
    tiles
}

fn split(pattern: &str) -> Option<(&str, &str)> {
    TOKENS.iter().find_map(|token| pattern.split_once(token))
}

fn tile_number(digits: &str) -> Option<u32> {
    let four = digits.len() == 4 && digits.bytes().all(|byte| byte.is_ascii_digit());
    four.then(|| digits.parse().ok()).flatten().filter(|number| *number >= 1001)
}
