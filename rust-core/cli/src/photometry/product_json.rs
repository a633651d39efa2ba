//! What a GLDF file holds, for machines.

use gonio_formats::{
    FormatError,
    gldf::{Emergency, EmitterUse, FilePlace, Gldf, Light, RatedFlux, Texts, Variant},
};
use serde_json::{Map, Value, json};
use std::path::Path;

/// Everything in one object.
pub(super) fn as_json(file: &Path, product: &Gldf<'_>) -> Value {
    json!({
        "file": file.to_string_lossy(),
        "manufacturer": product.manufacturer,
        "id": product.id,
        "gldf_version": product.version,
        "created_with": product.created_with,
        "name": texts(&product.name),
        "product_number": texts(&product.number),
        "variants": product.variants.iter().enumerate().map(|(index, variant)| variant_json(product, index, variant)).collect::<Vec<_>>(),
        "spectra": product.spectra.iter().map(|spectrum| json!({
            "id": spectrum.id,
            "file": spectrum.file.and_then(|file| path(product, file)),
            "values": spectrum.values.len(),
        })).collect::<Vec<_>>(),
        "files": product.files.iter().map(|file| json!({
            "id": file.id,
            "content_type": file.content_type,
            "path": if let FilePlace::Inside(path) = &file.place { Some(path) } else { None },
            "url": if let FilePlace::Address(address) = &file.place { Some(address) } else { None },
            "bytes": file.size,
        })).collect::<Vec<_>>(),
        "warnings": words(&product.warnings),
    })
}

fn words(problems: &[FormatError]) -> Vec<String> {
    problems.iter().map(ToString::to_string).collect()
}

/// Texts by the codes of their languages.
fn texts(texts: &Texts) -> Map<String, Value> {
    texts.0.iter().map(|(language, text)| (language.clone(), json!(text))).collect()
}

fn path<'a>(product: &'a Gldf<'_>, file: usize) -> Option<&'a str> {
    product.files.get(file).map(|file| file.place.as_str())
}

fn variant_json(product: &Gldf<'_>, index: usize, variant: &Variant) -> Value {
    let found = product.goniogram(variant);
    let figures = found.as_ref().ok().map(|goniogram| goniogram.figures());
    json!({
        "number": index + 1,
        "id": variant.id,
        "name": texts(&variant.name),
        "order_number": texts(&variant.number),
        "gtin": variant.gtin,
        "flux_lm": figures.as_ref().map(|figures| figures.flux),
        "watts": figures.as_ref().and_then(|figures| figures.watts),
        "peak_cd": figures.as_ref().map(|figures| figures.peak),
        "beam_angle_deg": figures.as_ref().map(|figures| figures.beam.map(|spread| spread.angle())),
        "emergency_flux_lm": product.emergency_flux(variant).ok().flatten(),
        "mountings": variant.mountings,
        "emitters": variant.emitters.iter().map(|used| emitter_json(product, used)).collect::<Vec<_>>(),
        "simple_geometry": variant.simple.map(|simple| json!({
            "body_m": simple.body,
            "emitter_m": simple.emitter,
            "heights_m": simple.heights,
        })),
        "models": variant.models.iter().filter_map(|model| path(product, *model)).collect::<Vec<_>>(),
        "problem": found.as_ref().err().map(ToString::to_string),
        "warnings": found.as_ref().map(|goniogram| words(&goniogram.warnings)).unwrap_or_default(),
    })
}

fn emitter_json(product: &Gldf<'_>, used: &EmitterUse) -> Value {
    let emitter = used.emitter.as_ref().ok().and_then(|emitter| product.emitters.get(*emitter));
    json!({
        "id": emitter.map(|emitter| &emitter.id),
        "object": used.object,
        "sensor": emitter.is_some_and(|emitter| emitter.is_sensor),
        "lights": emitter.map(|emitter| emitter.lights.iter().map(|light| light_json(product, light)).collect::<Vec<_>>()),
        "problem": used.emitter.as_ref().err().map(ToString::to_string),
    })
}

fn light_json(product: &Gldf<'_>, light: &Light) -> Value {
    let (luminaire, lamps) = match light.rated {
        Some(RatedFlux::Luminaire(flux)) => (Some(flux), None),
        Some(RatedFlux::Lamps(flux)) => (None, Some(flux)),
        None => (None, None),
    };
    json!({
        "name": texts(&light.name),
        "photometry": light.photometry.as_ref().ok().and_then(|file| path(product, *file)),
        "problem": light.photometry.as_ref().err().map(ToString::to_string),
        "rated_flux_lm": luminaire,
        "lamps_flux_lm": lamps,
        "watts": light.watts,
        "cct_k": light.temperature,
        "ra": light.rendering,
        "spectrum": light.spectrum.and_then(|spectrum| product.spectra.get(spectrum)).map(|spectrum| &spectrum.id),
        "emergency": match light.emergency {
            Emergency::None => "none",
            Emergency::Combined => "combined",
            Emergency::Only => "only",
        },
        "emergency_factor": light.emergency_factor,
        "emergency_flux_lm": light.emergency_flux,
        "rotation_deg": light.rotation,
    })
}
