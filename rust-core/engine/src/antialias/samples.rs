//! Traced values, and what is compared of them.

use crate::{colour::linear_to_srgb, transport::TileSums};
use gonio_simd::{Column, Execution, F, Lanes, Rgb, dispatch, padded};

/// Channels of a value: red, green, blue and coverage.
pub(super) const CHANNELS: usize = 4;

/// Values by place, and how they are shown.
#[derive(Debug, Default)]
pub(super) struct Samples {
    /// Radiance and coverage.
    pub(super) values: [Column; CHANNELS],
    /// Red, green and blue as a display shows them, 1 for white; logarithmic above.
    pub(super) shown: [Column; 3],
}

impl Samples {
    /// Room for so many, once; all are empty.
    pub(super) fn clear(&mut self, room: usize) {
        for column in self.values.iter_mut().chain(&mut self.shown) {
            if column.len() < room {
                *column = Column::new(padded(room) + gonio_simd::PADDING);
            }
        }
        self.values.iter_mut().for_each(|column| column.fill(0.0));
    }

    /// Adds the values of traced slots to the places that they are of.
    pub(super) fn add(&mut self, places: &[u32], traced: &TileSums) {
        let columns = traced.radiance.iter().chain([&traced.alpha]);
        for (values, traced) in self.values.iter_mut().zip(columns) {
            places.iter().zip(traced.iter()).for_each(|(place, value)| values[*place as usize] += value);
        }
    }

    /// Computes how the first `count` values are shown, `scale` times the radiance.
    pub(super) fn show(&mut self, execution: Execution, count: usize, scale: f32) {
        dispatch!(execution, l => show(l, self, count, scale));
    }

    /// The values at some places.
    #[inline(always)]
    pub(super) fn shown_at<L: Lanes>(&self, l: L, at: usize) -> Rgb<L> {
        let [r, g, b] = &self.shown;
        Rgb::new(l.load(r, at), l.load(g, at), l.load(b, at))
    }

    /// The values at any places.
    #[inline(always)]
    pub(super) fn shown_of<L: Lanes>(&self, l: L, place: gonio_simd::U<L>) -> Rgb<L> {
        let [r, g, b] = &self.shown;
        Rgb::new(l.gather(r, place), l.gather(g, place), l.gather(b, place))
    }
}

#[inline(always)]
fn show<L: Lanes>(l: L, samples: &mut Samples, count: usize, scale: f32) {
    for (values, shown) in samples.values.iter().zip(&mut samples.shown) {
        for at in (0..count).step_by(L::COUNT) {
            display(l.load(values, at) * scale).store(shown, at);
        }
    }
}

/// The display's curve (IEC 61966-2-1), and above white a logarithm that goes on as steeply: tone maps that compress show differences there too.
#[inline(always)]
fn display<L: Lanes>(x: F<L>) -> F<L> {
    const SLOPE: f32 = 1.055 / 2.4;
    let bright = x.max(1.0).ln() * SLOPE + 1.0;
    x.gt(1.0).select(bright, linear_to_srgb(x.saturate()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio_simd::One;

    #[test]
    fn what_is_shown_grows_without_steps() {
        let shown = |x: f32| display(F::<One>(x)).0;
        assert!((shown(1.0) - 1.0).abs() < 1e-5 && shown(0.0) == 0.0 && shown(-1.0) == 0.0);
        assert!((shown(0.5) - 0.735_36).abs() < 1e-4);
        let mut before = 0.0;
        for step in 1..4000 {
            let next = shown(step as f32 * 1e-3);
            assert!(next > before && next - before < 0.02, "{step}");
            before = next;
        }
    }
}
