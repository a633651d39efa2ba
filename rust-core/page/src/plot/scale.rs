//! Colours of classes of values.

use super::drawing::{Anchor, Drawing, Ink, LETTERS};
use crate::{
    Numbers,
    colour::{colour, ink},
};

/// Width of the legend's bar.
const BAR: f64 = 18.0;
/// Height of the sign of its unit.
const UNIT: f64 = 22.0;

/// Classes of values with a colour each: from each edge up to the next, the last one without an end where the scale is open.
#[derive(Clone, Debug)]
pub struct Scale {
    /// Rising.
    pub edges: Vec<f64>,
    /// Whether there is a class above the last edge.
    pub is_open: bool,
    /// The unit's sign.
    pub unit: String,
}

impl Scale {
    /// A scale whose edges rise.
    pub fn new(edges: &[f64], is_open: bool, unit: &str) -> Self {
        Self { edges: edges.to_vec(), is_open, unit: unit.to_owned() }
    }

    pub(super) fn classes(&self) -> usize {
        self.edges.len() - usize::from(!self.is_open)
    }

    /// The class of a value; what is below the first edge is of the first, what is above the last of the last.
    pub(super) fn class(&self, value: f64) -> usize {
        let above = self.edges.iter().filter(|edge| value >= **edge).count();
        above.saturating_sub(1).min(self.classes().saturating_sub(1))
    }

    fn share(&self, class: usize) -> f64 {
        class as f64 / (self.classes().max(2) - 1) as f64
    }

    pub(super) fn colour(&self, class: usize) -> String {
        colour(self.share(class))
    }

    /// The colour of a text over a class.
    pub(super) fn ink(&self, class: usize) -> &'static str {
        ink(self.share(class))
    }

    /// The legend: classes from the bottom up, their edges beside them, the unit above.
    pub(super) fn legend(&self, drawing: &mut Drawing, [x, y]: [f64; 2], height: f64, numbers: Numbers) {
        drawing.text([x, y + 0.5 * LETTERS + 3.0], Anchor::Start, Ink::Soft, &self.unit);
        let (low, one) = (y + height, (height - UNIT) / self.classes() as f64);
        for class in 0..self.classes() {
            drawing.rectangle([x, low - one * (class + 1) as f64], [BAR, one], &self.colour(class));
        }
        for (number, edge) in self.edges.iter().enumerate() {
            let middle = low - one * number as f64 + 0.35 * LETTERS;
            drawing.text([x + BAR + 6.0, middle], Anchor::Start, Ink::Full, &numbers.form(&edge.to_string()));
        }
    }
}
