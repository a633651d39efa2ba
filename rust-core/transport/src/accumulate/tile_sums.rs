//! The sums of a sample block by slot: radiance, coverage, AOVs, light passes, light groups, shader AOVs, shadow catchers.

use crate::accumulate::catcher_sums::CatcherSums;
use crate::accumulate::deep_sums::DeepSums;
use crate::accumulate::effort::Effort;
use crate::accumulate::light_sums::LightSums;
use crate::accumulate::matte_sums::MatteSums;
use crate::accumulate::shader_sums::ShaderSums;
use crate::state::columns::{Columns3, add_scaled, columns3};
use crate::tables::transport::Passes;
use gonio_camera::sampler::BATCH;
use gonio_simd::Column;

/// Sums over the samples of a block, by pixel slot. Columns that no pass wants are empty.
#[derive(Debug)]
pub struct TileSums {
    /// Radiance: of the pixel in the first `BATCH` entries, the measured irradiance in the second, then that of shadow catchers.
    pub radiance: Columns3,
    /// Coverage.
    pub alpha: Column,
    /// Share of holdouts; empty where there are none.
    pub holes: Column,
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
    /// Instance sets (Hydra's primId, not triangles); of the block's first sample that met one, plus one, zero for none.
    pub prim_id: Column<u32>,
    /// Numbers of placements in their sets and of triangles in their meshes, kept like `prim_id`.
    pub instance_id: Column<u32>,
    /// See `instance_id`.
    pub element_id: Column<u32>,
    /// Pass indices of instances and of materials, kept like `prim_id`.
    pub object_index: Column<u32>,
    /// See `object_index`.
    pub material_index: Column<u32>,
    /// Texture coordinates.
    pub uv: Columns3,
    /// Motion vectors, and the weight that they are divided by.
    pub motion: [Column; 5],
    /// Mist pass: the share of light that the mist lets through.
    pub clearness: Column,
    /// Number of camera rays, for pixels whose number is not that of the block's samples.
    pub rays: Column,
    /// The radiance on specular paths: seen directly, in mirrors and through smooth glass.
    pub specular: Columns3,
    /// Light passes.
    pub lights: LightSums,
    /// Light groups.
    pub groups: LightSums,
    /// Light path expressions that are followed.
    pub expressions: LightSums,
    /// What materials show in passes of their own.
    pub shader: ShaderSums,
    /// Work by pixel.
    pub effort: Effort,
    /// What camera rays met, for cryptomattes.
    pub mattes: MatteSums,
    /// What camera rays met at which depth.
    pub deep: DeepSums,
    /// What shadow catchers hide; empty where there are none.
    pub catchers: CatcherSums,
}

impl Default for TileSums {
    fn default() -> Self {
        Self {
            radiance: columns3(2 * BATCH),
            alpha: Column::new(BATCH),
            holes: Column::default(),
            depth: Column::new(BATCH),
            normal: Columns3::default(),
            position: Columns3::default(),
            albedo: Columns3::default(),
            guides: Default::default(),
            prim_id: Column::new(BATCH),
            instance_id: Column::new(BATCH),
            element_id: Column::new(BATCH),
            object_index: Column::new(BATCH),
            material_index: Column::new(BATCH),
            uv: Columns3::default(),
            motion: Default::default(),
            clearness: Column::new(BATCH),
            rays: Column::new(BATCH),
            specular: Columns3::default(),
            lights: LightSums::default(),
            groups: LightSums::default(),
            expressions: LightSums::default(),
            shader: ShaderSums::default(),
            effort: Effort::default(),
            mattes: MatteSums::default(),
            deep: DeepSums::default(),
            catchers: CatcherSums::default(),
        }
    }
}

impl TileSums {
    /// Makes room for what passes want, and for nothing else.
    pub(crate) fn prepare_passes(&mut self, passes: &Passes) {
        self.effort.prepare(passes.effort);
        self.deep.prepare(passes.deep.is_some());
        let [albedo, normal] = &mut self.guides;
        for (columns, wanted) in [
            (&mut self.normal, passes.surface),
            (&mut self.position, passes.surface),
            (&mut self.albedo, passes.surface),
            (&mut self.uv, passes.uv),
            (&mut self.specular, passes.guides),
            (albedo, passes.guides),
            (normal, passes.guides),
        ] {
            let room = if wanted { BATCH } else { 0 };
            if columns[0].len() != room {
                *columns = columns3(room);
            }
        }
        let room = if passes.motion.is_some() { BATCH } else { 0 };
        if self.motion[0].len() != room {
            self.motion = std::array::from_fn(|_| Column::new(room));
        }
    }

    /// Makes room for the sums of shadow catchers.
    pub fn prepare_catchers(&mut self) {
        if self.catchers.is_empty() {
            self.radiance = columns3(4 * BATCH);
            self.catchers.prepare();
        }
    }

    /// Makes room for the shares of holdouts.
    pub(crate) fn prepare_holes(&mut self) {
        if self.holes.is_empty() {
            self.holes = Column::new(BATCH);
        }
    }

    /// Sets radiance and coverage of a slot, and of how many camera rays they are made.
    pub fn set_pixel(&mut self, slot: usize, [red, green, blue, coverage]: [f32; 4], rays: u32) {
        for (column, value) in self.radiance.iter_mut().zip([red, green, blue]) {
            column[slot] = value;
        }
        (self.alpha[slot], self.rays[slot]) = (coverage, rays as f32);
    }

    /// Adds the sums of trees of specular rays, each ray counting as `factor` of a sample.
    pub(crate) fn add_specular(&mut self, rays: &Self, factor: f32) {
        add_scaled(&mut self.radiance, &rays.radiance, factor);
        add_scaled(&mut self.specular, &rays.specular, factor);
        self.guides.iter_mut().zip(&rays.guides).for_each(|(to, from)| add_scaled(to, from, factor));
        self.lights.add_scaled(&rays.lights, factor);
        self.groups.add_scaled(&rays.groups, factor);
        self.expressions.add_scaled(&rays.expressions, factor);
    }

    /// Tells apart at which depths the samples of a batch found their light; once it is traced.
    pub(crate) fn settle_depths(&mut self) {
        self.deep.settle(&self.radiance, &self.alpha);
    }

    /// Empties the sums of radiance and coverage, for those who look at nothing else.
    pub fn clear_colour(&mut self) {
        self.radiance.iter_mut().chain([&mut self.alpha]).for_each(|column| column.fill(0.0));
    }

    /// Empties all sums.
    pub fn clear(&mut self) {
        let threes = [&mut self.radiance, &mut self.normal, &mut self.position, &mut self.albedo, &mut self.uv, &mut self.specular];
        let ones = [&mut self.alpha, &mut self.holes, &mut self.depth, &mut self.clearness, &mut self.rays, &mut self.effort.rays];
        threes
            .into_iter()
            .chain(&mut self.guides)
            .flatten()
            .chain(ones)
            .chain(&mut self.motion)
            .chain(&mut self.shader.columns)
            .chain(self.catchers.columns())
            .for_each(|column| column.fill(0.0));
        [&mut self.prim_id, &mut self.instance_id, &mut self.element_id, &mut self.object_index, &mut self.material_index]
            .into_iter()
            .for_each(|column| column.fill(0));
        self.lights.clear();
        self.groups.clear();
        self.expressions.clear();
        self.mattes.met.clear();
        self.deep.clear();
    }
}
