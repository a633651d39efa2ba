//! Measured materials in Python.

use crate::{array::Array, buffer::doubles, error::exception, table};
use gonio::{Error, output::write_atomically, scene::read_file};
use gonio_formats::bsdf::{
    Direction, Grid, HalfVectorTable, Hemispheres, Layout, Measured, Resolution, Sampler, Table,
    gbsdf::{self, Encoding},
    read,
};
use pyo3::{
    exceptions::PyValueError,
    prelude::*,
    types::{PyBytes, PyDict, PyType},
};
use std::{
    io::Write,
    path::PathBuf,
    sync::{Arc, OnceLock},
};

/// A measured material: BSDF, density and samples at any directions, in double precision.
///
/// Directions are rows of unit vectors in the shading frame, z along the normal of the front, pointing away from the surface: light comes from
/// `wi` and leaves to `wo`. One row stands for as many as the other argument has.
#[pyclass(frozen, module = "gonio")]
pub(crate) struct MeasuredBsdf {
    measured: Arc<Measured>,
    /// What sampling needs, built when it is first asked for.
    table: OnceLock<Option<HalfVectorTable>>,
}

#[pymethods]
impl MeasuredBsdf {
    /// Reads MERL, RGL, pBRDF, UTIA, BSDF XML, Zemax and .gbsdf files, told apart by their content.
    #[staticmethod]
    fn from_file(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let found = py.detach(|| {
            let bytes = read_file(&path).map_err(|error| Error::io(&path, error))?;
            read(&bytes, &path.to_string_lossy()).map_err(|error| Error::in_file(&path, &error))
        });
        found.map(Self::of).map_err(exception)
    }

    /// Reads a file's bytes; `name` stands in messages.
    #[staticmethod]
    #[pyo3(signature = (data, name = "bytes"))]
    fn from_bytes(py: Python<'_>, data: &[u8], name: &str) -> PyResult<Self> {
        let found = py.detach(|| read(data, name).map_err(|error| Error::in_file(name, &error)));
        found.map(Self::of).map_err(exception)
    }

    /// A table of BSDF values in 1/sr, without a cosine, over axes in degrees, whose names say what they mean: theta_i, theta_o, delta_phi;
    /// theta_i, phi_i, theta_o, phi_o; theta_h, theta_d, phi_d; or rotation, theta_i, azimuth, radial. Values have the axes' order, then
    /// channels; NaN was not measured. Between angles values are linear, or those of the nearest angle for axes named in `nearest`; axes in
    /// `periods` go on after so many degrees. One channel is luminance, three are linear Rec.709 unless `xyz`, and any number has wavelengths
    /// in nm.
    #[staticmethod]
    #[pyo3(signature = (axes, values, *, side = "reflection-front", periods = None, nearest = None, wavelengths = None, xyz = false, reciprocal = false, bilateral = false))]
    #[expect(clippy::too_many_arguments, reason = "keyword arguments")]
    fn from_table(
        axes: &Bound<'_, PyDict>,
        values: &Bound<'_, PyAny>,
        side: &str,
        periods: Option<&Bound<'_, PyDict>>,
        nearest: Option<Vec<String>>,
        wavelengths: Option<Vec<f64>>,
        xyz: bool,
        reciprocal: bool,
        bilateral: bool,
    ) -> PyResult<Self> {
        let numbers = doubles(values, "values")?;
        let (coordinates, axes) = table::axes(axes, periods, &nearest.unwrap_or_default())?;
        let cells = axes.iter().map(|axis| axis.knots().len()).product();
        let channels = table::channels(numbers.len(), cells, wavelengths, xyz)?;
        let hemispheres = table::side(side)?;
        let layout = Layout { coordinates, axes, channels, hemispheres, reciprocal, bilateral };
        let numbers = numbers.into_iter().map(|x| x as f32).collect();
        let table = Table::new(layout, numbers).map_err(|error| table::wrong(&error))?;
        Ok(Self::of(Measured::Tables(vec![table])))
    }

