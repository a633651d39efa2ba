//! Densities over the square of normals, one for each slice of view directions.

use super::super::direction::{angles_of, solid_angle_per_square};
use super::super::warp::{Blend, Interpolant, Warp};

/// Densities over the square of normals (columns along the polar angle, rows along the azimuth), bilinear between nodes, for every slice of
/// view directions: the flat arrays of an RGL file's warp, so that one lane kernel serves both.
#[derive(Clone, Debug, PartialEq)]
pub struct Lobe {
    /// For each slice the share of light that this lobe has among the lobes of its side.
    pub share: Vec<f32>,
    /// The densities, which have no parameters: slices are numbered by the table.
    pub warp: Warp,
}

impl Lobe {
    /// The lobe of slices of weights at nodes, columns fastest. Shares begin as the sums of slices; the table weighs lobes against each other.
    pub(super) fn new(columns: usize, rows: usize, weights: Vec<f32>) -> Self {
        let share = weights.chunks_exact(columns * rows).map(|slice| slice.iter().sum()).collect();
        Self { share, warp: Warp::new(Interpolant { parameters: Vec::new(), columns, rows, data: weights }) }
    }

    /// A place in the square from two uniform numbers, by one slice's density.
    pub(super) fn sample(&self, slice: usize, u: [f64; 2]) -> [f64; 2] {
        self.warp.sample(u, &Blend::new(&[(slice, 1.0)])).0
    }

    /// The blended density of a place per solid angle of normals.
    pub(super) fn density(&self, blend: &Blend, square: [f64; 2]) -> f64 {
        self.warp.density.eval(square, blend) / solid_angle_per_square(square[0]).max(f64::MIN_POSITIVE)
    }
}

/// Points around a node of the square: their angles, and the solid angle for an area there.
pub(super) fn around_node(
    [column, row]: [usize; 2],
    [columns, rows]: [usize; 2],
    points: usize,
) -> impl Iterator<Item = ((f64, f64), f64)> {
    // Half a step to each side of the node, inside the square.
    let place = move |i: usize, node: usize, nodes: usize| {
        let offset = (i as f64 + 0.5) / points as f64 - 0.5;
        ((node as f64 + offset) / (nodes - 1) as f64).clamp(0.0, 1.0)
    };
    (0..points * points).map(move |i| {
        let square = [place(i % points, column, columns), place(i / points, row, rows)];
        (angles_of(square), solid_angle_per_square(square[0]))
    })
}
