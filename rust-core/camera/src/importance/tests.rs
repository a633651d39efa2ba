//! Points of rays are seen where the rays came from; areas against finite differences in double precision.

use super::Seen;
use crate::tests::{cameras, uniform};
use crate::{Aperture, CameraTable, Lens};
use gonio_simd::{Column, Execution, F, Lanes, One, Vec3, dispatch};

/// A point seen, in one lane.
pub(super) struct Found {
    pub raster: [f32; 2],
    pub origin: [f32; 3],
    pub direction: [f32; 3],
    pub distance: f32,
    pub importance: f32,
    pub valid: bool,
}

fn three(v: Vec3<One>) -> [f32; 3] {
    [v.x, v.y, v.z].map(|x| x.to_array()[0])
}

pub(super) fn seen(camera: &CameraTable, point: [f32; 3], lens: [f32; 2]) -> Found {
    let l = One;
    let Seen { raster, origin, direction, distance, importance, valid } = camera.importance(l, Vec3::splat(l, point), lens.map(|x| l.f(x)));
    let one = |x: F<One>| x.to_array()[0];
    let (origin, direction) = (three(origin), three(direction));
    Found { raster: raster.map(one), origin, direction, distance: one(distance), importance: one(importance), valid: valid.any() }
}

/// Every kind of lens, as a pinhole and wide, upright and turned, with steps of pixels either way and axes that are not square to each other.
pub(super) fn kinds() -> Vec<CameraTable> {
    let wide = Aperture { blades: 5, rotation: 0.3, width: 0.5 };
    let (sine, cosine) = 0.7f32.sin_cos();
    let turned = [[cosine, sine, 0.0], [0.0, 0.0, 1.0], [sine, -cosine, 0.0]];
    let sheared = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.6, 0.8]];
    let mut all = Vec::new();
    for camera in cameras() {
        let mirrored =
            CameraTable { corner: [-camera.corner[0], camera.corner[1]], pixel: [-camera.pixel[0], camera.pixel[1]], ..camera.clone() };
        all.push(CameraTable { axes: turned, position: [3.0, -2.0, 1.0], ..camera.clone() });
        all.push(CameraTable { lens_radius: 0.25, aperture: wide, position: [0.5, 1.0, -2.0], ..camera.clone() });
        all.push(CameraTable { lens_radius: 0.2, axes: turned, focus_distance: 2.0, ..mirrored });
        all.push(CameraTable { lens_radius: 0.1, axes: sheared, ..camera });
    }
    all
}

/// A ray of the camera in double precision: the mean of its definition, by the sums of `CameraTable::ray` for a place (a, b) of the opening.
fn ray64(camera: &CameraTable, raster: [f64; 2], opening: [f64; 2]) -> [[f64; 3]; 2] {
    let wide = |x: f32| f64::from(x);
    let x = wide(camera.corner[0]) + raster[0] * wide(camera.pixel[0]);
    let y = wide(camera.corner[1]) - raster[1] * wide(camera.pixel[1]);
    let (d, [a, b]) = (wide(camera.focus_distance), opening);
    let (r, turn) = (x.hypot(y), y.atan2(x));
    let polar = |angle: f64| [angle.sin() * turn.cos(), angle.sin() * turn.sin(), -angle.cos()];
    let direction = match camera.lens {
        Lens::Perspective => return placed(camera, [a, b, 0.0], [x * d, y * d, -d]),
        Lens::Orthographic => return placed(camera, [x + a, y + b, 0.0], [x, y, -d]),
        Lens::Equirectangular => [y.cos() * x.sin(), y.sin(), -y.cos() * x.cos()],
        Lens::Equidistant { .. } => polar(r),
        Lens::Equisolid { .. } => polar(2.0 * r.asin()),
    };
    let [p, q, s] = direction;
    let length = p.hypot(q);
    let right = [p * s / length, q * s / length, (s * s - 1.0) / length];
    let up = [q * right[2] - s * right[1], s * right[0] - p * right[2], p * right[1] - q * right[0]];
    placed(camera, [0, 1, 2].map(|k| a * right[k] + b * up[k]), direction.map(|x| x * d))
}

fn placed(camera: &CameraTable, start: [f64; 3], through: [f64; 3]) -> [[f64; 3]; 2] {
    let world = |v: [f64; 3]| [0, 1, 2].map(|k| (0..3).map(|i| v[i] * f64::from(camera.axes[i][k])).sum::<f64>());
    let direction = world([0, 1, 2].map(|k| through[k] - start[k]));
    let length = direction.iter().map(|x| x * x).sum::<f64>().sqrt();
    let origin = world(start);
    [[0, 1, 2].map(|k| origin[k] + f64::from(camera.position[k])), direction.map(|x| x / length)]
}