    /// What pickles and other processes make the same material of: `from_bytes` and the bytes of a file of its kind.
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, (Bound<'py, PyType>,))> {
        let bytes = py.detach(|| self.measured.to_bytes());
        let make = py.import("operator")?.getattr("methodcaller")?.call1(("from_bytes", PyBytes::new(py, &bytes)))?;
        Ok((make, (py.get_type::<Self>(),)))
    }

    /// Names of the channels: Y; R, G, B; X, Y, Z; or wavelengths.
    #[getter]
    fn channels(&self) -> Vec<String> {
        table::channel_names(self.measured.channels())
    }

    /// Whether only the difference of azimuths counts.
    #[getter]
    fn isotropic(&self) -> bool {
        self.measured.is_isotropic()
    }

    /// What was measured: reflection-front, reflection-back, transmission-front, transmission-back; the word is the side light comes from.
    #[getter]
    fn sides(&self) -> Vec<&'static str> {
        Hemispheres::ALL.into_iter().filter(|side| self.measured.has(*side)).map(Hemispheres::name).collect()
    }

    /// BSDF × |cos θi| in 1/sr, a row of channels for each pair; of linear Rec.709 if `rgb`.
    #[pyo3(signature = (wi, wo, *, rgb = false))]
    fn eval(&self, py: Python<'_>, wi: &Bound<'_, PyAny>, wo: &Bound<'_, PyAny>, rgb: bool) -> PyResult<Array> {
        let pairs = Pairs::new(wi, wo)?;
        let channels = self.measured.channels();
        let count = channels.count();
        let values = py.detach(|| {
            let mut values = vec![0.0; count * pairs.len()];
            for ((wi, wo), out) in pairs.iter().zip(values.chunks_exact_mut(count)) {
                self.measured.eval(wi, wo, out);
            }
            if !rgb {
                return (values, count);
            }
            let weights = channels.rgb_weights();
            let seen = |row: &[f64], c: usize| row.iter().zip(&weights).map(|(v, w)| v * w[c]).sum::<f64>();
            (values.chunks_exact(count).flat_map(|row| [0, 1, 2].map(|c| seen(row, c))).collect(), 3)
        });
        Ok(Array::rows(values.0, values.1))
    }

    /// The density of `sample` per solid angle, a number for each pair.
    fn pdf(&self, py: Python<'_>, wi: &Bound<'_, PyAny>, wo: &Bound<'_, PyAny>) -> PyResult<Array> {
        let pairs = Pairs::new(wi, wo)?;
        let densities = py.detach(|| {
            let sampler = self.sampler();
            pairs.iter().map(|(wi, wo)| sampler.pdf(wo, wi)).collect()
        });
        Ok(Array::flat(densities))
    }

    /// Directions that light comes from to leave to `wo`, and their densities, from rows of three uniform numbers in [0, 1). Where there is no
    /// such direction both are zero.
    fn sample(&self, py: Python<'_>, wo: &Bound<'_, PyAny>, u: &Bound<'_, PyAny>) -> PyResult<(Array, Array)> {
        let numbers = rows(&doubles(u, "u")?, "u")?;
        let pairs = Pairs::of(directions(wo, "wo")?, numbers, ["wo", "u"])?;
        let (found, densities): (Vec<Direction>, Vec<f64>) = py.detach(|| {
            let sampler = self.sampler();
            let one = |(wo, u)| sampler.sample(wo, u).map_or(([0.0; 3], 0.0), |sample| (sample.wi, sample.pdf));
            pairs.iter().map(one).unzip()
        });
        Ok((Array::rows(found.into_flattened(), 3), Array::flat(densities)))
    }

    /// The nearest OpenPBR surface to the front's reflection, by OpenPBR's names: base_color, base_metalness, specular_roughness,
    /// specular_roughness_anisotropy, specular_ior, the rotation of its wider way in degrees from the tangent, and the residual: the root mean
    /// square of differences between cube roots of BSDF × cosine, over that of the measured cube roots.
    fn fit<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let fit = py.detach(|| self.measured.fit()).map_err(|error| table::wrong(&error))?;
        let found = PyDict::new(py);
        found.set_item("base_color", fit.base_color)?;
        found.set_item("base_metalness", fit.base_metalness)?;
        found.set_item("specular_roughness", fit.specular_roughness)?;
        found.set_item("specular_roughness_anisotropy", fit.specular_roughness_anisotropy)?;
        found.set_item("specular_ior", fit.specular_ior)?;
        found.set_item("rotation_deg", fit.rotation_deg)?;
        found.set_item("residual", fit.residual)?;
        Ok(found)
    }

    /// Writes it as .gbsdf: tables as they are; everything else evaluated at `theta` polar angles and `phi` azimuths of a turn, 46 and 72 where
    /// none are given, 19 and 36 of anisotropic materials.
    #[pyo3(signature = (path, *, title = "", text = false, theta = None, phi = None))]
    fn write(&self, py: Python<'_>, path: PathBuf, title: &str, text: bool, theta: Option<usize>, phi: Option<usize>) -> PyResult<()> {
        let encoding = if text { Encoding::Text } else { Encoding::Binary };
        let grid = Grid::new(&self.measured, theta, phi);
        py.detach(|| {
            let bytes = match &*self.measured {
                Measured::Tables(tables) => gbsdf::write(tables, title, encoding),
                other => {
                    let tables = other.resampled(grid);
                    let tables = tables.map_err(|error| Error::setting("theta, phi", error.problem))?;
                    gbsdf::write(&tables, title, encoding)
                }
            };
            write_atomically(&path, true, |file| file.write_all(&bytes))
        })
        .map_err(exception)
    }
}

