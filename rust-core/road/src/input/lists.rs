//! `[[footpath]]`, `[required]`, `[[class]]`, `[[period]]` and `[optimise]`.

use super::{
    keys::{Bounds, File, Keys, WIDE},
    rows::{HEIGHTS, SPACINGS, TILTS},
};
use crate::{
    error::Result,
    required::{Class, KEYS, PATH_KEYS, Requirement},
    road::{Footpath, Period, Ranges},
};

/// Values that may be required.
const VALUES: Bounds = Bounds::above(0.0, 1e6, "");
/// The most footpaths, and periods of a year.
const MOST: usize = 100;
/// Hours of a year with a 29th of February.
const HOURS: Bounds = Bounds::above(0.0, 8784.0, " h");
/// What runs where nothing is said (EN 13201-5): a year's dark hours at full power.
const USUAL: Period = Period { hours: 4000.0, level: 1.0 };

const PATH: [&str; 5] = ["name", "side", "distance", "width", "required"];
const PERIOD: [&str; 2] = ["hours", "level"];
const OPTIMISE: [&str; 6] = ["spacing", "height", "tilt", "spacing_step", "height_step", "tilt_step"];

/// Areas beside the carriageway.
pub(super) fn footpaths(parts: &Keys<'_>, file: &File<'_>) -> Result<Vec<Footpath>> {
    let path = |(index, (table, start))| {
        let title = format!("[[footpath]] {}", index + 1);
        let keys = Keys::new(&title, file, table, start);
        keys.check(&PATH)?;
        let left = keys.word("side", &[("left", true), ("right", false)])?;
        Ok(Footpath {
            name: keys.text("name")?.map_or_else(|| format!("footpath {}", index + 1), str::to_owned),
            left: left.ok_or_else(|| keys.problem_of("side", "is missing, expected left or right"))?,
            distance: keys.number("distance", Bounds::from(0.0, 100.0, " m"))?.unwrap_or(0.0),
            width: keys.needed("width", WIDE)?,
            required: requirements(&keys, file, &format!("{title}: required"), &PATH_KEYS)?,
        })
    };
    let tables = parts.tables("footpath")?;
    if tables.len() > MOST {
        return Err(parts.problem_of("footpath", &format!("stands {} times, expected at most {MOST}", tables.len())));
    }
    tables.into_iter().enumerate().map(path).collect()
}

/// What the carriageway's results have to be.
pub(super) fn required(parts: &Keys<'_>, file: &File<'_>) -> Result<Vec<Requirement>> {
    requirements(parts, file, "[required]", &KEYS)
}

/// Classes, the most demanding first as the user has them.
pub(super) fn classes(parts: &Keys<'_>, file: &File<'_>) -> Result<Vec<Class>> {
    let known = [&["name"], &KEYS[..]].concat();
    let class = |(index, (table, start))| {
        let title = format!("[[class]] {}", index + 1);
        let keys = Keys::new(&title, file, table, start);
        keys.check(&known)?;
        let name = keys.needed_text("name", "what the class is called")?.to_owned();
        let required = values(&keys, &KEYS)?;
        if required.is_empty() {
            return Err(keys.problem_of("name", &format!("is '{name}', which requires nothing, expected values as under [required]")));
        }
        Ok(Class { name, required })
    };
    let tables = parts.tables("class")?;
    if tables.len() > MOST {
        return Err(parts.problem_of("class", &format!("stands {} times, expected at most {MOST}", tables.len())));
    }
    tables.into_iter().enumerate().map(class).collect()
}

/// The table `required` of a table, in the order of the known keys.
fn requirements(parts: &Keys<'_>, file: &File<'_>, title: &str, known: &[&'static str]) -> Result<Vec<Requirement>> {
    let Some((table, start)) = parts.table("required")? else { return Ok(Vec::new()) };
    let keys = Keys::new(title, file, table, start);
    keys.check(known)?;
    values(&keys, known)
}

fn values(keys: &Keys<'_>, known: &[&'static str]) -> Result<Vec<Requirement>> {
    let found = known.iter().map(|key| Ok(keys.number(key, VALUES)?.map(|value| Requirement { key, value })));
    found.filter_map(Result::transpose).collect()
}

/// The parts of a year.
pub(super) fn periods(parts: &Keys<'_>, file: &File<'_>) -> Result<Vec<Period>> {
    let tables = parts.tables("period")?;
    if tables.is_empty() {
        return Ok(vec![USUAL]);
    }
    let period = |(index, (table, start))| {
        let title = format!("[[period]] {}", index + 1);
        let keys = Keys::new(&title, file, table, start);
        keys.check(&PERIOD)?;
        Ok(Period { hours: keys.needed("hours", HOURS)?, level: keys.number("level", Bounds::from(0.0, 1.0, ""))?.unwrap_or(1.0) })
    };
    let periods: Vec<Period> = tables.into_iter().take(MOST).enumerate().map(period).collect::<Result<_>>()?;
    let hours: f64 = periods.iter().map(|period| period.hours).sum();
    if hours > 8784.0 {
        return Err(parts.problem_of("period", &format!("sums up to {hours} h, more than a year has")));
    }
    Ok(periods)
}

/// What may be varied.
pub(super) fn ranges(parts: &Keys<'_>, file: &File<'_>) -> Result<Option<Ranges>> {
    let Some((table, start)) = parts.table("optimise")? else { return Ok(None) };
    let keys = Keys::new("[optimise]", file, table, start);
    keys.check(&OPTIMISE)?;
    let range = |key, bounds| -> Result<Option<[f64; 2]>> {
        let found = keys.numbers::<2>(key, bounds)?;
        match found {
            Some([from, to]) if from > to => {
                Err(keys.problem_of(key, &format!("goes from {from} to {to}, expected the smaller number first")))
            }
            _ => Ok(found),
        }
    };
    let step = |key, usual, least, most| Ok(keys.number(key, Bounds::from(least, most, ""))?.unwrap_or(usual));
    let spacing = range("spacing", SPACINGS)?;
    Ok(Some(Ranges {
        spacing: spacing.ok_or_else(|| keys.problem_of("spacing", "is missing, expected a list of two numbers, [20, 50]"))?,
        height: range("height", HEIGHTS)?,
        tilt: range("tilt", TILTS)?,
        spacing_step: step("spacing_step", 1.0, 0.1, 100.0)?,
        height_step: step("height_step", 0.5, 0.1, 100.0)?,
        tilt_step: step("tilt_step", 5.0, 0.5, 90.0)?,
    }))
}
