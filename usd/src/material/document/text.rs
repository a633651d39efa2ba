//! A document's materials as the text of a USD layer.

use super::include;
use crate::material::definition::expand;
use crate::material::library::Library;
use crate::material::mtlx::{self, Stated};
use crate::material::neutral::{Document, Node, NodeIndex, Said, Source, Value};
use crate::material::xml::{self, Element};
use std::collections::HashSet;
use std::fmt::Write as _;
use std::path::Path;

/// How the names of the definitions of a material of a surface begin.
const SURFACE_MATERIAL: &str = "ND_surfacematerial";

/// A document as a layer.
pub(super) struct Converted {
    /// The text of the layer.
    pub(super) layer: String,
    /// What is left out.
    pub(super) problems: Vec<String>,
    /// What the document defines.
    pub(super) library: Library,
}

/// A document's materials as the text of a USD layer; nodes are named by the standard library where it is at hand.
pub(super) fn convert(text: &str, file: &Path, standard: Option<&Library>) -> Result<Converted, String> {
    let mut document = xml::parse(text).map_err(|error| format!("line {}: {}", error.line, error.problem))?;
    if document.name != "materialx" {
        return Err(format!("the root element is <{}>, expected <materialx>", document.name));
    }
    let mut problems = Vec::new();
    include::expand(&mut document, file, &mut problems);
    let folder = file.parent().unwrap_or(Path::new("")).to_string_lossy().into_owned();
    let stated = Stated { document: &document, graph: None, folder: &folder };
    let library = Library::of(&[stated]);
    let libraries: Vec<&Library> = std::iter::once(&library).chain(standard).collect();
    let mut materials = String::new();
    for child in &document.children {
        match child.name.as_str() {
            "surfacematerial" | "volumematerial" => materials += &material(child, stated, &libraries, &mut problems),
            "material" => {
                problems.push(format!("<{}> in MaterialX documents is not supported, it is left out", child.name));
            }
            _ if child.attribute("type") == Some("material") => {
                materials += &defined_material(child, stated, &libraries, &mut problems);
            }
            _ => {}
        }
    }
    let layer = format!(
        "#usda 1.0\n(\n    defaultPrim = \"MaterialX\"\n)\ndef Scope \"MaterialX\"\n{{\ndef Scope \"Materials\"\n{{\n{materials}}}\n}}\n"
    );
    Ok(Converted { layer, problems, library })
}

