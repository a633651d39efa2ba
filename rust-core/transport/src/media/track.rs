//! Tracking (delta tracking with null collisions, ratio tracking; pbrt's `SampleT_maj`): paths through media that vary, by collisions as frequent as the bound of the density in each cell.
//!
//! Collisions are weighed (Kutz and others, Spectral and Decomposition Tracking for Rendering Heterogeneous Volumes, 2017): absorption is a weight, never
//! an end. Even media beside them are not tracked: they have closed forms.

use super::field::{Cell, FieldRays};
use super::set::MediaSet;
use crate::tables::media::Coefficients;
use gonio_camera::sampler::to_unit;
use gonio_nodes::hash::hash2;
use gonio_simd::{F, Lanes, M, Spectrum, U, Vec3};

/// Most steps of a ray: a guard against endless ones.
const MOST_STEPS: u32 = 1 << 16;
/// Weights below this are as good as none.
const LEAST_WEIGHT: f32 = 1e-6;
/// Where nothing scatters, half of the rays of a weight below this end at a collision, and the others weigh twice as much.
const SMALL_WEIGHT: f32 = 0.1;

/// A medium that varies, along a register of rays.
#[derive(Clone, Copy, Debug)]
struct Part<L: Lanes> {
    rays: FieldRays<L>,
    row: U<L>,
    extinction: Spectrum<L>,
    scattering: Spectrum<L>,
    emission: Spectrum<L>,
    /// The greatest component that the extinction has where density is 1.
    most: F<L>,
}

/// The media along a register of rays that vary.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Track<'a, L: Lanes> {
    media: Coefficients<'a, L>,
    parts: [Option<Part<L>>; 4],
    /// Rays in any.
    pub(crate) varies: M<L>,
}

/// Where rays come to.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tracked<L: Lanes> {
    /// Those that scatter, and after how many metres.
    pub(crate) scatters: M<L>,
    pub(crate) distance: F<L>,
    /// What is left of light there, over the probability of it; times the scattering where they scatter.
    pub(crate) weight: Spectrum<L>,
    /// One of the places where they might have scattered.
    pub(crate) place: Candidates<L>,
}

/// Places where rays might scatter: one of them, drawn by what each brings in the mean (weighted reservoir sampling), stands for all.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidates<L: Lanes> {
    /// After how many metres it is.
    pub(crate) distance: F<L>,
    /// What it scatters.
    scattered: Spectrum<L>,
    /// The sum of all of them, of its components' means.
    sum: F<L>,
}

impl<L: Lanes> Candidates<L> {
    #[inline(always)]
    fn none(l: L) -> Self {
        Self { distance: l.f(0.0), scattered: Spectrum::zero(l), sum: l.f(0.0) }
    }

    /// Takes in one more of the chosen lanes, by a random number; says where it is the one that stands for all now.
    #[inline(always)]
    pub(crate) fn add(&mut self, distance: F<L>, scattered: Spectrum<L>, u: F<L>, chosen: M<L>) -> M<L> {
        let share = scattered.abs().mean().keep_if(chosen);
        self.sum += share;
        let taken = chosen & (u * self.sum).lt(share);
        self.distance = taken.select(distance, self.distance);
        self.scattered = taken.select(scattered, self.scattered);
        taken
    }

    /// The one that stands for all alone, so many metres further on, dimmed.
    #[inline(always)]
    pub(crate) fn alone(&self, distance: F<L>, left: Spectrum<L>) -> Self {
        let scattered = self.whole() * left;
        Self { distance, scattered, sum: scattered.abs().mean() }
    }

    /// What the place scatters in the place of all.
    #[inline(always)]
    pub(crate) fn whole(&self) -> Spectrum<L> {
        self.scattered * (self.sum / self.scattered.abs().mean().max(f32::MIN_POSITIVE))
    }
}

/// Random numbers of a register of rays.
#[derive(Clone, Copy, Debug)]
struct Random<L: Lanes> {
    seed: U<L>,
    count: u32,
}

impl<L: Lanes> Random<L> {
    #[inline(always)]
    fn next(&mut self) -> F<L> {
        self.count += 1;
        let l = self.seed.lanes();
        to_unit(hash2(l, self.seed, l.u(self.count)))
    }
}

