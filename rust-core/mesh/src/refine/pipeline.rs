//! From a polygon mesh to its refined mesh: base level, steps, limit, primvars.

use super::face_varying::{self, Channel};
use super::limit_normals::{Surface, normals};
use super::result::{RefineError, Refined};
use super::sharpness::sharpen;
use super::stage::{Linear, Rule, Stage};
use super::topology::Level;
use super::{BoundaryInterpolation, Creases, FaceVaryingInterpolation, RefineOptions, Scheme, TriangleRule};
use crate::triangulate::triangulate_faces;
use crate::vector::Vec3;
use crate::{FacePrimvar, Interpolation, MeshProblem, PolygonMesh, Severity};
use std::sync::atomic::{AtomicBool, Ordering};

/// Subdivides `mesh`. Primvars are carried by their interpolation: vertex like the points, varying linearly,
/// face-varying by `options.face_varying`, uniform and constant as they are; broken ones are dropped. Unindexed
/// face-varying values are continuous where neighbouring corners of a point agree bit for bit. Reads `cancel` once a level.
///
/// # Errors
/// Broken topology, and cancellation.
pub fn refine(mesh: &PolygonMesh, creases: &Creases, options: &RefineOptions, cancel: Option<&AtomicBool>) -> Result<Refined, RefineError> {
    let problems = mesh.validate();
    if problems.iter().any(|problem| problem.severity() == Severity::Fatal) {
        return Err(RefineError::Invalid(problems));
    }
    let mut refinement = Refinement::new(mesh, creases, options, problems);
    let level = refinement.allowed_level();
    for _ in 0..level {
        if cancel.is_some_and(|flag| flag.load(Ordering::Relaxed)) {
            return Err(RefineError::Cancelled);
        }
        refinement.step();
    }
    Ok(refinement.finish(level))
}

/// The faces of the base level, as corners of the original mesh.
struct Base {
    level: Level,
    /// Corner of the original mesh for each corner.
    corner_of: Vec<u32>,
    face_of: Vec<u32>,
}

impl Base {
    fn new(mesh: &PolygonMesh, scheme: Scheme) -> Self {
        let is_triangular = mesh.face_counts.iter().all(|&count| count <= 3);
        let (mut face_start, mut corner_of, mut face_of) = (vec![0u32], Vec::new(), Vec::new());
        if scheme == Scheme::Loop && !is_triangular {
            let right_handed = PolygonMesh { left_handed: false, primvars: Vec::new(), ..mesh.clone() };
            let triangulation = triangulate_faces(&right_handed, |_| false);
            face_start.extend((1..=triangulation.triangles.len() as u32).map(|face| 3 * face));
            corner_of = triangulation.corner_of.into_flattened();
            face_of = triangulation.face_of;
        } else {
            for (face, range) in mesh.usable_faces() {
                corner_of.extend(range.start as u32..range.end as u32);
                face_start.push(corner_of.len() as u32);
                face_of.push(face);
            }
        }
        let corner_vertex = corner_of.iter().map(|&corner| mesh.corners[corner as usize]).collect();
        Self { level: Level::new(mesh.points.len(), face_start, corner_vertex), corner_of, face_of }
    }
}

/// Face-varying primvars that share their topology.
struct FaceVarying {
    corner_element: Vec<u32>,
    channel: Channel,
    primvars: Vec<FacePrimvar>,
}

impl FaceVarying {
    fn step(&mut self, scheme: Scheme, triangles: TriangleRule, is_linear: bool) {
        let level = &self.channel.level;
        if is_linear {
            apply_to_all(&Linear { level, scheme }, &mut self.primvars);
        } else {
            apply_to_all(&Stage::to_next(level, scheme, triangles), &mut self.primvars);
        }
        self.channel.level = split(level, scheme);
    }
}

struct Refinement<'a> {
    mesh: &'a PolygonMesh,
    options: &'a RefineOptions,
    problems: Vec<MeshProblem>,
    level: Level,
    points: Vec<Vec3>,
    face_of: Vec<u32>,
    is_hole: Vec<bool>,
    /// Primvars that are one value per point, or not interpolated.
    primvars: Vec<FacePrimvar>,
    face_varying: Vec<FaceVarying>,
}

