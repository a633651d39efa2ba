//! From scene-linear light to display values: the curve alone, and a whole picture with all that stands around it.

use crate::{
    kernel::{Case, Kernel, Outcome},
    numbers::{BATCH, columns3, cube},
};
use gonio::colour::luminance_of_pixel;
use gonio::error::Result;
use gonio::film::{Frame, Image, Layer};
use gonio::output::{KEY, Look, ToneCurve, display, map_lanes};
use gonio::scene::{Aov, Crop};
use gonio_simd::{Column, Execution, Lanes, Rgb, dispatch};
use std::hint::black_box;

/// Width and height of the picture in pixels.
const SIZE: [u32; 2] = [3840, 2160];

/// The photographic operator and the sRGB curve.
struct Curve {
    radiance: [Column; 3],
    out: [Column; 3],
}

/// A film's colours to bytes.
struct Display {
    image: Image,
    bytes: Vec<u8>,
}

pub(super) fn cases() -> Vec<Case> {
    let mut radiance = cube();
    // Two decades about the key.
    radiance.iter_mut().for_each(|column| column.iter_mut().for_each(|x| *x = 0.01 * 100f32.powf(*x)));
    let pixels = (SIZE[0] * SIZE[1]) as usize;
    let values = (0..pixels).flat_map(|i| [radiance[0][i % BATCH], radiance[1][i % BATCH], radiance[2][i % BATCH], 1.0]).collect();
    let layers = vec![Layer { aov: Aov::Color, name: "color".into(), values, channels: 4 }];
    let image = Image {
        resolution: SIZE,
        window: Crop { min: [0; 2], max: SIZE },
        frame: Frame::default(),
        backdrop: Default::default(),
        layers,
        samples: 1,
        mean_samples: 1.0,
        manifests: Default::default(),
        deep: None,
    };
    vec![
        Case::new("photographic curve", "pixel", BATCH, Curve { radiance, out: columns3() }),
        Case::new("film to bytes", "pixel", pixels, Display { image, bytes: Vec::new() }),
    ]
}

#[inline(always)]
fn map<L: Lanes>(l: L, radiance: &[Column; 3], out: &mut [Column; 3]) {
    let ([r, g, b], [x, y, z]) = (radiance, out);
    let curve = ToneCurve::new(&Look::default(), KEY);
    for at in (0..BATCH).step_by(L::COUNT) {
        map_lanes(Rgb::load(l, [r, g, b], at), None, &curve).store([x, y, z], at);
    }
}

/// The same pixel by pixel.
fn map_standard(colour: [f32; 3], white: f32) -> [f32; 3] {
    let y = luminance_of_pixel(colour);
    let factor = (y / (white * white) + 1.0) / (y + 1.0);
    colour.map(|x| {
        let x = (x * factor).clamp(0.0, 1.0);
        if x < 0.003_130_8 { x * 12.92 } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 }
    })
}

impl Kernel for Curve {
    fn run(&mut self, execution: Execution) -> Result<()> {
        let Self { radiance, out } = self;
        dispatch!(execution, l => map(l, radiance, out));
        Ok(())
    }
    fn has_standard(&self) -> bool {
        true
    }
    fn run_standard(&mut self) {
        let white = Look::default().white;
        for i in (0..BATCH).map(black_box) {
            let mapped = map_standard([self.radiance[0][i], self.radiance[1][i], self.radiance[2][i]], white);
            (self.out[0][i], self.out[1][i], self.out[2][i]) = (mapped[0], mapped[1], mapped[2]);
        }
    }
    fn outcome(&self) -> Outcome {
        Outcome::of(self.out.iter().map(|column| &column[..]))
    }
}

impl Kernel for Display {
    fn run(&mut self, execution: Execution) -> Result<()> {
        self.bytes = display(&self.image, &Look::default(), execution);
        Ok(())
    }
    fn outcome(&self) -> Outcome {
        let sum: f64 = self.bytes.iter().map(|byte| f64::from(*byte)).sum();
        Outcome { value: sum / self.bytes.len().max(1) as f64, ..Outcome::of([]) }
    }
}
