//! A material's shading network on its way to a node graph: inputs are followed to constants or shader outputs, each output is built once.

use super::definition::{self, Outputs};
use super::emit::component;
use super::host::Host;
use super::materialx::{self, Rule};
use super::neutral::{Document, NodeIndex, Source};
use super::{arnold_nodes, usd_nodes};
use gonio::scene::{Channel, Graph, Input, Operation};
use std::collections::HashMap;
use std::rc::Rc;

/// Longest chain of shaders; longer ones are taken for cycles.
const MAX_DEPTH: usize = 200;
/// Most closures of a surface, those in mixes and layers counted.
const MAX_CLOSURES: usize = 1000;
/// The output that is read where a document names none.
const UNSTATED_OUTPUT: &str = "out";
/// Nodes in a graph beyond which shaders are not converted.
const MAX_NODES: usize = 60_000;

/// A node of the document on its way into the graph.
#[derive(Clone, Debug)]
pub(in crate::material) struct Shader {
    /// Its place in the document.
    pub(in crate::material) index: NodeIndex,
    /// Its prim's path.
    pub(in crate::material) path: Rc<str>,
    /// The name of the node that it is: `UsdPreviewSurface`, `ND_image_color3`.
    pub(in crate::material) id: Rc<str>,
}

/// What was built: an output of a node, at the place itself or a step beside it.
type BuiltKey = (NodeIndex, String, Option<u8>);

/// A network that is being converted.
pub(in crate::material) struct Network<'h> {
    /// The scene's reader.
    pub(in crate::material) host: &'h mut dyn Host,
    /// What is converted.
    pub(in crate::material) document: Document,
    /// The nodes so far.
    pub(in crate::material) graph: Graph,
    built: HashMap<BuiltKey, Option<Input>>,
    /// Outputs of the graphs that were put in nodes' places.
    expanded: HashMap<NodeIndex, Option<Outputs>>,
    /// The direction in which the place that is built for lies beside the hit.
    step: Option<u8>,
    depth: usize,
    /// Closures met.
    closures: usize,
    /// Nodes that could not be built.
    failures: usize,
}

impl<'h> Network<'h> {
    /// A network without graph nodes.
    pub(in crate::material) fn new(host: &'h mut dyn Host, mut document: Document) -> Self {
        document.problems.drain(..).for_each(|(path, problem)| host.warn(&path, problem));
        Self {
            host,
            document,
            graph: Graph::default(),
            built: HashMap::new(),
            expanded: HashMap::new(),
            step: None,
            depth: 0,
            closures: 0,
            failures: 0,
        }
    }

    /// A warning about a shader.
    pub(in crate::material) fn warn(&mut self, shader: &Shader, message: impl Into<String>) {
        self.host.warn(&shader.path, message.into());
    }

    /// Says once for each feature that it is not supported.
    pub(in crate::material) fn unsupported(&mut self, feature: &str, shader: &Shader) {
        self.host.unsupported(feature, &shader.path);
    }

    /// The node at an index.
    pub(in crate::material) fn shader(&self, index: NodeIndex) -> Shader {
        let node = self.document.node(index);
        Shader { index, path: node.path.clone(), id: node.id.clone() }
    }

    /// The direction of the step beside the hit for which nodes are built, if they are.
    pub(in crate::material) fn step(&self) -> Option<u8> {
        self.step
    }

    /// Builds something for the place one pixel beside the hit in one of two directions.
    pub(in crate::material) fn beside<R>(&mut self, axis: u8, run: impl FnOnce(&mut Self) -> R) -> R {
        let outer = self.step.replace(axis);
        let result = run(self);
        self.step = outer;
        result
    }

    /// What a node's output gives; `None`, with a warning, where the node is not supported.
    pub(in crate::material) fn output(&mut self, node: NodeIndex, output: &str) -> Option<Input> {
        let shader = self.shader(node);
        if !self.has_output(&shader, output) {
            let message = format!("'{}' has no output '{output}', which something reads; its value is used as a whole", shader.id);
            self.host.once("output", &format!("{} {output}", shader.path), &shader.path, message);
        }
        // Most nodes have one value, whose parts outputs are.
        let is_materialx = shader.id.strip_prefix("ND_").is_some_and(|node| !usd_nodes::is_usd_node(node)) || self.is_defined(&shader);
        let is_each = is_materialx && materialx::row(&shader.id).is_none_or(|row| matches!(row.rule, Rule::Each(_) | Rule::Later));
        let key = (node, if is_each { output.to_owned() } else { String::new() }, self.step);
        let whole = match self.built.get(&key) {
            Some(built) => *built,
            None => {
                let built = self.build(&shader, output);
                self.built.insert(key, built);
                built
            }
        }?;
        let index = usd_nodes::output_component(&shader.id, output).or_else(|| materialx::output_component(&shader.id, output));
        let index = index.or_else(|| arnold_nodes::output_component(&shader.id, output));
        Some(index.map_or(whole, |index| component(whole, index)))
    }

