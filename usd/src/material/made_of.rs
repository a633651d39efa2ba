//! What metal and what glass a material is of: `gonio:metal` and `gonio:glass` on its prim, a name or a file; `docs/spectral.md` tells more.

use crate::asset;
use crate::context::Context;
use crate::prim::Prim;
use crate::vt::AssetPath;
use gonio::scene::{Closure, GlassIndex, MetalIndex};
use gonio_formats::FormatError;
use std::sync::Arc;

const METAL: &str = "gonio:metal";
const GLASS: &str = "gonio:glass";

/// Makes a material's closures of what its prim names; what is neither a name nor a file is told, and they keep their colours or their index.
pub(super) fn apply<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, closures: &mut [Closure]) {
    let metal = (METAL, "metal", "the material keeps its colours");
    if let Some(found) = named(context, prim, metal, gonio_spectrum::read_metal, gonio_spectrum::metal, gonio_spectrum::metal_sets) {
        tell(context, prim, METAL, &found.notes);
        let metal = Arc::new(MetalIndex::from(found));
        closures.iter_mut().for_each(|closure| closure.metal = Some(metal.clone()));
    }
    let glass = (GLASS, "glass", "the material keeps its index");
    if let Some(found) = named(context, prim, glass, gonio_spectrum::read_glass, gonio_spectrum::glass, gonio_spectrum::glass_sets) {
        tell(context, prim, GLASS, &found.notes);
        let glass = Arc::new(GlassIndex::from(found));
        closures.iter_mut().for_each(|closure| closure.glass = Some(glass.clone()));
    }
}

/// What an attribute names, if it is authored; says where that is nothing.
fn named<'py, T>(
    context: &mut Context<'_, 'py>,
    prim: &Prim<'py>,
    (attribute, kind, otherwise): (&str, &str, &str),
    read: impl FnOnce(&[u8], &str) -> Result<T, FormatError>,
    of_name: impl FnOnce(&str) -> Option<T>,
    names: impl FnOnce() -> Vec<&'static str>,
) -> Option<T> {
    let authored = prim.attribute(attribute).filter(|_| prim.has_authored(attribute))?;
    let found = match authored.type_name().as_str() {
        "asset" => asset::read(context.py, &context.get_authored::<AssetPath>(prim, attribute)?, kind, read),
        _ => {
            let name = context.get_authored::<String>(prim, attribute)?;
            of_name(&name).ok_or_else(|| format!("{attribute} is '{name}', expected one of {}", names().join(", ")))
        }
    };
    found.map_err(|problem| context.refuse(&prim.origin(), &problem, otherwise)).ok()
}

fn tell<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, attribute: &str, notes: &[String]) {
    for note in notes {
        context.warn(&prim.origin(), format!("{attribute}: {note}"));
    }
}
