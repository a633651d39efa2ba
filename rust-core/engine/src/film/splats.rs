//! Light that light paths bring to any pixel of the picture (pbrt's `AddSplat`), in fixed point: whole numbers add up to the same bits in any order.

use super::channels::ChannelLayout;
use super::raw::array;
use super::splat_limits::{PixelSplats, Shows};
use crate::{
    scene::{Aov, Crop, LightPart, ScatteringKind},
    transport::{GroupPasses, Splat},
};
use std::io::{Read, Result, Write};

/// Values are counted in units of the lights' power times this, which leaves room for a thousand million million times as much in a pixel.
const UNIT: f64 = 1.0 / (1 << 20) as f64;
/// Most that one splat counts, in units.
const MOST: f64 = (1_u64 << 52) as f64;

/// The light that a pass shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Share {
    /// All of it.
    Radiance,
    /// Classes of light, as [`crate::scene::LightPath::Classes`] has them: what the first surface's lobes of some kinds scatter.
    Classes(u16),
    /// What the lights of a group send.
    Group(u16),
}

/// The classes of light that is indirect, of light straight from lights, and of all that surfaces scatter.
pub(super) const INDIRECT: u16 = 0b1111_0000;
const DIRECT: u16 = 0b1111;
pub(super) const SCATTERED: u16 = 0b1111_1111;

/// What is summed, and in which units.
#[derive(Clone, Debug)]
pub(crate) struct SplatLayout {
    /// Reciprocal of a unit's value.
    scale: f64,
    parts: Vec<Share>,
    /// Width and height.
    size: [usize; 2],
}

/// Sums of splats over the window.
#[derive(Clone, Debug)]
pub(crate) struct SplatFilm {
    layout: SplatLayout,
    /// Classes of light that light paths bring.
    brought: u16,
    /// The most of it that a pixel has, straight from lights and otherwise, 0 for any.
    limits: [f32; 2],
    /// Light paths so far.
    paths: u64,
    /// By part, channel and pixel.
    sums: Vec<i64>,
}

/// What a pass shows of splats.
pub(super) struct Shown<'a> {
    film: &'a SplatFilm,
    /// By channel and pixel.
    sums: &'a [i64],
    shows: Shows,
    unit: f64,
}

impl Shown<'_> {
    /// Radiance of a pixel of the window.
    pub(super) fn at(&self, [x, y]: [usize; 2]) -> [f64; 3] {
        let SplatFilm { layout, brought, limits, .. } = self.film;
        let pixel = y * layout.size[0] + x;
        let light = self.light(self.sums, pixel);
        if *limits == [0.0; 2] {
            return light;
        }
        let of = |share: Share| self.film.sums_of(share).map_or([0.0; 3], |sums| self.light(sums, pixel));
        let direct = if brought & DIRECT == 0 { [0.0; 3] } else { of(Share::Classes(DIRECT)) };
        let factor = PixelSplats { all: of(Share::Radiance), direct }.factor(*limits, self.shows);
        light.map(|x| x * factor)
    }

    fn light(&self, sums: &[i64], pixel: usize) -> [f64; 3] {
        let pixels = sums.len() / 3;
        [0, 1, 2].map(|channel| sums[channel * pixels + pixel] as f64 * self.unit)
    }
}

/// The splats of a block.
#[derive(Clone, Debug, Default)]
pub(crate) struct SplatBlock {
    /// Light paths that were traced for it.
    pub(crate) paths: u64,
    pixels: Vec<u32>,
    /// All parts of a splat, three channels each.
    values: Vec<i64>,
}

impl SplatLayout {
    /// The splats of a block in fixed point. `limits` are the most that one may bring to its pixel as a sample's part, straight from a light and
    /// otherwise; 0 for any.
    pub(crate) fn block(&self, splats: &[Splat], paths: u64, groups: &GroupPasses, limits: [f32; 2]) -> SplatBlock {
        let mut block = SplatBlock { paths, ..SplatBlock::default() };
        for splat in splats {
            let limit = limits[usize::from(!splat.direct)];
            let most = f64::from(limit) * (self.size[0] * self.size[1]) as f64;
            let value = splat.value.map(f64::from);
            let mean = value.iter().map(|x| x.abs()).sum::<f64>() / 3.0;
            let clamp = if limit > 0.0 && mean > most { most / mean } else { 1.0 };
            block.pixels.push(splat.pixel);
            for part in &self.parts {
                for (channel, value) in value.iter().enumerate() {
                    let share = match part {
                        Share::Radiance => 1.0,
                        Share::Classes(classes) => {
                            let kinds = if splat.direct { *classes } else { classes >> 4 };
                            let asked = KINDS.iter().filter(|kind| kinds >> **kind as u16 & 1 == 1);
                            asked.map(|kind| kind_share(splat, *kind, channel)).sum()
                        }
                        Share::Group(number) => f64::from(u8::from(groups.of_light.get(splat.light as usize) == Some(&u32::from(*number)))),
                    };
                    block.values.push((value * share * clamp * self.scale).clamp(-MOST, MOST).round() as i64);
                }
            }
        }
        block
    }
}

