//! Absolute photometry of UsdLux lights: `gonio:photometry` attributes; `docs/photometry.md` lists them.

use crate::context::Context;
use crate::goniogram::{self, Lamping};
use crate::prim::Prim;
use crate::vt::{AssetPath, FromValue};
use gonio::scene::{Goniogram, LightQuantity, LightShape, Opening, OpeningShape, Transform};
use std::sync::Arc;

/// Every attribute's name begins so.
const PREFIX: &str = "gonio:photometry:";

/// What a prim's attributes say of its strength.
pub(crate) struct Photometry {
    /// In place of the schema's intensity.
    pub(crate) quantity: Option<LightQuantity>,
    /// A dimmer's factor.
    pub(crate) dimming: f32,
    /// What ageing and soiling leave.
    pub(crate) maintenance: f32,
    /// A luminaire's, in candela.
    pub(crate) goniogram: Option<Arc<Goniogram>>,
    /// The shape that emits, where it is another than the schema's.
    pub(crate) shape: Option<LightShape>,
    /// Where that stands: turned about its vertical axis, of openings in metres.
    pub(crate) placed: Option<Transform>,
}

fn attribute<'py, T: FromValue>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, name: &str) -> Option<T> {
    context.get_authored(prim, &format!("{PREFIX}{name}"))
}

/// The photometry of a light of a shape at a place; `None` where the prim has no such attributes.
pub(crate) fn photometry<'py>(
    context: &mut Context<'_, 'py>,
    prim: &Prim<'py>,
    shape: LightShape,
    transform: &Transform,
) -> Option<Photometry> {
    if !prim.has_authored_prefix(PREFIX) {
        return None;
    }
    if shape.is_at_infinity() && prim.has_authored(&format!("{PREFIX}file")) {
        context.unsupported(&format!("{PREFIX}file of lights at infinity"), &prim.origin());
    }
    let path = if shape.is_at_infinity() { None } else { file(context, prim) };
    let quantity = quantity(context, prim).or(path.is_some().then_some(LightQuantity::Measured));
    let goniogram = path.and_then(|path| goniogram(context, prim, &path, quantity));
    let (shape, placed) = opening(context, prim, (shape, transform), goniogram.as_deref()).unzip();
    let [dimming, maintenance] = factors(context, prim);
    let rotation: f64 = attribute(context, prim, "rotation").unwrap_or(0.0);
    Some(Photometry { quantity, dimming, maintenance, goniogram, shape, placed: placed.map(|placed| turned(&placed, rotation)) })
}

/// Dimming and maintenance; 1 where nothing is said.
pub(crate) fn factors<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> [f32; 2] {
    ["dimming", "maintenanceFactor"].map(|name| {
        let found: f32 = attribute(context, prim, name).unwrap_or(1.0);
        if found.is_finite() && found >= 0.0 {
            return found;
        }
        context.warn(&prim.origin(), format!("{PREFIX}{name} is {found}, expected a number of zero or more; 1 is used"));
        1.0
    })
}

/// The luminaire's file that a prim names.
fn file<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> Option<AssetPath> {
    attribute(context, prim, "file").filter(|path: &AssetPath| !path.authored.is_empty())
}

/// The file's candela. Without them a light whose quantity stands for itself has it evenly, and others nobody knows the strength of.
fn goniogram<'py>(
    context: &mut Context<'_, 'py>,
    prim: &Prim<'py>,
    path: &AssetPath,
    quantity: Option<LightQuantity>,
) -> Option<Arc<Goniogram>> {
    let lamping = Lamping { lamp_set: attribute(context, prim, "lampSet"), tilt_deg: attribute(context, prim, "tilt").unwrap_or(0.0) };
    let needs_file = matches!(quantity, None | Some(LightQuantity::Measured | LightQuantity::LampLumens(_)));
    let instead = if needs_file { "the light stays dark" } else { "its quantity leaves its own shape evenly" };
    goniogram::absolute(context, prim, path, lamping, instead)
}

