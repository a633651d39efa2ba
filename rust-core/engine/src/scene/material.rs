//! Materials: a surface model with parameters that are constants or outputs of a node graph.

use super::{Origin, TextureFilter, TextureId, WrapMode};
use serde::{Deserialize, Serialize};

/// The model whose rules a material's parameters follow; parameter names are those of the surface's parameter block for all of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Model {
    /// OpenPBR 1.1, gonio's own.
    #[default]
    OpenPbr,
    /// Blender's Principled BSDF.
    Principled,
    /// UsdPreviewSurface.
    PreviewSurface,
    /// Autodesk standard_surface.
    StandardSurface,
    /// glTF's metallic-roughness model.
    Gltf,
}

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

/// What a value means to arithmetic nodes; kept for messages and front ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum OutputKind {
    /// One number.
    Scalar,
    /// A colour.
    Colour,
    /// A vector.
    Vector,
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
    /// A shading normal in world space from the tangent-space normal `inputs[0]` in [-1, 1], scaled in x and y by `scale`.
    NormalMap {
        /// Strength of the bend.
        scale: f32,
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
    /// `inputs[0]` to the power `inputs[1]`, zero for negative bases.
    Power,
    /// `inputs[1] - inputs[0]`, MaterialX's invert with its amount.
    Invert,
    /// `inputs[0]` held between `inputs[1]` and `inputs[2]`.
    Clamp,
    /// Components of `inputs[0..4]`, the first of each.
    Combine,
    /// The luminance of `inputs[0]` in all components.
    Luminance,
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

/// A surface.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Material {
    /// Where it came from.
    pub origin: Origin,
    /// The model whose rules the parameters follow.
    pub model: Model,
    /// Parameters that differ from the model's defaults, by the parameter block's names.
    pub parameters: Vec<(String, Input)>,
    /// The nodes that parameters refer to.
    pub graph: Graph,
    /// A shading normal in world space, from a [`Operation::NormalMap`] node.
    pub normal: Option<NodeId>,
    /// Opacity below this counts as 0, else as 1; 0 means opacity is as it is.
    pub opacity_threshold: f32,
    /// The surface is a sheet: light that passes is not bent.
    pub thin_walled: bool,
}

impl Material {
    /// A grey Lambertian surface of the given reflectance.
    pub fn diffuse(origin: Origin, reflectance: [f32; 3]) -> Self {
        let [r, g, b] = reflectance;
        Self {
            origin,
            parameters: vec![("base_color".into(), Input::Constant([r, g, b, 1.0])), ("specular_weight".into(), Input::Constant([0.0; 4]))],
            ..Self::default()
        }
    }
    /// Sets a scalar parameter.
    pub fn set(&mut self, name: &str, value: f32) {
        self.set_input(name, Input::Constant([value; 4]));
    }
    /// Sets a colour parameter.
    pub fn set_colour(&mut self, name: &str, [r, g, b]: [f32; 3]) {
        self.set_input(name, Input::Constant([r, g, b, 1.0]));
    }
    /// Sets a parameter, replacing an earlier value.
    pub fn set_input(&mut self, name: &str, input: Input) {
        match self.parameters.iter_mut().find(|(known, _)| known == name) {
            Some((_, value)) => *value = input,
            None => self.parameters.push((name.to_owned(), input)),
        }
    }
    /// The value set for a parameter.
    pub fn input(&self, name: &str) -> Option<Input> {
        self.parameters.iter().find(|(known, _)| known == name).map(|(_, input)| *input)
    }
}
