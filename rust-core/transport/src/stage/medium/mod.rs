//! Media that scatter: what happens to rays between surfaces (pbrt's `SampleMediumInteraction`, Cycles' `shade_volume`).
//!
//! The light that media send along rays is added (`shine`), a light is sampled for a place of each way (`light`), and it is drawn where paths scatter
//! before what they would meet (`flight`, `scatter`). Where media vary, it is drawn first where paths scatter, and the light is sampled at one of the
//! places where they might. All of it in one pass over the rays that are in something.

mod context;
mod flight;
mod light;
mod scatter;
mod shine;
mod way;

use crate::accumulate::deposit::Deposits;
use crate::media::track::{Track, nothing, seed};
use crate::state::nearest::NearestHits;
use crate::state::paths::Paths;
use crate::state::queue::Queues;
use crate::state::sample::SampleContext;
use crate::tables::Tables;
use crate::tables::transport::Transport;
use crate::words::flag;
use context::MediumContext;
use flight::{Flight, Lit};
use gonio_simd::{Lanes, Spectrum, dispatch};
use way::Way;

/// Takes camera paths through the media between them and what they hit: those that scatter before hit nothing.
pub(crate) fn pass(
    (tables, transport): (&Tables, &Transport),
    sample: &SampleContext<'_>,
    paths: &mut Paths,
    nearest: &mut NearestHits,
    queues: &mut Queues,
    deposits: &mut Deposits,
) {
    let context = MediumContext { tables, transport, sample };
    dispatch!(transport.execution, l => pass_paths(l, &context, paths, nearest, queues, deposits));
}

#[inline(always)]
fn pass_paths<L: Lanes>(
    l: L,
    context: &MediumContext<'_>,
    paths: &mut Paths,
    nearest: &mut NearestHits,
    queues: &mut Queues,
    deposits: &mut Deposits,
) {
    let media = &context.tables.materials.media;
    for at in (0..paths.count).step_by(L::COUNT) {
        let Some(mut way) = Way::load(l, context, paths, &nearest.hits, at) else { continue };
        let track = way.track(context, paths);
        let tracked = track.as_ref().map_or(l.m(false), |track| track.varies);
        if media.shines() {
            shine::add(context, &way, way.alive.and_not(tracked), deposits);
        }
        if !way.scatters.any() {
            continue;
        }
        let going_on = way.going_on(&context.transport.limits);
        // Deep pictures want light from where it scatters; else the best place of the way is lit, whether its path scatters there or not.
        let at_places = match context.transport.passes.deep {
            Some(_) => tracked | (way.core.flags & flag::CAMERA).ne(0),
            None => tracked,
        };
        light::sample_along(context, &way, going_on.and_not(at_places), &mut queues.shadows, deposits);
        let mut flight = flight::draw(context, &way);
        let mut lit = None;
        if let Some(track) = &track {
            let (flown, place) = match media.shines() {
                true => pass_shining(context, &mut way, track, &flight, deposits),
                false => pass_varying(context, &mut way, track, &flight),
            };
            (flight, lit) = (flown, Some(place));
        }
        let lit = match (lit, context.transport.passes.deep.is_some()) {
            (Some(lit), false) => lit,
            _ => flight.end(&way),
        };
        light::sample_at(context, &way, &lit, going_on & at_places, &mut queues.shadows, deposits);
        let scattered = way.scatters & flight.scatters;
        let absorbed = (way.scatters & flight.is_absorbed()).and_not(scattered);
        scatter::add_seen(context, (&way, &flight), [scattered, absorbed], deposits);
        scatter::go_on(context, &way, &flight, scattered & going_on, &mut queues.next);
        flight::settle(&way, &flight, scattered | absorbed, paths, &mut nearest.hits);
    }
}

