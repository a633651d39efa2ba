//! A register of path vertices on surfaces (pbrt's `SurfaceInteraction`).

use crate::geometry::{ShadowSegment, offset_ray_origin, shadow_ray_from, shadow_ray_to};
use crate::media::set::MediaSet;
use crate::state::passed::PassedLanes;
use crate::state::path_core::PathCore;
use crate::state::paths::PathLanes;
use crate::state::queue::shadow_rays::Along;
use crate::state::rays::RayLanes;
use crate::tables::Tables;
use crate::tables::guiding::Guided;
use crate::tables::transport::Transport;
use crate::words::flag;
use gonio_bsdf::Lobes;
use gonio_light::{LightSample, LightSampleContext};
use gonio_simd::{F, Frame, Lanes, M, U, Vec3};

/// Roughness widens a path's ray cone by this much, radians: blurred reflections need no fine texture level.
pub(crate) const CONE_PER_ROUGHNESS: f32 = 0.3;

/// Where on a surface a path is, and how rays leave there (pbrt's `Interaction`).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Interaction<L: Lanes> {
    /// World space, rebased, and a bound on its error, metres.
    pub(crate) position: Vec3<L>,
    pub(crate) error: F<L>,
    /// Geometric normal on the side of `wo`; the frame's z is the shading normal.
    pub(crate) geometric: Vec3<L>,
    pub(crate) frame: Frame<L>,
    /// Class of what is lit here, by which it selects lights; 0 sees all.
    pub(crate) receiver: U<L>,
}

impl<L: Lanes> Interaction<L> {
    /// The ray in a direction (pbrt's `SpawnRay`): it does not meet the surface that it leaves.
    #[inline(always)]
    pub(crate) fn spawn_ray(&self, direction: Vec3<L>) -> RayLanes<L> {
        let l = self.error.lanes();
        let origin = offset_ray_origin(self.position, self.geometric, self.error, direction);
        RayLanes { origin, direction, t_min: l.f(0.0), t_max: l.f(f32::MAX) }
    }

    /// The shadow ray to a light sample (pbrt's `SpawnRayTo`): it ends short of the light.
    #[inline(always)]
    pub(crate) fn spawn_ray_to(&self, sample: &LightSample<L>) -> RayLanes<L> {
        shadow_ray(shadow_ray_to(self.position, self.geometric, self.error, sample.wi, sample.distance))
    }

    /// The shadow ray to a light sample from beside: where `lifted`, from `lift` off the surface, on the side that is seen. From below the triangle blocks it.
    #[inline(always)]
    pub(crate) fn spawn_lifted_ray_to(&self, lift: Vec3<L>, lifted: M<L>, sample: &LightSample<L>) -> RayLanes<L> {
        let above = self.geometric.mul_add(self.error * 2.0, self.position + lift);
        let beside = offset_ray_origin(self.position, self.geometric, self.error, sample.wi);
        shadow_ray(shadow_ray_from(lifted.select(above, beside), self.position, sample.wi, sample.distance))
    }

    /// The normal that lights are chosen by; zero where lobes are about a fibre, of which no side is dark.
    #[inline(always)]
    pub(crate) fn lit_normal(&self, lobes: &Lobes<'_, L>) -> Vec3<L> {
        if lobes.has_fibre() { Vec3::splat(self.error.lanes(), [0.0; 3]) } else { self.frame.z }
    }

    /// As lights are sampled from here, and as the next vertex's MIS weight asks for it.
    #[inline(always)]
    pub(crate) fn light_context(&self) -> LightSampleContext<L> {
        LightSampleContext { position: self.position, normal: self.frame.z, receiver: self.receiver }
    }
}

/// A segment as a ray.
#[inline(always)]
fn shadow_ray<L: Lanes>(to: ShadowSegment<L>) -> RayLanes<L> {
    RayLanes { origin: to.origin, direction: to.direction, t_min: to.t_max.lanes().f(0.0), t_max: to.t_max }
}

/// A register of rays that go straight on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StraightOn<L: Lanes> {
    pub(crate) ray: RayLanes<L>,
    /// Of the cone where the rays start.
    pub(crate) width: F<L>,
    pub(crate) passed: PassedLanes<L>,
}

