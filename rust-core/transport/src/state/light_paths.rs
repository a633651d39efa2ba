//! Light paths' own state: the flux that each started with, and what a bounce brings: flux that arrived, escaped or may reach the camera.

use crate::state::columns::{Columns3, append3, columns3};
use crate::state::queue::shadow_rays::{SHADOW_ROOM, ShadowRays};
use crate::state::start_room::StartRoom;
use crate::state::textured_emission::EmissionRoom;
use crate::words::{flag, ray_mask};
use gonio_camera::sampler::{BATCH, CAPACITY};
use gonio_simd::{Column, Lanes, M, PADDING, Rgb, Spectrum, SpectrumColumns, U, Vec3, padded};

/// Room for what the paths of a batch bring in one bounce, and the walks that come out in it.
const ROOM: usize = padded(2 * CAPACITY) + PADDING;

/// By slot, what a light path started with; its throughput is the share that is left.
#[derive(Debug)]
pub(crate) struct LightStarts {
    /// Flux over the number of paths' share, see [`crate::Emission`].
    pub(crate) flux: SpectrumColumns,
    /// The light that it left; of ray tables 0.
    pub(crate) light: Column<u32>,
    /// Metres before which what the first ray meets stays dark, see [`gonio_light::EmittedRay`].
    pub(crate) clear: Column,
}

/// Flux that arrived on surfaces in one bounce, an entry each (photons). Rebased world space.
#[derive(Debug)]
pub struct Arrivals {
    /// Entries.
    pub count: usize,
    /// Instances that were hit.
    pub instance: Column<u32>,
    /// Triangles of their meshes.
    pub primitive: Column<u32>,
    /// Barycentric coordinates of corners 1 and 2.
    pub barycentric: [Column; 2],
    /// 1 on the triangle's front, −1 on its back.
    pub side: Column,
    /// Where.
    pub position: Columns3,
    /// Unit direction that the flux came in.
    pub direction: Columns3,
    /// Flux, R, G, B in the units of the emission.
    pub flux: Columns3,
    /// Path flags.
    pub(crate) flags: Column<u32>,
    /// Light that the path left.
    pub light: Column<u32>,
}

/// Flux that left the scene in one bounce, an entry each. Rebased world space.
#[derive(Debug)]
pub struct Escapes {
    /// Entries.
    pub count: usize,
    /// A point of the last ray.
    pub origin: Columns3,
    /// Its unit direction.
    pub direction: Columns3,
    /// Flux, R, G, B.
    pub flux: Columns3,
    /// Scatterings before.
    pub bounces: Column<u32>,
}

/// Light that may reach the camera: rays from the vertices of light paths, and where in the picture their light goes.
#[derive(Debug)]
pub(crate) struct Connections {
    /// Rays to the lens.
    pub(crate) rays: ShadowRays,
    /// By ray, the pixel of the window, row by row.
    pub(crate) pixel: Column<u32>,
}

/// All of them.
#[derive(Debug, Default)]
pub(crate) struct LightPathQueues {
    pub(crate) starts: LightStarts,
    pub(crate) arrivals: Arrivals,
    pub(crate) escapes: Escapes,
    pub(crate) connections: Connections,
    /// Scratch where programs know what lights emit.
    pub(crate) emission: Option<Box<EmissionRoom>>,
    /// Scratch where lamps may stand in what absorbs.
    pub(crate) media: Option<Box<StartRoom>>,
}

impl Default for LightStarts {
    fn default() -> Self {
        Self { flux: SpectrumColumns::new(BATCH + PADDING), light: Column::new(BATCH + PADDING), clear: Column::new(BATCH + PADDING) }
    }
}

impl Default for Arrivals {
    fn default() -> Self {
        let column = || Column::new(ROOM);
        let three = || columns3(ROOM);
        Self {
            count: 0,
            instance: Column::new(ROOM),
            primitive: Column::new(ROOM),
            barycentric: [column(), column()],
            side: column(),
            position: three(),
            direction: three(),
            flux: three(),
            flags: Column::new(ROOM),
            light: Column::new(ROOM),
        }
    }
}

impl Default for Escapes {
    fn default() -> Self {
        let three = || columns3(ROOM);
        Self { count: 0, origin: three(), direction: three(), flux: three(), bounces: Column::new(ROOM) }
    }
}

impl Default for Connections {
    fn default() -> Self {
        Self { rays: ShadowRays::with_mask(ray_mask::CAMERA), pixel: Column::new(SHADOW_ROOM) }
    }
}

/// One register of arrivals.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ArrivalLanes<L: Lanes> {
    pub(crate) instance: U<L>,
    pub(crate) primitive: U<L>,
    pub(crate) barycentric: [gonio_simd::F<L>; 2],
    pub(crate) side: gonio_simd::F<L>,
    pub(crate) position: Vec3<L>,
    pub(crate) direction: Vec3<L>,
    pub(crate) flux: Rgb<L>,
    pub(crate) flags: U<L>,
    pub(crate) light: U<L>,
}

impl Arrivals {
    #[inline(always)]
    pub(crate) fn append<L: Lanes>(&mut self, hit: &ArrivalLanes<L>, chosen: M<L>) {
        let n = self.count;
        hit.instance.append(chosen, &mut self.instance, n);
        hit.primitive.append(chosen, &mut self.primitive, n);
        hit.barycentric[0].append(chosen, &mut self.barycentric[0], n);
        hit.barycentric[1].append(chosen, &mut self.barycentric[1], n);
        hit.side.append(chosen, &mut self.side, n);
        append3(hit.position, chosen, &mut self.position, n);
        append3(hit.direction, chosen, &mut self.direction, n);
        append3(Vec3::new(hit.flux.r, hit.flux.g, hit.flux.b), chosen, &mut self.flux, n);
        hit.flags.append(chosen, &mut self.flags, n);
        hit.light.append(chosen, &mut self.light, n);
        self.count += chosen.count();
    }

    /// Scatterings of an entry's path before it arrived.
    pub fn bounces(&self, entry: usize) -> u32 {
        self.flags[entry] >> flag::BOUNCE_SHIFT
    }
}

impl Escapes {
    #[inline(always)]
    pub(crate) fn append<L: Lanes>(&mut self, [origin, direction]: [Vec3<L>; 2], flux: Rgb<L>, bounces: U<L>, chosen: M<L>) {
        let n = self.count;
        append3(origin, chosen, &mut self.origin, n);
        append3(direction, chosen, &mut self.direction, n);
        append3(Vec3::new(flux.r, flux.g, flux.b), chosen, &mut self.flux, n);
        bounces.append(chosen, &mut self.bounces, n);
        self.count += chosen.count();
    }
}

impl LightStarts {
    /// Flux that paths carry: what they started with times what is left of it.
    #[inline(always)]
    pub(crate) fn carried<L: Lanes>(&self, l: L, slot: U<L>, throughput: Spectrum<L>) -> Spectrum<L> {
        self.flux.gather(l, slot) * throughput
    }
}
