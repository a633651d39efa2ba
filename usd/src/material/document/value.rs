//! Values of a document in the text format of USD.

use super::follow::Place;
use super::text::{Writer, quoted};
use crate::material::xml::Element;
use std::path::Path;

impl Writer<'_> {
    /// The text of a value, with its colour space.
    pub(super) fn value(&self, input: &Element, kind: &str, place: Place<'_>) -> Option<String> {
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

/// The name of a type in USD; `None` for types that USD does not have.
pub(super) fn usd_type(kind: &str) -> Option<&'static str> {
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
