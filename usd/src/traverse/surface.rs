//! Meshes, quadrics and their materials.

use super::{Branch, Walker, push};
use crate::model::{Inherited, Kind, Model, Shape, Slot};
use crate::prim::Prim;
use crate::{material, mesh, mesh_light, meter, primvar, quadrics};
use gonio::Result;
use gonio::mesh::Interpolation;

impl<'py> Walker<'_, '_, 'py> {
    /// Adds a mesh.
    pub(super) fn mesh(&mut self, prim: &Prim<'py>, branch: &Branch, model: &mut Model) -> Result<()> {
        let Some(mesh::ReadMesh { source, slot_prims }) = mesh::read(self.context, prim) else { return Ok(()) };
        let has_opacity = source.polygons.primvars.iter().any(|primvar| primvar.name == "displayOpacity");
        let is_light = mesh_light::is_geometry_light(prim);
        let shape = Shape { mesh: self.submit(source)?, slots: vec![Slot::Unbound; slot_prims.len()], slot_prims, has_opacity, is_light };
        if meter::is_measured(prim) {
            push(model, prim, branch, Kind::Measured(Some(shape.mesh)));
        }
        // A binding may stand on a subset alone.
        let is_bound = branch.is_bound || shape.slot_prims.len() > 1;
        push(model, prim, &Branch { is_bound, ..branch.clone() }, Kind::Shape(shape));
        Ok(())
    }

    /// Adds a sphere, a cube or the like.
    pub(super) fn quadric(&mut self, prim: &Prim<'py>, type_name: &str, branch: &Branch, model: &mut Model) -> Result<()> {
        let Some(quadric) = quadrics::read(self.context, prim, type_name) else { return Ok(()) };
        let mesh = match self.quadrics.get(&quadric.key()) {
            Some(mesh) => *mesh,
            None => {
                let mesh = self.submit(quadric.source(prim.origin(), self.context.options.complexity))?;
                self.quadrics.insert(quadric.key(), mesh);
                mesh
            }
        };
        let own = primvar::authored(self.context, prim);
        for uneven in own.iter().filter(|primvar| primvar.interpolation != Interpolation::Constant && primvar.place_count() != 1) {
            self.context.unsupported(&format!("primvar '{}' that varies over a {type_name}", uneven.name), &prim.origin());
        }
        let own: Vec<Inherited> = own.iter().filter(|primvar| primvar.place_count() == 1).filter_map(single).collect();
        let has_opacity = own.iter().any(|inherited| inherited.name == "displayOpacity");
        if meter::is_measured(prim) {
            push(model, prim, branch, Kind::Measured(Some(mesh)));
        }
        let is_light = mesh_light::is_geometry_light(prim);
        let shape = Shape { mesh, slots: vec![Slot::Unbound], slot_prims: vec![prim.path()], has_opacity, is_light };
        let branch = Branch { primvars: primvar::merged(&own, &branch.primvars), ..branch.clone() };
        push(model, prim, &branch, Kind::Shape(shape));
        Ok(())
    }

    /// Looks up the materials of the model's shapes, all in one call.
    pub(super) fn bind(&mut self, model: &mut Model) {
        let mut prims = Vec::new();
        let mut places = Vec::new();
        for (index, element) in model.elements.iter().enumerate() {
            let Kind::Shape(shape) = &element.kind else { continue };
            if !element.is_bound {
                continue;
            }
            for (slot, path) in shape.slot_prims.iter().enumerate() {
                if let Some(prim) = self.context.prim_at(path) {
                    prims.push(prim);
                    places.push((index, slot));
                }
            }
        }
        if prims.is_empty() {
            return;
        }
        let materials = material::bound_all(self.context, &prims);
        for ((index, slot), material) in places.into_iter().zip(materials) {
            if let Kind::Shape(shape) = &mut model.elements[index].kind {
                shape.slots[slot] = Slot::Bound(material);
            }
        }
    }
}

/// A primvar with one value, whatever its interpolation says.
fn single(primvar: &gonio::mesh::FacePrimvar) -> Option<Inherited> {
    Some(Inherited { name: primvar.name.clone(), components: primvar.components, values: primvar.at(0)?.into(), is_varying: false })
}