/// The emitter of a luminaire's file, in metres, and its place: its own opening or a point, however the prim is scaled, or the light's shape, as large as it
/// stands there.
fn opening<'py>(
    context: &mut Context<'_, 'py>,
    prim: &Prim<'py>,
    (shape, transform): (LightShape, &Transform),
    found: Option<&Goniogram>,
) -> Option<(LightShape, Transform)> {
    let asked: String = attribute(context, prim, "opening").unwrap_or_default();
    let found = found?;
    let metres_per_unit = context.metres_per_unit;
    let own = match asked.as_str() {
        "" | "file" => LightShape::Opening(found.opening),
        "point" => LightShape::Point,
        "light" => {
            let of_light = LightShape::Opening(of_light(shape, metres_per_unit));
            return Some((of_light, transform.after(&Transform::scale(1.0 / metres_per_unit))));
        }
        other => {
            context.warn(&prim.origin(), format!("{PREFIX}opening is '{other}', expected file, point or light; file is used"));
            LightShape::Opening(found.opening)
        }
    };
    Some((own, transform.without_scale()))
}

/// The opening that a light's shape is, in metres.
fn of_light(shape: LightShape, metres_per_unit: f64) -> Opening {
    let opening = |shape, size: [f64; 3]| Opening::new(shape, size.map(|s| s * metres_per_unit));
    match shape {
        LightShape::Rectangle { width, height } => opening(OpeningShape::Rectangle, [width, height, 0.0]),
        LightShape::Disk { radius } => opening(OpeningShape::Disk, [2.0 * radius, 2.0 * radius, 0.0]),
        LightShape::Ellipse { width, height } => opening(OpeningShape::Disk, [width, height, 0.0]),
        LightShape::Sphere { radius } | LightShape::FacingDisk { radius } => opening(OpeningShape::Ellipsoid, [2.0 * radius; 3]),
        LightShape::Cylinder { radius, length } => opening(OpeningShape::CylinderAlongX, [length, 2.0 * radius, 2.0 * radius]),
        LightShape::Opening(opening) => opening,
        LightShape::Point | LightShape::Distant { .. } | LightShape::Dome { .. } => Opening::default(),
    }
}

/// A luminaire's place with C0 turned towards C90.
fn turned(placed: &Transform, rotation_deg: f64) -> Transform {
    let (sine, cosine) = rotation_deg.to_radians().sin_cos();
    placed.after(&Transform { columns: [[cosine, sine, 0.0], [-sine, cosine, 0.0], [0.0, 0.0, 1.0], [0.0; 3]] })
}

fn quantity<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> Option<LightQuantity> {
    let value: f64 = attribute(context, prim, "quantity")?;
    let unit: String = attribute(context, prim, "unit").unwrap_or_default();
    Some(match unit.as_str() {
        "" | "lm" => LightQuantity::Lumens(value),
        "lampLm" => LightQuantity::LampLumens(value),
        "cd" => LightQuantity::Candela(value),
        "lx" => LightQuantity::Lux { illuminance: value, distance: attribute(context, prim, "distance").unwrap_or(1.0) },
        "nit" => LightQuantity::Nits(value),
        "W" => LightQuantity::Watts(value),
        other => {
            let expected = "expected lm, lampLm, cd, lx, nit or W";
            context.warn(&prim.origin(), format!("{PREFIX}unit is '{other}', {expected}; the light keeps its intensity"));
            return None;
        }
    })
}

/// Reports what mesh lights have no use for.
pub(crate) fn report_unused_of_mesh<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) {
    for name in ["file", "variant", "opening", "rotation", "lampSet", "tilt"].map(|name| format!("{PREFIX}{name}")) {
        if prim.has_authored(&name) {
            context.unsupported(&format!("{name} of mesh lights"), &prim.origin());
        }
    }
}

/// Luminance in cd/m² of a mesh light of an area in m² whose attributes say how strong it is, before its colour and its dimming;
/// `efficacy` is in lm/W.
pub(crate) fn of_mesh<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, area: Option<f64>, efficacy: f64) -> Option<f64> {
    use std::f64::consts::PI;
    let area = area.filter(|area| *area > 0.0);
    let luminance = match (quantity(context, prim)?, area) {
        (LightQuantity::Nits(luminance), _) => luminance,
        (LightQuantity::Lumens(flux), Some(area)) => flux / (PI * area),
        (LightQuantity::Watts(watts), Some(area)) => watts * efficacy / (PI * area),
        _ => {
            context.warn(&prim.origin(), "mesh lights take nit, or lm or W of a known area; the light keeps its intensity");
            return None;
        }
    };
    if !(luminance.is_finite() && luminance >= 0.0) {
        context.warn(
            &prim.origin(),
            format!("{PREFIX}quantity gives {luminance} cd/m², expected zero or more; the light keeps its intensity"),
        );
        return None;
    }
    Some(luminance)
}
