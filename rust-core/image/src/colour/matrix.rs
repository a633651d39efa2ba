//! 3×3 matrices in `f64`, rows first, for colour conversion at load time.

/// A matrix by rows.
pub type Matrix3 = [[f64; 3]; 3];

/// `m · v`.
pub fn apply(m: &Matrix3, v: [f64; 3]) -> [f64; 3] {
    [dot(m[0], v), dot(m[1], v), dot(m[2], v)]
}

/// `a · b`: what `b` maps, `a` maps on.
pub fn product(a: &Matrix3, b: &Matrix3) -> Matrix3 {
    let mut out = [[0.0; 3]; 3];
    for (row, out_row) in a.iter().zip(&mut out) {
        for (column, value) in out_row.iter_mut().enumerate() {
            *value = dot(*row, [b[0][column], b[1][column], b[2][column]]);
        }
    }
    out
}

/// The inverse, or nothing where the determinant is zero or not finite.
pub fn inverse(m: &Matrix3) -> Option<Matrix3> {
    let [a, b, c] = [cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])];
    let determinant = dot(m[0], a);
    let usable = determinant.is_finite() && determinant.abs() > 1e-12;
    usable.then(|| {
        let mut out = [[0.0; 3]; 3];
        for (row, out_row) in out.iter_mut().enumerate() {
            *out_row = [a[row] / determinant, b[row] / determinant, c[row] / determinant];
        }
        out
    })
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
