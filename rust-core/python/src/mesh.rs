//! Meshes from Python buffers: triangles of points, or triangles of polygon corners as hosts with polygons have them.

use crate::buffer::{self, floats, floats_of_any_width, indices};
use gonio::scene::{Mesh, MeshKey, Origin, Primvar, PrimvarInterpolation};
use pyo3::{exceptions::PyValueError, prelude::*, types::PyDict};
use std::sync::Arc;

/// The arrays of a mesh as the caller gives them.
pub(crate) struct MeshBuffers<'a, 'py> {
    pub(crate) points: &'a Bound<'py, PyAny>,
    pub(crate) triangles: &'a Bound<'py, PyAny>,
    pub(crate) corners: Option<&'a Bound<'py, PyAny>>,
    pub(crate) faces: Option<&'a Bound<'py, PyAny>>,
    pub(crate) normals: Option<&'a Bound<'py, PyAny>>,
    pub(crate) uvs: Option<&'a Bound<'py, PyAny>>,
    pub(crate) primvars: Option<&'a Bound<'py, PyDict>>,
    pub(crate) slots: Option<&'a Bound<'py, PyAny>>,
    pub(crate) motion: Option<&'a Bound<'py, PyAny>>,
    pub(crate) motion_normals: Option<&'a Bound<'py, PyAny>>,
}

/// What values can belong to, and how triangles find them.
struct Topology {
    points: usize,
    triangles: usize,
    /// Number of polygon corners, and the corner of each triangle corner.
    corners: Option<(usize, Arc<[u32]>)>,
    /// Number of polygons, and the polygon of each triangle.
    faces: Option<(usize, Arc<[u32]>)>,
}

impl MeshBuffers<'_, '_> {
    /// Checks and copies the arrays.
    pub(crate) fn mesh(self, name: &str) -> PyResult<Mesh> {
        let points = buffer::points(self.points, "points")?;
        let mut triangles = buffer::triangles(self.triangles, "triangles")?;
        let faces = self.faces.map(|faces| indices(faces, "faces", 1)).transpose()?.map(|faces| faces.values);
        if let Some(faces) = faces.as_ref().filter(|faces| faces.len() != triangles.len()) {
            return Err(PyValueError::new_err(format!("faces: {} values were found, expected {}", faces.len(), triangles.len())));
        }
        let corners = match self.corners {
            Some(corners) => Some(resolve_corners(&indices(corners, "corners", 1)?.values, &mut triangles)?),
            None => None,
        };
        if let Some(index) = triangles.iter().flatten().find(|index| **index as usize >= points.len()) {
            return Err(PyValueError::new_err(format!("triangles: index {index} is out of range, there are {} points", points.len())));
        }
        let faces = faces.map(|faces| (faces.iter().max().map_or(0, |most| *most as usize + 1), faces));
        let topology = Topology { points: points.len(), triangles: triangles.len(), corners, faces };
        let mut primvars = Vec::new();
        if let Some(uvs) = self.uvs {
            primvars.push(topology.primvar(uvs, "st", Some(2))?);
        }
        for (key, value) in self.primvars.into_iter().flatten() {
            primvars.push(topology.primvar(&value, &key.extract::<String>()?, None)?);
        }
        let motion = keys(self.motion, self.motion_normals, points.len())?;
        Ok(Mesh {
            origin: Origin::new(name),
            normals: self.normals.map(|normals| topology.primvar(normals, "normals", Some(3))).transpose()?,
            slots: self.slots.map(|slots| topology.slots(slots)).transpose()?,
            points,
            motion,
            triangles,
            primvars,
            faces: topology.faces.map(|(_, of_triangle)| of_triangle),
            dicing: None,
        })
    }
}

