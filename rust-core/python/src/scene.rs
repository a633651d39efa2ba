//! Scenes built from Python buffers.

use crate::{
    buffer::{floats_of_any_width, matrices},
    daylight::{self, Daylight},
    description,
    error::{exception, setting},
    measured::MeasuredBsdf,
    mesh::MeshBuffers,
    settings,
};
use gonio::{
    Diagnostic,
    checkpoint::{Part, parts},
    scene::{self, Instances, MaterialId, MatteName, MeshId, Origin, Primvar, PrimvarInterpolation, Transform},
};
use pyo3::{
    prelude::*,
    sync::PyOnceLock,
    types::{PyDict, PyType},
};
use std::{collections::HashMap, path::PathBuf};

/// What is to be rendered: meshes, instances, materials, lights, cameras, settings; lengths in metres, radiances in cd/m².
#[pyclass(module = "gonio._gonio", subclass)]
#[derive(Default)]
pub(crate) struct Scene {
    pub(crate) scene: scene::Scene,
    pub(crate) diagnostics: Vec<Diagnostic>,
    /// Cameras were described with their own apertures, which the picture's shape leaves alone.
    pub(crate) cameras_have_shape: bool,
}

impl Scene {
    /// The same as a `gonio.Scene`, which is the class of this one with what Python adds.
    pub(crate) fn public(self, py: Python<'_>) -> PyResult<Bound<'_, Self>> {
        static CLASS: PyOnceLock<Py<PyType>> = PyOnceLock::new();
        let scene = CLASS.import(py, "gonio.scene", "Scene")?.call0()?.cast_into::<Self>()?;
        *scene.borrow_mut() = self;
        Ok(scene)
    }
}

/// What placements are called in mattes, where an asset is told apart from them.
fn matte_names(name: &str, asset: &str) -> Vec<MatteName> {
    let named = || MatteName { first: 0, object: name.into(), asset: asset.into() };
    if asset.is_empty() { Vec::new() } else { vec![named()] }
}

#[pymethods]
impl Scene {
    /// An empty scene.
    #[new]
    fn new() -> Self {
        Self::default()
    }

    /// Adds a mesh, or replaces mesh `index`; gives its number.
    ///
    /// points: float buffer (N, 3); triangles: integer buffer (M, 3) of point numbers, or of corner numbers where `corners` (C,) gives the point
    /// of each polygon corner; faces: integer buffer (M,), the polygon of each triangle; normals: float buffer with a value a point or corner, or
    /// None for flat triangles; uvs: float buffer, two numbers a point or corner; primvars: other values by name, 1 to 4 numbers a point, corner,
    /// face or mesh; slots: integer buffer of material slots, one a triangle or face.
    #[pyo3(signature = (points, triangles, *, corners = None, faces = None, normals = None, uvs = None, primvars = None, slots = None, name = "mesh", index = None))]
    #[expect(clippy::too_many_arguments, reason = "keyword arguments")]
    fn put_mesh(
        &mut self,
        points: &Bound<'_, PyAny>,
        triangles: &Bound<'_, PyAny>,
        corners: Option<&Bound<'_, PyAny>>,
        faces: Option<&Bound<'_, PyAny>>,
        normals: Option<&Bound<'_, PyAny>>,
        uvs: Option<&Bound<'_, PyAny>>,
        primvars: Option<&Bound<'_, PyDict>>,
        slots: Option<&Bound<'_, PyAny>>,
        name: &str,
        index: Option<u32>,
    ) -> PyResult<u32> {
        let buffers = MeshBuffers { points, triangles, corners, faces, normals, uvs, primvars, slots };
        let mesh = buffers.mesh(name)?;
        description::put(&mut self.scene.meshes, "mesh", mesh, index)
    }

