//! Words of graphs: spaces, quantities, values of rays, and how images are looked up.

use serde::{Deserialize, Serialize};

/// A texture of the scene, by its number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct TextureId(pub u32);

impl TextureId {
    /// Its place among the scene's textures.
    #[inline]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// What lies beyond the image.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum WrapMode {
    /// The image again.
    Repeat,
    /// The border's colour.
    Clamp,
    /// The image mirrored.
    Mirror,
    /// Zero, alpha too.
    Black,
}

/// How texels are filtered.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum TextureFilter {
    /// Trilinear between mip levels.
    Linear,
    /// The nearest texel of the finest level.
    Closest,
    /// As `Linear`, each level by cubic B-splines, which smooth the image.
    Cubic,
    /// As `Linear`, but sRGB's bytes of the finest level are mixed as they are encoded, as in Cycles.
    LinearCodes,
    /// As `Cubic`, with bytes mixed as for `LinearCodes`.
    CubicCodes,
}

/// A space that values are given in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Space {
    /// The world.
    World,
    /// The space of the points of the mesh that was hit.
    Object,
}

/// What a vector stands for when it changes spaces.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Quantity {
    /// A point.
    Point,
    /// A difference of points.
    Vector,
    /// A normal: stays perpendicular to the surface, and is made unit.
    Normal,
}

/// What is known of the ray that shades a hit (Blender's Light Path node).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum LightPathValue {
    /// 1 for rays of the camera, straight ways through included; else 0.
    IsCameraRay,
    /// 1 for shadow rays.
    IsShadowRay,
    /// 1 after diffuse scattering.
    IsDiffuseRay,
    /// 1 after glossy or specular scattering, reflected or transmitted.
    IsGlossyRay,
    /// 1 after a mirror or smooth glass.
    IsSingularRay,
    /// 1 after reflection; diffuse scattering counts as reflection.
    IsReflectionRay,
    /// 1 after refraction.
    IsTransmissionRay,
    /// The ray was scattered by a medium.
    IsVolumeScatterRay,
    /// Metres from the ray's start.
    RayLength,
    /// Scatterings so far.
    RayDepth,
    /// Diffuse ones among them.
    DiffuseDepth,
    /// Glossy reflections among them.
    GlossyDepth,
    /// Refractions among them.
    TransmissionDepth,
    /// Surfaces that the path went straight through.
    TransparentDepth,
}
