//! Media that scatter: what happens to rays between surfaces (pbrt's `SampleMediumInteraction`, Cycles' `shade_volume`).
//!
//! The light that media send along rays is added (`shine`), a light is sampled for a place of each way (`light`), and it is drawn where paths scatter
//! before what they would meet (`flight`, `scatter`). All of it in one pass over the rays that are in something.

mod context;
mod flight;
mod light;
mod scatter;
mod shine;
mod way;

use crate::accumulate::deposit::Deposits;
use crate::state::nearest::NearestHits;
use crate::state::paths::Paths;
use crate::state::queue::Queues;
use gonio_simd::{Lanes, dispatch};
use way::Way;

pub(crate) use context::MediumContext;

/// Takes camera paths through the media between them and what they hit: those that scatter before hit nothing.
pub(crate) fn pass(
    context: &MediumContext<'_>,
    paths: &mut Paths,
    nearest: &mut NearestHits,
    queues: &mut Queues,
    deposits: &mut Deposits,
) {
    dispatch!(context.transport.execution, l => pass_paths(l, context, paths, nearest, queues, deposits));
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
        let Some(way) = Way::load(l, media, paths, &nearest.hits, at) else { continue };
        if media.shines() {
            shine::add(context, &way, deposits);
        }
        if !way.scatters.any() {
            continue;
        }
        let going_on = way.going_on(&context.transport.limits);
        light::sample(context, &way, going_on, &mut queues.shadows, deposits);
        let flight = flight::draw(context, &way);
        let scattered = way.scatters & flight.scatters;
        scatter::add_seen(context, &way, scattered, deposits);
        scatter::go_on(context, &way, &flight, scattered & going_on, &mut queues.next);
        flight::settle(&way, &flight, scattered, paths, &mut nearest.hits);
    }
}

/// The same for light paths, which sample no light; those that scatter are taken from the escaped ones.
pub(crate) fn pass_light(context: &MediumContext<'_>, paths: &mut Paths, nearest: &mut NearestHits, next: &mut Paths) {
    dispatch!(context.transport.execution, l => pass_light_paths(l, context, paths, nearest, next));
}

#[inline(always)]
fn pass_light_paths<L: Lanes>(l: L, context: &MediumContext<'_>, paths: &mut Paths, nearest: &mut NearestHits, next: &mut Paths) {
    let NearestHits { hits, escaped, .. } = nearest;
    for at in (0..paths.count).step_by(L::COUNT) {
        let Some(way) = Way::load(l, &context.tables.materials.media, paths, hits, at).filter(|way| way.scatters.any()) else { continue };
        let flight = flight::draw(context, &way);
        let scattered = way.scatters & flight.scatters;
        scatter::go_on(context, &way, &flight, scattered & way.going_on(&context.transport.limits), next);
        let bits = scattered.bits();
        escaped.retain(|path| !(at..at + L::COUNT).contains(&(*path as usize)) || bits >> (*path as usize - at) & 1 == 0);
        flight::settle(&way, &flight, scattered, paths, hits);
    }
}
