//! Documents translated without `pxr`: values that fold, definitions put in place, and input that is meant to do harm.

use super::definition::Definition;
use super::host::Host;
use super::library::Library;
use super::mtlx::{self, Stated};
use super::network::Network;
use super::neutral::{NodeIndex, Said, Value};
use super::{surface, xml};
use crate::vt::AssetPath;
use gonio::scene::{Closure, Graph, Input, MeasuredId, TextureId};
use std::path::Path;
use std::sync::Arc;

/// A reader without a stage: it keeps what it is told.
#[derive(Default)]
struct Desk {
    told: Vec<String>,
    libraries: Vec<Arc<Library>>,
    files: Vec<String>,
    once: Vec<(&'static str, String)>,
}

impl Host for Desk {
    fn warn(&mut self, path: &str, message: String) {
        self.told.push(format!("{path}: {message}"));
    }
    fn once(&mut self, kind: &'static str, name: &str, path: &str, message: String) {
        let key = (kind, name.to_owned());
        if !self.once.contains(&key) {
            self.once.push(key);
            self.warn(path, message);
        }
    }
    fn unsupported(&mut self, feature: &str, path: &str) {
        self.warn(path, format!("{feature} is not supported"));
    }
    fn metres_per_unit(&self) -> f64 {
        0.01
    }
    fn frame(&self) -> [f64; 2] {
        [48.0, 24.0]
    }
    fn texture(&mut self, _: &str, file: &AssetPath, space: &str) -> Option<TextureId> {
        self.files.push(format!("{} {space}", file.authored));
        Some(TextureId(self.files.len() as u32 - 1))
    }
    fn measured(&mut self, _: &str, _: &AssetPath) -> Option<MeasuredId> {
        None
    }
    fn text_of_primvar(&mut self, _: &str) -> Option<(Value, Said)> {
        None
    }
    fn definition(&mut self, name: &str) -> Option<Arc<Definition>> {
        self.libraries.iter().find_map(|library| library.definition(name))
    }
    fn lacks_library(&mut self) -> bool {
        self.libraries.len() < 2
    }
}

/// The closures of the document's material `M`.
fn translated(body: &str, desk: &mut Desk) -> (Vec<Closure>, Graph) {
    let text = format!(
        r#"<materialx version="1.39" colorspace="lin_rec709">{body}
        <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial></materialx>"#
    );
    let document = xml::parse(&text).expect("well formed");
    let stated = Stated { document: &document, graph: None, folder: "/none" };
    let library = Arc::new(Library::of(&[stated]));
    desk.libraries.insert(0, library);
    let libraries: Vec<&Library> = desk.libraries.iter().map(|library| &**library).collect();
    let material = document.child_called("M").expect("a material");
    let (network, _) = mtlx::read(stated, material, "surfaceshader", &libraries).expect("a surface");
    let mut network = Network::new(desk, network);
    let shader = network.shader(NodeIndex(0));
    let closures = surface::convert(&mut network, &shader).unwrap_or_default();
    (closures, network.graph)
}

/// What is emitted by an unlit surface whose colour is the node `N`.
fn value(nodes: &str, desk: &mut Desk) -> Input {
    let surface =
        r#"<surface_unlit name="S" type="surfaceshader"><input name="emission_color" type="color3" nodename="N"/></surface_unlit>"#;
    let (closures, _) = translated(&(nodes.to_owned() + surface), desk);
    closures[0].input("emission_color").expect("a colour")
}

/// A node `N` whose inputs are name, type and value, and what it must give.
type Case = (&'static str, &'static str, &'static [(&'static str, &'static str, &'static str)], [f32; 3]);

