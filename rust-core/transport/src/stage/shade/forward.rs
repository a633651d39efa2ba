//! Light paths at a register of points: flux arrives, may be seen by the camera, and is scattered on by the adjoint BSDF.

use crate::accumulate::deposit::{Deposits, code_of_found};
use crate::stage::light::measure::MeasureContext;
use crate::stage::light::merge::in_share;
use crate::stage::light::nee::{seen_share, shares_of};
use crate::stage::shade::integrator::Integrator;
use crate::stage::shade::scatter::{send_on, without_cut_outs};
use crate::stage::shade::shading::{carried, normals, way_numbers};
use crate::state::chunk::ChunkContext;
use crate::state::light_paths::{ArrivalLanes, Connections};
use crate::state::paths::Paths;
use crate::state::queue::Queues;
use crate::state::queue::shadow_rays::{ShadowLanes, ShadowRays};
use crate::state::queue::shadow_trace::ShadowTrace;
use crate::state::rays::RayLanes;
use crate::state::vertex::Vertex;
use crate::state::wavelengths::at_slots;
use crate::tables::material::{SurfaceMaterial, parameter_values};
use crate::tables::photons::Bright;
use crate::words::{code, event, flag};
use crate::{geometry::shadow_ray_to, kernels};
use gonio_bsdf::{BsdfSample, Hits, LightHits, Lobes};
use gonio_camera::sampler::dimension;
use gonio_camera::{CameraTable, Placement};
use gonio_simd::{F, Lanes, M, One, Spectrum, SpectrumColumns, U, Vec3};

/// What of light paths is wanted.
#[derive(Clone, Copy, Debug)]
pub struct Wanted<'a> {
    /// Flux that arrives on surfaces.
    pub arrivals: Arriving,
    /// Whether paths go on by mirrors and smooth glass alone: camera paths find all that goes on otherwise.
    pub specular_only: bool,
    /// Light that surfaces send to the camera, which sees them directly; not that of a path's first surface, where paths are specular alone.
    pub picture: Option<Picture<'a>>,
}

impl Wanted<'_> {
    /// Whether paths carry flux as it is. Else they carry what camera paths would find, for what is found by both has to be the same.
    pub(crate) fn is_whole(&self) -> bool {
        !self.specular_only && self.picture.is_none()
    }
}

/// Which arrivals are noted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arriving {
    /// None.
    No,
    /// All, at any surface.
    All,
    /// Photons: those at surfaces that are not specular alone, black ones among them.
    Photons,
}

/// The picture that light paths bring light to.
#[derive(Clone, Copy, Debug)]
pub struct Picture<'a> {
    /// The camera.
    pub camera: &'a CameraTable,
    /// Where in a pixel its filter looks.
    pub placement: &'a Placement,
    /// First column and row of the window, and those behind the last.
    pub window: [[u32; 2]; 2],
}

/// Light paths: no light is sampled.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LightIntegrator<'a> {
    pub(crate) wanted: Wanted<'a>,
}

