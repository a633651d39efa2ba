//! Free flights: where paths scatter before what they would hit, drawn by the transmittance of one component of light, weighed over all of them.

use super::context::MediumContext;
use super::way::Way;
use crate::state::paths::Paths;
use gonio_accel::{Hits, NONE};
use gonio_camera::sampler::dimension;
use gonio_simd::{F, Lanes, M, PADDING, Spectrum};

/// A register of flights.
#[derive(Clone, Copy, Debug)]
pub(super) struct Flight<L: Lanes> {
    /// Whether they end before the way does, and after how many metres.
    pub(super) scatters: M<L>,
    pub(super) distance: F<L>,
    /// Factor on the throughput of those that do.
    pub(super) factor: Spectrum<L>,
    /// The probability that a flight comes to the end of its way.
    passes: F<L>,
}

/// Draws a flight along each way.
#[inline(always)]
pub(super) fn draw<L: Lanes>(context: &MediumContext<'_>, way: &Way<L>) -> Flight<L> {
    let l = way.pdf.lanes();
    let u = context.pair(l, way.core.slot, dimension::FLIGHT);
    let channels = way.channels();
    let extinction = channels.choose(u[0], way.extinction);
    let distance = -(1.0 - u[1]).max(1e-9).ln() / extinction.max(f32::MIN_POSITIVE);
    let scatters = distance.lt(way.length) & extinction.gt(0.0);
    let left = way.transmittance(distance);
    let density = channels.dot(way.extinction * left);
    let factor = left * way.phase.scattering * density.max(f32::MIN_POSITIVE).recip();
    Flight { scatters, distance, factor, passes: channels.dot(way.transmittance(way.length)) }
}

/// Takes what scattered from the hits, and makes up for it where paths came through; what dims them there is told at their hits.
#[inline(always)]
pub(super) fn settle<L: Lanes>(way: &Way<L>, flight: &Flight<L>, scattered: M<L>, paths: &mut Paths, hits: &mut Hits) {
    let l = flight.distance.lanes();
    let count = L::COUNT.min(paths.count - way.at);
    let passed = way.scatters.and_not(scattered);
    if passed.any() {
        let factor = passed.select(flight.passes.max(f32::MIN_POSITIVE).recip(), l.f(1.0));
        let mut places = [0; PADDING];
        places.iter_mut().zip(way.at as u32..).for_each(|(place, path)| *place = path);
        paths.carried.multiply(Spectrum::constant(factor), &places[..count]);
    }
    let bits = scattered.bits();
    for lane in (0..count).filter(|lane| bits >> lane & 1 == 1) {
        hits.instance[way.at + lane] = NONE;
    }
}
