//! Whether a place is outside: whether the open sky is seen from it, past everything, panes too.

use crate::{accel::RayBatch, compile::CompiledScene, measure::vector::Vector, transport::ray_mask};
use gonio_simd::Execution;
use std::{collections::HashMap, f64::consts::TAU};

/// Directions in which the sky is looked for.
const DIRECTIONS: usize = 128;
/// Metres of a cell, in which all places of a surface's side are as its first one.
const CELL_M: f32 = 1.0;
/// Turns from one direction to the next: the golden section spreads them evenly.
const GOLDEN: f64 = 0.618_033_988_749_895;

/// A side of a triangle near a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Side {
    /// The instance's and the triangle's number.
    pub(super) surface: [u32; 2],
    pub(super) is_front: bool,
    cell: [i32; 3],
}

impl Side {
    pub(super) fn new(surface: [u32; 2], is_front: bool, place: [f32; 3]) -> Self {
        Self { surface, is_front, cell: place.map(|x| (x / CELL_M).floor() as i32) }
    }
}

/// What is known of places; what is asked first of a cell holds for all of it.
#[derive(Debug)]
pub(super) struct Outdoors<'a> {
    scene: &'a CompiledScene,
    execution: Execution,
    directions: [Vec<f32>; 3],
    known: HashMap<Side, bool>,
}

impl<'a> Outdoors<'a> {
    /// `axes`: two level ones, and up; unit.
    pub(super) fn new(scene: &'a CompiledScene, axes: [Vector; 3], execution: Execution) -> Self {
        let all: Vec<Vector> = (0..DIRECTIONS).map(|number| upwards(axes, number)).collect();
        let directions = [0, 1, 2].map(|axis| all.iter().map(|direction| direction[axis] as f32).collect());
        Self { scene, execution, directions, known: HashMap::new() }
    }

    /// Whether the sky is seen from a place before a side, rebased world space.
    pub(super) fn is_outside(&mut self, side: Side, place: [f32; 3]) -> bool {
        if let Some(known) = self.known.get(&side) {
            return *known;
        }
        let found = self.sees_sky(place);
        self.known.insert(side, found);
        found
    }

    fn sees_sky(&self, place: [f32; 3]) -> bool {
        let origin = place.map(|x| vec![x; DIRECTIONS]);
        let rays = RayBatch {
            origin: origin.each_ref().map(|x| &x[..]),
            direction: self.directions.each_ref().map(|x| &x[..]),
            t_min: &[0.0; DIRECTIONS],
            t_max: &[f32::INFINITY; DIRECTIONS],
            mask: &[ray_mask::CAMERA; DIRECTIONS],
            time: &[],
            passed: &[],
        };
        let mut blocked = [1; DIRECTIONS];
        self.scene.tables.bvh.occluded(self.execution, &rays, false, &mut blocked);
        blocked.contains(&0)
    }
}

/// One of the directions, which share the upper hemisphere evenly.
fn upwards([x, y, up]: [Vector; 3], number: usize) -> Vector {
    let height = (number as f64 + 0.5) / DIRECTIONS as f64;
    let level = (1.0 - height * height).sqrt();
    let (sin, cos) = (number as f64 * GOLDEN * TAU).sin_cos();
    [0, 1, 2].map(|axis| level * (cos * x[axis] + sin * y[axis]) + height * up[axis])
}
