//! The light table: all lights in the form that kernels read.

use super::build::fill_row;
use super::dome::{DomeDistribution, EVEN_SAMPLED_PART};
use super::gate::Gates;
use super::goniogram::Goniogram;
use super::light_kind::LightKind;
use super::links::{LightLinks, LinkedLights};
use super::record::{Falloff, LightRecord, LightTexture};
use super::row::{ROW, Reader, field, flag};
use super::texture::{Placed, TexturePool};
use super::tree::LightTree;
use gonio_simd::{F, Lanes, M, U};
use std::{borrow::Borrow, sync::Arc};

/// Up to this many lights each point weighs all of them.
pub(crate) const MOST_EXHAUSTIVE: usize = 64;

/// How one light of many is selected.
#[derive(Clone, Debug)]
pub(crate) enum LightSampler {
    /// All of them weighed at each point.
    Exhaustive,
    /// Sets of them weighed at each point, then the parts of one.
    Tree(LightTree),
}

/// An infinite light, visited by every ray that leaves the scene.
#[derive(Clone, Debug)]
pub(crate) struct InfiniteLight {
    pub(crate) light: u32,
    pub(crate) kind: LightKind,
    /// Of a textured dome.
    pub(crate) distribution: Option<DomeDistribution>,
    pub(crate) visible: bool,
    /// To scattered rays.
    pub(crate) scattered: bool,
    /// Factors on what kinds of scattered rays find of it.
    pub(crate) factors: [f32; 4],
    /// Light sampling alone finds it.
    pub(crate) alone: bool,
}

/// All lights of a scene, laid out for sampling.
#[derive(Clone, Debug)]
pub struct LightTable {
    /// One row of [`ROW`] values a light.
    pub(crate) rows: Vec<f32>,
    pub(crate) count: usize,
    /// Bit k: some light is of kind number k.
    pub(crate) kinds: u32,
    pub(crate) sampler: LightSampler,
    pub(crate) textures: TexturePool,
    pub(crate) infinite: Vec<InfiniteLight>,
    pub(crate) goniograms: Vec<Arc<Goniogram>>,
    /// Rows of the rectangles that domes are looked for through.
    pub(crate) portals: Vec<u32>,
    /// By light, factors on what is scattered of it, four each; empty where all is as it is.
    pub(crate) factors: Vec<f32>,
    /// By light, the two numbers of its falloff; empty where all fall by nature.
    pub(crate) falloffs: Vec<f32>,
    /// By light, 1 over the squared index of what it stands in; empty where no light stands in anything.
    pub(crate) media: Vec<f32>,
    /// By light, the number of its spectrum counted from 1, 0 without one; empty where no light has any.
    pub(crate) spectra: Vec<u32>,
    /// Whether light sampling alone finds some light.
    pub(crate) any_alone: bool,
    /// Whether shading programs know what some lights emit.
    pub(crate) any_shaded: bool,
    /// Filters before the lights.
    pub(crate) gates: Gates,
    /// Which receivers see which lights, if they do not all see all.
    pub(crate) linked: Option<Arc<LinkedLights>>,
}

/// Lets light sampling choose domes by the part of them that it samples.
fn weaken_domes(infinite: &[InfiniteLight], rows: &mut [f32]) {
    for dome in infinite.iter().filter(|infinite| infinite.kind == LightKind::Dome) {
        let even = if dome.alone { 1.0 } else { EVEN_SAMPLED_PART };
        let part = dome.distribution.as_ref().map_or(even, |distribution| distribution.sampled_part);
        rows[dome.light as usize * ROW + field::STRENGTH] *= (SAMPLED_GAIN * part).min(1.0) as f32;
    }
}

impl LightTable {
    /// Lets light sampling look at an even dome as at one with this image: more often where the image is bright.
    pub fn look_at_dome_by(&mut self, light: u32, image: &LightTexture) {
        let domes = self.infinite.iter_mut().filter(|infinite| infinite.light == light && infinite.kind == LightKind::Dome);
        domes.for_each(|dome| dome.distribution = Some(DomeDistribution::new(image)));
    }

