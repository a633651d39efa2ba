//! The state of a batch of paths, in columns.

use super::{
    catcher::CatcherSums,
    light_draws::LightDraws,
    light_sums::{LightSums, code},
    material::Tables,
    paths::Paths,
    shader_passes::ShaderSums,
    shadow_order::ShadowOrder,
    statistics::Statistics,
    subsurface::Walks,
    transport::{FirstPasses, Transport},
    whitted::Branches,
};
use crate::{
    accel::{Hits, PassedHit},
    geometry::ShadowSegment,
    graph::{CHUNK, GraphScratch, OutputColumns, SurfaceColumns},
    light::Arrival,
};
use gonio_simd::{Column, Lanes, M, Rgb, U, Vec3, padded};

/// Pixels along a tile's side.
pub const TILE: usize = 64;
/// Pixels of a tile: the paths that start together.
pub const BATCH: usize = TILE * TILE;
/// Paths under way at once: each pixel's own, which a shadow catcher splits in two, and the one that measures its illuminance.
pub(super) const CAPACITY: usize = 3 * BATCH;
/// Room for shadow rays: walks under surfaces come out and are lit beside the surfaces themselves.
pub(super) const SHADOW_ROOM: usize = padded(2 * CAPACITY) + gonio_simd::PADDING;

/// What a path has met so far.
pub(super) mod flag {
    /// Nothing yet but what it saw through: hits are what the camera sees.
    pub(in crate::integrator) const CAMERA: u32 = 1;
    /// The last scattering was a mirror's or a smooth boundary's: lights cannot be sampled for it.
    pub(in crate::integrator) const DELTA: u32 = 2;
    /// A surface that is not a mirror has been met.
    pub(in crate::integrator) const MEASURED: u32 = 4;
    /// Above this bit, two bits: what the last scattering was, see [`event`].
    pub(in crate::integrator) const LAST_SHIFT: u32 = 3;
    /// Above this bit, two bits: what the first scattering was; of use only once there was one.
    pub(in crate::integrator) const FIRST_SHIFT: u32 = 5;
    /// Above this bit: the number of scatterings.
    pub(in crate::integrator) const BOUNCE_SHIFT: u32 = 8;
}

/// Kinds of scattering.
pub(super) mod event {
    /// Diffuse, fuzz and subsurface, reflected or transmitted.
    pub(in crate::integrator) const DIFFUSE: u32 = 0;
    /// Reflection off facets.
    pub(in crate::integrator) const GLOSSY: u32 = 1;
    /// Refraction.
    pub(in crate::integrator) const TRANSMISSION: u32 = 2;
}

/// Visibility bits of rays.
pub mod ray_mask {
    /// Rays from the camera.
    pub const CAMERA: u8 = 1;
    /// Rays to lights.
    pub const SHADOW: u8 = 2;
    /// Diffusely scattered rays.
    pub const DIFFUSE: u8 = 4;
    /// Rays of glossy reflection.
    pub const GLOSSY: u8 = 8;
    /// Rays of transmission.
    pub const TRANSMISSION: u8 = 16;
    /// Rays to lights that see shadow catchers alone.
    pub const CATCHER_SHADOW: u8 = 32;
    /// Scattered rays that see shadow catchers alone.
    pub const CATCHER_SCATTERED: u8 = 64;
    /// All scattered rays.
    pub const INDIRECT: u8 = DIFFUSE | GLOSSY | TRANSMISSION;
}

/// The pixel's Morton number in a slot of any kind of path.
#[inline(always)]
pub(super) fn pixel<L: Lanes>(slot: U<L>) -> U<L> {
    slot & (BATCH as u32 - 1)
}

pub(crate) type Columns3 = [Column; 3];

pub(super) fn columns3(len: usize) -> Columns3 {
    [Column::new(len), Column::new(len), Column::new(len)]
}

#[inline(always)]
pub(super) fn load3<L: Lanes>(l: L, columns: &Columns3, at: usize) -> Vec3<L> {
    Vec3::load(l, [&columns[0], &columns[1], &columns[2]], at)
}

#[inline(always)]
pub(super) fn gather3<L: Lanes>(l: L, columns: &Columns3, index: U<L>) -> Vec3<L> {
    Vec3::new(l.gather(&columns[0], index), l.gather(&columns[1], index), l.gather(&columns[2], index))
}

#[inline(always)]
pub(super) fn append3<L: Lanes>(v: Vec3<L>, mask: M<L>, columns: &mut Columns3, len: usize) {
    let [x, y, z] = columns;
    v.x.append(mask, x, len);
    v.y.append(mask, y, len);
    v.z.append(mask, z, len);
}

