//! Vertex merging (photon mapping): camera paths take up the photons about their vertices, but for those that the camera sees directly.

use crate::accumulate::deposit::{Contribution, Deposits, Source};
use crate::kernels;
use crate::state::chunk::ChunkContext;
use crate::state::vertex::Vertex;
use crate::tables::bright_places::BrightPlaces;
use crate::tables::light_groups::UNSEEN;
use crate::tables::photons::PhotonMap;
use crate::words::{code, flag};
use gonio_bsdf::Lobes;
use gonio_camera::sampler::dimension;
use gonio_simd::{F, Lanes, M, PADDING, Spectrum, U, Vec3, Wavelengths};
use std::f32::consts::PI;

/// Photons about the points of a register.
pub(crate) type Found = [Vec<u32>; PADDING];

/// Adds the light of photons about the chosen points, but for what light paths carry on from bright places.
#[inline(always)]
pub(crate) fn merge<L: Lanes>(
    chunk: &ChunkContext<'_, L>,
    (map, bright): (&PhotonMap, &BrightPlaces),
    point: &Vertex<L>,
    lobes: &Lobes<'_, L>,
    chosen: M<L>,
    found: &mut Found,
    deposits: &mut Deposits,
) {
    let ChunkContext { l, transport, .. } = *chunk;
    // The rest goes to the first surface by light paths.
    let seen_directly = chosen & (point.core.flags & flag::SEEN_DIRECTLY).ne(0);
    let left = if bright.is_empty() || !seen_directly.any() { l.f(1.0) } else { 1.0 - bright.carried_on(point.at.position, seen_directly) };
    let chosen = chosen & left.gt(0.0);
    let most = find(l, map, [point.at.position, point.at.geometric], chosen, found);
    if most == 0 {
        return;
    }
    let scale = left * (1.0 / (PI * map.radius() * map.radius()));
    let value =
        transport.limits.clamped(gathered(chunk, map, point, lobes, found, most, None) * point.core.throughput * scale, point.bounces + 2);
    let code = ((point.core.flags >> flag::FIRST_SHIFT) & 3) + code::INDIRECT;
    let light = Contribution { slot: point.core.slot, value, code, shares: None, specular: l.m(false), source: Source::Several };
    let counted = deposits.deposit(transport, &light, chosen & value.is_lit() & value.abs().max_component().is_finite());
    let groups = &transport.passes.groups;
    if !groups.wanted() || !counted.any() {
        return;
    }
    for number in 0..groups.count as u32 {
        let part = gathered(chunk, map, point, lobes, found, most, Some((&groups.of_light, number))) * point.core.throughput * scale;
        deposits.sums.groups.add(l.u(number), point.core.slot, chunk.sample.to_film(point.core.slot, part), counted & part.is_lit());
    }
}

/// Irradiance that the photons about a register of points bring to their front, R, G, B.
#[inline(always)]
pub(crate) fn irradiance<L: Lanes>(
    wavelengths: Wavelengths<'_, L>,
    map: &PhotonMap,
    [position, normal]: [Vec3<L>; 2],
    chosen: M<L>,
    found: &mut Found,
) -> Spectrum<L> {
    let l = position.x.lanes();
    let most = find(l, map, [position, normal], chosen, found);
    irradiance_of(wavelengths, map, found, most, normal)
}

/// Where light paths bring what comes straight from lights, at random by the share that they carry on from there: surfaces that camera paths
/// meet after they were scattered at the first.
#[inline(always)]
pub(crate) fn direct_left<L: Lanes>(chunk: &ChunkContext<'_, L>, map: &BrightPlaces, point: &Vertex<L>, chosen: M<L>) -> M<L> {
    let chosen = chosen & (point.core.flags & flag::SEEN_DIRECTLY).ne(0);
    if map.is_empty() || !chosen.any() {
        return chunk.l.m(false);
    }
    let share = map.carried_on(point.at.position, chosen);
    chosen & in_share(chunk, point, share)
}

