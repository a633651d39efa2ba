//! MaterialX documents as USD layers: `pxr` does not read `.mtlx`, so references to it are given a converted layer in memory.
//!
//! Layers on disk stay as they are; those in memory get their asset paths back when the stage has been read.

use super::xml::{self, Element};
use crate::pxr::{self, Module};
use gonio::Diagnostic;
use gonio::scene::Origin;
use pyo3::types::{PyCFunction, PyDict, PyTuple};
use pyo3::{intern, prelude::*};
use std::collections::HashMap;
use std::fmt::Write as _;
use std::path::Path;

/// Largest document that is read.
const MAX_BYTES: u64 = 64 << 20;
/// Longest chain of nodes.
const MAX_CHAIN: usize = 200;

/// Layers that stand in for documents while the stage is in use; when it is dropped, the stage's layers get their references back.
#[derive(Debug)]
pub struct Substitution {
    changed: Vec<Py<PyAny>>,
    layers: Vec<Py<PyAny>>,
    originals: HashMap<String, String>,
}

/// Converts the MaterialX documents that the stage's layers refer to, and puts them in place of the references: to be called once the stage
/// is open, before its composition errors are asked for. Documents that cannot be converted are reported by name. `None` where there are no
/// documents.
pub fn substitute_documents(stage: &Bound<'_, PyAny>, diagnostics: &mut Vec<Diagnostic>) -> Option<Substitution> {
    let mut substitution = Substitution { changed: Vec::new(), layers: Vec::new(), originals: HashMap::new() };
    if let Err(error) = substitution.fill(stage, diagnostics) {
        let message = format!("documents that layers refer to cannot be used: {}", pxr::message_of(stage.py(), &error));
        diagnostics.push(Diagnostic::warning(&Origin::new("MaterialX"), message));
    }
    (!substitution.changed.is_empty()).then_some(substitution)
}

impl Substitution {
    fn fill(&mut self, stage: &Bound<'_, PyAny>, diagnostics: &mut Vec<Diagnostic>) -> PyResult<()> {
        let py = stage.py();
        for (layer, documents) in references(stage)? {
            let mut replacements = HashMap::new();
            for (authored, resolved) in documents {
                let origin = Origin { name: authored.as_str().into(), file: resolved.as_str().into() };
                let Some(stand_in) = stand_in(py, Path::new(&resolved), &origin, diagnostics) else { continue };
                let identifier: String = stand_in.getattr(intern!(py, "identifier"))?.extract()?;
                self.originals.insert(identifier.clone(), authored.clone());
                self.layers.push(stand_in.unbind());
                replacements.insert(authored, identifier);
            }
            if !replacements.is_empty() {
                replace_paths(&layer, replacements)?;
                self.changed.push(layer.unbind());
            }
        }
        Ok(())
    }

    /// Number of documents in use.
    pub fn len(&self) -> usize {
        self.layers.len()
    }

    /// Whether no document is in use.
    pub fn is_empty(&self) -> bool {
        self.layers.is_empty()
    }
}

impl Drop for Substitution {
    fn drop(&mut self) {
        let (changed, originals) = (std::mem::take(&mut self.changed), std::mem::take(&mut self.originals));
        Python::try_attach(|py| {
            for layer in &changed {
                // A layer that cannot be changed back is only held by the stage that goes away.
                let _ = replace_paths(layer.bind(py), originals.clone());
            }
        });
    }
}

/// A layer and the documents that it refers to, authored and resolved.
type LayerDocuments<'py> = (Bound<'py, PyAny>, Vec<(String, String)>);

fn references<'py>(stage: &Bound<'py, PyAny>) -> PyResult<Vec<LayerDocuments<'py>>> {
    let py = stage.py();
    let mut found = Vec::new();
    for layer in stage.call_method0(intern!(py, "GetUsedLayers"))?.try_iter()? {
        let layer = layer?;
        let mut documents = Vec::new();
        for path in layer.call_method0(intern!(py, "GetCompositionAssetDependencies"))?.try_iter()? {
            let authored: String = path?.extract()?;
            if authored.to_ascii_lowercase().ends_with(".mtlx") {
                let resolved = layer.call_method1(intern!(py, "ComputeAbsolutePath"), (&authored,))?.extract()?;
                documents.push((authored, resolved));
            }
        }
        if !documents.is_empty() {
            found.push((layer, documents));
        }
    }
    Ok(found)
}