/// One register of shadow rays, to be appended.
#[derive(Clone, Copy, Debug)]
pub(super) struct ShadowLanes<L: Lanes> {
    pub(super) segment: ShadowSegment<L>,
    pub(super) contribution: Rgb<L>,
    pub(super) slot: U<L>,
    pub(super) code: U<L>,
    pub(super) light: U<L>,
    pub(super) shares: Option<[Rgb<L>; 2]>,
}

/// Shadow rays with what they bring if nothing is in the way.
#[derive(Debug)]
pub(super) struct ShadowRays {
    pub(super) count: usize,
    pub(super) origin: Columns3,
    pub(super) direction: Columns3,
    pub(super) t_max: Column,
    pub(super) contribution: Columns3,
    pub(super) slot: Column<u32>,
    /// What the contribution counts as, see [`super::light_sums::code`].
    pub(super) code: Column<u32>,
    /// The light that each ray leads to.
    pub(super) light: Column<u32>,
    /// Diffuse and glossy share of contributions at first surfaces; filled where passes of light are wanted.
    pub(super) shares: [Columns3; 2],
    /// Constant columns that the traversal wants.
    pub(super) t_min: Vec<f32>,
    pub(super) mask: Vec<u8>,
}

impl Default for ShadowRays {
    fn default() -> Self {
        let room = SHADOW_ROOM;
        Self {
            count: 0,
            origin: columns3(room),
            direction: columns3(room),
            t_max: Column::new(room),
            contribution: columns3(room),
            slot: Column::new(room),
            code: Column::new(room),
            light: Column::new(room),
            shares: [columns3(room), columns3(room)],
            t_min: vec![0.0; room],
            mask: vec![ray_mask::SHADOW; room],
        }
    }
}

impl ShadowRays {
    #[inline(always)]
    pub(super) fn append<L: Lanes>(&mut self, ray: &ShadowLanes<L>, chosen: M<L>) {
        let n = self.count;
        append3(ray.segment.origin, chosen, &mut self.origin, n);
        append3(ray.segment.direction, chosen, &mut self.direction, n);
        ray.segment.t_max.append(chosen, &mut self.t_max, n);
        append3(ray.contribution.into(), chosen, &mut self.contribution, n);
        ray.slot.append(chosen, &mut self.slot, n);
        ray.code.append(chosen, &mut self.code, n);
        ray.light.append(chosen, &mut self.light, n);
        if let Some(shares) = ray.shares {
            append3(shares[0].into(), chosen, &mut self.shares[0], n);
            append3(shares[1].into(), chosen, &mut self.shares[1], n);
        }
        self.count += chosen.count();
    }
}

/// Points whose illuminance is measured.
#[derive(Debug)]
pub(super) struct MeasurePoints {
    pub(super) count: usize,
    pub(super) position: Columns3,
    pub(super) error: Column,
    pub(super) geometric_normal: Columns3,
    pub(super) shading_normal: Columns3,
    pub(super) throughput: Columns3,
    pub(super) width: Column,
    pub(super) slot: Column<u32>,
}

impl Default for MeasurePoints {
    fn default() -> Self {
        let room = padded(BATCH) + gonio_simd::PADDING;
        Self {
            count: 0,
            position: columns3(room),
            error: Column::new(room),
            geometric_normal: columns3(room),
            shading_normal: columns3(room),
            throughput: columns3(room),
            width: Column::new(room),
            slot: Column::new(room),
        }
    }
}

/// Adds to each column another one's values times a factor.
pub(super) fn add_scaled(to: &mut Columns3, from: &Columns3, factor: f32) {
    for (to, from) in to.iter_mut().zip(from) {
        to.iter_mut().zip(from.iter()).for_each(|(to, from)| *to += from * factor);
    }
}

