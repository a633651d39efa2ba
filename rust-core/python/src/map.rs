//! Illumination maps.

use crate::{
    array::Array,
    error::{exception, setting, told},
    measure::colour_described,
    render::Render,
    scene::Scene,
    watched::{unless, watched},
};
use gonio::{
    Error,
    compile::{CompiledScene, compile},
    light_paths::Watch,
    map::{self, Chart, Looks, MapOptions, PartColour, Quantity, SideMap, TexelSize, corners},
    measure::MOST_BOUNCES,
};
use gonio_simd::Execution;
use pyo3::{prelude::*, types::PyDict};
use std::{
    path::PathBuf,
    sync::{Arc, atomic::AtomicBool},
};

/// Maps of a scene's surfaces.
#[pyclass(frozen, module = "gonio")]
pub(crate) struct IlluminationMaps {
    maps: Arc<map::IlluminationMaps>,
    scene: Arc<gonio::scene::Scene>,
    compiled: Arc<CompiledScene>,
}

/// The map of a surface.
#[pyclass(frozen, module = "gonio")]
pub(crate) struct SurfaceMap {
    maps: Arc<map::IlluminationMaps>,
    scene: Arc<gonio::scene::Scene>,
    number: usize,
    set: u32,
}

#[pymethods]
impl IlluminationMaps {
    /// The surfaces.
    #[getter]
    fn surfaces(&self) -> Vec<SurfaceMap> {
        let instances = &self.compiled.tables.geometry.instances;
        let of = |(number, map): (usize, &map::SurfaceMap)| {
            let set = instances[map.surface.instance as usize].set;
            SurfaceMap { maps: self.maps.clone(), scene: self.scene.clone(), number, set }
        };
        self.maps.surfaces.iter().enumerate().map(of).collect()
    }
    /// Light paths that were traced.
    #[getter]
    fn paths(&self) -> u64 {
        self.maps.paths
    }
    /// Relative standard error of a part's illuminance, averaged over the area where any light arrived, before parts were joined.
    #[getter]
    fn error(&self) -> f64 {
        self.maps.error
    }
    /// Lumens that the paths started with.
    #[getter]
    fn emitted(&self) -> f64 {
        self.maps.emitted
    }
    /// Lumens of paths that were cut off by the most bounces.
    #[getter]
    fn cut_off(&self) -> f64 {
        self.maps.cut_off
    }
    /// Bytes of the maps while they were made.
    #[getter]
    fn memory(&self) -> u64 {
        self.maps.memory
    }
    /// What is to be known of the maps: where it is, and what.
    #[getter]
    fn diagnostics(&self) -> Vec<(String, String)> {
        told(&self.maps.diagnostics)
    }
    /// Lux as the camera of a scene sees the surfaces, (height, width), rows from the top; nan where there is no map. The scene is the one that was
    /// mapped, with any camera and size. `quantity` is illuminance, direct, indirect, error or a figure of colour (`SurfaceMap.figure`); a pixel looks `side` × `side` times. With `smooth` differences
    /// that the values' standard errors explain go away, as in the command's pictures.
    #[pyo3(signature = (scene, *, quantity = "illuminance", side = 2, smooth = false))]
    fn view(&self, py: Python<'_>, scene: &Scene, quantity: &str, side: u32, smooth: bool) -> PyResult<Array> {
        let quantity = quantity_of(quantity)?;
        let description = scene.scene.clone();
        let seen = py.detach(|| {
            let compiled = compile(&description, Some(&self.compiled), &AtomicBool::new(false))?;
            if compiled.tables.first_light_instance as usize != self.maps.of_instance.len() {
                return Err(Error::setting("scene", "it has other surfaces than the one that was mapped"));
            }
            map::view(&self.maps, &compiled, &description.settings, quantity, Looks { side, smooth }, Execution::detect())
        });
        let (values, size) = seen.map_err(exception)?;
        Ok(Array::rows(values.into_iter().map(f64::from).collect(), size[0]))
    }
    fn __repr__(&self) -> String {
        format!("<gonio.IlluminationMaps of {} surfaces, {} light paths>", self.maps.surfaces.len(), self.maps.paths)
    }
}

