//! The part of a material's graph that displaces.

use super::program::compile_graph;
use crate::{
    compile::textures::CompiledTextures,
    error::Result,
    graph::{Program, Wanted, WantedOutput},
    scene::{Displacement, DisplacementKind, Graph, Input, Material, Node, NodeId},
};

/// Whether a material displaces anything.
pub(in crate::compile) fn displaces(material: &Material) -> bool {
    material.displacement.is_some_and(|displacement| !displacement.is_nothing())
}

/// A displacement with the nodes that it reads alone.
pub(in crate::compile) fn pruned(material: &Material, displacement: &Displacement) -> (Graph, Displacement) {
    let nodes = &material.graph.nodes;
    let mut read = vec![false; nodes.len()];
    let mark = |input: &Input, read: &mut Vec<bool>| {
        if let Input::Node(id, _) = input
            && let Some(read) = read.get_mut(usize::from(id.0))
        {
            *read = true;
        }
    };
    mark(&displacement.value, &mut read);
    for number in (0..nodes.len()).rev().filter(|number| *number < nodes.len()) {
        if read[number] {
            nodes[number].inputs.iter().for_each(|input| mark(input, &mut read));
        }
    }
    let mut graph = Graph::default();
    let mut order = vec![NodeId(0); nodes.len()];
    let renumbered = |input: &Input, order: &[NodeId]| match input {
        Input::Node(id, channel) => Input::Node(order[usize::from(id.0)], *channel),
        constant @ Input::Constant(_) => *constant,
    };
    for (number, node) in nodes.iter().enumerate().filter(|(number, _)| read[*number]) {
        let Node { operation, inputs } = node;
        order[number] = graph.add(operation.clone(), inputs.iter().map(|input| renumbered(input, &order)).collect());
    }
    (graph, Displacement { value: renumbered(&displacement.value, &order), ..*displacement })
}

/// What computes a displacement: its height, or its three components.
pub(in crate::compile) fn program(
    material: &Material,
    displacement: &Displacement,
    textures: &CompiledTextures,
    names: &[String],
) -> Result<Program> {
    let graph = compile_graph(material, textures, names)?;
    let width = if displacement.kind == DisplacementKind::Height { 1 } else { 3 };
    let output = WantedOutput { offset: 0, width, value: graph.code.value(displacement.value), range: None };
    Ok(Program::new(&graph.code, &Wanted { outputs: vec![output], uv: graph.uv, ..Wanted::default() }))
}
