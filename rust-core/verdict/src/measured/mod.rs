//! What was measured: the figures of files that gonio's commands print as JSON.

mod annual;
mod area;
mod colour;
mod emergency;
mod eyes;
mod grids;
mod lit;
mod modelling;
mod object;
mod road;
mod sports;
mod table;
mod view_out;
mod zones;

pub(crate) use area::{Area, Figure};

use crate::{
    error::VerdictError,
    names::{OTHER_CAPITALS, fit, listed, nearest, shown},
};
use gonio_formats::FormatError;
use object::{EXPECTED, Found, no_json};
use serde_json::Value;
use sha2::{Digest, Sha256};
use std::path::{Path, PathBuf};

/// A file that was read.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Source {
    pub(crate) path: PathBuf,
    pub(crate) sha256: String,
}

impl Source {
    pub(crate) fn new(path: &Path, bytes: &[u8]) -> Self {
        let sha256 = Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect();
        Self { path: path.into(), sha256 }
    }
}

/// The figures of all files.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Measured {
    pub(crate) sources: Vec<Source>,
    pub(crate) areas: Vec<Area>,
}

impl Measured {
    /// Reads what `gonio measure`, `gonio annual`, `gonio annual-metrics`, `gonio view-out`, `gonio road`, `gonio emergency`, `gonio sports` and `gonio zones`
    /// print with `--json`.
    ///
    /// # Errors
    /// Bytes that are no JSON, or not that of one of these commands, with the file and what was found.
    pub fn read(files: &[(PathBuf, Vec<u8>)]) -> Result<Self, VerdictError> {
        let mut measured = Self::default();
        for (number, (path, bytes)) in files.iter().enumerate() {
            let areas = areas(bytes, number).map_err(|error| VerdictError::new(path, error))?;
            measured.areas.extend(areas);
            measured.sources.push(Source::new(path, bytes));
        }
        modelling::add(&mut measured.areas);
        Ok(measured)
    }
}

impl Measured {
    /// The areas that somebody may mean by a name, with their numbers and how well they fit; capitals count where any fits with them.
    pub(crate) fn meant(&self, written: &str) -> Vec<(usize, &Area, u8)> {
        let fits = |area: &Area| std::iter::once(&area.name).chain(&area.aliases).filter_map(|name| fit(written, name)).min();
        let all = || self.areas.iter().enumerate().filter_map(|(number, area)| Some((number, area, fits(area)?)));
        let capitals = all().any(|(.., fit)| fit < OTHER_CAPITALS);
        all().filter(|(.., fit)| !capitals || *fit < OTHER_CAPITALS).collect()
    }

    /// The number of the file that somebody wrote, or what to tell of it.
    pub(crate) fn file(&self, written: &str) -> Result<usize, String> {
        let paths: Vec<String> = self.sources.iter().map(|source| source.path.to_string_lossy().into_owned()).collect();
        let fits = |path: &String| fit(written, path).is_some_and(|fit| fit < OTHER_CAPITALS);
        paths.iter().position(fits).ok_or_else(|| {
            let known = || paths.iter().map(String::as_str);
            let hint = nearest(written, known()).map_or(String::new(), |nearest| format!("; did you mean '{}'?", shown(nearest)));
            format!("file '{}' is none of those given: {}{hint}", shown(written), listed(known()))
        })
    }
}

fn areas(bytes: &[u8], file: usize) -> Found<Vec<Area>> {
    let whole: Value = serde_json::from_slice(bytes).map_err(|error| no_json(bytes, &error))?;
    let Value::Object(whole) = whole else {
        return Err(FormatError::whole(format!("no object of JSON, {EXPECTED}")));
    };
    let has = |key: &str| whole.contains_key(key);
    if has("share_of_points") && has("meters") {
        view_out::read(&whole, file)
    } else if has("meters") && has("grids") {
        grids::read(&whole, file)
    } else if has("weather") && has("grids") {
        annual::read(&whole, file)
    } else if has("l_av") && has("observers") {
        Ok(road::read(&whole, file))
    } else if has("routes") && has("luminaires") {
        emergency::read(&whole, file)
    } else if has("fields") && has("observers") {
        sports::read(&whole, file)
    } else if has("rooms") && has("tasks") {
        zones::read(&whole, file)
    } else {
        let found = listed(whole.keys().map(String::as_str));
        let found = if found.is_empty() { "nothing was found".to_owned() } else { format!("'{found}' were found") };
        Err(FormatError::whole(format!("{found}, {EXPECTED}")))
    }
}