fn quantity_of(name: &str) -> PyResult<Quantity> {
    Quantity::by_name(name).map_err(exception)
}

fn side_of(name: &str) -> PyResult<usize> {
    match name {
        "front" => Ok(0),
        "back" => Ok(1),
        _ => Err(setting("side", format!("'{name}' was found, expected front or back"))),
    }
}

impl SurfaceMap {
    /// Values (0) or errors (1) of a figure.
    fn figures(&self, figure: &str, side: &str, which: usize) -> PyResult<Array> {
        let Quantity::Figure(measurand) = quantity_of(figure)? else {
            return Err(setting("figure", format!("'{figure}' was found, expected cct, duv, ra, rf, rg or melanopic-edi")));
        };
        let parts = self.map().chart.len();
        let of = |part: Option<&PartColour>| part.map_or(f64::NAN, |part| f64::from(part.of(measurand)[which]));
        let lit = self.map().sides[side_of(side)?].as_ref();
        let values = (0..parts).map(|part| of(lit.and_then(|lit| lit.figures.get(part)))).collect();
        Ok(self.laid_out(values))
    }

    fn map(&self) -> &map::SurfaceMap {
        &self.maps.surfaces[self.number]
    }

    /// Values of a side; zeros where nothing arrived.
    fn values(&self, side: &str, pick: impl Fn(&SideMap) -> Vec<f64>) -> PyResult<Array> {
        let map = self.map();
        let values = map.sides[side_of(side)?].as_ref().map_or_else(|| vec![0.0; map.chart.len()], pick);
        Ok(self.laid_out(values))
    }

    /// In the texels' rows, or part by part.
    fn laid_out(&self, values: Vec<f64>) -> Array {
        match &self.map().chart {
            Chart::Texels(chart) => Array::rows(values, chart.size()[0] as usize),
            Chart::Cells(_) => Array::flat(values),
        }
    }
}

fn doubles(values: &[f32]) -> Vec<f64> {
    values.iter().map(|value| f64::from(*value)).collect()
}

