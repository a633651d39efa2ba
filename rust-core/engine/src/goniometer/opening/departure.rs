//! Light that leaves, a part of it: places and directions of the first rays, the same ones whatever the threads.

use std::sync::{
    Mutex, PoisonError,
    atomic::{AtomicBool, Ordering},
};

/// So many are enough.
const ENOUGH: usize = 1 << 14;

/// A ray that leaves the luminaire, in its frame.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct Departure {
    /// Where it was last turned, metres.
    pub(in super::super) place: [f64; 3],
    /// Unit.
    pub(in super::super) direction: [f64; 3],
}

/// Departures of whole batches, by their numbers.
#[derive(Debug, Default)]
pub(in super::super) struct Sample {
    batches: Mutex<Vec<(u64, Vec<Departure>)>>,
    full: AtomicBool,
}

impl Sample {
    /// Whether more are wanted.
    pub(in super::super) fn is_wanted(&self) -> bool {
        !self.full.load(Ordering::Relaxed)
    }

    /// Takes a batch's.
    pub(in super::super) fn add(&self, number: u64, departures: Vec<Departure>) {
        if !departures.is_empty() {
            self.batches.lock().unwrap_or_else(PoisonError::into_inner).push((number, departures));
        }
    }

    /// Asked between rounds, whose batches are always the same: whether it is enough.
    pub(in super::super) fn settle(&self) {
        let count: usize = self.batches.lock().unwrap_or_else(PoisonError::into_inner).iter().map(|(_, batch)| batch.len()).sum();
        self.full.store(count >= ENOUGH, Ordering::Relaxed);
    }

    /// All of them in the order of their batches.
    pub(in super::super) fn all(&self) -> Vec<Departure> {
        let mut batches = self.batches.lock().unwrap_or_else(PoisonError::into_inner).clone();
        batches.sort_by_key(|(number, _)| *number);
        batches.into_iter().flat_map(|(_, batch)| batch).collect()
    }
}