fn opening(camera: &CameraTable, lens: [f32; 2]) -> [f64; 2] {
    let l = One;
    let place = camera.aperture.sample(lens.map(|x| l.f(x)));
    place.map(|x| f64::from(x.to_array()[0]) * f64::from(camera.lens_radius))
}

/// Places of the raster, of the lens and along the ray.
fn places() -> impl Iterator<Item = ([f32; 2], [f32; 2], f32)> {
    (0..400).map(|i| {
        let number = |k: u64| uniform(11 + k, i);
        ([number(0) * 8.0, number(1) * 4.0], [number(2), number(3)], 0.7 + 30.0 * number(4).powi(3))
    })
}

/// Whether the middle ray leads so close to the axis, forwards or backwards, that the opening turns within its own width.
fn about_the_axis(camera: &CameraTable, raster: [f32; 2]) -> bool {
    let [_, d] = ray64(camera, raster.map(f64::from), [0.0; 2]);
    let ahead: f64 = (0..3).map(|k| d[k] * f64::from(camera.axes[2][k])).sum();
    !matches!(camera.lens, Lens::Perspective | Lens::Orthographic) && ahead.abs() > 0.85
}

#[test]
fn points_of_rays_are_seen_where_the_rays_came_from() {
    for camera in kinds() {
        let mut met = 0;
        for (raster, lens, t) in places() {
            let l = One;
            let ray = camera.ray(l, raster.map(|x| l.f(x)), lens.map(|x| l.f(x)));
            if !ray.mapped.any() || about_the_axis(&camera, raster) {
                continue;
            }
            met += 1;
            let (origin, direction) = (three(ray.origin), three(ray.direction));
            let point = [0, 1, 2].map(|k| origin[k] + t * direction[k]);
            let found = seen(&camera, point, lens);
            assert!(found.valid, "{camera:?} {raster:?} {lens:?} {t}");
            let near = |a: &[f32], b: &[f32], error: f32| a.iter().zip(b).all(|(a, b)| (a - b).abs() <= error);
            assert!(near(&found.raster, &raster, 8e-4 * 0.5), "{camera:?} {raster:?} {lens:?} {t}: {:?}", found.raster);
            assert!(near(&found.origin, &origin, 1e-4) && near(&found.direction, &direction, 2e-5), "{camera:?} {raster:?} {lens:?} {t}");
            assert!((found.distance / t - 1.0).abs() < 1e-4, "{camera:?}: {} for {t}", found.distance);
        }
        assert!(met > 100, "{camera:?}: {met}");
    }
}

#[test]
fn importance_is_the_raster_area_of_an_area_across_the_ray() {
    for camera in kinds() {
        for (raster, lens, t) in places() {
            let place = opening(&camera, lens);
            let at = |dx: f64, dy: f64| ray64(&camera, [f64::from(raster[0]) + dx, f64::from(raster[1]) + dy], place);
            let [origin, direction] = at(0.0, 0.0);
            let point = [0, 1, 2].map(|k| origin[k] + f64::from(t) * direction[k]);
            // Where a ray goes through the plane across this one.
            let passes = |dx: f64, dy: f64| {
                let [o, d] = at(dx, dy);
                let (gap, speed) = (0..3).fold((0.0, 0.0), |(g, s), k| (g + (point[k] - o[k]) * direction[k], s + d[k] * direction[k]));
                [0, 1, 2].map(|k| o[k] + gap / speed * d[k])
            };
            let step = 1e-5;
            let [[a, b], [c, d]] = [[passes(step, 0.0), passes(-step, 0.0)], [passes(0.0, step), passes(0.0, -step)]];
            let [u, v] = [[a, b], [c, d]].map(|[p, q]| [0, 1, 2].map(|k| (p[k] - q[k]) / (2.0 * step)));
            let area = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
            let area: f64 = (0..3).map(|k| area[k] * direction[k]).sum();
            let found = seen(&camera, point.map(|x| x as f32), lens);
            if found.valid && !about_the_axis(&camera, raster) {
                let expected = 1.0 / area.abs();
                assert!(
                    (f64::from(found.importance) / expected - 1.0).abs() < 1e-3,
                    "{camera:?} {raster:?} {lens:?} {t}: {} for {expected}",
                    found.importance
                );
            }
        }
    }
}

