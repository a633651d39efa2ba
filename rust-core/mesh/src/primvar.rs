//! Primvars of polygon meshes: named values with a rule how they spread over the surface.

use super::interpolation::Interpolation;
use super::triangulation::Triangulation;

/// A primvar: `values` holds elements of `components` floats each; `indices`, when present, picks an element per
/// constant, face, point or face corner, as `interpolation` says.
#[derive(Clone, Debug, PartialEq)]
pub struct FacePrimvar {
    /// Name without a namespace, such as `st`.
    pub name: String,
    /// What one element belongs to.
    pub interpolation: Interpolation,
    /// Floats per element, 1 to 16.
    pub components: usize,
    /// Elements, one after the other.
    pub values: Vec<f32>,
    /// Element of each place; `None` where places and elements agree one to one.
    pub indices: Option<Vec<u32>>,
}

impl FacePrimvar {
    /// Number of whole elements in `values`.
    #[must_use]
    pub fn element_count(&self) -> usize {
        self.values.len() / self.components.max(1)
    }

    /// Number of places that have an element: the indices where there are any, else the elements.
    #[must_use]
    pub fn place_count(&self) -> usize {
        self.indices.as_ref().map_or_else(|| self.element_count(), Vec::len)
    }

    /// Element index of `place` (a face, point or corner); `None` out of range.
    #[must_use]
    pub fn element_of(&self, place: usize) -> Option<u32> {
        match &self.indices {
            Some(indices) => indices.get(place).copied(),
            None => (place < self.element_count()).then_some(place as u32),
        }
    }

    /// Floats of the element at `place`; `None` out of range.
    #[must_use]
    pub fn at(&self, place: usize) -> Option<&[f32]> {
        let start = self.element_of(place)? as usize * self.components;
        self.values.get(start..start + self.components)
    }

    /// The same primvar over the triangles of `triangulation`: uniform gets one index per triangle, face-varying three
    /// per triangle; constant, varying and vertex stay as they are. A place without an element gets element 0.
    #[must_use]
    pub fn triangulated(&self, triangulation: &Triangulation) -> Self {
        let element = |&place: &u32| self.element_of(place as usize).unwrap_or(0);
        let indices = match self.interpolation {
            Interpolation::Uniform => Some(triangulation.face_of.iter().map(element).collect()),
            Interpolation::FaceVarying => Some(triangulation.corner_of.iter().flatten().map(element).collect()),
            Interpolation::Constant | Interpolation::Varying | Interpolation::Vertex => self.indices.clone(),
        };
        Self { indices, values: self.values.clone(), name: self.name.clone(), ..*self }
    }
}
