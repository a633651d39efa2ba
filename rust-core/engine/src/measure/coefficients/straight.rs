//! Light straight from the sky: shadow rays from each point to places in each patch, and on the disc of each sun.

use super::{ROUNDS, Tracing, Work};
use crate::{
    camera::sampler::{BATCH, hash},
    error::Result,
    measure::vector::{across, add, cross, dot, scaled, unit},
    transport::{SensorTable, Start, Tracer, Workspace},
};
use std::{
    f64::consts::TAU,
    ops::Range,
    sync::{Mutex, PoisonError, atomic::Ordering},
};

/// Directions whose rays are traced together.
const TOGETHER: usize = 256;
/// Places on each sun's disc.
const PLACES: usize = 4;
/// Where on the radius they lie: half of the disc's area is nearer to its middle.
const RADIUS: f64 = std::f64::consts::FRAC_1_SQRT_2;
/// Radians by which the places of one sun are turned against those of the one before.
const GOLDEN: f64 = 2.399_963_229_728_653;
/// Cells along a patch's sides, of which each round takes one.
const SIDE: u32 = 4;
const _: () = assert!(ROUNDS == (SIDE * SIDE) as usize);

/// A direction with the number of what shines from there.
type Numbered = ([f32; 3], u32);

/// Batches of a round.
pub(super) fn batches_of_a_round(tracing: &Tracing<'_>) -> u64 {
    tracing.task.patches.div_ceil(TOGETHER) as u64
}

/// Batches of the suns.
pub(super) fn batches_of_suns(tracing: &Tracing<'_>) -> u64 {
    tracing.task.suns.len().div_ceil(TOGETHER / PLACES) as u64
}

/// What each sun brings: points × suns.
pub(super) fn suns(tracing: &Tracing<'_>, work: &Work) -> Result<Vec<f32>> {
    let all = tracing.task.suns.len();
    let disc = TAU * (1.0 - (0.5 * tracing.task.sun_angle).cos());
    let batch = |chosen: Range<usize>| chosen.flat_map(|sun| on_disc(tracing, sun)).collect();
    let found = trace(tracing, work, (all, TOGETHER / PLACES, &[0]), |_, chosen| batch(chosen), |_| disc / PLACES as f64)?;
    Ok(found.into_iter().next().unwrap_or_default())
}

/// What each patch brings without being scattered in some rounds, one after the other: points × patches. The ground's, which has no places, is left out.
pub(super) fn patches(tracing: &Tracing<'_>, work: &Work, rounds: &[usize]) -> Result<Vec<Vec<f32>>> {
    let task = tracing.task;
    let place = |round: usize, patch: usize| Some(((task.place)(patch, jittered(tracing.settings.seed, round, patch))?, patch as u32));
    let batch = |round: usize, chosen: Range<usize>| chosen.filter_map(|patch| place(round, patch)).collect();
    trace(tracing, work, (task.patches, TOGETHER, rounds), batch, |patch| (task.solid_angle)(patch))
}

/// What numbered directions bring, by round: points × numbers. `batch` gives those of some numbers in a round, `weight` steradians of each.
fn trace(
    tracing: &Tracing<'_>,
    work: &Work,
    (numbers, together, rounds): (usize, usize, &[usize]),
    batch: impl Fn(usize, Range<usize>) -> Vec<Numbered> + Sync,
    weight: impl Fn(usize) -> f64 + Sync,
) -> Result<Vec<Vec<f32>>> {
    if numbers == 0 {
        return Ok(vec![Vec::new(); rounds.len()]);
    }
    let found: Vec<Mutex<Vec<f32>>> = rounds.iter().map(|_| Mutex::new(vec![0.0; tracing.rows() * numbers])).collect();
    let table = SensorTable::new(tracing.sensors, 1);
    let tracer = Tracer { tables: &tracing.scene.tables, start: Start::Sensors(&table), transport: tracing.transport() };
    let of_round = numbers.div_ceil(together);
    work.share_out(tracing, rounds.len() * of_round, |piece, workspace| {
        workspace.prepare(tracer.tables, &tracer.transport, false);
        let (place, first) = (piece / of_round, piece % of_round * together);
        let chosen = first..(first + together).min(numbers);
        let before = workspace.statistics.shadow_rays;
        let sums = arrived(tracing, &tracer, (&batch(rounds[place], chosen.clone()), chosen.clone()), workspace);
        let mut found = found[place].lock().unwrap_or_else(PoisonError::into_inner);
        for (row, sums) in found.chunks_exact_mut(numbers).zip(sums.chunks_exact(chosen.len())) {
            for (number, sum) in chosen.clone().zip(sums) {
                row[number] = (sum * weight(number)) as f32;
            }
        }
        work.done.fetch_add(1, Ordering::Relaxed);
        work.rays.fetch_add(workspace.statistics.shadow_rays - before, Ordering::Relaxed);
    })?;
    Ok(found.into_iter().map(|found| found.into_inner().unwrap_or_else(PoisonError::into_inner)).collect())
}

/// What some directions bring, for a steradian each: points × numbers.
fn arrived(
    tracing: &Tracing<'_>,
    tracer: &Tracer<'_>,
    (directions, chosen): (&[Numbered], Range<usize>),
    workspace: &mut Workspace,
) -> Vec<f64> {
    let points = tracing.sensors.len();
    let mut sums = vec![0.0; tracing.rows() * chosen.len()];
    for first in (0..points).step_by(BATCH) {
        workspace.deposits.sky.get_or_insert_default().count = 0;
        tracer.light_from(first..points.min(first + BATCH), directions, workspace);
        for (sky, entry) in workspace.deposits.sky.iter().flat_map(|sky| (0..sky.count).map(move |entry| (sky, entry))) {
            let point = first + sky.slot[entry] as usize - BATCH;
            let row = sky.opening(entry) * points + point;
            sums[row * chosen.len() + sky.number(entry) - chosen.start] += f64::from(sky.value[entry]);
        }
    }
    sums
}

/// Places on a sun's disc above the horizon, with the sun's number.
fn on_disc(tracing: &Tracing<'_>, sun: usize) -> impl Iterator<Item = Numbered> {
    let task = tracing.task;
    let (centre, up) = (task.suns[sun], task.up);
    let first = across(centre, up);
    let axes = [first, cross(centre, first)];
    let radius = RADIUS * (0.5 * task.sun_angle).tan();
    (0..PLACES).filter_map(move |place| {
        let (sin, cos) = (sun as f64 * GOLDEN + place as f64 * TAU / PLACES as f64).sin_cos();
        let off = add(scaled(axes[0], radius * cos), scaled(axes[1], radius * sin));
        let direction = unit(add(centre, off)).filter(|direction| dot(*direction, up) > 0.0)?;
        Some((direction.map(|x| x as f32), sun as u32))
    })
}

/// A place in the cell of a patch that a round takes. Which cell that is differs from patch to patch, so that no round looks at one side of all.
fn jittered(seed: u32, round: usize, patch: usize) -> [f64; 2] {
    let own = hash(seed ^ hash(patch as u32));
    // An odd factor and a sum permute the cells.
    let cell = ((round as u32).wrapping_mul(own | 1).wrapping_add(own >> 8)) % (SIDE * SIDE);
    let part = |salt: u32| f64::from(hash(own ^ hash(round as u32 + salt)) >> 8) / f64::from(1 << 24);
    [(f64::from(cell % SIDE) + part(1 << 8)) / f64::from(SIDE), (f64::from(cell / SIDE) + part(1 << 16)) / f64::from(SIDE)]
}
