//! Light filters of UsdLux (`light:filters`): barn doors and pictures before a light become what the scene knows, a goniogram or a picture on the
//! light; `docs/light-filters.md` lists types and attributes.

mod attributes;
mod projection;
mod slide;
mod types;

use crate::context::Context;
use crate::prim::Prim;
use crate::pxr::Module;
use crate::vt::FromValue;
use gonio::scene::{Light, LightShape, Texture, TextureSource, Transform};
use projection::{Plane, Strength, TEXELS};
use pyo3::{intern, prelude::*};
use slide::Slide;
use std::sync::Arc;
use types::{slide, strength};

/// A filter of a light.
#[derive(Clone, Debug)]
pub(crate) struct Filter {
    slide: Slide,
    strength: Strength,
    /// The filter's space to the light's own.
    to_light: Transform,
}

/// The relationships that name a light's filters, of today and of before USD 21.02.
const RELATIONSHIPS: [&str; 2] = ["light:filters", "filters"];

/// Whether prims of this type filter light, and are nothing else.
pub(crate) fn is_filter(type_name: &str) -> bool {
    type_name.ends_with("LightFilter") || type_name == "PxrGobo"
}

/// The paths of a light's filters.
fn paths(prim: &Prim<'_>) -> Vec<String> {
    RELATIONSHIPS.iter().filter(|name| prim.has_authored(name)).flat_map(|name| prim.targets(name)).collect()
}

/// Says by name that the prim's filters are left out, all of them.
pub(crate) fn report<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) {
    for path in paths(prim) {
        let kind = context.prim_at(&path).map(|filter| kind(context, &filter)).filter(|kind| !kind.is_empty());
        context.unsupported(&format!("a light filter of type {}", kind.as_deref().unwrap_or("unknown")), &prim.origin());
    }
}

/// The filters of a light; those that are not known, and lights that can have none, are reported.
pub(crate) fn read<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> Vec<Filter> {
    let paths = paths(prim);
    if paths.is_empty() {
        return Vec::new();
    }
    let mut found = Vec::new();
    for path in paths {
        let Some(filter) = context.prim_at(&path) else {
            context.unsupported("a light filter of type unknown", &prim.origin());
            continue;
        };
        let placed = to_light(context, &filter, prim);
        let Some(to_light) = context.attempt_at(&filter, "the place of the filter cannot be read", placed).flatten() else { continue };
        let kind = kind(context, &filter);
        if let Some(slide) = slide(context, prim, &filter, &kind) {
            found.push(Filter { slide, strength: strength(context, &filter), to_light });
        }
    }
    found
}

/// The type of a filter, or the shader of one of no type of its own.
fn kind<'py>(context: &mut Context<'_, 'py>, filter: &Prim<'py>) -> String {
    match filter.type_name() {
        plain if plain == "LightFilter" => context.get_authored(filter, "lightFilter:shaderId").unwrap_or(plain),
        own => own,
    }
}

/// The filter's space in the light's; none where either is flat.
fn to_light<'py>(context: &Context<'_, 'py>, filter: &Prim<'py>, light: &Prim<'py>) -> PyResult<Option<Transform>> {
    let py = context.py;
    let cache = Module::UsdGeom.item(py, "XformCache")?.call1((&context.time,))?;
    let to_stage = |prim: &Prim<'py>| -> PyResult<Option<Transform>> {
        Ok(Transform::from_value(&cache.call_method1(intern!(py, "GetLocalToWorldTransform"), (prim.object(),))?))
    };
    // The cache knows no places of types without a schema, as RenderMan's filters are.
    let xformable = Module::UsdGeom.item(py, "Xformable")?.call1((filter.object(),))?;
    let own = Transform::from_value(&xformable.call_method1(intern!(py, "GetLocalTransformation"), (&context.time,))?);
    let resets = xformable.call_method0(intern!(py, "GetResetXformStack"))?.is_truthy()?;
    let filter = match filter.parent().filter(|_| !resets) {
        Some(parent) => to_stage(&parent)?.zip(own).map(|(parent, own)| parent.after(&own)),
        None => own,
    };
    let light = to_stage(light)?;
    Ok(light.and_then(|light| light.inverse()).zip(filter).map(|(light, filter)| light.after(&filter)).filter(Transform::is_finite))
}

