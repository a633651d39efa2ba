//! Emission: light paths start at lights, or with rays of a table (pbrt's `Light::SampleLe`).

use crate::state::light_paths::LightStarts;
use crate::state::path_core::PathCore;
use crate::state::paths::{PathLanes, Paths};
use crate::state::rays::RayLanes;
use crate::state::sample::SampleContext;
use crate::tables::Tables;
use crate::tables::ray_table::RayTable;
use crate::words::flag;
use gonio_camera::sampler::{BATCH, dimension};
use gonio_light::{EmissionSampler, EmittedRay, LightSampleContext};
use gonio_simd::{Lanes, PADDING, U};

/// Where light paths start.
#[derive(Clone, Copy, Debug)]
pub enum Emission<'a> {
    /// At the scene's lights.
    Lights(&'a EmissionSampler),
    /// With the rays of a table, in order; behind its end it begins again.
    Rays(&'a RayTable),
}

/// A ray that leaves a light's surface starts so far off it, over the size of its coordinates: it may not meet the triangle that it leaves.
const OFFSET: f32 = 2e-6;

/// Starts a batch of light paths, one a slot.
#[inline(always)]
pub(crate) fn emit<L: Lanes>(
    l: L,
    tables: &Tables,
    emission: Emission<'_>,
    sample: &SampleContext<'_>,
    batch: u64,
    starts: &mut LightStarts,
    paths: &mut Paths,
) {
    paths.clear();
    for first in (0..BATCH as u32).step_by(L::COUNT) {
        let slot = l.iota() + first;
        let ray = match emission {
            Emission::Lights(sampler) => {
                let index = sample.index(l, slot);
                let [u_light, _] = sample.sampler.pair(l, index, sample.dimension(dimension::LIGHT_CHOICE));
                let place = sample.sampler.pair(l, index, dimension::PIXEL);
                let direction = sample.sampler.pair(l, index, dimension::LENS);
                sampler.sample(l, &tables.lights, u_light, place, direction)
            }
            Emission::Rays(table) => table.rays(l, numbers(l, table.len(), batch, first)),
        };
        let flux = tables.lights.light(sample.wavelengths(l, slot), ray.light, ray.flux);
        starts.flux.store(flux, first as usize);
        ray.light.store(&mut starts.light, first as usize);
        ray.clear.store(&mut starts.clear, first as usize);
        let carries = flux.is_lit() & flux.abs().max_component().is_finite();
        paths.append(&started(l, tables, &ray, slot), carries);
    }
}

/// Lets the flux of lamps that stand in glass or the like count as camera paths see it, which keep radiance behind interfaces.
#[inline(always)]
pub(crate) fn dim_starts<L: Lanes>(l: L, tables: &Tables, starts: &mut LightStarts) {
    for at in (0..BATCH).step_by(L::COUNT) {
        let factor = tables.lights.medium_factor(l, l.load_integers(&starts.light, at));
        starts.flux.store(starts.flux.load(l, at) * factor, at);
    }
}

/// Numbers of the rays that a batch's register takes from a table.
#[inline(always)]
fn numbers<L: Lanes>(l: L, count: usize, batch: u64, first: u32) -> U<L> {
    let mut numbers = [0; PADDING];
    let start = batch * BATCH as u64 + u64::from(first);
    numbers.iter_mut().zip(start..).for_each(|(number, at)| *number = (at % count as u64) as u32);
    l.load_integers(&numbers, 0)
}

#[inline(always)]
fn started<L: Lanes>(l: L, tables: &Tables, ray: &EmittedRay<L>, slot: U<L>) -> PathLanes<L> {
    let off = ray.origin.max_abs() * OFFSET;
    let from = LightSampleContext { position: ray.origin, normal: ray.normal, receiver: l.u(0) };
    let ray = RayLanes { origin: ray.normal.mul_add(off, ray.origin), direction: ray.direction, t_min: l.f(0.0), t_max: l.f(f32::MAX) };
    // Seen by what sees shadow rays, as all that a light sends.
    let core = PathCore::of_world(l, tables, slot, l.u(flag::DELTA | flag::FROM_LIGHT));
    PathLanes::start(ray, core).leaving(from, l.f(1.0))
}
