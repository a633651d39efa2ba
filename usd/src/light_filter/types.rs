//! Types of light filters: what each lets through, and how strong it is.

use super::attributes::{attribute, choice, colour, number, value};
use super::face::Strength;
use super::slide::{Picture, Slide, Tiling, Window};
use crate::context::Context;
use crate::light::is_link_authored;
use crate::material::{image_source, stated_colour_space};
use crate::prim::Prim;
use crate::vt::AssetPath;
use gonio::colour::ColourSpace;
use gonio::scene::TextureSource;
use gonio::texture::{self, DomeFormat, LatLong, Source};
use gonio::threads::in_pool;

/// What a filter of a type lets through; none, with a report, where it is not known or has no picture.
pub(super) fn slide<'py>(context: &mut Context<'_, 'py>, light: &Prim<'py>, filter: &Prim<'py>, kind: &str) -> Option<Slide> {
    match kind {
        "PxrIntMultLightFilter" => Some(Slide::Even),
        "PxrBarnLightFilter" => Some(window(context, filter)),
        "PxrCookieLightFilter" | "PxrGoboLightFilter" | "PxrGobo" => picture(context, filter),
        other => {
            let other = if other.is_empty() { "unknown" } else { other };
            context.unsupported(&format!("a light filter of type {other}"), &light.origin());
            None
        }
    }
}

/// How strong a filter is; what changes it and is not done is reported.
pub(super) fn strength<'py>(context: &mut Context<'_, 'py>, filter: &Prim<'py>) -> Strength {
    report_left_out(context, filter);
    let intensity = number(context, filter, &["intensity", "ri:intensity"], 1.0);
    let exposure = number(context, filter, &["exposure", "ri:exposure"], 0.0);
    let factor = (intensity * exposure.exp2()) as f32;
    let tint = colour(context, filter, &["tint", "color:tint"], [1.0; 3]);
    Strength {
        density: number(context, filter, &["density", "ri:density"], 1.0).clamp(0.0, 1.0) as f32,
        factor: if factor.is_finite() { tint.map(|x| (x * factor).max(0.0)) } else { [1.0; 3] },
        inverted: value(context, filter, &["invert", "ri:invert"]).unwrap_or(false),
    }
}

/// Says once by name what changes the filter and is not done.
fn report_left_out<'py>(context: &mut Context<'_, 'py>, filter: &Prim<'py>) {
    let origin = filter.origin();
    if is_link_authored(filter, "filterLink") {
        context.unsupported("the collection filterLink of light filters", &origin);
    }
    for name in ["barnMode", "cookieMode"] {
        if choice(context, filter, &[name], &["physical", "analytic"]) == 1 {
            let message = "the analytic mode of light filters is not supported, they stand in the way of light as they are placed";
            context.once("filter mode", "analytic", &origin, || message.to_owned());
        }
    }
    let combined: String = value(context, filter, &["combineMode", "ri:combineMode"]).unwrap_or_default();
    if !["", "mult", "multiply"].contains(&combined.as_str()) {
        context.unsupported(&format!("the mode '{combined}' of combining light filters"), &origin);
    }
    let factors =
        [["diffuse", "ri:diffuse"], ["specular", "ri:specular"], ["saturation", "color:saturation"], ["contrast", "color:contrast"]];
    for [name, old] in factors {
        if value::<f32>(context, filter, &[name, old]).is_some_and(|factor| factor != 1.0) {
            context.unsupported(&format!("{name} of light filters"), &origin);
        }
    }
}

fn window<'py>(context: &mut Context<'_, 'py>, filter: &Prim<'py>) -> Slide {
    let mut given = |names: &[&str], default| number(context, filter, names, default);
    let width = given(&["width"], 1.0) * given(&["scaleWidth", "scale:width"], 1.0);
    let height = given(&["height"], 1.0) * given(&["scaleHeight", "scale:height"], 1.0);
    let low = [-0.5 * width - given(&["left", "refine:left"], 0.0), -0.5 * height - given(&["bottom", "refine:bottom"], 0.0)];
    let high = [0.5 * width + given(&["right", "refine:right"], 0.0), 0.5 * height + given(&["top", "refine:top"], 0.0)];
    let (radius, edge) = (given(&["radius"], 0.0), given(&["edge", "edgeThickness"], 0.0).max(0.0));
    let before = choice(context, filter, &["preBarn", "preBarnEffect"], &["noEffect", "cone", "noLight"]);
    Slide::Window(Window { low, high, radius, edge, passes_behind: before == 0 })
}

fn picture<'py>(context: &mut Context<'_, 'py>, filter: &Prim<'py>) -> Option<Slide> {
    let mut picture = image(context, filter)?;
    picture.fill = colour(context, filter, &["fillColor", "texture:fillColor"], [0.0; 3]);
    picture.tiling = match choice(context, filter, &["tileMode", "texture:wrapMode"], &["off", "clamp", "repeat"]) {
        0 => Tiling::Fill,
        1 => Tiling::Clamp,
        _ => Tiling::Repeat,
    };
    for (k, letter) in ["U", "V"].into_iter().enumerate() {
        let names = |name: &str| [format!("{name}{letter}"), format!("texture:{name}{letter}")];
        let [new, old] = names("scale");
        picture.scale[k] = number(context, filter, &[&new, &old], 1.0);
        let [new, old] = names("offset");
        picture.offset[k] = number(context, filter, &[&new, &old], 0.0);
        let [new, old] = names("invert");
        picture.mirrored[k] = value(context, filter, &[&new, &old]).unwrap_or(false);
    }
    Some(Slide::Picture(picture))
}

/// The filter's picture in its frame; none, with a warning, where there is none.
fn image<'py>(context: &mut Context<'_, 'py>, filter: &Prim<'py>) -> Option<Picture> {
    let origin = filter.origin();
    let Some(map) = attribute(filter, &["map", "texture:map", "textureMap"]) else {
        context.warn(&origin, "the filter names no picture; it is left out");
        return None;
    };
    let path: AssetPath = context.get_attribute(&map)?;
    let source = match image_source(context.py, &path, &map) {
        Ok(TextureSource::File(file)) => Ok(Source::Path(file)),
        Ok(TextureSource::Encoded { name, bytes }) => Ok(Source::Bytes { name: name.as_str().into(), bytes }),
        Ok(_) => Err(format!("'{}' is a set of UDIM tiles", path.authored)),
        Err(problem) => Err(problem),
    };
    let space = ColourSpace::parse(&stated_colour_space(&map)).unwrap_or(ColourSpace::Auto);
    let decoded = source.and_then(|source| {
        let image = texture::load_image(&source).map_err(|error| error.to_string())?;
        let linear = in_pool(|| LatLong::from_image(&image, DomeFormat::LatLong, space)).map_err(|error| error.to_string())?;
        Ok((image, linear))
    });
    let size = [number(context, filter, &["width"], 1.0), number(context, filter, &["height"], 1.0)];
    match decoded {
        Ok(_) if size.iter().any(|size| *size <= 0.0) => context.warn(&origin, "the filter has no size; it is left out"),
        Ok((image, linear)) => return Some(Picture::new(&image, linear, size)),
        Err(problem) => context.warn(&origin, format!("{problem}; the filter is left out")),
    }
    None
}
