//! Arithmetic on plain `[f32; 3]` triples, in the few operations that meshes need.

pub(crate) type Vec3 = [f32; 3];

pub(crate) fn add(a: Vec3, b: Vec3) -> Vec3 {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

pub(crate) fn sub(a: Vec3, b: Vec3) -> Vec3 {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(crate) fn scale(a: Vec3, factor: f32) -> Vec3 {
    [a[0] * factor, a[1] * factor, a[2] * factor]
}

pub(crate) fn dot(a: Vec3, b: Vec3) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn cross(a: Vec3, b: Vec3) -> Vec3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The unit vector along `a`, or `None` where `a` has no usable direction (zero, NaN, infinite).
pub(crate) fn normalized(a: Vec3) -> Option<Vec3> {
    let largest = a[0].abs().max(a[1].abs()).max(a[2].abs());
    if !(largest > 0.0 && largest < f32::INFINITY) {
        return None;
    }
    // Scaling first keeps the squares of very small and very large vectors inside f32.
    let unit_box = [a[0] / largest, a[1] / largest, a[2] / largest];
    let length = dot(unit_box, unit_box).sqrt();
    (length > 0.0 && length.is_finite()).then(|| scale(unit_box, 1.0 / length))
}

/// Any unit vector perpendicular to the unit vector `n` (Duff et al. 2017, "Building an Orthonormal Basis, Revisited").
pub(crate) fn perpendicular(n: Vec3) -> Vec3 {
    let sign = 1.0f32.copysign(n[2]);
    let a = -1.0 / (sign + n[2]);
    let b = n[0] * n[1] * a;
    [1.0 + sign * n[0] * n[0] * a, sign * b, -sign * n[0]]
}

/// Angle in radians between two vectors of any length; 0 where one has no direction.
pub(crate) fn angle_between(a: Vec3, b: Vec3) -> f32 {
    let (Some(a), Some(b)) = (normalized(a), normalized(b)) else {
        return 0.0;
    };
    let sine = dot(cross(a, b), cross(a, b)).sqrt();
    sine.atan2(dot(a, b))
}

/// Newell's normal of a polygon, twice its area long, in f64 because large polygons far away lose f32's digits.
pub(super) fn newell(points: &[Vec3], vertices: &[u32]) -> [f64; 3] {
    let origin = vertices.first().map_or([0.0; 3], |&vertex| points[vertex as usize]);
    let relative = |vertex: u32| {
        let point = points[vertex as usize];
        [0, 1, 2].map(|axis| f64::from(point[axis]) - f64::from(origin[axis]))
    };
    let mut normal = [0.0; 3];
    for (i, &vertex) in vertices.iter().enumerate() {
        let (a, b) = (relative(vertex), relative(vertices[(i + 1) % vertices.len()]));
        for (axis, component) in normal.iter_mut().enumerate() {
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            *component += (a[u] - b[u]) * (a[v] + b[v]);
        }
    }
    normal
}
