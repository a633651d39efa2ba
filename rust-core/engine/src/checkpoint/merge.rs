//! From parts of a render's samples to the whole.

use super::Checkpoint;
use crate::error::{Error, Result};
use std::path::{Path, PathBuf};

/// Joins finished parts of one render, given in any order; they must follow one another without gap or overlap.
///
/// From the first sample on, the sums are those of one render to the bit.
pub fn merge(parts: &[PathBuf]) -> Result<Checkpoint> {
    let mut all = parts.iter().map(|path| Ok((path, Checkpoint::read(path)?))).collect::<Result<Vec<_>>>()?;
    all.sort_by_key(|(_, part)| part.film.range().start);
    let mut all = all.into_iter();
    let Some((first, mut whole)) = all.next() else { return Err(Error::setting("parts", "none were given")) };
    check_complete(first, &whole)?;
    for (path, part) in all {
        whole.identity.check(&part.identity, path, &["sample_range"])?;
        check_complete(path, &part)?;
        let (end, start) = (whole.film.range().end, part.film.range().start);
        if start != end {
            let what =
                if start > end { format!("samples {end}:{start} are missing") } else { format!("samples {start}:{end} are there twice") };
            return Err(Error::Format { path: path.clone(), line: None, problem: format!("its samples start at {start}: {what}") });
        }
        whole.film.join(part.film);
    }
    let range = whole.film.range();
    whole.identity.settings.sample_range = Some([range.start, range.end]);
    Ok(whole)
}

fn check_complete(path: &Path, part: &Checkpoint) -> Result<()> {
    if part.film.is_complete() {
        return Ok(());
    }
    let problem = "this part of the render is not finished; gonio render --resume goes on with it".to_owned();
    Err(Error::Format { path: path.to_owned(), line: None, problem })
}
