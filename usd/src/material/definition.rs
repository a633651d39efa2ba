//! A node's definition, and how a node that is defined by a graph is put in place of by the graph's nodes.

use super::neutral::{Document, Node, NodeIndex, Port, RAW, Source, Value};
use std::rc::Rc;

/// How deep definitions may stand inside one another.
const MAX_NESTING: usize = 32;
/// Most nodes of a document, those of definitions counted.
const MAX_NODES: usize = 60_000;

/// What a node may be told, what it gives, and of what it consists.
#[derive(Debug)]
pub(in crate::material) struct Definition {
    /// `ND_image_color3`.
    pub(in crate::material) name: String,
    /// `image`.
    pub(in crate::material) category: String,
    pub(in crate::material) inputs: Vec<DefinedInput>,
    /// What stands in brackets in names of files inside, and for what where a node says nothing.
    pub(in crate::material) tokens: Vec<(String, String)>,
    /// Names and types.
    pub(in crate::material) outputs: Vec<(String, String)>,
    /// The graph that it is, if it is one.
    pub(in crate::material) body: Option<Body>,
}

/// An input, its type, and what it is where nothing is said.
#[derive(Debug)]
pub(in crate::material) struct DefinedInput {
    pub(in crate::material) name: String,
    pub(in crate::material) kind: String,
    pub(in crate::material) source: Source,
}

/// The graph that a definition is.
#[derive(Debug)]
pub(in crate::material) struct Body {
    pub(in crate::material) nodes: Vec<BodyNode>,
    pub(in crate::material) outputs: Vec<(String, BodySource)>,
}

/// A node of a graph.
#[derive(Debug)]
pub(in crate::material) struct BodyNode {
    pub(in crate::material) name: String,
    pub(in crate::material) id: String,
    /// Whether it gives numbers that are no colours.
    pub(in crate::material) is_data: bool,
    /// Tokens that are set on it.
    pub(in crate::material) tokens: Vec<Port>,
    pub(in crate::material) inputs: Vec<(String, BodySource)>,
}

/// Where a value in a graph comes from.
#[derive(Debug)]
pub(in crate::material) enum BodySource {
    /// It stands there.
    Said(Source),
    /// An input of the graph, and the document's of that name where the definition has none.
    Interface(String, Source),
    /// The output of another of its nodes.
    Node(usize, String),
}

/// Appends the nodes of the graph that defines a node, reading what that node reads; gives the graph's outputs.
///
/// # Errors
/// Why that is too much.
pub(in crate::material) fn expand(
    document: &mut Document,
    node: NodeIndex,
    definition: &Definition,
) -> Result<Vec<(String, Source)>, String> {
    let Some(body) = &definition.body else { return Ok(Vec::new()) };
    let first = document.nodes.len();
    let outer = document.node(node).clone();
    check_nesting(document, &outer)?;
    if first + body.nodes.len() > MAX_NODES {
        return Err(format!("the network with its definitions has more than {MAX_NODES} nodes"));
    }
    let source = |source: &BodySource| match source {
        BodySource::Said(source) => source.clone(),
        BodySource::Node(index, output) => Source::Output(NodeIndex(first + index), output.clone()),
        BodySource::Interface(name, shared) => match outer.source(name) {
            Source::Nothing => definition.inputs.iter().find(|input| input.name == *name).map_or(shared, |input| &input.source).clone(),
            source => source,
        },
    };
    let value = |(token, default): &(String, String)| match outer.source(&format!("token:{token}")) {
        Source::Value(Value::Text(value), _) => value,
        _ => default.clone(),
    };
    let tokens: Vec<(String, String)> = definition.tokens.iter().map(|token| (format!("[{}]", token.0), value(token))).collect();
    let filled = |name: &str| tokens.iter().fold(name.to_owned(), |name, (token, value)| name.replace(token, value));
    for inner in &body.nodes {
        let index = document.add(&format!("{}/{}", outer.path, inner.name), &inner.id);
        let inputs = inner.inputs.iter().map(|(name, said)| {
            let mut source = source(said);
            if let Source::Value(Value::Asset(path), said) = &mut source {
                (path.authored, path.resolved) = (filled(&path.authored), filled(&path.resolved));
                if inner.is_data {
                    // The colour space around a file's name is for colours.
                    said.space = RAW.to_owned();
                }
            }
            Port { name: name.clone(), source }
        });
        let inputs: Vec<Port> = inputs.filter(|port| port.source != Source::Nothing).collect();
        let added = &mut document.nodes[index.0];
        added.inputs = inputs;
        added.inputs.extend(inner.tokens.iter().cloned());
        added.outer = Some(node);
    }
    Ok(body.outputs.iter().map(|(name, said)| (name.clone(), source(said))).collect())
}

/// Whether a node may be taken apart where it stands.
fn check_nesting(document: &Document, node: &Node) -> Result<(), String> {
    let mut around = node.outer;
    let mut depth = 0;
    while let Some(index) = around {
        let surrounding = document.node(index);
        depth += 1;
        if surrounding.id == node.id {
            return Err(format!("the definition '{}' stands inside itself", node.id));
        }
        if depth >= MAX_NESTING {
            return Err(format!("definitions stand in one another more than {MAX_NESTING} deep"));
        }
        around = surrounding.outer;
    }
    Ok(())
}

/// The outputs of a graph that stands for a node.
pub(in crate::material) type Outputs = Rc<Vec<(String, Source)>>;