impl SplatFilm {
    /// Empty sums for the passes of a film; `brought` are the classes of light that light paths bring, `limits` the most that a pixel has of direct
    /// and of indirect ones, `power` is that of their lights.
    pub(super) fn new(layout: &ChannelLayout, window: Crop, (brought, limits): (u16, [f32; 2]), power: f64) -> Self {
        let unit = power.max(f64::MIN_POSITIVE).log2().ceil().exp2() * UNIT;
        Self::scaled(layout, window, (brought, limits), unit.recip())
    }

    /// The same with a known scale.
    pub(super) fn scaled(layout: &ChannelLayout, window: Crop, (brought, limits): (u16, [f32; 2]), scale: f64) -> Self {
        let of_aov = |aov: &Aov| share_of(*aov, brought).filter(|share| *share != Share::Radiance);
        // What is limited apart is summed apart.
        let direct = (limits != [0.0; 2] && brought & DIRECT != 0).then_some(Share::Classes(DIRECT));
        let parts: Vec<Share> = [Share::Radiance].into_iter().chain(direct).chain(layout.aovs.iter().filter_map(of_aov)).collect();
        let size = [0, 1].map(|axis| (window.max[axis] - window.min[axis]) as usize);
        let sums = vec![0; parts.len() * 3 * size[0] * size[1]];
        Self { layout: SplatLayout { scale, parts, size }, brought, limits, paths: 0, sums }
    }

    /// What is summed.
    pub(crate) fn layout(&self) -> &SplatLayout {
        &self.layout
    }

    /// Adds a block.
    pub(super) fn add(&mut self, block: &SplatBlock) {
        self.paths += block.paths;
        let (channels, pixels) = (self.layout.parts.len() * 3, self.layout.size[0] * self.layout.size[1]);
        for (pixel, values) in block.pixels.iter().zip(block.values.chunks_exact(channels)) {
            for (channel, value) in values.iter().enumerate() {
                let sum = &mut self.sums[channel * pixels + *pixel as usize];
                *sum = sum.saturating_add(*value);
            }
        }
    }

    /// Adds other sums of the same film.
    pub(super) fn join(&mut self, other: &Self) {
        self.paths += other.paths;
        self.sums.iter_mut().zip(&other.sums).for_each(|(sum, more)| *sum = sum.saturating_add(*more));
    }

    /// The light that a pass shows, if it shows any of it.
    pub(super) fn shown(&self, aov: Aov) -> Option<Shown<'_>> {
        let share = share_of(aov, self.brought)?;
        let shows = Shows::of(if let Share::Classes(classes) = share { classes } else { self.brought });
        let unit = 1.0 / (self.layout.scale * self.paths.max(1) as f64);
        Some(Shown { film: self, sums: self.sums_of(share)?, shows, unit })
    }

    fn sums_of(&self, share: Share) -> Option<&[i64]> {
        let first = self.layout.parts.iter().position(|known| *known == share)? * 3;
        let pixels = self.layout.size[0] * self.layout.size[1];
        Some(&self.sums[first * pixels..(first + 3) * pixels])
    }

    /// Reciprocal of a unit's value: a power of two.
    pub(super) fn scale(&self) -> f64 {
        self.layout.scale
    }

    /// Writes the sums.
    pub(super) fn write(&self, out: &mut impl Write) -> Result<()> {
        out.write_all(&self.paths.to_le_bytes())?;
        out.write_all(bytemuck::cast_slice(&self.sums))
    }

    /// Takes what [`Self::write`] has written.
    pub(super) fn fill(&mut self, input: &mut impl Read) -> Result<()> {
        let mut paths = [0; 8];
        input.read_exact(&mut paths)?;
        self.paths = u64::from_le_bytes(paths);
        self.sums = array(input, self.sums.len())?;
        Ok(())
    }
}

/// The share of a kind in what the first surface scatters.
const KINDS: [ScatteringKind; 3] = [ScatteringKind::Diffuse, ScatteringKind::Glossy, ScatteringKind::Transmission];

/// The light that a pass shows of what light paths bring, if any.
fn share_of(aov: Aov, brought: u16) -> Option<Share> {
    let classes = match aov {
        Aov::Color | Aov::Luminance => return Some(Share::Radiance),
        Aov::LightGroup(number) => return Some(Share::Group(number)),
        Aov::Light(kind, LightPart::Direct) => 1u16 << kind as u16,
        Aov::Light(kind, LightPart::Indirect) => 16u16 << kind as u16,
        Aov::LightPaths(classes, _) => classes,
        _ => return None,
    };
    Some(classes & brought).filter(|classes| *classes != 0).map(Share::Classes)
}

fn kind_share(splat: &Splat, kind: ScatteringKind, channel: usize) -> f64 {
    let [diffuse, glossy] = splat.shares.map(|share| f64::from(share[channel]));
    match kind {
        ScatteringKind::Diffuse => diffuse,
        ScatteringKind::Glossy => glossy,
        ScatteringKind::Transmission => (1.0 - diffuse - glossy).max(0.0),
        ScatteringKind::Volume => 0.0,
    }
}
