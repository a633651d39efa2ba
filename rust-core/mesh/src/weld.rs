//! Points that stand at the same place, as along seams, and one normal for each place.

use super::vector::{Vec3, add, angle_between, cross, dot, normalized, scale, sub};

/// No entry.
const NONE: u32 = u32::MAX;
/// Normals of one place whose mean is shorter than this cancel: sheets that lie back to back do not belong together.
const LEAST_MEAN: f32 = 1e-3;
/// What a place without area gets.
const FALLBACK: Vec3 = [0.0, 0.0, 1.0];

/// Which points stand at the same place, to the last bit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Weld {
    /// The place of each point.
    pub place: Vec<u32>,
    /// How many places there are.
    pub count: usize,
}

impl Weld {
    /// The places of points, numbered as they come.
    #[must_use]
    pub fn new(points: &[[f32; 3]]) -> Self {
        let mask = (points.len() * 2).next_power_of_two().max(2) - 1;
        let mut first = vec![NONE; mask + 1];
        let mut weld = Self { place: Vec::with_capacity(points.len()), count: 0 };
        for (number, point) in points.iter().enumerate() {
            let key = bits(point);
            let mut at = mixed(key) & mask;
            while first[at] != NONE && bits(&points[first[at] as usize]) != key {
                at = (at + 1) & mask;
            }
            if first[at] == NONE {
                first[at] = number as u32;
                weld.place.push(weld.count as u32);
                weld.count += 1;
            } else {
                weld.place.push(weld.place[first[at] as usize]);
            }
        }
        weld
    }

    /// The unit normal of each place: the mean of the corners' normals, or of the triangles' where there are none, weighted by their angles.
    /// Points of one place whose normals cancel become places of their own.
    #[must_use]
    pub fn normals(&mut self, points: &[[f32; 3]], triangles: &[[u32; 3]], corner: Option<&dyn Fn(usize) -> [f32; 3]>) -> Vec<[f32; 3]> {
        let mut own = vec![[0.0; 3]; points.len()];
        for (number, triangle) in triangles.iter().enumerate() {
            let corners = triangle.map(|point| points[point as usize]);
            let flat = triangle_normal(&corners).unwrap_or([0.0; 3]);
            for k in 0..3 {
                let normal = corner.map_or(flat, |corner| normalized(corner(3 * number + k)).unwrap_or(flat));
                let sum = &mut own[triangle[k] as usize];
                *sum = add(*sum, scale(normal, angle(&corners, k)));
            }
        }
        let mut sums = vec![([0.0; 3], 0.0_f32); self.count];
        for (place, normal) in self.place.iter().zip(&own) {
            if let Some(unit) = normalized(*normal) {
                let sum = &mut sums[*place as usize];
                *sum = (add(sum.0, unit), sum.1 + 1.0);
            }
        }
        let cancels = |(sum, count): &(Vec3, f32)| *count > 1.0 && dot(*sum, *sum).sqrt() < LEAST_MEAN * count;
        let cancelled: Vec<bool> = sums.iter().map(cancels).collect();
        for (point, place) in self.place.iter_mut().enumerate() {
            if cancelled.get(*place as usize).copied().unwrap_or(false) {
                *place = self.count as u32;
                self.count += 1;
                sums.push((normalized(own[point]).unwrap_or(FALLBACK), 1.0));
            }
        }
        sums.into_iter().map(|(sum, _)| normalized(sum).unwrap_or(FALLBACK)).collect()
    }
}

/// Coordinates as bits; zero has one sign.
fn bits(point: &[f32; 3]) -> [u32; 3] {
    point.map(|x| (x + 0.0).to_bits())
}

fn mixed([x, y, z]: [u32; 3]) -> usize {
    let mut hash = u64::from(x) | u64::from(y) << 32;
    hash = (hash ^ u64::from(z).rotate_left(17)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    hash = (hash ^ (hash >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    (hash ^ (hash >> 32)) as usize
}

/// Unit normal of a triangle, if it has an area.
pub(crate) fn triangle_normal(corners: &[Vec3; 3]) -> Option<Vec3> {
    let [a, b] = [sub(corners[1], corners[0]), sub(corners[2], corners[0])];
    normalized(cross(normalized(a)?, normalized(b)?))
}

/// Angle at a corner, radians.
pub(crate) fn angle(corners: &[Vec3; 3], k: usize) -> f32 {
    angle_between(sub(corners[(k + 1) % 3], corners[k]), sub(corners[(k + 2) % 3], corners[k]))
}
