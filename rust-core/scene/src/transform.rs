//! Affine maps in double precision.

use serde::{Deserialize, Serialize};

/// An affine map from local to world space, metres, f64: `columns[0..3]` are the images of the axes, `columns[3]` the origin.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Transform {
    /// Images of x, y, z, and the origin.
    pub columns: [[f64; 3]; 4],
}

impl Default for Transform {
    fn default() -> Self {
        Self::IDENTITY
    }
}

impl Transform {
    /// The identity.
    pub const IDENTITY: Self = Self { columns: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, 0.0]] };

    /// From a 4×4 matrix for row vectors (translation in the last row), as USD and Blender's transposed matrices have it.
    pub fn from_row_vector_matrix(m: &[[f64; 4]; 4]) -> Self {
        let mut columns = [[0.0; 3]; 4];
        for (column, row) in columns.iter_mut().zip(m) {
            column.copy_from_slice(&row[..3]);
        }
        Self { columns }
    }
    /// A uniform scale about the origin.
    pub fn scale(s: f64) -> Self {
        Self { columns: [[s, 0.0, 0.0], [0.0, s, 0.0], [0.0, 0.0, s], [0.0; 3]] }
    }
    /// A translation.
    pub fn translation(t: [f64; 3]) -> Self {
        Self { columns: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], t] }
    }
    /// The image of a vector.
    pub fn vector(&self, v: [f64; 3]) -> [f64; 3] {
        let c = &self.columns;
        std::array::from_fn(|i| c[0][i] * v[0] + c[1][i] * v[1] + c[2][i] * v[2])
    }
    /// The image of a point.
    pub fn point(&self, p: [f64; 3]) -> [f64; 3] {
        let v = self.vector(p);
        std::array::from_fn(|i| v[i] + self.columns[3][i])
    }
    /// The same turns, mirrors and place, with axes of length 1; flattened axes stay.
    pub fn without_scale(&self) -> Self {
        let mut unit = *self;
        for column in &mut unit.columns[..3] {
            let length = column.iter().map(|x| x * x).sum::<f64>().sqrt();
            if length > 0.0 {
                column.iter_mut().for_each(|x| *x /= length);
            }
        }
        unit
    }
    /// This map after `inner`.
    pub fn after(&self, inner: &Self) -> Self {
        let c = &inner.columns;
        Self { columns: [self.vector(c[0]), self.vector(c[1]), self.vector(c[2]), self.point(c[3])] }
    }
    /// The determinant of the linear part; negative for mirrored, zero for flattened maps.
    pub fn determinant(&self) -> f64 {
        let [a, b, c, _] = &self.columns;
        a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])
    }
    /// The inverse, or `None` for flattened or non-finite maps.
    pub fn inverse(&self) -> Option<Self> {
        let det = self.determinant();
        if !det.is_finite() || det == 0.0 || !self.is_finite() {
            return None;
        }
        let [a, b, c, t] = &self.columns;
        let cross = |u: &[f64; 3], v: &[f64; 3]| [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        let rows = [cross(b, c), cross(c, a), cross(a, b)];
        let mut inverse = Self { columns: [[0.0; 3]; 4] };
        for (i, row) in rows.iter().enumerate() {
            for (j, value) in row.iter().enumerate() {
                inverse.columns[j][i] = value / det;
            }
        }
        let moved = inverse.vector(*t);
        inverse.columns[3] = [-moved[0], -moved[1], -moved[2]];
        inverse.is_finite().then_some(inverse)
    }
    /// Whether every number is finite.
    pub fn is_finite(&self) -> bool {
        self.columns.iter().flatten().all(|x| x.is_finite())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inverse_undoes_the_map() {
        let t = Transform { columns: [[1.0, 2.0, 0.5], [-1.0, 3.0, 0.0], [0.2, 0.1, -2.0], [10.0, 20.0, 30.0]] };
        let p = t.inverse().expect("invertible").point(t.point([0.3, -0.7, 1.9]));
        for (found, expected) in p.iter().zip([0.3, -0.7, 1.9]) {
            assert!((found - expected).abs() < 1e-12, "{p:?}");
        }
    }

    #[test]
    fn flattened_maps_have_no_inverse() {
        assert_eq!(Transform::scale(0.0).inverse(), None);
        assert_eq!(Transform::scale(f64::NAN).inverse(), None);
    }
}
