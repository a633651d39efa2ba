//! Where a part of a model is.

/// Three rows of a turn and a shift: x' = row · (x, y, z, 1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place(pub [[f64; 4]; 3]);

impl Place {
    /// Where nothing is moved.
    pub const ORIGIN: Self = Self([[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]]);

    /// A shift in metres after turns in degrees about the local axes, in L3D's fixed order Z, X, Y.
    pub fn new(position: [f64; 3], degrees: [f64; 3]) -> Self {
        let [(sx, cx), (sy, cy), (sz, cz)] = degrees.map(|angle| angle.to_radians().sin_cos());
        let x = Self([[1.0, 0.0, 0.0, 0.0], [0.0, cx, -sx, 0.0], [0.0, sx, cx, 0.0]]);
        let y = Self([[cy, 0.0, sy, 0.0], [0.0, 1.0, 0.0, 0.0], [-sy, 0.0, cy, 0.0]]);
        let mut z = Self([[cz, -sz, 0.0, 0.0], [sz, cz, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]]);
        z.0.iter_mut().zip(position).for_each(|(row, shift)| row[3] = shift);
        z.then(&x).then(&y)
    }

    /// The place of what has the place `inner` within this one.
    #[must_use]
    pub fn then(&self, inner: &Self) -> Self {
        let cell = |row: &[f64; 4], column: usize| (0..3).map(|k| row[k] * inner.0[k][column]).sum::<f64>();
        Self(self.0.map(|row| std::array::from_fn(|column| cell(&row, column) + if column == 3 { row[3] } else { 0.0 })))
    }

    /// Where a point comes to be.
    pub fn point(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        self.0.map(|row| row[0] * x + row[1] * y + row[2] * z + row[3])
    }

    /// Where a direction points then.
    pub fn direction(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        self.0.map(|row| row[0] * x + row[1] * y + row[2] * z)
    }

    /// How far it turns: the greatest difference of an axis from where it was.
    pub(crate) fn turn(&self) -> f64 {
        let rows = self.0.iter().zip(Self::ORIGIN.0);
        rows.flat_map(|(row, own)| (0..3).map(move |k| (row[k] - own[k]).abs())).fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(found: [f64; 3], expected: [f64; 3]) {
        assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12), "{found:?} {expected:?}");
    }

    #[test]
    fn turns_are_about_local_axes_z_first() {
        // About z by 90° the local x points along y; about that by 90° the local y, which pointed along −x, points along z.
        let place = Place::new([1.0, 2.0, 3.0], [90.0, 0.0, 90.0]);
        close(place.direction([1.0, 0.0, 0.0]), [0.0, 1.0, 0.0]);
        close(place.direction([0.0, 1.0, 0.0]), [0.0, 0.0, 1.0]);
        close(place.point([0.0; 3]), [1.0, 2.0, 3.0]);
    }

    #[test]
    fn places_within_places() {
        let outer = Place::new([0.0, 0.0, 1.0], [0.0, 0.0, 90.0]);
        let inner = Place::new([2.0, 0.0, 0.0], [0.0; 3]);
        close(outer.then(&inner).point([1.0, 0.0, 0.0]), [0.0, 3.0, 1.0]);
        assert!(inner.turn() < 1e-15 && outer.turn() > 0.9);
    }
}
