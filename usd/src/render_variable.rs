//! UsdRender's variables: which passes of gonio they are, and the layers of files that they become.

use crate::context::Context;
use crate::prim::Prim;
use gonio::film::{Image, Layer};
use gonio::scene::{
    Aov, Camera, Channel, Graph, Input, LightPart, Material, Operation, ScatteringKind, Scene, Settings, ShaderOutput, ShaderValue,
};

/// What a variable shows.
#[derive(Clone, Debug, PartialEq)]
pub enum Source {
    /// A pass.
    Pass(Aov),
    /// Light by the kind of its first scattering, the colour of the surface included: the sum of these parts.
    Light(ScatteringKind, Vec<LightPart>),
    /// A primvar of the first surface.
    Primvar(ShaderValue, String),
    /// The shading normal in the camera's space (+z towards the eye).
    EyeNormal,
    /// The position in the camera's space, metres.
    EyePosition,
}

/// A `RenderVar` prim.
#[derive(Clone, Debug, PartialEq)]
pub struct RenderVariable {
    /// The name of its layer in files.
    pub name: String,
    /// What it shows.
    pub source: Source,
    /// Whether files have it in half floats.
    pub half: bool,
}

/// Reads a variable; `None`, with a report, for those that gonio does not have.
pub(crate) fn read<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> Option<RenderVariable> {
    let stated: String = context.get(prim, "sourceName").unwrap_or_default();
    let kind: String = context.get(prim, "sourceType").unwrap_or_default();
    let name = prim.name();
    let stated = if stated.is_empty() { name.clone() } else { stated };
    let source = match kind.as_str() {
        "lpe" => light_path(&stated),
        "primvar" => Some(Source::Primvar(value_kind(context, prim), stated.clone())),
        _ => match stated.strip_prefix("primvars:") {
            Some(primvar) => Some(Source::Primvar(value_kind(context, prim), primvar.to_owned())),
            None => raw(&stated),
        },
    };
    if source.is_none() {
        context.unsupported(&format!("the render variable '{stated}' ({})", if kind.is_empty() { "raw" } else { &kind }), &prim.origin());
    }
    source.map(|source| RenderVariable { name, source, half: is_half(context, prim) })
}

/// Whether the variable's type is one of halves, as `color3h`, `half` and `float16` are.
fn is_half<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> bool {
    let kind: String = context.get_authored(prim, "dataType").unwrap_or_default();
    kind.starts_with("half") || kind.ends_with("16") || kind.strip_suffix('h').is_some_and(|kind| kind.ends_with(['2', '3', '4']))
}

fn value_kind<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> ShaderValue {
    let kind: String = context.get(prim, "dataType").unwrap_or_default();
    if matches!(kind.as_str(), "float" | "half" | "double" | "int" | "uint" | "bool") { ShaderValue::Number } else { ShaderValue::Color }
}

fn raw(name: &str) -> Option<Source> {
    match name {
        "Neye" | "Ncam" => Some(Source::EyeNormal),
        "Peye" | "Pcam" => Some(Source::EyePosition),
        name => aov_by_name(name).map(Source::Pass),
    }
}

/// The pass by the names that renderers give it.
pub fn aov_by_name(name: &str) -> Option<Aov> {
    Some(match name {
        "color" | "Color" | "Ci" | "C" | "rgba" | "RGBA" | "beauty" => Aov::Color,
        "a" | "A" | "alpha" | "Alpha" => Aov::Alpha,
        "z" | "Z" | "depth" | "Depth" | "cameraDepth" => Aov::Depth,
        "N" | "Nn" | "normal" | "Normal" | "Nworld" => Aov::Normal,
        "P" | "position" | "Position" | "Pworld" => Aov::P,
        "st" => Aov::Uv,
        other => return Aov::by_name(other),
    })
}

