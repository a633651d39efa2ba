//! Checks of untrusted polygon meshes.

use super::problem::MAX_ELEMENTS;
use super::{FacePrimvar, MeshProblem, PolygonMesh, Severity};

impl PolygonMesh {
    /// Everything that is wrong with the mesh, topology first. Allocates nothing that depends on a count in the data.
    #[must_use]
    pub fn validate(&self) -> Vec<MeshProblem> {
        let mut problems = self.validate_topology();
        problems.extend(self.primvars.iter().enumerate().filter_map(|(place, primvar)| self.validate_primvar(place, primvar)));
        problems.extend(self.primvars.iter().filter_map(non_finite_values));
        problems
    }

    /// What is wrong with points, faces and holes.
    #[must_use]
    pub fn validate_topology(&self) -> Vec<MeshProblem> {
        let mut problems = Vec::new();
        for (what, count) in [("points", self.points.len()), ("faces", self.face_counts.len()), ("face corners", self.corners.len())] {
            if count > MAX_ELEMENTS {
                problems.push(MeshProblem::TooLarge { what, count });
            }
        }
        let expected: u64 = self.face_counts.iter().map(|&count| u64::from(count)).sum();
        if expected != self.corners.len() as u64 {
            problems.push(MeshProblem::CornerCount { expected, found: self.corners.len() });
        }
        let points = self.points.len();
        if let Some((corner, count)) = first_and_count(self.corners.iter(), |&&vertex| vertex as usize >= points) {
            problems.push(MeshProblem::VertexOutOfRange { corner, vertex: self.corners[corner], points, count });
        }
        if let Some((first, count)) = first_and_count(self.points.iter(), |point| !point.iter().all(|x| x.is_finite())) {
            problems.push(MeshProblem::NonFinitePoints { first, count });
        }
        if let Some((first, count)) = first_and_count(self.face_counts.iter(), |&&count| count < 3) {
            problems.push(MeshProblem::ShortFaces { first, count });
        }
        let faces = self.face_counts.len();
        if let Some((first, count)) = first_and_count(self.hole_faces.iter(), |&&hole| hole as usize >= faces) {
            problems.push(MeshProblem::HoleOutOfRange { hole: self.hole_faces[first], faces, count });
        }
        problems
    }

    fn validate_primvar(&self, place: usize, primvar: &FacePrimvar) -> Option<MeshProblem> {
        let name = || primvar.name.clone();
        if !(1..=16).contains(&primvar.components) {
            return Some(MeshProblem::PrimvarComponents { primvar: place, name: name(), found: primvar.components });
        }
        let expected = self.place_count(primvar.interpolation);
        let ragged = !primvar.values.len().is_multiple_of(primvar.components);
        if ragged || primvar.place_count() != expected {
            let found = primvar.place_count();
            return Some(MeshProblem::PrimvarLength {
                primvar: place,
                name: name(),
                interpolation: primvar.interpolation,
                expected,
                found,
            });
        }
        let elements = primvar.element_count();
        let indices = primvar.indices.as_deref().unwrap_or(&[]);
        let position = indices.iter().position(|&index| index as usize >= elements)?;
        Some(MeshProblem::PrimvarIndex { primvar: place, name: name(), position, index: indices[position], elements })
    }

    /// The mesh with broken primvars dropped, values that are not finite set to 0 and bad holes removed, and what was
    /// wrong.
    ///
    /// # Errors
    /// All problems, where one of them is fatal.
    pub fn checked(mut self) -> Result<(Self, Vec<MeshProblem>), Vec<MeshProblem>> {
        let problems = self.validate();
        if problems.iter().any(|problem| problem.severity() == Severity::Fatal) {
            return Err(problems);
        }
        let is_bad = |place: usize| problems.iter().any(|problem| problem.severity() == Severity::Primvar(place));
        let mut place = 0;
        self.primvars.retain(|_| {
            place += 1;
            !is_bad(place - 1)
        });
        for value in self.primvars.iter_mut().flat_map(|primvar| primvar.values.iter_mut()).filter(|value| !value.is_finite()) {
            *value = 0.0;
        }
        let faces = self.face_counts.len();
        self.hole_faces.retain(|&hole| (hole as usize) < faces);
        Ok((self, problems))
    }
}

fn non_finite_values(primvar: &FacePrimvar) -> Option<MeshProblem> {
    let count = primvar.values.iter().filter(|value| !value.is_finite()).count();
    (count > 0).then(|| MeshProblem::PrimvarNonFinite { name: primvar.name.clone(), count })
}

/// Place of the first item that `is_bad`, and how many are.
fn first_and_count<T>(items: impl Iterator<Item = T>, is_bad: impl Fn(&T) -> bool) -> Option<(usize, usize)> {
    items.enumerate().filter(|(_, item)| is_bad(item)).fold(None, |found, (place, _)| match found {
        None => Some((place, 1)),
        Some((first, count)) => Some((first, count + 1)),
    })
}
