//! Meshes, quadrics, curves, points and their materials.

use super::{Branch, Walker, push};
use crate::context::Context;
use crate::kept::{KeptPrim, KeptShape, MeshParts};
use crate::model::{Inherited, Kind, Model, Shape};
use crate::prim::Prim;
use crate::{curves, draw_mode, material, mesh, mesh_light, meter, points, primvar, quadrics};
use gonio::Result;
use gonio::mesh::Interpolation;
use gonio::scene::{Geometry, Mesh, MeshId, Primvar};
use std::cell::OnceCell;
use std::rc::Rc;

/// A mesh of the scene with what a walk asks of its prim.
struct FoundMesh<'py> {
    mesh: MeshId,
    slot_prims: Vec<Prim<'py>>,
    has_opacity: bool,
    is_light: bool,
}

/// What reads a mesh from a prim, with a message where it cannot.
pub(super) type Reader<'py> = fn(&mut Context<'_, 'py>, &Prim<'py>) -> Option<mesh::ReadMesh<'py>>;

impl<'py> Walker<'_, '_, 'py> {
    /// Adds a mesh, or what becomes one; `read` reads it.
    pub(super) fn mesh(&mut self, prim: &Prim<'py>, read: Reader<'py>, branch: &Branch, model: &mut Model) -> Result<()> {
        let Some(FoundMesh { mesh, slot_prims, has_opacity, is_light }) = self.mesh_of(prim, read)? else { return Ok(()) };
        let paths = slot_prims.iter().map(Prim::path).collect();
        let shape = Shape { geometry: mesh.into(), slots: Rc::default(), slot_prims: paths, has_opacity, is_light };
        if meter::is_measured(prim) {
            push(model, prim, branch, Kind::Measured(Some(mesh)));
        }
        // A binding may stand on a subset alone.
        let is_bound = branch.is_bound || shape.slot_prims.len() > 1;
        self.push_shape(prim, &Branch { is_bound, ..branch.clone() }, shape, slot_prims, model);
        Ok(())
    }

