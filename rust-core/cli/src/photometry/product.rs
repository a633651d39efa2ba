//! What a GLDF file holds, for readers: a product with its variants.

use gonio_formats::{
    gldf::{Emergency, FilePlace, Gldf, Light, RatedFlux, Texts, Variant},
    l3d::{L3d, L3dShape},
    short_number, tame,
};

/// The product, line by line; texts of the file do not reach into the terminal.
pub(super) fn as_text(product: &Gldf<'_>) -> Vec<String> {
    let mut lines = Vec::new();
    if !product.manufacturer.is_empty() {
        lines.push(format!("manufacturer: {}", product.manufacturer));
    }
    if !product.name.shown().is_empty() {
        lines.push(format!("product: {}", named(&product.name, &product.number)));
    }
    let version = if product.version.is_empty() { "of no stated version".to_owned() } else { product.version.clone() };
    lines.push(format!("file: GLDF {version}, {} files, {} variants", product.files.len(), product.variants.len()));
    for (index, variant) in product.variants.iter().enumerate() {
        lines.extend(variant_lines(product, index, variant));
    }
    for spectrum in &product.spectra {
        let what = match spectrum.file.and_then(|file| product.files.get(file)) {
            Some(file) => file.place.as_str().to_owned(),
            None => format!("{} values in the product", spectrum.values.len()),
        };
        lines.push(format!("spectrum {}: {what}", spectrum.id));
    }
    for file in &product.files {
        if let FilePlace::Address(address) = &file.place {
            lines.push(format!("not in the archive, and not fetched: {address} ({})", file.content_type));
        }
    }
    lines.extend(product.warnings.iter().map(|warning| format!("warning: {warning}")));
    lines.iter().map(|line| tame(line)).collect()
}

/// A name with the number behind it.
fn named(name: &Texts, number: &Texts) -> String {
    match (name.shown(), number.shown()) {
        (name, "") => name.to_owned(),
        (name, number) => format!("{name} ({number})"),
    }
}

fn variant_lines(product: &Gldf<'_>, index: usize, variant: &Variant) -> Vec<String> {
    let head = format!("variant {}: {}", index + 1, named(&variant.name, &variant.number));
    let found = product.goniogram(variant);
    let mut lines = match &found {
        Ok(goniogram) => {
            let figures = goniogram.figures();
            let power = figures.watts.zip(figures.efficacy).map(|(watts, efficacy)| format!(", {watts} W, {efficacy:.1} lm/W"));
            let beam = figures.beam.map(|spread| format!("{:.1}°", spread.angle())).join(" × ");
            let light = format!("{:.1} lm{}, {:.1} cd, beam {beam}", figures.flux, power.unwrap_or_default(), figures.peak);
            vec![format!("{head}: {light}")]
        }
        Err(problem) => vec![head, format!("    no photometry: {problem}")],
    };
    for used in &variant.emitters {
        let Some(emitter) = used.emitter.as_ref().ok().and_then(|emitter| product.emitters.get(*emitter)) else { continue };
        let at = if used.object.is_empty() { String::new() } else { format!(" at {}", used.object) };
        if emitter.is_sensor {
            lines.push(format!("    sensor {}{at}", emitter.id));
        }
        lines.extend(emitter.lights.iter().map(|light| format!("    emitter {}{at}: {}", emitter.id, light_words(product, light))));
    }
    if let Ok(Some(flux)) = product.emergency_flux(variant) {
        lines.push(format!("    in emergencies: {flux:.1} lm"));
    }
    if !variant.mountings.is_empty() {
        lines.push(format!("    mounting: {}", variant.mountings.join("; ")));
    }
    lines.extend(bodies(product, variant).into_iter().map(|line| format!("    {line}")));
    let warnings = found.iter().flat_map(|goniogram| &goniogram.warnings);
    lines.extend(warnings.map(|warning| format!("    warning: {warning}")));
    lines
}

/// A light's source, photometry, rated flux and colour.
fn light_words(product: &Gldf<'_>, light: &Light) -> String {
    let photometry = match &light.photometry {
        Ok(file) => product.files.get(*file).map(|file| file.place.as_str().to_owned()),
        Err(problem) => Some(problem.to_string()),
    };
    let parts = [
        Some(light.name.shown().to_owned()).filter(|name| !name.is_empty()),
        photometry,
        light.rated.map(|rated| match rated {
            RatedFlux::Luminaire(flux) => format!("{} lm rated", short_flux(flux)),
            RatedFlux::Lamps(flux) => format!("lamps of {} lm", short_flux(flux)),
        }),
        light.watts.filter(|watts| *watts > 0.0).map(|watts| format!("{watts} W")),
        light.temperature.map(|kelvin| format!("{kelvin} K")),
        light.rendering.map(|index| format!("Ra {index}")),
        light.spectrum.and_then(|spectrum| product.spectra.get(spectrum)).map(|spectrum| format!("spectrum {}", spectrum.id)),
        emergency_words(light),
    ];
    parts.into_iter().flatten().collect::<Vec<_>>().join(", ")
}

/// Makers state whole lumens.
fn short_flux(flux: f64) -> String {
    format!("{flux:.0}")
}

fn emergency_words(light: &Light) -> Option<String> {
    let when = match light.emergency {
        Emergency::None => return None,
        Emergency::Combined => "in emergencies too",
        Emergency::Only => "in emergencies alone",
    };
    let factor = light.emergency_factor.map(|factor| format!(", times {factor}"));
    let flux = light.emergency_flux.map(|flux| format!(", {} lm then", short_flux(flux)));
    Some(format!("{when}{}", flux.or(factor).unwrap_or_default()))
}

/// The variant's simple body and its model.
fn bodies(product: &Gldf<'_>, variant: &Variant) -> Vec<String> {
    let mut lines = Vec::new();
    if let Some(simple) = &variant.simple {
        let [length, width, height] = simple.body.map(short_number);
        let body = if width == "0" { format!("{length} m across") } else { format!("{length} × {width} m") };
        lines.push(format!("body: {body}, {height} m high"));
    }
    for file in variant.models.iter().filter_map(|model| product.files.get(*model)) {
        let content =
            if file.content_type == "geo/l3d" { product.l3d(variant).map(|bytes| bytes.and_then(|bytes| model(&bytes))) } else { None };
        let content = match content {
            None => "not read".to_owned(),
            Some(Ok(words)) => words,
            Some(Err(problem)) => problem.to_string(),
        };
        lines.push(format!("model {}: {content}", file.place.as_str()));
    }
    lines
}

fn model(bytes: &[u8]) -> Result<String, gonio_formats::FormatError> {
    let model = L3d::read(bytes)?;
    let mut faces = 0;
    for mesh in &model.meshes {
        faces += model.polygons(mesh)?.face_counts.len();
    }
    let lights = model.lights.iter().map(|light| {
        let shape = match light.shape {
            L3dShape::Point => "point".to_owned(),
            L3dShape::Circle(diameter) => format!("disk of {} m", short_number(diameter)),
            L3dShape::Rectangle([x, y]) => format!("{} × {} m", short_number(x), short_number(y)),
        };
        format!("{} ({shape})", light.name)
    });
    let lights: Vec<String> = lights.collect();
    let parts = model.parts.len();
    Ok(format!("{parts} parts, {faces} faces in {} meshes; light leaves at {}", model.meshes.len(), lights.join(", ")))
}