/// A name that a prim or an attribute may have.
fn identifier(name: &str) -> String {
    let plain: String = name.replace('/', "__").chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
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

/// What materials read, by MaterialX's and by USD's names.
const TERMINALS: [(&str, &str); 3] = [("surfaceshader", "surface"), ("volumeshader", "volume"), ("displacementshader", "displacement")];

/// A material prim with the shaders that it reads; empty, with a problem, where it has neither a surface nor a volume.
fn material(material: &Element, stated: Stated<'_>, libraries: &[&Library], problems: &mut Vec<String>) -> String {
    let name = identifier(material.attribute("name").unwrap_or("material"));
    let root = format!("/MaterialX/Materials/{name}");
    let (mut terminals, mut shaders, mut known) = (String::new(), String::new(), HashSet::new());
    for (input, kind) in TERMINALS {
        let Some((document, output)) = mtlx::read(stated, material, input, libraries) else { continue };
        if kind == "displacement" && terminals.is_empty() {
            continue;
        }
        // Nodes that several read are there once.
        for node in &document.nodes {
            if known.insert(node.path.clone()) {
                shaders += &shader(&root, node, &document, problems);
            }
        }
        terminals += &terminal(&root, kind, &document.nodes[0], &output);
    }
    if terminals.is_empty() {
        let missing = if material.name == "volumematerial" { "volume" } else { "surface" };
        problems.push(format!("the material '{name}' has no {missing} shader"));
        return String::new();
    }
    format!("def Material \"{name}\"\n{{\n{terminals}{shaders}}}\n")
}

/// A material that is an instance of a definition: what the surface material inside that reads; empty, with a problem, where there is none.
fn defined_material(element: &Element, stated: Stated<'_>, libraries: &[&Library], problems: &mut Vec<String>) -> String {
    let name = identifier(element.attribute("name").unwrap_or("material"));
    let root = format!("/MaterialX/Materials/{name}");
    let mut document = mtlx::read_to(stated, element, libraries);
    // Materials in one another, the innermost last.
    let mut materials = vec![NodeIndex(0)];
    let innermost = loop {
        let index = materials[materials.len() - 1];
        let id = document.node(index).id.clone();
        if id.starts_with(SURFACE_MATERIAL) {
            break index;
        }
        let definition = libraries.iter().find_map(|library| library.definition(&id)).filter(|definition| definition.body.is_some());
        let outputs = definition.map_or(Ok(Vec::new()), |definition| expand(&mut document, index, &definition));
        match outputs.as_deref() {
            Ok([(_, Source::Output(inner, _)), ..]) if !materials.contains(inner) => materials.push(*inner),
            Ok(_) => {
                problems.push(format!("<{}> '{name}' is not supported, it is left out", element.name));
                return String::new();
            }
            Err(problem) => {
                problems.push(format!("the material '{name}' is left out: {problem}"));
                return String::new();
            }
        }
    };
    let mut terminals = String::new();
    for (input, kind) in TERMINALS {
        if let Source::Output(end, output) = document.node(innermost).source(input) {
            terminals += &terminal(&root, kind, document.node(end), &output);
        }
    }
    let is_shader = |index: &usize| !materials.contains(&NodeIndex(*index));
    let shaders = (0..document.nodes.len()).filter(is_shader).map(|index| shader(&root, &document.nodes[index], &document, problems));
    let shaders: String = shaders.collect();
    format!("def Material \"{name}\"\n{{\n{terminals}{shaders}}}\n")
}

/// The output of a material that is that of its shader.
fn terminal(root: &str, kind: &str, end: &Node, output: &str) -> String {
    let (end, output) = (identifier(&end.path), identifier(output));
    format!("token outputs:mtlx:{kind}.connect = <{root}/{end}.outputs:{output}>\n")
}

fn shader(root: &str, node: &Node, document: &Document, problems: &mut Vec<String>) -> String {
    let name = identifier(&node.path);
    let mut text = format!("def Shader \"{name}\"\n{{\nuniform token info:id = {}\n", quoted(&node.id));
    for port in &node.inputs {
        let input = port.name.split(':').map(identifier).collect::<Vec<_>>().join(":");
        let line = match &port.source {
            Source::Output(index, output) => {
                let (source, output) = (identifier(&document.node(*index).path), identifier(output));
                Some(format!("token inputs:{input}.connect = <{root}/{source}.outputs:{output}>"))
            }
            Source::Value(value, said) => value_line(&input, value, said),
            // What a node reads of the surface where nothing is said is its own affair.
            Source::Nothing | Source::Geometric(_) => continue,
            Source::Unreadable(problem) => {
                problems.push(format!("the input '{input}' of '{name}' is left out: {problem}"));
                continue;
            }
        };
        match line {
            Some(line) => {
                let _ = writeln!(text, "{line}");
            }
            None => problems.push(format!("the input '{input}' of '{name}' names a file that cannot be written, it is left out")),
        }
    }
    text + "token outputs:out\n}\n"
}

/// An input with its value; `None` for files that the text format cannot name.
fn value_line(input: &str, value: &Value, said: &Said) -> Option<String> {
    let joined = |numbers: &[f32]| numbers.iter().map(f32::to_string).collect::<Vec<_>>().join(", ");
    let (kind, text) = match value {
        Value::Numbers(values, 1) => ("float", joined(&values[..1])),
        Value::Numbers(values, count) => {
            let kind = match (said.is_colour, count) {
                (true, 3) => "color3f",
                (true, _) => "color4f",
                (false, 2) => "float2",
                (false, 3) => "float3",
                (false, _) => "float4",
            };
            (kind, format!("({})", joined(&values[..*count])))
        }
        Value::Matrix(rows, side) => {
            let rows: Vec<String> = rows[..*side].iter().map(|row| format!("({})", joined(&row[..*side]))).collect();
            (if *side == 3 { "matrix3d" } else { "matrix4d" }, format!("({})", rows.join(", ")))
        }
        Value::Text(text) => ("string", quoted(text)),
        Value::Asset(path) => {
            // Absolute: layers in memory have no place.
            let place = if path.resolved.is_empty() { &path.authored } else { &path.resolved };
            ("asset", (!place.contains('@') && !place.contains('\n')).then(|| format!("@{place}@"))?)
        }
    };
    Some(format!("{kind} inputs:{input} = {text}{}", metadata(said)))
}

/// The colour space and the unit of a value.
fn metadata(said: &Said) -> String {
    let mut lines = String::new();
    if !said.space.is_empty() {
        let _ = writeln!(lines, "colorSpace = {}", quoted(&said.space));
    }
    if !said.unit.is_empty() {
        let _ = writeln!(lines, "customData = {{\nstring unit = {}\n}}", quoted(&said.unit));
    }
    if lines.is_empty() { lines } else { format!(" (\n{lines})") }
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
        let Converted { layer, problems, .. } = convert(text, Path::new("/d/doc.mtlx"), None).expect("converts");
        assert!(problems.is_empty(), "{problems:?}");
        for part in [
            "def Material \"M_1\"",
            "outputs:mtlx:surface.connect = </MaterialX/Materials/M_1/S.outputs:out>",
            "info:id = \"ND_standard_surface_surfaceshader\"",
            "float inputs:base = 0.5",
            "token inputs:base_color.connect = </MaterialX/Materials/M_1/NG__i.outputs:out>",
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
        let Converted { layer, problems, .. } = convert(text, Path::new("doc.mtlx"), None).expect("converts");
        assert_eq!(problems.len(), 2, "{problems:?}");
        assert!(problems.iter().any(|problem| problem.contains("the node 'no'")), "{problems:?}");
        assert!(layer.contains("ND_add_float") && !layer.contains("inputs:ior"));
        assert!(convert("<other/>", Path::new("doc.mtlx"), None).is_err());
    }
}
