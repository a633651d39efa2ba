//! Names of honeybee's own modifiers.

use crate::modifier::{GLASS_INDEX, Modifier};

/// What honeybee calls nothing at all between two rooms.
pub(super) const AIR_BOUNDARY: &str = "air_boundary";

/// Honeybee's modifiers that need no definition: reflectances and transmissivities by name (honeybee-standards, `radiance_default.json`).
const GENERIC: [(&str, Generic); 15] = [
    ("generic_floor_0.20", Generic::Opaque(0.2)),
    ("generic_wall_0.50", Generic::Opaque(0.5)),
    ("generic_ceiling_0.80", Generic::Opaque(0.8)),
    ("generic_opaque_door_0.50", Generic::Opaque(0.5)),
    ("generic_interior_shade_0.50", Generic::Opaque(0.5)),
    ("generic_exterior_shade_0.35", Generic::Opaque(0.35)),
    ("generic_context_0.20", Generic::Opaque(0.2)),
    ("generic_floor_exterior_side_0.50", Generic::Opaque(0.5)),
    ("generic_wall_exterior_side_0.35", Generic::Opaque(0.35)),
    ("generic_ceiling_exterior_side_0.35", Generic::Opaque(0.35)),
    ("black", Generic::Opaque(0.0)),
    ("generic_interior_window_vis_0.88", Generic::Pane(0.9584154328610596)),
    ("generic_exterior_window_vis_0.64", Generic::Pane(0.6975761815384331)),
    ("generic_exterior_screened_window_vis_0.32", Generic::Pane(0.34901895091031854)),
    (AIR_BOUNDARY, Generic::Nothing),
];

#[derive(Clone, Copy)]
enum Generic {
    Opaque(f64),
    Pane(f64),
    Nothing,
}

/// Honeybee's own modifier of a name.
pub(super) fn generic(name: &str) -> Option<Modifier> {
    let (_, found) = GENERIC.iter().find(|(known, _)| *known == name)?;
    Some(match *found {
        Generic::Opaque(reflectance) => Modifier::Plastic { colour: [reflectance; 3], specularity: 0.0, roughness: 0.0 },
        Generic::Pane(transmissivity) => Modifier::Glass { transmissivity: [transmissivity; 3], index: GLASS_INDEX },
        Generic::Nothing => Modifier::Void,
    })
}
