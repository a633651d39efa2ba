//! Definitions of nodes, and those among them that are graphs of others: MaterialX's standard library, read from the folder of its Python
//! package, or what a document defines for itself.

use super::definition::{Body, BodyNode, BodySource, Definition};
use super::mtlx::{Stated, is_data, token_port, tokens, value_of};
use super::neutral::Source;
use super::xml::{self, Element};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Largest file of a library.
const MAX_BYTES: u64 = 16 << 20;
/// Deepest folder of a library.
const MAX_FOLDERS: usize = 4;
/// The beginnings of folders of a library that hold code of shading languages alone.
const SKIPPED: [&str; 2] = ["gen", "targets"];

/// Definitions by name.
#[derive(Debug, Default)]
pub struct Library {
    definitions: HashMap<String, Arc<Definition>>,
    /// Names of definitions by the category of their nodes.
    categories: HashMap<String, Vec<String>>,
}

impl Library {
    /// The library in some folders; `None` where there is none that can be read.
    pub(in crate::material) fn read(folders: &[PathBuf]) -> Option<Self> {
        let mut documents = Vec::new();
        folders.iter().for_each(|folder| collect(folder, 0, &mut documents));
        let places = documents.iter().map(|(document, folder)| Stated { document, graph: None, folder });
        let library = Self::of(&places.collect::<Vec<_>>());
        (!library.definitions.is_empty()).then_some(library)
    }

