//! Daylight factors by coefficients: the traditional overcast sky of the CIE (type 16), per cent of its light outside.

use crate::{
    error::Result,
    group::Group,
    sky::{SkyOptions, cie_sky},
    sun::Sun,
};

/// The sky of daylight factors.
const OVERCAST: u8 = 16;
/// Its light on a level surface, lx; factors are per cent.
const OUTSIDE: f64 = 100.0;

/// Factors of the points in per cent, blinds open: of the mean of all blocks, then without each of them.
pub(crate) fn of_points(groups: &[Group], options: &SkyOptions, blocks: usize) -> Result<Vec<Vec<f64>>> {
    let sky = cie_sky(options.factor, OVERCAST, Sun::default(), OUTSIDE, options.ground)?;
    let under_sky = |row: &[f32]| row.iter().zip(&sky).map(|(coefficient, patch)| f64::from(*coefficient) * f64::from(*patch)).sum::<f64>();
    let of = |without: Option<usize>| {
        let mut factors = vec![0.0; groups[0].open.points];
        for group in groups {
            let rows = group.open.mean(without.filter(|_| group.open.blocks.len() > 1));
            factors.iter_mut().zip(rows.chunks_exact(group.open.columns)).for_each(|(factor, row)| *factor += under_sky(row));
        }
        factors
    };
    Ok(std::iter::once(None).chain((0..blocks).filter(|_| blocks > 1).map(Some)).map(of).collect())
}