/// What steps send where nothing does.
#[inline(always)]
pub(crate) fn nothing<L: Lanes>(_: F<L>, _: F<L>, _: Spectrum<L>) {}

/// The optical depth of a flight, by a random number.
#[inline(always)]
pub(crate) fn depth<L: Lanes>(u: F<L>) -> F<L> {
    -(1.0 - u).max(1e-9).ln()
}

/// A seed for a ray from somewhere on; `salt` tells samples apart that send the very same ray.
#[inline(always)]
pub(crate) fn seed<L: Lanes>(origin: Vec3<L>, direction: Vec3<L>, from: F<L>, salt: U<L>) -> U<L> {
    let l = from.lanes();
    let place = hash2(l, origin.x.to_bits() ^ origin.y.to_bits().reverse_bits(), origin.z.to_bits() ^ from.to_bits().reverse_bits());
    let along = hash2(l, place ^ direction.x.to_bits(), direction.y.to_bits() ^ direction.z.to_bits().reverse_bits());
    hash2(l, along, salt)
}

impl<L: Lanes> Part<L> {
    /// That of some rows; `None` where none of them varies.
    #[inline(always)]
    fn new(l: L, media: Coefficients<'_, L>, row: U<L>, ray: [Vec3<L>; 2], time: F<L>) -> Option<Self> {
        let field = media.table.field(l, row);
        let here = field.ne(0);
        if !here.any() {
            return None;
        }
        let (rays, extinction) = (FieldRays::new(l, &media.table.fields, field, ray, time), media.field_extinction(l, row));
        Some(Self {
            rays,
            row,
            extinction,
            scattering: media.scattering(l, row).keep_if(here),
            emission: media.emission(l, row).keep_if(here),
            most: media.bound(l, row, extinction, rays.coloured(l)),
        })
    }
}

impl<'a, L: Lanes> Track<'a, L> {
    /// Those of rays that are in some media, from their places on, at times of the shutter; `None` where nothing varies.
    #[inline(always)]
    pub(crate) fn of(l: L, media: Coefficients<'a, L>, set: MediaSet<L>, ray: [Vec3<L>; 2], time: impl FnOnce() -> F<L>) -> Option<Self> {
        if media.table.varies() && set.varies(media.table).any() { Some(Self::new(l, &media, &set, &(ray, time()))) } else { None }
    }

    #[inline(never)]
    fn new(l: L, media: &Coefficients<'a, L>, set: &MediaSet<L>, (ray, time): &([Vec3<L>; 2], F<L>)) -> Self {
        l.vectorize(
            #[inline(always)]
            || {
                let parts = set.rows().map(
                    #[inline(always)]
                    |row| match row {
                        Some(row) => Part::new(l, *media, row, *ray, *time),
                        None => None,
                    },
                );
                Self { media: *media, parts, varies: set.varies(media.table) }
            },
        )
    }

    /// The bound of the extinction behind so many metres, and where it ends to hold.
    #[inline(always)]
    fn cell(&self, distance: F<L>) -> (F<L>, F<L>) {
        let l = distance.lanes();
        let (mut majorant, mut exit) = (l.f(0.0), l.f(f32::INFINITY));
        for part in self.parts.iter().flatten() {
            let Cell { most, exit: end } = part.rays.cell(l, &self.media.table.fields, distance);
            majorant = most.mul_add(part.most, majorant);
            exit = part.rays.any().select(exit.min(end), exit);
        }
        (majorant, exit)
    }

    /// Densities after so many metres, by the media's order.
    #[inline(always)]
    pub(crate) fn densities(&self, distance: F<L>) -> [F<L>; 4] {
        let l = distance.lanes();
        self.parts.map(
            #[inline(always)]
            |part| match part {
                Some(part) => part.rays.density(l, &self.media.table.fields, distance),
                None => l.f(0.0),
            },
        )
    }

    /// Scattering and extinction a metre after so many metres, where the media have these densities.
    #[inline(always)]
    pub(crate) fn coefficients(&self, distance: F<L>, densities: [F<L>; 4]) -> [Spectrum<L>; 2] {
        let l = densities[0].lanes();
        let mut sums = [Spectrum::zero(l); 2];
        for (part, density) in self.parts.iter().zip(densities) {
            let Some(part) = part else { continue };
            let even = (part.row, [part.scattering, part.extinction]);
            let [scattering, extinction] = part.rays.taken(l, self.media, even, distance, density);
            sums[0] += scattering;
            sums[1] += extinction;
        }
        sums
    }