impl Integrator for LightIntegrator<'_> {
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
        _deposits: &mut Deposits,
    ) {
        let ChunkContext { l, transport, sample: context, .. } = *chunk;
        let clear = l.gather(&queues.light_paths.starts.clear, point.core.slot);
        point.alive &= point.bounces.ne(0) | l.gather(&chunk.hits.t, point.path).ge(clear);
        let lit = lit(chunk, point, queues);
        let index = context.index(l, point.core.slot);
        let base = context.dimension(0);
        let [u_lobe, u_opacity] = context.sampler.pair(l, index, base + dimension::LOBE);
        let present = without_cut_outs(chunk, material, point, lobes, u_opacity, &mut queues.next);
        let [non_specular, all_delta] = lobes.specularity(l);
        point.all_delta = all_delta;
        let noted = match self.wanted.arrivals {
            Arriving::No => l.m(false),
            Arriving::All => present & lit,
            Arriving::Photons => (present & lit).and_not(all_delta),
        };
        if noted.any() && !material.surface.lobes.straight {
            arrive(chunk, point, noted, at, queues);
        }
        let values = parameter_values(material, chunk.columns.outputs());
        let normals = normals(chunk, material, point, at);
        let entering = l.load(&chunk.columns.surface.side, at).gt(0.0);
        let numbers = way_numbers(chunk, material, point);
        let starts = &queues.light_paths.starts;
        let carried = carried(material, starts.carried(l, point.core.slot, point.core.throughput));
        let wo = point.local_wo;
        let hits = Hits { values: &values, at, wo, entering, normals: normals.as_ref(), walks: true, carried, numbers: numbers.as_ref() };
        let whole = self.wanted.is_whole();
        let light = LightHits { hits, geometric: point.at.frame.to_local(point.at.geometric), whole };
        let mut room = Lobes::empty(l);
        let going_on =
            present & point.bounces.lt(transport.limits.max_bounces + 1) & transport.limits.allow(point.core.counts, point.bounces);
        if let Some(picture) = &self.wanted.picture {
            let seen =
                (going_on & lit & non_specular & (point.bounces.ne(0) | l.m(!self.wanted.specular_only))).and_not(hidden(chunk, point));
            if seen.any() && !material.holdout {
                connect(chunk, material, point, (&light, lobes), seen, picture, &mut room, queues);
            }
        }
        let [u, v] = context.sampler.pair(l, index, base + dimension::BSDF);
        let sample = kernels::sample(l, lobes, point.local_wo, [u_lobe, u, v]);
        let mut goes = if self.wanted.specular_only { sample.delta } else { l.m(true) };
        if let (true, Some(photons)) = (self.wanted.picture.is_some(), &transport.photons) {
            goes |= goes_on(chunk, point, (&photons.bright, &sample), going_on.and_not(goes));
        }
        let mut factor = kernels::flux_factor(l, &material.surface, &light, lobes, &sample, &mut room);
        if chunk.tables.lights.has_factors() {
            let own = lamp_factor(chunk, point, &sample, queues);
            goes = goes.and_not(own.eq(0.0));
            factor = factor * own;
        }
        // Camera paths keep radiance behind an interface without the squared index, so what they take up there is less by it than the flux.
        if let (false, Some(squared)) = (whole, lobes.squared_index()) {
            let passed = sample.transmitted.and_not(sample.straight | sample.diffuse);
            factor = factor * passed.select(squared.recip(), Spectrum::one(l));
        }
        let [_, u_roulette] = context.sampler.pair(l, index, base + dimension::LIGHT_CHOICE);
        let ending = if material.transparent { present.and_not(going_on) } else { l.m(false) };
        let masks = [going_on & goes & (lit | sample.straight), ending];
        send_on(chunk, point, lobes, (&sample, factor), u_roulette, masks, &mut queues.next, &mut queues.walks);
    }

    #[inline(always)]
    fn measure<L: Lanes>(&self, _: &MeasureContext<'_, L>, _: &mut ShadowRays, _: &mut Paths, _: &mut Deposits) {}
}

/// Where a path's lamp lights what it met: what it does not light stays dark where its light arrives first. What goes straight on there does not arrive.
#[inline(always)]
fn lit<L: Lanes>(chunk: &ChunkContext<'_, L>, point: &Vertex<L>, queues: &Queues) -> M<L> {
    let l = chunk.l;
    if chunk.tables.links.receivers.is_empty() {
        return l.m(true);
    }
    let light = l.gather_integers(&queues.light_paths.starts.light, point.core.slot);
    point.bounces.ne(0) | chunk.tables.lights.sees(l, point.at.receiver, light)
}

/// The lamp's own factor on what is scattered first of its light.
#[inline(always)]
fn lamp_factor<L: Lanes>(chunk: &ChunkContext<'_, L>, point: &Vertex<L>, sample: &BsdfSample<L>, queues: &Queues) -> F<L> {
    let l = chunk.l;
    let kind = sample.diffuse.select(l.u(0), sample.transmitted.select(l.u(2), l.u(1)));
    let light = l.gather_integers(&queues.light_paths.starts.light, point.core.slot);
    let own = chunk.tables.lights.scattered_factor(l, light, kind);
    (point.bounces.eq(0) & !sample.straight).select(own, l.f(1.0))
}

/// Where the camera sees nothing of what the path has met.
#[inline(always)]
fn hidden<L: Lanes>(chunk: &ChunkContext<'_, L>, point: &Vertex<L>) -> M<L> {
    let (l, geometry) = (chunk.l, &chunk.tables.geometry);
    if geometry.set_hidden.is_empty() {
        return l.m(false);
    }
    l.gather_integers(&geometry.set_hidden, geometry.set_lanes(l, point.instance)).ne(0)
}

