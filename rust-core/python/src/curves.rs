//! Curves and points from Python buffers.

use crate::{
    buffer::{self, floats, floats_of_any_width, indices},
    error::setting,
};
use gonio::scene::{CurveBasis, CurveShape, CurveWrap, Curves, Origin, PointKey, PointShape, Points, Primvar, PrimvarInterpolation};
use pyo3::{exceptions::PyValueError, prelude::*, types::PyDict};

/// The arrays and words of curves as the caller gives them.
pub(crate) struct CurveBuffers<'a, 'py> {
    pub(crate) points: &'a Bound<'py, PyAny>,
    pub(crate) counts: &'a Bound<'py, PyAny>,
    pub(crate) widths: &'a Bound<'py, PyAny>,
    pub(crate) kind: &'a str,
    pub(crate) basis: &'a str,
    pub(crate) wrap: &'a str,
    pub(crate) shape: &'a str,
    pub(crate) motion: Option<&'a Bound<'py, PyAny>>,
    pub(crate) primvars: Option<&'a Bound<'py, PyDict>>,
}

impl CurveBuffers<'_, '_> {
    /// Checks and copies the arrays.
    pub(crate) fn curves(self, name: &str) -> PyResult<Curves> {
        let points = buffer::points(self.points, "points")?;
        let counts = indices(self.counts, "counts", 1)?.values;
        let sum: u64 = counts.iter().map(|count| u64::from(*count)).sum();
        if sum != points.len() as u64 {
            return Err(PyValueError::new_err(format!("counts: {sum} points in all were found, expected {}", points.len())));
        }
        let basis = match self.kind {
            "linear" => CurveBasis::Linear,
            "cubic" => one_of(
                "basis",
                self.basis,
                &[("bezier", CurveBasis::Bezier), ("bspline", CurveBasis::BSpline), ("catmullRom", CurveBasis::CatmullRom)],
            )?,
            other => return Err(setting("type", format!("'{other}' was found, expected linear or cubic"))),
        };
        let wraps = [("nonperiodic", CurveWrap::Nonperiodic), ("periodic", CurveWrap::Periodic), ("pinned", CurveWrap::Pinned)];
        let mut curves = Curves {
            origin: Origin::new(name),
            motion: keys(self.motion, points.len())?,
            points,
            counts,
            basis,
            wrap: one_of("wrap", self.wrap, &wraps)?,
            shape: one_of("shape", self.shape, &[("round", CurveShape::Round), ("ribbon", CurveShape::Ribbon)])?,
            ..Curves::default()
        };
        let elements = [
            (PrimvarInterpolation::Vertex, curves.points.len()),
            (PrimvarInterpolation::Varying, curves.joints()),
            (PrimvarInterpolation::Uniform, curves.counts.len()),
            (PrimvarInterpolation::Constant, 1),
        ];
        curves.widths = widths(self.widths, &elements)?;
        curves.primvars = primvars(self.primvars, &elements)?;
        Ok(curves)
    }
}

/// The arrays and words of points as the caller gives them.
pub(crate) struct PointBuffers<'a, 'py> {
    pub(crate) points: &'a Bound<'py, PyAny>,
    pub(crate) widths: &'a Bound<'py, PyAny>,
    pub(crate) normals: Option<&'a Bound<'py, PyAny>>,
    pub(crate) shape: &'a str,
    pub(crate) motion: Option<&'a Bound<'py, PyAny>>,
    pub(crate) primvars: Option<&'a Bound<'py, PyDict>>,
}

impl PointBuffers<'_, '_> {
    /// Checks and copies the arrays.
    pub(crate) fn points(self, name: &str) -> PyResult<Points> {
        let points = buffer::points(self.points, "points")?;
        let elements = [(PrimvarInterpolation::Vertex, points.len()), (PrimvarInterpolation::Constant, 1)];
        Ok(Points {
            origin: Origin::new(name),
            motion: keys(self.motion, points.len())?,
            points,
            widths: widths(self.widths, &elements)?,
            normals: self.normals.map(|normals| primvar(normals, "normals", Some(3), &elements)).transpose()?,
            shape: one_of("shape", self.shape, &[("sphere", PointShape::Sphere), ("disc", PointShape::Disc)])?,
            primvars: primvars(self.primvars, &elements)?,
        })
    }
}

