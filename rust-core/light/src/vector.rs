//! Small double-precision vectors for building tables.

pub(crate) type Vector = [f64; 3];

pub(crate) fn widen(v: [f32; 3]) -> Vector {
    v.map(f64::from)
}

pub(crate) fn narrow(v: Vector) -> [f32; 3] {
    v.map(|x| x as f32)
}

pub(crate) fn add(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

pub(crate) fn scale(a: Vector, s: f64) -> Vector {
    a.map(|x| x * s)
}

pub(crate) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(crate) fn length(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

/// The unit vector along `a`, or `fallback` where `a` has no direction.
pub(crate) fn unit_or(a: Vector, fallback: Vector) -> Vector {
    let size = length(a);
    if size > 0.0 && size.is_finite() { scale(a, 1.0 / size) } else { fallback }
}

/// Determinant of the matrix with these columns.
pub(crate) fn determinant(columns: [Vector; 3]) -> f64 {
    dot(columns[0], cross(columns[1], columns[2]))
}

/// Rows of the inverse of the matrix with these columns; `None` where it is singular.
pub(crate) fn inverse_rows(columns: [Vector; 3]) -> Option<[Vector; 3]> {
    let d = determinant(columns);
    let rows = [cross(columns[1], columns[2]), cross(columns[2], columns[0]), cross(columns[0], columns[1])].map(|row| scale(row, 1.0 / d));
    (d != 0.0 && rows.iter().flatten().all(|x| x.is_finite())).then_some(rows)
}

/// Singular values of the matrix with these columns: lengths of the columns after turning them orthogonal (one-sided Jacobi).
pub(crate) fn principal_axes(mut columns: [Vector; 3]) -> [f64; 3] {
    for _ in 0..30 {
        for (i, j) in [(0, 1), (0, 2), (1, 2)] {
            let (a, b) = (columns[i], columns[j]);
            let (aa, bb, ab) = (dot(a, a), dot(b, b), dot(a, b));
            if ab.abs() <= 1e-15 * (aa * bb).sqrt() {
                continue;
            }
            let tau = (bb - aa) / (2.0 * ab);
            let t = tau.signum() / (tau.abs() + (1.0 + tau * tau).sqrt());
            let c = 1.0 / (1.0 + t * t).sqrt();
            columns[i] = add(scale(a, c), scale(b, -c * t));
            columns[j] = add(scale(a, c * t), scale(b, c));
        }
    }
    columns.map(length)
}