fn replace_paths(layer: &Bound<'_, PyAny>, replacements: HashMap<String, String>) -> PyResult<()> {
    let py = layer.py();
    let replace = move |arguments: &Bound<'_, PyTuple>, _: Option<&Bound<'_, PyDict>>| -> PyResult<String> {
        let path: String = arguments.get_item(0)?.extract()?;
        Ok(replacements.get(&path).cloned().unwrap_or(path))
    };
    let function = PyCFunction::new_closure(py, None, None, replace)?;
    Module::UsdUtils.item(py, "ModifyAssetPaths")?.call1((layer, function)).map(|_| ())
}

/// A layer in memory with a document's materials.
fn stand_in<'py>(py: Python<'py>, file: &Path, origin: &Origin, diagnostics: &mut Vec<Diagnostic>) -> Option<Bound<'py, PyAny>> {
    let mut warn = |message: String| diagnostics.push(Diagnostic::warning(origin, message));
    let text = match read(file).and_then(|text| convert(&text, file)) {
        Ok((text, problems)) => {
            problems.into_iter().for_each(&mut warn);
            text
        }
        Err(problem) => {
            warn(format!("{problem}; its materials are missing"));
            return None;
        }
    };
    let import = || -> PyResult<Bound<'py, PyAny>> {
        let layer = Module::Sdf.item(py, "Layer")?.call_method1(intern!(py, "CreateAnonymous"), ("materialx.usda",))?;
        layer.call_method1(intern!(py, "ImportFromString"), (text,))?;
        Ok(layer)
    };
    match import() {
        Ok(layer) => Some(layer),
        Err(error) => {
            warn(format!("the MaterialX document cannot be converted: {}", pxr::message_of(py, &error)));
            None
        }
    }
}

fn read(path: &Path) -> Result<String, String> {
    let length = std::fs::metadata(path).map_err(|error| format!("the MaterialX document cannot be read: {error}"))?.len();
    if length > MAX_BYTES {
        return Err(format!("the MaterialX document has {length} bytes, more than {MAX_BYTES}"));
    }
    std::fs::read_to_string(path).map_err(|error| format!("the MaterialX document cannot be read: {error}"))
}

/// A document's materials as the text of a USD layer, and what is left out.
fn convert(text: &str, file: &Path) -> Result<(String, Vec<String>), String> {
    let document = xml::parse(text).map_err(|error| format!("line {}: {}", error.line, error.problem))?;
    if document.name != "materialx" {
        return Err(format!("the root element is <{}>, expected <materialx>", document.name));
    }
    let folder = file.parent().unwrap_or(Path::new("")).to_string_lossy().into_owned();
    let mut writer = Writer { document: &document, folder, problems: Vec::new() };
    let mut materials = String::new();
    for child in &document.children {
        match child.name.as_str() {
            "surfacematerial" => materials += &writer.material(child),
            "xi:include" | "include" | "material" | "nodedef" => {
                writer.problems.push(format!("<{}> in MaterialX documents is not supported, it is left out", child.name));
            }
            _ => {}
        }
    }
    let layer = format!(
        "#usda 1.0\n(\n    defaultPrim = \"MaterialX\"\n)\ndef Scope \"MaterialX\"\n{{\ndef Scope \"Materials\"\n{{\n{materials}}}\n}}\n"
    );
    Ok((layer, writer.problems))
}

/// A node and the graph that it stands in; `None` for the document's own nodes.
#[derive(Clone, Copy)]
struct Place<'d> {
    node: &'d Element,
    graph: Option<&'d Element>,
}

impl Place<'_> {
    /// The name of the shader prim, unique in a material.
    fn prim_name(&self) -> String {
        let own = self.node.attribute("name").unwrap_or("node");
        identifier(&self.graph.and_then(|graph| graph.attribute("name")).map_or(own.to_owned(), |graph| format!("{graph}__{own}")))
    }
}

/// What an input is set to.
enum Setting<'d> {
    Value(&'d Element),
    Node(Place<'d>, Option<&'d str>),
    Nothing,
}

struct Writer<'d> {
    document: &'d Element,
    folder: String,
    problems: Vec<String>,
}

fn identifier(name: &str) -> String {
    let plain: String = name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
    if plain.starts_with(|c: char| c.is_ascii_digit()) { format!("_{plain}") } else { plain }
}