    /// Lays out the lights; a light's index is its place in `records`. Lights without extent, power or finite values stay in the table and are
    /// never selected. A texture whose values do not fit its size counts as white.
    pub fn build(records: &[LightRecord], textures: &[impl Borrow<LightTexture>], goniograms: &[Arc<Goniogram>]) -> Self {
        let mut pool = TexturePool::default();
        let placed: Vec<Option<Placed>> = textures.iter().map(|image| pool.insert(image.borrow())).collect();
        let mut rows = vec![0.0; records.len() * ROW];
        let mut infinite = Vec::new();
        let mut portals = Vec::new();
        let mut kinds = 0;
        for (light, (record, row)) in records.iter().zip(rows.chunks_exact_mut(ROW)).enumerate() {
            let textured = matches!(record.kind, LightKind::Rectangle | LightKind::Dome);
            let index = record.texture.filter(|_| textured).map(|index| index as usize);
            let image = index.and_then(|i| placed.get(i).copied().flatten().map(|place| (place, textures[i].borrow())));
            let distribution = image.filter(|_| record.kind == LightKind::Dome).map(|(_, texture)| {
                if record.sampled_alone { DomeDistribution::of_emission(texture) } else { DomeDistribution::new(texture) }
            });
            let mean = match (&distribution, image) {
                (Some(distribution), _) => distribution.mean_luminance,
                (None, Some((_, texture))) => mean_luminance(texture),
                (None, None) => 1.0,
            };
            let goniogram = record.goniogram.filter(|_| !record.kind.is_infinite()).and_then(|number| goniograms.get(number as usize));
            fill_row(record, mean * goniogram.map_or(1.0, |goniogram| f64::from(goniogram.peak())), row);
            row[field::GONIOGRAM] = f32::from_bits(record.goniogram.filter(|_| goniogram.is_some()).map_or(0, |number| number + 1));
            fill_texture(image.map(|(place, _)| place), row);
            let flags = row[field::FLAGS].to_bits();
            if flags & (flag::SHAPED | flag::OPENING) != 0 || goniogram.is_some() || image.is_some() {
                row[field::FLAGS] = f32::from_bits(flags | flag::VARIED);
            }
            if record.portal {
                if record.kind == LightKind::Rectangle && row[field::DENSITY].is_finite() {
                    portals.push(light as u32);
                }
                continue;
            }
            kinds |= 1 << record.kind as u32;
            if record.kind.is_infinite() && row[field::FLAGS].to_bits() & (flag::LIT | flag::DELTA) == flag::LIT {
                let (visible, scattered) = (record.visible_to_camera, record.visible_to_scattered);
                let (alone, factors) = (record.sampled_alone, record.scattered);
                infinite.push(InfiniteLight { light: light as u32, kind: record.kind, distribution, visible, scattered, factors, alone });
            }
        }
        // Portals show the whole dome to light sampling.
        if portals.is_empty() {
            weaken_domes(&infinite, &mut rows);
        }
        let sampler = if records.len() <= MOST_EXHAUSTIVE { LightSampler::Exhaustive } else { LightSampler::Tree(LightTree::new(&rows)) };
        let any_alone = records.iter().any(|record| record.sampled_alone);
        let any_factor = records.iter().any(|record| record.scattered != [1.0; 4]);
        let factors = if any_factor { records.iter().flat_map(|record| record.scattered).collect() } else { Vec::new() };
        let falloff = |record: &LightRecord| if record.kind.is_infinite() { Falloff::NATURAL } else { record.falloff };
        let any_falloff = records.iter().any(|record| falloff(record) != Falloff::NATURAL);
        let falloffs = if any_falloff { records.iter().flat_map(|record| falloff(record).words()).collect() } else { Vec::new() };
        Self {
            rows,
            count: records.len(),
            kinds,
            sampler,
            textures: pool,
            infinite,
            goniograms: goniograms.to_vec(),
            portals,
            factors,
            falloffs,
            media: Vec::new(),
            spectra: Vec::new(),
            any_alone,
            any_shaded: records.iter().any(|record| record.shaded),
            gates: Gates::default(),
            linked: None,
        }
    }
    /// The same lights, of which receivers see those alone that `links` let them see.
    pub fn with_links(self, links: LightLinks) -> Self {
        let linked = LinkedLights::new(links, &self.rows);
        Self { linked: Some(Arc::new(linked)), ..self }
    }
    /// Whether some light counts for some kinds of scattering otherwise than for all.
    pub fn has_factors(&self) -> bool {
        !self.factors.is_empty()
    }
    /// Factor on what is scattered of each lane's light in a way (0 diffuse, 1 glossy, 2 transmitted, 3 by a medium); 0 where such rays do not see it.
    #[inline(always)]
    pub fn scattered_factor<L: Lanes>(&self, l: L, light: U<L>, kind: U<L>) -> F<L> {
        if self.factors.is_empty() {
            return l.f(1.0);
        }
        l.gather(&self.factors, (light << 2) + kind)
    }
    /// Whether receivers of a class see each lane's light.
    #[inline(always)]
    pub fn sees<L: Lanes>(&self, l: L, receiver: U<L>, light: U<L>) -> M<L> {
        self.linked.as_ref().map_or(l.m(true), |linked| linked.links.sees(l, receiver, light))
    }
    /// Whether receivers of a class see lights of each lane's set.
    #[inline(always)]
    pub fn sees_set<L: Lanes>(&self, l: L, receiver: U<L>, set: U<L>) -> M<L> {
        self.linked.as_ref().map_or(l.m(true), |linked| linked.links.sees_set(l, receiver, set))
    }
    /// Lights in the table.
    pub fn len(&self) -> usize {
        self.count
    }
    /// Whether there is no light at all.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }
    /// Indices of the infinite lights.
    pub fn infinite_lights(&self) -> impl Iterator<Item = u32> + '_ {
        self.infinite.iter().map(|infinite| infinite.light)
    }
    /// The group of a light whose samples are taken together: its kind, or itself where groups may be as many as lights.
    pub fn group(&self, light: u32, one_by_one: bool) -> usize {
        if one_by_one { light as usize } else { (self.rows[light as usize * ROW + field::FLAGS].to_bits() & flag::KIND) as usize }
    }
    /// The middle of a light that has a place and sends light.
    pub fn centre(&self, light: u32) -> Option<[f32; 3]> {
        self.ball(light).map(|(centre, _)| centre)
    }
    /// A ball around a light that has a place and sends light: its middle, and its radius in metres.
    pub fn ball(&self, light: u32) -> Option<([f32; 3], f32)> {
        let row = self.rows.as_chunks::<ROW>().0.get(light as usize)?;
        let flags = row[field::FLAGS].to_bits();
        let centre = [0, 1, 2].map(|axis| row[field::BOUND_CENTRE + axis]);
        (flags & (flag::LIT | flag::INFINITE) == flag::LIT).then_some((centre, row[field::BOUND_RADIUS]))
    }
    /// Whether a light emits from all around.
    pub fn is_dome(&self, light: u32) -> bool {
        self.infinite.iter().any(|infinite| infinite.light == light && infinite.kind == LightKind::Dome)
    }
    /// Whether some light is of this kind.
    pub fn has(&self, kind: LightKind) -> bool {
        self.kinds >> kind as u32 & 1 != 0
    }
    /// Whether lights differ in how they are sampled.
    pub fn has_several_kinds(&self) -> bool {
        self.kinds.count_ones() > 1
    }
    /// Whether camera rays see each lane's light.
    #[inline(always)]
    pub fn visible_to_camera<L: Lanes>(&self, l: L, light: U<L>) -> M<L> {
        if self.count == 0 {
            return l.m(false);
        }
        self.reader(l, light).flag(flag::VISIBLE)
    }
    #[inline(always)]
    pub(crate) fn reader<L: Lanes>(&self, l: L, light: U<L>) -> Reader<'_, L> {
        Reader::new(l, &self.rows, light)
    }
}

/// A dome is selected by this times the part of its light that light sampling is to bring, at most by all of it. Least variance on scenes of
/// `tests/peers/render` (crowd, field, street, car): by all of its light an even sky is drawn in vain, by the part alone a panorama too seldom.
const SAMPLED_GAIN: f64 = 2.0;

/// Mean luminance over an image.
fn mean_luminance(image: &LightTexture) -> f64 {
    let sum: f64 = image.rgb.as_chunks::<3>().0.iter().map(|c| super::build::luminance(*c)).filter(|y| y.is_finite()).sum();
    sum / (image.width * image.height) as f64
}

fn fill_texture(placed: Option<Placed>, row: &mut [f32]) {
    let Placed { first, width, height } = placed.unwrap_or(Placed { first: 0, width: 0, height: 0 });
    row[field::TEXTURE] = f32::from_bits(first);
    row[field::TEXTURE_WIDTH] = f32::from_bits(width);
    row[field::TEXTURE_HEIGHT] = f32::from_bits(height);
}
