//! Directions against Cycles' own, lenses against what they must do.

use super::{Aperture, CameraTable, Lens, Surroundings};
use gonio_simd::{Column, Execution, F, Lanes, One, Vec3, dispatch};
use std::f32::consts::{FRAC_PI_2, PI};

/// A camera at the origin whose picture of `resolution` covers a plane of `size` about `middle`.
pub(crate) fn table(lens: Lens, resolution: [f32; 2], size: [f32; 2], middle: [f32; 2]) -> CameraTable {
    CameraTable {
        axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        position: [0.0; 3],
        corner: [middle[0] - 0.5 * size[0], middle[1] + 0.5 * size[1]],
        pixel: [size[0] / resolution[0], size[1] / resolution[1]],
        lens,
        lens_radius: 0.0,
        aperture: Aperture::default(),
        focus_distance: 5.0,
        planes: Vec::new(),
        clipping: [0.1, 100.0],
        motion: None,
        surroundings: Surroundings::OPEN,
    }
}

/// One of each kind, with a picture of 8 × 4.
pub(crate) fn cameras() -> [CameraTable; 5] {
    let resolution = [8.0, 4.0];
    let (fov, solid) = (4.5f32, 2.5f32);
    [
        table(Lens::Perspective, resolution, [1.6, 0.8], [0.0; 2]),
        table(Lens::Orthographic, resolution, [4.0, 2.0], [0.5, 0.0]),
        table(Lens::Equirectangular, resolution, [3.5, 1.9], [-0.25, 0.25]),
        table(Lens::Equidistant { limit: 0.5 * fov }, resolution, [fov; 2], [0.0; 2]),
        table(Lens::Equisolid { limit: (0.25 * solid).sin() }, resolution, [0.5 * 30.0 / 10.5, 0.5 * 15.0 / 10.5], [0.0; 2]),
    ]
}

struct Ray {
    origin: [f32; 3],
    direction: [f32; 3],
    limits: [f32; 2],
    spread: f32,
    mapped: bool,
}

fn ray(camera: &CameraTable, raster: [f32; 2], lens: [f32; 2]) -> Ray {
    let l = One;
    let r = camera.ray(l, raster.map(|x| l.f(x)), lens.map(|x| l.f(x)));
    let one = |x: F<One>| x.to_array()[0];
    let three = |v: Vec3<One>| [one(v.x), one(v.y), one(v.z)];
    Ray {
        origin: three(r.origin),
        direction: three(r.direction),
        limits: [one(r.t_min), one(r.t_max)],
        spread: one(r.spread),
        mapped: r.mapped.any(),
    }
}

pub(crate) fn distance(a: [f32; 3], b: [f32; 3]) -> f32 {
    (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f32>().sqrt()
}

/// Uniform numbers in [0, 1): a counter through a 64-bit mixer (SplitMix64).
pub(crate) fn uniform(seed: u64, index: u64) -> f32 {
    let mut z = (seed << 40 ^ index).wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 40) as f32 / (1u32 << 24) as f32
}

/// Directions that the Cycles of Blender 5.0.1 gave a background shader at the middles of an 8 × 4 picture's pixels (column, row from the top).
#[test]
fn panoramas_are_those_of_cycles() {
    type Known = ([f32; 2], [f32; 3]);
    let [_, _, equirectangular, equidistant, equisolid] = cameras();
    let known: [(&CameraTable, &[Known]); 3] = [
        (
            &equirectangular,
            &[
                ([0.0, 0.0], [-0.5588604, 0.8206238, 0.1193812]),
                ([5.0, 1.0], [0.3491337, 0.46842, -0.8115962]),
                ([7.0, 3.0], [0.8576875, -0.4461856, -0.2555201]),
            ],
        ),
        (
            &equidistant,
            &[
                ([3.0, 0.0], [-0.1627896, 0.9767456, 0.1395271]),
                ([5.0, 1.0], [0.7063986, 0.4709344, -0.5284144]),
                ([7.0, 2.0], [0.8543124, -0.2440875, 0.4588807]),
                ([4.0, 1.0], [0.2630751, 0.5261503, -0.8086763]),
            ],
        ),
        (
            &equisolid,
            &[
                ([3.0, 0.0], [-0.1713047, 0.5139184, -0.8405609]),
                ([5.0, 1.0], [0.5139184, 0.1713068, -0.8405605]),
                ([6.0, 2.0], [0.7949593, -0.1589908, -0.5854585]),
                ([4.0, 1.0], [0.1771431, 0.1771432, -0.9681119]),
            ],
        ),
    ];
    for (camera, directions) in known {
        for (pixel, expected) in directions {
            let found = ray(camera, pixel.map(|x| x + 0.5), [0.5; 2]);
            assert!(found.mapped && distance(found.direction, *expected) < 1e-5, "{:?} {pixel:?}: {:?}", camera.lens, found.direction);
        }
    }
    for camera in [&equidistant, &equisolid] {
        assert!(!ray(camera, [0.5, 0.5], [0.5; 2]).mapped, "{:?}", camera.lens);
    }
    assert!(!ray(&equisolid, [0.5, 1.5], [0.5; 2]).mapped && !ray(&equisolid, [7.5, 1.5], [0.5; 2]).mapped);
}