/// Which light paths of a picture go on where they scatter otherwise than specularly: from bright places, which camera paths seldom meet.
#[inline(always)]
fn goes_on<L: Lanes>(chunk: &ChunkContext<'_, L>, point: &Vertex<L>, (bright, sample): (&Bright, &BsdfSample<L>), chosen: M<L>) -> M<L> {
    // Beyond its first surface that is not specular a path is on its way.
    let under_way = (point.core.flags & flag::SEEN_DIRECTLY).ne(0);
    // Camera paths find what enters a surface first.
    let first = chosen.and_not(under_way | sample.entered);
    let [straight, caustic] = [first & point.bounces.eq(0), first & point.bounces.ne(0)];
    let mut goes = chosen & under_way;
    for (places, first) in [(&bright.direct, straight), (&bright.caustic, caustic)] {
        if first.any() && !places.is_empty() {
            goes |= first & in_share(chunk, point, places.carried_on(point.at.position, first));
        }
    }
    goes
}

/// Notes flux that arrived.
#[inline(always)]
fn arrive<L: Lanes>(chunk: &ChunkContext<'_, L>, point: &Vertex<L>, present: M<L>, at: usize, queues: &mut Queues) {
    let (l, surface) = (chunk.l, &chunk.columns.surface);
    let starts = &queues.light_paths.starts;
    let hit = ArrivalLanes {
        instance: point.instance,
        primitive: l.load_integers(&surface.primitive, at),
        barycentric: [l.load(&surface.barycentric[0], at), l.load(&surface.barycentric[1], at)],
        side: l.load(&surface.side, at),
        position: point.at.position,
        direction: -point.wo,
        flux: chunk.sample.to_film(point.core.slot, starts.carried(l, point.core.slot, point.core.throughput)),
        flags: point.core.flags,
        light: l.gather_integers(&starts.light, point.core.slot),
    };
    queues.light_paths.arrivals.append(&hit, present);
}

/// Queues rays to the lens for light that the camera may see.
#[inline(always)]
#[expect(clippy::too_many_arguments, reason = "a surface, its light and where it is seen")]
fn connect<'s, L: Lanes>(
    chunk: &ChunkContext<'_, L>,
    material: &'s SurfaceMaterial,
    point: &Vertex<L>,
    (light, lobes): (&LightHits<'s, L>, &Lobes<'s, L>),
    chosen: M<L>,
    picture: &Picture<'_>,
    room: &mut Lobes<'s, L>,
    queues: &mut Queues,
) {
    let ChunkContext { l, sample: context, .. } = *chunk;
    let index = context.index(l, point.core.slot);
    let base = context.dimension(0);
    let lens = context.sampler.pair(l, index, base + dimension::LIGHT);
    let filter = context.sampler.pair(l, index, base + dimension::SPLAT);
    let time = chunk.paths.rays.times(l, point.path);
    let seen = picture.camera.importance_at(l, point.at.position, lens, time);
    let (pixel, inside) = picture.pixel(l, seen.raster, filter);
    let to = -seen.direction;
    let front = point.at.geometric.dot(to).gt(0.0);
    let local = point.at.frame.to_local(to);
    // Neither side of the triangle may be told from the other by the shading normal alone: it would leak light.
    let usable = chosen & seen.valid & inside & (front & local.z.gt(0.0) | (!front) & local.z.lt(0.0));
    if !usable.any() {
        return;
    }
    let flux = kernels::flux(l, &material.surface, light, lobes, local, room);
    // As the camera sees it: layers take from each other by its angle.
    let (diffuse, drawn) = kernels::flux_diffuse(l, light, room, local);
    let scattered = as_radiance(lobes, local, [flux, diffuse]);
    let (straight, reflected) = (point.bounces.eq(0), local.z.gt(0.0));
    let exact = shares_of(diffuse, scattered, reflected);
    let starts = &queues.light_paths.starts;
    let light = l.gather_integers(&starts.light, point.core.slot);
    let scattered =
        if chunk.tables.lights.has_factors() { straight.select(scattered * seen_share(chunk, exact, light), scattered) } else { scattered };
    let value = starts.carried(l, point.core.slot, point.core.throughput)
        * scattered
        * (seen.importance * picture.camera.surroundings.squared_index);
    let lit = usable & value.is_lit() & value.abs().max_component().is_finite();
    let to_lens = shadow_ray_to(point.at.position, point.at.geometric, point.at.error, to, seen.distance);
    // The first surface that the camera sees scatters all of it: a light pass each, by the kind of its lobes. What comes later camera paths give to
    // the lobe that they have drawn.
    let glossy = (1.0 - drawn).keep_if(reflected);
    let shares = [straight.select(exact[0], Spectrum::constant(drawn)), straight.select(exact[1], Spectrum::constant(glossy))];
    // Straight from a light it is direct.
    let bounces = straight.select(l.u(1 << flag::BOUNCE_SHIFT), l.u(2 << flag::BOUNCE_SHIFT));
    let code = code_of_found(bounces | event::DIFFUSE, 0);
    let ray = RayLanes { origin: to_lens.origin, direction: to_lens.direction, t_min: l.f(0.0), t_max: to_lens.t_max };
    // Shares are colour from here on; what the ray carries is on its way.
    let wavelengths = chunk.sample.wavelengths(l, point.core.slot);
    let [diffuse, glossy] = shares;
    let shares = Some([wavelengths.as_colour(diffuse), wavelengths.as_colour(glossy)]);
    let connections = &mut queues.light_paths.connections;
    connections.rays.append_time(time, lit, chunk.transport.shutter.is_some());
    pixel.append(lit, &mut connections.pixel, connections.rays.count);
    let sent = ShadowLanes {
        ray,
        contribution: value,
        slot: point.core.slot,
        code,
        light,
        shares,
        receiver: None,
        along: point.along(chunk.tables, chunk.transport, to, None),
    };
    connections.rays.append(&sent, lit);
}

