//! Traced coefficients as groups of windows.

use super::facade::{Facade, FacadeBlinds};
use crate::{
    error::{Diagnostic, Error, Result},
    measure::DaylightCoefficients,
};
use gonio_annual::{Blinds, Coefficients, Group};
use std::ops::Range;

/// Points that were traced.
pub(crate) struct PointsTraced {
    /// By scene, that with open blinds first.
    pub(crate) states: Vec<DaylightCoefficients>,
    pub(crate) points: usize,
    /// What differs from what was asked for.
    pub(crate) diagnostics: Vec<Diagnostic>,
}

impl PointsTraced {
    /// The groups of windows of some of the points.
    pub(crate) fn groups(&self, rows: Range<usize>, facades: &[Facade]) -> Result<Vec<Group>> {
        groups(&self.states, (self.points, rows), facades)
    }
}

/// The groups of windows of a grid's rows, which are some of all points.
fn groups(traced: &[DaylightCoefficients], (points, rows): (usize, Range<usize>), facades: &[Facade]) -> Result<Vec<Group>> {
    let are_told_apart = facades.iter().any(|facade| !facade.prims.is_empty());
    let parts = if are_told_apart { facades.len() + 1 } else { 1 };
    let of_part = |rounds: &[Vec<f32>], part: usize| matrix(rounds, parts * points, part * points + rows.start..part * points + rows.end);
    let group = |part: usize, facade: Option<&Facade>| {
        let open = &traced[0];
        // Where suns were not asked for, all light is in the patches.
        let has_suns = !open.suns.is_empty();
        let suns = |of: &DaylightCoefficients| of_part(std::slice::from_ref(&of.suns), part);
        let closed = |closed: &DaylightCoefficients| {
            let all = of_part(&closed.all, part)?;
            if !has_suns {
                return Ok(Blinds::Coefficients(all));
            }
            Ok(Blinds::Traced { all, scattered: of_part(&closed.scattered, part)?, suns: suns(closed)? })
        };
        let blinds = match facade.and_then(|facade| facade.blinds) {
            Some(FacadeBlinds::Share(share)) => Some(Blinds::Share(share)),
            Some(FacadeBlinds::Scene(number)) => traced.get(number + 1).map(closed).transpose()?,
            None => None,
        };
        Ok(Group {
            open: of_part(&open.all, part)?,
            scattered: has_suns.then(|| of_part(&open.scattered, part)).transpose()?,
            direct: has_suns.then(|| suns(open)).transpose()?,
            sun: None,
            blinds,
            closed: facade.and_then(|facade| facade.closed.clone()),
        })
    };
    if !are_told_apart {
        return Ok(vec![group(0, facades.first())?]);
    }
    let rest = group(0, None)?;
    let is_lit = |of: &Coefficients| of.blocks.iter().flatten().any(|value| *value > 0.0);
    let facades = facades.iter().enumerate().map(|(place, facade)| group(place + 1, Some(facade)));
    facades.chain(is_lit(&rest.open).then_some(Ok(rest))).collect()
}

/// Rows of some of all points, in all rounds.
fn matrix(rounds: &[Vec<f32>], all: usize, rows: Range<usize>) -> Result<Coefficients> {
    let columns = rounds.first().map_or(0, Vec::len) / all.max(1);
    let blocks = rounds.iter().map(|round| round[rows.start * columns..rows.end * columns].to_vec()).collect();
    Coefficients::new(rows.len(), columns, blocks).map_err(|error| Error::setting("grids", error.to_string()))
}