/// Light path expressions of one scattering kind: `C<RD>` and its like, then whether light comes straight, from other surfaces, or both.
fn light_path(expression: &str) -> Option<Source> {
    use LightPart::{Direct, Indirect};
    let path: String = expression.trim().trim_start_matches("lpe:").split_whitespace().collect();
    if matches!(path.as_str(), "C.*" | "C.*[LO]" | "C.*[<L.>O]" | "C.*<L.>" | "C.*L" | "C[LO]|C.*[LO]") {
        return Some(Source::Pass(Aov::Color));
    }
    if matches!(path.as_str(), "CO" | "C[O]" | "C<O>" | "C<O.>") {
        return Some(Source::Pass(Aov::Emission));
    }
    const KINDS: [(ScatteringKind, &[&str]); 3] = [
        (ScatteringKind::Diffuse, &["<RD>", "<.D>", "D"]),
        (ScatteringKind::Glossy, &["<R[SG]>", "<R[GS]>", "<RS>", "<RG>", "<.S>", "<.G>", "[SG]", "[GS]", "S", "G"]),
        (ScatteringKind::Transmission, &["<T[SG]>", "<T[GS]>", "<T.>", "<TS>", "<TG>", "<TD>"]),
    ];
    let path = path.strip_prefix('C')?;
    let found = KINDS.iter().find_map(|(kind, names)| names.iter().find_map(|name| Some((*kind, path.strip_prefix(name)?))));
    let (kind, rest) = found?;
    let parts = match rest {
        "L" | "<L.>" | "[<L.>]" | "[LO]" | "[OL]" | "[<L.>O]" | "[O<L.>]" => vec![Direct],
        ".+L" | ".+<L.>" | ".+[LO]" | ".+[<L.>O]" | "..*L" | "..*<L.>" | "..*[<L.>O]" => vec![Indirect],
        ".*L" | ".*<L.>" | ".*[LO]" | ".*[<L.>O]" => vec![Direct, Indirect],
        _ => return None,
    };
    Some(Source::Light(kind, parts))
}

/// Asks for the passes of variables in place of those that are set. Where there are none, the settings stay.
pub fn ask_for_passes(settings: &mut Settings, variables: &[RenderVariable]) {
    if variables.is_empty() {
        return;
    }
    settings.aovs.clear();
    for variable in variables {
        for aov in passes(settings, variable) {
            if !settings.aovs.contains(&aov) {
                settings.aovs.push(aov);
            }
        }
    }
}

/// The passes that a variable's layer is made of; shader passes are entered in the settings.
fn passes(settings: &mut Settings, variable: &RenderVariable) -> Vec<Aov> {
    let mut shader = |kind, name: &str| {
        let names = &mut settings.shader_passes;
        let number = names.iter().position(|known| known == name).unwrap_or(names.len());
        if number == names.len() {
            names.push(name.to_owned());
        }
        vec![Aov::Shader(kind, number as u16)]
    };
    match &variable.source {
        Source::Pass(aov) => vec![*aov],
        Source::Light(kind, parts) => parts.iter().chain([&LightPart::Color]).map(|part| Aov::Light(*kind, *part)).collect(),
        Source::Primvar(kind, name) => shader(*kind, name),
        Source::EyeNormal => shader(ShaderValue::Color, EYE_NORMAL),
        Source::EyePosition => shader(ShaderValue::Color, EYE_POSITION),
    }
}

/// Names of the shader passes in the camera's space.
const EYE_NORMAL: &str = "Neye";
const EYE_POSITION: &str = "Peye";

/// Gives all materials the outputs that variables show; to be called when the camera is chosen.
pub fn add_shader_outputs(scene: &mut Scene, variables: &[RenderVariable]) {
    let camera = scene.cameras.get(scene.settings.camera as usize).cloned().unwrap_or_default();
    for variable in variables {
        for material in &mut scene.materials {
            let graph = &mut material.graph;
            let (name, output) = match &variable.source {
                Source::Primvar(_, name) => {
                    (name.as_str(), graph.add(Operation::Primvar { name: name.clone(), fallback: [0.0; 4] }, Vec::new()))
                }
                Source::EyeNormal => (EYE_NORMAL, to_eye(graph, Operation::Normal, &camera, false)),
                Source::EyePosition => (EYE_POSITION, to_eye(graph, Operation::Position, &camera, true)),
                Source::Pass(_) | Source::Light(..) => continue,
            };
            set_output(material, name, output);
        }
    }
}