#[test]
fn fisheyes_end_at_their_field_of_view() {
    for (lens, side) in [(Lens::Equidistant { limit: 1.5 }, 3.2), (Lens::Equisolid { limit: 0.75f32.sin() }, 2.0 * 0.8 * 0.75f32.sin())] {
        let camera = table(lens, [1000.0; 2], [side; 2], [0.0; 2]);
        for column in 0..1000 {
            let r = ray(&camera, [column as f32 + 0.5, 500.0], [0.5; 2]);
            let angle = r.direction[0].hypot(r.direction[1]).atan2(-r.direction[2]);
            assert!((angle - 1.5).abs() < 0.01 || r.mapped == (angle < 1.5), "{lens:?} {column}: {angle} {}", r.mapped);
        }
    }
}

#[test]
fn what_is_in_focus_is_sharp_through_the_whole_lens() {
    for camera in cameras() {
        let wide = CameraTable { lens_radius: 0.7, aperture: Aperture { blades: 5, rotation: 0.3, width: 0.5 }, ..camera.clone() };
        for raster in [[4.0, 2.0], [5.3, 1.1], [2.2, 2.9]] {
            let chief = ray(&camera, raster, [0.5; 2]);
            let along = if matches!(camera.lens, Lens::Perspective | Lens::Orthographic) { -chief.direction[2] } else { 1.0 };
            let sharp: [f32; 3] = [0, 1, 2].map(|k| chief.origin[k] + chief.direction[k] * camera.focus_distance / along);
            for i in 0..100 {
                let r = ray(&wide, raster, [uniform(1, 2 * i), uniform(1, 2 * i + 1)]);
                let offset = [0, 1, 2].map(|k| r.origin[k] - chief.origin[k]);
                let t: f32 = (0..3).map(|k| (sharp[k] - r.origin[k]) * r.direction[k]).sum();
                let passes = [0, 1, 2].map(|k| r.origin[k] + t * r.direction[k]);
                assert!(distance(passes, sharp) < 1e-5, "{:?} {raster:?}: {passes:?} for {sharp:?}", camera.lens);
                assert!(distance(offset, [0.0; 3]) <= 0.7001, "{offset:?}");
                // Panoramas have their opening across every ray.
                let lean: f32 =
                    (0..3).map(|k| offset[k] * if along == 1.0 { chief.direction[k] } else { f32::from(u8::from(k == 2)) }).sum();
                assert!(lean.abs() < 1e-5, "{:?}: {offset:?}", camera.lens);
            }
        }
    }
}

#[test]
fn parallel_rays_are_parallel_and_evenly_spaced() {
    let [_, camera, ..] = cameras();
    let [first, last] = [[0.5, 0.5], [7.5, 3.5]].map(|raster| ray(&camera, raster, [0.5; 2]));
    assert_eq!(first.direction, [0.0, 0.0, -1.0]);
    assert_eq!(last.direction, first.direction);
    assert_eq!((first.origin, last.origin), ([-1.25, 0.75, 0.0], [2.25, -0.75, 0.0]));
    assert_eq!(first.limits, camera.clipping);
}

