//! MaterialX's noises of cells: random numbers of cells, and Worley's, in two and three dimensions (1.39's reference in GLSL).

use crate::finite::finite;
use crate::hash::{hash2, hash3, hash4, to_unit};
use gonio_simd::{F, Lanes, U};
use serde::{Deserialize, Serialize};

/// A random number in [0, 1] for each cell of the grid of whole numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct MxCellNoise {
    /// 2 (`x` and `y`) or 3.
    pub dimensions: u8,
    /// Channels: 1 (the others are 0) or 3, which hash one word more.
    pub channels: u8,
}

/// The cell's random number.
#[inline(always)]
fn cell<L: Lanes>(l: L, solid: bool, [x, y, z]: [U<L>; 3]) -> F<L> {
    to_unit(if solid { hash3(l, x, y, z) } else { hash2(l, x, y) })
}

/// One of the cell's random numbers.
#[inline(always)]
fn cell_channel<L: Lanes>(l: L, solid: bool, [x, y, z]: [U<L>; 3], channel: u32) -> F<L> {
    to_unit(if solid { hash4(l, x, y, z, l.u(channel)) } else { hash3(l, x, y, l.u(channel)) })
}

/// The cell that a point lies in.
#[inline(always)]
fn cell_of<L: Lanes>(p: [F<L>; 3]) -> [U<L>; 3] {
    let [x, y, z] = p;
    [x.floor().to_i32(), y.floor().to_i32(), z.floor().to_i32()]
}

impl MxCellNoise {
    /// The inputs' names.
    pub const INPUTS: [&str; 3] = ["x", "y", "z"];
    /// Three channels.
    pub const OUTPUTS: usize = 3;

    /// The channels at the points.
    #[inline(always)]
    pub fn evaluate<L: Lanes>(&self, l: L, p: &[F<L>; 3]) -> [F<L>; 3] {
        let (solid, at, zero) = (self.dimensions == 3, cell_of(*p), l.f(0.0));
        if self.channels == 1 {
            return [cell(l, solid, at), zero, zero];
        }
        let mut out = [zero; 3];
        for (channel, out) in out.iter_mut().enumerate() {
            *out = cell_channel(l, solid, at, channel as u32);
        }
        out
    }
}

/// What Worley noise gives.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum MxWorleyStyle {
    /// Distances to the nearest, second and third point.
    #[default]
    Distance,
    /// Random numbers of the nearest point's cell.
    Solid,
}

/// Distances to points of which each cell has one, or numbers of the nearest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct MxWorley {
    /// 2 (`x` and `y`) or 3.
    pub dimensions: u8,
    /// Channels wanted, from 1 to 3; the others are 0.
    pub channels: u8,
    /// What is given.
    pub style: MxWorleyStyle,
}

/// The nearest points so far.
struct Nearest<L: Lanes> {
    /// Squared distances, the least first.
    squares: [F<L>; 3],
    /// The way to the first.
    way: [F<L>; 3],
}

impl<L: Lanes> Nearest<L> {
    #[inline(always)]
    fn add(&mut self, way: [F<L>; 3], solid: bool) {
        let [x, y, z] = way;
        let square = if solid { x * x + y * y + z * z } else { x * x + y * y };
        let [first, second, third] = self.squares;
        let nearer = square.lt(first);
        for (kept, way) in self.way.iter_mut().zip(way) {
            *kept = nearer.select(way, *kept);
        }
        self.squares = [first.min(square), second.min(first.max(square)), third.min(second.max(square))];
    }
}

impl MxWorley {
    /// The inputs' names.
    pub const INPUTS: [&str; 4] = ["x", "y", "z", "jitter"];
    /// Three channels.
    pub const OUTPUTS: usize = 3;

    /// The channels at the points.
    #[inline(always)]
    pub fn evaluate<L: Lanes>(&self, l: L, inputs: &[F<L>; 4]) -> [F<L>; 3] {
        let [x, y, z, jitter] = *inputs;
        let solid = self.dimensions == 3;
        let nearest = nearest(l, solid, [x, y, z], jitter);
        let [to_x, to_y, to_z] = nearest.way;
        let at = cell_of([x + to_x, y + to_y, z + to_z]);
        let mut out = [l.f(0.0); 3];
        for (channel, out) in out.iter_mut().enumerate().take(usize::from(self.channels)) {
            *out = match self.style {
                MxWorleyStyle::Distance => finite(nearest.squares[channel].sqrt()),
                MxWorleyStyle::Solid if self.channels == 1 => cell(l, solid, at),
                MxWorleyStyle::Solid => cell_channel(l, solid, at, channel as u32),
            };
        }
        out
    }
}

/// The nearest points among those of the point's cell and its neighbours.
#[inline(always)]
fn nearest<L: Lanes>(l: L, solid: bool, p: [F<L>; 3], jitter: F<L>) -> Nearest<L> {
    // So far that jitter beyond 1 cannot bring a point there.
    let mut nearest = Nearest { squares: [l.f(1e6); 3], way: [l.f(0.0); 3] };
    let home = cell_of(p);
    let mut within = p;
    for x in &mut within {
        *x -= x.floor();
    }
    let depth = if solid { -1..=1 } else { 0..=0 };
    for i in -1..=1i32 {
        for j in -1..=1i32 {
            for k in depth.clone() {
                let step = [i, j, k];
                let mut at = home;
                for (at, step) in at.iter_mut().zip(step) {
                    *at += step.cast_unsigned();
                }
                let mut way = [l.f(0.0); 3];
                for axis in 0..if solid { 3 } else { 2 } {
                    let place = (cell_channel(l, solid, at, axis as u32) - 0.5) * jitter + 0.5;
                    way[axis] = place + step[axis] as f32 - within[axis];
                }
                nearest.add(way, solid);
            }
        }
    }
    nearest
}