/// Follows ways through media that vary.
#[inline(never)]
fn pass_varying<L: Lanes>(context: &MediumContext<'_>, way: &mut Way<L>, track: &Track<'_, L>, even: &Flight<L>) -> (Flight<L>, Lit<L>) {
    way.pdf.lanes().vectorize(
        #[inline(always)]
        || flight::track(context, (way, track), *even, nothing),
    )
}

/// The same where something shines, which is added.
#[inline(never)]
fn pass_shining<L: Lanes>(
    context: &MediumContext<'_>,
    way: &mut Way<L>,
    track: &Track<'_, L>,
    even: &Flight<L>,
    deposits: &mut Deposits,
) -> (Flight<L>, Lit<L>) {
    way.pdf.lanes().vectorize(
        #[inline(always)]
        || {
            let l = way.pdf.lanes();
            let (mut sent, mut middle, along) = ([Spectrum::zero(l); 4], l.f(0.0), *way);
            let flight = flight::track(
                context,
                (way, track),
                *even,
                #[inline(always)]
                |place, length, weight| {
                    for (sum, part) in sent.iter_mut().zip(shine::sent(context, &along, track, place)) {
                        let light = part * weight * length;
                        *sum += light;
                        middle += light.mean() * (place - along.from);
                    }
                },
            );
            let whole = sent.iter().fold(l.f(0.0), |sum, part| sum + part.mean());
            let parts = sent.map(|part| part * way.core.throughput);
            shine::deposit(context, (way, middle / whole.max(f32::MIN_POSITIVE)), parts, way.scatters & track.varies, deposits);
            flight
        },
    )
}

/// For paths that no medium scatters: dims them by what varies before what they hit. What even media leave is told at hits.
pub(crate) fn dim((tables, transport): (&Tables, &Transport), sample: &SampleContext<'_>, paths: &mut Paths, nearest: &NearestHits) {
    let context = MediumContext { tables, transport, sample };
    dispatch!(transport.execution, l => dim_paths(l, &context, paths, nearest));
}

#[inline(always)]
fn dim_paths<L: Lanes>(l: L, context: &MediumContext<'_>, paths: &mut Paths, nearest: &NearestHits) {
    for at in (0..paths.count).step_by(L::COUNT) {
        let Some(way) = Way::load(l, context, paths, &nearest.hits, at) else { continue };
        let Some(track) = way.track(context, paths) else { continue };
        let seed = seed(way.origin, way.direction, way.from, context.sample.salt(l, way.core.slot));
        let left = track.transmittance([way.from, way.from + way.length], way.alive, seed);
        flight::multiply(paths, at, left);
    }
}

/// As [`pass`] for light paths, which sample no light; those that scatter are taken from the escaped ones.
pub(crate) fn pass_light(
    (tables, transport): (&Tables, &Transport),
    sample: &SampleContext<'_>,
    paths: &mut Paths,
    nearest: &mut NearestHits,
    next: &mut Paths,
) {
    let context = MediumContext { tables, transport, sample };
    dispatch!(transport.execution, l => pass_light_paths(l, &context, paths, nearest, next));
}

#[inline(always)]
fn pass_light_paths<L: Lanes>(l: L, context: &MediumContext<'_>, paths: &mut Paths, nearest: &mut NearestHits, next: &mut Paths) {
    let NearestHits { hits, escaped, .. } = nearest;
    for at in (0..paths.count).step_by(L::COUNT) {
        let Some(mut way) = Way::load(l, context, paths, hits, at).filter(|way| way.scatters.any()) else { continue };
        let mut flight = flight::draw(context, &way);
        if let Some(track) = way.track(context, paths) {
            (flight, _) = pass_varying(context, &mut way, &track, &flight);
        }
        let scattered = way.scatters & flight.scatters;
        scatter::go_on(context, &way, &flight, scattered & way.going_on(&context.transport.limits), next);
        let bits = scattered.bits();
        escaped.retain(|path| !(at..at + L::COUNT).contains(&(*path as usize)) || bits >> (*path as usize - at) & 1 == 0);
        flight::settle(&way, &flight, scattered, paths, hits);
    }
}
