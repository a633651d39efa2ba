//! A material's shading network on its way to a node graph: inputs are followed to constants or shader outputs, each output is built once.

use super::arithmetic::{colour, component, scalar};
use super::value::{Source, Value, is_colour, source, stated_colour_space, to_linear_rec709};
use super::{arnold_nodes, materialx_nodes, usd_nodes};
use crate::context::Context;
use crate::prim::{Attribute, Prim};
use crate::pxr;
use crate::vt::FromValue;
use gonio::scene::{Channel, Graph, Input, Operation, Origin};
use pyo3::prelude::*;
use std::collections::HashMap;

/// Longest chain of shaders; longer ones are taken for cycles.
const MAX_DEPTH: usize = 200;
/// Most closures of a surface, those in mixes and layers counted.
const MAX_CLOSURES: usize = 1000;
/// Nodes in a graph beyond which shaders are not converted.
const MAX_NODES: usize = 60_000;

/// A shader prim and its node's name.
#[derive(Clone, Debug)]
pub(in crate::material) struct Shader<'py> {
    /// The prim.
    pub(in crate::material) prim: Prim<'py>,
    /// Its path.
    pub(in crate::material) path: String,
    /// The name of the node that it is: `UsdPreviewSurface`, `ND_image_color3`.
    pub(in crate::material) id: String,
}

impl<'py> Shader<'py> {
    /// The shader at a prim.
    pub(in crate::material) fn new(prim: Prim<'py>, time: &Bound<'py, PyAny>) -> Self {
        let id = || prim.attribute("info:id")?.get(time).ok()??.extract::<String>().ok().filter(|id| !id.is_empty());
        let id = id().or_else(|| source_asset(&prim, time)).unwrap_or_default();
        Self { path: prim.path(), id, prim }
    }
}

/// What stands for a node's name where the code is in a file: the source's kind and the name in it, `mdl:OmniPBR`, or the file's own.
fn source_asset<'py>(prim: &Prim<'py>, time: &Bound<'py, PyAny>) -> Option<String> {
    let source = |name: &str| name.strip_prefix("info:")?.strip_suffix("sourceAsset").map(str::to_owned);
    let kind = prim.authored_names().iter().find_map(|name| source(name))?;
    let text = |name: String| prim.attribute(&name)?.get(time).ok().flatten();
    let inside = text(format!("info:{kind}sourceAsset:subIdentifier")).and_then(|name| name.extract::<String>().ok());
    let named = inside.filter(|name| !name.is_empty()).or_else(|| {
        let path = crate::vt::AssetPath::from_value(&text(format!("info:{kind}sourceAsset"))?)?.authored;
        std::path::Path::new(&path).file_stem().map(|stem| stem.to_string_lossy().into_owned())
    });
    named.map(|name| kind + &name)
}

/// A network that is being converted.
#[derive(Debug)]
pub(in crate::material) struct Network<'c, 'a, 'py> {
    /// The stage at hand.
    pub(in crate::material) context: &'c mut Context<'a, 'py>,
    /// The nodes so far.
    pub(in crate::material) graph: Graph,
    /// What was built for a shader, by its path.
    built: HashMap<String, Option<Input>>,
    depth: usize,
    /// Closures met.
    closures: usize,
}

impl<'c, 'a, 'py> Network<'c, 'a, 'py> {
    /// A network without nodes.
    pub(in crate::material) fn new(context: &'c mut Context<'a, 'py>) -> Self {
        Self { context, graph: Graph::default(), built: HashMap::new(), depth: 0, closures: 0 }
    }

    /// A warning about a shader.
    pub(in crate::material) fn warn(&mut self, shader: &Shader<'_>, message: impl Into<String>) {
        let origin = Origin::new(&shader.path);
        self.context.warn(&origin, message);
    }

    /// Says once for each feature that it is not supported.
    pub(in crate::material) fn unsupported(&mut self, feature: &str, shader: &Shader<'_>) {
        self.context.unsupported(feature, &Origin::new(&shader.path));
    }

