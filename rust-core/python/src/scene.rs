//! Scenes built from Python buffers.

use crate::{
    buffer::{floats_of_any_width, matrices},
    curves::{CurveBuffers, PointBuffers},
    daylight::{self, Daylight},
    description,
    error::{exception, setting, told},
    field,
    measured::MeasuredBsdf,
    memory::Keeper,
    mesh::MeshBuffers,
    mesh_file, settings,
};
use gonio::{
    Diagnostic,
    checkpoint::{Part, parts},
    compile::TreesAhead,
    scene::{
        self, CurvesId, Dicing, Geometry, Instances, Link, Linking, MaterialId, MatteName, MeshId, Origin, PointsId, Primvar,
        PrimvarInterpolation, Transform,
    },
};
use pyo3::{
    exceptions::PyValueError,
    prelude::*,
    sync::PyOnceLock,
    types::{PyBytes, PyDict, PyType},
};
use std::{
    collections::HashMap,
    path::{Path, PathBuf},
    sync::{Mutex, PoisonError},
};

/// What is to be rendered: meshes, instances, materials, lights, cameras, settings; lengths in metres, radiances in cd/m².
#[pyclass(module = "gonio._gonio", subclass)]
#[derive(Default)]
pub(crate) struct Scene {
    pub(crate) scene: scene::Scene,
    pub(crate) diagnostics: Vec<Diagnostic>,
    /// Cameras were described with their own apertures, which the picture's shape leaves alone.
    pub(crate) cameras_have_shape: bool,
    /// Trees that are built before the scene is rendered.
    pub(crate) ahead: Mutex<Option<Ahead>>,
}

/// Trees under way, for which freed memory is kept meanwhile.
#[derive(Debug)]
pub(crate) struct Ahead {
    trees: TreesAhead,
    _memory: Keeper,
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

impl Scene {
    /// Takes the trees that were begun: the next render waits for them.
    pub(crate) fn trees_ahead(&self) -> TreesAhead {
        let mut ahead = self.ahead.lock().unwrap_or_else(PoisonError::into_inner);
        ahead.take().map(|ahead| ahead.trees).unwrap_or_default()
    }

    /// What is placed: one of these.
    fn geometry(&self, mesh: Option<u32>, curves: Option<u32>, points: Option<u32>) -> PyResult<Geometry> {
        let (kind, number, geometry, there) = match (mesh, curves, points) {
            (Some(mesh), None, None) => ("mesh", mesh, Geometry::from(MeshId(mesh)), self.scene.meshes.len()),
            (None, Some(curves), None) => ("curves", curves, CurvesId(curves).into(), self.scene.curves.len()),
            (None, None, Some(points)) => ("points", points, PointsId(points).into(), self.scene.points.len()),
            _ => return Err(setting("mesh", "expected one of mesh, curves and points".to_owned())),
        };
        if number as usize >= there {
            let kinds = if kind == "mesh" { "meshes" } else { kind };
            return Err(setting(kind, format!("{number} was found, the scene has {there} {kinds}")));
        }
        Ok(geometry)
    }
}

/// What placements are called in mattes, where an asset is told apart from them.
fn matte_names(name: &str, asset: &str) -> Vec<MatteName> {
    let named = || MatteName { first: 0, object: name.into(), asset: asset.into() };
    if asset.is_empty() { Vec::new() } else { vec![named()] }
}

impl Scene {
    fn field_of(&self, field: u32) -> PyResult<&scene::Field> {
        let count = self.scene.fields.len();
        self.scene
            .fields
            .get(field as usize)
            .ok_or_else(|| PyValueError::new_err(format!("field {field} was asked for, the scene has {count}")))
    }
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
    /// face or mesh; slots: integer buffer of material slots, one a triangle or face; motion: float
    /// buffer (K, N, 3), the points at K evenly spaced times over the shutter; motion_normals: the normals at those. ahead: other threads build the
    /// mesh's tree meanwhile, which the next `Render` takes; for scenes of many meshes that are rendered once they are described.
    #[pyo3(signature = (points, triangles, *, corners = None, faces = None, normals = None, uvs = None, primvars = None, slots = None, motion = None, motion_normals = None, name = "mesh", index = None, ahead = false))]
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
        motion: Option<&Bound<'_, PyAny>>,
        motion_normals: Option<&Bound<'_, PyAny>>,
        name: &str,
        index: Option<u32>,
        ahead: bool,
    ) -> PyResult<u32> {
        let buffers = MeshBuffers { points, triangles, corners, faces, normals, uvs, primvars, slots, motion, motion_normals };
        let mesh = buffers.mesh(name)?;
        if ahead {
            let under_way = self.ahead.get_mut().unwrap_or_else(PoisonError::into_inner);
            under_way.get_or_insert_with(|| Ahead { trees: TreesAhead::default(), _memory: Keeper::new() }).trees.add(&mesh);
        }
        description::put(&mut self.scene.meshes, "mesh", mesh, index)
    }