#[test]
fn what_is_not_seen_is_not_valid_and_nothing_is_nan() {
    let check = |camera: &CameraTable, point: [f32; 3], valid: bool| {
        for lens in [[0.5; 2], [0.3, 0.8], [0.0, 1.0]] {
            let found = seen(camera, point, lens);
            assert_eq!(found.valid, valid, "{camera:?} {point:?} {lens:?}");
            let numbers = [found.raster.as_slice(), &found.origin, &found.direction, &[found.distance, found.importance]].concat();
            assert!(numbers.iter().all(|x| x.is_finite()), "{camera:?} {point:?} {lens:?}: {numbers:?}");
            assert!(valid == (found.importance > 0.0));
        }
    };
    for camera in cameras() {
        for camera in [
            camera.clone(),
            CameraTable { clipping: [0.0, f32::MAX], ..camera.clone() },
            CameraTable { lens_radius: 0.01, ..camera.clone() },
        ] {
            let flat = matches!(camera.lens, Lens::Perspective | Lens::Orthographic);
            for nowhere in [[f32::NAN, 0.0, -1.0], [0.0, f32::INFINITY, -1.0], [1e30; 3], [0.0, 0.0, 1e-30]] {
                seen(&camera, nowhere, [0.5; 2]);
                if nowhere.iter().any(|x| !x.is_finite()) {
                    check(&camera, nowhere, false);
                }
            }
            check(&camera, [0.0; 3], false);
            check(&camera, [0.2, 0.1, -3.0], true);
            check(&camera, [0.2, 0.1, 1.5], camera.lens == Lens::Equirectangular);
            // Clipped before and behind; planes clip by depth.
            check(&camera, [0.02, 0.02, -0.06], camera.clipping[0] == 0.0);
            check(&camera, [60.0, 20.0, -90.0], camera.clipping[1] > 1e3 || flat);
            check(&camera, [0.0, 0.0, -101.0], camera.clipping[1] > 1e3 && (camera.lens_radius == 0.0 || flat));
            // The zenith is a whole row of the map of the world. Rays of a wide lens pass it by.
            if camera.lens_radius == 0.0 {
                check(&camera, [0.0, 2.0, 0.0], matches!(camera.lens, Lens::Equidistant { .. }));
            }
        }
        let flattened = CameraTable { axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]], ..camera.clone() };
        check(&flattened, [0.2, 0.1, -3.0], false);
    }
}

#[test]
fn longitudes_are_told_within_a_turn() {
    let [_, _, camera, ..] = cameras();
    let turn = camera.turn().expect("repeats itself");
    assert!((turn - 8.0 * std::f32::consts::TAU / 3.5).abs() < 1e-4);
    let left = seen(&camera, [-0.1, 0.1, 3.0], [0.5; 2]);
    let right = seen(&camera, [0.1, 0.1, 3.0], [0.5; 2]);
    assert!(left.valid && right.valid && left.raster[0] > right.raster[0] && right.raster[0] > 8.0 && left.raster[0] < turn);
}

#[inline(always)]
fn received<L: Lanes>(l: L, camera: &CameraTable, u: &[Column; 5], out: &mut [Column; 4]) {
    for at in (0..u[0].len()).step_by(L::COUNT) {
        let number = |k: usize| l.load(&u[k], at);
        let point = Vec3::new(number(0) * 8.0 - 4.0, number(1) * 8.0 - 4.0, number(2) * 8.0 - 6.0);
        let seen = camera.importance(l, point, [number(3), number(4)]);
        let numbers = [seen.raster[0], seen.raster[1], seen.importance * seen.distance.squared(), seen.direction.x + seen.origin.y];
        for (column, number) in out.iter_mut().zip(numbers) {
            number.store(column, at);
        }
    }
}

#[test]
fn all_levels_agree() {
    let count = 1024;
    let mut u = [0, 1, 2, 3, 4].map(|_| Column::new(count));
    for (k, column) in u.iter_mut().enumerate() {
        (0..count).for_each(|i| column[i] = uniform(3 + k as u64, i as u64));
    }
    for camera in kinds() {
        let four = || [0, 1, 2, 3].map(|_| Column::new(count));
        let mut scalar = four();
        dispatch!(Execution::Scalar, l => received(l, &camera, &u, &mut scalar));
        for execution in Execution::all() {
            let mut wide = four();
            dispatch!(execution, l => received(l, &camera, &u, &mut wide));
            let apart = |i: &usize| (0..4).any(|k| (wide[k][*i] - scalar[k][*i]).abs() > 1e-3 * scalar[k][*i].abs().max(1.0));
            // Roundings tip a point over the field's end or into the next blade here and there.
            let different = (0..count).filter(apart).count();
            assert!(different <= 3, "{camera:?} at {}: {different} points differ", execution.name());
        }
    }
}
