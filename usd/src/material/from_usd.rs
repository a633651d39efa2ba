//! Shading networks of UsdShade as neutral documents: what a surface reads, followed through the interfaces of node graphs and materials.

use super::dangling;
use super::neutral::{Document, NodeIndex, Port, Said, Source, Value};
use super::textures::{resolve_of_frame, resolve_text, resolve_tiles};
use super::value::{is_colour, stated_colour_space};
use crate::prim::{Attribute, Prim};
use crate::pxr::{self, Module};
use pyo3::{intern, prelude::*};
use std::collections::HashMap;

/// Most shaders of a network that are read.
const MAX_SHADERS: usize = 60_000;

/// The network whose end is this shader prim, which becomes its first node.
pub(in crate::material) fn read<'py>(surface: Prim<'py>, time: &Bound<'py, PyAny>) -> Document {
    let mut reader = Reader { document: Document::default(), known: HashMap::new(), waiting: Vec::new(), time };
    reader.node(surface);
    while let Some((index, prim)) = reader.waiting.pop() {
        let names: Vec<String> = prim.authored_names().iter().filter_map(|name| Some(name.strip_prefix("inputs:")?.to_owned())).collect();
        for name in names {
            let source = reader.source(&prim, &name).unwrap_or_else(|error| Source::Unreadable(pxr::message_of(prim.py(), &error)));
            reader.document.nodes[index.0].inputs.push(Port { name, source });
        }
    }
    reader.document
}

struct Reader<'t, 'py> {
    document: Document,
    /// Shaders met, by path.
    known: HashMap<String, NodeIndex>,
    /// Those whose inputs are still to be read.
    waiting: Vec<(NodeIndex, Prim<'py>)>,
    time: &'t Bound<'py, PyAny>,
}

impl<'py> Reader<'_, 'py> {
    /// The node of a shader prim; its inputs are read later.
    fn node(&mut self, prim: Prim<'py>) -> Option<NodeIndex> {
        let path = prim.path();
        if let Some(known) = self.known.get(&path) {
            return Some(*known);
        }
        if self.known.len() >= MAX_SHADERS {
            return None;
        }
        let index = self.document.add(&path, &node_id(&prim, self.time));
        self.known.insert(path, index);
        self.waiting.push((index, prim));
        Some(index)
    }

    fn source(&mut self, shader: &Prim<'py>, name: &str) -> PyResult<Source> {
        let py = shader.py();
        // Shaders have no schema that would give unauthored inputs a value.
        let Some(attribute) = shader.attribute(&format!("inputs:{name}")) else { return Ok(Source::Nothing) };
        if !attribute.object().call_method0(intern!(py, "HasAuthoredConnections"))?.is_truthy()? {
            return self.value(name, &attribute);
        }
        let input = Module::UsdShade.wrap("Input", attribute.object())?;
        let producers = input.call_method0(intern!(py, "GetValueProducingAttributes"))?;
        let producer = producers.try_iter()?.next().transpose()?;
        // Where a connection leads nowhere, the input's own value is what is left.
        let own = producer.as_ref().map_or(Ok(true), |producer| producer.eq(attribute.object()))?;
        let Some(producer) = producer.filter(|_| !own) else {
            if let Some((prim, output)) = undeclared_source(attribute.object())? {
                return Ok(self.output(prim, output));
            }
            if let Some(end) = dangling::dangling(attribute.object())? {
                let message = format!("input '{name}' is connected to {end}; its own value or default is used");
                self.document.problems.push((shader.path(), message));
            }
            return self.value(name, &attribute);
        };
        let full_name: String = producer.call_method0(intern!(py, "GetName"))?.extract()?;
        let Some(output) = full_name.strip_prefix("outputs:") else {
            return self.value(name, &Attribute::new(producer));
        };
        let prim = Prim::new(producer.call_method0(intern!(py, "GetPrim"))?);
        Ok(self.output(prim, output.to_owned()))
    }

    fn output(&mut self, prim: Prim<'py>, output: String) -> Source {
        match self.node(prim) {
            Some(index) => Source::Output(index, output),
            None => Source::Unreadable(format!("the network has more than {MAX_SHADERS} shaders")),
        }
    }