/// What the camera sees first, by pixel slot; sums over the samples of a block. Columns that no pass wants are empty.
#[derive(Debug)]
pub struct FirstHit {
    /// Radiance: of the pixel in the first `BATCH` entries, the measured irradiance in the second, then that of shadow catchers.
    pub radiance: Columns3,
    /// Coverage.
    pub alpha: Column,
    /// Distance along the camera's axis, metres.
    pub depth: Column,
    /// Shading normals, world space.
    pub normal: Columns3,
    /// Positions, world space, not rebased.
    pub position: Columns3,
    /// Albedos.
    pub albedo: Columns3,
    /// Albedo and normal for denoisers.
    pub guides: [Columns3; 2],
    /// Instance sets; of the block's first sample that met one, plus one, zero for none.
    pub prim_id: Column<u32>,
    /// Pass indices of instances and of materials, kept like `prim_id`.
    pub object_index: Column<u32>,
    /// See `object_index`.
    pub material_index: Column<u32>,
    /// Texture coordinates.
    pub uv: Columns3,
    /// What the mist leaves.
    pub clearness: Column,
    /// Camera rays, of pixels that have a number of their own.
    pub rays: Column,
    /// What of the radiance the camera sees sharply: straight, in mirrors and through smooth glass.
    pub sharp: Columns3,
    /// Light by where it comes from.
    pub lights: LightSums,
    /// Light by its group.
    pub groups: LightSums,
    /// What materials show in passes of their own.
    pub shader: ShaderSums,
    /// What shadow catchers hide; empty where there are none.
    pub catchers: CatcherSums,
}

impl Default for FirstHit {
    fn default() -> Self {
        Self {
            radiance: columns3(2 * BATCH),
            alpha: Column::new(BATCH),
            depth: Column::new(BATCH),
            normal: Columns3::default(),
            position: Columns3::default(),
            albedo: Columns3::default(),
            guides: Default::default(),
            prim_id: Column::new(BATCH),
            object_index: Column::new(BATCH),
            material_index: Column::new(BATCH),
            uv: Columns3::default(),
            clearness: Column::new(BATCH),
            rays: Column::new(BATCH),
            sharp: Columns3::default(),
            lights: LightSums::default(),
            groups: LightSums::default(),
            shader: ShaderSums::default(),
            catchers: CatcherSums::default(),
        }
    }
}

impl FirstHit {
    /// Makes room for what passes want, and for nothing else.
    fn prepare_passes(&mut self, passes: &FirstPasses) {
        let [albedo, normal] = &mut self.guides;
        for (columns, wanted) in [
            (&mut self.normal, passes.surface),
            (&mut self.position, passes.surface),
            (&mut self.albedo, passes.surface),
            (&mut self.uv, passes.uv),
            (&mut self.sharp, passes.guides),
            (albedo, passes.guides),
            (normal, passes.guides),
        ] {
            let room = if wanted { BATCH } else { 0 };
            if columns[0].len() != room {
                *columns = columns3(room);
            }
        }
    }

    /// Makes room for the sums of shadow catchers.
    pub fn prepare_catchers(&mut self) {
        if self.catchers.is_empty() {
            self.radiance = columns3(4 * BATCH);
            self.catchers.prepare();
        }
    }

    /// Sets radiance and coverage of a slot, and of how many camera rays they are made.
    pub fn set_pixel(&mut self, slot: usize, [red, green, blue, coverage]: [f32; 4], rays: u32) {
        for (column, value) in self.radiance.iter_mut().zip([red, green, blue]) {
            column[slot] = value;
        }
        (self.alpha[slot], self.rays[slot]) = (coverage, rays as f32);
    }

    /// Takes what other camera rays saw sharply, of which each counts as `factor` of one.
    pub(super) fn add_sharp(&mut self, rays: &Self, factor: f32) {
        add_scaled(&mut self.radiance, &rays.radiance, factor);
        add_scaled(&mut self.sharp, &rays.sharp, factor);
        self.guides.iter_mut().zip(&rays.guides).for_each(|(to, from)| add_scaled(to, from, factor));
        self.lights.add_scaled(&rays.lights, factor);
        self.groups.add_scaled(&rays.groups, factor);
    }

    /// Empties the sums of radiance and coverage, for those who look at nothing else.
    pub fn clear_colour(&mut self) {
        self.radiance.iter_mut().chain([&mut self.alpha]).for_each(|column| column.fill(0.0));
    }

    /// Empties all sums.
    pub fn clear(&mut self) {
        let threes = [&mut self.radiance, &mut self.normal, &mut self.position, &mut self.albedo, &mut self.uv, &mut self.sharp];
        let ones = [&mut self.alpha, &mut self.depth, &mut self.clearness, &mut self.rays];
        threes
            .into_iter()
            .chain(&mut self.guides)
            .flatten()
            .chain(ones)
            .chain(&mut self.shader.columns)
            .chain(self.catchers.columns())
            .for_each(|column| column.fill(0.0));
        [&mut self.prim_id, &mut self.object_index, &mut self.material_index].into_iter().for_each(|column| column.fill(0));
        self.lights.clear();
        self.groups.clear();
    }
}

