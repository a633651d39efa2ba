//! Sets of rays, as paths in a scene make them one after the other.

use super::numbers::Random;
use gonio::accel::{Hits, NONE, RayBatch, RayMask};
use gonio::camera::CameraTable;
use gonio::geometry::{SurfacePoint, shadow_ray_to};
use gonio::light::LightSampleContext;
use gonio::transport::{Tables, kernels, ray_mask};
use gonio_simd::{Execution, F, M, One, U, Vec3};

/// Rays that own their columns.
#[derive(Clone, Debug, Default)]
pub(super) struct Rays {
    origin: [Vec<f32>; 3],
    direction: [Vec<f32>; 3],
    t_min: Vec<f32>,
    t_max: Vec<f32>,
    mask: Vec<RayMask>,
}

impl Rays {
    pub(super) fn len(&self) -> usize {
        self.t_max.len()
    }

    fn push(&mut self, origin: Vec3<One>, direction: Vec3<One>, t_max: f32, mask: RayMask) {
        let (o, d) = ([origin.x.0, origin.y.0, origin.z.0], [direction.x.0, direction.y.0, direction.z.0]);
        for axis in 0..3 {
            self.origin[axis].push(o[axis]);
            self.direction[axis].push(d[axis]);
        }
        self.t_min.push(0.0);
        self.t_max.push(t_max);
        self.mask.push(mask);
    }

    /// Up to `n` rays from `first` on.
    pub(super) fn batch(&self, first: usize, n: usize) -> RayBatch<'_> {
        let range = first..(first + n).min(self.len());
        RayBatch {
            origin: [0, 1, 2].map(|axis| &self.origin[axis][range.clone()]),
            direction: [0, 1, 2].map(|axis| &self.direction[axis][range.clone()]),
            t_min: &self.t_min[range.clone()],
            t_max: &self.t_max[range.clone()],
            mask: &self.mask[range],
            time: &[],
            passed: &[],
        }
    }

    /// One ray through every pixel's middle, in blocks of 4 × 4 pixels; the sides are multiples of 4.
    pub(super) fn camera(camera: &CameraTable, [width, height]: [usize; 2]) -> Self {
        let mut rays = Self::default();
        for block in 0..width * height / 16 {
            let (x, y) = (block % (width / 4) * 4, block / (width / 4) * 4);
            for k in 0..16 {
                let raster = [(x + k % 4) as f32 + 0.5, (y + k / 4) as f32 + 0.5];
                let ray = camera.ray(One, raster.map(F), [F(0.5); 2]);
                rays.push(ray.origin, ray.direction, ray.t_max.0, ray_mask::CAMERA);
            }
        }
        rays
    }

    /// Cosine-distributed rays from where these hit; those that hit nothing or a light end.
    pub(super) fn scattered(&self, tables: &Tables, random: &mut Random) -> Self {
        let mut rays = Self::default();
        for (point, normal) in self.surfaces(tables) {
            let (turn, z) = (random.unit() * std::f32::consts::TAU, 2.0 * random.unit() - 1.0);
            let ring = (1.0 - z * z).max(0.0).sqrt();
            let ball = Vec3::splat(One, [ring * turn.cos(), ring * turn.sin(), z]);
            let direction = (normal * 1.0001 + ball).normalize();
            rays.push(point.offset_ray_origin(direction), direction, f32::MAX, ray_mask::DIFFUSE);
        }
        rays
    }

    /// Rays from where these hit to one light each, as the renderer draws them.
    pub(super) fn to_lights(&self, tables: &Tables, random: &mut Random) -> Self {
        let mut rays = Self::default();
        for (point, normal) in self.surfaces(tables) {
            let [choice, u, v] = [random.unit(), random.unit(), random.unit()].map(F);
            let from = LightSampleContext { position: point.position, normal, receiver: U(0) };
            let sample = kernels::sample_li(One, tables, None, &from, &[choice, u, v]);
            if sample.pdf.0 > 0.0 && normal.dot(sample.wi).0 > 0.0 {
                let segment = shadow_ray_to(point.position, point.geometric_normal, point.error, sample.wi, sample.distance);
                rays.push(segment.origin, segment.direction, segment.t_max.0, ray_mask::SHADOW);
            }
        }
        rays
    }

    /// Surface points that the rays hit, and the normals on the rays' side.
    fn surfaces(&self, tables: &Tables) -> Vec<(SurfacePoint<One>, Vec3<One>)> {
        let mut hits = Hits::default();
        tables.bvh.first_hit(Execution::Scalar, &self.batch(0, self.len()), false, &mut hits);
        let at_surface = (0..self.len()).filter(|i| hits.instance[*i] != NONE && hits.instance[*i] < tables.first_light_instance);
        let point = |i: usize| {
            let (instance, primitive) = (U(hits.instance[i]), U(hits.primitive[i]));
            let hit = tables.geometry.hit_lanes(One, instance, primitive, F(hits.u[i]), F(hits.v[i]));
            let point = tables.geometry.surface_point(One, &hit);
            let direction = Vec3::splat(One, [0, 1, 2].map(|axis| self.direction[axis][i]));
            let back: M<One> = point.geometric_normal.dot(direction).gt(0.0);
            (point, back.select(-point.geometric_normal, point.geometric_normal))
        };
        at_surface.map(point).collect()
    }
}
