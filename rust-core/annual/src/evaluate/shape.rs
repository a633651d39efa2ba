//! Whether coefficients fit each other and the year.

use super::{Blinds, Group, wrong};
use crate::{
    division::Division,
    error::{AnnualError, Result},
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
        wrong(&first.open, format!("{patches} columns, expected those of a sky with its ground: {counts}"))
    })?;
    let sunny = year.sunny_steps();
    let mut blocks = 1;
    for group in groups {
        let closed = if let Some(Blinds::Coefficients(closed)) = &group.blinds { Some(closed) } else { None };
        for (of, is_patches, is_suns) in [
            (Some(&group.open), true, false),
            (closed, true, false),
            (group.direct.as_ref(), true, true),
            (group.sun.as_ref(), false, true),
        ] {
            let Some(of) = of else { continue };
            if of.points != points {
                return Err(wrong(of, format!("{} rows, expected {points}, the points of the other matrices", of.points)));
            }
            if !(is_patches && of.columns == patches || is_suns && of.columns == sunny.len()) {
                let names =
                    [(is_patches, patches, "patches"), (is_suns, sunny.len(), "suns, one for each step of the weather with the sun up")];
                let expected: Vec<String> =
                    names.iter().filter(|name| name.0).map(|(_, count, name)| format!("{count} ({name})")).collect();
                return Err(wrong(of, format!("{} columns, expected {}", of.columns, expected.join(" or "))));
            }
            if blocks > 1 && of.blocks.len() > 1 && of.blocks.len() != blocks {
                return Err(wrong(of, format!("{} blocks, expected {blocks} as in the other matrices", of.blocks.len())));
            }
            blocks = blocks.max(of.blocks.len());
        }
        if group.blinds.is_some() && group.direct.is_none() {
            return Err(AnnualError::setting("blinds", "direct coefficients are missing: direct sun is what closes blinds"));
        }
    }
    let mut suns = vec![None; year.steps.len()];
    sunny.iter().enumerate().for_each(|(column, step)| suns[*step] = Some(column));
    let has_direct = groups.iter().all(|group| group.direct.is_some());
    Ok(Shape { points, factor: division.factor(), blocks, has_direct, suns })
}
