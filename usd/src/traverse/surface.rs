//! Meshes, quadrics, curves, points and their materials.

use super::{Branch, Walker, push};
use crate::model::{Inherited, Kind, Model, Shape};
use crate::prim::Prim;
use crate::{curves, draw_mode, material, mesh, mesh_light, meter, points, primvar, quadrics};
use gonio::Result;
use gonio::mesh::Interpolation;
use gonio::scene::{Geometry, Primvar};
use std::cell::OnceCell;
use std::rc::Rc;

impl<'py> Walker<'_, '_, 'py> {
    /// Adds what was read of a mesh, or of what becomes one.
    pub(super) fn mesh(&mut self, prim: &Prim<'py>, read: Option<mesh::ReadMesh>, branch: &Branch, model: &mut Model) -> Result<()> {
        let Some(mesh::ReadMesh { source, slot_prims }) = read else { return Ok(()) };
        let has_opacity = source.polygons.primvars.iter().any(|primvar| primvar.name == "displayOpacity");
        let is_light = mesh_light::is_geometry_light(prim);
        let mesh = self.submit(source)?;
        let shape = Shape { geometry: mesh.into(), slots: Rc::default(), slot_prims, has_opacity, is_light };
        if meter::is_measured(prim) {
            push(model, prim, branch, Kind::Measured(Some(mesh)));
        }
        // A binding may stand on a subset alone.
        let is_bound = branch.is_bound || shape.slot_prims.len() > 1;
        self.push_shape(prim, &Branch { is_bound, ..branch.clone() }, shape, model);
        Ok(())
    }

    /// Adds what is drawn in the place of a model.
    pub(super) fn stand_in(&mut self, prim: &Prim<'py>, branch: &Branch, model: &mut Model) -> Result<()> {
        let Some((source, materials)) = draw_mode::stand_in(self.context, prim, branch.draw_mode) else { return Ok(()) };
        let slots = Rc::new(OnceCell::from(materials));
        let shape = Shape { geometry: self.submit(source)?.into(), slots, slot_prims: Vec::new(), has_opacity: false, is_light: false };
        push(model, prim, branch, Kind::Shape(shape));
        Ok(())
    }

    fn push_shape(&mut self, prim: &Prim<'py>, branch: &Branch, shape: Shape, model: &mut Model) {
        if branch.is_bound {
            self.to_bind.push((shape.slot_prims.clone(), shape.slots.clone()));
        }
        push(model, prim, branch, Kind::Shape(shape));
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
        let shape = Shape { geometry: mesh.into(), slots: Rc::default(), slot_prims: vec![prim.path()], has_opacity, is_light };
        let branch = Branch { primvars: primvar::merged(&own, &branch.primvars), ..branch.clone() };
        self.push_shape(prim, &branch, shape, model);
        Ok(())
    }

    /// Adds curves.
    pub(super) fn curves(&mut self, prim: &Prim<'py>, type_name: &str, branch: &Branch, model: &mut Model) {
        let Some(curves) = curves::read(self.context, prim, type_name) else { return };
        let has_opacity = has_opacity(&curves.primvars);
        let geometry = self.context.scene.add_curves(curves).into();
        self.push_fibres(prim, branch, geometry, has_opacity, model);
    }

    /// Adds points.
    pub(super) fn points(&mut self, prim: &Prim<'py>, branch: &Branch, model: &mut Model) {
        let Some(points) = points::read(self.context, prim) else { return };
        let has_opacity = has_opacity(&points.primvars);
        let geometry = self.context.scene.add_points(points).into();
        self.push_fibres(prim, branch, geometry, has_opacity, model);
    }

    fn push_fibres(&mut self, prim: &Prim<'py>, branch: &Branch, geometry: Geometry, has_opacity: bool, model: &mut Model) {
        if mesh_light::is_geometry_light(prim) {
            self.context.unsupported("curves and points as lights", &prim.origin());
        }
        let shape = Shape { geometry, slots: Rc::default(), slot_prims: vec![prim.path()], has_opacity, is_light: false };
        self.push_shape(prim, branch, shape, model);
    }

    /// Looks up the materials of all shapes in one call: `pxr` reads the collections above anew in each.
    pub(super) fn bind(&mut self) {
        let shapes = std::mem::take(&mut self.to_bind);
        let mut prims = Vec::new();
        // A prim that has vanished leaves its shape without materials.
        let shapes: Vec<_> = shapes
            .into_iter()
            .filter_map(|(paths, slots)| {
                let mut own: Vec<Prim<'py>> = paths.iter().map(|path| self.context.prim_at(path)).collect::<Option<_>>()?;
                let count = own.len();
                prims.append(&mut own);
                Some((count, slots))
            })
            .collect();
        if prims.is_empty() {
            return;
        }
        let mut materials = material::bound_all(self.context, &prims).into_iter();
        for (count, slots) in shapes {
            // Each cell is filled once.
            let _ = slots.set(materials.by_ref().take(count).collect());
        }
    }
}

fn has_opacity(primvars: &[Primvar]) -> bool {
    primvars.iter().any(|primvar| primvar.name == "displayOpacity")
}

/// A primvar with one value, whatever its interpolation says.
fn single(primvar: &gonio::mesh::FacePrimvar) -> Option<Inherited> {
    Some(Inherited { name: primvar.name.clone(), components: primvar.components, values: primvar.at(0)?.into(), is_varying: false })
}