    /// Places a mesh many times, or replaces the placements `index`; gives their number.
    ///
    /// transforms: float buffer (N, 4, 4) of matrices for column vectors; visibility: which rays see them (camera, diffuse, glossy, transmission,
    /// shadow), all by default, and `holdout` and `shadow_catcher`; asset: what the asset matte calls them, their name if empty; primvars: values by name, one a placement, for materials where the mesh has none of the name.
    #[pyo3(signature = (mesh, materials, transforms, *, name = "instances", visibility = None, primvars = None, pass_index = 0, light_group = "", asset = "", index = None))]
    #[expect(clippy::too_many_arguments, reason = "keyword arguments")]
    fn put_instances(
        &mut self,
        mesh: u32,
        materials: Vec<u32>,
        transforms: &Bound<'_, PyAny>,
        name: &str,
        visibility: Option<HashMap<String, bool>>,
        primvars: Option<&Bound<'_, PyDict>>,
        pass_index: u32,
        light_group: &str,
        asset: &str,
        index: Option<u32>,
    ) -> PyResult<u32> {
        if mesh as usize >= self.scene.meshes.len() {
            return Err(setting("mesh", format!("{mesh} was found, the scene has {} meshes", self.scene.meshes.len())));
        }
        if let Some(material) = materials.iter().find(|material| **material as usize >= self.scene.materials.len()) {
            return Err(setting("materials", format!("{material} was found, the scene has {} materials", self.scene.materials.len())));
        }
        let place = |m: [[f64; 4]; 4]| Transform { columns: std::array::from_fn(|column| std::array::from_fn(|row| m[row][column])) };
        let transforms: Vec<Transform> = matrices(transforms, "transforms")?.into_iter().map(place).collect();
        let mut own = Vec::new();
        for (key, value) in primvars.into_iter().flatten() {
            let name: String = key.extract()?;
            let values = floats_of_any_width(&value, &name)?;
            let (components, interpolation) = (values.width as u8, PrimvarInterpolation::Uniform);
            own.push(Primvar { name, interpolation, components, values: values.values.into(), indices: None });
        }
        let (visibility, [holdout, shadow_catcher]) = description::visibility(visibility.unwrap_or_default())?;
        let instances = Instances {
            origin: Origin::new(name),
            mesh: MeshId(mesh),
            materials: materials.into_iter().map(MaterialId).collect(),
            transforms,
            primvars: own,
            visibility,
            holdout,
            shadow_catcher,
            pass_index,
            light_group: light_group.to_owned(),
            matte_names: matte_names(name, asset),
        };
        description::put(&mut self.scene.instances, "instances", instances, index)
    }

    /// Adds a material described as in `to_dict`, or replaces material `index`; gives its number.
    #[pyo3(signature = (description, index = None))]
    fn put_material(&mut self, description: &Bound<'_, PyDict>, index: Option<u32>) -> PyResult<u32> {
        description::put(&mut self.scene.materials, "material", description::read(description, "material")?, index)
    }

    /// Adds a light described as in `to_dict`, or replaces light `index`; gives its number.
    #[pyo3(signature = (description, index = None))]
    fn put_light(&mut self, description: &Bound<'_, PyDict>, index: Option<u32>) -> PyResult<u32> {
        description::put(&mut self.scene.lights, "light", description::read(description, "light")?, index)
    }

    /// Adds a camera described as in `to_dict`, or replaces camera `index`; gives its number. The apertures' widths follow the shape of the
    /// picture until a camera is put with `fixed_aperture`.
    #[pyo3(signature = (description, index = None, *, fixed_aperture = true))]
    fn put_camera(&mut self, description: &Bound<'_, PyDict>, index: Option<u32>, fixed_aperture: bool) -> PyResult<u32> {
        let number = description::put(&mut self.scene.cameras, "camera", description::read(description, "camera")?, index)?;
        self.cameras_have_shape |= fixed_aperture;
        Ok(number)
    }

    /// Adds a meter described as in `to_dict`, or replaces meter `index`; gives its number.
    #[pyo3(signature = (description, index = None))]
    fn put_meter(&mut self, description: &Bound<'_, PyDict>, index: Option<u32>) -> PyResult<u32> {
        description::put(&mut self.scene.meters, "meter", description::read(description, "meter")?, index)
    }

    /// Adds a calculation grid described as in `to_dict`, or replaces grid `index`; gives its number.
    #[pyo3(signature = (description, index = None))]
    fn put_grid(&mut self, description: &Bound<'_, PyDict>, index: Option<u32>) -> PyResult<u32> {
        description::put(&mut self.scene.grids, "grid", description::read(description, "grid")?, index)
    }