fn set_output(material: &mut Material, name: &str, node: gonio::scene::NodeId) {
    // Scenes that are looked at by one camera after the other have earlier ones.
    material.shader_outputs.retain(|output| output.name != name);
    let (color, value) = (Input::Node(node, Channel::Rgb), Input::Node(node, Channel::R));
    material.shader_outputs.push(ShaderOutput { name: name.to_owned(), color, value });
}

/// A node's value carried from the world to the camera's space.
fn to_eye(graph: &mut Graph, operation: Operation, camera: &Camera, is_point: bool) -> gonio::scene::NodeId {
    let columns = camera.transform.columns;
    let rows = std::array::from_fn(|axis| {
        let length = columns[axis].iter().map(|x| x * x).sum::<f64>().sqrt();
        let unit = columns[axis].map(|x| if length > 0.0 { x / length } else { 0.0 });
        let offset: f64 = if is_point { -(0..3).map(|i| unit[i] * columns[3][i]).sum::<f64>() } else { 0.0 };
        [unit[0] as f32, unit[1] as f32, unit[2] as f32, offset as f32]
    });
    let world = graph.add(operation, Vec::new());
    graph.add(Operation::Transform3d { rows }, vec![Input::Node(world, Channel::Rgb)])
}

/// The layers of a picture that variables name, in their order, with their names.
pub fn layers(image: &Image, settings: &Settings, variables: &[RenderVariable]) -> Vec<Layer> {
    let mut settings = settings.clone();
    let mut layers: Vec<Layer> = Vec::with_capacity(variables.len());
    for variable in variables {
        let found = layer(image, &passes(&mut settings, variable), variable);
        // These have one name in files, whatever the variable is called.
        let is_there =
            |new: &Layer| matches!(new.aov, Aov::Color | Aov::Luminance | Aov::Illuminance) && layers.iter().any(|l| l.aov == new.aov);
        layers.extend(found.filter(|new| !is_there(new)));
    }
    layers
}

fn layer(image: &Image, passes: &[Aov], variable: &RenderVariable) -> Option<Layer> {
    let parts: Vec<&Layer> = passes.iter().filter_map(|aov| image.layer(*aov)).collect();
    let Source::Light(..) = variable.source else {
        let pass = *parts.first()?;
        // A lone channel must not be called as one of the colour's.
        let is_taken = pass.channels == 1 && ["R", "G", "B", "A"].contains(&variable.name.as_str());
        return Some(if is_taken { pass.clone() } else { Layer { name: variable.name.clone(), ..pass.clone() } });
    };
    // Light passes are divided by the colour, which is the last.
    let (colour, lights) = parts.split_last()?;
    let values = colour.values.iter().enumerate().map(|(at, colour)| colour * lights.iter().map(|light| light.values[at]).sum::<f32>());
    Some(Layer { aov: passes[0], name: variable.name.clone(), values: values.collect(), channels: colour.channels })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn passes_have_the_names_of_other_renderers() {
        assert_eq!(aov_by_name("Ci"), Some(Aov::Color));
        assert_eq!(aov_by_name("cameraDepth"), Some(Aov::Depth));
        assert_eq!(raw("Neye"), Some(Source::EyeNormal));
        assert_eq!(raw("something else"), None);
    }

    #[test]
    fn light_paths_are_of_one_kind() {
        use LightPart::{Direct, Indirect};
        assert_eq!(light_path("lpe:C.*[LO]"), Some(Source::Pass(Aov::Color)));
        assert_eq!(light_path("C<RD>[<L.>O]"), Some(Source::Light(ScatteringKind::Diffuse, vec![Direct])));
        assert_eq!(light_path("C<RD>.+[<L.>O]"), Some(Source::Light(ScatteringKind::Diffuse, vec![Indirect])));
        assert_eq!(light_path("C<R[SG]> .* L"), Some(Source::Light(ScatteringKind::Glossy, vec![Direct, Indirect])));
        assert_eq!(light_path("C<TS>[LO]"), Some(Source::Light(ScatteringKind::Transmission, vec![Direct])));
        for other in ["C<RD><RD>L", "C<RD>", "", "C<L.'key'>", "CDDL"] {
            assert_eq!(light_path(other), None, "{other}");
        }
    }
}
