//! Rays that Python brings.

use crate::{
    array::Array,
    buffer::doubles,
    error::{exception, setting},
    scene::Scene,
};
use gonio::rays::{self, SurfaceHits};
use gonio_simd::Execution;
use pyo3::{exceptions::PyValueError, prelude::*};
use std::sync::atomic::AtomicBool;

/// Rays between two looks at signals: some tenths of a second.
const AT_ONCE: usize = 1 << 20;

/// A scene that rays are sent into: compiled once, asked as often as wanted. Lights' own shapes block nothing, as in pictures; what cameras do not
/// see, rays do not meet.
#[pyclass(frozen, module = "gonio")]
pub(crate) struct RayCaster {
    caster: rays::RayCaster,
}

/// What rays have met, an entry each: arrays that numpy reads without a copy. Where a ray met nothing, distances are infinite, numbers −1 and all
/// else is not a number.
#[pyclass(frozen, module = "gonio")]
pub(crate) struct RayHits {
    hits: SurfaceHits,
}

#[pymethods]
impl RayCaster {
    /// Compiles the scene as it is now. `uv` names the primvar of the texture coordinates that hits have.
    #[new]
    #[pyo3(signature = (scene, *, uv = "st"))]
    fn new(py: Python<'_>, scene: &Scene, uv: &str) -> PyResult<Self> {
        let description = scene.scene.clone();
        let caster = py.detach(|| rays::RayCaster::new(&description, uv, &AtomicBool::new(false)));
        Ok(Self { caster: caster.map_err(exception)? })
    }

    /// The first surface on each ray: origins in metres and directions of any length, float buffers (N, 3); either may be one row for all.
    /// `max_distance` in metres.
    #[pyo3(signature = (origins, directions, *, max_distance = None))]
    fn first_hits(
        &self,
        py: Python<'_>,
        origins: &Bound<'_, PyAny>,
        directions: &Bound<'_, PyAny>,
        max_distance: Option<f64>,
    ) -> PyResult<RayHits> {
        let (mut origins, mut directions) = (vectors(origins, "origins")?, vectors(directions, "directions")?);
        match (origins.len(), directions.len()) {
            (1, count) => origins = vec![origins[0]; count],
            (count, 1) => directions = vec![directions[0]; count],
            (a, b) if a == b => {}
            (a, b) => return Err(setting("directions", format!("{b} were found for {a} origins"))),
        }
        let farthest = max_distance.unwrap_or(f64::INFINITY);
        if farthest.is_nan() || farthest <= 0.0 {
            return Err(setting("max_distance", format!("{farthest} was found, expected metres above 0")));
        }
        let mut hits = SurfaceHits::default();
        for (origins, directions) in origins.chunks(AT_ONCE).zip(directions.chunks(AT_ONCE)) {
            py.check_signals()?;
            let found = py.detach(|| self.caster.first_hits(origins, directions, farthest, Execution::detect()));
            hits.append(found.map_err(exception)?);
        }
        Ok(RayHits { hits })
    }
}

/// Rows of three numbers.
fn vectors(object: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<[f64; 3]>> {
    let shape: Option<Vec<usize>> = object.getattr("shape").and_then(|shape| shape.extract()).ok();
    match shape.as_deref() {
        None | Some([3] | [_, 3]) => {}
        Some(shape) => return Err(PyValueError::new_err(format!("{name}: the shape is {shape:?}, expected (N, 3)"))),
    }
    let values = doubles(object, name)?;
    if !values.len().is_multiple_of(3) {
        return Err(PyValueError::new_err(format!("{name}: {} numbers were found, expected three a ray", values.len())));
    }
    Ok(values.as_chunks::<3>().0.to_vec())
}

#[pymethods]
impl RayHits {
    /// Whether each ray met a surface: int32, 1 or 0.
    #[getter]
    fn hit(&self) -> Array {
        Array::integers(self.hits.numbers.iter().map(|numbers| i32::from(numbers[0] >= 0)).collect())
    }
    /// Metres from the origin, (N,) float64.
    #[getter]
    fn distance(&self) -> Array {
        Array::flat(self.hits.distance.clone())
    }
    /// Points in the world, metres, (N, 3).
    #[getter]
    fn position(&self) -> Array {
        rows(&self.hits.position)
    }
    /// Unit shading normals in the world, (N, 3), on the side from which the triangle's corners run counter-clockwise.
    #[getter]
    fn normal(&self) -> Array {
        rows(&self.hits.normal)
    }
    /// The triangles' own unit normals, (N, 3), on the same side.
    #[getter]
    fn geometric_normal(&self) -> Array {
        rows(&self.hits.geometric_normal)
    }
    /// Texture coordinates, (N, 2); not a number where the mesh has none.
    #[getter]
    fn uv(&self) -> Array {
        rows(&self.hits.uv)
    }
    /// Numbers that `put_instances` gave, (N,) int32.
    #[getter]
    fn instance(&self) -> Array {
        self.numbers(0)
    }
    /// Numbers of the placements among those of the instances, (N,) int32.
    #[getter]
    fn placement(&self) -> Array {
        self.numbers(1)
    }
    /// Numbers of the materials, (N,) int32; −1 also where the instance has none.
    #[getter]
    fn material(&self) -> Array {
        self.numbers(2)
    }
    /// Numbers of the triangles in their mesh, (N,) int32; of a mesh that is diced, in what it was cut into.
    #[getter]
    fn triangle(&self) -> Array {
        self.numbers(3)
    }
    /// Number of rays.
    fn __len__(&self) -> usize {
        self.hits.distance.len()
    }
}

impl RayHits {
    fn numbers(&self, place: usize) -> Array {
        Array::integers(self.hits.numbers.iter().map(|numbers| numbers[place]).collect())
    }
}

fn rows<const N: usize>(vectors: &[[f64; N]]) -> Array {
    Array::rows(vectors.as_flattened().to_vec(), N)
}