    /// Where an input's value comes from; what cannot be read counts as nothing, with a warning.
    pub(in crate::material) fn source(&mut self, shader: &Shader<'py>, name: &str) -> Source<'py> {
        match source(&shader.prim, name, &self.context.time) {
            Ok(source) => source,
            Err(error) => {
                let problem = pxr::message_of(self.context.py, &error);
                self.warn(shader, format!("input '{name}' cannot be read ({problem}); its default is used"));
                Source::Nothing
            }
        }
    }

    /// An input as a constant or a node's output; `None` where nothing usable is said.
    pub(in crate::material) fn input(&mut self, shader: &Shader<'py>, name: &str) -> Option<Input> {
        match self.source(shader, name) {
            Source::Nothing => None,
            Source::Value(Value::Numbers(values, count), attribute) => Some(self.constant(shader, name, values, count, &attribute)),
            Source::Value(..) => {
                self.warn(shader, format!("input '{name}' holds no number; its default is used"));
                None
            }
            Source::Output(prim, output) => self.output(prim, &output),
        }
    }

    fn constant(&mut self, shader: &Shader<'py>, name: &str, values: [f32; 4], count: usize, attribute: &Attribute<'py>) -> Input {
        if values.iter().any(|x| !x.is_finite()) {
            self.warn(shader, format!("input '{name}' is not finite; 0 is used"));
            return Input::Constant(values.map(|x| if x.is_finite() { x } else { 0.0 }));
        }
        if count < 3 || !is_colour(attribute) {
            return Input::Constant(values);
        }
        match to_linear_rec709(values, &stated_colour_space(attribute)) {
            Ok(values) => Input::Constant(values),
            Err(space) => {
                self.warn(shader, format!("input '{name}' has the unknown colour space '{space}'; taken as linear Rec.709"));
                Input::Constant(values)
            }
        }
    }

    /// A scalar input, or its default.
    pub(in crate::material) fn scalar(&mut self, shader: &Shader<'py>, name: &str, default: f32) -> Input {
        self.input(shader, name).map_or(scalar(default), |input| component(input, 0))
    }

    /// A colour or vector input, or its default.
    pub(in crate::material) fn colour(&mut self, shader: &Shader<'py>, name: &str, default: [f32; 3]) -> Input {
        self.input(shader, name).unwrap_or(colour(default))
    }

    /// An input that must not vary over the surface; what does is replaced by the default, with a warning.
    pub(in crate::material) fn uniform(&mut self, shader: &Shader<'py>, name: &str, default: [f32; 4]) -> [f32; 4] {
        match self.input(shader, name) {
            None => default,
            Some(Input::Constant(values)) => values,
            Some(Input::Node(..)) => {
                self.warn(shader, format!("input '{name}' varies over the surface, which is not supported for it; its default is used"));
                default
            }
        }
    }

    /// A number that must not vary over the surface.
    pub(in crate::material) fn number(&mut self, shader: &Shader<'py>, name: &str, default: f32) -> f32 {
        self.uniform(shader, name, [default; 4])[0]
    }

    /// A token or string.
    pub(in crate::material) fn text(&mut self, shader: &Shader<'py>, name: &str) -> Option<String> {
        match self.source(shader, name) {
            Source::Value(value, _) => value.text().map(str::to_owned),
            _ => None,
        }
    }

    /// What a shader's output gives; `None`, with a warning, where the shader is not supported.
    fn output(&mut self, prim: Prim<'py>, output: &str) -> Option<Input> {
        let shader = Shader::new(prim, &self.context.time);
        let whole = match self.built.get(&shader.path) {
            Some(built) => *built,
            None => {
                let built = self.build(&shader);
                self.built.insert(shader.path.clone(), built);
                built
            }
        }?;
        let index = usd_nodes::output_component(&shader.id, output).or_else(|| materialx_nodes::output_component(&shader.id, output));
        let index = index.or_else(|| arnold_nodes::output_component(&shader.id, output));
        Some(index.map_or(whole, |index| component(whole, index)))
    }

    fn build(&mut self, shader: &Shader<'py>) -> Option<Input> {
        if self.depth >= MAX_DEPTH || self.graph.nodes.len() >= MAX_NODES {
            self.warn(shader, "the shading network is too deep or goes round in a circle; the input's default is used");
            return None;
        }
        self.depth += 1;
        let built = match shader.id.strip_prefix("ND_") {
            Some(node) if !usd_nodes::is_usd_node(node) => materialx_nodes::build(self, shader, node),
            Some(node) => usd_nodes::build(self, shader, node, true),
            None => match shader.id.strip_prefix("arnold:") {
                Some(node) => arnold_nodes::build(self, shader, node),
                None => usd_nodes::build(self, shader, &shader.id, false),
            },
        };
        self.depth -= 1;
        if built.is_none() {
            self.warn(shader, format!("shader node '{}' is not supported; the default of the input that it feeds is used", shader.id));
        }
        built
    }

    /// Runs something a closure deeper; `None` where closures are too many or go round in a circle, which is said once.
    pub(in crate::material) fn within<R>(&mut self, shader: &Shader<'py>, run: impl FnOnce(&mut Self) -> R) -> Option<R> {
        self.closures += 1;
        if self.depth >= MAX_DEPTH || self.closures > MAX_CLOSURES || self.graph.nodes.len() >= MAX_NODES {
            let message = || "the closures are too many or go round in a circle; those beyond are left out".to_owned();
            self.context.once("closures", &shader.path, &Origin::new(&shader.path), message);
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
