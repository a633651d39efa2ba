//! What metal a material is of: `gonio:metal` on its prim, a name or a file; `docs/spectral.md` tells more.

use crate::asset;
use crate::context::Context;
use crate::prim::Prim;
use crate::vt::AssetPath;
use gonio::scene::{Closure, MetalIndex};
use std::sync::Arc;

const METAL: &str = "gonio:metal";

/// Makes the metallic parts of a material's closures of what its prim names; what is no metal is told, and they keep their colours.
pub(super) fn apply<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, closures: &mut [Closure]) {
    let Some(attribute) = prim.attribute(METAL).filter(|_| prim.has_authored(METAL)) else { return };
    let found = match attribute.type_name().as_str() {
        "asset" => match context.get_authored::<AssetPath>(prim, METAL) {
            Some(path) => asset::read(context.py, &path, "metal", gonio_spectrum::read_metal),
            None => return,
        },
        _ => match context.get_authored::<String>(prim, METAL) {
            Some(name) => gonio_spectrum::metal(&name)
                .ok_or_else(|| format!("{METAL} is '{name}', expected one of {}", gonio_spectrum::metal_sets().join(", "))),
            None => return,
        },
    };
    match found {
        Ok(metal) => {
            let notes = metal.notes.clone();
            let metal = Arc::new(MetalIndex::from(metal));
            closures.iter_mut().for_each(|closure| closure.metal = Some(metal.clone()));
            for note in notes {
                context.warn(&prim.origin(), format!("{METAL}: {note}"));
            }
        }
        Err(problem) => context.refuse(&prim.origin(), &problem, "the material keeps its colours"),
    }
}
