//! UsdLux lights as light sources of the scene, by the formulas of its schema: intensity 1 is 1 cd/m².

use crate::context::{Context, UpAxis};
use crate::goniogram::{Request, goniogram};
use crate::lamp_spectrum::lamp_spectrum;
use crate::material::{stated_colour_space, texture, to_linear_rec709};
use crate::photometry;
use crate::prim::Prim;
use crate::pxr::Module;
use crate::vt::{AssetPath, FromValue};
use gonio::scene::{DomeFormat, Emission, Goniogram, Light, LightShape, Shaping, TextureId, Transform, Visibility};
use pyo3::{intern, prelude::*};
use std::{f64::consts::PI, sync::Arc};

/// Half angle from which on a cone takes nothing away, degrees.
const FULL_CONE: f32 = 180.0;
/// Ninety degrees about x: +y goes to +z, as UsdLux turns domes to a vertical z.
const Y_TO_Z: Transform = Transform { columns: [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0], [0.0; 3]] };

/// Whether prims of this type are lights.
pub fn is_light(type_name: &str) -> bool {
    matches!(
        type_name,
        "SphereLight"
            | "DiskLight"
            | "RectLight"
            | "CylinderLight"
            | "DistantLight"
            | "DomeLight"
            | "DomeLight_1"
            | "PortalLight"
            | "GeometryLight"
            | "PluginLight"
    )
}

/// The light at a prim; `transform` takes its local space to metres. `None`, with a report, for types that are not supported.
pub fn light<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, transform: &Transform) -> Option<Light> {
    let type_name = prim.type_name();
    let stated = shape(context, prim, &type_name)?;
    let is_normalized = input(context, prim, "normalize").unwrap_or(false);
    let intensity = intensity_as_point(context, prim, stated, transform, is_normalized);
    let shape = if intensity.is_some() { LightShape::Point } else { stated };
    let is_dome = matches!(shape, LightShape::Dome { .. });
    let photometry = photometry::photometry(context, prim, shape, transform);
    // A quantity takes the place of the intensity, whatever that is.
    let has_quantity = photometry.as_ref().is_some_and(|photometry| photometry.quantity.is_some());
    let emission = Emission {
        radiance: if has_quantity { tint(context, prim) } else { radiance(context, prim)?.map(|x| x * intensity.unwrap_or(1.0) as f32) },
        normalized: !is_dome && is_normalized && intensity.is_none(),
        metres_per_unit: context.metres_per_unit,
    };
    let has_texture = is_dome || matches!(shape, LightShape::Rectangle { .. });
    report_left_out(context, prim);
    let goniogram = if shape.is_at_infinity() { None } else { measured(context, prim) };
    let light = Light {
        origin: prim.origin(),
        shape,
        emission,
        shaping: shaping(context, prim, &shape),
        goniogram,
        texture: if has_texture { light_texture(context, prim) } else { None },
        transform: if is_dome { dome_transform(context, prim, &type_name, transform) } else { *transform },
        visibility: Visibility { camera: is_seen_by_camera(context, prim), ..Visibility::default() },
        casts_shadow: casts_shadow(context, prim),
        diffuse: multiplier(context, prim, "diffuse"),
        specular: multiplier(context, prim, "specular"),
        group: group(context, prim),
        spectrum: lamp_spectrum(context, prim),
        ..Light::default()
    };
    Some(match photometry {
        None => light,
        Some(photometry) => Light {
            quantity: photometry.quantity,
            dimming: photometry.dimming,
            maintenance: photometry.maintenance,
            goniogram: photometry.goniogram.or(light.goniogram),
            shape: photometry.shape.unwrap_or(light.shape),
            transform: photometry.placed.unwrap_or(light.transform),
            ..light
        },
    })
}

/// Candela of a sphere of 1 cd/m² that is to be a point, as `treatAsPoint` asks, or as it has no extent; `None` for all others.
fn intensity_as_point<'py>(
    context: &mut Context<'_, 'py>,
    prim: &Prim<'py>,
    shape: LightShape,
    transform: &Transform,
    is_normalized: bool,
) -> Option<f64> {
    let LightShape::Sphere { radius } = shape else { return None };
    let is_point = context.get(prim, "treatAsPoint").unwrap_or(false) || (radius == 0.0 && is_normalized);
    // Normalized light is over the area 4πr² in the stage's units; π r² of it is seen from everywhere.
    let scale = transform.columns[..3].iter().map(|axis| axis.iter().map(|x| x * x).sum::<f64>()).sum::<f64>() / 3.0;
    let seen = || if is_normalized { 0.25 * context.metres_per_unit.powi(2) } else { PI * radius * radius * scale };
    is_point.then(seen)
}