/// Flux that an interface sends to its other side as the radiance that camera paths keep there, without the squared index.
#[inline(always)]
fn as_radiance<L: Lanes>(lobes: &Lobes<'_, L>, to: Vec3<L>, [flux, diffuse]: [Spectrum<L>; 2]) -> Spectrum<L> {
    let behind = to.z.lt(0.0);
    let Some(squared) = lobes.squared_index() else { return flux };
    if !behind.any() {
        return flux;
    }
    // What is scattered diffusely passes no interface.
    let passed = (flux - diffuse).part_of(flux);
    behind.select(flux - passed * (Spectrum::one(flux.lanes()) - squared.recip()), flux)
}

impl Picture<'_> {
    /// The pixel whose filter, drawn from, looks at a place of the raster; and whether it lies in the window.
    #[inline(always)]
    fn pixel<L: Lanes>(&self, l: L, raster: [F<L>; 2], u: [F<L>; 2]) -> (U<L>, M<L>) {
        let offset = match self.placement {
            Placement::Filter(filter) => [filter.offset(l, u[0]), filter.offset(l, u[1])],
            Placement::Grid(_) => [u[0] - 0.5, u[1] - 0.5],
        };
        let [min, max] = self.window;
        // The camera looks from a pixel's middle at middle + offset, so what lies at a place is seen by the pixel about place − offset.
        let mut place = [(raster[0] - offset[0]).floor(), (raster[1] - offset[1]).floor()];
        if let Some(turn) = self.camera.turn() {
            // All around, both edges of the picture see the same.
            let (turn, left) = (turn.round(), min[0] as f32);
            place[0] -= ((place[0] - left) / turn).floor() * turn;
        }
        let inside = |axis: usize| place[axis].ge(min[axis] as f32) & place[axis].lt(max[axis] as f32);
        let inside = inside(0) & inside(1);
        let column = (place[0] - min[0] as f32).keep_if(inside).to_i32();
        let row = (place[1] - min[1] as f32).keep_if(inside).to_i32();
        (row * (max[0] - min[0]) + column, inside)
    }
}

/// Light that light paths brought to a pixel of the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Splat {
    /// Pixel of the window, row by row.
    pub pixel: u32,
    /// Light that it left.
    pub light: u32,
    /// Radiance of the pixel, R, G, B, times the number of paths.
    pub value: [f32; 3],
    /// Diffuse and glossy shares of what the surface scattered.
    pub shares: [[f32; 3]; 2],
    /// Whether it came straight from the light.
    pub direct: bool,
}

impl Splat {
    /// The splats of the connections that nothing blocked; light becomes colour here.
    pub(crate) fn collect(Connections { rays, pixel }: &Connections, trace: &ShadowTrace, splats: &mut Vec<Self>) {
        let (blocked, wavelengths) = (&trace.blocked, trace.wavelengths.as_deref());
        let three = |columns: &SpectrumColumns, at: usize| columns.load(One, at).to_rgb().into();
        let seen = |at: usize| at_slots(One, wavelengths, One.u(rays.slot[at])).to_rgb(rays.contribution.load(One, at)).into();
        splats.extend((0..rays.count).filter(|at| blocked[*at] == 0).map(|at| Self {
            pixel: pixel[at],
            light: rays.light[at],
            value: seen(at),
            shares: [three(&rays.shares[0], at), three(&rays.shares[1], at)],
            direct: rays.code[at] < code::INDIRECT,
        }));
    }
}
