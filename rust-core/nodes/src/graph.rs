//! Graphs of nodes, as scene descriptions hold them.

use crate::Operation;
use serde::{Deserialize, Serialize};

/// A node's place in its graph.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct NodeId(pub u16);

/// Which part of a node's four-component output is taken.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
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
