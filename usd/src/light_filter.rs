//! Light filters of UsdLux (`light:filters`): barn doors and pictures before a light become filters of the scene, or a picture on the light;
//! `docs/light-filters.md` lists types and attributes.

mod attributes;
mod face;
mod slide;
mod types;

use crate::context::Context;
use crate::prim::Prim;
use crate::pxr::Module;
use crate::vt::FromValue;
use face::{Plane, Strength, TEXELS};
use gonio::scene::{Light, LightFilter, LightShape, Texture, TextureSource, Transform};
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

/// The light behind its filters.
pub(crate) fn apply(context: &mut Context<'_, '_>, filters: &[Filter], mut light: Light) -> Light {
    let planes: Vec<(&Filter, Plane<'_>)> = filters.iter().filter_map(|filter| Some((filter, plane(filter)?))).collect();
    let (even, planes): (Vec<_>, Vec<_>) = planes.into_iter().partition(|(filter, _)| filter.slide == Slide::Even);
    for (filter, _) in even {
        let factor = filter.strength.on([1.0; 3]);
        light.emission.radiance = std::array::from_fn(|k| light.emission.radiance[k] * factor[k]);
    }
    if planes.is_empty() {
        return light;
    }
    if light.shape.is_at_infinity() {
        context.unsupported("a light filter on a light at infinity", &light.origin);
        return light;
    }
    let is_rectangle = matches!(light.shape, LightShape::Rectangle { .. });
    let (faces, before): (Vec<_>, Vec<_>) = planes.into_iter().partition(|(_, plane)| is_rectangle && plane.is_face());
    on_face(context, faces.into_iter().map(|(_, plane)| plane).collect(), &mut light);
    let (useless, before): (Vec<_>, Vec<_>) = before.into_iter().partition(|(_, plane)| plane.is_in_the_middle());
    if !useless.is_empty() {
        context.warn(&light.origin, "a light filter lies in the light's middle, from where nothing can be thrown; it is left out");
    }
    light.filters = before.into_iter().map(|(filter, _)| described(filter)).collect();
    light
}

/// Filters on a rectangle's face are a picture on it.
fn on_face(context: &mut Context<'_, '_>, faces: Vec<Plane<'_>>, light: &mut Light) {
    let LightShape::Rectangle { width, height } = light.shape else { return };
    if faces.is_empty() {
        return;
    }
    if light.texture.is_some() {
        context.unsupported("a light filter on the face of a light with a texture", &light.origin);
        return;
    }
    let rgba: Arc<[f32]> = face::picture(&faces, [width, height]).into();
    let source = TextureSource::Pixels { width: TEXELS as u32, height: TEXELS as u32, rgba };
    let texture = Texture { origin: light.origin.clone(), source, colour_space: "raw".to_owned() };
    light.texture = Some(context.scene.add_texture(texture));
}

fn described(filter: &Filter) -> LightFilter {
    let Strength { density, factor, inverted } = filter.strength;
    LightFilter { to_light: filter.to_light, slide: filter.slide.described(), missed: filter.slide.behind(), inverted, factor, density }
}

/// A filter as its light sees it that has a place; none where it is flat.
fn plane(filter: &Filter) -> Option<Plane<'_>> {
    let from_light = filter.to_light.inverse().filter(Transform::is_finite)?;
    Some(Plane { slide: &filter.slide, strength: filter.strength, from_light })
}