    /// Whether a node has an output of that name, as far as its definition is known.
    fn has_output(&mut self, shader: &Shader, output: &str) -> bool {
        if let Some(known) = usd_nodes::has_output(&shader.id, output) {
            return known;
        }
        let definition = if shader.id.starts_with("arnold:") { None } else { self.host.definition(&shader.id) };
        // Where a document names no output, it means the only one, which may have any name.
        let is_stated = output != UNSTATED_OUTPUT;
        definition.is_none_or(|definition| {
            (!is_stated && definition.outputs.len() == 1) || definition.outputs.iter().any(|(name, _)| name == output)
        })
    }

    fn build(&mut self, shader: &Shader, output: &str) -> Option<Input> {
        if self.depth >= MAX_DEPTH || self.graph.nodes.len() >= MAX_NODES {
            let message = "the shading network is too deep or goes round in a circle; the input's default is used".to_owned();
            self.host.once("depth", "network", &shader.path, message);
            return None;
        }
        self.depth += 1;
        let built = match shader.id.strip_prefix("ND_") {
            Some(node) if !usd_nodes::is_usd_node(node) => self.build_materialx(shader, output),
            Some(node) => usd_nodes::build(self, shader, node, true),
            None => match shader.id.strip_prefix("arnold:") {
                Some(node) => arnold_nodes::build(self, shader, node),
                None if self.is_defined(shader) => self.build_materialx(shader, output),
                None => usd_nodes::build(self, shader, &shader.id, false),
            },
        };
        self.depth -= 1;
        if built.is_none() {
            self.failures += 1;
            let message = format!("shader node '{}' is not supported; the default of the input that it feeds is used", shader.id);
            // Parts of definitions are many, and none is the user's own.
            match self.document.node(shader.index).outer {
                None => self.warn(shader, message),
                Some(_) => self.host.once("shader node", &shader.id, &shader.path, message),
            }
        }
        built
    }

    /// Whether a document's own definition, whose name need not begin as the library's, says what the node is.
    fn is_defined(&mut self, shader: &Shader) -> bool {
        let is_other = shader.id.starts_with("ND_") || shader.id.starts_with("arnold:") || usd_nodes::is_usd_node(&shader.id);
        !is_other && self.host.definition(&shader.id).is_some_and(|definition| definition.body.is_some())
    }

    /// A node that is computed, or the graph that defines it.
    fn build_materialx(&mut self, shader: &Shader, output: &str) -> Option<Input> {
        let is_computed = materialx::row(&shader.id).is_some_and(|row| !matches!(row.rule, Rule::Later));
        if !is_computed && let Some(outputs) = self.expanded(shader) {
            let named = outputs.iter().find(|(name, _)| name == output).or(outputs.first())?;
            let failures = self.failures;
            let value = self.value_of(shader, output, named.1.clone());
            // What lacks a part is not what its name says.
            return value.filter(|_| self.failures == failures);
        }
        materialx::build(self, shader, output)
    }

    /// The outputs of the graph that defines a node, its nodes now being in the document; `None` where it is not defined by one.
    pub(in crate::material) fn expanded(&mut self, shader: &Shader) -> Option<Outputs> {
        if let Some(known) = self.expanded.get(&shader.index) {
            return known.clone();
        }
        let definition = self.host.definition(&shader.id);
        if definition.is_none() && shader.id.starts_with("ND_") && self.host.lacks_library() {
            let message = format!(
                "'{}' is not among the nodes of MaterialX that are built in; most others come with its standard library: pip install \
                 materialx",
                shader.id
            );
            self.host.once("extra", "materialx", &shader.path, message);
        }
        let outputs = definition.filter(|definition| definition.body.is_some()).and_then(|definition| {
            let expanded = definition::expand(&mut self.document, shader.index, &definition);
            expanded.map_err(|problem| self.host.once("definitions", &problem, &shader.path, problem.clone())).ok().map(Outputs::new)
        });
        self.expanded.insert(shader.index, outputs.clone());
        outputs
    }

    /// The node behind the first output of the graph that defines a node.
    pub(in crate::material) fn inside(&mut self, shader: &Shader) -> Option<Shader> {
        match self.expanded(shader)?.first()?.1 {
            Source::Output(node, _) => Some(self.shader(node)),
            _ => None,
        }
    }

    /// Says that a node waits for an operation of the engine.
    pub(in crate::material) fn waits(&mut self, shader: &Shader) {
        let (name, _) = materialx::split(&shader.id);
        self.host.unsupported(&format!("the pattern '{name}' of MaterialX"), &shader.path);
    }

    /// Runs something a closure deeper; `None` where closures are too many or go round in a circle, which is said once.
    pub(in crate::material) fn within<R>(&mut self, shader: &Shader, run: impl FnOnce(&mut Self) -> R) -> Option<R> {
        self.closures += 1;
        if self.depth >= MAX_DEPTH || self.closures > MAX_CLOSURES || self.graph.nodes.len() >= MAX_NODES {
            let message = "the closures are too many or go round in a circle; those beyond are left out".to_owned();
            self.host.once("closures", &shader.path, &shader.path, message);
            return None;
        }
        self.depth += 1;
        let result = run(self);
        self.depth -= 1;
        Some(result)
    }

    /// Appends a node and gives its whole output.
    pub(in crate::material) fn node(&mut self, operation: Operation, inputs: Vec<Input>) -> Input {
        Input::Node(self.graph.add(operation, inputs), Channel::Rgb)
    }
}