#[test]
fn planes_hide_what_lies_behind_them() {
    let camera = table(Lens::Perspective, [8.0, 8.0], [2.0, 2.0], [0.0, 0.0]);
    let ray = |planes: Vec<[f32; 4]>, x: f32| {
        let camera = CameraTable { planes, clipping: [0.0, 100.0], ..camera.clone() };
        let ray = camera.ray(One, [One.f(x), One.f(4.0)], [One.f(0.5); 2]);
        (ray.t_min.0, ray.t_max.0)
    };
    // Nothing to the left is seen, and nothing nearer than 3 m along the axis.
    let (near, far) = ray(vec![[1.0, 0.0, 0.0, 0.0]], 2.0);
    assert!(near >= far || far <= 0.0, "{near} to {far}");
    assert_eq!(ray(vec![[1.0, 0.0, 0.0, 0.0]], 6.0).0, 0.0);
    let (near, far) = ray(vec![[0.0, 0.0, -1.0, -3.0]], 4.0);
    assert!((near - 3.0).abs() < 1e-5 && far > 99.0, "{near} to {far}");
    // Along a plane rays lie on one of its sides.
    assert!(ray(vec![[0.0, 1.0, 0.0, -0.5]], 4.0).1 < 0.0 && ray(vec![[0.0, 1.0, 0.0, 0.5]], 4.0).1 > 0.0);
    let seen = CameraTable { planes: vec![[1.0, 0.0, 0.0, 0.0]], ..camera };
    let valid = |x: f32| seen.importance(One, Vec3::splat(One, [x, 0.0, -5.0]), [One.f(0.5); 2]).valid.any();
    assert!(valid(0.5) && !valid(-0.5));
}

#[test]
fn clipping_is_by_depth_for_planes_and_by_distance_for_panoramas() {
    for camera in cameras() {
        let r = ray(&camera, [5.9, 1.2], [0.5; 2]);
        let along = if matches!(camera.lens, Lens::Perspective | Lens::Orthographic) { -r.direction[2] } else { 1.0 };
        for k in 0..2 {
            assert!((r.limits[k] * along / camera.clipping[k] - 1.0).abs() < 1e-5, "{:?}: {:?}", camera.lens, r.limits);
        }
    }
}

#[test]
fn spread_is_the_angle_between_neighbours() {
    for camera in cameras().into_iter().filter(|camera| camera.lens != Lens::Orthographic) {
        let [here, there] = [[4.0, 2.0], [4.0, 2.01]].map(|raster| ray(&camera, raster, [0.5; 2]));
        let angle = distance(here.direction, there.direction) * 100.0;
        assert!((here.spread / angle - 1.0).abs() < 2e-2, "{:?}: {} for {angle}", camera.lens, here.spread);
    }
}

/// Whether a point lies in the opening.
pub(crate) fn holds(aperture: &Aperture, [x, y]: [f64; 2]) -> bool {
    let x = x / f64::from(aperture.width);
    if aperture.blades < 3 {
        return x * x + y * y <= 1.0;
    }
    let wedge = 2.0 * std::f64::consts::PI / f64::from(aperture.blades);
    let turn = (y.atan2(x) - f64::from(aperture.rotation)).rem_euclid(wedge);
    let off = if turn > 0.5 * wedge { turn - wedge } else { turn };
    x.hypot(y) * off.cos() <= (0.5 * wedge).cos()
}

#[inline(always)]
fn openings<L: Lanes>(l: L, aperture: &Aperture, u: &[Column; 2], out: &mut [Column; 2]) {
    for at in (0..u[0].len()).step_by(L::COUNT) {
        let [x, y] = aperture.sample([l.load(&u[0], at), l.load(&u[1], at)]);
        x.store(&mut out[0], at);
        y.store(&mut out[1], at);
    }
}