/// The light group that a prim names.
pub fn group<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> String {
    context.get_authored(prim, "gonio:lightGroup").unwrap_or_default()
}

/// A light's input; stages of before USD 21.02 have the names without prefix.
pub(crate) fn input<'py, T: FromValue>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, name: &str) -> Option<T> {
    let full_name = format!("inputs:{name}");
    let is_old = prim.has_authored(name) && !prim.has_authored(&full_name);
    context.get(prim, if is_old { name } else { &full_name })
}

/// An input of a light that is a number; what is none is told, and the default used.
fn number<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, name: &str, default: f32) -> f32 {
    let found: f32 = input(context, prim, name).unwrap_or(default);
    if found.is_finite() {
        return found;
    }
    context.warn(&prim.origin(), format!("{name} is {found}, expected a number; {default} is used"));
    default
}

/// The same of a colour, which has no part below 0.
fn numbers<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, name: &str, default: [f32; 3]) -> [f32; 3] {
    let found: [f32; 3] = input(context, prim, name).unwrap_or(default);
    if found.iter().all(|x| x.is_finite() && *x >= 0.0) {
        return found;
    }
    let held = found.map(|x| if x.is_finite() { x.max(0.0) } else { 0.0 });
    context.warn(&prim.origin(), format!("{name} is {found:?}, expected numbers of zero or more; {held:?} is used"));
    held
}

/// A length, which must be a finite number.
fn length<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, name: &str, default: f64) -> f64 {
    let found: f64 = input(context, prim, name).unwrap_or(default);
    if found.is_finite() && found >= 0.0 {
        return found;
    }
    context.warn(&prim.origin(), format!("{name} is {found}, expected a length; {default} is used"));
    default
}

fn shape<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, type_name: &str) -> Option<LightShape> {
    Some(match type_name {
        "RectLight" => LightShape::Rectangle { width: length(context, prim, "width", 1.0), height: length(context, prim, "height", 1.0) },
        "DiskLight" => LightShape::Disk { radius: length(context, prim, "radius", 0.5) },
        "SphereLight" => LightShape::Sphere { radius: length(context, prim, "radius", 0.5) },
        "CylinderLight" => {
            LightShape::Cylinder { radius: length(context, prim, "radius", 0.5), length: length(context, prim, "length", 1.0) }
        }
        "DistantLight" => LightShape::Distant { angle_deg: length(context, prim, "angle", 0.53) },
        "DomeLight" | "DomeLight_1" => LightShape::Dome { format: dome_format(context, prim) },
        other => {
            context.unsupported(&format!("a light of type {other}"), &prim.origin());
            return None;
        }
    })
}

fn dome_format<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> DomeFormat {
    let token: String = input(context, prim, "texture:format").unwrap_or_default();
    match token.as_str() {
        "" | "automatic" => DomeFormat::Automatic,
        "latlong" => DomeFormat::LatLong,
        "mirroredBall" => DomeFormat::MirroredBall,
        "angular" => DomeFormat::Angular,
        "cubeMapVerticalCross" => DomeFormat::CubeMapVerticalCross,
        other => {
            context.warn(&prim.origin(), format!("texture:format is '{other}', which is not a known layout; automatic is used"));
            DomeFormat::Automatic
        }
    }
}

/// `color`, times the colour of the temperature if that is enabled.
pub(crate) fn tint<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> [f32; 3] {
    let colour = colour(context, prim);
    let temperature = if input(context, prim, "enableColorTemperature").unwrap_or(false) { temperature(context, prim) } else { [1.0; 3] };
    std::array::from_fn(|i| colour[i] * temperature[i])
}

/// `intensity · 2^exposure · color`, times the colour of the temperature if that is enabled.
pub(crate) fn radiance<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> Option<[f32; 3]> {
    let (intensity, exposure) = (number(context, prim, "intensity", 1.0), number(context, prim, "exposure", 0.0));
    let strength = intensity * exposure.exp2();
    let radiance = tint(context, prim).map(|x| strength * x);
    if radiance.iter().all(|x: &f32| x.is_finite()) {
        return Some(radiance);
    }
    context
        .warn(&prim.origin(), format!("the light's strength is not finite (intensity {intensity}, exposure {exposure}); it is left out"));
    None
}