const CASES: &[Case] = &[
    ("modulo", "color3", &[("in1", "color3", "-0.25, 1.75, 3"), ("in2", "color3", "1, 0.5, 2")], [0.75, 0.25, 1.0]),
    ("ceil", "color3", &[("in", "color3", "-0.25, 1.75, 3")], [0.0, 2.0, 3.0]),
    ("power", "color3", &[("in1", "color3", "-2, 2, 0.5"), ("in2", "float", "2")], [4.0, 4.0, 0.25]),
    ("safepower", "color3", &[("in1", "color3", "-4, 4, 0"), ("in2", "float", "0.5")], [-2.0, 2.0, 0.0]),
    (
        "ifgreater",
        "color3",
        &[("value1", "float", "2"), ("value2", "float", "2"), ("in1", "color3", "1,1,1"), ("in2", "color3", "3,4,5")],
        [3.0, 4.0, 5.0],
    ),
    ("ifgreatereq", "color3", &[("value1", "float", "2"), ("value2", "float", "2"), ("in1", "color3", "1,2,3")], [1.0, 2.0, 3.0]),
    ("ifequal", "color3", &[("value1", "float", "2"), ("value2", "float", "3"), ("in1", "color3", "1,2,3")], [0.0, 0.0, 0.0]),
    ("switch", "color3", &[("in1", "color3", "1,1,1"), ("in3", "color3", "3,4,5"), ("which", "float", "2.5")], [3.0, 4.0, 5.0]),
    ("burn", "color3", &[("fg", "color3", "0, 0.5, 2"), ("bg", "color3", "0.5, 0.75, 0.5"), ("mix", "float", "1")], [0.0, 0.5, 0.75]),
    ("dodge", "color3", &[("fg", "color3", "1, 0.5, 0"), ("bg", "color3", "0.5, 0.25, 0.5"), ("mix", "float", "1")], [0.0, 0.5, 0.5]),
    (
        "overlay",
        "color3",
        &[("fg", "color3", "0.5, 0.5, 1"), ("bg", "color3", "0.25, 0.75, 0.5"), ("mix", "float", "1")],
        [0.25, 0.75, 1.0],
    ),
    ("remap", "color3", &[("in", "color3", "0.5, 1, 0"), ("outlow", "float", "1"), ("outhigh", "float", "3")], [2.0, 3.0, 1.0]),
    ("range", "color3", &[("in", "color3", "0.25, 4, 0"), ("gamma", "float", "2"), ("doclamp", "boolean", "true")], [0.5, 1.0, 0.0]),
    ("smoothstep", "color3", &[("in", "color3", "0.5, -1, 9")], [0.5, 0.0, 1.0]),
    ("saturate", "color3", &[("in", "color3", "1, 0, 0"), ("amount", "float", "0")], [0.272_228_7; 3]),
    ("rotate3d", "vector3", &[("in", "vector3", "1, 0, 0"), ("amount", "float", "90"), ("axis", "vector3", "0, 0, 2")], [0.0, -1.0, 0.0]),
    ("transformmatrix", "vector3", &[("in", "vector3", "1, 2, 3"), ("mat", "matrix33", "0,1,0, 0,0,1, 1,0,0")], [3.0, 1.0, 2.0]),
    ("time", "float", &[], [2.0; 3]),
    ("blackbody", "color3", &[("temperature", "float", "6500")], [1.014_4, 0.998_2, 0.995_6]),
    ("deon_hair_absorption_from_melanin", "vector3", &[], [0.087_17, 0.157_79, 0.348_09]),
    ("chiang_hair_absorption_from_color", "vector3", &[("color", "color3", "0.5, 0.2, 0.1")], [0.013_57, 0.073_16, 0.149_74]),
    ("roughness_dual", "vector2", &[("roughness", "vector2", "0.5, -1")], [0.25, 0.25, 0.0]),
];

