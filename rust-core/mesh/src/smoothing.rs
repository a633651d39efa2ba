//! Which corners share a shading normal, so that normals can be made again where points have moved.

use super::Weld;
use super::vector::{Vec3, add, dot, normalized, scale};
use super::weld::{angle, triangle_normal};

/// No entry.
const NONE: u32 = u32::MAX;
/// The cosine between normals that count as one.
const ALIKE: f32 = 0.9999;
/// Groups of one place that a corner is compared with: bounds the cost of places with very many.
const MOST_GROUPS: usize = 64;

/// Corners at one place whose normals are alike are one group: what was smooth stays smooth, also over seams, and what was sharp sharp.
#[derive(Clone, Debug, Default)]
pub struct Smoothing {
    /// The group of each corner, three a triangle.
    pub group: Vec<u32>,
    /// The unit normal that a group had; zero where it had no direction.
    pub normals: Vec<[f32; 3]>,
}

impl Smoothing {
    /// The groups of triangles whose corners have these normals.
    #[must_use]
    pub fn new(weld: &Weld, triangles: &[[u32; 3]], normal: &dyn Fn(usize) -> [f32; 3]) -> Self {
        let mut made = Self { group: Vec::with_capacity(triangles.len() * 3), normals: Vec::new() };
        // Groups of a place are a list: its first one, and of each the next.
        let (mut first, mut next) = (vec![NONE; weld.count], Vec::<u32>::new());
        for (corner, point) in triangles.as_flattened().iter().enumerate() {
            let (place, own) = (weld.place[*point as usize] as usize, normalized(normal(corner)).unwrap_or([0.0; 3]));
            let (mut at, mut compared) = (first[place], 1);
            while at != NONE && compared < MOST_GROUPS && !alike(made.normals[at as usize], own) {
                (at, compared) = (next[at as usize], compared + 1);
            }
            if at == NONE {
                at = made.normals.len() as u32;
                made.normals.push(own);
                next.push(first[place]);
                first[place] = at;
            }
            made.group.push(at);
        }
        made
    }

    /// The groups' normals over points that have moved: the mean of their triangles' weighted by angle, as they were where that has no direction.
    #[must_use]
    pub fn remade(&self, points: &[[f32; 3]], triangles: &[[u32; 3]]) -> Vec<[f32; 3]> {
        let mut sums = vec![[0.0; 3]; self.normals.len()];
        for (triangle, groups) in triangles.iter().zip(self.group.as_chunks::<3>().0) {
            let corners = triangle.map(|point| points[point as usize]);
            let Some(normal) = triangle_normal(&corners) else { continue };
            for (k, group) in groups.iter().enumerate() {
                let sum = &mut sums[*group as usize];
                *sum = add(*sum, scale(normal, angle(&corners, k)));
            }
        }
        sums.iter().zip(&self.normals).map(|(sum, old)| normalized(*sum).unwrap_or(*old)).collect()
    }
}

fn alike(a: Vec3, b: Vec3) -> bool {
    a == b || dot(a, b) > ALIKE
}
