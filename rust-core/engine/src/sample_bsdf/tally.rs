//! What leaves the sample, counted by the patch that it came from and the one that it leaves to.

use super::place::Place;
use crate::{
    light_paths::{Batch, BatchEstimates, Channels, Collector, Estimate, WorkerSums},
    transport::{Arrivals, Escapes, LIGHT_BATCH, Receiver},
};
use gonio_formats::bsdf::Basis;
use gonio_simd::Column;

/// Where light goes beside the patches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sum {
    /// All that leaves to the front.
    Front,
    /// All that leaves to the back.
    Back,
    /// What leaves sideways.
    Lost,
    /// What was followed too long.
    CutOff,
    /// All the rest.
    Absorbed,
}

const SUMS: usize = 5;

/// Sums over the batches of all incident patches.
#[derive(Debug)]
pub(super) struct Tally<'a> {
    place: &'a Place,
    basis: &'a Basis,
    /// By incident patch.
    estimates: Vec<BatchEstimates>,
}

impl<'a> Tally<'a> {
    /// Empty sums for so many incident patches, each with `most` rays at most.
    pub(super) fn new(place: &'a Place, basis: &'a Basis, incident: usize, most: u64) -> Self {
        let estimates = (0..incident).map(|_| BatchEstimates::new(width(basis), [1.0; 3], most)).collect();
        Self { place, basis, estimates }
    }

    /// The share of an incident patch's light that leaves into a patch of the front or the back, after so many batches.
    pub(super) fn share(&self, incident: usize, to_front: bool, patch: usize, batches: u64) -> Estimate {
        self.estimates[incident].get(patch_cell(self.basis, to_front, patch), batches, LIGHT_BATCH)
    }

    /// A sum of an incident patch.
    pub(super) fn sum(&self, incident: usize, sum: Sum, batches: u64) -> Estimate {
        self.estimates[incident].get(sum_cell(self.basis, sum), batches, LIGHT_BATCH)
    }
}

/// Cells of an incident patch.
fn width(basis: &Basis) -> usize {
    2 * basis.count() + SUMS
}

fn patch_cell(basis: &Basis, to_front: bool, patch: usize) -> usize {
    if to_front { patch } else { basis.count() + patch }
}

fn sum_cell(basis: &Basis, sum: Sum) -> usize {
    2 * basis.count() + sum as usize
}

/// Takes batches that start with the incident patches in `order`, one after the other.
#[derive(Debug)]
pub(super) struct InOrder<'a> {
    pub(super) tally: &'a Tally<'a>,
    pub(super) order: &'a [usize],
}

/// A worker's batch.
#[derive(Debug)]
pub(super) struct Room<'a> {
    place: &'a Place,
    basis: &'a Basis,
    sums: WorkerSums,
    left: Channels,
}

impl<'a> Collector for InOrder<'a> {
    type Room = Room<'a>;

    fn room(&self) -> Room<'a> {
        let Tally { place, basis, .. } = *self.tally;
        Room { place, basis, sums: WorkerSums::new(width(basis)), left: [0.0; 3] }
    }

    fn add(&self, batch: &Batch<'_>, room: &mut Room<'a>) {
        let incident = self.order[(batch.number % self.order.len() as u64) as usize];
        let left = std::mem::take(&mut room.left);
        let (emitted, cut_off) = (batch.flux.emitted, batch.flux.cut_off);
        let absorbed = [0, 1, 2].map(|k| emitted[k] - left[k] - cut_off[k]);
        room.sums.add(sum_cell(room.basis, Sum::CutOff), cut_off);
        room.sums.add(sum_cell(room.basis, Sum::Absorbed), absorbed);
        self.tally.estimates[incident].complete(&mut room.sums);
        self.tally.estimates[incident].join(&mut room.sums);
    }
}

impl Receiver for Room<'_> {
    fn arrived(&mut self, _: &Arrivals) {}

    fn escaped(&mut self, escapes: &Escapes) {
        let three = |columns: &[Column; 3], entry: usize| [0, 1, 2].map(|k| f64::from(columns[k][entry]));
        for entry in 0..escapes.count {
            let [place, direction, flux] = [&escapes.origin, &escapes.direction, &escapes.flux].map(|columns| three(columns, entry));
            (0..3).for_each(|k| self.left[k] += flux[k]);
            match self.place.outgoing(place, direction) {
                None => self.sums.add(sum_cell(self.basis, Sum::Lost), flux),
                Some(to) => {
                    let to_front = to[2] > 0.0;
                    self.sums.add(patch_cell(self.basis, to_front, self.basis.outgoing_patch(to)), flux);
                    self.sums.add(sum_cell(self.basis, if to_front { Sum::Front } else { Sum::Back }), flux);
                }
            }
        }
    }
}
