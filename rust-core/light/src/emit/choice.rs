//! Which light sends: by power, with a little for each that is weak, so that a lamp is not starved by the sun.

use gonio_simd::{F, Lanes, U};

/// Share of the rays that all emitting lights get alike.
const EVEN: f64 = 0.1;

/// Lights by cumulative probability.
#[derive(Clone, Debug)]
pub(super) struct Choice {
    /// From 0 to exactly 1, one more than lights.
    cumulative: Vec<f32>,
    lights: Vec<u32>,
}

impl Choice {
    /// Of lights and their powers; what is not positive and finite is left out.
    pub(super) fn new(powers: impl Iterator<Item = (u32, f64)>) -> Self {
        let emitting: Vec<(u32, f64)> = powers.filter(|(_, power)| *power > 0.0 && power.is_finite()).collect();
        let total: f64 = emitting.iter().map(|(_, power)| power).sum();
        let (mut cumulative, mut sum) = (vec![0.0], 0.0);
        for (_, power) in &emitting {
            sum += EVEN / emitting.len() as f64 + (1.0 - EVEN) * power / total;
            cumulative.push(sum.min(1.0) as f32);
        }
        if let Some(last) = cumulative.last_mut().filter(|_| !emitting.is_empty()) {
            *last = 1.0;
        }
        Self { cumulative, lights: emitting.iter().map(|(light, _)| *light).collect() }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.lights.is_empty()
    }

    /// A light and its probability, for `u` in `[0, 1)`; there must be lights.
    #[inline(always)]
    pub(super) fn sample<L: Lanes>(&self, l: L, u: F<L>) -> (U<L>, F<L>) {
        let (place, [low, high]) = find(l, &self.cumulative, l.u(0), l.u(self.lights.len() as u32), u);
        (l.gather_integers(&self.lights, place), high - low)
    }
}

/// The interval that holds `u`, of `count` ones whose cumulative values, ascending, start at `first`; and its ends.
#[inline(always)]
pub(super) fn find<L: Lanes>(l: L, cumulative: &[f32], first: U<L>, count: U<L>, u: F<L>) -> (U<L>, [F<L>; 2]) {
    let (mut low, mut high) = (l.u(0), count);
    loop {
        let open = (low + 1).lt(high);
        if !open.any() {
            return (low, l.gather_pairs(cumulative, first + low));
        }
        let middle = (low + high) >> 1;
        let above = l.gather(cumulative, first + middle).le(u);
        low = (open & above).select(middle, low);
        high = open.and_not(above).select(middle, high);
    }
}