    /// The mesh of a prim, as it was where time does not change it.
    fn mesh_of(&mut self, prim: &Prim<'py>, read: Reader<'py>) -> Result<Option<FoundMesh<'py>>> {
        if let Some(KeptShape::Mesh(mesh, MeshParts { subsets, has_opacity, is_light })) = prim.known().still_shape(prim) {
            let subsets = subsets.iter().map(|subset| subset.prim(self.context.py));
            let slot_prims = std::iter::once(prim.clone()).chain(subsets).collect();
            self.context.kept.shapes += 1;
            let mesh = self.context.scene.add_mesh(mesh.clone());
            return Ok(Some(FoundMesh { mesh, slot_prims, has_opacity: *has_opacity, is_light: *is_light }));
        }
        let told = self.context.told();
        let Some(mesh::ReadMesh { source, slot_prims }) = read(self.context, prim) else { return Ok(None) };
        let has_opacity = source.polygons.primvars.iter().any(|primvar| primvar.name == "displayOpacity");
        let is_light = mesh_light::is_geometry_light(prim);
        let mesh = self.submit(source)?;
        if self.context.kept.is_on() && self.context.told() == told {
            // The mesh itself would be its own keeper.
            let subsets = slot_prims.iter().skip(1).map(KeptPrim::of).collect();
            self.to_keep.insert(mesh, (prim.known().clone(), MeshParts { subsets, has_opacity, is_light }));
        }
        Ok(Some(FoundMesh { mesh, slot_prims, has_opacity, is_light }))
    }

    /// Adds what is drawn in the place of a model.
    pub(super) fn stand_in(&mut self, prim: &Prim<'py>, branch: &Branch, model: &mut Model) -> Result<()> {
        let Some((source, materials)) = draw_mode::stand_in(self.context, prim, branch.draw_mode) else { return Ok(()) };
        let slots = Rc::new(OnceCell::from(materials));
        let shape = Shape { geometry: self.submit(source)?.into(), slots, slot_prims: Vec::new(), has_opacity: false, is_light: false };
        push(model, prim, branch, Kind::Shape(shape));
        Ok(())
    }

    fn push_shape(&mut self, prim: &Prim<'py>, branch: &Branch, shape: Shape, slot_prims: Vec<Prim<'py>>, model: &mut Model) {
        if branch.is_bound {
            self.to_bind.push((slot_prims, shape.slots.clone()));
        }
        push(model, prim, branch, Kind::Shape(shape));
    }

    /// Adds a sphere, a cube or the like.
    pub(super) fn quadric(&mut self, prim: &Prim<'py>, type_name: &str, branch: &Branch, model: &mut Model) -> Result<()> {
        let Some(quadric) = quadrics::read(self.context, prim, type_name) else { return Ok(()) };
        let mesh = match self.quadrics.get(&quadric.key()) {
            Some(mesh) => *mesh,
            None => {
                let mesh = match self.context.kept.quadric(&quadric.key()).cloned() {
                    Some(known) => {
                        self.context.kept.shapes += 1;
                        self.context.scene.add_mesh(Mesh { origin: prim.origin(), ..known })
                    }
                    None => self.submit(quadric.source(prim.origin(), self.context.options.complexity))?,
                };
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
        self.push_shape(prim, &branch, shape, vec![prim.clone()], model);
        Ok(())
    }

    /// Adds curves.
    pub(super) fn curves(&mut self, prim: &Prim<'py>, type_name: &str, branch: &Branch, model: &mut Model) {
        let told = self.context.told();
        let curves = match prim.known().still_shape(prim) {
            Some(KeptShape::Curves(curves)) => {
                self.context.kept.shapes += 1;
                curves.clone()
            }
            _ => {
                let Some(curves) = curves::read(self.context, prim, type_name) else { return };
                self.keep(prim, told, || KeptShape::Curves(curves.clone()));
                curves
            }
        };
        let has_opacity = has_opacity(&curves.primvars);
        let geometry = self.context.scene.add_curves(curves).into();
        self.push_fibres(prim, branch, geometry, has_opacity, model);
    }

    /// Adds points.
    pub(super) fn points(&mut self, prim: &Prim<'py>, branch: &Branch, model: &mut Model) {
        let told = self.context.told();
        let points = match prim.known().still_shape(prim) {
            Some(KeptShape::Points(points)) => {
                self.context.kept.shapes += 1;
                points.clone()
            }
            _ => {
                let Some(points) = points::read(self.context, prim) else { return };
                self.keep(prim, told, || KeptShape::Points(points.clone()));
                points
            }
        };
        let has_opacity = has_opacity(&points.primvars);
        let geometry = self.context.scene.add_points(points).into();
        self.push_fibres(prim, branch, geometry, has_opacity, model);
    }

    /// Keeps a shape that was read without anything told since.
    fn keep(&self, prim: &Prim<'py>, told: usize, shape: impl FnOnce() -> KeptShape) {
        if self.context.kept.is_on() && self.context.told() == told {
            // Full where the shape changes with time.
            let _ = prim.known().shape.set(shape());
        }
    }

    fn push_fibres(&mut self, prim: &Prim<'py>, branch: &Branch, geometry: Geometry, has_opacity: bool, model: &mut Model) {
        if mesh_light::is_geometry_light(prim) {
            self.context.unsupported("curves and points as lights", &prim.origin());
        }
        let shape = Shape { geometry, slots: Rc::default(), slot_prims: vec![prim.path()], has_opacity, is_light: false };
        self.push_shape(prim, branch, shape, vec![prim.clone()], model);
    }

    /// Looks up the materials of all shapes in one call: `pxr` reads the collections above anew in each.
    pub(super) fn bind(&mut self) {
        let shapes = std::mem::take(&mut self.to_bind);
        let mut prims = Vec::new();
        let mut counts = Vec::with_capacity(shapes.len());
        for (mut own, slots) in shapes {
            counts.push((own.len(), slots));
            prims.append(&mut own);
        }
        if prims.is_empty() {
            return;
        }
        let mut materials = material::bound_all(self.context, &prims).into_iter();
        for (count, slots) in counts {
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
