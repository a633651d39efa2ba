//! Paths from the points into the sky, round by round.

use super::{ROUNDS, Tracing, Work};
use crate::{
    camera::sampler::{BATCH, Runs, TILE, tile_place},
    error::Result,
    measure::sensing::seed_of_round,
    transport::{SensorTable, SkyArrivals, Start, Tracer, Workspace},
};
use std::sync::{Mutex, PoisonError, atomic::Ordering};

/// The row of a slot whose pixel no sensor owns.
const NOBODY: u32 = u32::MAX;

/// How the points lie in the tiles of a picture, the same in all rounds.
struct Layout {
    table: SensorTable,
    /// Samples of each pixel in a round.
    samples: u32,
    tiles: usize,
    /// By patch, whether paths alone find it.
    by_paths: Vec<bool>,
}

impl Layout {
    fn new(tracing: &Tracing<'_>) -> Self {
        let of_round = tracing.settings.samples.div_ceil(ROUNDS as u32);
        let table = SensorTable::new(tracing.sensors, of_round as usize);
        let samples = of_round.div_ceil((table.side() * table.side()) as u32).max(1);
        let tiles = (table.resolution()[1] as usize).div_ceil(TILE);
        let by_paths = (0..tracing.task.patches).map(|patch| (tracing.task.place)(patch, [0.5; 2]).is_none()).collect();
        Self { table, samples, tiles, by_paths }
    }

    /// By slot of a tile, the point that it belongs to.
    fn rows(&self, tile: usize, points: usize) -> Vec<u32> {
        let (side, across) = (self.table.side(), TILE / self.table.side());
        let row = |slot: usize| {
            let [x, y] = tile_place(slot);
            let point = (tile * TILE + y) / side * across + x / side;
            if point < points { point as u32 } else { NOBODY }
        };
        (0..BATCH).map(row).collect()
    }
}

/// Tiles of a round, and batches.
pub(super) fn size(tracing: &Tracing<'_>) -> (usize, u64) {
    let layout = Layout::new(tracing);
    (layout.tiles, layout.tiles as u64 * u64::from(layout.samples))
}

/// All light and the scattered part of it in some rounds, one after the other: points × patches.
pub(super) fn trace(tracing: &Tracing<'_>, work: &Work, rounds: &[usize]) -> Result<[Vec<Vec<f32>>; 2]> {
    let layout = Layout::new(tracing);
    let points = tracing.sensors.len();
    let empty = || rounds.iter().map(|_| Mutex::new(vec![0.0; tracing.rows() * tracing.task.patches])).collect::<Vec<_>>();
    let sums = [empty(), empty()];
    let rows: Vec<Vec<u32>> = (0..layout.tiles).map(|tile| layout.rows(tile, points)).collect();
    // Rounds and tiles are whole works of one worker each, so that sums do not hang on how many workers there are.
    work.share_out(tracing, rounds.len() * layout.tiles, |number, workspace| {
        let (place, tile) = (number / layout.tiles, number % layout.tiles);
        trace_tile(tracing, work, &layout, (rounds[place], tile), &rows[tile], [&sums[0][place], &sums[1][place]], workspace);
    })?;
    Ok(sums.map(|sums| sums.into_iter().map(|sum| sum.into_inner().unwrap_or_else(PoisonError::into_inner)).collect()))
}

/// A round of a tile's points.
fn trace_tile(
    tracing: &Tracing<'_>,
    work: &Work,
    layout: &Layout,
    (round, tile): (usize, usize),
    rows: &[u32],
    sums: [&Mutex<Vec<f32>>; 2],
    workspace: &mut Workspace,
) {
    let mut transport = tracing.transport();
    transport.passes.illuminance = false;
    transport.seed = seed_of_round(tracing.settings.seed, round as u32);
    transport.samples = layout.samples;
    let tracer = Tracer { tables: &tracing.scene.tables, start: Start::Sensors(&layout.table), transport };
    workspace.prepare(tracer.tables, &tracer.transport, false);
    let [width, height] = layout.table.resolution();
    let top = (tile * TILE) as u32;
    let (min, max) = ([0, top], [width, height.min(top + TILE as u32)]);
    let first = rows.iter().copied().min().unwrap_or(0);
    let last = rows.iter().copied().filter(|row| *row != NOBODY).max().unwrap_or(first);
    let patches = tracing.task.patches;
    let count = (last - first + 1) as usize * patches;
    let mut found = [0, 1].map(|_| vec![0.0_f64; tracing.task.parts() * count]);
    for sample in 0..layout.samples {
        let sky = workspace.deposits.sky.get_or_insert_default();
        sky.count = 0;
        let before = workspace.statistics.rays + workspace.statistics.shadow_rays;
        tracer.trace(min, max, &Runs::whole(sample), workspace, &|| work.is_cancelled());
        if work.is_cancelled() {
            return;
        }
        if let Some(sky) = &workspace.deposits.sky {
            add(sky, (rows, first, count), (tracing, layout), &mut found);
        }
        work.done.fetch_add(1, Ordering::Relaxed);
        work.rays.fetch_add(workspace.statistics.rays + workspace.statistics.shadow_rays - before, Ordering::Relaxed);
    }
    let share = 1.0 / ((layout.table.side() * layout.table.side()) as f64 * f64::from(layout.samples));
    for (sum, found) in sums.into_iter().zip(found) {
        let mut sum = sum.lock().unwrap_or_else(PoisonError::into_inner);
        let of_part = tracing.sensors.len() * patches;
        for (sum, found) in sum.chunks_exact_mut(of_part).zip(found.chunks_exact(count)) {
            let place = first as usize * patches;
            sum[place..place + count].iter_mut().zip(found).for_each(|(sum, found)| *sum = (found * share) as f32);
        }
    }
}

/// Adds what arrived to the patches that it came from: what was scattered to both sums, and to that of all light what comes straight from patches
/// without places.
fn add(
    sky: &SkyArrivals,
    (rows, first, count): (&[u32], u32, usize),
    (tracing, layout): (&Tracing<'_>, &Layout),
    [all, scattered]: &mut [Vec<f64>; 2],
) {
    let task = tracing.task;
    let [x, y, z] = &sky.direction;
    for entry in 0..sky.count {
        // What is looked at comes to pixels, what is measured behind them.
        let Some(row) = rows.get(sky.slot[entry] as usize % BATCH).filter(|row| **row != NOBODY) else { continue };
        let patch = (task.patch_of)([x[entry], y[entry], z[entry]]);
        let place = sky.opening(entry) * count + (row - first) as usize * task.patches + patch;
        let value = f64::from(sky.value[entry]);
        let is_direct = sky.is_direct(entry);
        if !is_direct {
            scattered[place] += value;
        }
        if !is_direct || layout.by_paths[patch] {
            all[place] += value;
        }
    }
}
