//! What a fit of three unknowns needs of matrices.

use crate::colour::inverse;

/// Rows that a sum over pairs of vectors has: for each of `left`'s components the products with `right`.
pub(super) fn products<const N: usize>(pairs: impl Iterator<Item = ([f64; N], [f64; 3])>) -> [[f64; 3]; N] {
    let mut sums = [[0.0; 3]; N];
    for (left, right) in pairs {
        for (row, left) in sums.iter_mut().zip(left) {
            row.iter_mut().zip(right).for_each(|(sum, right)| *sum += left * right);
        }
    }
    sums
}

/// Rows times a matrix of three.
pub(super) fn times<const N: usize>(rows: &[[f64; 3]; N], matrix: &[[f64; 3]; 3]) -> [[f64; 3]; N] {
    rows.map(|row| std::array::from_fn(|k| (0..3).map(|j| row[j] * matrix[j][k]).sum()))
}

/// The inverse of a matrix, zero where there is none.
pub(super) fn inverted(matrix: &[[f64; 3]; 3]) -> [[f64; 3]; 3] {
    inverse(matrix).unwrap_or_default()
}
