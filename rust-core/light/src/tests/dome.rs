//! Domes, constant and textured.

use super::harness::{draw, estimate, eval_escaped, numbers, sample_li, seeing_all, turned, uniform};
use crate::{EscapedRay, LightKind, LightRecord, LightTable, LightTexture};
use gonio_simd::{Column, Execution, F, Lanes, M, One, Vec3, dispatch};
use std::f64::consts::PI;

fn dome(texture: Option<u32>) -> LightRecord {
    LightRecord { texture, ..LightRecord::new(LightKind::Dome) }
}

fn image(width: usize, height: usize, value: impl Fn(usize, usize) -> [f32; 3]) -> LightTexture {
    let rgb = (0..width * height).flat_map(|i| value(i % width, i / width)).collect();
    LightTexture { width, height, rgb }
}

#[test]
fn constant_dome_gives_pi() {
    for textures in [vec![], vec![image(64, 32, |_, _| [1.0; 3])]] {
        let record = dome((!textures.is_empty()).then_some(0));
        let textured = record.texture.is_some();
        let table = LightTable::build(&[record], &textures, &[]);
        for n in [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.6, 0.0, -0.8]] {
            let drawn = draw(Execution::best(), &table, [0.0; 3], n, &numbers(1, 1 << 16));
            let (mean, error) = estimate(&drawn, n.map(f64::from), 1 << 16);
            assert!((mean[0] - PI).abs() < 4.9 * error[0] + 1e-5, "{n:?}: {} ± {}", mean[0], error[0]);
            assert!(textured || error[0] < 1e-5, "a constant dome has no noise: {}", error[0]);
        }
    }
}

#[inline(always)]
fn look<L: Lanes>(l: L, table: &LightTable, wi: [f32; 3]) -> [f32; 3] {
    let yes = l.m(true);
    let ray = EscapedRay { direction: Vec3::splat(l, wi), pdf: l.f(1.0), first: yes, delta: yes, kind: l.u(0) };
    let seen = eval_escaped(l, table, &seeing_all(l, [Vec3::splat(l, [0.0; 3]); 2]), &ray).to_rgb();
    [seen.r.to_array()[0], seen.g.to_array()[0], seen.b.to_array()[0]]
}

fn radiance(table: &LightTable, wi: [f32; 3]) -> [f32; 3] {
    look(One, table, wi)
}

#[test]
fn images_are_placed_as_openexr_says() {
    // Eight columns, four rows, each pixel its own colour.
    let texture = image(8, 4, |x, y| [x as f32 + 1.0, y as f32 + 1.0, 0.5]);
    let table = LightTable::build(&[dome(Some(0))], &[texture], &[]);
    let direction = |column: f32, row: f32| {
        let (longitude, latitude) =
            (std::f32::consts::TAU * (0.5 - (column + 0.5) / 8.0), std::f32::consts::PI * (0.5 - (row + 0.5) / 4.0));
        [longitude.sin() * latitude.cos(), latitude.sin(), longitude.cos() * latitude.cos()]
    };
    for (column, row) in [(0, 0), (3, 1), (7, 3), (5, 2), (2, 0)] {
        let seen = radiance(&table, direction(column as f32, row as f32));
        assert!((seen[0] - column as f32 - 1.0).abs() < 1e-3 && (seen[1] - row as f32 - 1.0).abs() < 1e-3, "{column} {row}: {seen:?}");
    }
    // +X is left of the middle, +Z in it, between the fourth and the fifth column.
    assert!((radiance(&table, [0.0, 0.0, 1.0])[0] - 4.5).abs() < 1e-3);
    assert!((radiance(&table, [1.0, 0.0, 0.0])[0] - 2.5).abs() < 1e-3);
    assert!(radiance(&table, [0.0, 1.0, 0.0])[1] < 1.01 && radiance(&table, [0.0, -1.0, 0.0])[1] > 3.99);
    // Across the seam behind, first and last column mix.
    assert!((radiance(&table, [0.0, 0.0, -1.0])[0] - 4.5).abs() < 1e-3);
}

fn starry() -> LightTexture {
    let mut sky = image(128, 64, |x, y| [0.2 + 0.1 * uniform(9, (x * 64 + y) as u64), 0.3, 0.5]);
    for (x, y) in [(30, 10), (31, 10), (90, 28)] {
        sky.rgb[3 * (y * 128 + x)..][..3].copy_from_slice(&[9000.0, 8000.0, 7000.0]);
    }
    sky
}

/// Illuminance by the midpoint rule on the sphere, radiances through the table's own lookup.
fn quadrature(table: &LightTable, n: [f64; 3]) -> f64 {
    let (width, height) = (1024, 512);
    let mut sum = 0.0;
    for row in 0..height {
        let latitude = PI * (0.5 - (row as f64 + 0.5) / height as f64);
        let solid = (2.0 * PI / width as f64) * (PI / height as f64) * latitude.cos();
        for column in 0..width {
            let longitude = 2.0 * PI * (column as f64 + 0.5) / width as f64;
            let wi = [longitude.sin() * latitude.cos(), latitude.sin(), longitude.cos() * latitude.cos()];
            let cosine = wi[0] * n[0] + wi[1] * n[1] + wi[2] * n[2];
            if cosine > 0.0 {
                sum += f64::from(radiance(table, wi.map(|x| x as f32))[1]) * cosine * solid;
            }
        }
    }
    sum
}