/// Keys of points (K, N, 3).
fn keys(points: Option<&Bound<'_, PyAny>>, count: usize) -> PyResult<Vec<PointKey>> {
    let Some(points) = points else { return Ok(Vec::new()) };
    let points = floats(points, "motion", 3)?.values;
    let points = points.as_chunks::<3>().0;
    if count == 0 || !points.len().is_multiple_of(count) {
        return Err(PyValueError::new_err(format!("motion: {} points were found, expected {count} a key", points.len())));
    }
    Ok(points.chunks(count).map(|points| PointKey { points: points.into() }).collect())
}

/// How many values there are by what they belong to, the likeliest first.
type Elements<'a> = &'a [(PrimvarInterpolation, usize)];

/// The value of a word.
fn one_of<T: Copy>(name: &str, found: &str, words: &[(&str, T)]) -> PyResult<T> {
    let known = words.iter().find(|(word, _)| *word == found).map(|(_, value)| *value);
    known.ok_or_else(|| {
        let expected: Vec<&str> = words.iter().map(|(word, _)| *word).collect();
        setting(name, format!("'{found}' was found, expected one of {}", expected.join(", ")))
    })
}

/// Diameters: a number for all, or a buffer.
fn widths(object: &Bound<'_, PyAny>, elements: Elements<'_>) -> PyResult<Primvar> {
    match object.extract::<f32>() {
        Ok(width) => Ok(Primvar::constant("widths", width)),
        Err(_) => primvar(object, "widths", Some(1), elements),
    }
}

fn primvars(dictionary: Option<&Bound<'_, PyDict>>, elements: Elements<'_>) -> PyResult<Vec<Primvar>> {
    let read = |(key, value): (Bound<'_, PyAny>, Bound<'_, PyAny>)| primvar(&value, &key.extract::<String>()?, None, elements);
    dictionary.into_iter().flatten().map(read).collect()
}

/// A buffer, or a pair of it and an interpolation, which else follows from the number of values.
fn primvar(object: &Bound<'_, PyAny>, name: &str, components: Option<usize>, elements: Elements<'_>) -> PyResult<Primvar> {
    let pair = object.extract::<(Bound<'_, PyAny>, String)>().ok();
    let (object, asked) = match &pair {
        Some((buffer, word)) => (buffer, Some(interpolation(name, word)?)),
        None => (object, None),
    };
    let grouped = match components {
        Some(components) => floats(object, name, components)?,
        None => floats_of_any_width(object, name)?,
    };
    let fits = |(kind, count): &&(PrimvarInterpolation, usize)| *count == grouped.len() && asked.is_none_or(|asked| asked == *kind);
    let Some((interpolation, _)) = elements.iter().find(fits) else {
        let expected = elements.iter().filter(|(kind, _)| asked.is_none_or(|asked| asked == *kind));
        let expected: Vec<String> = expected.map(|(kind, count)| format!("{count} ({kind:?})")).collect();
        return Err(PyValueError::new_err(format!("{name}: {} values were found, expected {}", grouped.len(), expected.join(" or "))));
    };
    let (interpolation, components) = (*interpolation, grouped.width as u8);
    Ok(Primvar { name: name.into(), interpolation, components, values: grouped.values, indices: None })
}

/// What values belong to, by UsdGeom's word.
fn interpolation(name: &str, word: &str) -> PyResult<PrimvarInterpolation> {
    let words = [
        ("vertex", PrimvarInterpolation::Vertex),
        ("varying", PrimvarInterpolation::Varying),
        ("uniform", PrimvarInterpolation::Uniform),
        ("constant", PrimvarInterpolation::Constant),
    ];
    one_of(name, word, &words)
}
