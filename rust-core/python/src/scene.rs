//! Scenes built from Python buffers.

use crate::{
    buffer::{floats, indices},
    error::exception,
    film::aov_name,
};
use gonio::{
    Diagnostic,
    scene::{
        self, Aov, Camera, DomeFormat, Emission, Input, Instances, Integrator, Light, LightShape, Material, MaterialId, Mesh, MeshId,
        Origin, Primvar, PrimvarInterpolation, Transform, Visibility,
    },
};
use pyo3::{exceptions::PyValueError, prelude::*, types::PyDict};
use std::path::PathBuf;

/// What is to be rendered: meshes, instances, materials, lights, cameras, settings; lengths in metres, radiances in cd/m².
#[pyclass(module = "gonio")]
#[derive(Default)]
pub(crate) struct Scene {
    pub(crate) scene: scene::Scene,
    pub(crate) diagnostics: Vec<Diagnostic>,
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

fn setting(name: &str, problem: String) -> PyErr {
    exception(gonio::Error::Setting { name: name.into(), problem })
}

#[pymethods]
impl Scene {
    /// An empty scene.
    #[new]
    fn new() -> Self {
        Self::default()
    }

    /// Adds a triangle mesh; gives its number.
    ///
    /// points: float buffer (N, 3); triangles: integer buffer (M, 3); normals: float buffer (N, 3) or (3 M, 3) or None for flat triangles;
    /// uvs: float buffer (N, 2) or (3 M, 2); slots: integer buffer (M,) of material slots.
    #[pyo3(signature = (points, triangles, *, normals = None, uvs = None, slots = None, name = "mesh"))]
    fn add_mesh(
        &mut self,
        points: &Bound<'_, PyAny>,
        triangles: &Bound<'_, PyAny>,
        normals: Option<&Bound<'_, PyAny>>,
        uvs: Option<&Bound<'_, PyAny>>,
        slots: Option<&Bound<'_, PyAny>>,
        name: &str,
    ) -> PyResult<u32> {
        let points = floats(points, "points", 3)?.arrays::<3>();
        let triangles = indices(triangles, "triangles", 3)?.arrays::<3>();
        if let Some(index) = triangles.iter().flatten().find(|index| **index as usize >= points.len()) {
            return Err(PyValueError::new_err(format!("triangles: index {index} is out of range, there are {} points", points.len())));
        }
        let primvar = |object: Option<&Bound<'_, PyAny>>, name: &str, components: u8| -> PyResult<Option<Primvar>> {
            let Some(object) = object else { return Ok(None) };
            let grouped = floats(object, name, usize::from(components))?;
            let (elements, values) = (grouped.len(), grouped.values);
            let interpolation = match elements {
                n if n == points.len() => PrimvarInterpolation::Vertex,
                n if n == triangles.len() * 3 => PrimvarInterpolation::FaceVarying,
                n => {
                    let expected = format!("{} (one a point) or {} (one a corner)", points.len(), triangles.len() * 3);
                    return Err(PyValueError::new_err(format!("{name}: {n} values were found, expected {expected}")));
                }
            };
            Ok(Some(Primvar { name: name.into(), interpolation, components, values: values.into(), indices: None }))
        };
        let normals = primvar(normals, "normals", 3)?;
        let uvs = primvar(uvs, "st", 2)?;
        let slots = match slots {
            Some(slots) => {
                let slots = indices(slots, "slots", 1)?.values;
                if slots.len() != triangles.len() || slots.iter().any(|slot| *slot > u32::from(u16::MAX)) {
                    return Err(PyValueError::new_err(format!("slots: expected {} values from 0 to 65535", triangles.len())));
                }
                Some(slots.into_iter().map(|slot| slot as u16).collect())
            }
            None => None,
        };
        let mesh = Mesh {
            origin: Origin::new(name),
            points: points.into(),
            triangles: triangles.into(),
            normals,
            primvars: uvs.into_iter().collect(),
            slots,
            faces: None,
        };
        Ok(self.scene.add_mesh(mesh).0)
    }

