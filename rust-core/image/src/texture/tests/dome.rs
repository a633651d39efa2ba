//! Environment formats: a smooth radiance of direction, drawn in each format, comes back as lat-long.

use crate::colour::{ColourSpace, Stated};
use crate::texture::{DomeFormat, Image, LatLong, Texels};
use std::f64::consts::PI;

fn radiance([x, y, z]: [f64; 3]) -> [f64; 3] {
    [0.5 + 0.5 * x, 0.5 + 0.5 * y, 0.5 + 0.5 * z]
}

/// The direction at a place of an image (right and down in −1..1), in words of the formats' definitions.
fn direction(format: DomeFormat, right: f64, down: f64) -> Option<[f64; 3]> {
    let radius = right.hypot(down);
    match format {
        DomeFormat::LatLong => None,
        DomeFormat::CubeMapVerticalCross => cross(right, down),
        _ if radius > 1.0 => None,
        DomeFormat::Angular => {
            let angle = radius * PI;
            let (s, unit) = (angle.sin(), radius.max(1e-12));
            Some([s * right / unit, -s * down / unit, angle.cos()])
        }
        DomeFormat::MirroredBall => {
            // The view ray −Z reflected about the ball's normal.
            let normal = [right, -down, (1.0 - radius * radius).sqrt()];
            Some([2.0 * normal[2] * normal[0], 2.0 * normal[2] * normal[1], 2.0 * normal[2] * normal[2] - 1.0])
        }
    }
}

fn cross(right: f64, down: f64) -> Option<[f64; 3]> {
    let (x, y) = ((right + 1.0) * 1.5, (down + 1.0) * 2.0);
    let (a, b) = (2.0 * x.fract() - 1.0, 2.0 * y.fract() - 1.0);
    let v = match (x as u32, y as u32) {
        (1, 0) => [-a, 1.0, b],
        (0, 1) => [1.0, -b, a],
        (1, 1) => [-a, -b, 1.0],
        (2, 1) => [-1.0, -b, -a],
        (1, 2) => [-a, -1.0, -b],
        (1, 3) => [-a, b, -1.0],
        _ => return None,
    };
    let length = v.iter().map(|c| c * c).sum::<f64>().sqrt();
    Some(v.map(|c| c / length))
}

fn draw(format: DomeFormat, width: u32, height: u32) -> Image {
    let mut values = Vec::new();
    for y in 0..height {
        for x in 0..width {
            let place = |i: u32, size: u32| (f64::from(i) + 0.5) / f64::from(size) * 2.0 - 1.0;
            let rgb = direction(format, place(x, width), place(y, height)).map_or([0.0; 3], radiance);
            values.extend(rgb.map(|value| value as f32));
        }
    }
    Image { width, height, channels: 3, texels: Texels::Float(values), stated: Stated::Nothing }
}

#[test]
fn every_format_shows_the_same_sky() {
    for (format, width, height) in
        [(DomeFormat::Angular, 200, 200), (DomeFormat::MirroredBall, 256, 256), (DomeFormat::CubeMapVerticalCross, 192, 256)]
    {
        let sky = LatLong::from_image(&draw(format, width, height), format, ColourSpace::Raw).unwrap();
        assert_eq!(sky.width, 2 * sky.height);
        for y in 0..sky.height {
            for x in 0..sky.width {
                let towards = sky.direction(x as f64 + 0.5, y as f64 + 0.5);
                // A ball shows what lies behind it in a thin ring only.
                if format != DomeFormat::CubeMapVerticalCross && towards[2] < -0.95 {
                    continue;
                }
                for (found, exact) in sky.rgb[y * sky.width + x].into_iter().zip(radiance(towards)) {
                    assert!((f64::from(found) - exact).abs() < 0.02, "{format:?} {towards:?}: {found}, not {exact}");
                }
            }
        }
    }
}

#[test]
fn lat_long_directions_are_those_of_openexr() {
    let sky = LatLong { width: 8, height: 4, rgb: Vec::new() };
    let near = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12);
    assert!(near(sky.direction(4.0, 2.0), [0.0, 0.0, 1.0]));
    assert!(near(sky.direction(2.0, 2.0), [1.0, 0.0, 0.0]));
    assert!(near(sky.direction(4.0, 0.0), [0.0, 1.0, 0.0]));
    assert!(near(sky.direction(0.0, 2.0), [0.0, 0.0, -1.0]));
}

#[test]
fn lat_long_keeps_its_texels() {
    let image = super::made::floats(8, 4, 3, 1);
    let sky = LatLong::from_image(&image, DomeFormat::LatLong, ColourSpace::Raw).unwrap();
    assert_eq!((sky.width, sky.height), (8, 4));
    assert_eq!(sky.rgb[9], [0, 1, 2].map(|c| image.rgba(9)[c]));
}
