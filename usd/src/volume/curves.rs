//! Coefficients that follow a field by a curve: the curve laid down in steps, and the field's numbers taken through it.

use gonio::scene::{Lattice, Medium};

/// Steps from no value of a field to its greatest.
pub(super) const STEPS: usize = 256;
/// What colours may be off those of the densest place, of its greatest, and be taken for them.
const TOLERANCE: f32 = 1e-4;

/// Absorption and scattering a metre, R, G, B each, evenly from 0 to the greatest value of a field.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Curve {
    steps: Vec<[f32; 6]>,
    most: f32,
}

/// What a field becomes by a curve: a medium, and what its extinction and scattering are multiplied by.
pub(super) struct Curved {
    pub(super) medium: Medium,
    pub(super) density: Lattice,
    /// Factors of each colour, where colours vary.
    pub(super) taken: Vec<Lattice>,
}

impl Curve {
    /// Of absorption and scattering at each step, up to a field's greatest value.
    pub(super) fn new(absorption: &[[f32; 3]], scattering: &[[f32; 3]], most: f32) -> Self {
        let both = |(a, s): (&[f32; 3], &[f32; 3])| [a[0], a[1], a[2], s[0], s[1], s[2]];
        Self { steps: absorption.iter().zip(scattering).map(both).collect(), most }
    }

    /// Whether there is something where the field is 0.
    pub(super) fn starts_above_nothing(&self) -> bool {
        self.steps.first().is_some_and(|first| first.iter().any(|x| *x > 0.0))
    }

    /// Absorption and scattering where the field has a value.
    fn at(&self, value: f32) -> [f32; 6] {
        let last = self.steps.len() - 1;
        let place = (value / self.most * last as f32).clamp(0.0, last as f32);
        let (low, high) = (self.steps[place as usize], self.steps[(place as usize + 1).min(last)]);
        std::array::from_fn(|part| (high[part] - low[part]).mul_add(place.fract(), low[part]))
    }

    /// A lattice through the curve; `medium` says the rest.
    pub(super) fn applied(&self, lattice: &Lattice, medium: &Medium) -> Curved {
        let densest = self.steps.iter().copied().max_by(|a, b| greatest(a).total_cmp(&greatest(b))).unwrap_or_default();
        let most = greatest(&densest).max(f32::MIN_POSITIVE);
        let density = through(lattice, |value| greatest(&self.at(value)) / most);
        let is_one = |step: &[f32; 6]| {
            let share = greatest(step) / most;
            step.iter().zip(densest).all(|(found, whole)| (found - share * whole).abs() <= TOLERANCE * most)
        };
        let [a, b, c, d, e, f] = densest;
        if self.steps.iter().all(is_one) {
            return Curved { medium: Medium { absorption: [a, b, c], scattering: [d, e, f], ..*medium }, density, taken: Vec::new() };
        }
        let scatters = self.steps.iter().any(|step| step[3..].iter().any(|x| *x > 0.0));
        let [absorption, scattering] = if scatters { [[0.0; 3], [most; 3]] } else { [[most; 3], [0.0; 3]] };
        let part = |number: usize| {
            let of = move |[a, b, c, d, e, f]: [f32; 6]| [a + d, b + e, c + f, d, e, f][number] / most;
            through(lattice, |value| of(self.at(value)))
        };
        Curved { medium: Medium { absorption, scattering, ..*medium }, density, taken: (0..6).map(part).collect() }
    }
}

/// The greatest component of the extinction.
fn greatest([a, b, c, d, e, f]: &[f32; 6]) -> f32 {
    (a + d).max(b + e).max(c + f)
}

/// A lattice whose numbers go through a function; where it holds none nothing is.
fn through(lattice: &Lattice, of: impl Fn(f32) -> f32) -> Lattice {
    let all = |values: &[f32]| values.iter().map(|value| of(*value)).collect();
    Lattice { values: all(&lattice.values), block_values: all(&lattice.block_values), ..lattice.clone() }
}
