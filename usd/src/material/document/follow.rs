//! What a document's inputs are set to, followed through its graphs.

use super::text::{Writer, identifier};
use crate::material::xml::Element;

/// A node and the graph that it stands in; `None` for the document's own nodes.
#[derive(Clone, Copy)]
pub(super) struct Place<'d> {
    pub(super) node: &'d Element,
    pub(super) graph: Option<&'d Element>,
}

impl Place<'_> {
    /// The name of the shader prim, unique in a material.
    pub(super) fn prim_name(&self) -> String {
        let own = self.node.attribute("name").unwrap_or("node");
        identifier(&self.graph.and_then(|graph| graph.attribute("name")).map_or(own.to_owned(), |graph| format!("{graph}__{own}")))
    }
}

/// What an input is set to.
pub(super) enum Setting<'d> {
    Value(&'d Element),
    Node(Place<'d>, Option<&'d str>),
    Nothing,
}

impl<'d> Writer<'d> {
    /// Follows an input of a node in `graph` to a value or a node.
    pub(super) fn setting(&self, input: &'d Element, graph: Option<&'d Element>) -> Setting<'d> {
        let scope = graph.unwrap_or(self.document);
        if let Some(name) = input.attribute("interfacename") {
            return match graph.and_then(|graph| graph.child_called(name)) {
                // The graph's own input belongs to the document.
                Some(interface) => self.setting(interface, None),
                None => Setting::Nothing,
            };
        }
        if let Some(name) = input.attribute("nodegraph") {
            let Some(graph) = self.document.child_called(name) else { return Setting::Nothing };
            return self.graph_output(graph, input.attribute("output"));
        }
        if let Some(name) = input.attribute("nodename") {
            return match scope.child_called(name) {
                Some(graph) if graph.name == "nodegraph" => self.graph_output(graph, input.attribute("output")),
                Some(node) => Setting::Node(Place { node, graph }, input.attribute("output")),
                None => Setting::Nothing,
            };
        }
        if input.attribute("value").is_some() { Setting::Value(input) } else { Setting::Nothing }
    }

    fn graph_output(&self, graph: &'d Element, name: Option<&str>) -> Setting<'d> {
        let mut outputs = graph.children.iter().filter(|child| child.name == "output");
        let output = match name {
            Some(name) => outputs.find(|output| output.attribute("name") == Some(name)),
            None => outputs.next(),
        };
        let node = output.and_then(|output| Some((graph.child_called(output.attribute("nodename")?)?, output.attribute("output"))));
        node.map_or(Setting::Nothing, |(node, output)| Setting::Node(Place { node, graph: Some(graph) }, output))
    }
}
