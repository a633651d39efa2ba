//! A volume prim and those of its fields.

use super::{Field, PREFIX, Volume};
use crate::context::Context;
use crate::prim::Prim;
use crate::vt::AssetPath;
use crate::xform::Xforms;
use gonio::scene::Transform;

/// Deepest field below its volume.
const MAX_DEPTH: usize = 64;

/// A volume prim; `None`, with a report, where it has no field that can be used.
pub(crate) fn read<'py>(context: &mut Context<'_, 'py>, xforms: &Xforms<'py>, prim: &Prim<'py>) -> Option<Volume> {
    let names = prim.authored_names().iter().filter_map(|name| name.strip_prefix(PREFIX).filter(|name| !name.is_empty()));
    let mut names: Vec<String> = names.map(str::to_owned).collect();
    names.sort();
    let told = context.told();
    let fields: Vec<Field> = names.into_iter().filter_map(|name| field(context, xforms, prim, name)).collect();
    if fields.is_empty() && context.told() == told {
        context.once("volume", "no fields", &prim.origin(), || "the volume has no field; it is left out".into());
    }
    (!fields.is_empty()).then_some(Volume { fields })
}

/// The field that a relationship leads to.
fn field<'py>(context: &mut Context<'_, 'py>, xforms: &Xforms<'py>, volume: &Prim<'py>, name: String) -> Option<Field> {
    let path = volume.targets(&format!("{PREFIX}{name}")).into_iter().next()?;
    let Some(prim) = context.prim_at(&path) else {
        context.warn(&volume.origin(), format!("its field '{name}' is <{path}>, which does not exist; the field is left out"));
        return None;
    };
    let type_name = prim.type_name();
    if type_name != "OpenVDBAsset" {
        context.unsupported(&format!("the field type '{type_name}'"), &prim.origin());
        return None;
    }
    let to_volume = to_volume(context, xforms, volume, &prim)?;
    let Some(file) = context.get::<AssetPath>(&prim, "filePath").filter(|file| !file.authored.is_empty()) else {
        context.warn(&prim.origin(), "no file is named; the field is left out");
        return None;
    };
    let grid: String = context.get(&prim, "fieldName").unwrap_or_default();
    let index = context.get::<i32>(&prim, "fieldIndex").map_or(0, |index| index.max(0) as usize);
    Some(Field { name, path, file, grid, index, to_volume })
}

/// From a field's file to the volume: by what stands between the two, or by the field's own transformation where it stands elsewhere.
fn to_volume<'py>(context: &mut Context<'_, 'py>, xforms: &Xforms<'py>, volume: &Prim<'py>, field: &Prim<'py>) -> Option<Transform> {
    let above = volume.path();
    let is_below = field.path().starts_with(&format!("{above}/"));
    let mut transform = Transform::IDENTITY;
    let mut place = Some(field.clone());
    for _ in 0..MAX_DEPTH {
        let Some(prim) = place.filter(|prim| prim.path() != above) else { break };
        let local = xforms.local(context, &prim)?;
        if local.resets {
            context.unsupported("a field that resets the transformations above it", &prim.origin());
            return None;
        }
        transform = local.transform.after(&transform);
        place = if is_below { prim.parent() } else { None };
    }
    Some(transform)
}
