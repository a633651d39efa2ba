//! Sun and sky of prims with `gonio:daylight` attributes, on any Xform or DomeLight; `docs/daylight.md` lists them.

use crate::context::{Context, UpAxis};
use crate::light;
use crate::prim::Prim;
use gonio::Result;
use gonio::scene::{Light, Transform};
use gonio::sky::{self, Daylight, Frame, Irradiance, Moment, Place, SkyModel};

/// Every attribute's name begins so.
const PREFIX: &str = "gonio:daylight:";

/// Whether the prim says where the sun and the sky are to be seen from.
pub(crate) fn is_daylight(prim: &Prim<'_>) -> bool {
    prim.has_authored_prefix(PREFIX)
}

/// The vertical axis of the scene's sky.
pub fn up_axis(axis: UpAxis) -> sky::UpAxis {
    match axis {
        UpAxis::Y => sky::UpAxis::Y,
        UpAxis::Z => sky::UpAxis::Z,
    }
}

/// Adds the daylight at a prim; `transform` takes its local space to metres, and turns the sky with the prim.
pub(crate) fn add_lights<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, transform: &Transform) {
    let is_light = light::is_light(&prim.type_name());
    let Some(own) = (if is_light { light::light(context, prim, transform) } else { Some(Light::default()) }) else { return };
    let frame = Frame { up_axis: up_axis(context.up_axis), north_deg: number(context, prim, "north").unwrap_or(0.0) };
    let rows = context.get_authored::<i32>(prim, &name("rows")).map_or(sky::DEFAULT_ROWS, |rows| u32::try_from(rows).unwrap_or(0));
    let first = context.scene.lights.len();
    let added = read(context, prim).and_then(|daylight| daylight.add_to(&mut context.scene, &frame, rows));
    if let Err(error) = added {
        return context.warn(&prim.origin(), format!("{error}; there is no daylight"));
    }
    if own.quantity.is_some() || own.spectrum.is_some() {
        context.warn(&prim.origin(), "a quantity and a spectrum say nothing of daylight, which has its own; they are ignored");
    }
    for added in &mut context.scene.lights[first..] {
        // A dome's own strength, visibility and group hold for its sky and its sun.
        let radiance = added.emission.radiance;
        added.emission.radiance = std::array::from_fn(|i| radiance[i] * own.emission.radiance[i]);
        added.visibility = own.visibility;
        added.casts_shadow = own.casts_shadow;
        (added.diffuse, added.specular, added.volume) = (own.diffuse, own.specular, own.volume);
        added.dimming *= own.dimming;
        added.maintenance *= own.maintenance;
        added.group.clone_from(&own.group);
        added.origin = prim.origin();
        added.transform = transform.after(&added.transform);
    }
}

fn name(attribute: &str) -> String {
    format!("{PREFIX}{attribute}")
}

fn number<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, attribute: &str) -> Option<f64> {
    context.get_authored(prim, &name(attribute))
}

fn read<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> Result<Daylight> {
    let place = Place {
        latitude_deg: number(context, prim, "latitude").unwrap_or(f64::NAN),
        longitude_deg: number(context, prim, "longitude").unwrap_or(f64::NAN),
        elevation_m: number(context, prim, "elevation").unwrap_or(0.0),
    };
    let text: String = context.get_authored(prim, &name("time")).unwrap_or_default();
    let mut daylight = Daylight::new(place.checked()?, Moment::parse(&text)?);
    if let Some(hour) = number(context, prim, "hour") {
        daylight.moment.hour = hour;
    }
    if let Some(model) = context.get_authored::<String>(prim, &name("sky")) {
        daylight.model = SkyModel::parse(&model)?;
    }
    let measured = [number(context, prim, "directNormalIrradiance"), number(context, prim, "diffuseHorizontalIrradiance")];
    if measured != [None; 2] {
        let [direct_normal, diffuse_horizontal] = measured.map(|value| value.unwrap_or(f64::NAN));
        daylight.irradiance = Some(Irradiance { direct_normal, diffuse_horizontal });
    }
    daylight.turbidity = number(context, prim, "turbidity").unwrap_or(daylight.turbidity);
    daylight.dew_point_c = number(context, prim, "dewPoint").unwrap_or(daylight.dew_point_c);
    daylight.ground = number(context, prim, "ground").unwrap_or(daylight.ground);
    daylight.is_coloured = context.get_authored(prim, &name("coloured")).unwrap_or(true);
    Ok(daylight)
}
