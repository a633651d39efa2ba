//! Light that rays found: the shapes of lights before surfaces, and infinite lights behind all (pbrt's escaped-ray and hit-area-light work items).
//!
//! It is weighted by MIS (multiple importance sampling) against next event estimation.

use crate::accumulate::add::add;
use crate::accumulate::deposit::{Contribution, Deposits, Source, code_of_found};
use crate::accumulate::expression_sums::with_state;
use crate::accumulate::guides::is_specular_path;
use crate::kernels::{self, LightHit};
use crate::state::columns::gather3;
use crate::state::light_paths::{Escapes, LightStarts};
use crate::state::nearest::{MetLights, NearestHits};
use crate::state::paths::{CarriedLanes, Paths, TrackLanes};
use crate::state::sample::SampleContext;
use crate::state::wavelengths::SlotWavelengths;
use crate::tables::Tables;
use crate::tables::transport::Transport;
use crate::words::{code, flag};
use gonio_accel::NONE;
use gonio_light::{EscapedRay, hit_weight};
use gonio_simd::{Lanes, Spectrum, U, dispatch};

/// Adds the light that shapes and the environment send along the rays of paths.
pub(crate) fn add_found(
    (tables, transport): (&Tables, &Transport),
    sample: &SampleContext<'_>,
    paths: &Paths,
    nearest: &mut NearestHits,
    deposits: &mut Deposits,
) {
    dispatch!(transport.execution, l => {
        add_shapes(l, (tables, transport), sample, paths, &nearest.lights, deposits);
        add_environment(l, (tables, transport), sample, paths, &mut nearest.escaped, deposits);
    });
}