/// A quoted string of the text format.
fn quoted(text: &str) -> String {
    let mut result = String::from("\"");
    for c in text.chars() {
        match c {
            '"' => result.push_str("\\\""),
            '\\' => result.push_str("\\\\"),
            '\n' => result.push_str("\\n"),
            c if c.is_control() => {}
            c => result.push(c),
        }
    }
    result + "\""
}

impl<'d> Writer<'d> {
    fn material(&mut self, material: &'d Element) -> String {
        let name = identifier(material.attribute("name").unwrap_or("material"));
        let surface = material.child_called("surfaceshader").map(|input| self.setting(input, None));
        let Some(Setting::Node(place, output)) = surface else {
            self.problems.push(format!("the material '{name}' has no surface shader"));
            return String::new();
        };
        if material.child_called("displacementshader").is_some() {
            self.problems.push(format!("the displacement of the material '{name}' is not supported, it is left out"));
        }
        let root = format!("/MaterialX/Materials/{name}");
        let mut shaders = Vec::new();
        let mut done = Vec::new();
        self.shader(&root, place, &mut shaders, &mut done, 0);
        let output = output.unwrap_or("out");
        let body = shaders.concat();
        format!(
            "def Material \"{name}\"\n{{\ntoken outputs:mtlx:surface.connect = <{root}/{}.outputs:{output}>\n{body}}}\n",
            place.prim_name()
        )
    }

    /// Appends the shader of a node and those that it reads.
    fn shader(&mut self, root: &str, place: Place<'d>, shaders: &mut Vec<String>, done: &mut Vec<String>, depth: usize) {
        let name = place.prim_name();
        if depth > MAX_CHAIN || done.contains(&name) {
            return;
        }
        done.push(name.clone());
        let mut text = format!("def Shader \"{name}\"\n{{\nuniform token info:id = {}\n", quoted(&node_id(place.node)));
        for input in place.node.children.iter().filter(|child| child.name == "input") {
            let Some(input_name) = input.attribute("name").map(identifier) else { continue };
            let kind = usd_type(input.attribute("type").unwrap_or_default());
            match (self.setting(input, place.graph), kind) {
                (Setting::Node(source, output), kind) => {
                    let kind = kind.unwrap_or("token");
                    let output = identifier(output.unwrap_or("out"));
                    let _ = writeln!(text, "{kind} inputs:{input_name}.connect = <{root}/{}.outputs:{output}>", source.prim_name());
                    self.shader(root, source, shaders, done, depth + 1);
                }
                (Setting::Value(value), Some(kind)) => match self.value(value, kind, place) {
                    Some(value) => {
                        let _ = writeln!(text, "{kind} inputs:{input_name} = {value}");
                    }
                    None => self.problems.push(format!("the input '{input_name}' of '{name}' has no usable value, it is left out")),
                },
                _ => {}
            }
        }
        text.push_str("token outputs:out\n}\n");
        shaders.push(text);
    }

    /// Follows an input of a node in `graph` to a value or a node.
    fn setting(&self, input: &'d Element, graph: Option<&'d Element>) -> Setting<'d> {
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

    /// The text of a value, with its colour space.
    fn value(&self, input: &Element, kind: &str, place: Place<'_>) -> Option<String> {
        let value = input.attribute("value")?;
        let is_colour = place.node.attribute("type").is_some_and(|kind| kind.starts_with("color"));
        match kind {
            "string" => Some(quoted(value)),
            "bool" => Some(u8::from(value == "true").to_string()),
            "asset" => {
                let path = self.asset(value, place)?;
                Some(path + &self.colour_space(input, place, is_colour))
            }
            kind => {
                let numbers: Vec<f64> =
                    value.split([',', ' ']).filter(|part| !part.is_empty()).map(|part| part.trim().parse().ok()).collect::<Option<_>>()?;
                let is_sound = numbers.len() == components(kind) && numbers.iter().all(|x| x.is_finite());
                let text = numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(", ");
                let space = self.colour_space(input, place, kind.starts_with("color"));
                is_sound.then(|| if numbers.len() == 1 { text } else { format!("({text}){space}") })
            }
        }
    }

    /// Asset paths are absolute: layers in memory have no place.
    fn asset(&self, value: &str, place: Place<'_>) -> Option<String> {
        let prefix = place.graph.and_then(|graph| graph.attribute("fileprefix")).or_else(|| self.document.attribute("fileprefix"));
        let relative = format!("{}{value}", prefix.unwrap_or_default());
        let path = Path::new(&self.folder).join(Path::new(value)).exists().then(|| Path::new(&self.folder).join(value));
        let path = path.unwrap_or_else(|| Path::new(&self.folder).join(relative)).to_string_lossy().into_owned();
        (!path.contains('@') && !path.contains('\n')).then(|| format!("@{path}@"))
    }

