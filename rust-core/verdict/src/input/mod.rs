//! Reading requirements from their TOML file.

mod keys;

use crate::{
    bound::Bound,
    error::{Result, VerdictError},
    requirement::{Requirement, Requirements},
    unit::usual,
};
use gonio_formats::FormatError;
use keys::{File, Keys};
use std::path::Path;
use toml::de::DeTable;

const PARTS: [&str; 5] = ["title", "project", "place", "author", "require"];
const KEYS: [&str; 9] = ["area", "quantity", "of", "file", "at_least", "at_most", "unit", "label", "maintenance_factor"];
/// Signs of units that limits are written in.
const UNITS: [&str; 11] = ["lx", "cd/m²", "%", "K", "h", "m", "°", "mW/(lx·m²)", "kWh/m²", "W/km", ""];
/// The greatest limit.
const MOST: f64 = 1e12;

impl Requirements {
    /// Reads requirements from the bytes of their file.
    ///
    /// # Errors
    /// Anything that has no sensible reading, with the file, its line, and what was expected.
    pub fn read(bytes: &[u8], path: &Path) -> std::result::Result<Self, VerdictError> {
        let whole = |problem| VerdictError::new(path, FormatError::whole(problem));
        let text = std::str::from_utf8(bytes).map_err(|_| whole("not a text in UTF-8, expected TOML".to_owned()))?;
        let file = File { path, text };
        let parsed = DeTable::parse(text).map_err(|error| {
            let message = format!("no TOML: {}", error.message().replace('\n', ", "));
            error.span().map_or_else(|| whole(message.clone()), |span| file.problem(span.start, message.clone()))
        })?;
        let parts = Keys::new("the requirements", &file, parsed.get_ref(), 0);
        parts.check(&PARTS)?;
        let words = |key: &str| Ok(parts.text(key)?.map(str::to_owned));
        let list: Vec<Requirement> =
            parts.tables("require")?.into_iter().map(|(table, start)| requirement(&file, table, start)).collect::<Result<_>>()?;
        if list.is_empty() {
            return Err(parts.problem_of("require", "is missing, expected one [[require]] at least"));
        }
        let (title, project, place, author) = (words("title")?, words("project")?, words("place")?, words("author")?);
        Ok(Self { path: path.into(), title, project, place, author, list })
    }
}

fn requirement(file: &File<'_>, table: &DeTable<'_>, start: usize) -> Result<Requirement> {
    let keys = Keys::new("[[require]]", file, table, start);
    keys.check(&KEYS)?;
    let words = |key: &str| Ok(keys.text(key)?.map(str::to_owned));
    let needed = |key: &str, expected: &str| words(key)?.ok_or_else(|| keys.problem_of(key, &format!("is missing, expected {expected}")));
    let area = needed("area", "the name of a grid, a meter or a road, or the end of its prim's path")?;
    let quantity = needed("quantity", "what is required, as \"mean\" or \"ugr\"")?;
    let (bound, limit) = bound(&keys)?;
    let factor = keys.number("maintenance_factor", |factor| factor > 0.0 && factor <= 1.0, "above 0 and up to 1")?;
    Ok(Requirement {
        area,
        quantity,
        of: words("of")?,
        file: words("file")?,
        bound,
        limit,
        unit: unit(&keys)?,
        label: words("label")?,
        maintenance_factor: factor,
        line: file.line(start),
    })
}

/// The limit and its side.
fn bound(keys: &Keys<'_>) -> Result<(Bound, f64)> {
    let number = |bound: Bound| {
        let found = keys.number(bound.key(), |limit| (0.0..=MOST).contains(&limit), &format!("from 0 to {MOST:e}"))?;
        Ok(found.map(|limit| (bound, limit)))
    };
    match (number(Bound::AtLeast)?, number(Bound::AtMost)?) {
        (Some(_), Some(_)) => Err(keys.problem_of("at_most", "stands beside at_least, expected one of them; a range is two [[require]]")),
        (Some(found), None) | (None, Some(found)) => Ok(found),
        (None, None) => Err(keys.problem_of("at_least", "or at_most is missing, expected a number")),
    }
}

fn unit(keys: &Keys<'_>) -> Result<Option<String>> {
    let Some(written) = keys.text("unit")? else { return Ok(None) };
    let sign = usual(written);
    if UNITS.contains(&sign) {
        return Ok(Some(sign.to_owned()));
    }
    let known = UNITS.iter().filter(|unit| !unit.is_empty()).copied().collect::<Vec<_>>().join(", ");
    Err(keys.problem_of("unit", &format!("is '{}', expected one of {known}", crate::names::shown(written))))
}
