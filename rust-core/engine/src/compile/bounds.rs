//! World bounds.

use super::{lights::sized, numbers::geometry_number};
use crate::scene::{LightShape, Mesh, Scene, Transform};

/// A box, empty when its minimum is above its maximum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Least coordinates, metres.
    pub min: [f64; 3],
    /// Greatest coordinates, metres.
    pub max: [f64; 3],
}

impl Default for Bounds {
    fn default() -> Self {
        Self { min: [f64::INFINITY; 3], max: [f64::NEG_INFINITY; 3] }
    }
}

impl Bounds {
    /// World bounds of everything placed in a scene.
    pub fn of_scene(scene: &Scene) -> Self {
        of_instances(scene, &of_geometry(scene))
    }
    /// Bounds of a scene's surfaces and of its lights that have a place, after a map of the world.
    pub(crate) fn of_all(scene: &Scene, map: &Transform) -> Self {
        let mut bounds = Self::default();
        let all = of_geometry(scene);
        for instances in &scene.instances {
            let mesh = all.get(geometry_number(scene, instances.geometry)).copied().unwrap_or_default();
            instances.transforms.iter().for_each(|transform| bounds.join(&mesh.transformed(&map.after(transform))));
        }
        for light in scene.lights.iter().filter(|light| !light.shape.is_at_infinity()) {
            // Sizes are in the map's axes.
            let half = match &light.shape {
                LightShape::Point => [0.0; 3],
                LightShape::Opening(opening) => opening.size.map(|x| 0.5 * x),
                LightShape::Rectangle { .. } | LightShape::Disk { .. } | LightShape::Ellipse { .. } => [1.0, 1.0, 0.0],
                _ => [1.0; 3],
            };
            bounds.join(&Self { min: half.map(|x| -x), max: half }.transformed(&map.after(&sized(light))));
        }
        bounds
    }
    /// Takes another box in.
    fn join(&mut self, other: &Self) {
        if !other.is_empty() {
            self.extend(other.min);
            self.extend(other.max);
        }
    }
    /// Whether nothing is inside.
    pub fn is_empty(&self) -> bool {
        (0..3).any(|i| self.min[i] > self.max[i])
    }
    /// Takes a point in; points that are not finite are left out.
    pub fn extend(&mut self, p: [f64; 3]) {
        if p.iter().all(|x| x.is_finite()) {
            for (i, x) in p.iter().enumerate() {
                self.min[i] = self.min[i].min(*x);
                self.max[i] = self.max[i].max(*x);
            }
        }
    }
    /// The box of the corners under a map.
    pub fn transformed(&self, transform: &Transform) -> Self {
        let mut out = Self::default();
        if !self.is_empty() {
            for corner in 0..8 {
                out.extend(transform.point(std::array::from_fn(|i| if corner >> i & 1 == 0 { self.min[i] } else { self.max[i] })));
            }
        }
        out
    }
    /// The middle.
    pub fn centre(&self) -> [f64; 3] {
        std::array::from_fn(|i| 0.5 * (self.min[i] + self.max[i]))
    }
    /// The sphere around it, its centre as single precision has it about `origin`.
    pub(crate) fn sphere(&self, origin: [f64; 3]) -> ([f32; 3], f64) {
        let centre = self.centre();
        (std::array::from_fn(|i| (centre[i] - origin[i]) as f32), self.radius())
    }
    /// Half the diagonal.
    pub fn radius(&self) -> f64 {
        0.5 * (0..3).map(|i| (self.max[i] - self.min[i]).powi(2)).sum::<f64>().sqrt()
    }
    /// Where single precision has its origin: the middle of scenes that lie farther away than they are large, else zero, so that small edits
    /// do not move it.
    pub(super) fn rebase_origin(&self) -> [f64; 3] {
        if self.is_empty() {
            return [0.0; 3];
        }
        let centre = self.centre();
        let away = centre.iter().map(|x| x * x).sum::<f64>().sqrt();
        if away > 2.0 * self.radius() { centre } else { [0.0; 3] }
    }
}

/// Bounds of meshes, curves and points in their own spaces.
fn of_geometry(scene: &Scene) -> Vec<Bounds> {
    let curves = scene.curves.iter().map(|curves| of_points(&curves.points, &curves.widths.values));
    let points = scene.points.iter().map(|points| of_points(&points.points, &points.widths.values));
    scene.meshes.iter().map(of_mesh).chain(curves).chain(points).collect()
}

/// Bounds of points with diameters, the largest for all.
fn of_points(points: &[[f32; 3]], widths: &[f32]) -> Bounds {
    let radius = 0.5 * f64::from(widths.iter().copied().filter(|width| width.is_finite()).fold(0.0, f32::max));
    let mut bounds = Bounds::default();
    for point in points.iter().map(|point| point.map(f64::from)) {
        bounds.extend(point.map(|x| x - radius));
        bounds.extend(point.map(|x| x + radius));
    }
    bounds
}

/// Bounds of a mesh in its own space.
pub(super) fn of_mesh(mesh: &Mesh) -> Bounds {
    let mut bounds = Bounds::default();
    for point in mesh.points.iter().chain(mesh.motion.iter().flat_map(|key| key.points.iter())) {
        bounds.extend(point.map(f64::from));
    }
    bounds
}

/// Bounds of all instances of meshes whose own bounds are known.
pub(super) fn of_instances(scene: &Scene, meshes: &[Bounds]) -> Bounds {
    let mut bounds = Bounds::default();
    for instances in &scene.instances {
        let Some(mesh) = meshes.get(geometry_number(scene, instances.geometry)) else { continue };
        for transform in &instances.transforms {
            bounds.join(&mesh.transformed(transform));
        }
        for transform in instances.motion.iter().flatten() {
            bounds.join(&mesh.transformed(transform));
        }
    }
    bounds
}