#[test]
fn lens_openings_are_filled_evenly() {
    const BINS: usize = 16;
    const FINE: usize = 64;
    let count = 1 << 17;
    let u = [7, 8].map(|seed| {
        let mut column = Column::new(count);
        (0..count).for_each(|i| column[i] = uniform(seed, i as u64));
        column
    });
    for (blades, rotation, width) in [(0, 0.0, 1.0), (3, 0.0, 1.0), (3, 0.3, 0.5), (5, 1.0, 1.0), (6, -0.2, 2.0), (16, 0.1, 0.7)] {
        let aperture = Aperture { blades, rotation, width };
        let span = f64::from(width.max(1.0));
        let cell = |i: usize, n: usize| (2.0 * (i as f64 + 0.5) / n as f64 - 1.0) * span;
        let mut shares = vec![0.0; BINS * BINS];
        for i in 0..BINS * FINE {
            for j in 0..BINS * FINE {
                shares[i / FINE * BINS + j / FINE] += f64::from(u8::from(holds(&aperture, [cell(i, BINS * FINE), cell(j, BINS * FINE)])));
            }
        }
        let total: f64 = shares.iter().sum();
        for execution in Execution::all() {
            let mut out = [Column::new(count), Column::new(count)];
            dispatch!(execution, l => openings(l, &aperture, &u, &mut out));
            let mut observed = vec![0.0; BINS * BINS];
            for (x, y) in out[0].iter().zip(out[1].iter()).take(count) {
                let [a, b] = [x, y].map(|x| (((f64::from(*x) / span + 1.0) / 2.0 * BINS as f64) as usize).min(BINS - 1));
                observed[a * BINS + b] += 1.0;
            }
            let (mut chi, mut cells) = (0.0, 0.0);
            for (share, seen) in shares.iter().zip(&observed) {
                let expected = share / total * count as f64;
                if expected > 8.0 {
                    // The expectation's own error, from the edge.
                    chi += (seen - expected).powi(2) / (expected + (0.01 * expected).powi(2));
                    cells += 1.0;
                }
            }
            // Wilson and Hilferty's normal approximation; 1 − 1e-6 one-sided.
            let z = ((chi / cells).cbrt() - (1.0 - 2.0 / (9.0 * cells))) / (2.0f64 / (9.0 * cells)).sqrt();
            assert!(z < 4.75, "{aperture:?} at {}: chi-square {chi} over {cells} cells (z = {z})", execution.name());
        }
    }
}

/// As Cycles' blurred points are seen: with three blades the corner opposite to +x lies at −1, the edge at +½; turned by 0.3 it turns against the clock.
#[test]
fn polygons_stand_as_in_cycles() {
    for rotation in [0.0, 0.3] {
        let aperture = Aperture { blades: 3, rotation, width: 1.0 };
        for k in 0..3 {
            let angle = rotation + (2.0 * k as f32 + 1.0) * PI / 3.0;
            let near = [0.999 * angle.cos(), 0.999 * angle.sin()].map(f64::from);
            assert!(holds(&aperture, near), "{rotation} {k}");
        }
        let l = One;
        let extreme = |u: [f32; 2]| aperture.sample(u.map(|x| l.f(x))).map(|x| x.to_array()[0]);
        // The first triangle's far corners, by its last numbers.
        for (v, side) in [(0.0, -1.0), (1.0, 1.0)] {
            let [x, y] = extreme([0.333_333, v]);
            let angle = rotation + side * PI / 3.0;
            assert!((x - angle.cos()).abs() < 2e-3 && (y - angle.sin()).abs() < 2e-3, "{rotation} {v}: {x} {y}");
        }
    }
}

#[inline(always)]
fn traced<L: Lanes>(l: L, camera: &CameraTable, u: &[Column; 4], out: &mut [Column; 3]) {
    for at in (0..u[0].len()).step_by(L::COUNT) {
        let number = |k: usize| l.load(&u[k], at);
        let r = camera.ray(l, [number(0) * 8.0, number(1) * 4.0], [number(2), number(3)]);
        let [x, y, z] = out;
        r.mapped.select(r.direction + r.origin, Vec3::splat(l, [0.0; 3])).store([x, y, z], at);
    }
}

#[test]
fn all_levels_agree() {
    let count = 1024;
    let mut u = [0, 1, 2, 3].map(|_| Column::new(count));
    for (k, column) in u.iter_mut().enumerate() {
        (0..count).for_each(|i| column[i] = uniform(3 + k as u64, i as u64));
    }
    for camera in cameras() {
        let camera = CameraTable { lens_radius: 0.2, aperture: Aperture { blades: 6, rotation: FRAC_PI_2, width: 0.8 }, ..camera };
        let three = || [Column::new(count), Column::new(count), Column::new(count)];
        let mut scalar = three();
        dispatch!(Execution::Scalar, l => traced(l, &camera, &u, &mut scalar));
        for execution in Execution::all() {
            let mut wide = three();
            dispatch!(execution, l => traced(l, &camera, &u, &mut wide));
            let apart = |i: &usize| (0..3).any(|k| (wide[k][*i] - scalar[k][*i]).abs() > 1e-4);
            // Roundings tip a point over the rim or into the next blade here and there.
            let different = (0..count).filter(apart).count();
            assert!(different <= 2, "{:?} at {}: {different} rays differ", camera.lens, execution.name());
        }
    }
}
