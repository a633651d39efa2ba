//! MaterialX documents as neutral ones: values, colour spaces, units and files as the format states them.

use super::library::{Library, plain_id};
use super::neutral::{Document, NodeIndex, Port, RAW, Said, Source, Value};
use super::value::UNIT_MATRIX;
use super::xml::Element;
use crate::vt::AssetPath;
use std::collections::HashMap;
use std::path::Path;

/// Longest way through interfaces of graphs to a value.
const MAX_STEPS: usize = 64;

/// What holds around a node: the document, the graph that it stands in, and the folder that files are named from.
#[derive(Clone, Copy, Debug)]
pub(in crate::material) struct Stated<'d> {
    pub(in crate::material) document: &'d Element,
    pub(in crate::material) graph: Option<&'d Element>,
    pub(in crate::material) folder: &'d str,
}

impl<'d> Stated<'d> {
    /// The space said for an input, or for colours the one that holds around it.
    pub(in crate::material) fn colour_space(&self, input: &Element, node: &Element, is_colour: bool) -> String {
        let inherited = || {
            let scopes = [Some(node), self.graph, Some(self.document)];
            scopes.into_iter().flatten().find_map(|scope| scope.attribute("colorspace")).filter(|_| is_colour)
        };
        input.attribute("colorspace").or_else(inherited).unwrap_or_default().to_owned()
    }

    /// The document's own input of a name.
    pub(in crate::material) fn document_input(&self, name: &str) -> Option<&'d Element> {
        self.document.children.iter().find(|child| child.name == "input" && child.attribute("name") == Some(name))
    }

    /// A file's name with what tokens of the node, its graph and the document stand for: `[name]`.
    fn without_tokens(&self, name: &str, node: &Element) -> String {
        let scopes = [Some(node), self.graph, Some(self.document)].into_iter().flatten();
        scopes.flat_map(tokens).fold(name.to_owned(), |name, (token, value)| name.replace(&format!("[{token}]"), value))
    }

    /// Where a file lies: beside the document, under the prefix that holds unless it is there without.
    pub(in crate::material) fn file(&self, name: &str) -> String {
        let prefix = self.graph.and_then(|graph| graph.attribute("fileprefix")).or_else(|| self.document.attribute("fileprefix"));
        let folder = Path::new(self.folder);
        let plain = folder.join(name);
        let path = if plain.exists() || Path::new(name).is_absolute() {
            plain
        } else {
            folder.join(format!("{}{name}", prefix.unwrap_or_default()))
        };
        path.to_string_lossy().into_owned()
    }
}

/// Names and values of what stands in brackets in names of files below an element.
pub(in crate::material) fn tokens(element: &Element) -> impl Iterator<Item = (&str, &str)> {
    let tokens = element.children.iter().filter(|child| child.name == "token");
    tokens.filter_map(|token| Some((token.attribute("name")?, token.attribute("value").unwrap_or_default())))
}

/// The port of a node on which a token of its definition is set.
pub(in crate::material) fn token_port(token: &str, value: &str) -> Port {
    Port { name: format!("token:{token}"), source: Source::Value(Value::Text(value.to_owned()), Said::default()) }
}

/// Whether a type is that of numbers that are no colours.
pub(in crate::material) fn is_data(kind: &str) -> bool {
    components(kind).is_some() && !kind.starts_with("color")
}

/// Components of a type of numbers; `None` for other types.
pub(in crate::material) fn components(kind: &str) -> Option<usize> {
    Some(match kind {
        "float" | "integer" | "boolean" => 1,
        "vector2" => 2,
        "color3" | "vector3" => 3,
        "color4" | "vector4" => 4,
        "matrix33" => 9,
        "matrix44" => 16,
        _ => return None,
    })
}

/// The finite numbers in a value's text.
pub(in crate::material) fn numbers(text: &str) -> Option<Vec<f32>> {
    let parts = text.split([',', ' ', '\n', '\t', '\r']).filter(|part| !part.is_empty());
    parts.map(|part| part.parse::<f64>().ok().filter(|x| x.is_finite()).map(|x| x as f32)).collect()
}

/// The value of an input of a node; `None` where there is none, or none that is sound.
pub(in crate::material) fn value_of(input: &Element, node: &Element, stated: &Stated<'_>) -> Option<(Value, Said)> {
    let (text, kind) = (input.attribute("value")?, input.attribute("type").unwrap_or_default());
    let is_colour = kind.starts_with("color");
    let unit = input.attribute("unit").unwrap_or_default().to_owned();
    let mut said = Said { is_colour, unit, ..Said::default() };
    let value = match (kind, components(kind)) {
        ("string", _) => Value::Text(text.to_owned()),
        ("filename", _) => {
            // Definitions and nodes of several outputs hand names on to what reads them.
            said.space = stated.colour_space(input, node, node.attribute("type").is_none_or(|kind| !is_data(kind)));
            if said.space.is_empty() {
                // Where a document names no space, nothing is converted.
                said.space = RAW.to_owned();
            }
            let name = stated.without_tokens(text, node);
            let place = stated.file(&name);
            Value::Asset(AssetPath { authored: name, resolved: place })
        }
        ("boolean", _) => Value::Numbers([f32::from(u8::from(text == "true")); 4], 1),
        (_, Some(count)) => {
            let numbers = numbers(text).filter(|numbers| numbers.len() == count)?;
            if is_colour {
                said.space = stated.colour_space(input, node, true);
            }
            number_value(&numbers)
        }
        _ => return None,
    };
    Some((value, said))
}