impl<'a> Refinement<'a> {
    fn new(mesh: &'a PolygonMesh, creases: &Creases, options: &'a RefineOptions, mut problems: Vec<MeshProblem>) -> Self {
        let Base { mut level, corner_of, face_of } = Base::new(mesh, options.scheme);
        let holes = mesh.hole_mask();
        let mut base_holes: Vec<bool> = face_of.iter().map(|&face| holes[face as usize]).collect();
        // A linear surface needs no neighbours beyond the boundary, so that no face is dropped there.
        let is_kept = options.scheme == Scheme::Bilinear && options.boundary == BoundaryInterpolation::None;
        let boundary = if is_kept { BoundaryInterpolation::EdgeOnly } else { options.boundary };
        problems.extend(sharpen(&mut level, creases, boundary, &mut base_holes));
        let mut is_hole = holes;
        for (&face, hole) in face_of.iter().zip(base_holes) {
            is_hole[face as usize] |= hole;
        }
        let points = mesh.points.clone();
        let mut refinement =
            Self { mesh, options, problems, level, points, face_of, is_hole, primvars: Vec::new(), face_varying: Vec::new() };
        let dropped: Vec<Severity> = refinement.problems.iter().map(MeshProblem::severity).collect();
        for (place, primvar) in mesh.primvars.iter().enumerate() {
            if !dropped.contains(&Severity::Primvar(place)) {
                refinement.add_primvar(primvar, &corner_of);
            }
        }
        refinement
    }

    fn add_primvar(&mut self, primvar: &FacePrimvar, corner_of: &[u32]) {
        match primvar.interpolation {
            Interpolation::Constant | Interpolation::Uniform => self.primvars.push(primvar.clone()),
            Interpolation::Varying | Interpolation::Vertex => {
                let indices = primvar.indices.as_deref();
                let values = indices.map_or_else(|| primvar.values.clone(), |indices| gathered(primvar, indices));
                self.primvars.push(FacePrimvar { values, indices: None, name: primvar.name.clone(), ..*primvar });
            }
            Interpolation::FaceVarying => self.add_face_varying(primvar, corner_of),
        }
    }

    fn add_face_varying(&mut self, primvar: &FacePrimvar, corner_of: &[u32]) {
        let element = |corner: u32| primvar.element_of(corner_of[corner as usize] as usize).unwrap_or(0);
        let corners = 0..corner_of.len() as u32;
        let corner_element: Vec<u32> = if primvar.indices.is_some() {
            corners.map(element).collect()
        } else {
            let value_of = |corner: u32| primvar.at(corner_of[corner as usize] as usize).unwrap_or(&[]);
            let welded = face_varying::welded(self.level.vertex_count, &self.level.corner_vertex, value_of);
            welded.into_iter().map(element).collect()
        };
        let known = self.face_varying.iter().position(|group| group.corner_element == corner_element);
        let place = known.unwrap_or_else(|| {
            let channel = face_varying::channel(&self.level, &corner_element, self.options.face_varying);
            self.face_varying.push(FaceVarying { corner_element, channel, primvars: Vec::new() });
            self.face_varying.len() - 1
        });
        let group = &mut self.face_varying[place];
        let values = gathered(primvar, &group.channel.elements);
        group.primvars.push(FacePrimvar { values, indices: None, name: primvar.name.clone(), ..*primvar });
    }

    /// The level that `max_faces` and 32-bit indices allow.
    fn allowed_level(&mut self) -> u32 {
        // A quarter of the index range leaves room for half-edges and for the vertices of the last level.
        let max_faces = self.options.max_faces.min(1 << 28);
        let first = if self.options.scheme == Scheme::Loop { 4 * self.level.face_count() } else { self.level.corner_vertex.len() };
        let mut given = 0;
        let mut faces = first;
        while given < self.options.level && faces <= max_faces && first > 0 {
            given += 1;
            faces *= 4;
        }
        if given < self.options.level && first > 0 {
            self.problems.push(MeshProblem::LevelReduced { asked: self.options.level, given, max_faces });
        }
        given
    }

    fn is_linear(&self) -> bool {
        self.options.scheme == Scheme::Bilinear || self.options.face_varying == FaceVaryingInterpolation::All
    }