/// Keys of points (K, N, 3), with normals of as many a key where there are any.
fn keys(points: Option<&Bound<'_, PyAny>>, normals: Option<&Bound<'_, PyAny>>, count: usize) -> PyResult<Vec<MeshKey>> {
    let Some(points) = points else { return Ok(Vec::new()) };
    let points = floats(points, "motion", 3)?.values;
    let points = points.as_chunks::<3>().0;
    if count == 0 || !points.len().is_multiple_of(count) {
        return Err(PyValueError::new_err(format!("motion: {} points were found, expected {count} a key", points.len())));
    }
    let number = points.len() / count;
    let normals = normals.map(|normals| floats(normals, "motion_normals", 3)).transpose()?.map(|normals| normals.values);
    if let Some(normals) = normals.as_ref().filter(|normals| !normals.len().is_multiple_of(3 * number)) {
        return Err(PyValueError::new_err(format!("motion_normals: {} were found for {number} keys", normals.len() / 3)));
    }
    let of_key = |key: usize| {
        normals.as_ref().map(|normals| {
            let width = normals.len() / number;
            normals[key * width..(key + 1) * width].into()
        })
    };
    Ok(points.chunks(count).enumerate().map(|(key, points)| MeshKey { points: points.into(), normals: of_key(key) }).collect())
}

/// Turns corner numbers of triangles into point numbers; gives the number of corners and the corner numbers.
fn resolve_corners(corners: &[u32], triangles: &mut Arc<[[u32; 3]]>) -> PyResult<(usize, Arc<[u32]>)> {
    let of_triangles: Arc<[u32]> = triangles.as_flattened().into();
    if let Some(corner) = of_triangles.iter().find(|corner| **corner as usize >= corners.len()) {
        return Err(PyValueError::new_err(format!("triangles: corner {corner} is out of range, there are {} corners", corners.len())));
    }
    Arc::make_mut(triangles).iter_mut().flatten().for_each(|corner| *corner = corners[*corner as usize]);
    Ok((corners.len(), of_triangles))
}

impl Topology {
    /// Values as a primvar; what they belong to follows from their number.
    fn primvar(&self, object: &Bound<'_, PyAny>, name: &str, components: Option<usize>) -> PyResult<Primvar> {
        let grouped = match components {
            Some(components) => floats(object, name, components)?,
            None => floats_of_any_width(object, name)?,
        };
        let (elements, components) = (grouped.len(), grouped.width as u8);
        let values = grouped.values;
        let primvar = |interpolation, indices| Primvar { name: name.into(), interpolation, components, values, indices };
        match elements {
            // Where there are corners, values for each are what hosts have most of.
            n if self.corners.as_ref().is_some_and(|(corners, _)| *corners == n) => {
                let of_triangles = self.corners.as_ref().map(|(_, corners)| corners.clone());
                Ok(primvar(PrimvarInterpolation::FaceVarying, of_triangles))
            }
            n if n == self.points => Ok(primvar(PrimvarInterpolation::Vertex, None)),
            n if n == self.triangles * 3 => Ok(primvar(PrimvarInterpolation::FaceVarying, None)),
            n if self.faces.as_ref().is_some_and(|(faces, _)| *faces == n) => {
                Ok(primvar(PrimvarInterpolation::Uniform, self.faces.as_ref().map(|(_, faces)| faces.clone())))
            }
            n if n == self.triangles => Ok(primvar(PrimvarInterpolation::Uniform, None)),
            1 => Ok(primvar(PrimvarInterpolation::Constant, None)),
            n => {
                let corners = self.corners.as_ref().map_or(self.triangles * 3, |(corners, _)| *corners);
                let expected = format!("{} (one a point) or {corners} (one a corner)", self.points);
                Err(PyValueError::new_err(format!("{name}: {n} values were found, expected {expected}")))
            }
        }
    }

    /// Material slots, one a triangle or one a face.
    fn slots(&self, object: &Bound<'_, PyAny>) -> PyResult<Arc<[u16]>> {
        let slots = indices(object, "slots", 1)?.values;
        if slots.iter().any(|slot| *slot > u32::from(u16::MAX)) {
            return Err(PyValueError::new_err("slots: expected values from 0 to 65535"));
        }
        let of_face = |face: &u32| slots.get(*face as usize).map(|slot| *slot as u16);
        match &self.faces {
            _ if slots.len() == self.triangles => Ok(slots.iter().map(|slot| *slot as u16).collect()),
            Some((faces, of_triangle)) if slots.len() >= *faces => Ok(of_triangle.iter().filter_map(of_face).collect()),
            _ => {
                let faces = self.faces.as_ref().map_or_else(String::new, |(faces, _)| format!(" or {faces}"));
                Err(PyValueError::new_err(format!("slots: {} values were found, expected {}{faces}", slots.len(), self.triangles)))
            }
        }
    }
}