fn number_value(numbers: &[f32]) -> Value {
    let side = match numbers {
        [single] => return Value::Numbers([*single; 4], 1),
        few if few.len() <= 4 => {
            let mut values = [0.0, 0.0, 0.0, 1.0];
            values[..few.len()].copy_from_slice(few);
            return Value::Numbers(values, few.len());
        }
        nine if nine.len() == 9 => 3,
        _ => 4,
    };
    let mut rows = UNIT_MATRIX;
    for (row, numbers) in rows.iter_mut().zip(numbers.chunks(side)) {
        row[..numbers.len()].copy_from_slice(numbers);
    }
    Value::Matrix(Box::new(rows), side)
}

/// What reads something that the document does not have.
fn missing(what: &str, name: &str) -> Source {
    Source::Unreadable(format!("it reads the {what} '{name}', which is not there"))
}

/// The network that an input of a node reads, whose end is the first node of the result, and the output of it that is read; `None` where
/// the input reads no node.
pub(in crate::material) fn read(stated: Stated<'_>, node: &Element, input: &str, libraries: &[&Library]) -> Option<(Document, String)> {
    let mut reader = Reader { document: Document::default(), known: HashMap::new(), waiting: Vec::new(), libraries };
    let Source::Output(_, output) = reader.source(node.child_called(input)?, Place { node, stated }, 0) else { return None };
    Some((reader.finished(), output))
}

/// The network that ends in a node, which is the first of the result.
pub(in crate::material) fn read_to(stated: Stated<'_>, node: &Element, libraries: &[&Library]) -> Document {
    let mut reader = Reader { document: Document::default(), known: HashMap::new(), waiting: Vec::new(), libraries };
    reader.node(Place { node, stated });
    reader.finished()
}

/// A node and what holds around it.
#[derive(Clone, Copy)]
struct Place<'d> {
    node: &'d Element,
    stated: Stated<'d>,
}

struct Reader<'d, 'l> {
    document: Document,
    known: HashMap<*const Element, NodeIndex>,
    waiting: Vec<(NodeIndex, Place<'d>)>,
    libraries: &'l [&'l Library],
}

impl<'d> Reader<'d, '_> {
    /// The document with the inputs of all nodes that were met.
    fn finished(mut self) -> Document {
        while let Some((index, place)) = self.waiting.pop() {
            self.document.nodes[index.0].inputs.extend(tokens(place.node).map(|(token, value)| token_port(token, value)));
            for input in place.node.children.iter().filter(|child| child.name == "input") {
                let source = self.source(input, place, 0);
                if let (Some(name), true) = (input.attribute("name"), source != Source::Nothing) {
                    self.document.nodes[index.0].inputs.push(Port { name: name.to_owned(), source });
                }
            }
        }
        self.document
    }

    fn node(&mut self, place: Place<'d>) -> NodeIndex {
        let key = std::ptr::from_ref(place.node);
        if let Some(known) = self.known.get(&key) {
            return *known;
        }
        let name = place.node.attribute("name").unwrap_or("node");
        let path = place.stated.graph.and_then(|graph| graph.attribute("name")).map_or(name.to_owned(), |graph| format!("{graph}/{name}"));
        let id = self.libraries.iter().find_map(|library| library.name_of(place.node)).unwrap_or_else(|| plain_id(place.node));
        let index = self.document.add(&path, &id);
        self.known.insert(key, index);
        self.waiting.push((index, place));
        index
    }

    fn source(&mut self, input: &'d Element, place: Place<'d>, steps: usize) -> Source {
        let Place { stated, .. } = place;
        if steps > MAX_STEPS {
            return Source::Unreadable("its connections go round in a circle".to_owned());
        }
        let outside = Stated { graph: None, ..stated };
        if let Some(name) = input.attribute("interfacename") {
            let own = stated.graph.and_then(|graph| graph.child_called(name)).filter(|child| child.name == "input");
            // The graph's own input belongs to the document, which may have inputs that all read.
            return match own.or_else(|| stated.document_input(name)) {
                Some(interface) => self.source(interface, Place { stated: outside, ..place }, steps + 1),
                None => missing("input", name),
            };
        }
        let scope = stated.graph.unwrap_or(stated.document);
        let named = input.attribute("nodegraph").and_then(|name| stated.document.child_called(name));
        let named = named.or_else(|| input.attribute("nodename").and_then(|name| scope.child_called(name)));
        match named {
            Some(graph) if graph.name == "nodegraph" => {
                let mut outputs = graph.children.iter().filter(|child| child.name == "output");
                let output = match input.attribute("output") {
                    Some(name) => outputs.find(|output| output.attribute("name") == Some(name)),
                    None => outputs.next(),
                };
                let inside = Place { node: graph, stated: Stated { graph: Some(graph), ..stated } };
                match output {
                    Some(output) => self.source(output, inside, steps + 1),
                    None => missing("output", input.attribute("output").unwrap_or_default()),
                }
            }
            Some(node) => {
                let index = self.node(Place { node, stated });
                Source::Output(index, input.attribute("output").unwrap_or("out").to_owned())
            }
            None => match (input.attribute("defaultgeomprop"), value_of(input, place.node, &stated)) {
                (_, Some((value, said))) => Source::Value(value, said),
                (Some(name), None) => Source::Geometric(name.to_owned()),
                (None, None) if input.attribute("value").is_some() => Source::Unreadable("its value is not usable".to_owned()),
                (None, None) => {
                    let read = input.attribute("nodegraph").or(input.attribute("nodename"));
                    read.map_or(Source::Nothing, |name| missing("node", name))
                }
            },
        }
    }
}