/// The light behind its filters: one, or one for each of red, green and blue.
pub(crate) fn apply(context: &mut Context<'_, '_>, filters: &[Filter], mut light: Light) -> Vec<Light> {
    let planes: Vec<Plane<'_>> = filters.iter().filter_map(|filter| plane(filter, &light.transform)).collect();
    if planes.is_empty() {
        return vec![light];
    }
    let (even, planes): (Vec<_>, Vec<_>) = planes.into_iter().partition(|plane| *plane.slide == Slide::Even);
    for plane in even {
        let factor = plane.strength.on([1.0; 3]);
        light.emission.radiance = std::array::from_fn(|k| light.emission.radiance[k] * factor[k]);
    }
    if planes.is_empty() {
        return vec![light];
    }
    if let Some(hindrance) = hindrance(&light) {
        context.unsupported(&format!("a light filter on {hindrance}"), &light.origin);
        return vec![light];
    }
    let is_rectangle = matches!(light.shape, LightShape::Rectangle { .. });
    let (faces, before): (Vec<_>, Vec<_>) = planes.into_iter().partition(|plane| is_rectangle && plane.is_face());
    if let (LightShape::Rectangle { width, height }, false) = (light.shape, faces.is_empty()) {
        let rgba: Arc<[f32]> = projection::picture(&faces, [width, height]).into();
        let source = TextureSource::Pixels { width: TEXELS as u32, height: TEXELS as u32, rgba };
        let texture = Texture { origin: light.origin.clone(), source, colour_space: "raw".to_owned() };
        light.texture = Some(context.scene.add_texture(texture));
    }
    let (useless, before): (Vec<_>, Vec<_>) = before.into_iter().partition(Plane::is_in_the_middle);
    if !useless.is_empty() {
        context.warn(&light.origin, "a light filter lies in the light's middle, from where nothing can be thrown; it is left out");
    }
    if before.is_empty() {
        return vec![light];
    }
    let tinted = |(colour, goniogram): ([f32; 3], _)| {
        let mut part = light.clone();
        part.emission.radiance = std::array::from_fn(|k| light.emission.radiance[k] * colour[k]);
        part.goniogram = Some(Arc::new(goniogram));
        part
    };
    projection::goniograms(&before).into_iter().map(tinted).collect()
}

/// Why a light can have no filter that differs from place to place.
fn hindrance(light: &Light) -> Option<&'static str> {
    if light.shape.is_at_infinity() {
        Some("a light at infinity")
    } else if light.goniogram.is_some() {
        Some("a light with a light distribution")
    } else if light.quantity.is_some() {
        Some("a light of a photometric quantity")
    } else if light.texture.is_some() {
        Some("a light with a texture")
    } else {
        None
    }
}

/// A filter as the light sees it that has a place; none where one of them is flat.
fn plane<'a>(filter: &'a Filter, placed: &Transform) -> Option<Plane<'a>> {
    let from_world = placed.after(&filter.to_light).inverse()?;
    let [x, _, z, middle] = placed.columns;
    let scaled = |v: [f64; 3], s: f64| v.map(|x| x * s);
    let dot = |a: [f64; 3], b: [f64; 3]| (0..3).map(|k| a[k] * b[k]).sum::<f64>();
    let unit = |v: [f64; 3]| scaled(v, 1.0 / dot(v, v).sqrt());
    let z = unit(z);
    let x = unit(std::array::from_fn(|k| x[k] - dot(x, z) * z[k]));
    // Mirrored lights stay mirrored.
    let side = if placed.determinant() < 0.0 { -1.0 } else { 1.0 };
    let y = [z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0]].map(|v| v * side);
    let from_light = from_world.after(&Transform { columns: [x, y, z, middle] });
    let face = [placed.columns[0], placed.columns[1]].map(|axis| from_world.vector(axis));
    let is_finite = from_light.is_finite() && face.iter().flatten().all(|x| x.is_finite());
    is_finite.then_some(Plane { slide: &filter.slide, strength: filter.strength, from_light, face })
}