/// Rays that go on behind the shapes of lights; their columns keep their room from batch to batch.
#[derive(Debug, Default)]
pub(super) struct RetracedRays {
    pub(super) origin: [Vec<f32>; 3],
    pub(super) direction: [Vec<f32>; 3],
    pub(super) t_min: Vec<f32>,
    pub(super) t_max: Vec<f32>,
    pub(super) mask: Vec<u8>,
}

impl RetracedRays {
    /// Takes the rays of the named paths.
    pub(super) fn select(&mut self, paths: &Paths, chosen: &[u32]) {
        fn fill<T: Copy>(to: &mut Vec<T>, from: &[T], chosen: &[u32]) {
            to.clear();
            to.extend(chosen.iter().map(|path| from[*path as usize]));
        }
        for axis in 0..3 {
            fill(&mut self.origin[axis], &paths.origin[axis], chosen);
            fill(&mut self.direction[axis], &paths.direction[axis], chosen);
        }
        fill(&mut self.t_min, &paths.t_min, chosen);
        fill(&mut self.t_max, &paths.t_max, chosen);
        fill(&mut self.mask, &paths.mask, chosen);
    }
}

/// All that a worker needs to trace a batch; made once a worker, so that no stage allocates.
#[derive(Debug, Default)]
pub struct Workspace {
    pub(super) paths: Paths,
    pub(super) next: Paths,
    pub(super) branches: Branches,
    pub(super) hits: Hits,
    pub(super) retraced: Hits,
    pub(super) retraced_rays: RetracedRays,
    pub(super) light_draws: LightDraws,
    pub(super) shadows: ShadowRays,
    pub(super) shadow_order: ShadowOrder,
    /// Light that arrived, where it is to be learned from.
    pub(crate) arrivals: Option<Vec<Arrival>>,
    pub(super) blocked: Vec<u8>,
    pub(super) passed: Vec<PassedHit>,
    pub(super) measure: MeasurePoints,
    pub(super) walks: Walks,
    pub(super) walk_hits: Hits,
    /// Walks that reached the surface.
    pub(super) out: Vec<u32>,
    /// Path numbers in the order of their materials, and where each material's begin and end.
    pub(super) order: Vec<u32>,
    pub(super) material_start: Vec<u32>,
    pub(super) material_end: Vec<u32>,
    pub(super) material_of: Vec<u32>,
    /// Mixes and the paths at them.
    pub(super) mixed: Vec<(u32, u32)>,
    /// Weights of a mix over a chunk, three channels a closure.
    pub(super) weights: Vec<f32>,
    pub(super) escaped: Vec<u32>,
    pub(super) at_lights: Vec<u32>,
    pub(super) surface: SurfaceColumns,
    pub(super) scratch: GraphScratch,
    pub(super) outputs: OutputColumns,
    /// What programs of shader passes computed.
    pub(super) shader_outputs: OutputColumns,
    /// The block under way.
    pub first_hit: FirstHit,
    /// The same of rays that see sharply alone.
    pub(super) sharp_hit: FirstHit,
    /// Rays traced and lanes alive, for benchmarks.
    pub statistics: Statistics,
}

impl Workspace {
    /// Slots of the rays at hand, and what they have hit.
    pub fn hits_by_slot(&self) -> (impl Iterator<Item = u32>, &Hits) {
        ((0..self.paths.count).map(|path| self.paths.slot(path)), &self.hits)
    }

    /// Lets rays that see sharply alone have sums of their own.
    pub(super) fn start_sharp(&mut self, transport: &Transport) {
        self.branches.prepare(transport);
        self.sharp_hit.clear();
        std::mem::swap(&mut self.first_hit, &mut self.sharp_hit);
    }

    /// Adds what they saw to the block, so many of them counting as one sample.
    pub(super) fn end_sharp(&mut self, rays: u32) {
        std::mem::swap(&mut self.first_hit, &mut self.sharp_hit);
        self.first_hit.add_sharp(&self.sharp_hit, 1.0 / rays as f32);
    }

    /// Empties the block's sums, and makes room for those that passes want.
    pub fn prepare(&mut self, tables: &Tables, transport: &Transport, shows_lights: bool) {
        self.branches.prepare(transport);
        for sums in [&mut self.first_hit, &mut self.sharp_hit] {
            sums.lights.prepare(if shows_lights { code::COUNT } else { 0 });
            sums.groups.prepare(transport.passes.groups.count);
            sums.prepare_passes(&transport.passes);
        }
        self.first_hit.shader.prepare(&transport.passes.shader);
        if !tables.geometry.set_catcher.is_empty() {
            self.first_hit.prepare_catchers();
        }
        self.first_hit.clear();
    }
}

const _: () = assert!(CHUNK.is_multiple_of(gonio_simd::PADDING));
