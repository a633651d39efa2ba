//! Spectra of lights and of surfaces that shine: `gonio:spectrum`, a file, a name, or pairs of nanometres and power; `docs/spectral.md` tells more.

use crate::asset;
use crate::context::Context;
use crate::prim::Prim;
use crate::vt::AssetPath;
use gonio::scene::LampSpectrum;
use std::sync::Arc;

const SPECTRUM: &str = "gonio:spectrum";

/// The spectrum of a light, or of what a material's surface sends, where it has one; what is none is told, and it keeps its colour.
pub(crate) fn lamp_spectrum<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> Option<Arc<LampSpectrum>> {
    let attribute = prim.attribute(SPECTRUM).filter(|_| prim.has_authored(SPECTRUM))?;
    let found = match attribute.type_name().as_str() {
        "asset" => {
            let path = context.get_authored::<AssetPath>(prim, SPECTRUM)?;
            from_file(context, &path)
        }
        "string" | "token" => from_name(&context.get_authored::<String>(prim, SPECTRUM)?),
        _ => {
            let pairs = context.get_authored::<Vec<[f32; 2]>>(prim, SPECTRUM)?;
            let of = |part: usize| pairs.iter().map(|pair| f64::from(pair[part])).collect();
            Ok(LampSpectrum { name: String::new(), wavelengths_nm: of(0), power: of(1) })
        }
    };
    match found {
        Ok(spectrum) => Some(Arc::new(spectrum)),
        Err(problem) => {
            context.refuse(&prim.origin(), &problem, "its light keeps its colour");
            None
        }
    }
}

fn from_name(name: &str) -> Result<LampSpectrum, String> {
    let unknown = || format!("{SPECTRUM} is '{name}', expected one of {}", gonio_spectrum::NAMES);
    gonio_spectrum::named(name).ok_or_else(unknown)?.map(LampSpectrum::from).map_err(|error| format!("{SPECTRUM}: {}", error.problem))
}

fn from_file(context: &Context<'_, '_>, path: &AssetPath) -> Result<LampSpectrum, String> {
    asset::read(context.py, path, "spectrum", gonio_spectrum::read).map(LampSpectrum::from)
}
