//! Modifier sets: what surfaces are made of by what they are, and honeybee's own where nobody says.

use super::node::Node;

/// A room's modifier set; without one the generic one.
#[derive(Clone, Debug, Default)]
pub(super) struct Set<'a> {
    node: Option<Node<'a>>,
}

/// What a set says of a surface: its part and the key in there, and honeybee's own modifier.
pub(super) type Place = (&'static str, &'static str, &'static str);

impl<'a> Set<'a> {
    pub(super) fn of(node: Node<'a>) -> Self {
        Self { node: Some(node) }
    }

    /// The modifier of a place, by name or defined there; `None` leaves it to honeybee's own.
    pub(super) fn get(&self, (part, key, _): Place) -> Option<Node<'a>> {
        let node = self.node.as_ref()?;
        if part.is_empty() { node.get(key) } else { node.get(part)?.get(key) }
    }
}

/// Where a face stands in a set.
pub(super) fn of_face(face_type: &str, boundary: &str) -> Option<Place> {
    let key = if boundary == "Outdoors" { "exterior_modifier" } else { "interior_modifier" };
    Some(match face_type {
        "Wall" => ("wall_set", key, "generic_wall_0.50"),
        "Floor" => ("floor_set", key, "generic_floor_0.20"),
        "RoofCeiling" => ("roof_ceiling_set", key, "generic_ceiling_0.80"),
        "AirBoundary" => ("", "air_boundary_modifier", super::generic::AIR_BOUNDARY),
        _ => return None,
    })
}

/// Where a window stands in a set.
pub(super) fn of_aperture(boundary: &str, is_operable: bool, face_type: &str) -> Place {
    const PANE: &str = "generic_exterior_window_vis_0.64";
    match (boundary, is_operable, face_type) {
        ("Surface", ..) => ("aperture_set", "interior_modifier", "generic_interior_window_vis_0.88"),
        (_, true, _) => ("aperture_set", "operable_modifier", PANE),
        (_, false, "Wall") => ("aperture_set", "window_modifier", PANE),
        _ => ("aperture_set", "skylight_modifier", PANE),
    }
}

/// Where a door stands in a set.
pub(super) fn of_door(boundary: &str, is_glass: bool, face_type: &str) -> Place {
    const LEAF: &str = "generic_opaque_door_0.50";
    match (boundary, is_glass, face_type) {
        ("Surface", true, _) => ("door_set", "interior_glass_modifier", "generic_interior_window_vis_0.88"),
        ("Surface", false, _) => ("door_set", "interior_modifier", LEAF),
        (_, true, _) => ("door_set", "exterior_glass_modifier", "generic_exterior_window_vis_0.64"),
        (_, false, "Wall") => ("door_set", "exterior_modifier", LEAF),
        _ => ("door_set", "overhead_modifier", LEAF),
    }
}

/// Where a shade stands in a set.
pub(super) fn of_shade(is_indoor: bool) -> Place {
    if is_indoor {
        ("shade_set", "interior_modifier", "generic_interior_shade_0.50")
    } else {
        ("shade_set", "exterior_modifier", "generic_exterior_shade_0.35")
    }
}

/// Where a shade without a parent stands; no set says anything of those that are detached.
pub(super) fn of_orphan(is_detached: bool) -> Place {
    if is_detached { ("", "", "generic_context_0.20") } else { of_shade(false) }
}
