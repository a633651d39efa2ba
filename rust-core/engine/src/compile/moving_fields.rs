//! Fields that move while the shutter is open, with the one placement of what their media fill.

use super::{fields::base, motion};
use crate::{
    error::Diagnostic,
    scene::{FieldId, Instances, Scene},
    transport::MovingFields,
};
use gonio_simd::motion::Rows;

/// Which fields move, and how, in world space rebased to an origin.
pub(super) fn moving(scene: &Scene, origin: [f64; 3]) -> MovingFields {
    let mut moving = MovingFields::default();
    for (set, id) in held(scene).filter(|(set, _)| set.transforms.len() == 1) {
        let field = &scene.fields[id.index()];
        let Some(inverse) = field.to_world.inverse() else { continue };
        // What cannot be used of the keys is told where the placements are laid out.
        let Some((_, motion)) = motion::motions(set, &scene.settings, origin, &mut Vec::new()).into_iter().next() else { continue };
        let (columns, base) = (inverse.after(&set.transforms[0]).columns, base(field));
        let to_lattice: Rows = std::array::from_fn(|axis| {
            let [x, y, z, added] = columns.map(|column| column[axis]);
            [x, y, z, added - f64::from(base[axis])]
        });
        moving.add(id.0 + 1, motion, to_lattice);
    }
    moving
}

/// Says which fields cannot move with what holds them.
pub(super) fn report(scene: &Scene, diagnostics: &mut Vec<Diagnostic>) {
    for (set, id) in held(scene).filter(|(set, _)| set.transforms.len() > 1) {
        let problem =
            format!("it is in {} things that move; it stands still within them, one field each moves with it", set.transforms.len());
        diagnostics.push(Diagnostic::warning(&scene.fields[id.index()].origin, problem));
    }
}

/// Sets of placements that move, with the fields of the media in them.
fn held(scene: &Scene) -> impl Iterator<Item = (&Instances, FieldId)> {
    let moves = |set: &&Instances| !scene.fields.is_empty() && motion::moves(set, &scene.settings);
    let medium = |set: &Instances| -> Vec<FieldId> {
        let materials = set.materials.iter().filter_map(|material| scene.materials.get(material.index()));
        let mut found: Vec<FieldId> =
            materials.filter_map(|material| material.medium.field).filter(|id| id.index() < scene.fields.len()).collect();
        found.dedup();
        found
    };
    scene.instances.iter().filter(moves).flat_map(move |set| medium(set).into_iter().map(move |id| (set, id)))
}
