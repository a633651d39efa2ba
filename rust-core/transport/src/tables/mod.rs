//! What kernels see of a compiled scene and of a view: tables, which no stage changes.

pub(crate) mod bodies;
pub(crate) mod bright_places;
pub(crate) mod expressions;
pub(crate) mod fields;
pub(crate) mod guiding;
pub(crate) mod light_groups;
pub(crate) mod links;
pub(crate) mod material;
pub(crate) mod matte_names;
pub(crate) mod media;
pub(crate) mod motion_vectors;
pub(crate) mod openings;
pub(crate) mod photons;
pub(crate) mod ray_table;
pub(crate) mod shader_passes;
pub(crate) mod shutter;
pub(crate) mod transport;

use crate::geometry::GeometryTable;
use crate::tables::bodies::Bodies;
use crate::tables::light_groups::LightGroups;
use crate::tables::links::Links;
use gonio_accel::Tlas;
use gonio_image::texture::TextureTable;
use gonio_light::LightTable;
use gonio_simd::WavelengthTable;
use material::MaterialTable;
use matte_names::MatteNames;
use motion_vectors::NeighbourFrames;
use std::sync::Arc;

/// The tables of a compiled scene.
#[derive(Debug)]
pub struct Tables {
    /// TLAS over the BLASes of all meshes; instances of light shapes follow those of meshes.
    pub bvh: Tlas,
    /// Meshes and instances.
    pub geometry: GeometryTable,
    /// Where meshes and instances were at the frame before and will be at the next, for the pass of motion vectors.
    pub neighbours: Option<NeighbourFrames>,
    /// Materials.
    pub materials: MaterialTable,
    /// Images.
    pub textures: TextureTable,
    /// Lights.
    pub lights: Arc<LightTable>,
    /// First instance that is a light's shape.
    pub first_light_instance: u32,
    /// Light of each such instance.
    pub instance_light: Vec<u32>,
    /// First light of each mesh instance whose triangles are lights, or [`crate::geometry::NONE`]; empty if there is none.
    pub triangle_lights: Vec<u32>,
    /// The first light that is a triangle, and the instance of each such light.
    pub light_instances: (u32, Vec<u32>),
    /// 1 for lights on objects, which are absent for paths among shadow catchers alone; empty if there is none.
    pub object_lights: Vec<u32>,
    /// Lights by group.
    pub groups: LightGroups,
    /// Which lights light which instances, and which cast their shadows.
    pub links: Links,
    /// What placements are called in cryptomattes.
    pub matte_names: MatteNames,
    /// Whether any material lets straight light pass.
    pub any_transparent: bool,
    /// Whether any material absorbs light inside.
    pub any_absorbing: bool,
    /// Placed meshes that absorb or refract.
    pub bodies: Bodies,
    /// By mesh instance, 1 over the squared index of what its surfaces shine into; empty where none shines into glass or the like.
    pub emission_in_media: Vec<f32>,
    /// What the wavelengths of paths mean, where light has any; else it is computed as colour.
    pub wavelengths: Option<Arc<WavelengthTable>>,
    /// World position of the rebased origin, metres.
    pub origin: [f64; 3],
}

impl Tables {
    /// Says what the wavelengths of paths mean from now on, where light has any; the media are told.
    pub fn set_wavelengths(&mut self, table: Option<Arc<WavelengthTable>>) {
        if let Some(table) = &table {
            self.materials.media.set_wavelengths(table);
        }
        self.wavelengths = table;
    }
}