/// Notes the flux of light paths that left the scene.
#[inline(always)]
pub(crate) fn escape<L: Lanes>(
    l: L,
    (tables, sample): (&Tables, &SampleContext<'_>),
    paths: &Paths,
    escaped: &mut Vec<u32>,
    starts: &LightStarts,
    escapes: &mut Escapes,
) {
    let count = escaped.len();
    escaped.resize(gonio_simd::padded(count), 0);
    for at in (0..count).step_by(L::COUNT) {
        let alive = l.first(count - at);
        let path = l.load_integers(escaped, at);
        let TrackLanes { slot, flags, .. } = paths.track(l, path);
        let flux = sample.to_film(slot, starts.carried(l, slot, leaving_scene(l, (tables, sample.wavelengths, None), paths, path)));
        let ray = [gather3(l, &paths.rays.origin, path), paths.cone(l, path).direction];
        escapes.append(ray, flux, flags >> flag::BOUNCE_SHIFT, alive);
    }
    escaped.truncate(count);
}

/// Throughput of paths behind all that they can still come through: where media reach infinitely far, none is left.
#[inline(always)]
fn leaving_scene<L: Lanes>(
    l: L,
    (tables, wavelengths, sample): (&Tables, Option<&SlotWavelengths>, Option<&SampleContext<'_>>),
    paths: &Paths,
    path: U<L>,
) -> Spectrum<L> {
    let throughput = paths.carried(l, path).throughput;
    if tables.materials.media.is_empty() {
        return throughput;
    }
    throughput * paths.transmittance(l, (tables, wavelengths, sample), path, l.f(f32::MAX), l.m(true))
}

/// Adds the emission of light shapes that paths hit, weighted by MIS against next event estimation.
#[inline(always)]
fn add_shapes<L: Lanes>(
    l: L,
    (tables, transport): (&Tables, &Transport),
    sample: &SampleContext<'_>,
    paths: &Paths,
    lights: &MetLights,
    deposits: &mut Deposits,
) {
    for at in (0..lights.path.len()).step_by(L::COUNT) {
        let path = l.load_integers(&lights.path, at);
        let alive = path.ne(NONE);
        let path = path.keep_if(alive);
        let (instance, t) = (l.load_integers(&lights.instance, at), l.load(&lights.t, at));
        let light = l.gather_integers(&tables.instance_light, instance - tables.first_light_instance);
        let direction = paths.cone(l, path).direction;
        let from = paths.previous(l, path);
        let point = direction.mul_add(t, gather3(l, &paths.rays.origin, path));
        let hit = LightHit { light, from, direction, point };
        let (radiance, pdf) =
            kernels::eval_light(l, tables, transport.light_cache.as_deref(), &hit, alive, sample.wavelengths(l, paths.track(l, path).slot));
        let (carried, TrackLanes { slot, flags, .. }) = (paths.carried(l, path), paths.track(l, path));
        let mut weight = hit_weight(carried.pdf, pdf, (flags & flag::DELTA).eq(0));
        if tables.lights.has_factors() {
            let factor = tables.lights.scattered_factor(l, light, (flags >> flag::LAST_SHIFT) & 3);
            weight = (flags & flag::CAMERA).ne(0).select(weight, weight * factor);
        }
        let radiance = if tables.any_absorbing {
            radiance * paths.transmittance(l, (tables, sample.wavelengths, Some(sample)), path, t, alive)
        } else {
            radiance
        };
        let value = transport.limits.clamped(radiance * carried.throughput * weight, flags >> flag::BOUNCE_SHIFT);
        let code = with_state(&transport.passes, code_of_found(flags, code::EMISSION), flags);
        let specular = is_specular_path(flags, slot);
        let left = transport.is_left_to_light_paths(flags, light, alive);
        let light = Contribution { slot, value, code, shares: None, specular, source: Source::Light(light) };
        deposits.deposit(transport, &light, (alive & value.is_lit()).and_not(left));
    }
}

/// Infinite lights whose caustics light paths bring.
fn infinite_left_to_light_paths<'a>(tables: &'a Tables, transport: &'a Transport) -> impl Iterator<Item = u32> + 'a {
    let left = transport.light_paths.as_deref().unwrap_or_default();
    tables.lights.infinite_lights().filter(|number| left.get(*number as usize).is_some_and(|left| *left != 0))
}

/// Adds the light of infinite lights to paths that escaped, weighted by MIS against next event estimation.
#[inline(always)]
fn add_environment<L: Lanes>(
    l: L,
    (tables, transport): (&Tables, &Transport),
    sample: &SampleContext<'_>,
    paths: &Paths,
    escaped: &mut Vec<u32>,
    deposits: &mut Deposits,
) {
    let count = escaped.len();
    escaped.resize(gonio_simd::padded(count), 0);
    for at in (0..count).step_by(L::COUNT) {
        let alive = l.first(count - at);
        let path = l.load_integers(escaped, at);
        let (CarriedLanes { pdf, .. }, TrackLanes { slot, flags, .. }) = (paths.carried(l, path), paths.track(l, path));
        let camera = (flags & flag::CAMERA).ne(0);
        let throughput = leaving_scene(l, (tables, sample.wavelengths, Some(sample)), paths, path);
        let passed = throughput.mean() * (1.0 / transport.squared_index);
        // The pdf of camera rays is their share of the sample. What dims them covers what is behind by as much.
        let covered = if transport.environment_covers { pdf } else { pdf - passed };
        add(&mut deposits.sums.alpha, slot, covered, alive & camera);
        let clear = if transport.limits.clear_roughness < 0.0 { l.m(false) } else { alive & (flags & flag::CLEAR).ne(0) };
        if clear.any() {
            // What glass lets pass of nothing does not cover what is behind.
            add(&mut deposits.sums.alpha, slot, -passed, clear);
        }
        let alive = if transport.shows_environment { alive } else { alive.and_not(camera | clear) };
        let from = paths.previous(l, path);
        let (direction, light_cache) = (paths.cone(l, path).direction, transport.light_cache.as_deref());
        let (delta, kind) = ((flags & flag::DELTA).ne(0), (flags >> flag::LAST_SHIFT) & 3);
        let ray = EscapedRay { direction, pdf, first: camera, delta, kind };
        let wavelengths = sample.wavelengths(l, slot);
        let all = kernels::eval_escaped(l, tables, light_cache, &from, &ray, None, wavelengths);
        let mut sent = all;
        for number in infinite_left_to_light_paths(tables, transport) {
            let left = transport.is_left_to_light_paths(flags, l.u(number), alive);
            if left.any() {
                let part = kernels::eval_escaped(l, tables, light_cache, &from, &ray, Some(number), wavelengths);
                sent = left.select((sent - part).left_of(all), sent);
            }
        }
        let unclamped = sent * throughput;
        let value = transport.limits.clamped(unclamped, flags >> flag::BOUNCE_SHIFT);
        let expressions = transport.passes.expressions.as_deref();
        let code = with_state(&transport.passes, code_of_found(flags, code::ENVIRONMENT), flags);
        let specular = is_specular_path(flags, slot);
        let light = Contribution { slot, value, code, shares: None, specular, source: Source::Several };
        let counted = deposits.deposit(transport, &light, alive & value.is_lit());
        deposits.note_sky(&light, direction, counted);
        let told_apart = expressions.filter(|expressions| expressions.infinite.is_none());
        if (transport.passes.groups.wanted() || told_apart.is_some()) && counted.any() {
            // A limit holds for all of them together.
            let share = value.abs().max_component() / unclamped.abs().max_component().max(f32::MIN_POSITIVE);
            for number in tables.lights.infinite_lights() {
                let value = kernels::eval_escaped(l, tables, light_cache, &from, &ray, Some(number), wavelengths) * throughput * share;
                let part = Contribution { value, source: Source::Light(l.u(number)), ..light };
                let left = transport.is_left_to_light_paths(flags, l.u(number), counted);
                let lit = (counted & value.is_lit()).and_not(left);
                deposits.deposit_to_group(&transport.passes.groups, &part, lit);
                if let Some(expressions) = told_apart {
                    deposits.deposit_to_expressions(expressions, &part, lit);
                }
            }
        }
    }
    escaped.truncate(count);
}
