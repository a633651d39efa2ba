//! Tabulated directions: bands about a pole, each cut into equal columns around it. Lights that send alike share a table.

use super::choice::find;
use super::row::{Own, at};
use gonio_simd::{F, Lanes, Vec3};
use std::f32::consts::{PI, TAU};

/// Share of a table's rays that go everywhere alike: nothing that a table's cells missed goes unseen.
const EVERYWHERE: f64 = 0.02;

/// Where a table lies in the pools.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Placed {
    pub(super) first: u32,
    pub(super) columns: u32,
    pub(super) size: [u32; 2],
}

/// All tables.
#[derive(Clone, Debug, Default)]
pub(super) struct Beams {
    /// Ends of the bands, as squared sines of half the angle to the pole; one more than bands.
    heights: Vec<f32>,
    /// Cumulative probability of the bands, at the same places.
    bands: Vec<f32>,
    /// Cumulative probability along each band, one more than columns a band.
    columns: Vec<f32>,
}

/// From 0 to exactly 1.
fn accumulate(weights: &[f64], into: &mut Vec<f32>) {
    let total: f64 = weights.iter().sum();
    let mut sum = 0.0;
    into.push(0.0);
    for (k, weight) in weights.iter().enumerate() {
        sum += if total > 0.0 { weight / total } else { 1.0 / weights.len() as f64 };
        into.push(if k + 1 == weights.len() { 1.0 } else { sum.min(1.0) as f32 });
    }
}

impl Beams {
    /// Takes in what is sent in the mean over each cell, band by band, between ascending `heights` (0 to 1).
    pub(super) fn insert(&mut self, heights: &[f64], cells: &[f64]) -> Placed {
        let rows = heights.len() - 1;
        let columns = cells.len() / rows;
        let height = |row: usize| heights[row + 1] - heights[row];
        let mean = cells.iter().enumerate().map(|(i, v)| v * height(i / columns)).sum::<f64>() / columns as f64;
        let weights: Vec<f64> = cells.iter().map(|v| v + EVERYWHERE * mean).collect();
        let placed = Placed { first: self.heights.len() as u32, columns: self.columns.len() as u32, size: [rows as u32, columns as u32] };
        self.heights.extend(heights.iter().map(|t| *t as f32));
        let sums: Vec<f64> = (0..rows).map(|row| weights[row * columns..][..columns].iter().sum::<f64>() * height(row)).collect();
        accumulate(&sums, &mut self.bands);
        for row in 0..rows {
            accumulate(&weights[row * columns..][..columns], &mut self.columns);
        }
        placed
    }

    pub(super) fn is_empty(&self) -> bool {
        self.heights.is_empty()
    }

    /// A direction about the pole, and its density per solid angle.
    #[inline(always)]
    pub(super) fn sample<L: Lanes>(&self, l: L, own: &Own<'_, L>, u: [F<L>; 2]) -> (Vec3<L>, F<L>) {
        let (first, rows, columns) = (own.integer(at::FIRST), own.integer(at::SIZE), own.integer(at::SIZE + 1));
        let (row, [low, high]) = find(l, &self.bands, first, rows.max(1), u[0]);
        let [bottom, top] = l.gather_pairs(&self.heights, first + row);
        let t = bottom.lerp(top, inside(u[0], low, high)).clamp(bottom, top);
        let (column, [left, right]) = find(l, &self.columns, own.integer(at::COLUMNS) + row * (columns + 1), columns.max(1), u[1]);
        let turn = (column.to_float() + inside(u[1], left, right)) / columns.to_float();
        let (sine_turn, cosine_turn) = turn.sin_cos_turns();
        let sine = (t * (1.0 - t)).safe_sqrt() * 2.0;
        let pdf = (high - low) * (right - left) * columns.to_float() / ((top - bottom) * (4.0 * PI));
        (Vec3::new(sine * cosine_turn, sine * sine_turn, 1.0 - t * 2.0), pdf)
    }

    /// Density per solid angle of a unit direction about the pole.
    #[inline(always)]
    pub(super) fn density<L: Lanes>(&self, l: L, own: &Own<'_, L>, direction: Vec3<L>) -> F<L> {
        let (first, rows, columns) = (own.integer(at::FIRST), own.integer(at::SIZE), own.integer(at::SIZE + 1));
        let across = direction.x * direction.x + direction.y * direction.y;
        let near = across / ((direction.z.abs() + 1.0) * 2.0);
        let t = direction.z.lt(0.0).select(1.0 - near, near);
        let (row, [bottom, top]) = find(l, &self.heights, first, rows.max(1), t);
        let [low, high] = l.gather_pairs(&self.bands, first + row);
        let turn = direction.y.atan2(direction.x) * (1.0 / TAU);
        let turn = turn.lt(0.0).select(turn + 1.0, turn);
        let column = (turn * columns.to_float()).max(0.0).to_i32().min(columns.max(1) - 1);
        let [left, right] = l.gather_pairs(&self.columns, own.integer(at::COLUMNS) + row * (columns + 1) + column);
        (high - low) * (right - left) * columns.to_float() / ((top - bottom) * (4.0 * PI))
    }
}

/// How far a number lies between two.
#[inline(always)]
fn inside<L: Lanes>(u: F<L>, low: F<L>, high: F<L>) -> F<L> {
    ((u - low) / (high - low).max(f32::MIN_POSITIVE)).clamp(0.0, 1.0 - f32::EPSILON)
}
