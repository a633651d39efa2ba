//! Graphs of nodes that compute materials' parameters.

use super::{TextureFilter, TextureId, WrapMode};
use serde::{Deserialize, Serialize};

/// A node's place in its graph.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct NodeId(pub u16);

/// Which part of a node's four-component output is taken.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Channel {
    /// The first three as a colour or vector.
    #[default]
    Rgb,
    /// First.
    R,
    /// Second.
    G,
    /// Third.
    B,
    /// Fourth.
    A,
}

/// A parameter: a constant, or a node's output.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Input {
    /// One value; a scalar parameter reads the first component, a scalar constant fills all four.
    Constant([f32; 4]),
    /// The output of a node.
    Node(NodeId, Channel),
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

/// What a node computes, in MaterialX's vocabulary; all values have four components.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Operation {
    /// An image lookup at `inputs[0]` (uv); gives `fallback` where the texture could not be had. Output = texel · scale + bias.
    Image {
        /// The image.
        texture: TextureId,
        /// What lies beyond it in u and v.
        wrap: [WrapMode; 2],
        /// How texels are filtered.
        filter: TextureFilter,
        /// Multiplies the texel.
        scale: [f32; 4],
        /// Added afterwards.
        bias: [f32; 4],
        /// Taken without a texture.
        fallback: [f32; 4],
    },
    /// The named primvar at the hit, or `fallback` where the mesh has none.
    Primvar {
        /// The name without prefix.
        name: String,
        /// Taken where there is none.
        fallback: [f32; 4],
    },
    /// `inputs[0]` scaled, then rotated by degrees counter-clockwise, then moved (UsdTransform2d's order).
    Transform2d {
        /// Factors.
        scale: [f32; 2],
        /// Degrees, counter-clockwise.
        rotation_deg: f32,
        /// Offset.
        translation: [f32; 2],
    },
    /// `inputs[0]` as a point to which the rows are applied; the fourth component stays.
    Transform3d {
        /// Three rows of a 3×4 matrix.
        rows: [[f32; 4]; 3],
    },
    /// `inputs[0]` carried from one space to another; zero where the object is flat and its inverse would be needed.
    Transform {
        /// The space it is given in.
        from: Space,
        /// The space of the result.
        to: Space,
        /// What it stands for.
        quantity: Quantity,
    },
    /// A shading normal in world space, on the side the surface is seen from, from the tangent-space normal `inputs[0]` in [-1, 1], scaled
    /// in x and y by `scale`.
    NormalMap {
        /// Strength of the bend.
        scale: f32,
        /// The primvar whose coordinates it lies along, mirrored parts turning the bitangent round, or those of the surface's first image.
        #[serde(default)]
        uv: Option<String>,
    },
    /// The hit's position in the world, metres.
    Position,
    /// The unit shading normal on the side the surface is seen from, world space, before the material bends it.
    Normal,
    /// The triangle's unit normal on the side it is seen from, world space.
    GeometricNormal,
    /// The unit direction to where the ray came from, world space.
    Incoming,
    /// 1 where the front is seen, 0 where the back is.
    FrontFacing,
    /// What is known of the ray; for shadow rays its depths are zero.
    LightPath(LightPathValue),
    /// The world-space vector in the surface to the next pixel along one of two directions that span it.
    PositionStep {
        /// 0 or 1: which of the two.
        axis: u8,
    },
    /// How much the named primvar changes over that step.
    PrimvarStep {
        /// The name without prefix.
        name: String,
        /// 0 or 1: which of the two directions.
        axis: u8,
    },
    /// The unit tangent along the first of the coordinates of the named primvar, world space; zero where the mesh has none.
    UvTangent {
        /// The primvar.
        uv: String,
    },
    /// Each component of `inputs[0]` looked up in its own column of the table, whose rows are evenly spread over the range.
    Curve {
        /// Rows of four components, at most 65,536.
        table: Vec<[f32; 4]>,
        /// What the first and the last row stand for.
        range: [f32; 2],
        /// Whether values between rows are interpolated; else the row below counts.
        linear: bool,
        /// Whether the first and last two rows are prolonged beyond the range; else the outer rows are held.
        extrapolate: bool,
    },
    /// `inputs[0] + inputs[1]`.
    Add,
    /// `inputs[0] - inputs[1]`.
    Subtract,
    /// `inputs[0] · inputs[1]`.
    Multiply,
    /// `inputs[0] / inputs[1]`, zero where the divisor is zero.
    Divide,
    /// `inputs[0]` where `inputs[2]` is 0, `inputs[1]` where it is 1 (MaterialX's bg, fg, mix).
    Mix,
    /// `inputs[0]` to the power `inputs[1]`, zero for negative bases; zero to the power zero is one, to any other zero.
    Power,
    /// `inputs[1] - inputs[0]`, MaterialX's invert with its amount.
    Invert,
    /// `inputs[0]` held between `inputs[1]` and `inputs[2]`.
    Clamp,
    /// Components of `inputs[0..4]`, the first of each.
    Combine,
    /// The lesser of `inputs[0]` and `inputs[1]`.
    Minimum,
    /// The greater of `inputs[0]` and `inputs[1]`.
    Maximum,
    /// The magnitude of `inputs[0]`.
    Absolute,
    /// −1, 0 or 1, as `inputs[0]` is negative, zero or positive.
    Sign,
    /// The largest integer not above `inputs[0]`.
    Floor,
    /// The square root of `inputs[0]`, zero below zero.
    SquareRoot,
    /// e to the power `inputs[0]`, which is held to 88.
    Exponential,
    /// The natural logarithm of `inputs[0]`, zero where that is not positive.
    Logarithm,
    /// The sine of `inputs[0]`, radians.
    Sine,
    /// The cosine of `inputs[0]`, radians.
    Cosine,
    /// The angle in radians whose sine is `inputs[0]`, held to [-1, 1].
    ArcSine,
    /// The angle in radians whose cosine is `inputs[0]`, held to [-1, 1].
    ArcCosine,
    /// The angle in radians of the point whose ordinate is `inputs[0]` and whose abscissa is `inputs[1]`.
    ArcTangent2,
    /// 1 where `inputs[0]` is less than `inputs[1]`, else 0.
    Less,
    /// The unpolarised reflectance of a smooth dielectric at the cosine `inputs[0]`, either sign; `inputs[1]` is the index of refraction on
    /// the far side over that on the near side.
    Fresnel,
    /// The luminance of `inputs[0]` in all components.
    Luminance,
    /// The inner product of the first three components of `inputs[0]` and `inputs[1]` in all components.
    Dot,
    /// The cross product of `inputs[0]` and `inputs[1]`.
    Cross,
    /// `inputs[0]` made unit; zero stays zero.
    Normalize,
    /// Hue in turns, saturation and value of the colour `inputs[0]`; the fourth component stays.
    RgbToHsv,
    /// The colour of the hue in turns, saturation and value in `inputs[0]`; the fourth component stays.
    HsvToRgb,
}

/// A node: an operation and where its inputs come from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Node {
    /// What it computes.
    pub operation: Operation,
    /// Its inputs, each a constant or an earlier node.
    pub inputs: Vec<Input>,
}

/// Nodes in an order in which each comes after those it reads.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Graph {
    /// The nodes.
    pub nodes: Vec<Node>,
}

impl Graph {
    /// Appends a node; its inputs must be there already.
    pub fn add(&mut self, operation: Operation, inputs: Vec<Input>) -> NodeId {
        self.nodes.push(Node { operation, inputs });
        NodeId(u16::try_from(self.nodes.len() - 1).expect("a graph has fewer than 65,536 nodes"))
    }
}
