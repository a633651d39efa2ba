//! A document's materials as the text of a USD layer.

use super::follow::{Place, Setting};
use super::value::usd_type;
use crate::material::xml::{self, Element};
use std::fmt::Write as _;
use std::path::Path;

/// Longest chain of nodes.
const MAX_CHAIN: usize = 200;

/// A document's materials as the text of a USD layer, and what is left out.
pub(super) fn convert(text: &str, file: &Path) -> Result<(String, Vec<String>), String> {
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

/// Writes shaders, and remembers what is left out.
pub(super) struct Writer<'d> {
    pub(super) document: &'d Element,
    pub(super) folder: String,
    problems: Vec<String>,
}

/// A name that a prim or an attribute may have.
pub(super) fn identifier(name: &str) -> String {
    let plain: String = name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
    if plain.starts_with(|c: char| c.is_ascii_digit()) { format!("_{plain}") } else { plain }
}

/// A quoted string of the text format.
pub(super) fn quoted(text: &str) -> String {
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
        // Closures and surfaces have the type in their name, or no type there.
        ("mix" | "add" | "layer", "BSDF" | "EDF") => format!("ND_{}_{}", node.name, kind.to_ascii_lowercase()),
        ("multiply", "BSDF" | "EDF") => {
            let factor = if input("in2") == "color3" { 'C' } else { 'F' };
            format!("ND_multiply_{}{factor}", kind.to_ascii_lowercase())
        }
        (name, "BSDF" | "EDF") => format!("ND_{name}"),
        ("surface" | "surface_unlit", _) => format!("ND_{}", node.name),
        ("combine2", "color4") => "ND_combine2_color4CF".to_owned(),
        ("combine2", "vector4") if input("in1") == "vector2" => "ND_combine2_vector4VV".to_owned(),
        ("combine2", "vector4") => "ND_combine2_vector4VF".to_owned(),
        (name, _) => format!("ND_{name}_{kind}"),
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