    /// Has a mesh cut when the scene is compiled, until no edge is longer than so many pixels of the camera that renders, or, where `length` is
    /// above 0, than that in the mesh's own units. `levels`: how often an edge is cut in two at most; `smooth`: new points lie on curves through
    /// the points with their normals.
    #[pyo3(signature = (mesh, *, pixels = 1.0, length = 0.0, levels = 12, smooth = true))]
    fn set_dicing(&mut self, mesh: u32, pixels: f32, length: f32, levels: u32, smooth: bool) -> PyResult<()> {
        if !(pixels.is_finite() && pixels > 0.0 && length.is_finite() && length >= 0.0) {
            return Err(PyValueError::new_err(format!("pixels {pixels} and length {length} were found, expected above 0 and 0 or more")));
        }
        let count = self.scene.meshes.len();
        let wrong = || PyValueError::new_err(format!("mesh {mesh} was asked for, the scene has {count}"));
        self.scene.meshes.get_mut(mesh as usize).ok_or_else(wrong)?.dicing = Some(Dicing { pixels, length, levels, smooth });
        Ok(())
    }

    /// Adds curves, or replaces curves `index`; gives their number.
    ///
    /// points: float buffer (N, 3), curve after curve; counts: integer buffer, the points of each curve; widths: diameters, a number or a float buffer;
    /// type: linear or cubic; basis: bezier, bspline or catmullRom; wrap: nonperiodic, periodic or pinned; shape: round, or ribbon for flat ones that
    /// face each ray; primvars: values by name, 1 to 4 numbers each. Whether values belong to points (vertex), joints of spans (varying), curves
    /// (uniform) or all (constant) follows from their number, or is told by a pair of buffer and word. motion: float buffer (K, N, 3), the points at
    /// K evenly spaced times over the shutter.
    #[pyo3(signature = (points, counts, widths, *, r#type = "linear", basis = "bezier", wrap = "nonperiodic", shape = "round", motion = None, primvars = None, name = "curves", index = None))]
    #[expect(clippy::too_many_arguments, reason = "keyword arguments")]
    fn put_curves(
        &mut self,
        points: &Bound<'_, PyAny>,
        counts: &Bound<'_, PyAny>,
        widths: &Bound<'_, PyAny>,
        r#type: &str,
        basis: &str,
        wrap: &str,
        shape: &str,
        motion: Option<&Bound<'_, PyAny>>,
        primvars: Option<&Bound<'_, PyDict>>,
        name: &str,
        index: Option<u32>,
    ) -> PyResult<u32> {
        let buffers = CurveBuffers { points, counts, widths, kind: r#type, basis, wrap, shape, motion, primvars };
        description::put(&mut self.scene.curves, "curves", buffers.curves(name)?, index)
    }

    /// Adds points, or replaces points `index`; gives their number.
    ///
    /// points: float buffer (N, 3); widths: diameters, a number or a float buffer; normals: float buffer (N, 3) of shading normals in place of the
    /// shape's; shape: sphere, or disc for flat ones that face each ray; primvars: values by name, 1 to 4 numbers a point, or one for all;
    /// motion: float buffer (K, N, 3), the points at K evenly spaced times over the shutter.
    #[pyo3(signature = (points, widths, *, normals = None, shape = "sphere", motion = None, primvars = None, name = "points", index = None))]
    #[expect(clippy::too_many_arguments, reason = "keyword arguments")]
    fn put_points(
        &mut self,
        points: &Bound<'_, PyAny>,
        widths: &Bound<'_, PyAny>,
        normals: Option<&Bound<'_, PyAny>>,
        shape: &str,
        motion: Option<&Bound<'_, PyAny>>,
        primvars: Option<&Bound<'_, PyDict>>,
        name: &str,
        index: Option<u32>,
    ) -> PyResult<u32> {
        let buffers = PointBuffers { points, widths, normals, shape, motion, primvars };
        description::put(&mut self.scene.points, "points", buffers.points(name)?, index)
    }

    /// Places a mesh, or curves or points (then mesh is None), many times, or replaces the placements `index`; gives their number.
    ///
    /// transforms: float buffer (N, 4, 4) of matrices for column vectors; visibility: which rays see them (camera, diffuse, glossy, transmission,
    /// shadow), all by default, and `holdout` and `shadow_catcher`; linking: what is lit by what they emit, and what casts shadows of it, described
    /// as in `to_dict`; asset: what the asset matte calls them, their name if empty; primvars: values by name, one a placement, for materials where
    /// the mesh has none of the name.
    /// shadow_terminator: the cosine under which light grazes that starts from the surface that smooth normals tell of, not from the triangles.
    /// motion: float buffer (K, N, 4, 4), the same at K evenly spaced times over the shutter.
    #[pyo3(signature = (mesh, materials, transforms, *, curves = None, points = None, motion = None, name = "instances", visibility = None, primvars = None, pass_index = 0, light_group = "", linking = None, asset = "", shadow_terminator = 0.0, index = None))]
    #[expect(clippy::too_many_arguments, reason = "keyword arguments")]
    fn put_instances(
        &mut self,
        mesh: Option<u32>,
        materials: Vec<u32>,
        transforms: &Bound<'_, PyAny>,
        curves: Option<u32>,
        points: Option<u32>,
        motion: Option<&Bound<'_, PyAny>>,
        name: &str,
        visibility: Option<HashMap<String, bool>>,
        primvars: Option<&Bound<'_, PyDict>>,
        pass_index: u32,
        light_group: &str,
        linking: Option<&Bound<'_, PyAny>>,
        asset: &str,
        shadow_terminator: f32,
        index: Option<u32>,
    ) -> PyResult<u32> {
        if !(0.0..=1.0).contains(&shadow_terminator) {
            return Err(setting("shadow_terminator", format!("{shadow_terminator} was found, expected a cosine from 0 to 1")));
        }
        let geometry = self.geometry(mesh, curves, points)?;
        if let Some(material) = materials.iter().find(|material| **material as usize >= self.scene.materials.len()) {
            return Err(setting("materials", format!("{material} was found, the scene has {} materials", self.scene.materials.len())));
        }
        let place = |m: [[f64; 4]; 4]| Transform { columns: std::array::from_fn(|column| std::array::from_fn(|row| m[row][column])) };
        let transforms: Vec<Transform> = matrices(transforms, "transforms")?.into_iter().map(place).collect();
        let keys: Vec<Transform> = match motion {
            Some(motion) => matrices(motion, "motion")?.into_iter().map(place).collect(),
            None => Vec::new(),
        };
        if !keys.is_empty() && (transforms.is_empty() || !keys.len().is_multiple_of(transforms.len())) {
            return Err(setting("motion", format!("{} matrices were found, expected {} a key", keys.len(), transforms.len())));
        }
        let motion = keys.chunks(transforms.len().max(1)).map(<[Transform]>::to_vec).collect();
        let mut own = Vec::new();
        for (key, value) in primvars.into_iter().flatten() {
            let name: String = key.extract()?;
            let values = floats_of_any_width(&value, &name)?;
            let (components, interpolation) = (values.width as u8, PrimvarInterpolation::Uniform);
            own.push(Primvar { name, interpolation, components, values: values.values, indices: None });
        }
        let (visibility, [holdout, shadow_catcher]) = description::visibility(visibility.unwrap_or_default())?;
        let instances = Instances {
            origin: Origin::new(name),
            geometry,
            materials: materials.into_iter().map(MaterialId).collect(),
            transforms,
            motion,
            primvars: own,
            visibility,
            holdout,
            shadow_catcher,
            shadow_terminator,
            pass_index,
            light_group: light_group.to_owned(),
            linking: linking.map(|linking| description::read(linking, "linking")).transpose()?.unwrap_or_default(),
            matte_names: matte_names(name, asset),
        };
        description::put(&mut self.scene.instances, "instances", instances, index)
    }

    /// Links light `light`, or what the placements `instances` emit, to placements by their numbers.
    ///
    /// receivers: those alone that it lights, or all but `receivers_except`; blockers: those alone that cast its shadows, or all but `blockers_except`.
    /// What is not given is linked to all. Cameras see it either way, and no light is hidden from meters.
    #[pyo3(signature = (*, light = None, instances = None, receivers = None, receivers_except = None, blockers = None, blockers_except = None))]
    fn link(
        &mut self,
        light: Option<u32>,
        instances: Option<u32>,
        receivers: Option<Vec<u32>>,
        receivers_except: Option<Vec<u32>>,
        blockers: Option<Vec<u32>>,
        blockers_except: Option<Vec<u32>>,
    ) -> PyResult<()> {
        let sets = self.scene.instances.len();
        let link = |name: &str, only: Option<Vec<u32>>, except: Option<Vec<u32>>| {
            if let Some(unknown) = only.iter().chain(&except).flatten().find(|number| **number as usize >= sets) {
                return Err(setting(name, format!("{unknown} was found, the scene has {sets} instances")));
            }
            match (only, except) {
                (None, None) => Ok(Link::All),
                (Some(only), None) => Ok(Link::Only(only)),
                (None, Some(except)) => Ok(Link::Except(except)),
                (Some(_), Some(_)) => Err(setting(name, "was given together with the exceptions, which are from all".to_owned())),
            }
        };
        let linking =
            Linking { receivers: link("receivers", receivers, receivers_except)?, blockers: link("blockers", blockers, blockers_except)? };
        let place = match (light, instances) {
            (Some(number), None) => self.scene.lights.get_mut(number as usize).map(|light| &mut light.linking),
            (None, Some(number)) => self.scene.instances.get_mut(number as usize).map(|set| &mut set.linking),
            _ => return Err(setting("light", "expected either a light or instances".to_owned())),
        };
        let found = light.or(instances).unwrap_or_default();
        *place.ok_or_else(|| setting("light", format!("{found} was found, which the scene does not have")))? = linking;
        Ok(())
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

    /// What fills all of space, described as in `to_dict`; an empty description is nothing.
    fn put_atmosphere(&mut self, description: &Bound<'_, PyDict>) -> PyResult<()> {
        self.scene.atmosphere = description::read(description, "atmosphere")?;
        Ok(())
    }

    /// Adds a texture described as in `to_dict`, or replaces texture `index`; gives its number.
    ///
    /// In place of a source, `data` gives a name for messages and an encoded file's bytes, or those of UDIM tiles by number; `pixels` gives numbers of
    /// shape (height, width) or (height, width, 1 to 4), rows from the top: uint8 and uint16 are fractions of their largest, floats are as they stand.
    /// The description's `colour_space` says what they mean: "raw" for linear ones.
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

    /// Adds the mesh of an OBJ or PLY file, or replaces mesh `index`; gives its number, and the names of its materials in the order of its slots.
    ///
    /// Polygons of any number of corners are cut into triangles. Normals are the file's, texture coordinates the primvar `st`. Lengths and axes are the
    /// file's own: `put_instances` places them.
    #[pyo3(signature = (path, index = None))]
    fn put_mesh_file(&mut self, py: Python<'_>, path: PathBuf, index: Option<u32>) -> PyResult<(u32, Vec<String>)> {
        let (mesh, materials) = mesh_file::read(py, &path)?;
        Ok((description::put(&mut self.scene.meshes, "mesh", mesh, index)?, materials))
    }

    /// Adds a measured material, or replaces number `index`; gives its number, which closures of the model "Measured" name as `measured`.
    #[pyo3(signature = (measured, *, name = "measured", index = None))]
    fn put_measured(&mut self, measured: &Bound<'_, MeasuredBsdf>, name: &str, index: Option<u32>) -> PyResult<u32> {
        let element = scene::MeasuredBsdf::new(Origin::new(name), measured.get().shared());
        description::put(&mut self.scene.measured, "measured", element, index)
    }

    /// Adds a field described as in `to_dict`, or replaces field `index`; gives its number, which media name as `field`.
    ///
    /// `density` and `heat` are arrays (nx, ny, nz), or a file and the name of its grid. The description's `to_world` leads to the world from an array's
    /// voxels, whose centres are whole numbers, or from the file's space. Its `beyond` says for how many voxels an array's outermost values go on before
    /// and behind it, three numbers each.
    ///
    /// Where colours vary, `taken` is an array (nx, ny, nz, 6) of factors on the medium's extinction, R, G, B, and on its scattering, of which the
    /// density is at least the greatest; `sent` (nx, ny, nz, 3) has factors on its emission, in place of the heat.
    #[pyo3(signature = (description, index = None, *, density, heat = None, taken = None, sent = None))]
    #[expect(clippy::too_many_arguments, reason = "keyword arguments")]
    fn put_field(
        &mut self,
        py: Python<'_>,
        description: &Bound<'_, PyDict>,
        index: Option<u32>,
        density: field::Source<'_>,
        heat: Option<field::Source<'_>>,
        taken: Option<Bound<'_, PyAny>>,
        sent: Option<Bound<'_, PyAny>>,
    ) -> PyResult<u32> {
        let described = description::read(description, "field")?;
        let field = field::filled(py, described, (&density, heat.as_ref()), [taken, sent])?;
        description::put(&mut self.scene.fields, "field", field, index)
    }

    /// Adds the box about a field as a mesh, or replaces mesh `index`; gives its number, and the map that places it, a 4×4 matrix for column vectors.
    #[pyo3(signature = (field, index = None))]
    fn put_field_box(&mut self, field: u32, index: Option<u32>) -> PyResult<(u32, [[f64; 4]; 4])> {
        let field = self.field_of(field)?;
        let (place, mesh) = (description::matrix(&field.to_world), field.mesh());
        Ok((description::put(&mut self.scene.meshes, "mesh", mesh, index)?, place))
    }

    /// Has what a field holds flow while the shutter is open, from time 0 to time 1; its numbers hold at `rests`. `to_world` is the map that it was put
    /// with.
    ///
    /// `flow` is an array (nx, ny, nz, 3) as large as the density with three factors that make voxels of it; or a file, the names of its grid of
    /// velocities or of three for x, y and z, and how long the shutter is open in their unit of time. The box about it is to be put anew.
    fn put_flow(
        &mut self,
        py: Python<'_>,
        field: u32,
        to_world: &Bound<'_, PyDict>,
        flow: field::FlowSource<'_>,
        rests: f32,
    ) -> PyResult<()> {
        let to_world: scene::Transform = description::read(to_world, "transform")?;
        let found = field::flow(py, self.field_of(field)?, &to_world, &flow, rests)?;
        self.scene.fields[field as usize].flow = found;
        Ok(())
    }

    /// Where a field lies when the map `to_world`, which it was put with, is one of `keys` instead: 4×4 matrices for column vectors.
    fn field_places(&self, field: u32, to_world: &Bound<'_, PyDict>, keys: Vec<Bound<'_, PyDict>>) -> PyResult<Vec<[[f64; 4]; 4]>> {
        let field = self.field_of(field)?;
        let to_world: scene::Transform = description::read(to_world, "transform")?;
        let Some(back) = to_world.inverse() else { return Ok(Vec::new()) };
        let place = |key: &Bound<'_, PyDict>| {
            let key: scene::Transform = description::read(key, "transform")?;
            Ok(description::matrix(&key.after(&back).after(&field.to_world)))
        };
        keys.iter().map(place).collect()
    }

    /// Keeps the first `n` elements of a kind: meshes, curves, points, instances, materials, textures, measured, fields, lights, cameras, meters or grids.
    fn truncate(&mut self, kind: &str, n: usize) -> PyResult<()> {
        let scene = &mut self.scene;
        match kind {
            "meshes" => scene.meshes.truncate(n),
            "curves" => scene.curves.truncate(n),
            "points" => scene.points.truncate(n),
            "instances" => scene.instances.truncate(n),
            "materials" => scene.materials.truncate(n),
            "textures" => scene.textures.truncate(n),
            "measured" => scene.measured.truncate(n),
            "fields" => scene.fields.truncate(n),
            "lights" => scene.lights.truncate(n),
            "cameras" => scene.cameras.truncate(n),
            "meters" => scene.meters.truncate(n),
            "grids" => scene.grids.truncate(n),
            other => {
                let expected = "meshes, curves, points, instances, materials, textures, measured, fields, lights, cameras, meters or grids";
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
        told(&self.diagnostics)
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

    /// What pickles, copies and other processes make the same scene of.
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, (Bound<'py, PyAny>,))> {
        let bytes = py.detach(|| scene::to_bundle(&self.scene)).map_err(exception)?;
        let diagnostics = told(&self.diagnostics);
        let arguments = ("_of_bundle", PyBytes::new(py, &bytes), self.cameras_have_shape, diagnostics);
        let make = py.import("operator")?.getattr("methodcaller")?.call1(arguments)?;
        Ok((make, (py.import("gonio.scene")?.getattr("Scene")?,)))
    }

    /// The scene of a bundle's bytes.
    #[staticmethod]
    fn _of_bundle<'py>(
        py: Python<'py>,
        bytes: &[u8],
        cameras_have_shape: bool,
        diagnostics: Vec<(String, String)>,
    ) -> PyResult<Bound<'py, Self>> {
        let scene = py.detach(|| scene::of_bundle(bytes, Path::new("pickle"))).map_err(exception)?;
        let diagnostics = diagnostics.into_iter().map(|(origin, message)| Diagnostic::warning(&Origin::new(origin), message)).collect();
        Self { scene, cameras_have_shape, diagnostics, ..Self::default() }.public(py)
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
