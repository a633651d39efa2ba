//! The scene description: what is to be rendered, as plain data.
//!
//! Front ends fill a [`Scene`]; nothing here knows how it is computed. Lengths are metres, transforms f64, colours linear Rec.709,
//! radiances scaled so that their luminance is in cd/m².

mod antialiasing;
mod aov;
mod atomic;
mod blob;
mod bundle;
mod camera;
mod cryptomatte;
mod curves;
mod dark;
mod dicing;
mod digest;
mod displacement;
pub mod error;
mod eyes;
mod field;
mod flow;
mod glass_index;
mod goniogram;
mod instance;
mod lamp_spectrum;
mod light;
mod light_filter;
mod light_path;
mod light_quantity;
mod linking;
mod material;
mod measured;
mod medium;
mod mesh;
mod metal_index;
mod meter;
mod origin;
mod points;
mod regular;
mod settings;
mod shutter;
mod temporary;
mod texture;
mod transform;

pub use antialiasing::Antialiasing;
pub use aov::{
    AMBIENT_OCCLUSION, Aov, EYE_NORMAL, EYE_POSITION, LIGHT_GROUP, LightPart, OTHER_LIGHTS, PRIMVARS, ScatteringKind, ShaderValue,
};
pub use atomic::{Output, check_writable, is_ordinary, write_atomically, write_beside};
pub use bundle::digest_scene;
pub use bundle::{load_bundle, of_bundle, save_bundle, to_bundle, with_images};
pub use camera::{Camera, CameraExposure, Projection};
pub use cryptomatte::{MATTE_RANKS, MOST_MATTE_RANKS, Manifests, MatteKind, MatteName, matte_id, matte_key};
pub use curves::{CurveBasis, CurveShape, CurveWrap, Curves};
pub use dicing::Dicing;
pub use digest::{Digest, Digesting};
pub use displacement::{Displacement, DisplacementKind};
pub use error::{Diagnostic, Error, Result, Severity};
pub use eyes::{Eyes, SITTING, STANDING};
pub use field::{COLOURS, Field, Lattice};
pub use flow::Flow;
pub use glass_index::GlassIndex;
pub use gonio_formats::photometry::{Opening, OpeningShape, PhotometricType};
pub use gonio_nodes::{
    Channel, Graph, Input, LightPathValue, Node, NodeId, Operation, Quantity, Space, TextureFilter, TextureId, WrapMode,
};
pub use gonio_spectrum::ColourSpectra;
pub use gonio_volume::{BRICK_EDGE, BRICK_VOXELS};
pub use goniogram::Goniogram;
pub use instance::{Geometry, Instances, Visibility};
pub use lamp_spectrum::{LampSpectrum, lumens_per_watt};
pub use light::{DomeFormat, Emission, Falloff, Light, LightShape, Shaping, Spot};
pub use light_filter::{LightFilter, Slide};
pub use light_path::{LightPath, LightSource, MOST_EXPRESSIONS, MOST_STATES, PathAutomaton, SCATTERINGS, STEPS, light_path};
pub use light_quantity::{LUMENS_PER_WATT, LightQuantity};
pub use linking::{Link, Linking};
pub use material::{Closure, Distribution, FibreDirection, Material, Model, ShaderOutput, SubsurfaceMethod};
pub use measured::MeasuredBsdf;
pub use medium::{HAZE_ANISOTROPY, Medium, Phase, VISIBILITY_CONTRAST};
pub use mesh::{Mesh, MeshKey, Primvar, PrimvarInterpolation};
pub use metal_index::MetalIndex;
pub use meter::{Grid, GridArea, Measurand, Meter};
pub use origin::{Origin, is_below};
pub use points::{PointKey, PointShape, Points, point_key_problem};
pub use regular::{open_file, read_file};
pub use settings::{Background, Caustics, Crop, Filter, Guiding, Integrator, MOST_LIGHT_SAMPLES, Mist, Observer, Settings, parse_bytes};
pub use shutter::{Shutter, key_problem};
pub use texture::{Texture, TextureSource, Tile};
pub use transform::Transform;

use serde::{Deserialize, Serialize};

macro_rules! id {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
        pub struct $name(pub u32);
        impl $name {
            /// The place in the scene's list.
            #[inline]
            pub fn index(self) -> usize {
                self.0 as usize
            }
        }
    };
}
id!(
    /// A mesh of the scene.
    MeshId
);
id!(
    /// Curves of the scene.
    CurvesId
);
id!(
    /// Points of the scene.
    PointsId
);
id!(
    /// A material of the scene.
    MaterialId
);
id!(
    /// A measured BSDF of the scene.
    MeasuredId
);
id!(
    /// A field of the scene.
    FieldId
);