    fn step(&mut self) {
        let RefineOptions { scheme, triangles, .. } = *self.options;
        let linear = Linear { level: &self.level, scheme };
        let stage = Stage::to_next(&self.level, scheme, triangles);
        self.points = stage.apply(&self.points);
        for primvar in &mut self.primvars {
            match primvar.interpolation {
                Interpolation::Vertex => primvar.values = stage.apply_flat(&primvar.values, primvar.components),
                Interpolation::Varying => primvar.values = linear.apply_flat(&primvar.values, primvar.components),
                _ => {}
            }
        }
        let is_linear = self.is_linear();
        for group in &mut self.face_varying {
            group.step(scheme, triangles, is_linear);
        }
        let parents: Vec<u32> = match scheme {
            Scheme::Loop => (0..4 * self.level.face_count() as u32).map(|face| face / 4).collect(),
            Scheme::CatmullClark | Scheme::Bilinear => self.level.corner_faces(),
        };
        self.face_of = parents.into_iter().map(|face| self.face_of[face as usize]).collect();
        self.level = split(&self.level, scheme);
    }

    fn finish(mut self, reached: u32) -> Refined {
        let scheme = self.options.scheme;
        // The limit stencils want faces of one size, which only refined levels have.
        let to_limit = self.options.to_limit && reached > 0;
        let control = std::mem::take(&mut self.points);
        let points = if to_limit { self.move_to_limit(&control) } else { control.clone() };
        let surface = Surface {
            level: &self.level,
            control: (reached > 0).then_some(control.as_slice()),
            points: &points,
            scheme,
            left_handed: self.mesh.left_handed,
        };
        let normals = self.options.normals.then(|| normals(&surface));
        let primvars = self.carried_primvars();
        let hole_faces = (0..self.face_of.len() as u32).filter(|&face| self.is_hole[self.face_of[face as usize] as usize]).collect();
        let face_counts = self.level.face_start.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let corners = self.level.corner_vertex;
        let mesh = PolygonMesh { points, face_counts, corners, hole_faces, left_handed: self.mesh.left_handed, primvars };
        Refined { mesh, face_of: self.face_of, normals, level: reached, problems: self.problems }
    }

    /// Moves points and smooth primvars to the limit; returns the points.
    fn move_to_limit(&mut self, control: &[Vec3]) -> Vec<Vec3> {
        let scheme = self.options.scheme;
        let stage = Stage::to_limit(&self.level, scheme);
        for primvar in self.primvars.iter_mut().filter(|primvar| primvar.interpolation == Interpolation::Vertex) {
            primvar.values = stage.apply_flat(&primvar.values, primvar.components);
        }
        if !self.is_linear() {
            for group in &mut self.face_varying {
                apply_to_all(&Stage::to_limit(&group.channel.level, scheme), &mut group.primvars);
            }
        }
        stage.apply(control)
    }

    fn carried_primvars(&mut self) -> Vec<FacePrimvar> {
        let mut carried = std::mem::take(&mut self.primvars);
        for primvar in carried.iter_mut().filter(|primvar| primvar.interpolation == Interpolation::Uniform) {
            let indices = self.face_of.iter().map(|&face| primvar.element_of(face as usize).unwrap_or(0)).collect();
            primvar.indices = Some(indices);
        }
        for group in std::mem::take(&mut self.face_varying) {
            let indices = group.channel.level.corner_vertex;
            carried.extend(group.primvars.into_iter().map(|primvar| FacePrimvar { indices: Some(indices.clone()), ..primvar }));
        }
        carried
    }
}

fn split(level: &Level, scheme: Scheme) -> Level {
    if scheme == Scheme::Loop { level.split_to_triangles() } else { level.split_to_quads() }
}

fn apply_to_all(rule: &impl Rule, primvars: &mut [FacePrimvar]) {
    for primvar in primvars {
        primvar.values = rule.apply_flat(&primvar.values, primvar.components);
    }
}

/// The elements of a primvar that `indices` name.
fn gathered(primvar: &FacePrimvar, indices: &[u32]) -> Vec<f32> {
    let components = primvar.components;
    indices.iter().flat_map(|&index| &primvar.values[index as usize * components..][..components]).copied().collect()
}
