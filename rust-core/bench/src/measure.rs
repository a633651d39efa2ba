//! Timing: all versions in turn, slot by slot, in processor time, so that a busy machine counts as little as can be.

use super::kernel::{Kernel, Outcome};
use cpu_time::ProcessTime;
use gonio::error::{Error, Result};
use gonio_simd::Execution;
use std::{
    hint::black_box,
    sync::atomic::{AtomicBool, Ordering},
    time::Instant,
};

/// Processor seconds of a slot: short beside a scheduler's time slice, so that most slots are undisturbed, and long beside the clock's resolution.
const SLOT: f64 = 1e-3;
/// Rounds at least, however long one takes.
const LEAST_ROUNDS: usize = 5;
/// Most calls in a slot.
const MOST_CALLS: f64 = 1e5;

/// A version of a kernel.
#[derive(Clone, Copy, Debug)]
pub(super) enum Variant {
    /// On lanes, one or more.
    Lanes(Execution),
    /// On the standard library's functions.
    Standard,
}

impl Variant {
    /// The level's name.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Lanes(execution) => execution.name(),
            Self::Standard => "std",
        }
    }
    /// Values done at once.
    pub(super) fn lanes(self) -> usize {
        match self {
            Self::Lanes(execution) => execution.lanes(),
            Self::Standard => 1,
        }
    }
    fn run(self, kernel: &mut dyn Kernel) -> Result<()> {
        match self {
            Self::Lanes(execution) => kernel.run(execution),
            Self::Standard => {
                kernel.run_standard();
                Ok(())
            }
        }
    }
}

/// Timed slots of all versions.
#[derive(Debug)]
pub(super) struct Slots {
    /// `seconds[round][variant]`: processor seconds a call, all threads together.
    pub(super) seconds: Vec<Vec<f64>>,
    /// The same by the clock.
    pub(super) clock: Vec<Vec<f64>>,
    /// What each version computed.
    pub(super) outcomes: Vec<Outcome>,
}

/// All versions that this machine has: the scalar level, the standard library's where there is one, then wider and wider ones.
pub(super) fn variants(standard: bool) -> Vec<Variant> {
    let mut levels: Vec<Variant> = Execution::all().into_iter().rev().map(Variant::Lanes).collect();
    if standard {
        levels.insert(1, Variant::Standard);
    }
    levels
}

/// Times rounds of one slot a version until the seconds are over.
pub(super) fn interleaved(kernel: &mut dyn Kernel, variants: &[Variant], seconds: f64, cancel: &AtomicBool) -> Result<Slots> {
    let mut outcomes = Vec::with_capacity(variants.len());
    let mut calls = vec![1; variants.len()];
    for (variant, calls) in variants.iter().zip(&mut calls).filter(|_| seconds > 0.0) {
        // The first call warms caches and branch predictors, the second tells how many make a slot.
        variant.run(kernel)?;
        let once = timed(*variant, 1, kernel)?.0;
        *calls = (SLOT / once.max(1e-9)).clamp(1.0, MOST_CALLS).round() as u32;
        if cancel.load(Ordering::Relaxed) {
            return Err(Error::Cancelled);
        }
    }
    let least = if seconds > 0.0 { LEAST_ROUNDS } else { 1 };
    let start = Instant::now();
    let (mut rounds, mut clock): (Vec<Vec<f64>>, Vec<Vec<f64>>) = Default::default();
    while rounds.len() < least || start.elapsed().as_secs_f64() < seconds {
        let mut round = [vec![0.0; variants.len()], vec![0.0; variants.len()]];
        for turn in 0..variants.len() {
            // Each round begins with another version, so that none always follows the same.
            let which = (turn + rounds.len()) % variants.len();
            (round[0][which], round[1][which]) = timed(variants[which], calls[which], kernel)?;
            // The first round goes through them in their order.
            if rounds.is_empty() {
                outcomes.push(kernel.outcome());
            }
        }
        let [processor, by_clock] = round;
        rounds.push(processor);
        clock.push(by_clock);
        if cancel.load(Ordering::Relaxed) {
            return Err(Error::Cancelled);
        }
    }
    Ok(Slots { seconds: rounds, clock, outcomes })
}

/// Seconds of processor time and by the clock a call, over some calls.
fn timed(variant: Variant, calls: u32, kernel: &mut dyn Kernel) -> Result<(f64, f64)> {
    let (start, clock) = (ProcessTime::now(), Instant::now());
    for _ in 0..calls {
        variant.run(black_box(&mut *kernel))?;
    }
    let calls = f64::from(calls);
    Ok((start.elapsed().as_secs_f64() / calls, clock.elapsed().as_secs_f64() / calls))
}