#[pymethods]
impl SurfaceMap {
    /// The object's name, or the prim's path.
    #[getter]
    fn name(&self) -> &str {
        &self.map().surface.origin.name
    }
    /// Its number among the placements of the object.
    #[getter]
    fn placement(&self) -> u32 {
        self.map().surface.placement[0]
    }
    /// The number of its instances in the scene, as `add_instance` gave it.
    #[getter]
    fn instances(&self) -> u32 {
        self.set
    }
    /// Square metres of one side.
    #[getter]
    fn area(&self) -> f64 {
        self.map().surface.area()
    }
    /// Width and height in texels; None of divided triangles.
    #[getter]
    fn size(&self) -> Option<(u32, u32)> {
        match &self.map().chart {
            Chart::Texels(chart) => Some(chart.size().into()),
            Chart::Cells(_) => None,
        }
    }
    /// Lumens that arrived on a side.
    #[pyo3(signature = (side = "front"))]
    fn flux(&self, side: &str) -> PyResult<f64> {
        Ok(self.map().summaries[side_of(side)?].flux)
    }
    /// Lumens that arrived on a side straight from lights.
    #[pyo3(signature = (side = "front"))]
    fn direct_flux(&self, side: &str) -> PyResult<f64> {
        Ok(self.map().summaries[side_of(side)?].direct)
    }
    /// Standard error of the lumens, as if all arrivals were independent.
    #[pyo3(signature = (side = "front"))]
    fn flux_error(&self, side: &str) -> PyResult<f64> {
        Ok(self.map().summaries[side_of(side)?].standard_error)
    }
    /// Mean lux of a side.
    #[pyo3(signature = (side = "front"))]
    fn mean(&self, side: &str) -> PyResult<f64> {
        Ok(self.map().summaries[side_of(side)?].mean())
    }
    /// Lux: (height, width) of texels, rows from the top, nan where there is nothing of the surface; one number a part of divided triangles.
    #[pyo3(signature = (side = "front"))]
    fn illuminance(&self, side: &str) -> PyResult<Array> {
        self.values(side, |map| doubles(&map.illuminance))
    }
    /// Lux straight from lights, laid out as all of it.
    #[pyo3(signature = (side = "front"))]
    fn direct(&self, side: &str) -> PyResult<Array> {
        self.values(side, |map| doubles(&map.direct))
    }
    /// Standard errors in lux, as if all arrivals were independent.
    #[pyo3(signature = (side = "front"))]
    fn standard_errors(&self, side: &str) -> PyResult<Array> {
        self.values(side, |map| doubles(&map.standard_error))
    }
    /// Red, green and blue parts of the lux, three in a row, part after part; None where they were not asked for or nothing arrived.
    #[pyo3(signature = (side = "front"))]
    fn colours(&self, side: &str) -> PyResult<Option<Array>> {
        let map = self.map().sides[side_of(side)?].as_ref().filter(|map| !map.colour.is_empty());
        Ok(map.map(|map| Array::rows(map.colour.iter().flatten().map(|value| f64::from(*value)).collect(), 3)))
    }
    /// A figure of the light's colour, part by part, laid out as `illuminance`: cct, duv, ra, rf, rg or melanopic-edi; nan where there is no light, it is not
    /// white, or figures were not asked for.
    #[pyo3(signature = (figure, side = "front"))]
    fn figure(&self, figure: &str, side: &str) -> PyResult<Array> {
        self.figures(figure, side, 0)
    }
    /// Standard errors of `figure`.
    #[pyo3(signature = (figure, side = "front"))]
    fn figure_errors(&self, figure: &str, side: &str) -> PyResult<Array> {
        self.figures(figure, side, 1)
    }
    /// What the light of a whole side says together, as `Reading.colour`; None where nothing arrived or figures were not asked for.
    #[pyo3(signature = (side = "front"))]
    fn colour<'py>(&self, py: Python<'py>, side: &str) -> PyResult<Option<Bound<'py, PyDict>>> {
        let colour = self.map().summaries[side_of(side)?].colour.as_ref();
        colour.map(|colour| colour_described(py, colour)).transpose()
    }
    /// The parts of divided triangles: nine numbers a row, the corners in the world, metres; None of texels.
    #[getter]
    fn corners(&self) -> Option<Array> {
        let map = self.map();
        let Chart::Cells(chart) = &map.chart else { return None };
        let mesh = &self.scene.meshes[map.surface.mesh.index()];
        let mut out = Vec::with_capacity(9 * chart.len());
        for (triangle, points) in mesh.triangles.iter().enumerate() {
            let [a, b, c] = points.map(|point| mesh.points.get(point as usize).map_or([0.0; 3], |point| point.map(f64::from)));
            for code in 0..chart.cells(triangle).len() as u32 {
                for [u, v] in corners(chart.level(triangle), code) {
                    let local = [0, 1, 2].map(|k| a[k] * (1.0 - u - v) + b[k] * u + c[k] * v);
                    out.extend(map.surface.transform.point(local));
                }
            }
        }
        Some(Array::rows(out, 9))
    }
    /// Lux at the corners of the mesh's triangles, (triangles, 3), those of neighbours joined; 0 where nothing arrived. `quantity` is illuminance,
    /// direct, indirect or error.
    #[pyo3(signature = (side = "front", *, quantity = "illuminance"))]
    fn at_corners(&self, side: &str, quantity: &str) -> PyResult<Array> {
        let map = self.map();
        let values = map.at_corners(&self.scene.meshes[map.surface.mesh.index()], side_of(side)?, quantity_of(quantity)?);
        Ok(Array::rows(values.into_iter().flatten().map(f64::from).collect(), 3))
    }
    /// Mean lux of the mesh's triangles, where triangles were divided; 0 where nothing arrived. `quantity` is illuminance, direct or indirect.
    #[pyo3(signature = (side = "front", *, quantity = "illuminance"))]
    fn of_triangles(&self, side: &str, quantity: &str) -> PyResult<Array> {
        let (map, side, quantity) = (self.map(), side_of(side)?, quantity_of(quantity)?);
        let triangles = 0..map.surface.areas.len();
        Ok(Array::flat(triangles.map(|triangle| map.mean_of(side, triangle, quantity)).collect()))
    }
    /// Writes texels as an OpenEXR texture: R, G, B, Illuminance, Direct and StandardError in lux, those of the back with Back. before.
    fn write(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        py.detach(|| map::write_map_exr(&path, self.map())).map_err(exception)
    }
    fn __repr__(&self) -> String {
        format!("<gonio.SurfaceMap of {}: {} parts>", self.map().surface.origin, self.map().chart.len())
    }
}