    /// Radiance that a metre of each medium sends after so many metres.
    #[inline(always)]
    pub(crate) fn emission(&self, distance: F<L>) -> [Spectrum<L>; 4] {
        let l = distance.lanes();
        self.parts.map(
            #[inline(always)]
            |part| match part {
                Some(part) if part.emission.is_lit().any() => part.emission * part.rays.glow(l, self.media, distance),
                _ => Spectrum::zero(l),
            },
        )
    }

    /// Takes the chosen rays on until they scatter, or have gone so many metres from where the distances count.
    ///
    /// `scatter` has the weights of the components of light by which it is drawn whether a collision scatters, and the number that the first flight is
    /// drawn by; without it nothing scatters. `shines` takes what each step sends, over its metres: a place on it, its length, and the weight there.
    #[inline(always)]
    pub(crate) fn go(
        &self,
        [from, to]: [F<L>; 2],
        chosen: M<L>,
        scatter: Option<(Spectrum<L>, F<L>)>,
        seed: U<L>,
        mut shines: impl FnMut(F<L>, F<L>, Spectrum<L>),
    ) -> Tracked<L> {
        let l = from.lanes();
        let mut random = Random { seed, count: 0 };
        let (mut t, mut weight) = (from, Spectrum::one(l));
        let mut flight = depth(match scatter {
            Some((_, u)) => u,
            None => random.next(),
        });
        let mut active = chosen & self.varies & from.lt(to);
        let mut scattered = l.m(false);
        let mut place = Candidates::none(l);
        for _ in 0..MOST_STEPS {
            if !active.any() {
                break;
            }
            let (majorant, exit) = self.cell(t);
            let exit = exit.min(to);
            let hit = t + flight / majorant.max(f32::MIN_POSITIVE);
            // Where nothing is there is no collision, however far the ray goes.
            let collides = active & hit.lt(exit) & majorant.gt(0.0);
            let next = active.select(collides.select(hit, exit), t);
            shines(random.next().mul_add(next - t, t), (next - t).keep_if(active), weight);
            flight = collides.select(depth(random.next()), (flight - majorant * (next - t)).max(0.0));
            t = next;
            if collides.any() {
                let [scattering, extinction] = self.coefficients(t, self.densities(t));
                let null = Spectrum::constant(majorant) + extinction * l.f(-1.0);
                let probability = match scatter {
                    Some((channels, _)) => {
                        let shares = (weight * channels).abs();
                        let (some, none) = (shares.dot(scattering), shares.dot(null.abs()));
                        some / (some + none).max(f32::MIN_POSITIVE)
                    }
                    None => l.f(0.0),
                };
                if scatter.is_some() {
                    let share = weight * scattering * majorant.max(f32::MIN_POSITIVE).recip();
                    place.add(t, share, random.next(), collides);
                }
                let scatters = collides & random.next().lt(probability);
                let drawn = majorant * scatters.select(probability, 1.0 - probability);
                let factor = scatters.select(scattering, null) * drawn.max(f32::MIN_POSITIVE).recip();
                weight = collides.select(weight * factor, weight);
                if scatter.is_none() {
                    let small = collides & weight.abs().max_component().lt(SMALL_WEIGHT);
                    let doubled = weight * l.f(2.0).keep_if(random.next().lt(0.5));
                    weight = small.select(doubled, weight);
                }
                scattered |= scatters;
            }
            active = active.and_not(scattered) & t.lt(to) & weight.abs().max_component().gt(LEAST_WEIGHT);
        }
        let lost = (chosen & self.varies & t.lt(to)).and_not(scattered);
        Tracked { scatters: scattered, distance: t, weight: lost.select(Spectrum::zero(l), weight), place }
    }

    /// What is left of light along the chosen rays; an estimate, compiled once.
    #[inline(never)]
    pub(crate) fn transmittance(&self, way: [F<L>; 2], chosen: M<L>, seed: U<L>) -> Spectrum<L> {
        seed.lanes().vectorize(
            #[inline(always)]
            || {
                let left = self.go(way, chosen, None, seed, nothing).weight;
                (chosen & self.varies).select(left, Spectrum::one(left.lanes()))
            },
        )
    }
}
