//! GeomSubsets: faces of a mesh with a material of their own.

use crate::context::Context;
use crate::prim::Prim;
use crate::pxr::Module;
use pyo3::intern;
use pyo3::prelude::*;

/// The subsets of a mesh that bind materials.
#[derive(Debug, Default)]
pub struct Subsets<'py> {
    /// Their prims; slot 1 is the first.
    pub prims: Vec<Prim<'py>>,
    /// The slot of each face, 0 where no subset has it; `None` without subsets.
    pub face_slots: Option<Vec<u16>>,
}

/// Reads the face subsets among the mesh's children whose family is `materialBind`, or that have none but bind a material.
pub fn read<'py>(context: &mut Context<'_, 'py>, mesh: &Prim<'py>, face_count: usize) -> Subsets<'py> {
    let mut subsets = Subsets::default();
    for child in children(mesh) {
        if child.type_name() != "GeomSubset" || !binds_material(context, &child) {
            continue;
        }
        let slot = u16::try_from(subsets.prims.len() + 1);
        let (Some(indices), Ok(slot)) = (context.get_authored::<Vec<i32>>(&child, "indices"), slot) else { continue };
        let slots = subsets.face_slots.get_or_insert_with(|| vec![0; face_count]);
        let (outside, overlapping) = assign(slots, &indices, slot);
        if outside > 0 {
            let message = format!("{outside} of {} indices name no face, the mesh has {face_count}; they are ignored", indices.len());
            context.warn(&child.origin(), message);
        }
        if overlapping > 0 {
            context.warn(&child.origin(), format!("an earlier subset has {overlapping} of its faces too, and keeps them"));
        }
        subsets.prims.push(child);
    }
    subsets
}

fn children<'py>(mesh: &Prim<'py>) -> Vec<Prim<'py>> {
    let py = mesh.py();
    if !mesh.is_instance() {
        return mesh.displayed_children().collect();
    }
    // An instanced mesh has its subsets as instance proxies.
    let proxies = || Module::Usd.item(py, "TraverseInstanceProxies")?.call0();
    let list = proxies().and_then(|predicate| mesh.object().call_method1(intern!(py, "GetFilteredChildren"), (predicate,)));
    list.and_then(|list| list.try_iter()?.map(|child| child.map(Prim::new)).collect()).unwrap_or_default()
}

fn binds_material<'py>(context: &mut Context<'_, 'py>, subset: &Prim<'py>) -> bool {
    let family = context.get_authored::<String>(subset, "familyName").unwrap_or_default();
    let is_for_faces = context.get_authored::<String>(subset, "elementType").is_none_or(|element| element == "face");
    is_for_faces && (family == "materialBind" || family.is_empty() && subset.has_authored_prefix("material:binding"))
}

/// Gives the faces a slot; returns how many indices are out of range, and how many faces have one already.
fn assign(slots: &mut [u16], indices: &[i32], slot: u16) -> (usize, usize) {
    let (mut outside, mut overlapping) = (0, 0);
    for &index in indices {
        match usize::try_from(index).ok().and_then(|face| slots.get_mut(face)) {
            None => outside += 1,
            Some(taken) if *taken == 0 => *taken = slot,
            Some(taken) => overlapping += usize::from(*taken != slot),
        }
    }
    (outside, overlapping)
}

#[cfg(test)]
mod tests {
    use super::assign;

    #[test]
    fn the_first_subset_keeps_a_face() {
        let mut slots = [0; 4];
        assert_eq!(assign(&mut slots, &[0, 1, 1], 1), (0, 0));
        assert_eq!(assign(&mut slots, &[1, 2, 7, -1], 2), (2, 1));
        assert_eq!(slots, [1, 1, 2, 0]);
    }
}