    fn value(&self, name: &str, attribute: &Attribute<'py>) -> PyResult<Source> {
        let value = attribute.get(self.time)?;
        let Some(mut value) = value.as_ref().and_then(Value::from_python) else { return Ok(Source::Nothing) };
        // A colour has three numbers at least.
        let is_colour = !matches!(value, Value::Numbers(_, ..3)) && is_colour(attribute);
        let mut said = Said { is_colour, ..Said::default() };
        match &mut value {
            Value::Numbers(_, count) if said.is_colour && *count >= 3 => said.space = stated_colour_space(attribute),
            Value::Asset(path) => {
                said.space = stated_colour_space(attribute);
                if path.resolved.is_empty() {
                    path.resolved = resolve_tiles(attribute, &path.authored);
                }
                if path.resolved.is_empty() {
                    path.resolved = resolve_of_frame(attribute, &path.authored, self.time);
                }
            }
            Value::Text(text) if names_file(name) => {
                said.space = stated_colour_space(attribute);
                said.resolved = resolve_tiles(attribute, text);
                if said.resolved.is_empty() {
                    said.resolved = resolve_text(attribute, text);
                }
            }
            Value::Numbers(..) => said.unit = unit(attribute),
            Value::Text(_) | Value::Matrix(..) => {}
        }
        Ok(Source::Value(value, said))
    }
}

/// The shader and its output that a connection names although the shader does not declare it, for which `pxr` follows no connection: some
/// exporters leave outputs out, and mean the shader all the same.
pub(in crate::material) fn undeclared_source<'py>(attribute: &Bound<'py, PyAny>) -> PyResult<Option<(Prim<'py>, String)>> {
    let py = attribute.py();
    let stage = attribute.call_method0(intern!(py, "GetStage"))?;
    for path in attribute.call_method0(intern!(py, "GetConnections"))?.try_iter()? {
        let path = path?;
        let name: String = path.getattr(intern!(py, "name"))?.extract()?;
        let prim = Prim::new(stage.call_method1(intern!(py, "GetPrimAtPath"), (path.call_method0(intern!(py, "GetPrimPath"))?,))?);
        match name.strip_prefix("outputs:") {
            Some(output) if prim.is_valid() && prim.type_name() == "Shader" => return Ok(Some((prim, output.to_owned()))),
            _ => {}
        }
    }
    Ok(None)
}

/// The unit that exporters of MaterialX leave at an attribute.
fn unit(attribute: &Attribute<'_>) -> String {
    attribute.metadata("customData").and_then(|data| data.get_item("unit").ok()?.extract().ok()).unwrap_or_default()
}

/// Whether text in an input is the name of a file.
fn names_file(input: &str) -> bool {
    input.starts_with("file") || input.ends_with("_texture")
}

/// The name of the node that a shader prim is.
fn node_id<'py>(prim: &Prim<'py>, time: &Bound<'py, PyAny>) -> String {
    let id = || prim.attribute("info:id")?.get(time).ok()??.extract::<String>().ok().filter(|id| !id.is_empty());
    id().or_else(|| source_asset(prim, time)).unwrap_or_default()
}

/// What stands for a node's name where the code is in a file: the source's kind and the name in it, `mdl:OmniPBR`, or the file's own.
fn source_asset<'py>(prim: &Prim<'py>, time: &Bound<'py, PyAny>) -> Option<String> {
    let source = |name: &str| name.strip_prefix("info:")?.strip_suffix("sourceAsset").map(str::to_owned);
    let kind = prim.authored_names().iter().find_map(|name| source(name))?;
    let text = |name: String| prim.attribute(&name)?.get(time).ok().flatten();
    let inside = text(format!("info:{kind}sourceAsset:subIdentifier")).and_then(|name| name.extract::<String>().ok());
    let named = inside.filter(|name| !name.is_empty()).or_else(|| {
        use crate::vt::FromValue;
        let path = crate::vt::AssetPath::from_value(&text(format!("info:{kind}sourceAsset"))?)?.authored;
        std::path::Path::new(&path).file_stem().map(|stem| stem.to_string_lossy().into_owned())
    });
    named.map(|name| kind + &name)
}
