//! Whether coefficients fit each other and the year.

use crate::{
    Coefficients,
    division::Division,
    error::{AnnualError, Result},
    group::{Blinds, Group},
    year::Year,
};

/// What all groups of a grid have in common.
pub(super) struct Shape {
    pub(super) points: usize,
    pub(super) factor: u32,
    pub(super) blocks: usize,
    pub(super) has_direct: bool,
    /// For each step the column of its sun.
    pub(super) suns: Vec<Option<usize>>,
}

/// Checks coefficients against each other and the year.
pub(super) fn shape(groups: &[Group], year: &Year) -> Result<Shape> {
    let first = groups.first().ok_or_else(|| AnnualError::setting("coefficients", "there are none"))?;
    let (points, patches) = (first.open.points, first.open.columns);
    let division = Division::of_count(patches).ok_or_else(|| {
        let counts = [1, 2, 3, 4, 5, 6].map(|factor| Division::count(factor).to_string()).join(", ");
        first.open.wrong(format!("{patches} columns, expected those of a sky with its ground: {counts}"))
    })?;
    let sunny = year.sunny_steps();
    let mut shape = Shape { points, factor: division.factor(), blocks: 1, has_direct: true, suns: vec![None; year.steps.len()] };
    sunny.iter().enumerate().for_each(|(column, step)| shape.suns[*step] = Some(column));
    let (patches, suns) = ((patches, "patches"), (sunny.len(), "suns, one for each step of the weather with the sun up"));
    for group in groups {
        let closed = match &group.blinds {
            Some(Blinds::Coefficients(closed)) => [Some(closed), None],
            Some(Blinds::Traced { all, scattered, .. }) => [Some(all), Some(scattered)],
            Some(Blinds::Share(_)) | None => [None, None],
        };
        for of in [Some(&group.open), group.scattered.as_ref()].into_iter().chain(closed).flatten() {
            shape.check(of, &[patches])?;
        }
        if let Some(Blinds::Traced { suns: of, .. }) = &group.blinds {
            shape.check(of, &[suns])?;
        }
        group.direct.iter().try_for_each(|of| shape.check(of, &[patches, suns]))?;
        group.sun.iter().try_for_each(|of| shape.check(of, &[suns]))?;
        let is_apart = group.scattered.is_some() || matches!(group.blinds, Some(Blinds::Traced { .. }));
        if is_apart && group.direct.as_ref().is_none_or(|direct| direct.columns == patches.0) {
            return Err(AnnualError::setting(
                "scattered",
                "direct coefficients of suns are missing: they bring the rest of the sun's light",
            ));
        }
        if group.blinds.is_some() && group.closed.is_none() && group.direct.is_none() {
            return Err(AnnualError::setting("blinds", "direct coefficients are missing: direct sun is what closes blinds"));
        }
        shape.has_direct &= group.direct.is_some();
    }
    Ok(shape)
}

impl Shape {
    /// Checks a matrix whose columns may be those of some counts, and notes its blocks.
    fn check(&mut self, of: &Coefficients, columns: &[(usize, &str)]) -> Result<()> {
        if of.points != self.points {
            return Err(of.wrong(format!("{} rows, expected {}, the points of the other matrices", of.points, self.points)));
        }
        if !columns.iter().any(|(count, _)| *count == of.columns) {
            let expected: Vec<String> = columns.iter().map(|(count, name)| format!("{count} ({name})")).collect();
            return Err(of.wrong(format!("{} columns, expected {}", of.columns, expected.join(" or "))));
        }
        let blocks = of.blocks.len();
        if self.blocks > 1 && blocks > 1 && blocks != self.blocks {
            return Err(of.wrong(format!("{blocks} blocks, expected {} as in the other matrices", self.blocks)));
        }
        self.blocks = self.blocks.max(blocks);
        Ok(())
    }
}