#[test]
fn bright_spots_are_found() {
    let record = LightRecord {
        to_world: {
            let [x, y, z] = turned([1.0; 3], [0.4, 1.0, 0.2]);
            [x, y, z, [0.0; 3]]
        },
        ..dome(Some(0))
    };
    let table = LightTable::build(&[record], &[starry()], &[]);
    for n in [[0.0, 1.0, 0.0], [0.6, 0.0, 0.8], [0.0, 0.0, -1.0]] {
        let expected = quadrature(&table, n);
        let count = 1 << 16;
        let drawn = draw(Execution::best(), &table, [0.0; 3], n.map(|x| x as f32), &numbers(13, count));
        let (mean, error) = estimate(&drawn, n, count);
        assert!((mean[1] - expected).abs() < 4.9 * error[1] + 2e-3 * expected, "{n:?}: {} ± {} for {expected}", mean[1], error[1]);
        assert!(error[1] < 0.01 * mean[1], "{n:?}: error {} of {}", error[1], mean[1]);
    }
}

/// A cosine-distributed direction about +Z with MIS against the table: both halves of the estimate together.
#[inline(always)]
fn both_halves<L: Lanes>(l: L, table: &LightTable, u: &[Column; 3], out: &mut Column) {
    let from = seeing_all(l, [Vec3::splat(l, [0.0; 3]), Vec3::splat(l, [0.0, 0.0, 1.0])]);
    let never: M<L> = l.m(false);
    for at in (0..out.len()).step_by(L::COUNT) {
        let numbers: [F<L>; 3] = [l.load(&u[0], at), l.load(&u[1], at), l.load(&u[2], at)];
        let s = sample_li(l, table, None, &from, &numbers);
        let bsdf = s.wi.z.max(0.0) * std::f32::consts::FRAC_1_PI;
        let weight = s.delta.select(l.f(1.0), s.pdf * s.pdf / (s.pdf * s.pdf + bsdf * bsdf));
        let by_light = (s.radiance.g * s.wi.z.max(0.0) * weight / s.pdf).keep_if(s.pdf.gt(0.0));
        let (sine, cosine) = numbers[2].sin_cos_turns();
        let r = numbers[1].sqrt();
        let wi = Vec3::new(r * cosine, r * sine, (1.0 - numbers[1]).safe_sqrt());
        let ray = EscapedRay { direction: wi, pdf: wi.z * std::f32::consts::FRAC_1_PI, first: never, delta: never, kind: l.u(0) };
        let by_bsdf = eval_escaped(l, table, &from, &ray).to_rgb().g * std::f32::consts::PI;
        (by_light + by_bsdf).store(out, at);
    }
}

#[test]
fn escaped_rays_and_samples_add_up_to_the_illuminance() {
    let records = [
        dome(Some(0)),
        dome(None),
        LightRecord { angle: 0.8, radiance: [2.0; 3], ..LightRecord::new(LightKind::Distant) },
        LightRecord { radiance: [1.5; 3], ..LightRecord::new(LightKind::Distant) },
    ];
    let table = LightTable::build(&records, &[starry()], &[]);
    let alone = LightTable::build(&records[..1], &[starry()], &[]);
    let expected = quadrature(&alone, [0.0, 0.0, 1.0]) + PI + 2.0 * PI * 0.4f64.sin().powi(2) + 1.5;
    for execution in Execution::all() {
        let count = 1 << 17;
        let mut out = Column::new(count);
        dispatch!(execution, l => both_halves(l, &table, &numbers(19, count), &mut out));
        let mean = out.iter().map(|x| f64::from(*x)).sum::<f64>() / count as f64;
        let variance = out.iter().map(|x| (f64::from(*x) - mean).powi(2)).sum::<f64>() / count as f64;
        let error = (variance / count as f64).sqrt();
        assert!((mean - expected).abs() < 4.9 * error + 2e-3 * expected, "{}: {mean} ± {error} for {expected}", execution.name());
    }
}

#[test]
fn skies_are_selected_by_what_light_samples_bring() {
    let sun = LightRecord { angle: 0.01, ..LightRecord::new(LightKind::Distant) };
    let even = image(64, 32, |_, _| [1.0; 3]);
    let peak = image(64, 32, |x, y| if (20..24).contains(&x) && (6..10).contains(&y) { [500.0; 3] } else { [0.1; 3] });
    let selected = |textures: &[LightTexture]| {
        let mut record = dome((!textures.is_empty()).then_some(0));
        // As bright in the mean as without an image.
        let mean: f32 = textures.iter().map(|image| image.rgb.iter().sum::<f32>() / image.rgb.len() as f32).sum();
        record.radiance = [if textures.is_empty() { 1.0 } else { 1.0 / mean }; 3];
        let table = LightTable::build(&[record, LightRecord { radiance: [4e4; 3], ..sun }], textures, &[]);
        let (towards_sun, origin) = (Vec3::splat(One, [0.0, 0.0, 1.0]), Vec3::splat(One, [0.0; 3]));
        table.light_pmf(One, None, &seeing_all(One, [origin, towards_sun]), One.u(0)).to_array()[0]
    };
    let [bare, even, peak] = [selected(&[]), selected(&[even]), selected(&[peak])];
    assert!(bare > 0.0 && bare < 0.2 && (bare - even).abs() < 0.02, "even skies: {bare} and {even}");
    assert!(peak > 2.0 * even, "a sky with a bright spot: {peak}, an even one: {even}");
}
