//! Scenes built from Python buffers.

use crate::{
    buffer::{floats_of_any_width, matrices},
    daylight::{self, Daylight},
    description,
    error::{exception, setting},
    light,
    measure::measurand,
    measured::MeasuredBsdf,
    mesh::MeshBuffers,
    settings,
};
use gonio::{
    Diagnostic,
    checkpoint::{Part, parts},
    scene::{
        self, Camera, Closure, DomeFormat, Emission, Grid, GridArea, Input, Instances, Light, LightShape, Material, MaterialId, MeshId,
        Meter, Origin, Primvar, PrimvarInterpolation, Transform, Visibility,
    },
};
use pyo3::{exceptions::PyValueError, prelude::*, pybacked::PyBackedBytes, types::PyDict};
use std::{collections::HashMap, path::PathBuf};

/// What is to be rendered: meshes, instances, materials, lights, cameras, settings; lengths in metres, radiances in cd/m².
#[pyclass(module = "gonio")]
#[derive(Default)]
pub(crate) struct Scene {
    pub(crate) scene: scene::Scene,
    pub(crate) diagnostics: Vec<Diagnostic>,
    /// Cameras were described with their own apertures, which the picture's shape leaves alone.
    pub(crate) cameras_have_shape: bool,
}

/// A 4×4 matrix for column vectors (translation in the last column), or None for the identity.
fn transform(matrix: Option<&Bound<'_, PyAny>>) -> PyResult<Transform> {
    let Some(matrix) = matrix else { return Ok(Transform::IDENTITY) };
    let rows: Vec<Vec<f64>> = matrix.extract()?;
    if rows.len() != 4 || rows.iter().any(|row| row.len() != 4) {
        return Err(PyValueError::new_err("transform: expected a 4 by 4 matrix"));
    }
    Ok(Transform { columns: std::array::from_fn(|column| std::array::from_fn(|row| rows[row][column])) })
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
    fn add_mesh(
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
    /// shadow), all by default, and `holdout` and `shadow_catcher`; primvars: values by name, one a placement, for materials where the mesh has none of the name.
    #[pyo3(signature = (mesh, materials, transforms, *, name = "instances", visibility = None, primvars = None, pass_index = 0, light_group = "", index = None))]
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
        index: Option<u32>,
    ) -> PyResult<u32> {
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

    /// Adds a camera described as in `to_dict`, or replaces camera `index`; gives its number.
    #[pyo3(signature = (description, index = None))]
    fn put_camera(&mut self, description: &Bound<'_, PyDict>, index: Option<u32>) -> PyResult<u32> {
        self.cameras_have_shape = true;
        description::put(&mut self.scene.cameras, "camera", description::read(description, "camera")?, index)
    }

    /// Adds a texture described as in `to_dict`, or replaces texture `index`; gives its number.
    ///
    /// In place of a source, `data` gives an encoded file's bytes, whose format `name` tells, or `pixels` linear RGBA floats (height, width, 4)
    /// with the rows from the top.
    #[pyo3(signature = (description, index = None, *, data = None, pixels = None))]
    fn put_texture(
        &mut self,
        description: &Bound<'_, PyDict>,
        index: Option<u32>,
        data: Option<(String, PyBackedBytes)>,
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

    /// Keeps the first so many elements of each kind named.
    #[pyo3(signature = (*, meshes = None, instances = None, materials = None, textures = None, measured = None, lights = None, cameras = None, meters = None, grids = None))]
    #[expect(clippy::too_many_arguments, reason = "keyword arguments")]
    fn truncate(
        &mut self,
        meshes: Option<usize>,
        instances: Option<usize>,
        materials: Option<usize>,
        textures: Option<usize>,
        measured: Option<usize>,
        lights: Option<usize>,
        cameras: Option<usize>,
        meters: Option<usize>,
        grids: Option<usize>,
    ) {
        let scene = &mut self.scene;
        scene.meshes.truncate(meshes.unwrap_or(usize::MAX));
        scene.instances.truncate(instances.unwrap_or(usize::MAX));
        scene.materials.truncate(materials.unwrap_or(usize::MAX));
        scene.textures.truncate(textures.unwrap_or(usize::MAX));
        scene.measured.truncate(measured.unwrap_or(usize::MAX));
        scene.lights.truncate(lights.unwrap_or(usize::MAX));
        scene.cameras.truncate(cameras.unwrap_or(usize::MAX));
        scene.meters.truncate(meters.unwrap_or(usize::MAX));
        scene.grids.truncate(grids.unwrap_or(usize::MAX));
    }

    /// Adds a material: keyword arguments are surface parameters by their OpenPBR names, numbers or triples; gives its number.
    #[pyo3(signature = (name = "material", **parameters))]
    fn add_material(&mut self, name: &str, parameters: Option<&Bound<'_, PyDict>>) -> PyResult<u32> {
        let mut material = Closure::default();
        for (key, value) in parameters.into_iter().flatten() {
            let key: String = key.extract()?;
            if key == "thin_walled" {
                material.thin_walled = value.extract()?;
                continue;
            }
            let known = gonio::bsdf::parameter::find(&key);
            let parameter = known.ok_or_else(|| setting(&key, "the surface has no parameter of this name"))?;
            let numbers: Vec<f32> =
                if let Ok(number) = value.extract::<f32>() { vec![number; parameter.width()] } else { value.extract()? };
            if numbers.len() != parameter.width() {
                return Err(setting(&key, format!("{} numbers were found, expected {}", numbers.len(), parameter.width())));
            }
            let mut constant = [1.0; 4];
            constant[..numbers.len()].copy_from_slice(&numbers);
            material.set_input(&key, Input::Constant(constant));
        }
        Ok(self.scene.add_material(Material::of(Origin::new(name), material)).0)
    }

    /// Places a mesh; transform is a 4×4 matrix for column vectors.
    #[pyo3(signature = (mesh, materials = Vec::new(), *, transform = None, name = "instance"))]
    fn add_instance(&mut self, mesh: u32, materials: Vec<u32>, transform: Option<&Bound<'_, PyAny>>, name: &str) -> PyResult<()> {
        if mesh as usize >= self.scene.meshes.len() {
            return Err(setting("mesh", format!("{mesh} was found, the scene has {} meshes", self.scene.meshes.len())));
        }
        if let Some(material) = materials.iter().find(|material| **material as usize >= self.scene.materials.len()) {
            return Err(setting("materials", format!("{material} was found, the scene has {} materials", self.scene.materials.len())));
        }
        self.scene.instances.push(Instances {
            origin: Origin::new(name),
            mesh: MeshId(mesh),
            materials: materials.into_iter().map(MaterialId).collect(),
            transforms: vec![self::transform(transform)?],
            primvars: Vec::new(),
            visibility: Visibility::default(),
            holdout: false,
            shadow_catcher: false,
            pass_index: 0,
            light_group: String::new(),
        });
        Ok(())
    }

    /// Adds a light of a shape: "rectangle" (width, height), "disk" (radius), "sphere" (radius), "cylinder" (radius, length), "point",
    /// "luminaire" (its goniogram's opening, or another), "distant" (angle in degrees), "dome". Radiance in cd/m² (point and luminaire: cd; a
    /// distant light: lux on a facing surface); flat ones shine along local −z.
    ///
    /// One of lumens, lamp_lumens, candela, lux (at metres: a pair), nits or watts in place of it lets the radiance tell the colour alone; so does a
    /// goniogram of a point or a luminaire, whose factors then are cd. The temperature in K multiplies the colour.
    #[pyo3(signature = (shape, radiance = [1.0; 3], *, transform = None, width = 1.0, height = 1.0, radius = 0.5, length = 1.0, angle = 0.53, visible = true, name = "light", **photometry))]
    #[expect(clippy::too_many_arguments, reason = "keyword arguments")]
    fn add_light(
        &mut self,
        shape: &str,
        radiance: [f32; 3],
        transform: Option<&Bound<'_, PyAny>>,
        width: f64,
        height: f64,
        radius: f64,
        length: f64,
        angle: f64,
        visible: bool,
        name: &str,
        photometry: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<u32> {
        let photometry = light::Photometry::new(photometry)?;
        let (shape, normalized) = match shape {
            "rectangle" => (LightShape::Rectangle { width, height }, false),
            "disk" => (LightShape::Disk { radius }, false),
            "sphere" => (LightShape::Sphere { radius }, false),
            "cylinder" => (LightShape::Cylinder { radius, length }, false),
            "point" => (LightShape::Point, false),
            "luminaire" => (LightShape::Opening(photometry.opening()), false),
            "distant" => (LightShape::Distant { angle_deg: angle }, true),
            "dome" => (LightShape::Dome { format: DomeFormat::Automatic }, false),
            other => {
                let problem = format!("'{other}' was found, expected rectangle, disk, sphere, cylinder, point, luminaire, distant or dome");
                return Err(setting("shape", problem));
            }
        };
        let plain = Light {
            emission: Emission { radiance, normalized, ..Emission::default() },
            visibility: Visibility { camera: visible, ..Visibility::default() },
            ..Light::new(Origin::new(name), shape, self::transform(transform)?)
        };
        self.scene.lights.push(photometry.applied(plain));
        Ok((self.scene.lights.len() - 1) as u32)
    }

    /// Adds sun and sky: a dome of `rows` rows, and a distant light where the sun's disc shines. `up` is the scene's vertical axis, Z (north is +Y) or
    /// Y (north is −Z); east is +X. `north` turns true north clockwise, in degrees seen from above.
    #[pyo3(signature = (daylight, *, up = "Z", north = 0.0, rows = 512))]
    fn add_daylight(&mut self, py: Python<'_>, daylight: &Daylight, up: &str, north: f64, rows: u32) -> PyResult<()> {
        let (frame, daylight) = (daylight::frame(up, north)?, daylight.daylight);
        py.detach(|| daylight.add_to(&mut self.scene, &frame, rows)).map_err(exception)?;
        Ok(())
    }

    /// Adds a meter at a point in metres; gives its number. quantity: illuminance (of the plane across `normal`), cylindrical or semicylindrical (`normal`
    /// is the axis), daylight-factor, luminance (towards `facing`), or ugr (of the luminaires, along `facing`, upright along `normal`).
    #[pyo3(signature = (position, *, normal = [0.0, 0.0, 1.0], facing = [0.0, 1.0, 0.0], quantity = "illuminance", name = "meter"))]
    fn add_meter(&mut self, position: [f64; 3], normal: [f64; 3], facing: [f64; 3], quantity: &str, name: &str) -> PyResult<u32> {
        let meter = Meter { origin: Origin::new(name), position, normal, facing, measurand: measurand(quantity)? };
        description::put(&mut self.scene.meters, "meter", meter, None)
    }

    /// Adds a calculation grid over a parallelogram (`corner` and two `edges`, metres) or over mesh number `mesh` placed by `transform`, shown or not;
    /// gives its number. spacing: metres from point to point, 0 as EN 12464-1 has it; margin: metres left out along the edges; height: metres above
    /// the area; the rest as a meter's.
    #[pyo3(signature = (*, corner = [0.0; 3], edges = None, mesh = None, transform = None, spacing = 0.0, margin = 0.0, height = 0.0, facing = [0.0, 1.0, 0.0], quantity = "illuminance", name = "grid"))]
    #[expect(clippy::too_many_arguments, reason = "keyword arguments")]
    fn add_grid(
        &mut self,
        corner: [f64; 3],
        edges: Option<[[f64; 3]; 2]>,
        mesh: Option<u32>,
        transform: Option<&Bound<'_, PyAny>>,
        spacing: f64,
        margin: f64,
        height: f64,
        facing: [f64; 3],
        quantity: &str,
        name: &str,
    ) -> PyResult<u32> {
        let area = match (edges, mesh) {
            (Some(edges), None) => GridArea::Rectangle { corner, edges },
            (None, Some(mesh)) => GridArea::Mesh { mesh: MeshId(mesh), transform: self::transform(transform)? },
            _ => return Err(PyValueError::new_err("a grid wants either edges or a mesh")),
        };
        let grid = Grid { origin: Origin::new(name), area, spacing, margin, height, facing, measurand: measurand(quantity)? };
        description::put(&mut self.scene.grids, "grid", grid, None)
    }

    /// Adds a camera looking along −z of its transform, y up; makes it the one that renders.
    #[pyo3(signature = (transform = None, *, fov = 40.0, name = "camera"))]
    fn add_camera(&mut self, transform: Option<&Bound<'_, PyAny>>, fov: f64, name: &str) -> PyResult<()> {
        let [width, height] = self.scene.settings.resolution.map(f64::from);
        let camera = Camera::perspective(Origin::new(name), self::transform(transform)?, fov, width / height.max(1.0));
        self.scene.cameras.push(camera);
        self.scene.settings.camera = (self.scene.cameras.len() - 1) as u32;
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

    /// Saves the scene as a bundle that renders again, bit for bit, without its host. Image files stay names, or travel along with
    /// `images`; sets of UDIM tiles cannot.
    #[pyo3(signature = (path, *, images = false))]
    fn save(&self, py: Python<'_>, path: PathBuf, images: bool) -> PyResult<()> {
        let save = || match images {
            true => scene::save_bundle(&scene::with_images(&self.scene)?, &path),
            false => scene::save_bundle(&self.scene, &path),
        };
        py.detach(save).map_err(exception)
    }

    /// Loads a bundle.
    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let scene = py.detach(|| scene::load_bundle(&path)).map_err(exception)?;
        Ok(Self { scene, ..Self::default() })
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
