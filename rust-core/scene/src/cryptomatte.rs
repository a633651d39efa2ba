//! Cryptomatte (Psyop's specification 1.2): what names become in pictures, and the manifests that lead back to them.

use super::{Instances, Scene};
use serde::{Deserialize, Serialize};
use std::{collections::BTreeSet, sync::Arc};

/// What mattes tell apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum MatteKind {
    /// Objects, or prims.
    Object,
    /// Materials.
    Material,
    /// What objects are parts of.
    Asset,
}

/// Ranks of a matte where nothing else is asked for: the names of a pixel that cover most of it.
pub const MATTE_RANKS: u32 = 6;
/// Most ranks of a matte.
pub const MOST_MATTE_RANKS: u32 = 16;

impl MatteKind {
    /// All of them, with the name of the pass that stands for all layers, and with what the names of the layers start with.
    pub const NAMES: [(Self, &'static str, &'static str); 3] = [
        (Self::Object, "cryptomatte_object", "CryptoObject"),
        (Self::Material, "cryptomatte_material", "CryptoMaterial"),
        (Self::Asset, "cryptomatte_asset", "CryptoAsset"),
    ];

    /// The kind whose layers a pass stands for; `crypto_object` and the like are the names that other renderers use.
    pub fn by_name(name: &str) -> Option<Self> {
        let spelled = |known: &str, layers: &str| {
            let short = known.replace("cryptomatte_", "crypto_");
            [known, layers, &short].iter().any(|spelling| spelling.eq_ignore_ascii_case(name))
        };
        Self::NAMES.iter().find(|(_, known, layers)| spelled(known, layers)).map(|(kind, ..)| *kind)
    }

    /// The kind and the number of a layer, such as `CryptoObject00`.
    pub fn by_layer(name: &str) -> Option<(Self, u8)> {
        let found = Self::NAMES.iter().find_map(|(kind, _, layers)| Some((*kind, name.strip_prefix(layers)?)));
        let (kind, number) = found.filter(|(_, number)| number.len() == 2)?;
        number.parse().ok().filter(|number| u32::from(*number) < MOST_MATTE_RANKS / 2).map(|number| (kind, number))
    }

    /// What the names of its layers start with.
    pub fn layers(self) -> &'static str {
        Self::NAMES.iter().find(|(kind, ..)| *kind == self).map_or("", |(_, _, layers)| layers)
    }
}

/// What one or more placements of a set of instances are called.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct MatteName {
    /// The first placement that is called so; the next entry's is the first that is not.
    pub first: u32,
    /// The object's name, or the prim's path.
    pub object: Arc<str>,
    /// The name of what it is a part of.
    pub asset: Arc<str>,
}

impl Instances {
    /// What the placements are called: as told, or after their origin.
    pub fn names_in_mattes(&self) -> Vec<MatteName> {
        if !self.matte_names.is_empty() {
            return self.matte_names.clone();
        }
        let name = self.origin.name.clone();
        vec![MatteName { first: 0, object: name.clone(), asset: name }]
    }
}

/// The 32-bit value of a name: the bits of a float that is neither denormal nor infinite nor NaN.
pub fn matte_id(name: &str) -> u32 {
    let hash = murmur3(name.as_bytes());
    // An exponent of zeros or of ones becomes another by its lowest bit.
    if matches!(hash >> 23 & 255, 0 | 255) { hash ^ 1 << 23 } else { hash }
}

/// The key of a layer in headers: seven digits of its name's hash.
pub fn matte_key(layer: &str) -> String {
    format!("{:08x}", murmur3(layer.as_bytes()))[..7].to_owned()
}

