//! Optical depth along shadow rays, which pass surfaces: segment by segment, from where they enter media to where they leave them; media that vary are
//! tracked along them.

use super::set::{MediaColumns, MediaSet};
use super::track::{Track, seed};
use crate::tables::media::{Coefficients, MediumTable};
use gonio_accel::TransparentHit;
use gonio_simd::{Column, Lanes, One, PADDING, Spectrum, SpectrumColumns, Vec3, WavelengthColumn};

/// Where a ray passes the surface of what a medium fills.
#[derive(Clone, Copy, Debug)]
struct Crossing {
    ray: u32,
    t: f32,
    row: u32,
    entering: bool,
}

/// A stretch of a ray through media that vary.
#[derive(Clone, Copy, Debug)]
struct Stretch {
    ray: u32,
    media: MediaSet<One>,
    ends: [f32; 2],
}

/// Columns of rays that are tracked.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TrackedRays<'a> {
    pub(crate) origin: [&'a [f32]; 3],
    pub(crate) direction: [&'a [f32]; 3],
    /// None where nothing moves.
    pub(crate) time: &'a [f32],
    /// What tells samples apart that send the same ray.
    pub(crate) salt: &'a [u32],
    pub(crate) wavelengths: WavelengthColumn<'a>,
}

/// By shadow ray; used where anything absorbs.
#[derive(Debug)]
pub struct OpticalDepth {
    crossings: Vec<Crossing>,
    depth: SpectrumColumns,
    stretches: Vec<Stretch>,
    /// Room for a register of them, and for what they leave of light.
    lanes: (MediaColumns, SpectrumColumns),
}

impl OpticalDepth {
    /// Room for so many rays.
    pub fn new(room: usize) -> Self {
        let lanes = (MediaColumns::new(PADDING), SpectrumColumns::new(PADDING));
        Self { crossings: Vec::new(), depth: SpectrumColumns::new(room), stretches: Vec::new(), lanes }
    }

    /// Begins with rays that have passed nothing.
    pub fn clear(&mut self) {
        self.crossings.clear();
        self.stretches.clear();
    }

    /// Adds hits on the surface of what a row of the table fills; `sides` are 1 where rays enter it, else -1.
    pub fn add(&mut self, row: u32, hits: &[TransparentHit], sides: &Column) {
        let crossings = hits.iter().zip(&sides[..]);
        self.crossings.extend(crossings.map(|(hit, side)| Crossing { ray: hit.ray, t: hit.t, row, entering: *side > 0.0 }));
    }

    /// Adds up the depths of the first `count` rays, which start in `media` and end at these distances, for light of their wavelengths.
    #[inline(always)]
    pub fn add_up<L: Lanes>(
        &mut self,
        l: L,
        (table, wavelengths): (&MediumTable, WavelengthColumn<'_>),
        media: &MediaColumns,
        ends: &[f32],
        count: usize,
    ) {
        for at in (0..count).step_by(L::COUNT) {
            let here = media.load(l, at);
            self.depth.store(here.optical_depth(table.at(wavelengths.load(l, at)), l.load(ends, at)), at);
            if table.varies() {
                let bits = (here.varies(table) & l.first(count - at)).bits();
                let rays = (at..at + L::COUNT).filter(|ray| bits >> (ray - at) & 1 == 1);
                self.stretches.extend(rays.map(|ray| Stretch { ray: ray as u32, media: media.load(One, ray), ends: [0.0, ends[ray]] }));
            }
        }
        // Whatever order surfaces come in.
        self.crossings
            .sort_unstable_by(|a, b| a.ray.cmp(&b.ray).then(a.t.total_cmp(&b.t)).then((a.row, a.entering).cmp(&(b.row, b.entering))));
        if table.varies() {
            let crossings = &self.crossings;
            self.stretches.retain(|stretch| crossings.binary_search_by_key(&stretch.ray, |crossing| crossing.ray).is_err());
        }
        for of_ray in self.crossings.chunk_by(|a, b| a.ray == b.ray) {
            let ray = of_ray[0].ray as usize;
            let of_light = table.at(wavelengths.gather(One, One.u(ray as u32)));
            self.depth.store(along(of_light, media.load(One, ray), of_ray, ends[ray], &mut self.stretches), ray);
        }
    }

    /// Dims what rays carry by what varies along them; those that something blocks are left.
    #[inline(always)]
    pub(crate) fn track<L: Lanes>(
        &mut self,
        l: L,
        table: &MediumTable,
        rays: TrackedRays<'_>,
        blocked: &[u8],
        carried: &mut SpectrumColumns,
    ) {
        self.stretches.retain(|stretch| blocked[stretch.ray as usize] == 0);
        // Rays of like lengths end together.
        let length = |stretch: &Stretch| stretch.ends[1] - stretch.ends[0];
        self.stretches.sort_unstable_by(|a, b| length(a).total_cmp(&length(b)));
        let Self { stretches, lanes: (media, left), .. } = self;
        for some in stretches.chunks(L::COUNT) {
            let (mut ray, mut ends) = ([0; PADDING], [[0.0; PADDING]; 2]);
            for (lane, stretch) in some.iter().enumerate() {
                media.store(stretch.media, lane);
                ray[lane] = stretch.ray;
                ends[0][lane] = stretch.ends[0];
                ends[1][lane] = stretch.ends[1];
            }
            let number = l.load_integers(&ray, 0);
            let [origin, direction] = [rays.origin, rays.direction].map(
                #[inline(always)]
                |[x, y, z]| Vec3::new(l.gather(x, number), l.gather(y, number), l.gather(z, number)),
            );
            let way = [l.load(&ends[0], 0), l.load(&ends[1], 0)];
            let time = || if rays.time.is_empty() { l.f(0.5) } else { l.gather(rays.time, number) };
            let of_light = table.at(rays.wavelengths.gather(l, number));
            let Some(track) = Track::of(l, of_light, media.load(l, 0), [origin, direction], time) else { continue };
            left.store(
                track.transmittance(way, l.first(some.len()), seed(origin, direction, way[0], l.gather_integers(rays.salt, number))),
                0,
            );
            for (lane, ray) in ray[..some.len()].iter().enumerate() {
                carried.multiply(*ray as usize, left, lane);
            }
        }
    }

    /// What is left of light along a register of rays, from the one at `at` on.
    #[inline(always)]
    pub fn transmittance<L: Lanes>(&self, l: L, at: usize) -> Spectrum<L> {
        (self.depth.load(l, at) * l.f(-1.0)).exp()
    }
}

/// Optical depth in even media of a ray that starts in some; notes its stretches through those that vary.
fn along(
    of_light: Coefficients<'_, One>,
    mut media: MediaSet<One>,
    crossings: &[Crossing],
    end: f32,
    stretches: &mut Vec<Stretch>,
) -> Spectrum<One> {
    let (mut depth, mut start) = (Spectrum::zero(One), 0.0);
    let mut note = |media: MediaSet<One>, ends: [f32; 2]| {
        if of_light.table.varies() && media.varies(of_light.table).any() {
            stretches.push(Stretch { ray: crossings[0].ray, media, ends });
        }
    };
    for Crossing { t, row, entering, .. } in crossings {
        note(media, [start, *t]);
        depth += media.extinction(of_light) * One.f(t - start);
        media = if *entering { media.entered(*row, One.m(true)) } else { media.left(*row, One.m(true)) };
        start = *t;
    }
    note(media, [start, end]);
    depth + media.optical_depth(of_light, One.f(end - start))
}