/// One register of path vertices: what shading, NEE and scattering read of a hit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Vertex<L: Lanes> {
    pub(crate) alive: M<L>,
    pub(crate) path: U<L>,
    /// Of the register's first lane in the columns of the chunk.
    pub(crate) place: usize,
    pub(crate) at: Interaction<L>,
    /// Unit direction to the previous vertex: world space, and in the frame of `at`.
    pub(crate) wo: Vec3<L>,
    pub(crate) local_wo: Vec3<L>,
    /// What the path carries, as it arrives.
    pub(crate) core: PathCore<L>,
    pub(crate) instance: U<L>,
    pub(crate) bounces: U<L>,
    /// What is behind the surface; [`PathCore::media`] is before it.
    pub(crate) behind: MediaSet<L>,
    /// Where all lobes are specular: mirrors or smooth glass.
    pub(crate) all_delta: M<L>,
    /// Pdf of the direction that found the vertex, per solid angle; of no meaning for camera rays.
    pub(crate) pdf: F<L>,
    /// Where light paths bring what comes straight from lights.
    pub(crate) direct_left: M<L>,
    /// What the guiding field knows here, where it is followed.
    pub(crate) guided: Option<Guided<L>>,
    /// Share of a camera ray's sample that is here; of no meaning for other rays.
    pub(crate) share: F<L>,
}

impl<L: Lanes> Vertex<L> {
    /// A vertex of a register's first lane at a place of its chunk, about which nothing is known yet but where it is and what the path carries.
    #[inline(always)]
    pub(crate) fn new(
        at: Interaction<L>,
        [wo, local_wo]: [Vec3<L>; 2],
        core: PathCore<L>,
        [path, instance]: [U<L>; 2],
        place: usize,
        alive: M<L>,
    ) -> Self {
        let l = core.unguided.lanes();
        Self {
            alive,
            path,
            place,
            at,
            wo,
            local_wo,
            core,
            instance,
            bounces: core.flags >> flag::BOUNCE_SHIFT,
            behind: MediaSet::open(l),
            all_delta: l.m(false),
            pdf: l.f(0.0),
            direct_left: l.m(false),
            guided: None,
            share: l.f(0.0),
        }
    }

    /// What rays that leave are in: `across` where they go behind the surface, `straight` where nothing bends them.
    #[inline(always)]
    pub(crate) fn media_towards(&self, across: M<L>, straight: M<L>) -> MediaSet<L> {
        self.core.media.towards(self.behind, across, straight)
    }

    /// What shadow rays take along that leave in a direction.
    #[inline(always)]
    pub(crate) fn along(&self, tables: &Tables, transport: &Transport, direction: Vec3<L>, ceiling: Option<F<L>>) -> Along<L> {
        let l = self.bounces.lanes();
        let media =
            if tables.any_absorbing { self.media_towards(self.at.geometric.dot(direction).lt(0.0), l.m(false)) } else { self.core.media };
        Along::new(tables, transport, media, self.core.counts, ceiling)
    }

    /// The path that leaves here with a ray, whose direction was found with a density, and with what it carries from here.
    #[inline(always)]
    pub(crate) fn go_on(&self, ray: RayLanes<L>, pdf: F<L>, core: PathCore<L>) -> PathLanes<L> {
        PathLanes::start(ray, core).leaving(self.at.light_context(), pdf)
    }

    /// The path that goes on, with some flags, as if there were no surface: it is still under way from the vertex before. `counted` is what that counts.
    #[inline(always)]
    pub(crate) fn straight_on(&self, on: &StraightOn<L>, before: LightSampleContext<L>, (flags, counted): (U<L>, u32)) -> PathLanes<L> {
        let everywhere = self.alive | !self.alive;
        let media = self.media_towards(everywhere, everywhere);
        let core = PathCore { width: on.width, flags, counts: self.core.counts + counted, media, ..self.core };
        PathLanes::start(on.ray, core).leaving(before, self.pdf).having_passed(Some(on.passed))
    }
}
