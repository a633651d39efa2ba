//! One step from a level to the next for values of any number of components.

use super::mask::{VertexMask, limit_masks, refinement_masks};
use super::topology::Level;
use super::{Scheme, TriangleRule, bilinear, catmull_clark, loop_scheme};

/// The rule that values follow on one level.
pub(super) struct Stage<'a> {
    level: &'a Level,
    scheme: Scheme,
    triangles: TriangleRule,
    masks: Vec<VertexMask>,
    is_limit: bool,
}

impl<'a> Stage<'a> {
    /// From `level` to the next.
    pub(super) fn to_next(level: &'a Level, scheme: Scheme, triangles: TriangleRule) -> Self {
        let masks = match scheme {
            Scheme::CatmullClark => refinement_masks(level, catmull_clark::smooth_weights),
            Scheme::Loop => refinement_masks(level, loop_scheme::smooth_weights),
            Scheme::Bilinear => Vec::new(),
        };
        Self { level, scheme, triangles, masks, is_limit: false }
    }

    /// From `level` to the limit surface; bilinear values are there already.
    pub(super) fn to_limit(level: &'a Level, scheme: Scheme) -> Self {
        let masks = match scheme {
            Scheme::CatmullClark => limit_masks(level, catmull_clark::limit_weights),
            Scheme::Loop => limit_masks(level, loop_scheme::limit_weights),
            Scheme::Bilinear => Vec::new(),
        };
        Self { level, scheme, triangles: TriangleRule::CatmullClark, masks, is_limit: true }
    }
}

impl Rule for Stage<'_> {
    fn apply<const N: usize>(&self, values: &[[f32; N]]) -> Vec<[f32; N]> {
        match (self.scheme, self.is_limit) {
            (Scheme::CatmullClark, false) => catmull_clark::refine_values(self.level, &self.masks, self.triangles, values),
            (Scheme::CatmullClark, true) => catmull_clark::limit_values(self.level, &self.masks, values),
            (Scheme::Loop, false) => loop_scheme::refine_values(self.level, &self.masks, values),
            (Scheme::Loop, true) => loop_scheme::limit_values(self.level, &self.masks, values),
            (Scheme::Bilinear, false) => bilinear::refine_values(self.level, values),
            (Scheme::Bilinear, true) => values.to_vec(),
        }
    }
}

/// Linear interpolation from `level` to the next, whatever the scheme.
pub(super) struct Linear<'a> {
    pub(super) level: &'a Level,
    pub(super) scheme: Scheme,
}

impl Rule for Linear<'_> {
    fn apply<const N: usize>(&self, values: &[[f32; N]]) -> Vec<[f32; N]> {
        match self.scheme {
            Scheme::Loop => bilinear::refine_edges(self.level, values),
            Scheme::CatmullClark | Scheme::Bilinear => bilinear::refine_values(self.level, values),
        }
    }
}

/// A linear map from the elements of a level to those of the next, or of the limit.
pub(super) trait Rule {
    /// Elements of `N` components at the other end of the step.
    fn apply<const N: usize>(&self, values: &[[f32; N]]) -> Vec<[f32; N]>;

    /// As `apply` for any number of components; more than four go one at a time.
    fn apply_flat(&self, values: &[f32], components: usize) -> Vec<f32> {
        match components {
            1 => self.apply::<1>(values.as_chunks().0).into_flattened(),
            2 => self.apply::<2>(values.as_chunks().0).into_flattened(),
            3 => self.apply::<3>(values.as_chunks().0).into_flattened(),
            4 => self.apply::<4>(values.as_chunks().0).into_flattened(),
            _ => {
                let column = |k: usize| values.iter().skip(k).step_by(components).map(|&x| [x]).collect::<Vec<_>>();
                let columns: Vec<Vec<[f32; 1]>> = (0..components).map(|k| self.apply(&column(k))).collect();
                let count = columns.first().map_or(0, Vec::len);
                (0..count).flat_map(|row| columns.iter().map(move |column| column[row][0])).collect()
            }
        }
    }
}