/// Keeps the light of a scene on its surfaces, by light paths: on those of the objects that `prims` names and what is below them, or on all.
///
/// With `uv`, the name of texture coordinates, on their texels, of `texel` metres or `resolution` (width, height) in number; without, on triangles
/// divided until their parts are no larger than `texel` metres squared. It ends where the standard error, averaged over the lit area, is `error` of
/// the illuminance, after `paths` light paths or `time_limit` seconds; divided triangles are joined where their own error would be larger.
/// `colours` keeps red, green and blue too, `figures` those of the light's colour, for which lamps want spectra, `memory` is the most bytes. `previous` lends the trees and images of what did not change, and
/// `cancelled`, a function that says whether to stop, is asked every 50 ms.
#[pyfunction]
#[pyo3(signature = (
    scene, *, prims = None, uv = None, texel = None, resolution = None, error = 0.05, paths = 16777216, time_limit = 0.0, colours = false, figures = false,
    memory = 1073741824, max_bounces = None, previous = None, cancelled = None
))]
#[expect(clippy::too_many_arguments, reason = "keyword arguments")]
pub(crate) fn illumination_map(
    py: Python<'_>,
    scene: &Scene,
    prims: Option<Vec<String>>,
    uv: Option<String>,
    texel: Option<f64>,
    resolution: Option<(u32, u32)>,
    error: f64,
    paths: u64,
    time_limit: f64,
    colours: bool,
    figures: bool,
    memory: u64,
    max_bounces: Option<u32>,
    previous: Option<&Render>,
    cancelled: Option<Py<PyAny>>,
) -> PyResult<IlluminationMaps> {
    let texel = match (texel, resolution) {
        (Some(_), Some(_)) => return Err(setting("texel", "it was given with a resolution, expected one of both")),
        (Some(metres), None) => TexelSize::Metres(metres),
        (None, Some((width, height))) => TexelSize::Resolution([width, height]),
        (None, None) => TexelSize::Automatic,
    };
    let max_bounces = max_bounces.unwrap_or(MOST_BOUNCES);
    let (prims, time_limit_s) = (prims.unwrap_or_default(), time_limit);
    let options = MapOptions { prims, uv, texel, error, paths, time_limit_s, colours, figures, memory, max_bounces };
    let description = Arc::new(scene.scene.clone());
    let before = previous.and_then(Render::compiled);
    let ask = |py: Python<'_>, _: Option<&u64>| unless(py, cancelled.as_ref());
    let (maps, compiled) = watched(py, ask, |stop, progress| {
        let compiled = Arc::new(compile(&description, before.as_deref(), stop)?);
        let mut tell = |paths| progress(&paths);
        let mut watch = Watch { cancel: stop, progress: &mut tell };
        let maps = map::illumination_maps(&description, &compiled, &options, Execution::detect(), &mut watch)?;
        Ok((Arc::new(maps), compiled))
    })?;
    Ok(IlluminationMaps { maps, scene: description, compiled })
}
