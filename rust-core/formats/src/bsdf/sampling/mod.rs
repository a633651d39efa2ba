//! Directions in proportion to what a measurement scatters, and their densities.

mod half_vector;
mod lobe;

pub use half_vector::{HalfVectorTable, Resolution};
pub use lobe::Lobe;

use std::borrow::Cow;

use super::direction::Direction;
use super::measured::Measured;

/// A sampled direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Where light comes from.
    pub wi: Direction,
    /// The probability density of it, per solid angle.
    pub pdf: f64,
}

/// How a measurement is sampled: exactly by an RGL file's own warp and by the sums over patches, else by tables over half vectors.
#[derive(Clone, Debug)]
pub struct Sampler<'a> {
    measured: &'a Measured,
    table: Option<Cow<'a, HalfVectorTable>>,
}

impl<'a> Sampler<'a> {
    /// The sampler of a measurement; where it needs tables they are built from as many evaluations as the resolution says.
    pub fn new(measured: &'a Measured, resolution: &Resolution) -> Self {
        let table = match measured {
            Measured::Rgl(_) | Measured::Patches(_) => None,
            Measured::Tables(_) | Measured::Tree(_) => Some(Cow::Owned(HalfVectorTable::new(measured, resolution))),
        };
        Self { measured, table }
    }

    /// The sampler of a measurement whose tables, where it needs them, were built before.
    pub fn with_table(measured: &'a Measured, table: Option<&'a HalfVectorTable>) -> Self {
        Self { measured, table: table.map(Cow::Borrowed) }
    }

    /// The tables over half vectors, where the measurement needs them.
    pub fn table(&self) -> Option<&HalfVectorTable> {
        self.table.as_deref()
    }

    /// A direction that light comes from to leave to `wo`, from three uniform numbers in [0, 1); none if nothing leaves to there, or where
    /// an RGL file's warp falls below the surface.
    pub fn sample(&self, wo: Direction, u: [f64; 3]) -> Option<Sample> {
        let (wi, pdf) = match (self.measured, &self.table) {
            (Measured::Rgl(rgl), _) => rgl.sample(wo, [u[1], u[2]]),
            (Measured::Patches(patches), _) => patches.sample(wo, u),
            (_, table) => table.as_ref().and_then(|table| table.sample(wo, u)),
        }?;
        Some(Sample { wi, pdf })
    }

    /// The density of [`Sampler::sample`], per solid angle.
    pub fn pdf(&self, wo: Direction, wi: Direction) -> f64 {
        match (self.measured, &self.table) {
            (Measured::Rgl(rgl), _) => rgl.pdf(wo, wi),
            (Measured::Patches(patches), _) => patches.pdf(wo, wi),
            (_, table) => table.as_ref().map_or(0.0, |table| table.pdf(wo, wi)),
        }
    }
}
