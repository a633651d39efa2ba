//! What was found of a sample.

use super::{Window, place::Place};
use crate::{
    compile::Bounds,
    error::{Diagnostic, Error, Result},
    goniometer::{Frame, Value},
    light_paths::Channels,
    transport::Statistics,
};
use gonio_formats::bsdf::{Basis, Hemispheres, PatchCounts, Patches, Shares};
use std::time::Duration;

/// Where the light of one incident patch goes to, as shares of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FromPatch {
    /// Back to the side that it comes from.
    pub reflected: Value,
    /// To the other side.
    pub transmitted: Value,
    /// Sideways, beyond the sample; counted nowhere.
    pub lost: Value,
    /// Nowhere: it was followed too long.
    pub cut_off: Value,
    /// Into the sample.
    pub absorbed: Value,
    /// Rays that tell so.
    pub rays: u64,
    /// Root of the sum of squared standard errors over that of squared shares, by outgoing patch.
    pub error: f64,
}

/// What came from one side. Shares and errors by patch: `[incident * basis.count() + outgoing]`.
#[derive(Clone, Debug)]
pub struct Side {
    /// Whether it is the front.
    pub from_front: bool,
    /// Incident patches.
    pub from: Vec<FromPatch>,
    /// Shares that stay on the side, linear Rec.709.
    pub reflected: Vec<Channels>,
    /// Shares that leave to the other side.
    pub transmitted: Vec<Channels>,
    /// Standard errors of the luminance of `reflected`.
    pub reflected_errors: Vec<f64>,
    /// Standard errors of the luminance of `transmitted`.
    pub transmitted_errors: Vec<f64>,
}

/// A sample's reading.
#[derive(Clone, Debug)]
pub struct SampleReading {
    /// The patches.
    pub basis: Basis,
    /// Whether [`SampleReading::patches`] have colour.
    pub colour: bool,
    /// The sample's axes.
    pub frame: Frame,
    /// What light fell on.
    pub window: Window,
    /// Least and greatest coordinates of the sample in its axes, repeats included, metres.
    pub body: [[f64; 3]; 2],
    /// What came from the front, and from the back.
    pub sides: Vec<Side>,
    /// Rays that were traced.
    pub paths: u64,
    /// Time that it took.
    pub elapsed: Duration,
    /// Whether the error that was asked for was reached by every patch.
    pub converged: bool,
    /// Counts of rays.
    pub statistics: Statistics,
    /// What is not as asked for.
    pub diagnostics: Vec<Diagnostic>,
}

impl SampleReading {
    /// The matrices. Where the shares of an incident patch are more than all of the light by their noise they are scaled down to it.
    ///
    /// # Errors
    /// Shares that are no numbers.
    pub fn patches(&self) -> Result<Patches> {
        let counts: Vec<PatchCounts> = self.sides.iter().flat_map(|side| side.counts(self.basis.count(), self.colour)).collect();
        Patches::counted(self.basis.clone(), &counts).map_err(|error| Error::setting("sample", error.problem))
    }

    /// The greatest error of a patch.
    pub fn error(&self) -> f64 {
        self.sides.iter().flat_map(|side| &side.from).map(|from| from.error).fold(0.0, f64::max)
    }

    /// A share of evenly diffuse light from a side.
    pub fn of_diffuse(&self, side: &Side, of: impl Fn(&FromPatch) -> Value) -> Value {
        let weights: Vec<f64> = (0..self.basis.count()).map(|patch| self.basis.projected_solid_angle(patch)).collect();
        let all: f64 = weights.iter().sum();
        let [value, variance] = side.from.iter().zip(&weights).fold([0.0; 2], |sum, (from, weight)| {
            let share = of(from);
            [sum[0] + weight * share.value, sum[1] + (weight * share.error).powi(2)]
        });
        Value { value: value / all, error: variance.sqrt() / all }
    }

    pub(super) fn body(place: &Place) -> [[f64; 3]; 2] {
        let Bounds { min, max } = place.bounds();
        [*min, *max]
    }
}

impl Side {
    /// Both directions that its light goes to.
    fn counts(&self, patches: usize, colour: bool) -> [PatchCounts; 2] {
        let (mut reflected, mut transmitted) = (self.reflected.clone(), self.transmitted.clone());
        for (reflected, transmitted) in reflected.chunks_exact_mut(patches).zip(transmitted.chunks_exact_mut(patches)) {
            for k in 0..3 {
                let sum: f64 = reflected.iter().chain(transmitted.iter()).map(|share| share[k]).sum();
                if sum > 1.0 {
                    reflected.iter_mut().chain(transmitted.iter_mut()).for_each(|share| share[k] /= sum);
                }
            }
        }
        let hemispheres = if self.from_front {
            [Hemispheres::ReflectionFront, Hemispheres::TransmissionFront]
        } else {
            [Hemispheres::ReflectionBack, Hemispheres::TransmissionBack]
        };
        let shares = |found: Vec<Channels>| match colour {
            true => Shares::Rgb(found),
            false => Shares::Visible(found.into_iter().map(crate::colour::luminance).collect()),
        };
        let [reflection, transmission] = hemispheres;
        [
            PatchCounts { hemispheres: reflection, shares: shares(reflected) },
            PatchCounts { hemispheres: transmission, shares: shares(transmitted) },
        ]
    }
}
