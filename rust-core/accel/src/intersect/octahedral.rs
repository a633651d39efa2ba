//! Directions in two numbers (Cigolle et al.: A Survey of Efficient Representations for Independent Unit Vectors, 2014).

/// The octahedral coordinates of a vector of any length, −1 to 1.
pub(super) fn octahedral(n: [f32; 3]) -> [f32; 2] {
    let sum = n[0].abs() + n[1].abs() + n[2].abs();
    let [x, y] = [n[0] / sum, n[1] / sum];
    if n[2] >= 0.0 { [x, y] } else { [(1.0 - y.abs()).copysign(x), (1.0 - x.abs()).copysign(y)] }
}

/// A vector of octahedral coordinates; not unit.
pub(super) fn from_octahedral([x, y]: [f32; 2]) -> [f32; 3] {
    let z = 1.0 - x.abs() - y.abs();
    let fold = (-z).max(0.0);
    [x - fold.copysign(x), y - fold.copysign(y), z]
}
