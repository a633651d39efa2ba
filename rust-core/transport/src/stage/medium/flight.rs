//! Free flights: where paths scatter before what they would hit.
//!
//! Flights through even media are drawn by the transmittance of one component of light, weighed over all of them. Media that vary are tracked up to where
//! that one ends: what comes first counts.

use super::context::MediumContext;
use super::way::Way;
use crate::media::phase::PhaseMix;
use crate::media::track::{Track, Tracked, depth, seed};
use crate::state::paths::Paths;
use gonio_accel::{Hits, NONE};
use gonio_camera::sampler::{dimension, to_unit};
use gonio_nodes::hash::hash2;
use gonio_simd::{F, Lanes, M, PADDING, Spectrum, U};

/// Tells the number that chooses among places from those of tracking.
const LIT: u32 = 0x11d7;

/// A register of flights.
#[derive(Clone, Copy, Debug)]
pub(super) struct Flight<L: Lanes> {
    /// Whether they end before the way does, and after how many metres.
    pub(super) scatters: M<L>,
    pub(super) distance: F<L>,
    /// Factor on the throughput of those that do.
    pub(super) factor: Spectrum<L>,
    /// Factor on that of those which come to the end of their way, beside what even media leave there.
    through: Spectrum<L>,
}

/// Where light is sampled for ways: where their flights end, or, through media that vary, at one place for all where they might have ended.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lit<L: Lanes> {
    pub(super) distance: F<L>,
    /// What the place scatters in the place of all, and how.
    pub(super) factor: Spectrum<L>,
    pub(super) phase: PhaseMix<L>,
}

impl<L: Lanes> Flight<L> {
    /// Where they end before their ways do, as a place to be lit.
    #[inline(always)]
    pub(super) fn end(&self, way: &Way<L>) -> Lit<L> {
        Lit { distance: self.distance, factor: self.factor.keep_if(self.scatters), phase: way.phase }
    }

    /// Those of which tracking leaves nothing at the end of their way: what they would meet there is not seen.
    #[inline(always)]
    pub(super) fn is_absorbed(&self) -> M<L> {
        !self.through.is_lit()
    }
}

/// Draws a flight along each way through even media.
#[inline(always)]
pub(super) fn draw<L: Lanes>(context: &MediumContext<'_>, way: &Way<L>) -> Flight<L> {
    let l = way.pdf.lanes();
    let u = context.pair(l, way.core.slot, dimension::FLIGHT);
    let channels = way.channels();
    let extinction = channels.choose(u[0], way.extinction);
    let distance = depth(u[1]) / extinction.max(f32::MIN_POSITIVE);
    let scatters = way.scatters_evenly & distance.lt(way.length) & extinction.gt(0.0);
    let left = way.transmittance(distance);
    let density = channels.dot(way.extinction * left);
    let factor = left * way.phase.scattering * density.max(f32::MIN_POSITIVE).recip();
    let through = Spectrum::constant(passes(way, way.length).max(f32::MIN_POSITIVE).recip());
    Flight { scatters, distance, factor, through }
}

/// The probability that flights through even media come so far.
#[inline(always)]
fn passes<L: Lanes>(way: &Way<L>, distance: F<L>) -> F<L> {
    let one = distance.lanes().f(1.0);
    way.scatters_evenly.select(way.channels().dot(way.transmittance(distance)), one)
}

/// What even media leave of light after so many metres, over the probability that flights come so far: what is met there is met by those alone.
#[inline(always)]
pub(super) fn left_where_flights_pass<L: Lanes>(way: &Way<L>, distance: F<L>) -> Spectrum<L> {
    way.transmittance(distance) * passes(way, distance).max(f32::MIN_POSITIVE).recip()
}

/// Follows ways through media that vary as far as their flights; gives the flights that they become and where they are lit, and lets ways scatter as
/// their places do. `shines` takes what is sent along them.
#[inline(always)]
pub(super) fn track<L: Lanes>(
    context: &MediumContext<'_>,
    (way, track): (&mut Way<L>, &Track<'_, L>),
    even: Flight<L>,
    shines: impl FnMut(F<L>, F<L>, Spectrum<L>),
) -> (Flight<L>, Lit<L>) {
    let l = way.pdf.lanes();
    let chosen = way.scatters & track.varies;
    let end = even.scatters.select(even.distance, way.length);
    let [own, first] = context.pair(l, way.core.slot, dimension::TRACK);
    let seed = seed(way.origin, way.direction, way.from, own.to_bits());
    let found = track.go([way.from, way.from + end], chosen, Some((way.core.throughput, first)), seed, shines);
    let scattered = chosen & found.scatters;
    let distance = (found.distance - way.from).max(0.0);
    let lit = lit(context, (way, track), &even, &found, seed);
    let factor =
        scattered.select(found.weight * left_where_flights_pass(way, distance), chosen.select(even.factor * found.weight, even.factor));
    let densities = track.densities(found.distance);
    let phase = PhaseMix::at(l, way.core.media, context.media(l, way.core.slot), densities);
    way.phase = way.phase.or(phase, scattered);
    let [_, extinction] = track.coefficients(found.distance, densities);
    way.extinction = scattered.select(extinction, way.extinction);
    let flight = Flight {
        scatters: even.scatters | scattered,
        distance: scattered.select(distance, even.distance),
        factor,
        through: chosen.select(even.through * found.weight, even.through),
    };
    (flight, lit)
}

/// The place where ways are lit: one of those where tracking might have scattered them, or where their flights through even media end.
#[inline(always)]
fn lit<L: Lanes>(
    context: &MediumContext<'_>,
    (way, track): (&Way<L>, &Track<'_, L>),
    even: &Flight<L>,
    found: &Tracked<L>,
    seed: U<L>,
) -> Lit<L> {
    let l = way.pdf.lanes();
    let distance = (found.place.distance - way.from).max(0.0);
    let mut place = found.place.alone(distance, left_where_flights_pass(way, distance));
    let phase = PhaseMix::at(l, way.core.media, context.media(l, way.core.slot), track.densities(found.place.distance));
    let ended = even.scatters.and_not(found.scatters);
    let evenly = place.add(even.distance, even.factor * found.weight, to_unit(hash2(l, seed, l.u(LIT))), ended);
    Lit { distance: place.distance, factor: place.whole(), phase: phase.or(way.phase, evenly) }
}

/// Multiplies what a register of paths carries, from the one at `at` on.
#[inline(always)]
pub(super) fn multiply<L: Lanes>(paths: &mut Paths, at: usize, factor: Spectrum<L>) {
    let mut places = [0; PADDING];
    places.iter_mut().zip(at as u32..).for_each(|(place, path)| *place = path);
    paths.carried.multiply(factor, &places[..L::COUNT.min(paths.count - at)]);
}

/// Takes what scattered or was absorbed from the hits, and makes up for it where paths came through; what dims them there is told at their hits.
#[inline(always)]
pub(super) fn settle<L: Lanes>(way: &Way<L>, flight: &Flight<L>, ended: M<L>, paths: &mut Paths, hits: &mut Hits) {
    let l = flight.distance.lanes();
    let count = L::COUNT.min(paths.count - way.at);
    let passed = way.scatters.and_not(ended);
    if passed.any() {
        multiply(paths, way.at, passed.select(flight.through, Spectrum::one(l)));
    }
    let bits = ended.bits();
    for lane in (0..count).filter(|lane| bits >> lane & 1 == 1) {
        hits.instance[way.at + lane] = NONE;
    }
}
