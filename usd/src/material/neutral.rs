//! A shading network as plain data: nodes with their inputs, wherever they were read. It knows neither `pxr` nor files.

use crate::vt::AssetPath;
use std::rc::Rc;

/// What an input is set to.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Value {
    /// Numbers, flags and vectors: up to four components and their count; the fourth of fewer is 1.
    Numbers([f32; 4], usize),
    /// Rows of a square matrix, filled up with those of the unit matrix, and their count.
    Matrix(Box<[[f32; 4]; 4]>, usize),
    /// Tokens and strings.
    Text(String),
    /// Files.
    Asset(AssetPath),
}

impl Value {
    /// Text, also of assets.
    pub(crate) fn text(&self) -> Option<&str> {
        match self {
            Self::Text(text) | Self::Asset(AssetPath { authored: text, .. }) => Some(text),
            Self::Numbers(..) | Self::Matrix(..) => None,
        }
    }
}

/// The colour space of numbers that are used as they stand.
pub(in crate::material) const RAW: &str = "raw";

/// What is said about a value beside it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(in crate::material) struct Said {
    /// Whether it is a colour by its type.
    pub(in crate::material) is_colour: bool,
    /// The colour space; empty if none is said.
    pub(in crate::material) space: String,
    /// The unit of a length or an angle; empty if none is said.
    pub(in crate::material) unit: String,
    /// Where the file lies that text would name; empty if there is none.
    pub(in crate::material) resolved: String,
}

/// A node's place in its document.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(in crate::material) struct NodeIndex(pub(in crate::material) usize);

/// Where an input's value comes from.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::material) enum Source {
    /// Nothing is said.
    Nothing,
    /// A value, and what is said about it.
    Value(Value, Said),
    /// A node's output.
    Output(NodeIndex, String),
    /// A property of the place on the surface, by MaterialX's name: `UV0`, `Nworld`.
    Geometric(String),
    /// The input could not be read, for this reason.
    Unreadable(String),
}

/// An input by name.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::material) struct Port {
    pub(in crate::material) name: String,
    pub(in crate::material) source: Source,
}

/// A node.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::material) struct Node {
    /// Where it is, for messages: a prim's path.
    pub(in crate::material) path: Rc<str>,
    /// The name of its definition: `UsdPreviewSurface`, `ND_image_color3`.
    pub(in crate::material) id: Rc<str>,
    /// What its inputs are set to.
    pub(in crate::material) inputs: Vec<Port>,
    /// The node that it helps to define, if it does.
    pub(in crate::material) outer: Option<NodeIndex>,
}

impl Node {
    /// The source of an input.
    pub(in crate::material) fn source(&self, name: &str) -> Source {
        self.inputs.iter().find(|port| port.name == name).map_or(Source::Nothing, |port| port.source.clone())
    }
}

/// Nodes that read one another.
#[derive(Clone, Debug, Default)]
pub(in crate::material) struct Document {
    /// The nodes, in no order.
    pub(in crate::material) nodes: Vec<Node>,
    /// What is wrong with it, and the paths where.
    pub(in crate::material) problems: Vec<(String, String)>,
}

impl Document {
    /// Appends a node without inputs.
    pub(in crate::material) fn add(&mut self, path: &str, id: &str) -> NodeIndex {
        self.nodes.push(Node { path: path.into(), id: id.into(), inputs: Vec::new(), outer: None });
        NodeIndex(self.nodes.len() - 1)
    }

    /// The node at an index.
    pub(in crate::material) fn node(&self, NodeIndex(index): NodeIndex) -> &Node {
        &self.nodes[index]
    }
}