/// MurmurHash3_x86_32 with seed 0 (Austin Appleby, public domain).
fn murmur3(bytes: &[u8]) -> u32 {
    let scrambled = |word: u32| word.wrapping_mul(0xcc9e_2d51).rotate_left(15).wrapping_mul(0x1b87_3593);
    let (words, rest) = bytes.as_chunks::<4>();
    let mut hash = 0_u32;
    for word in words {
        hash = (hash ^ scrambled(u32::from_le_bytes(*word))).rotate_left(13).wrapping_mul(5).wrapping_add(0xe654_6b64);
    }
    let tail = rest.iter().rev().fold(0, |tail, byte| tail << 8 | u32::from(*byte));
    hash ^= scrambled(tail);
    hash ^= bytes.len() as u32;
    hash = (hash ^ hash >> 16).wrapping_mul(0x85eb_ca6b);
    hash = (hash ^ hash >> 13).wrapping_mul(0xc2b2_ae35);
    hash ^ hash >> 16
}

/// The names in a scene's mattes, sorted, each once.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Manifests {
    /// By kind, the names.
    names: Vec<(MatteKind, Vec<Arc<str>>)>,
}

impl Manifests {
    /// The names of the kinds that a scene's passes show.
    pub fn of(scene: &Scene) -> Self {
        let kinds = scene.settings.matte_kinds();
        Self { names: kinds.into_iter().map(|kind| (kind, names(scene, kind))).collect() }
    }

    /// The names of a kind.
    pub fn names(&self, kind: MatteKind) -> &[Arc<str>] {
        self.names.iter().find(|(known, _)| *known == kind).map_or(&[], |(_, names)| names)
    }

    /// The manifest of a kind: a JSON object of names and of their values in eight hexadecimal digits.
    pub fn json(&self, kind: MatteKind) -> String {
        let quoted = |name: &Arc<str>| serde_json::to_string(&**name).unwrap_or_default();
        let entries: Vec<String> = self.names(kind).iter().map(|name| format!("{}:\"{:08x}\"", quoted(name), matte_id(name))).collect();
        format!("{{{}}}", entries.join(","))
    }
}

fn names(scene: &Scene, kind: MatteKind) -> Vec<Arc<str>> {
    let mut names = BTreeSet::new();
    match kind {
        MatteKind::Material => names.extend(scene.materials.iter().map(|material| material.origin.name.clone())),
        _ => {
            for named in scene.instances.iter().flat_map(Instances::names_in_mattes) {
                names.insert(if kind == MatteKind::Object { named.object } else { named.asset });
            }
        }
    }
    names.into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hashes_are_those_of_the_reference() {
        // Values of the reference implementation, seed 0.
        for (text, hash) in
            [("", 0), ("test", 0xba6b_d213), ("Hello, world!", 0xc036_3e43), ("The quick brown fox jumps over the lazy dog", 0x2e4f_f723)]
        {
            assert_eq!(murmur3(text.as_bytes()), hash, "{text}");
        }
    }

    #[test]
    fn ids_are_ordinary_floats() {
        let names = (0..20_000).map(|number| format!("/World/thing_{number}"));
        assert!(names.map(|name| f32::from_bits(matte_id(&name))).all(f32::is_normal));
        assert!(f32::from_bits(matte_id("")).is_normal());
    }

    #[test]
    fn layers_have_a_kind_and_a_number() {
        assert_eq!(MatteKind::by_layer("CryptoObject00"), Some((MatteKind::Object, 0)));
        assert_eq!(MatteKind::by_layer("CryptoAsset02"), Some((MatteKind::Asset, 2)));
        assert_eq!(
            [MatteKind::by_layer("CryptoObject"), MatteKind::by_layer("CryptoObject99"), MatteKind::by_layer("Object00")],
            [None; 3]
        );
        assert_eq!(MatteKind::by_name("crypto_material"), Some(MatteKind::Material));
        assert_eq!(MatteKind::by_name("CryptoAsset"), Some(MatteKind::Asset));
    }

    #[test]
    fn manifests_are_json() {
        let names: Vec<Arc<str>> = vec!["a \"quoted\" name".into(), "größe".into()];
        let manifests = Manifests { names: vec![(MatteKind::Object, names.clone())] };
        let read: serde_json::Value = serde_json::from_str(&manifests.json(MatteKind::Object)).expect("JSON");
        for name in &names {
            assert_eq!(read[&**name].as_str(), Some(format!("{:08x}", matte_id(name)).as_str()));
        }
        assert_eq!(manifests.json(MatteKind::Asset), "{}");
    }
}