/// Everything that is rendered.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Scene {
    /// Triangle meshes, shared by instances.
    pub meshes: Vec<Mesh>,
    /// Curves, shared by instances.
    #[serde(default)]
    pub curves: Vec<Curves>,
    /// Points, shared by instances.
    #[serde(default)]
    pub points: Vec<Points>,
    /// Placed meshes, curves and points.
    pub instances: Vec<Instances>,
    /// Materials.
    pub materials: Vec<Material>,
    /// Images.
    pub textures: Vec<Texture>,
    /// Measured BSDFs, shared by closures.
    #[serde(default)]
    pub measured: Vec<MeasuredBsdf>,
    /// What varies within media.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub fields: Vec<Field>,
    /// Light sources other than emissive materials.
    pub lights: Vec<Light>,
    /// Cameras; [`Settings::camera`] chooses one.
    pub cameras: Vec<Camera>,
    /// Points at which light is measured.
    #[serde(default)]
    pub meters: Vec<Meter>,
    /// Calculation grids.
    #[serde(default)]
    pub grids: Vec<Grid>,
    /// What fills all of space: haze, fog, water.
    #[serde(default, skip_serializing_if = "Medium::is_clear")]
    pub atmosphere: Medium,
    /// How it is rendered.
    pub settings: Settings,
}

impl Scene {
    /// Names of the light groups, that of all lights that are in none the last one.
    pub fn light_groups(&self) -> Vec<String> {
        let named = self.lights.iter().map(|light| &light.group).chain(self.instances.iter().map(|set| &set.light_group));
        let mut names: Vec<String> = Vec::new();
        for name in named.filter(|name| !name.is_empty() && *name != OTHER_LIGHTS) {
            if !names.contains(name) {
                names.push(name.clone());
            }
        }
        names.push(OTHER_LIGHTS.to_owned());
        names
    }

    /// Makes each light a group by the last part of its name, unless some light or surface names a group.
    pub fn group_by_lamp(&mut self) {
        if self.light_groups().len() == 1 {
            self.lights.iter_mut().for_each(|light| light.group = light.origin.name.rsplit('/').next().unwrap_or_default().to_owned());
        }
    }

    /// Adds a mesh.
    pub fn add_mesh(&mut self, mesh: Mesh) -> MeshId {
        self.meshes.push(mesh);
        MeshId(id_of(self.meshes.len()))
    }
    /// Adds curves.
    pub fn add_curves(&mut self, curves: Curves) -> CurvesId {
        self.curves.push(curves);
        CurvesId(id_of(self.curves.len()))
    }
    /// Adds points.
    pub fn add_points(&mut self, points: Points) -> PointsId {
        self.points.push(points);
        PointsId(id_of(self.points.len()))
    }
    /// Adds a material.
    pub fn add_material(&mut self, material: Material) -> MaterialId {
        self.materials.push(material);
        MaterialId(id_of(self.materials.len()))
    }
    /// Adds a texture.
    pub fn add_texture(&mut self, texture: Texture) -> TextureId {
        self.textures.push(texture);
        TextureId(id_of(self.textures.len()))
    }
    /// Adds a measured BSDF.
    pub fn add_measured(&mut self, measured: MeasuredBsdf) -> MeasuredId {
        self.measured.push(measured);
        MeasuredId(id_of(self.measured.len()))
    }
    /// Adds a field.
    pub fn add_field(&mut self, field: Field) -> FieldId {
        self.fields.push(field);
        FieldId(id_of(self.fields.len()))
    }
    /// Adds a field, its box and what fills that: a volume.
    pub fn add_volume(&mut self, field: Field, medium: Medium) -> &mut Instances {
        let (mesh, to_world) = (field.mesh(), field.to_world);
        let medium = Medium { field: Some(self.add_field(field)), ..medium };
        self.add_filled(mesh, medium, to_world)
    }
    /// Adds a closed mesh with nothing at its surface and a medium behind it.
    pub fn add_filled(&mut self, mesh: Mesh, medium: Medium, to_world: Transform) -> &mut Instances {
        let origin = mesh.origin.clone();
        let mesh = self.add_mesh(mesh);
        let material = self.add_material(Material::volume(origin.clone(), medium));
        self.instances.push(Instances::new(origin, mesh, vec![material], vec![to_world]));
        self.instances.last_mut().expect("it was added")
    }
}

fn id_of(len: usize) -> u32 {
    u32::try_from(len - 1).expect("a scene has fewer than 2^32 elements of a kind")
}