    /// The space said for the input, or for colours the one that holds in its graph or document.
    fn colour_space(&self, input: &Element, place: Place<'_>, is_colour: bool) -> String {
        let inherited = || {
            let scopes = [Some(place.node), place.graph, Some(self.document)];
            scopes.into_iter().flatten().find_map(|scope| scope.attribute("colorspace")).filter(|_| is_colour)
        };
        input.attribute("colorspace").or_else(inherited).map(|space| format!(" (\ncolorSpace = {}\n)", quoted(space))).unwrap_or_default()
    }
}

/// The name of a node's definition.
fn node_id(node: &Element) -> String {
    if let Some(definition) = node.attribute("nodedef") {
        return definition.to_owned();
    }
    let kind = node.attribute("type").unwrap_or_default();
    let input = |name: &str| node.child_called(name).and_then(|input| input.attribute("type")).unwrap_or_default();
    match (node.name.as_str(), kind) {
        ("convert" | "swizzle", _) => format!("ND_{}_{}_{kind}", node.name, input("in")),
        ("combine2", "color4") => "ND_combine2_color4CF".to_owned(),
        ("combine2", "vector4") if input("in1") == "vector2" => "ND_combine2_vector4VV".to_owned(),
        ("combine2", "vector4") => "ND_combine2_vector4VF".to_owned(),
        (name, _) => format!("ND_{name}_{kind}"),
    }
}

fn usd_type(kind: &str) -> Option<&'static str> {
    Some(match kind {
        "float" => "float",
        "integer" => "int",
        "boolean" => "bool",
        "color3" => "color3f",
        "color4" => "color4f",
        "vector2" => "float2",
        "vector3" => "float3",
        "vector4" => "float4",
        "string" => "string",
        "filename" => "asset",
        _ => return None,
    })
}

fn components(kind: &str) -> usize {
    match kind {
        "float2" => 2,
        "color3f" | "float3" => 3,
        "color4f" | "float4" => 4,
        _ => 1,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn graphs_are_flattened_into_the_material() {
        let text = r#"<materialx version="1.38" colorspace="lin_rec709" fileprefix="maps/">
            <nodegraph name="NG"><image name="i" type="color3"><input name="file" type="filename" value="a.png" colorspace="srgb_texture"/></image>
              <output name="o" type="color3" nodename="i"/></nodegraph>
            <standard_surface name="S" type="surfaceshader"><input name="base" type="float" value="0.5"/>
              <input name="base_color" type="color3" nodegraph="NG" output="o"/><input name="coat_color" type="color3" value="1, 0.5 0"/></standard_surface>
            <surfacematerial name="M 1" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
          </materialx>"#;
        let (layer, problems) = convert(text, Path::new("/d/doc.mtlx")).expect("converts");
        assert!(problems.is_empty(), "{problems:?}");
        for part in [
            "def Material \"M_1\"",
            "outputs:mtlx:surface.connect = </MaterialX/Materials/M_1/S.outputs:out>",
            "info:id = \"ND_standard_surface_surfaceshader\"",
            "float inputs:base = 0.5",
            "color3f inputs:base_color.connect = </MaterialX/Materials/M_1/NG__i.outputs:out>",
            "color3f inputs:coat_color = (1, 0.5, 0) (\ncolorSpace = \"lin_rec709\"\n)",
            "asset inputs:file = @/d/maps/a.png@ (\ncolorSpace = \"srgb_texture\"\n)",
        ] {
            assert!(layer.contains(part), "{part}\n{layer}");
        }
    }

    #[test]
    fn circles_and_gaps_end() {
        let text = r#"<materialx><add name="a" type="float"><input name="in1" type="float" nodename="a"/><input name="in2" type="float" value="x"/></add>
            <gltf_pbr name="S" type="surfaceshader"><input name="roughness" type="float" nodename="a"/><input name="ior" type="float" nodename="no"/></gltf_pbr>
            <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial></materialx>"#;
        let (layer, problems) = convert(text, Path::new("doc.mtlx")).expect("converts");
        assert_eq!(problems.len(), 1);
        assert!(layer.contains("ND_add_float") && !layer.contains("inputs:ior"));
        assert!(convert("<other/>", Path::new("doc.mtlx")).is_err());
    }
}