    /// Adds a material: keyword arguments are surface parameters by their OpenPBR names, numbers or triples; gives its number.
    #[pyo3(signature = (name = "material", **parameters))]
    fn add_material(&mut self, name: &str, parameters: Option<&Bound<'_, PyDict>>) -> PyResult<u32> {
        let mut material = Material { origin: Origin::new(name), ..Material::default() };
        for (key, value) in parameters.into_iter().flatten() {
            let key: String = key.extract()?;
            if key == "thin_walled" {
                material.thin_walled = value.extract()?;
                continue;
            }
            let known = gonio::bsdf::parameter::find(&key);
            let parameter = known.ok_or_else(|| setting(&key, "the surface has no parameter of this name".into()))?;
            let numbers: Vec<f32> =
                if let Ok(number) = value.extract::<f32>() { vec![number; parameter.width()] } else { value.extract()? };
            if numbers.len() != parameter.width() {
                return Err(setting(&key, format!("{} numbers were found, expected {}", numbers.len(), parameter.width())));
            }
            let mut constant = [1.0; 4];
            constant[..numbers.len()].copy_from_slice(&numbers);
            material.set_input(&key, Input::Constant(constant));
        }
        Ok(self.scene.add_material(material).0)
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
        });
        Ok(())
    }

    /// Adds a light of a shape: "rectangle" (width, height), "disk" (radius), "sphere" (radius), "cylinder" (radius, length),
    /// "distant" (angle in degrees), "dome". Radiance in cd/m² (a distant light: lux on a facing surface); flat ones shine along local −z.
    #[pyo3(signature = (shape, radiance = [1.0; 3], *, transform = None, width = 1.0, height = 1.0, radius = 0.5, length = 1.0, angle = 0.53, visible = true, name = "light"))]
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
    ) -> PyResult<u32> {
        let (shape, normalized) = match shape {
            "rectangle" => (LightShape::Rectangle { width, height }, false),
            "disk" => (LightShape::Disk { radius }, false),
            "sphere" => (LightShape::Sphere { radius }, false),
            "cylinder" => (LightShape::Cylinder { radius, length }, false),
            "distant" => (LightShape::Distant { angle_deg: angle }, true),
            "dome" => (LightShape::Dome { format: DomeFormat::Automatic }, false),
            other => {
                let problem = format!("'{other}' was found, expected rectangle, disk, sphere, cylinder, distant or dome");
                return Err(setting("shape", problem));
            }
        };
        self.scene.lights.push(Light {
            emission: Emission { radiance, normalized, ..Emission::default() },
            visibility: Visibility { camera: visible, ..Visibility::default() },
            ..Light::new(Origin::new(name), shape, self::transform(transform)?)
        });
        Ok((self.scene.lights.len() - 1) as u32)
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

    /// Changes settings: width, height, samples, seed, threads, max_bounces, integrator ("path", "direct"), time_limit, passes.
    #[pyo3(signature = (*, width = None, height = None, samples = None, seed = None, threads = None, max_bounces = None, integrator = None, time_limit = None, passes = None))]
    #[expect(clippy::too_many_arguments, reason = "keyword arguments")]
    fn set(
        &mut self,
        width: Option<u32>,
        height: Option<u32>,
        samples: Option<u32>,
        seed: Option<u32>,
        threads: Option<u32>,
        max_bounces: Option<u32>,
        integrator: Option<&str>,
        time_limit: Option<f64>,
        passes: Option<Vec<String>>,
    ) -> PyResult<()> {
        if samples == Some(0) {
            return Err(setting("samples", "0 was found, expected 1 or more".into()));
        }
        if let Some(limit) = time_limit.filter(|limit| !(limit.is_finite() && *limit >= 0.0)) {
            return Err(setting("time_limit", format!("{limit} was found, expected seconds from 0 (no limit) on")));
        }
        let before = self.scene.settings.resolution;
        let s = &mut self.scene.settings;
        s.resolution = [width.unwrap_or(s.resolution[0]), height.unwrap_or(s.resolution[1])];
        let [now, then] = [s.resolution, before].map(|[width, height]| f64::from(width) / f64::from(height.max(1)));
        // Cameras keep their vertical field of view and follow the picture's shape.
        self.scene.cameras.iter_mut().for_each(|camera| camera.aperture[0] *= now / then.max(1e-9));
        s.samples = samples.unwrap_or(s.samples);
        s.seed = seed.unwrap_or(s.seed);
        s.threads = threads.unwrap_or(s.threads);
        s.max_bounces = max_bounces.unwrap_or(s.max_bounces);
        s.time_limit_s = time_limit.unwrap_or(s.time_limit_s);
        s.integrator = match integrator {
            None => s.integrator,
            Some("path") => Integrator::Path,
            Some("direct") => Integrator::Direct,
            Some(other) => return Err(setting("integrator", format!("'{other}' was found, expected path or direct"))),
        };
        if let Some(names) = passes {
            let all = [Aov::Color, Aov::Alpha, Aov::Depth, Aov::Normal, Aov::P, Aov::Albedo, Aov::PrimId, Aov::Luminance, Aov::Illuminance];
            let known = |name: &String| all.into_iter().find(|aov| aov_name(*aov) == name);
            let find = |name: &String| known(name).ok_or_else(|| setting("passes", format!("there is no pass '{name}'")));
            s.aovs = names.iter().map(find).collect::<PyResult<_>>()?;
        }
        Ok(())
    }

    /// What is not as asked for, as (origin, message).
    #[getter]
    fn diagnostics(&self) -> Vec<(String, String)> {
        self.diagnostics.iter().map(|d| (d.origin.to_string(), d.message.clone())).collect()
    }

    /// The scene as nested dictionaries and lists.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let text = py.detach(|| serde_json::to_string(&self.scene));
        let text = text.map_err(|error| PyValueError::new_err(error.to_string()))?;
        py.import("json")?.call_method1("loads", (text,))
    }

    /// Saves the scene as a bundle that renders again, bit for bit, without its host.
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        py.detach(|| scene::save_bundle(&self.scene, &path)).map_err(exception)
    }

    /// Loads a bundle.
    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let scene = py.detach(|| scene::load_bundle(&path)).map_err(exception)?;
        Ok(Self { scene, diagnostics: Vec::new() })
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