fn colour<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> [f32; 3] {
    let [r, g, b] = numbers(context, prim, "color", [1.0; 3]);
    let space = prim.attribute("inputs:color").map(|attribute| stated_colour_space(&attribute)).unwrap_or_default();
    match to_linear_rec709([r, g, b, 1.0], &space) {
        Ok([r, g, b, _]) => [r, g, b],
        Err(unknown) => {
            context.warn(&prim.origin(), format!("the colour space '{unknown}' is not known; linear Rec.709 is used"));
            [r, g, b]
        }
    }
}

/// The colour of a black body as UsdLux computes it: of luminance 1, and 6500 K is not exactly white.
fn temperature<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> [f32; 3] {
    // The library's function reads beyond its table where the temperature is no number, and takes the process with it.
    let kelvin = number(context, prim, "colorTemperature", 6500.0);
    let rgb = Module::UsdLux.item(context.py, "BlackbodyTemperatureAsRgb").and_then(|function| function.call1((kelvin,)));
    let rgb = context.attempt(&prim.origin(), "the colour temperature cannot be evaluated", rgb);
    rgb.and_then(|rgb| <[f32; 3]>::from_value(&rgb)).unwrap_or([1.0; 3])
}

fn light_texture<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> Option<TextureId> {
    let name = ["inputs:texture:file", "texture:file"].into_iter().find(|name| prim.has_authored(name))?;
    let attribute = prim.attribute(name)?;
    let path: AssetPath = context.get_attribute(&attribute)?;
    if path.authored.is_empty() {
        return None;
    }
    let space = stated_colour_space(&attribute);
    texture(context, &prim.origin(), &path, &attribute, if space.is_empty() { "auto" } else { &space })
}

/// The scene's domes stand upright on +y; those of `DomeLight_1` on the axis they say.
fn dome_transform<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, type_name: &str, transform: &Transform) -> Transform {
    if type_name != "DomeLight_1" {
        return *transform;
    }
    let axis: String = context.get(prim, "poleAxis").unwrap_or_default();
    let is_z = match axis.as_str() {
        "Z" => true,
        "Y" => false,
        _ => context.up_axis == UpAxis::Z,
    };
    if is_z { transform.after(&Y_TO_Z) } else { *transform }
}

fn shaping<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, shape: &LightShape) -> Shaping {
    let is_applied = prim.applied_schemas().iter().any(|schema| schema == "ShapingAPI");
    let is_authored = prim.has_authored_prefix("inputs:shaping:") || prim.has_authored_prefix("shaping:");
    if !is_applied && !is_authored {
        return Shaping::default();
    }
    if shape.is_at_infinity() {
        if is_shaped(context, prim) {
            context.unsupported("shaping of lights at infinity", &prim.origin());
        }
        return Shaping::default();
    }
    let angle = number(context, prim, "shaping:cone:angle", FULL_CONE).max(0.0);
    let (softness, focus) = (number(context, prim, "shaping:cone:softness", 0.0), number(context, prim, "shaping:focus", 0.0));
    Shaping {
        cone_angle_deg: (angle < FULL_CONE).then_some(angle),
        cone_softness: softness.clamp(0.0, 1.0),
        focus: focus.max(0.0),
        focus_tint: numbers(context, prim, "shaping:focusTint", [0.0; 3]),
    }
}

/// Whether anything is said of shaping beyond what exporters write to all lights and what changes nothing.
fn is_shaped<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> bool {
    let mut number = |name: &str| {
        let is_said = prim.has_authored(name) || prim.has_authored(&format!("inputs:{name}"));
        if is_said { input::<f32>(context, prim, name) } else { None }
    };
    let is_cone = number("shaping:cone:angle").is_some_and(|angle| angle < FULL_CONE);
    let is_focused = number("shaping:focus").is_some_and(|focus| focus > 0.0);
    is_cone || is_focused || input::<AssetPath>(context, prim, "shaping:ies:file").is_some_and(|file| !file.authored.is_empty())
}

/// The light distribution of the shaping's file.
fn measured<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> Option<Arc<Goniogram>> {
    let path: AssetPath = input(context, prim, "shaping:ies:file")?;
    if path.authored.is_empty() {
        return None;
    }
    let angle_scale: f32 = input(context, prim, "shaping:ies:angleScale").unwrap_or(0.0);
    let normalized = input(context, prim, "shaping:ies:normalize").unwrap_or(false);
    goniogram(context, prim, &path, Request { angle_scale: if angle_scale.is_finite() { angle_scale } else { 0.0 }, normalized })
}