impl MeasuredBsdf {
    /// A measured material.
    pub(crate) fn of(measured: Measured) -> Self {
        Self { measured: Arc::new(measured), table: OnceLock::new() }
    }

    /// What was measured, to be shared with scenes.
    pub(crate) fn shared(&self) -> Arc<Measured> {
        self.measured.clone()
    }

    fn sampler(&self) -> Sampler<'_> {
        let build = || Sampler::new(&self.measured, &Resolution::of(&self.measured)).table().cloned();
        Sampler::with_table(&self.measured, self.table.get_or_init(build).as_ref())
    }
}

/// Rows of two arguments beside each other; a single row stands for all.
struct Pairs {
    first: Vec<[f64; 3]>,
    second: Vec<[f64; 3]>,
}

impl Pairs {
    fn new(wi: &Bound<'_, PyAny>, wo: &Bound<'_, PyAny>) -> PyResult<Self> {
        Self::of(directions(wi, "wi")?, directions(wo, "wo")?, ["wi", "wo"])
    }

    fn of(first: Vec<[f64; 3]>, second: Vec<[f64; 3]>, names: [&str; 2]) -> PyResult<Self> {
        if first.len() == second.len() || first.len() == 1 || second.len() == 1 {
            return Ok(Self { first, second });
        }
        let ([a, b], [m, n]) = (names, [first.len(), second.len()]);
        Err(PyValueError::new_err(format!("{a} has {m} rows and {b} has {n}, expected as many or one")))
    }

    fn len(&self) -> usize {
        if self.first.len() == 1 { self.second.len() } else { self.first.len() }
    }

    fn iter(&self) -> impl Iterator<Item = ([f64; 3], [f64; 3])> {
        let at = |rows: &[[f64; 3]], i: usize| rows[if rows.len() == 1 { 0 } else { i }];
        (0..self.len()).map(move |i| (at(&self.first, i), at(&self.second, i)))
    }
}

/// Numbers in rows of three.
fn rows(numbers: &[f64], name: &str) -> PyResult<Vec<[f64; 3]>> {
    match numbers.as_chunks() {
        (rows, []) => Ok(rows.to_vec()),
        _ => Err(PyValueError::new_err(format!("{name}: {} numbers were found, expected rows of 3", numbers.len()))),
    }
}

/// Unit vectors along rows of three numbers.
fn directions(object: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<Direction>> {
    let mut rows = rows(&doubles(object, name)?, name)?;
    for (i, row) in rows.iter_mut().enumerate() {
        let length = row.iter().map(|x| x * x).sum::<f64>().sqrt();
        if !(length.is_finite() && length > 0.0) {
            return Err(PyValueError::new_err(format!("{name}: row {i} is {row:?}, expected a direction")));
        }
        *row = row.map(|x| x / length);
    }
    Ok(rows)
}