/// Whether a random number of the point's is below a share.
#[inline(always)]
pub(crate) fn in_share<L: Lanes>(chunk: &ChunkContext<'_, L>, point: &Vertex<L>, share: F<L>) -> M<L> {
    let context = chunk.sample;
    let [_, u] = context.sampler.pair(chunk.l, context.index(chunk.l, point.core.slot), context.dimension(dimension::CLOSURE));
    u.lt(share)
}

/// Irradiance by listed photons: of those on a normal's side.
#[inline(always)]
fn irradiance_of<L: Lanes>(wavelengths: Wavelengths<'_, L>, map: &PhotonMap, found: &Found, most: usize, normal: Vec3<L>) -> Spectrum<L> {
    let l = normal.x.lanes();
    let mut sum = Spectrum::zero(l);
    for at in 0..most {
        let (number, here) = numbers(l, found, at);
        let photon = map.photons(l, number);
        sum += wavelengths.radiance(photon.flux).keep_if(here & normal.dot(photon.wi).gt(0.0));
    }
    sum * (1.0 / (PI * map.radius() * map.radius()))
}

/// Lists the photons about each chosen point; gives the length of the longest list.
#[inline(always)]
fn find<L: Lanes>(l: L, map: &PhotonMap, [position, normal]: [Vec3<L>; 2], chosen: M<L>, found: &mut Found) -> usize {
    let [x, y, z, nx, ny, nz] = [position.x, position.y, position.z, normal.x, normal.y, normal.z].map(|x| x.to_array());
    let mut most = 0;
    for (lane, found) in found.iter_mut().enumerate().take(L::COUNT) {
        found.clear();
        if chosen.bits() >> lane & 1 == 1 {
            map.about(l, [x[lane], y[lane], z[lane]], [nx[lane], ny[lane], nz[lane]], found);
            most = most.max(found.len());
        }
    }
    most
}

/// The photons at a place of all lists, and which lists are so long.
#[inline(always)]
fn numbers<L: Lanes>(l: L, found: &Found, at: usize) -> (U<L>, M<L>) {
    let (mut numbers, mut lanes) = ([0; PADDING], 0_u64);
    for (lane, list) in found.iter().enumerate().take(L::COUNT) {
        if let Some(number) = list.get(at) {
            numbers[lane] = *number;
            lanes |= 1 << lane;
        }
    }
    (l.load_integers(&numbers, 0), M(l.mask_from_bits(lanes)))
}

/// What the photons send to the previous vertex, times the area that they are gathered from; of one group of lights, or of all.
#[inline(always)]
fn gathered<L: Lanes>(
    chunk: &ChunkContext<'_, L>,
    map: &PhotonMap,
    point: &Vertex<L>,
    lobes: &Lobes<'_, L>,
    found: &Found,
    most: usize,
    group: Option<(&[u32], u32)>,
) -> Spectrum<L> {
    let (l, wavelengths) = (chunk.l, chunk.sample.wavelengths(chunk.l, point.core.slot));
    let mut sum = Spectrum::zero(l);
    let geometric = point.at.frame.to_local(point.at.geometric);
    for at in 0..most {
        let (number, mut here) = numbers(l, found, at);
        let photon = map.photons(l, number);
        if let Some((of_light, number)) = group {
            let own = l.gather_integers(of_light, photon.light.keep_if(here));
            here &= own.ne(UNSEEN) & own.eq(number);
        }
        let wi = point.at.frame.to_local(photon.wi);
        let cosine = geometric.dot(wi);
        // BSDF × |cos| about the shading normal, for flux that fell on the triangle.
        let value = kernels::eval(l, lobes, point.local_wo, wi) * cosine.abs().max(1e-3).recip();
        sum += (value * wavelengths.radiance(photon.flux)).keep_if(here);
    }
    sum
}
