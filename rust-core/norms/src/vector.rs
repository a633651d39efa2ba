//! Vectors in the scene's space.

pub(crate) type Vector = [f64; 3];

/// Lengths up to this are none, m.
const NO_LENGTH: f64 = 1e-9;

/// `a`, and `b` so many times.
pub(crate) fn plus(a: Vector, b: Vector, times: f64) -> Vector {
    std::array::from_fn(|k| a[k] + times * b[k])
}

pub(crate) fn minus(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|k| a[k] - b[k])
}

pub(crate) fn dot(a: Vector, b: Vector) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}

pub(crate) fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(crate) fn distance(a: Vector, b: Vector) -> f64 {
    (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt()
}

/// A way of length 1; none of one that has hardly any.
pub(crate) fn unit(way: Vector) -> Option<Vector> {
    let length = distance(way, [0.0; 3]);
    (length > NO_LENGTH && length.is_finite()).then(|| way.map(|part| part / length))
}
