//! UsdRender's variables: which passes of gonio they are, and the layers of files that they become.

use crate::context::Context;
use crate::prim::Prim;
use crate::render_settings::{RenderVariable, Source};
use gonio::film::{Image, Layer};
use gonio::scene::{AMBIENT_OCCLUSION, Aov, EYE_NORMAL, EYE_POSITION, LightPath, MatteKind, PRIMVARS, Settings, ShaderValue};

/// Reads a variable; `None`, with a report, for those that gonio does not have.
pub(crate) fn read<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> Option<RenderVariable> {
    let stated: String = context.get(prim, "sourceName").unwrap_or_default();
    let kind: String = context.get(prim, "sourceType").unwrap_or_default();
    let name = prim.name();
    let stated = if stated.is_empty() { name.clone() } else { stated };
    let source = match kind.as_str() {
        "lpe" => light_path(&stated),
        "primvar" => Some(Source::Shader(value_kind(context, prim), format!("{PRIMVARS}{}", stated.trim_start_matches(PRIMVARS)))),
        _ if stated.starts_with(PRIMVARS) => Some(Source::Shader(value_kind(context, prim), stated.clone())),
        _ => raw(&stated),
    };
    if source.is_none() {
        let kind = if kind.is_empty() { "raw" } else { &kind };
        let problem = if kind == "lpe" { gonio::scene::light_path(&stated).err() } else { None };
        let problem = problem.map(|problem| format!(": {problem}")).unwrap_or_default();
        context.unsupported(&format!("the render variable '{stated}' ({kind}){problem}"), &prim.origin());
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
        "Neye" | "Ncam" => Some(Source::Shader(ShaderValue::Color, EYE_NORMAL.to_owned())),
        "Peye" | "Pcam" => Some(Source::Shader(ShaderValue::Color, EYE_POSITION.to_owned())),
        AMBIENT_OCCLUSION => Some(Source::Shader(ShaderValue::Number, name.to_owned())),
        name => MatteKind::by_name(name).map(Source::Cryptomatte).or_else(|| aov_by_name(name).map(Source::Pass)),
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
        "motionvector" | "motionvectors" | "motionVector" | "motionVectors" | "Vector" => Aov::Motion,
        other => return Aov::by_name(other),
    })
}

/// The pass of a light path expression, if gonio can show it.
fn light_path(expression: &str) -> Option<Source> {
    match gonio::scene::light_path(expression).ok()? {
        // With coverage.
        LightPath::Classes(LightPath::ALL) => Some(Source::Pass(Aov::Color)),
        _ => Some(Source::LightPath(expression.to_owned())),
    }
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

/// The passes that a variable's layers are, entered in the settings.
fn passes(settings: &mut Settings, variable: &RenderVariable) -> Vec<Aov> {
    match &variable.source {
        Source::Pass(aov) => vec![*aov],
        Source::LightPath(expression) => settings.light_path_pass(expression).into_iter().collect(),
        Source::Shader(kind, name) => settings.shader_pass(*kind, name).into_iter().collect(),
        Source::Cryptomatte(kind) => settings.matte_layers(*kind).collect(),
    }
}

/// The layers of a picture that variables name, in their order, with their names.
pub fn layers(image: &Image, settings: &Settings, variables: &[RenderVariable]) -> Vec<Layer> {
    let mut settings = settings.clone();
    let mut layers: Vec<Layer> = Vec::with_capacity(variables.len());
    for variable in variables {
        let passes = passes(&mut settings, variable);
        if let Source::Cryptomatte(_) = variable.source {
            layers.extend(
                passes.iter().enumerate().filter_map(|(number, aov)| {
                    Some(Layer { name: format!("{}{number:02}", variable.name), ..image.layer(*aov)?.clone() })
                }),
            );
            continue;
        }
        let found = layer(image, &passes, variable);
        // These have one name in files, whatever the variable is called.
        let is_there =
            |new: &Layer| matches!(new.aov, Aov::Color | Aov::Luminance | Aov::Illuminance) && layers.iter().any(|l| l.aov == new.aov);
        layers.extend(found.filter(|new| !is_there(new)));
    }
    layers
}

fn layer(image: &Image, passes: &[Aov], variable: &RenderVariable) -> Option<Layer> {
    let pass = image.layer(*passes.first()?)?;
    // A lone channel must not be called as one of the colour's.
    let is_taken = pass.channels == 1 && ["R", "G", "B", "A"].contains(&variable.name.as_str());
    Some(if is_taken { pass.clone() } else { Layer { name: variable.name.clone(), ..pass.clone() } })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn passes_have_the_names_of_other_renderers() {
        assert_eq!(aov_by_name("Ci"), Some(Aov::Color));
        assert_eq!(aov_by_name("cameraDepth"), Some(Aov::Depth));
        assert_eq!(raw("Neye"), Some(Source::Shader(ShaderValue::Color, EYE_NORMAL.into())));
        assert_eq!(raw("crypto_object"), Some(Source::Cryptomatte(MatteKind::Object)));
        assert_eq!(raw("something else"), None);
    }

    #[test]
    fn light_path_expressions_are_passes() {
        assert_eq!(light_path("lpe:C.*[LO]"), Some(Source::Pass(Aov::Color)));
        assert_eq!(light_path("C<RD>[<L.>O]"), Some(Source::LightPath("C<RD>[<L.>O]".into())));
        assert_eq!(light_path("C.*<L.'key'>"), Some(Source::LightPath("C.*<L.'key'>".into())));
        assert_eq!(light_path("C<RD><RD>L"), Some(Source::LightPath("C<RD><RD>L".into())));
        for other in ["C<RD>", "", "C<RD'skin'>L"] {
            assert_eq!(light_path(other), None, "{other}");
        }
    }
}