    /// Adds a texture described as in `to_dict`, or replaces texture `index`; gives its number.
    ///
    /// In place of a source, `data` gives a name for messages and an encoded file's bytes, or those of UDIM tiles by number; `pixels` gives linear
    /// RGBA floats (height, width, 4) with the rows from the top.
    #[pyo3(signature = (description, index = None, *, data = None, pixels = None))]
    fn put_texture(
        &mut self,
        description: &Bound<'_, PyDict>,
        index: Option<u32>,
        data: Option<(String, description::Data)>,
        pixels: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<u32> {
        let texture = description::texture(description, data, pixels)?;
        description::put(&mut self.scene.textures, "texture", texture, index)
    }

    /// Adds a measured material, or replaces number `index`; gives its number, which closures of the model "Measured" name as `measured`.
    #[pyo3(signature = (measured, *, name = "measured", index = None))]
    fn put_measured(&mut self, measured: &Bound<'_, MeasuredBsdf>, name: &str, index: Option<u32>) -> PyResult<u32> {
        let element = scene::MeasuredBsdf::new(Origin::new(name), measured.get().shared());
        description::put(&mut self.scene.measured, "measured", element, index)
    }

    /// Keeps the first `n` elements of a kind: meshes, instances, materials, textures, measured, lights, cameras, meters or grids.
    fn truncate(&mut self, kind: &str, n: usize) -> PyResult<()> {
        let scene = &mut self.scene;
        match kind {
            "meshes" => scene.meshes.truncate(n),
            "instances" => scene.instances.truncate(n),
            "materials" => scene.materials.truncate(n),
            "textures" => scene.textures.truncate(n),
            "measured" => scene.measured.truncate(n),
            "lights" => scene.lights.truncate(n),
            "cameras" => scene.cameras.truncate(n),
            "meters" => scene.meters.truncate(n),
            "grids" => scene.grids.truncate(n),
            other => {
                let expected = "meshes, instances, materials, textures, measured, lights, cameras, meters or grids";
                return Err(setting("kind", format!("'{other}' was found, expected {expected}")));
            }
        }
        Ok(())
    }

    /// Adds sun and sky: a dome of `rows` rows, and a distant light where the sun's disc shines. `up` is the scene's vertical axis, Z (north is +Y) or
    /// Y (north is −Z); east is +X. `north` turns true north clockwise, in degrees seen from above.
    #[pyo3(signature = (daylight, *, up = "Z", north = 0.0, rows = 512))]
    fn add_daylight(&mut self, py: Python<'_>, daylight: &Daylight, up: &str, north: f64, rows: u32) -> PyResult<()> {
        let (frame, daylight) = (daylight::frame(up, north)?, daylight.daylight);
        py.detach(|| daylight.add_to(&mut self.scene, &frame, rows)).map_err(exception)?;
        Ok(())
    }

    /// Parts of the render with about equal work, `count` or as many as there can be, each with the settings `tile_range` and `sample_range` that make it.
    fn parts<'py>(&self, py: Python<'py>, count: u32) -> PyResult<Vec<Bound<'py, PyDict>>> {
        let keywords = |part: Part| -> PyResult<_> {
            let keywords = PyDict::new(py);
            keywords.set_item("tile_range", (part.tiles[0], part.tiles[1]))?;
            keywords.set_item("sample_range", (part.samples[0], part.samples[1]))?;
            Ok(keywords)
        };
        parts(&self.scene.settings, count).map_err(exception)?.into_iter().map(keywords).collect()
    }

    /// Changes settings; what is not named stays. See the stub for all of them.
    ///
    /// Passes that show what materials compute are called `aov:` (colours, four channels) or `aov_value:` (numbers) and the name of the materials'
    /// shader outputs.
    #[pyo3(signature = (**changes))]
    fn set(&mut self, changes: Option<&Bound<'_, PyDict>>) -> PyResult<()> {
        let Some(changes) = changes else { return Ok(()) };
        let mut settings = self.scene.settings.clone();
        settings::change(&mut settings, changes)?;
        let aspect = |[width, height]: [u32; 2]| f64::from(width.max(1)) / f64::from(height.max(1));
        let stretch = aspect(settings.resolution) / aspect(self.scene.settings.resolution);
        // Cameras that were made for the picture's shape follow it.
        if !self.cameras_have_shape {
            self.scene.cameras.iter_mut().for_each(|camera| camera.aperture[0] *= stretch);
        }
        self.scene.settings = settings;
        Ok(())
    }

    /// Width and height of the picture in pixels.
    #[getter]
    fn resolution(&self) -> (u32, u32) {
        self.scene.settings.resolution.into()
    }

    /// Names of the light groups; "other" is that of all lights that are in none. Their passes are called `lightgroup:` and the name.
    #[getter]
    fn light_groups(&self) -> Vec<String> {
        self.scene.light_groups()
    }

    /// What is not as asked for, as (origin, message).
    #[getter]
    fn diagnostics(&self) -> Vec<(String, String)> {
        self.diagnostics.iter().map(|d| (d.origin.to_string(), d.message.clone())).collect()
    }

    /// The scene as nested dictionaries and lists.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        description::to_python(py, &self.scene)
    }

    /// Saves the scene as a bundle that renders again, bit for bit, without its host. Image files stay names, or travel along with `images`.
    #[pyo3(signature = (path, *, images = false))]
    fn save(&self, py: Python<'_>, path: PathBuf, images: bool) -> PyResult<()> {
        let save = || match images {
            true => scene::save_bundle(&scene::with_images(&self.scene), &path),
            false => scene::save_bundle(&self.scene, &path),
        };
        py.detach(save).map_err(exception)
    }

    /// Loads a bundle.
    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf) -> PyResult<Bound<'_, Self>> {
        let scene = py.detach(|| scene::load_bundle(&path)).map_err(exception)?;
        Self { scene, ..Self::default() }.public(py)
    }

    /// Counts, for a look.
    fn __repr__(&self) -> String {
        let s = &self.scene;
        format!(
            "<gonio.Scene: {} meshes, {} instance sets, {} materials, {} lights, {} cameras>",
            s.meshes.len(),
            s.instances.len(),
            s.materials.len(),
            s.lights.len(),
            s.cameras.len()
        )
    }
}