    /// What documents define, each with the folder that it lies in.
    pub(in crate::material) fn of(documents: &[Stated<'_>]) -> Self {
        let mut library = Self::default();
        let elements = || documents.iter().flat_map(|stated| stated.document.children.iter().map(move |child| (*stated, child)));
        for (stated, element) in elements().filter(|(_, element)| element.name == "nodedef") {
            if let Some(definition) = definition(&stated, element) {
                library.categories.entry(definition.category.clone()).or_default().push(definition.name.clone());
                library.definitions.insert(definition.name.clone(), Arc::new(definition));
            }
        }
        // A graph names its definition, or an implementation names both.
        let graphs: HashMap<&str, (Stated<'_>, &Element)> = elements()
            .filter(|(_, element)| element.name == "nodegraph")
            .filter_map(|(stated, element)| Some((element.attribute("name")?, (stated, element))))
            .collect();
        let own = graphs.values().filter_map(|(stated, graph)| Some((graph.attribute("nodedef")?, *stated, *graph)));
        let named = elements().filter(|(_, element)| element.name == "implementation").filter_map(|(_, element)| {
            let (stated, graph) = graphs.get(element.attribute("nodegraph")?)?;
            Some((element.attribute("nodedef")?, *stated, *graph))
        });
        let bodies: Vec<(String, Body)> =
            own.chain(named).map(|(name, stated, graph)| (name.to_owned(), library.body(&stated, graph))).collect();
        for (name, body) in bodies {
            if let Some(definition) = library.definitions.get_mut(&name).and_then(Arc::get_mut) {
                definition.body = Some(body);
            }
        }
        library
    }

    /// The definition of a name.
    pub(in crate::material) fn definition(&self, name: &str) -> Option<Arc<Definition>> {
        self.definitions.get(name).cloned()
    }

    /// The name of the definition that a node follows, by its category, its type and those of its inputs.
    pub(in crate::material) fn name_of(&self, node: &Element) -> Option<String> {
        if let Some(name) = node.attribute("nodedef") {
            return Some(name.to_owned());
        }
        let kind = node.attribute("type").unwrap_or_default();
        let candidates = self.categories.get(&node.name)?.iter().filter_map(|name| self.definitions.get(name));
        let fitting: Vec<&Arc<Definition>> =
            candidates.filter(|definition| kind == "multioutput" || definition.outputs.iter().any(|output| output.1 == kind)).collect();
        let agrees = |definition: &Definition| {
            let mut inputs = node.children.iter().filter(|child| child.name == "input");
            inputs.all(|input| {
                let known = definition.inputs.iter().find(|known| Some(known.name.as_str()) == input.attribute("name"));
                known.is_some_and(|known| Some(known.kind.as_str()) == input.attribute("type"))
            })
        };
        fitting.iter().find(|definition| agrees(definition)).or(fitting.first()).map(|definition| definition.name.clone())
    }

    fn body(&self, stated: &Stated<'_>, graph: &Element) -> Body {
        let stated = Stated { graph: Some(graph), ..*stated };
        let elements = graph.children.iter().filter(|child| child.name != "input" && child.name != "output");
        let elements: Vec<&Element> = elements.filter(|child| child.attribute("name").is_some()).collect();
        let places: HashMap<&str, usize> =
            elements.iter().enumerate().filter_map(|(index, element)| Some((element.attribute("name")?, index))).collect();
        let source = |input: &Element, node: &Element| -> Option<BodySource> {
            if let Some(name) = input.attribute("interfacename") {
                let shared = stated.document_input(name).and_then(|shared| value_of(shared, node, &Stated { graph: None, ..stated }));
                let shared = shared.map_or(Source::Nothing, |(value, said)| Source::Value(value, said));
                return Some(BodySource::Interface(name.to_owned(), shared));
            }
            if let Some(name) = input.attribute("nodename") {
                return Some(BodySource::Node(*places.get(name)?, input.attribute("output").unwrap_or("out").to_owned()));
            }
            if let Some(name) = input.attribute("defaultgeomprop") {
                return Some(BodySource::Said(Source::Geometric(name.to_owned())));
            }
            let (value, said) = value_of(input, node, &stated)?;
            Some(BodySource::Said(Source::Value(value, said)))
        };
        let nodes = elements.iter().map(|element| {
            let inputs = element.children.iter().filter(|child| child.name == "input");
            BodyNode {
                name: element.attribute("name").unwrap_or_default().to_owned(),
                id: self.name_of(element).unwrap_or_else(|| plain_id(element)),
                is_data: element.attribute("type").is_some_and(is_data),
                tokens: tokens(element).map(|(token, value)| token_port(token, value)).collect(),
                inputs: inputs.filter_map(|input| Some((input.attribute("name")?.to_owned(), source(input, element)?))).collect(),
            }
        });
        let outputs = graph.children.iter().filter(|child| child.name == "output");
        Body {
            nodes: nodes.collect(),
            outputs: outputs.filter_map(|output| Some((output.attribute("name")?.to_owned(), source(output, graph)?))).collect(),
        }
    }
}

/// The name that a node's definition has in the standard library, by its naming.
pub(in crate::material) fn plain_id(node: &Element) -> String {
    if let Some(definition) = node.attribute("nodedef") {
        return definition.to_owned();
    }
    let kind = node.attribute("type").unwrap_or_default();
    let input = |name: &str| node.child_called(name).and_then(|input| input.attribute("type")).unwrap_or_default();
    match (node.name.as_str(), kind) {
        ("convert" | "swizzle", _) => format!("ND_{}_{}_{kind}", node.name, input("in")),
        // Of vectors and matrices the type of the input counts.
        ("dotproduct" | "distance", _) => format!("ND_{}_{}", node.name, input("in1")),
        ("magnitude" | "extract" | "determinant", _) => format!("ND_{}_{}", node.name, input("in")),
        ("separate2" | "separate3" | "separate4", _) => format!("ND_{}_{}", node.name, input("in")),
        // Closures and surfaces have the type in their name, or no type there.
        ("mix" | "add" | "layer", "BSDF" | "EDF") => format!("ND_{}_{}", node.name, kind.to_ascii_lowercase()),
        ("multiply", "BSDF" | "EDF") => {
            let factor = if input("in2") == "color3" { 'C' } else { 'F' };
            format!("ND_multiply_{}{factor}", kind.to_ascii_lowercase())
        }
        (name, "BSDF" | "EDF") => format!("ND_{name}"),
        (
            "surface"
            | "surface_unlit"
            | "disney_principled"
            | "roughness_anisotropy"
            | "roughness_dual"
            | "artistic_ior"
            | "blackbody"
            | "chiang_hair_roughness"
            | "deon_hair_absorption_from_melanin"
            | "chiang_hair_absorption_from_color",
            _,
        ) => {
            format!("ND_{}", node.name)
        }
        ("and" | "or" | "xor" | "not", _) => format!("ND_logical_{}", node.name),
        ("combine2", "color4") => "ND_combine2_color4CF".to_owned(),
        ("combine2", "vector4") if input("in1") == "vector2" => "ND_combine2_vector4VV".to_owned(),
        ("combine2", "vector4") => "ND_combine2_vector4VF".to_owned(),
        ("transformmatrix", "vector2") => "ND_transformmatrix_vector2M3".to_owned(),
        ("transformmatrix", "vector3") if input("mat") == "matrix44" => "ND_transformmatrix_vector3M4".to_owned(),
        ("creatematrix", _) => format!("ND_creatematrix_{}_{kind}", input("in1")),
        (name, _) => format!("ND_{name}_{kind}"),
    }
}

fn definition(stated: &Stated<'_>, element: &Element) -> Option<Definition> {
    let (name, category) = (element.attribute("name")?.to_owned(), element.attribute("node")?.to_owned());
    let inputs = element.children.iter().filter(|child| child.name == "input").filter_map(|input| {
        let source = match input.attribute("defaultgeomprop") {
            Some(name) => Source::Geometric(name.to_owned()),
            None => value_of(input, element, stated).map_or(Source::Nothing, |(value, said)| Source::Value(value, said)),
        };
        let kind = input.attribute("type").unwrap_or_default().to_owned();
        Some(super::definition::DefinedInput { name: input.attribute("name")?.to_owned(), kind, source })
    });
    let outputs = element.children.iter().filter(|child| child.name == "output");
    let outputs = outputs.filter_map(|output| Some((output.attribute("name")?.to_owned(), output.attribute("type")?.to_owned())));
    let tokens = tokens(element).map(|(token, value)| (token.to_owned(), value.to_owned())).collect();
    Some(Definition { name, category, inputs: inputs.collect(), tokens, outputs: outputs.collect(), body: None })
}

/// The documents in a folder and those inside it, each with the folder that it lies in.
fn collect(folder: &Path, depth: usize, documents: &mut Vec<(Element, String)>) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    let mut paths: Vec<_> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    paths.sort();
    for path in paths {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if path.is_dir() {
            if depth < MAX_FOLDERS && !SKIPPED.iter().any(|skipped| name.starts_with(skipped)) {
                collect(&path, depth + 1, documents);
            }
            continue;
        }
        let is_sound = name.ends_with(".mtlx") && path.metadata().is_ok_and(|data| data.len() <= MAX_BYTES);
        let text = if is_sound { std::fs::read_to_string(&path).ok() } else { None };
        documents.extend(text.and_then(|text| Some((xml::parse(&text).ok()?, folder.to_string_lossy().into_owned()))));
    }
}
