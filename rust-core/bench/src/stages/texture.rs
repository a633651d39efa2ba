//! Filtered lookups in images, by format and filter.

use crate::{
    kernel::{Case, Kernel, Outcome},
    numbers::{BATCH, STEPS, column},
};
use gonio::colour::{ColourSpace, Stated};
use gonio::error::{Error, Result};
use gonio::texture::{Filter, Image, MipMap, Texels, TextureTable, Wrap};
use gonio_simd::{Column, Execution, Lanes, Vec2, dispatch};
use std::sync::{Arc, atomic::AtomicBool};

/// Texels a side of images that stay in the second-level cache as bytes, and of those that do not.
const SIDES: [u32; 2] = [256, 2048];

/// Lookups all over an image.
struct Lookups {
    table: TextureTable,
    uv: [Column; 2],
    /// Footprints in units of the texture coordinates.
    width: Column,
    filter: Filter,
    out: [Column; 4],
}

pub(super) fn cases(cancel: &AtomicBool) -> Result<Vec<Case>> {
    let [small, large] = SIDES;
    let case = |name: &str, side: u32, texels: Texels, space: ColourSpace, texels_wide: f32, filter: Filter| {
        let channels = (texels.len() / (side * side) as usize) as u32;
        let image = Image { width: side, height: side, channels, texels, stated: Stated::Nothing };
        let map = MipMap::build(&image, space, cancel).map_err(|error| Error::Internal(error.to_string()))?;
        let mut table = TextureTable::new();
        table.push(Arc::new(map));
        let (uv, mut width) = ([column(STEPS[0]), column(STEPS[1])], column(STEPS[2]));
        // Footprints from nothing to twice the mean, as curved surfaces have them.
        width.iter_mut().for_each(|x| *x *= 2.0 * texels_wide / side as f32);
        let out = [Column::new(BATCH), Column::new(BATCH), Column::new(BATCH), Column::new(BATCH)];
        Ok(Case::new(name, "lookup", BATCH, Lookups { table, uv, width, filter, out }))
    };
    let srgb = ColourSpace::SRGB_TEXTURE;
    Ok(vec![
        case("sRGB bytes, nearest", small, bytes(small), srgb, 0.5, Filter::Nearest)?,
        case("sRGB bytes, bilinear", small, bytes(small), srgb, 0.0, Filter::Trilinear)?,
        case("sRGB bytes, trilinear", small, bytes(small), srgb, 4.0, Filter::Trilinear)?,
        case("raw bytes, trilinear", small, bytes(small), ColourSpace::Raw, 4.0, Filter::Trilinear)?,
        case("floats, trilinear", small, floats(small), ColourSpace::Raw, 4.0, Filter::Trilinear)?,
        case("sRGB bytes, trilinear, 16 MiB", large, bytes(large), srgb, 4.0, Filter::Trilinear)?,
    ])
}

/// Four channels of noise.
fn bytes(side: u32) -> Texels {
    Texels::Byte((0..side * side * 4).map(|i| (i.wrapping_mul(2_654_435_761) >> 24) as u8).collect())
}

fn floats(side: u32) -> Texels {
    Texels::Float((0..side * side * 4).map(|i| i.wrapping_mul(2_654_435_761) as f32 * 1e-9).collect())
}

#[inline(always)]
fn look_up<L: Lanes>(l: L, table: &TextureTable, uv: &[Column; 2], width: &Column, filter: Filter, out: &mut [Column; 4]) {
    for at in (0..width.len()).step_by(L::COUNT) {
        let place = Vec2 { x: l.load(&uv[0], at), y: l.load(&uv[1], at) };
        let texel = table.sample(l, 0, place, l.load(width, at), [Wrap::Repeat; 2], filter);
        for (channel, out) in texel.into_iter().zip(out.iter_mut()) {
            channel.store(out, at);
        }
    }
}

impl Kernel for Lookups {
    fn run(&mut self, execution: Execution) -> Result<()> {
        let Self { table, uv, width, filter, out } = self;
        dispatch!(execution, l => look_up(l, table, uv, width, *filter, out));
        Ok(())
    }
    fn outcome(&self) -> Outcome {
        Outcome::of(self.out.iter().map(|column| &column[..]))
    }
}
