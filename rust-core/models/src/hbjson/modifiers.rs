//! Modifiers by their definitions.

use super::generic::{AIR_BOUNDARY, generic};
use super::node::Node;
use super::sets::Set;
use crate::measured;
use crate::modifier::{GLASS_INDEX, Modifier};
use std::collections::HashMap;

/// What points up in a BSDF's sample where nothing is said, as honeybee has it.
const UP: [f64; 3] = [0.01, 0.01, 1.0];

/// The modifiers and the modifier sets of a model by their names.
pub(super) struct Library<'a> {
    modifiers: HashMap<&'a str, Node<'a>>,
    sets: HashMap<&'a str, Node<'a>>,
}

impl<'a> Library<'a> {
    pub(super) fn of(root: &Node<'a>) -> Self {
        let mut library = Self { modifiers: HashMap::new(), sets: HashMap::new() };
        let Some(radiance) = root.get("properties").and_then(|properties| properties.get("radiance")) else { return library };
        let global = radiance.get("global_modifier_set").map(|set| set.list("modifiers")).unwrap_or_default();
        library.modifiers.extend(global.into_iter().chain(radiance.list("modifiers")).map(|node| (node.identifier(), node)));
        library.sets.extend(radiance.list("modifier_sets").into_iter().map(|node| (node.identifier(), node)));
        library
    }

    /// The modifier set of a room.
    ///
    /// # Errors
    /// It names one that there is not.
    pub(super) fn set_of_room(&self, room: &Node<'a>) -> Result<Set<'a>, String> {
        let Some(name) = super::radiance(room, "modifier_set") else { return Ok(Set::default()) };
        let name = name.value.as_str().unwrap_or("");
        self.sets.get(name).map(|node| Set::of(node.clone())).ok_or_else(|| format!("there is no modifier set '{name}'"))
    }

    /// What a name or a definition means, and the name.
    ///
    /// # Errors
    /// There is no such modifier, or its definition is wrong; where that stands.
    pub(super) fn modifier(&self, asked: &Node<'a>) -> Result<(&'a str, Modifier), String> {
        let Some(name) = asked.value.as_str() else { return Ok((asked.identifier(), defined(asked)?)) };
        let found = match self.modifiers.get(name) {
            // Honeybee's own definition is a clear sheet; nothing at all is the same.
            Some(_) if name == AIR_BOUNDARY => Modifier::Void,
            Some(node) => defined(node).map_err(|problem| format!("modifier '{name}' ({}): {problem}", node.path))?,
            None => generic(name).ok_or_else(|| format!("there is no modifier '{name}'"))?,
        };
        Ok((name, found))
    }
}

/// What a definition means.
fn defined(node: &Node<'_>) -> Result<Modifier, String> {
    let colour = |what: &str| -> Result<[f64; 3], String> {
        let part = |channel: &str, otherwise| node.number(&format!("{channel}_{what}"), otherwise);
        let otherwise = if node.kind() == "Mirror" { 1.0 } else { 0.0 };
        Ok([part("r", otherwise)?, part("g", otherwise)?, part("b", otherwise)?])
    };
    let (specularity, roughness) = (node.number("specularity", 0.0), node.number("roughness", 0.0));
    let found = match node.kind() {
        "Void" => Modifier::Void,
        "Plastic" => Modifier::Plastic { colour: colour("reflectance")?, specularity: specularity?, roughness: roughness? },
        "Metal" => {
            // Metals are specular where nothing is said.
            Modifier::Metal { colour: colour("reflectance")?, specularity: node.number("specularity", 0.9)?, roughness: roughness? }
        }
        "Trans" => Modifier::Trans {
            colour: colour("reflectance")?,
            specularity: specularity?,
            roughness: roughness?,
            transmitted: node.number("transmitted_diff", 0.0)?,
            transmitted_specular: node.number("transmitted_spec", 0.0)?,
        },
        "Glass" => Modifier::Glass { transmissivity: colour("transmissivity")?, index: node.number("refraction_index", GLASS_INDEX)? },
        "Mirror" => Modifier::Mirror { colour: colour("reflectance")? },
        "Light" | "Glow" => Modifier::Light { radiance: colour("emittance")? },
        "BSDF" => {
            let data = node.text("bsdf_data").ok_or("bsdf_data is missing, expected the text of a BSDF file")?;
            let up = if node.get("up_orientation").is_some() { node.triple("up_orientation")? } else { UP };
            measured::modifier(data.as_bytes(), node.identifier(), up)?
        }
        other => return Err(format!("its type is '{other}', expected Plastic, Metal, Trans, Glass, Mirror, Light, Glow, BSDF or Void")),
    };
    found.problem().map_or(Ok(found), Err)
}
