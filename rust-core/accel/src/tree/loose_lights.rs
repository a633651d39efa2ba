//! Loose lights: shapes of lights that stand beside the TLAS, where they are few. No shadow ray sees them.
//!
//! A register of rays is tested against a ball around each, which costs less than what the tree would take. Rays that meet the ball are tested
//! against the shape.

use super::instance::{Geometry, Instance};
use super::tlas::Tlas;
use crate::hit_callback::Beyond;
use crate::intersect::shape::Shape;
use crate::ray::{Covered, Hits, NONE, Passed, RayBatch};
use gonio_simd::{Execution, Lanes, Vec3, dispatch};

/// More shapes than this stand in the tree.
pub(crate) const MOST_LOOSE: usize = 8;

/// A shape's record, and a ball around it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LooseLight {
    pub(crate) record: u32,
    centre: [f32; 3],
    radius: f32,
}

/// A ball's radius is widened by this share of itself, of its distance and of its place's distance from the world's middle, for rounding.
const ROUNDING: f32 = 2e-6;

impl LooseLight {
    /// The shape of an instance whose record has a number; `None` for meshes.
    pub(crate) fn new(instance: &Instance, record: u32) -> Option<Self> {
        let Geometry::Shape(shape) = instance.geometry else { return None };
        let column = |k: usize| instance.object_to_world.map(|row| row[k]);
        let [x, y, z] = [column(0), column(1), column(2)];
        let radius = match shape {
            Shape::Rectangle => 0.5 * (dot(x, x) + dot(y, y) + 2.0 * dot(x, y).abs()).sqrt(),
            Shape::Disk => reach(&[x, y]),
            Shape::Sphere => reach(&[x, y, z]),
            Shape::Cylinder => 0.5 * dot(x, x).sqrt() + reach(&[y, z]),
        };
        let centre = column(3).map(|x| x as f32);
        let away: f32 = centre.iter().map(|x| x.abs()).sum();
        Some(LooseLight { record, centre, radius: radius as f32 * (1.0 + ROUNDING) + away * ROUNDING })
    }

    /// A box around it.
    pub(crate) fn bounds(&self) -> [[f32; 3]; 2] {
        [-self.radius, self.radius].map(|reach| self.centre.map(|x| x + reach))
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// How far these axes take the points of the unit ball at most: the root of a bound on the largest eigenvalue of their products (Gershgorin).
fn reach(axes: &[[f64; 3]]) -> f64 {
    let products = |a: &[f64; 3]| axes.iter().map(|b| dot(*a, *b).abs()).sum::<f64>();
    axes.iter().map(products).fold(0.0, f64::max).sqrt()
}

impl Tlas {
    /// Whether there are loose lights: then all shapes of lights are.
    pub fn has_loose_lights(&self) -> bool {
        !self.loose_lights.is_empty()
    }

    /// The nearest hit of every ray on loose lights, or else its hit in the tree from the query before: `behind`, an entry a ray.
    pub fn first_hit_before(&self, execution: Execution, rays: &RayBatch, behind: &[Covered], hits: &mut Hits) {
        hits.resize(rays.len());
        for (i, covered) in behind[..rays.len()].iter().enumerate() {
            hits.set(i, &covered.hit);
        }
        self.intersect_loose_lights(execution, rays, hits);
    }

    /// Replaces hits by nearer ones on loose lights.
    pub(crate) fn intersect_loose_lights(&self, execution: Execution, rays: &RayBatch, hits: &mut Hits) {
        hits.covered.clear();
        if self.has_loose_lights() {
            dispatch!(execution, l => intersect_balls(l, self, rays, hits));
            hits.covered.sort_unstable_by_key(|covered| covered.ray);
        }
    }

    /// The hit of ray `i` on one of them, if it is the nearest.
    fn intersect_one(&self, light: &LooseLight, rays: &RayBatch, i: usize, hits: &mut Hits) {
        let record = &self.records[light.record as usize];
        let Geometry::Shape(shape) = record.geometry.get() else { return };
        if record.mask & rays.mask[i] == 0 {
            return;
        }
        let before = hits.get(i);
        let passed = rays.passed.get(i).copied().unwrap_or(Passed::NOTHING);
        let mut beyond = Beyond::new(before, passed);
        record.intersect_shape(shape, rays.origin_of(i), rays.direction_of(i), rays.t_min[i].max(0.0), &mut beyond);
        let nearest = beyond.nearest();
        if nearest != before {
            if before.instance < self.records[self.loose_lights[0].record as usize].id || before.instance == NONE {
                hits.covered.push(Covered { ray: i as u32, hit: before });
            }
            hits.set(i, &nearest);
        }
    }
}

#[inline(always)]
fn intersect_balls<L: Lanes>(l: L, scene: &Tlas, rays: &RayBatch, hits: &mut Hits) {
    for at in (0..rays.len()).step_by(L::COUNT) {
        let vector =
            |columns: &[&[f32]; 3]| Vec3::new(l.load_to_end(columns[0], at), l.load_to_end(columns[1], at), l.load_to_end(columns[2], at));
        let (origin, direction) = (vector(&rays.origin), vector(&rays.direction));
        let (t_min, t_max) = (l.load_to_end(rays.t_min, at), l.load_to_end(&hits.t, at));
        let inverse_length = direction.length_squared().inverse_root();
        for light in &scene.loose_lights {
            let way = Vec3::splat(l, light.centre) - origin;
            let along = way.dot(direction) * (inverse_length * inverse_length);
            let foot = way - direction * along;
            let radius = (way.x.abs() + way.y.abs() + way.z.abs()).mul_add(ROUNDING, l.f(light.radius));
            let half = radius * inverse_length;
            let near = foot.length_squared().le(radius * radius) & t_min.le(along + half) & (along - half).le(t_max);
            let mut lanes = (near & l.first(rays.len() - at)).bits();
            while lanes != 0 {
                scene.intersect_one(light, rays, at + lanes.trailing_zeros() as usize, hits);
                lanes &= lanes - 1;
            }
        }
    }
}
