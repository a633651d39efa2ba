//! `Lanes8` in plain Rust, for the scalar level.

use super::lanes8::Lanes8;
use super::line_ray::SmoothHits;
use super::prepared::{Padded, PreparedRay};
use super::smooth::SmoothLeaf;
use super::smooth_scalar;
use super::transform::Affine;
use super::triangle_block::{BlockHits, TriangleBlock};
use crate::tree::node::{Node, WIDTH};

/// Boxes and triangles in loops over plain numbers.
#[derive(Clone, Copy)]
pub(crate) struct Scalar;

impl Lanes8 for Scalar {
    #[inline(always)]
    fn prepare(self, origin: Padded, direction: Padded, t_min: f32, t_max: f32) -> Option<PreparedRay> {
        PreparedRay::new(origin, direction, t_min, t_max)
    }

    #[inline(always)]
    fn image(self, map: &Affine, ray: &PreparedRay, t_max: f32) -> Option<PreparedRay> {
        PreparedRay::new(map.point(ray.origin), map.direction(ray.direction), ray.t_min, t_max)
    }

    #[inline(always)]
    fn boxes(self, node: &Node, ray: &PreparedRay, t_max: f32, near: &mut [f32; WIDTH]) -> u32 {
        let mut far = [t_max; WIDTH];
        *near = [ray.t_min; WIDTH];
        for axis in 0..3 {
            let near_planes = &node.bounds[ray.near_rows[axis] as usize / WIDTH];
            let far_planes = &node.bounds[ray.far_rows[axis] as usize / WIDTH];
            for slot in 0..WIDTH {
                let enter = near_planes[slot] * ray.reciprocal[axis] + ray.near_offset[axis];
                let leave = far_planes[slot] * ray.reciprocal[axis] + ray.far_offset[axis];
                near[slot] = if enter > near[slot] { enter } else { near[slot] };
                far[slot] = if leave < far[slot] { leave } else { far[slot] };
            }
        }
        let mut mask = 0;
        for slot in 0..WIDTH {
            mask |= u32::from(near[slot] <= far[slot]) << slot;
        }
        mask
    }

    #[inline(always)]
    fn triangles(self, block: &TriangleBlock, ray: &PreparedRay, t_max: f32, hits: &mut BlockHits) -> u32 {
        let [x_axis, y_axis, z_axis, _] = ray.axes.map(|axis| axis as usize / WIDTH);
        let mut mask = 0;
        for lane in 0..WIDTH {
            let corner = |k: usize| {
                let rows = &block.vertices[k];
                let z = rows[z_axis][lane] - ray.origin[z_axis];
                let x = (rows[x_axis][lane] - ray.origin[x_axis]) - ray.shear[0] * z;
                [x, (rows[y_axis][lane] - ray.origin[y_axis]) - ray.shear[1] * z, z]
            };
            let (a, b, c) = (corner(0), corner(1), corner(2));
            let u = c[0] * b[1] - c[1] * b[0];
            let v = a[0] * c[1] - a[1] * c[0];
            let w = b[0] * a[1] - b[1] * a[0];
            let determinant = u + v + w;
            let inverse = 1.0 / determinant;
            let t = (u * a[2] + (v * b[2] + w * c[2])) * inverse * ray.shear[2];
            let inside = (u >= 0.0 && v >= 0.0 && w >= 0.0) | (u <= 0.0 && v <= 0.0 && w <= 0.0);
            (hits.t[lane], hits.u[lane], hits.v[lane]) = (t, v * inverse, w * inverse);
            mask |= u32::from(inside & (t > ray.t_min) & (t <= t_max)) << lane;
        }
        mask
    }

    #[inline(always)]
    fn smooth(self, leaf: SmoothLeaf<'_>, ray: &PreparedRay, t_max: f32, hits: &mut SmoothHits) -> u32 {
        smooth_scalar::intersect(leaf, ray, t_max, hits)
    }
}
