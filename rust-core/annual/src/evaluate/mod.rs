//! A year at the points of a grid: chunks of steps go through sky, product and metrics, so that memory does not grow with the year.

mod blinds;
mod closed;
mod columns;
mod prepared;
mod shape;

use crate::{
    chunk::Chunk,
    daylight_factor,
    electric::ElectricLight,
    error::Result,
    group::Group,
    metrics::{Counts, Grid, Half, Variant},
    schedule::Schedule,
    sky::{Light, Quantity, SkyMatrix, SkyOptions},
    year::Year,
};
pub(crate) use closed::closed_steps;
use prepared::Prepared;

/// Fewest steps of a chunk.
const LEAST_STEPS: usize = 16;

/// How a year is calculated.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// The sky; it is in cd/m², and its light and division follow from the coefficients.
    pub sky: SkyOptions,
    /// Bytes that the columns and products of a chunk may take, beside the coefficients.
    pub memory: usize,
    /// Threads.
    pub threads: usize,
    /// Electric light beside daylight, whose energy is asked for.
    pub electric: Option<ElectricLight>,
}

/// Calculates a grid by its groups of windows, whose light adds up. `take` sees every chunk, of all blocks and without each of
/// them, and stops the calculation by `false`: then there is no result.
///
/// # Errors
/// Coefficients that fit neither each other nor the year, and settings out of their range.
pub fn evaluate(
    year: &Year,
    schedule: &Schedule,
    groups: &[Group],
    settings: &Settings,
    take: &mut dyn FnMut(&Chunk<'_>) -> bool,
) -> Result<Option<Grid>> {
    settings.electric.iter().try_for_each(ElectricLight::check)?;
    let shape = shape::shape(groups, year)?;
    let options = SkyOptions { factor: shape.factor, quantity: Quantity::Luminance, ..settings.sky };
    let all = SkyMatrix::new(year, SkyOptions { light: Light::All { sun_patches: 4 }, ..options })?;
    let alone = SkyMatrix::new(year, SkyOptions { light: Light::SunAlone { sun_patches: 4 }, ..options })?;
    let sky = SkyMatrix::new(year, SkyOptions { light: Light::WithoutSun, ..options })?;
    let half = Half::of(&all);
    let mut variants: Vec<(Vec<Prepared>, Counts)> = std::iter::once(None)
        .chain((0..shape.blocks).filter(|_| shape.blocks > 1).map(Some))
        .map(|without| (Prepared::all(groups, without), Counts::new(shape.points, settings.electric)))
        .collect();
    let lit: Vec<usize> = (0..year.steps.len()).filter(|step| all.conditions(*step).is_some()).collect();
    let mut closed = vec![0; groups.len()];
    let skies = columns::Skies { all: &all, alone: &alone, sky: &sky, suns: &shape.suns };
    for steps in lit.chunks(steps_of_a_chunk(settings, &shape, groups)) {
        let columns = columns::Columns::new(&skies, groups, &shape, steps, settings.threads);
        for (index, (prepared, counts)) in variants.iter_mut().enumerate() {
            let light = prepared::light(prepared, &columns, settings.threads);
            let (direct, sun) = (light.direct.as_deref(), light.sun.as_deref());
            let chunk = Chunk { steps, total: &light.total, direct, sun, closed: &light.closed, without: index.checked_sub(1) };
            if !take(&chunk) {
                return Ok(None);
            }
            counts.add(&chunk, schedule, &half);
            if index == 0 {
                let used = |of: &Vec<bool>| steps.iter().zip(of).filter(|(step, closed)| **closed && schedule.is_used(**step)).count();
                closed.iter_mut().zip(&light.closed).for_each(|(count, of)| *count += used(of));
            }
        }
    }
    let factors = daylight_factor::of_points(groups, &options, shape.blocks)?;
    let variants = variants.into_iter().zip(factors).map(|((_, counts), factors)| Variant { counts, factors }).collect::<Vec<_>>();
    let closed_hours = if groups.iter().any(|group| group.blinds.is_some()) {
        closed.into_iter().map(|count| count as f64 * year.step_hours).collect()
    } else {
        Vec::new()
    };
    Ok(Some(Grid { closed_hours, ..Grid::new(&variants, year, schedule, &half, shape.has_direct) }))
}

/// As many steps as fit into the memory.
fn steps_of_a_chunk(settings: &Settings, shape: &shape::Shape, groups: &[Group]) -> usize {
    let columns = 3 * (144 * (shape.factor * shape.factor) as usize + 2);
    let products = shape.points * (2 + 3 * groups.len());
    (settings.memory / (4 * (columns + products))).max(LEAST_STEPS)
}
