//! Surfaces of the radiance 1, whose light is sent from points spread over them, are as bright as camera rays find them.

use super::tests::{kinds, seen};
use crate::tests::{table, uniform};
use crate::{CameraTable, Lens};
use gonio_simd::{Lanes, One, Vec3};
use std::f32::consts::{PI, TAU};

const PIXELS: [usize; 2] = [8, 4];
const COUNT: u64 = 1 << 17;

/// What shines, in the camera's surroundings.
#[derive(Clone, Copy, Debug)]
enum Shape {
    /// A sphere of this radius about the camera's place, seen from inside. All pixels that the lens maps are 1.
    Room(f32),
    /// A disk of this radius so far ahead of the camera, across its axis.
    Disk(f32, f32),
}

/// What the pixels hold and the variances of that.
struct Picture {
    sum: [f64; PIXELS[0] * PIXELS[1]],
    squares: [f64; PIXELS[0] * PIXELS[1]],
}

impl Picture {
    fn new() -> Self {
        Self { sum: [0.0; 32], squares: [0.0; 32] }
    }
    fn add(&mut self, raster: [f32; 2], value: f64) {
        let [x, y] = raster.map(f32::floor);
        if x >= 0.0 && x < PIXELS[0] as f32 && y >= 0.0 && y < PIXELS[1] as f32 {
            let at = y as usize * PIXELS[0] + x as usize;
            self.sum[at] += value;
            self.squares[at] += value * value;
        }
    }
    fn mean(&self, at: usize) -> (f64, f64) {
        let n = COUNT as f64;
        let mean = self.sum[at] / n;
        (mean, (self.squares[at] / n - mean * mean).max(0.0) / n)
    }
}

impl Shape {
    /// A point, the normal there and the whole area.
    fn sample(self, camera: &CameraTable, u: [f32; 2]) -> ([f32; 3], [f32; 3], f32) {
        let (sine, cosine) = (u[1] * TAU).sin_cos();
        let at = |v: [f32; 3]| [0, 1, 2].map(|k| camera.position[k] + (0..3).map(|i| v[i] * camera.axes[i][k]).sum::<f32>());
        match self {
            Self::Room(radius) => {
                let z = 1.0 - 2.0 * u[0];
                let across = (1.0 - z * z).max(0.0).sqrt();
                let normal = [-across * cosine, -across * sine, -z];
                ([0, 1, 2].map(|k| camera.position[k] - radius * normal[k]), normal, 4.0 * PI * radius * radius)
            }
            Self::Disk(radius, ahead) => {
                let r = radius * u[0].sqrt();
                (at([r * cosine, r * sine, -ahead]), camera.axes[2], PI * radius * radius)
            }
        }
    }
    /// Whether a ray meets it.
    fn holds(self, camera: &CameraTable, origin: [f32; 3], direction: [f32; 3]) -> bool {
        let along = |axis: usize, v: [f32; 3]| (0..3).map(|k| v[k] * camera.axes[axis][k]).sum::<f32>();
        let from = [0, 1, 2].map(|k| origin[k] - camera.position[k]);
        match self {
            Self::Room(_) => true,
            Self::Disk(radius, ahead) => {
                let t = (-ahead - along(2, from)) / along(2, direction);
                let at = [0, 1].map(|axis| along(axis, from) + t * along(axis, direction));
                t > 0.0 && at[0].hypot(at[1]) < radius
            }
        }
    }
}

fn by_light(camera: &CameraTable, shape: Shape) -> Picture {
    let mut picture = Picture::new();
    for i in 0..COUNT {
        let number = |k: u64| uniform(40 + k, i);
        let (point, normal, area) = shape.sample(camera, [number(0), number(1)]);
        let found = seen(camera, point, [number(2), number(3)]);
        let cosine = -(0..3).map(|k| normal[k] * found.direction[k]).sum::<f32>();
        if found.valid && cosine > 0.0 {
            picture.add(found.raster, f64::from(area * cosine * found.importance));
        }
    }
    picture
}

fn by_camera(camera: &CameraTable, shape: Shape) -> Picture {
    let mut picture = Picture::new();
    let l = One;
    for i in 0..COUNT {
        let number = |k: u64| uniform(50 + k, i);
        let raster = [number(0) * PIXELS[0] as f32, number(1) * PIXELS[1] as f32];
        let ray = camera.ray(l, raster.map(|x| l.f(x)), [number(2), number(3)].map(|x| l.f(x)));
        let three = |v: Vec3<One>| [v.x, v.y, v.z].map(|x| x.to_array()[0]);
        if ray.mapped.any() && shape.holds(camera, three(ray.origin), three(ray.direction)) {
            picture.add(raster, (PIXELS[0] * PIXELS[1]) as f64);
        }
    }
    picture
}

#[test]
fn surfaces_of_even_radiance_are_as_bright_from_their_own_side() {
    for camera in kinds() {
        // The disk belongs to cameras whose axes are square to each other.
        let square = camera.axes[1][1] * camera.axes[2][1] == 0.0;
        for shape in [Shape::Room(6.0), Shape::Disk(2.5, 3.0)].into_iter().take(1 + usize::from(square)) {
            let (light, eye) = (by_light(&camera, shape), by_camera(&camera, shape));
            let (mut chi, mut cells, mut bright) = (0.0, 0.0, 0);
            for at in 0..PIXELS[0] * PIXELS[1] {
                let ((found, variance), (expected, other)) = (light.mean(at), eye.mean(at));
                if expected * COUNT as f64 > 500.0 {
                    chi += (found - expected).powi(2) / (variance + other);
                    cells += 1.0;
                    bright += usize::from(expected > 0.3);
                } else {
                    assert!(found < 0.1, "{camera:?} {shape:?} {at}: {found} for {expected}");
                }
            }
            let z = ((chi / cells).cbrt() - (1.0 - 2.0 / (9.0 * cells))) / (2.0f64 / (9.0 * cells)).sqrt();
            assert!(bright >= 1 && z < 4.75, "{camera:?} {shape:?}: chi-square {chi} over {cells} cells (z = {z})");
        }
    }
}

/// Panoramas turn their opening about the axis. There a place of the lens has two middle rays to a point, or none.
#[test]
fn wide_panoramas_are_as_bright_about_their_axis() {
    let wide = |lens| CameraTable { lens_radius: 0.8, focus_distance: 2.0, ..table(lens, [8.0, 4.0], [0.3, 0.2], [0.0; 2]) };
    for lens in [Lens::Equirectangular, Lens::Equidistant { limit: 1.0 }, Lens::Equisolid { limit: 0.5 }] {
        let picture = by_light(&wide(lens), Shape::Disk(4.0, 6.0));
        let (mean, variance) = (0..32).map(|at| picture.mean(at)).fold((0.0, 0.0), |a, b| (a.0 + b.0 / 32.0, a.1 + b.1 / 1024.0));
        assert!((mean - 1.0).abs() < 4.0 * variance.sqrt() && variance < 0.04f64.powi(2), "{lens:?}: {mean} by {}", variance.sqrt());
    }
}
