//! Path tracing at a register of points: cut-outs, next event estimation (NEE) of one light, BSDF sampling.

use crate::accumulate::deposit::Deposits;
use crate::stage::light::light_queue::sample_queued;
use crate::stage::light::measure::{self, MeasureContext};
use crate::stage::light::merge::{direct_left, merge};
use crate::stage::light::nee::{queue_shadow_ray, sample_light};
use crate::stage::shade::guided::{look_up, sampled_by_all, unguided};
use crate::stage::shade::integrator::Integrator;
use crate::stage::shade::portal::pass_on;
use crate::stage::shade::scatter::{send_on, without_cut_outs};
use crate::stage::shade::shading::{add_seen, guide_and_measure};
use crate::state::chunk::ChunkContext;
use crate::state::paths::Paths;
use crate::state::queue::Queues;
use crate::state::queue::light_samples::LightSampleQueue;
use crate::state::queue::shadow_rays::ShadowRays;
use crate::state::vertex::Vertex;
use crate::tables::material::SurfaceMaterial;
use crate::tables::transport::FirstLight;
use crate::words::flag;
use gonio_bsdf::Lobes;
use gonio_camera::sampler::dimension;
use gonio_light::SampleWeight;
use gonio_simd::Lanes;

/// One light and one direction at random at each point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PathIntegrator {
    /// Whether surfaces are lit; else paths go on by mirrors and smooth glass alone, and find what shines by itself.
    pub(crate) lit: bool,
}

impl Integrator for PathIntegrator {
    const WALKS: bool = true;

    fn shadow_rays_per_hit(&self) -> usize {
        1
    }

    #[inline(always)]
    fn shade<L: Lanes>(
        &self,
        chunk: &ChunkContext<'_, L>,
        material: &SurfaceMaterial,
        point: &mut Vertex<L>,
        lobes: &Lobes<'_, L>,
        at: usize,
        queues: &mut Queues,
        deposits: &mut Deposits,
    ) {
        let ChunkContext { l, tables, transport, sample: context, .. } = *chunk;
        let index = context.index(l, point.core.slot);
        let base = context.dimension(0);
        let [u_lobe, u_opacity] = context.sampler.pair(l, index, base + dimension::LOBE);
        point.core.unguided = unguided(chunk, point);
        let present = without_cut_outs(chunk, material, point, lobes, u_opacity, &mut queues.next);
        let present = add_seen(chunk, material, point, lobes, (present, true), at, deposits);
        if let Some(portal) = lobes.portal() {
            pass_on(chunk, point, portal, point.pdf, present, &mut queues.next);
            return;
        }
        let [non_specular, going_on] = guide_and_measure(chunk, point, lobes, present, &mut queues.measure, deposits);
        if let Some(photons) = &transport.photons {
            // At what the camera sees directly, light paths left their light in the picture.
            let rough = (point.core.flags & flag::ROUGH).ne(0);
            let splats = l.m(transport.first_light == FirstLight::Splats);
            let unseen = (going_on & non_specular).and_not(splats & point.bounces.eq(0) & !rough);
            for (map, chosen) in [(&photons.fine, unseen.and_not(rough)), (&photons.coarse, unseen & rough)] {
                if chosen.any() {
                    merge(chunk, (map, &photons.bright.caustic), point, lobes, chosen, &mut queues.photons, deposits);
                }
            }
            point.direct_left = direct_left(chunk, &photons.bright.direct, point, unseen);
        }
        look_up(chunk, point, lobes, going_on & non_specular);
        let [u_light, u_roulette] = context.sampler.pair(l, index, base + dimension::LIGHT_CHOICE);
        if self.lit && (non_specular & going_on).any() && !tables.lights.is_empty() {
            if LightSampleQueue::pays::<L>(&tables.lights, chunk.count) {
                let sample = sample_queued(chunk, at, lobes.has_fibre(), &mut queues.light_samples);
                queue_shadow_ray(chunk, point, lobes, (&sample, SampleWeight::Mis), going_on, &mut queues.shadows, deposits);
            } else {
                let [u, v] = context.sampler.pair(l, index, base + dimension::LIGHT);
                sample_light(chunk, point, lobes, [u_light, u, v], going_on, &mut queues.shadows, deposits);
            }
        }
        let [u, v] = context.sampler.pair(l, index, base + dimension::BSDF);
        let ending = if material.transparent { present.and_not(going_on) } else { l.m(false) };
        if (going_on | ending).any() {
            let (sample, factor) = sampled_by_all(chunk, point, lobes, [u_lobe, u, v]);
            let goes = if self.lit { l.m(true) } else { sample.delta | sample.straight };
            let masks = [going_on & goes, ending & goes];
            send_on(chunk, point, lobes, (&sample, factor), u_roulette, masks, &mut queues.next, &mut queues.walks);
        }
    }

    #[inline(always)]
    fn measure<L: Lanes>(&self, chunk: &MeasureContext<'_, L>, shadows: &mut ShadowRays, next: &mut Paths, deposits: &mut Deposits) {
        measure::light_and_start(chunk, shadows, next, deposits);
    }
}
