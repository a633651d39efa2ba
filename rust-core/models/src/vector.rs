//! Vectors of three.

pub(crate) type Vec3 = [f64; 3];

pub(crate) fn sub(a: Vec3, b: Vec3) -> Vec3 {
    std::array::from_fn(|i| a[i] - b[i])
}

/// `a + b * factor`.
pub(crate) fn along(a: Vec3, b: Vec3, factor: f64) -> Vec3 {
    std::array::from_fn(|i| a[i] + b[i] * factor)
}

pub(crate) fn dot(a: Vec3, b: Vec3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn cross(a: Vec3, b: Vec3) -> Vec3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(crate) fn length(a: Vec3) -> f64 {
    dot(a, a).sqrt()
}

/// The unit vector; `None` of what has no direction.
pub(crate) fn unit(a: Vec3) -> Option<Vec3> {
    let long = length(a);
    (long.is_finite() && long > 1e-300).then(|| a.map(|x| x / long))
}

/// A unit vector across a unit vector.
pub(crate) fn across(z: Vec3) -> Vec3 {
    let helper = if z[0].abs() < 0.6 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
    unit(cross(helper, z)).unwrap_or([1.0, 0.0, 0.0])
}

/// Twice the area of an outline times its unit normal (Newell).
pub(crate) fn newell(points: &[Vec3]) -> Vec3 {
    let Some(&origin) = points.first() else { return [0.0; 3] };
    let pairs = points.iter().zip(points.iter().cycle().skip(1));
    pairs.fold([0.0; 3], |sum, (&a, &b)| along(sum, cross(sub(a, origin), sub(b, origin)), 1.0))
}