/// The factor on what surfaces scatter of a light in a way.
fn multiplier<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, name: &str) -> f32 {
    let found: f32 = input(context, prim, name).unwrap_or(1.0);
    if found.is_finite() && found >= 0.0 {
        return found;
    }
    context.warn(&prim.origin(), format!("{name} is {found}, expected a number of zero or more; 1 is used"));
    1.0
}

fn casts_shadow<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> bool {
    if !prim.has_authored_prefix("inputs:shadow:") && !prim.has_authored_prefix("shadow:") {
        return true;
    }
    for (name, off) in [("shadow:distance", -1.0), ("shadow:falloff", -1.0)] {
        if input::<f32>(context, prim, name).is_some_and(|value| value >= 0.0 && value != off) {
            context.unsupported(&format!("{name} of lights"), &prim.origin());
        }
    }
    if input::<[f32; 3]>(context, prim, "shadow:color").is_some_and(|colour| colour != [0.0; 3]) {
        context.unsupported("shadow:color of lights", &prim.origin());
    }
    input(context, prim, "shadow:enable").unwrap_or(true)
}

/// Says once by name what changes the light and is not done.
pub(crate) fn report_left_out<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) {
    let origin = prim.origin();
    if prim.has_authored("portals") && !prim.targets("portals").is_empty() {
        context.unsupported("portals of dome lights", &origin);
    }
    if ["inputs:color", "inputs:intensity"].iter().any(|name| is_connected(prim, name)) {
        context.unsupported("shader networks on lights", &origin);
    }
}

/// Whether a light's collection of links, `lightLink` or `shadowLink`, may hold anything but all.
pub(crate) fn is_link_authored(prim: &Prim<'_>, collection: &str) -> bool {
    prim.has_authored_prefix(&format!("collection:{collection}"))
}

fn is_connected(prim: &Prim<'_>, name: &str) -> bool {
    if !prim.has_authored(name) {
        return false;
    }
    let connected = |object: &Bound<'_, PyAny>| object.call_method0(intern!(object.py(), "HasAuthoredConnections"))?.is_truthy();
    prim.attribute(name).is_some_and(|attribute| connected(attribute.object()).unwrap_or(false))
}

/// Whether camera rays see the emitter: UsdLux has no say in it, renderers have names of their own.
pub fn is_seen_by_camera<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> bool {
    const FLAGS: [&str; 7] = [
        "primvars:gonio:visibility:camera",
        "primvars:ri:attributes:visibility:camera",
        "primvars:arnold:visibility:camera",
        "karma:light:renderlightgeo",
        "primvars:karma:light:renderlightgeo",
        "inputs:visibility:camera",
        "visibleInPrimaryRay",
    ];
    let is_hidden = FLAGS.iter().any(|name| context.get_authored::<bool>(prim, name) == Some(false));
    // A share.
    let is_hidden = is_hidden || context.get_authored::<f64>(prim, "primvars:arnold:camera") == Some(0.0);
    let karma = context.get_authored::<String>(prim, "primvars:karma:object:rendervisibility");
    !is_hidden && karma.is_none_or(|expression| karma_shows_primary(&expression))
}

/// Karma's expression: names of ray kinds joined by `|`, `*` for all, a leading `-` for all but the named.
fn karma_shows_primary(expression: &str) -> bool {
    let expression = expression.trim();
    let (is_exclusion, names) = expression.strip_prefix('-').map_or((false, expression), |names| (true, names));
    let names_primary = names.split(['|', '&', ' ', ',']).any(|name| name.trim().trim_start_matches('-') == "primary");
    if is_exclusion { !names_primary } else { names_primary || expression.is_empty() || expression.contains('*') }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn karma_expressions() {
        for (expression, shown) in
            [("-primary", false), ("*", true), ("", true), ("primary", true), ("shadow|diffuse", false), ("-shadow", true)]
        {
            assert_eq!(karma_shows_primary(expression), shown, "{expression}");
        }
    }

    #[test]
    fn vertical_z_turns_the_pole() {
        assert_eq!(Y_TO_Z.vector([0.0, 1.0, 0.0]), [0.0, 0.0, 1.0]);
        assert_eq!(Y_TO_Z.vector([0.0, 0.0, 1.0]), [0.0, -1.0, 0.0]);
        assert!((Y_TO_Z.determinant() - 1.0).abs() < 1e-15);
    }
}