#[test]
fn constants_fold_to_what_the_nodes_mean() {
    for (node, kind, inputs, expected) in CASES {
        let inputs: String =
            inputs.iter().map(|(name, kind, value)| format!(r#"<input name="{name}" type="{kind}" value="{value}"/>"#)).collect();
        let mut desk = Desk::default();
        let Input::Constant(found) = value(&format!(r#"<{node} name="N" type="{kind}">{inputs}</{node}>"#), &mut desk) else {
            panic!("{node} is not constant");
        };
        for (found, expected) in found.iter().zip(expected) {
            assert!(
                (found - expected).abs() < 2e-3 * (1.0 + expected.abs()) * if *node == "blackbody" { 20.0 } else { 1.0 },
                "{node}: {found} {expected}"
            );
        }
        assert!(desk.told.is_empty(), "{node}: {:?}", desk.told);
    }
}

#[test]
fn a_documents_own_definitions_are_put_in_place() {
    let nodes = r#"
        <nodedef name="ND_twice" node="twice"><input name="in" type="color3" value="0.5, 0.5, 0.5"/><input name="by" type="float" value="2"/>
          <output name="out" type="color3"/><output name="half" type="color3"/></nodedef>
        <nodegraph name="NG_twice" nodedef="ND_twice">
          <multiply name="m" type="color3"><input name="in1" type="color3" interfacename="in"/><input name="in2" type="float" interfacename="by"/></multiply>
          <divide name="d" type="color3"><input name="in1" type="color3" interfacename="in"/><input name="in2" type="float" interfacename="by"/></divide>
          <output name="out" type="color3" nodename="m"/><output name="half" type="color3" nodename="d"/></nodegraph>
        <twice name="A" type="multioutput"><input name="by" type="float" value="4"/></twice>
        <add name="N" type="color3"><input name="in1" type="color3" nodename="A" output="half"/><input name="in2" type="color3" nodename="B"/></add>
        <twice name="B" type="color3"><input name="in" type="color3" nodename="A" output="out"/></twice>"#;
    let mut desk = Desk::default();
    assert_eq!(value(nodes, &mut desk), Input::Constant([4.125, 4.125, 4.125, 8.25]));
    assert!(desk.told.is_empty(), "{:?}", desk.told);
}

#[test]
fn circles_end_with_a_word() {
    let circle = r#"<add name="N" type="color3"><input name="in1" type="color3" nodename="N"/></add>"#;
    let inside = r#"<nodedef name="ND_me" node="me"><output name="out" type="color3"/></nodedef>
        <nodegraph name="NG_me" nodedef="ND_me"><me name="m" type="color3"/><output name="out" type="color3" nodename="m"/></nodegraph>
        <me name="N" type="color3"/>"#;
    let twice = r#"<nodedef name="ND_me" node="me"><input name="in" type="color3" value="1,1,1"/><output name="out" type="color3"/></nodedef>
        <nodegraph name="NG_me" nodedef="ND_me"><me name="a" type="color3"/><me name="b" type="color3"/>
          <add name="c" type="color3"><input name="in1" type="color3" nodename="a"/><input name="in2" type="color3" nodename="b"/></add>
          <output name="out" type="color3" nodename="c"/></nodegraph><me name="N" type="color3"/>"#;
    let graph = r#"<nodegraph name="G"><output name="o" type="color3" nodegraph="G" output="o"/></nodegraph>
        <dot name="N" type="color3"><input name="in" type="color3" nodegraph="G" output="o"/></dot>"#;
    for nodes in [circle, inside, twice, graph] {
        let mut desk = Desk::default();
        value(nodes, &mut desk);
        assert!(!desk.told.is_empty(), "{nodes}");
        assert!(desk.told.len() < 20, "{}", desk.told.len());
    }
}

#[test]
fn ten_thousand_nodes_are_read_and_bounded() {
    let chain = |count: usize| -> String {
        (0..count)
            .map(|i| format!(r#"<add name="n{i}" type="color3"><input name="in1" type="color3" nodename="n{}"/></add>"#, i + 1))
            .collect()
    };
    let mut desk = Desk::default();
    let nodes = chain(10_000) + r#"<dot name="N" type="color3"><input name="in" type="color3" nodename="n0"/></dot>"#;
    value(&nodes, &mut desk);
    assert!(desk.told.iter().any(|told| told.contains("too deep")), "{:?}", desk.told.first());
    // A broad one is no trouble.
    let sums: String = (1..5000)
        .map(|i| {
            format!(
                r#"<add name="s{i}" type="color3"><input name="in1" type="color3" nodename="s{}"/><input name="in2" type="color3" nodename="s{}"/></add>"#,
                i / 2,
                i / 2
            )
        })
        .collect();
    let mut desk = Desk::default();
    let broad =
        sums + r#"<texcoord name="s0" type="color3"/><dot name="N" type="color3"><input name="in" type="color3" nodename="s4999"/></dot>"#;
    assert!(matches!(value(&broad, &mut desk), Input::Node(..)));
    assert!(desk.told.is_empty(), "{:?}", desk.told.first());
}

#[test]
fn missing_ends_and_unknown_nodes_give_defaults() {
    let mut desk = Desk::default();
    let found = value(r#"<no_such_node name="N" type="color3"/>"#, &mut desk);
    assert_eq!(found, Input::Constant([1.0; 4]));
    assert!(desk.told.iter().any(|told| told.contains("no_such_node")), "{:?}", desk.told);
    assert_eq!(desk.told.iter().filter(|told| told.contains("pip install materialx")).count(), 1, "{:?}", desk.told);
    let mut desk = Desk::default();
    let graph = r#"<nodegraph name="G"/><dot name="N" type="color3"><input name="in" type="color3" nodegraph="G" output="o"/></dot>"#;
    assert_eq!(value(graph, &mut desk), Input::Constant([0.0; 4]));
}

#[test]
fn units_become_those_of_the_stage() {
    let mut desk = Desk::default();
    let node = r#"<constant name="N" type="float"><input name="value" type="float" value="2" unittype="distance" unit="inch"/></constant>"#;
    let Input::Constant([x, ..]) = value(node, &mut desk) else { panic!("not constant") };
    assert!((x - 5.08).abs() < 1e-5, "{x}");
}

/// The standard library, where its package lies beside the sources.
fn standard_library() -> Option<Arc<Library>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent()?.join(".venv/lib");
    let versions = std::fs::read_dir(root).ok()?;
    let library = |version: std::fs::DirEntry| Library::read(&[version.path().join("site-packages/MaterialX/libraries")]);
    versions.filter_map(Result::ok).find_map(library).map(Arc::new)
}

#[test]
fn the_standard_librarys_graphs_flatten() {
    let Some(library) = standard_library() else {
        eprintln!("skipped: the package materialx is not installed in .venv");
        return;
    };
    let mut desk = Desk { libraries: vec![library], ..Desk::default() };
    let circle = r#"<circle name="N" type="float"><input name="radius" type="float" value="0.25"/></circle>"#;
    assert!(matches!(value(circle, &mut desk), Input::Node(..)), "{:?}", desk.told);
    let corrected = r#"<colorcorrect name="N" type="color3"><input name="in" type="color3" value="0.2, 0.4, 0.6"/>
        <input name="exposure" type="float" value="1"/></colorcorrect>"#;
    let Input::Constant(found) = value(corrected, &mut desk) else { panic!("not constant: {:?}", desk.told) };
    for (found, expected) in found.iter().zip([0.4, 0.8, 1.2]) {
        assert!((found - expected).abs() < 1e-5, "{found} {expected}");
    }
    assert!(desk.told.is_empty(), "{:?}", desk.told);
    let (closures, _) = translated(r#"<disney_principled name="S" type="surfaceshader"/>"#, &mut desk);
    assert!(!closures.is_empty(), "{:?}", desk.told);
}
