//! When blinds are closed, without the light of others.

use super::{Settings, evaluate};
use crate::{chunk::Chunk, error::Result, group::Group, schedule::Schedule, year::Year};

/// By group the steps of a year in which its blinds are closed: by its schedule, or by direct sun on the points that the groups light. `goes_on` is asked now
/// and then, and stops by `false`: then there is no result.
///
/// # Errors
/// As [`evaluate`].
pub(crate) fn closed_steps(
    year: &Year,
    groups: &[Group],
    settings: &Settings,
    goes_on: &dyn Fn() -> bool,
) -> Result<Option<Vec<Vec<bool>>>> {
    let means: Vec<Group> = groups.iter().map(Group::mean).collect();
    let mut found = vec![vec![false; year.steps.len()]; groups.len()];
    let mut take = |chunk: &Chunk<'_>| {
        for (found, closed) in found.iter_mut().zip(chunk.closed) {
            chunk.steps.iter().zip(closed).for_each(|(step, closed)| found[*step] = *closed);
        }
        goes_on()
    };
    let always = Schedule::daily(year, 0.0, 24.0)?;
    Ok(evaluate(year, &always, &means, settings, &mut take)?.map(|_| found))
}
