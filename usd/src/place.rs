//! From models to the scene: groups multiplied out, shapes of equal mesh and materials gathered into one set of instances.

mod linking;
mod matte_name;
mod rebound;
mod volumes;

use crate::context::Context;
use crate::model::{Element, Group, Inherited, Kind, Model, Shape};
use crate::options::Purpose;
use crate::roles::Role;
use crate::volume::{self, Filling, PlacedVolume};
use crate::{camera, daylight, haze, light, light_filter, material, mesh_light, meter, primvar};
use gonio::scene::{
    Geometry, GridArea, Instances, Light, Material, MaterialId, MeshId, Origin, Primvar, PrimvarInterpolation, Scene, Transform, Visibility,
};
use gonio::{Error, Result, memory::room_for};
use linking::{Collections, LinkTable};
use std::collections::{HashMap, HashSet};
use std::rc::Rc;

/// Most placed shapes of a stage.
const MAX_PLACEMENTS: usize = 1 << 25;

/// Bytes of a placed shape until it can be traced: its transformations, its rows of tables, its part of the tree.
const PLACEMENT_BYTES: u64 = 500;

/// Where a model is placed.
#[derive(Clone, Debug)]
struct Placement {
    /// The model's frame to the world, metres.
    transforms: Vec<Transform>,
    /// Values that come from outside the model.
    primvars: Rc<[Inherited]>,
    purpose: Option<Purpose>,
    /// For models of native instances: the model's root and the path that stands for it.
    renamed: Option<(String, String)>,
    /// Whether a material binding outside the model may count inside.
    is_rebound: bool,
    /// What all of a point instancer's prototypes are in the render pass: that which the instancer is.
    role: Option<Role>,
    /// The path that collections of links are asked for, where that is not the prim's.
    stand_in: Option<String>,
}

impl Placement {
    /// The frame of a group's model, without its transformations, values and purpose.
    fn inside(&self, element: &Element, group: &Group) -> Self {
        let renamed = match &group.instance {
            Some(instance) => Some((group.model.root.clone(), self.path(instance))),
            None => self.renamed.clone(),
        };
        let is_rebound = self.is_rebound || group.instance.is_some() && element.is_bound;
        let stand_in = linking::stand_in(self, element, group);
        Self { transforms: Vec::new(), primvars: Rc::from([]), purpose: None, renamed, is_rebound, role: self.role, stand_in }
    }

    fn path(&self, path: &str) -> String {
        let renamed = self.renamed.as_ref().and_then(|(from, to)| Some(format!("{to}{}", path.strip_prefix(from.as_str())?)));
        renamed.unwrap_or_else(|| path.to_owned())
    }
}

/// Instances that share geometry, materials, the names of their values, a light group, what they are in the render pass, and links.
type Key = (Geometry, Vec<MaterialId>, Vec<(String, usize)>, String, Role, Links);

/// The collections of links that name a shape, and its own as a light.
type Links = (Vec<u32>, Collections);

/// Instances under construction: the values of all placements, one after the other, for each name of the key.
#[derive(Debug)]
struct Gathered {
    instances: Instances,
    names: Vec<(String, usize)>,
    values: Vec<Vec<f32>>,
    links: Links,
}

/// Fills the scene's instances, lights and cameras.
#[derive(Debug)]
pub struct Placer<'w, 'a, 'py> {
    context: &'w mut Context<'a, 'py>,
    failed: HashSet<MeshId>,
    /// Materials by the path of the prim in its instance.
    rebound: HashMap<String, MaterialId>,
    places: HashMap<Key, usize>,
    gathered: Vec<Gathered>,
    geometry_lights: HashMap<(String, MaterialId), MaterialId>,
    /// Paths of prims whose kind is that of assets.
    assets: HashSet<String>,
    links: LinkTable<'py>,
    volumes: Vec<PlacedVolume>,
    /// What fills volumes, by the place of their materials' bindings and their primvars.
    fillings: HashMap<String, Rc<[Filling]>>,
    /// The scene's lights that have links, by their numbers.
    linked_lights: Vec<(usize, Collections)>,
}

/// Places the world. `failed` are the meshes that could not be built; they are removed from the scene.
///
/// # Errors
/// Cancellation, or more placements than are reasonable.
pub fn place_world<'py>(context: &mut Context<'_, 'py>, world: &Model, failed: HashSet<MeshId>) -> Result<()> {
    let placement = Placement {
        transforms: vec![Transform::scale(context.metres_per_unit)],
        primvars: Rc::from([]),
        purpose: None,
        renamed: None,
        is_rebound: false,
        role: None,
        stand_in: None,
    };
    check_count(world)?;
    let links = LinkTable::new(context, world, &placement);
    let rebound = rebound::materials(context, world, &placement);
    let assets = matte_name::assets(context);
    let mut placer = Placer {
        context,
        failed,
        rebound,
        places: HashMap::new(),
        gathered: Vec::new(),
        geometry_lights: HashMap::new(),
        assets,
        links,
        volumes: Vec::new(),
        fillings: HashMap::new(),
        linked_lights: Vec::new(),
    };
    placer.place(world, &placement)?;
    placer.finish();
    Ok(())
}

/// Refuses a world that places more than there is room for, before any of it is placed: models within models multiply.
fn check_count(world: &Model) -> Result<()> {
    let (mut known, mut total) = (HashMap::new(), 0_u64);
    for element in &world.elements {
        total = total.saturating_add(placements(element, &mut known));
        let refused = |why: String| Err(Error::scene(&Origin::new(&element.path), why));
        if total > MAX_PLACEMENTS as u64 {
            return refused(format!("the stage has {total} instances with those placed here, the limit is {MAX_PLACEMENTS}"));
        }
        if let Err(shortage) = room_for(total * PLACEMENT_BYTES) {
            return refused(format!("the stage has {total} instances with those placed here: {shortage}"));
        }
    }
    Ok(())
}

/// Groups and shapes that an element places, all in all; those of models once each.
fn placements(element: &Element, known: &mut HashMap<*const Model, u64>) -> u64 {
    let Kind::Group(group) = &element.kind else { return 1 };
    let model = Rc::as_ptr(&group.model);
    let inside = known.get(&model).copied().unwrap_or_else(|| {
        let inside = group.model.elements.iter().fold(0, |sum: u64, element| sum.saturating_add(placements(element, known)));
        known.insert(model, inside);
        inside
    });
    (group.transforms.len() as u64).saturating_mul(inside.saturating_add(1))
}

impl<'py> Placer<'_, '_, 'py> {
    fn place(&mut self, model: &Model, placement: &Placement) -> Result<()> {
        for element in &model.elements {
            self.context.check_cancel()?;
            let purpose = element.purpose.or(placement.purpose);
            match &element.kind {
                Kind::Group(group) => self.group(element, group, purpose, placement)?,
                // What is measured on need not be shown.
                Kind::Measured(mesh) => self.meters(element, *mesh, placement),
                _ if !self.context.options.shows(purpose.unwrap_or_default()) => {}
                Kind::Shape(shape) => self.shape(element, shape, placement)?,
                Kind::Volume(volume) => self.volume(element, volume, placement),
                Kind::Light => self.lights(element, placement),
                Kind::Camera => self.cameras(element, placement),
            }
        }
        Ok(())
    }

    fn transforms(&self, element: &Element, placement: &Placement) -> Vec<Transform> {
        if element.is_detached {
            let root = Transform::scale(self.context.metres_per_unit);
            return vec![root.after(&element.to_model); placement.transforms.len()];
        }
        placement.transforms.iter().map(|transform| transform.after(&element.to_model)).collect()
    }

    fn group(&mut self, element: &Element, group: &Group, purpose: Option<Purpose>, placement: &Placement) -> Result<()> {
        let outer = self.transforms(element, placement);
        let mut transforms = Vec::with_capacity(outer.len() * group.transforms.len());
        for transform in &outer {
            transforms.extend(group.transforms.iter().map(|inner| transform.after(inner)));
        }
        let repeated: Vec<Inherited> = placement.primvars.iter().map(|value| each_repeated(value, group.transforms.len())).collect();
        let tiled: Vec<Inherited> = group.primvars.iter().map(|value| tiled(value, outer.len())).collect();
        let near = primvar::merged(&tiled, &element.primvars);
        let primvars = primvar::merged(&near, &repeated);
        let role = placement.role.or_else(|| group.instance.is_none().then(|| self.role(element, placement)));
        self.place(&group.model, &Placement { transforms, primvars, purpose, role, ..placement.inside(element, group) })
    }

    fn shape(&mut self, element: &Element, shape: &Shape, placement: &Placement) -> Result<()> {
        let role = self.role(element, placement);
        if shape.geometry.mesh().is_some_and(|mesh| self.failed.contains(&mesh)) || !role.rendered {
            return Ok(());
        }
        let scene = &self.context.scene;
        let inherited = primvar::merged(&element.primvars, &placement.primvars);
        let primvars: Vec<Inherited> = inherited.iter().filter(|value| !has_primvar(scene, shape.geometry, &value.name)).cloned().collect();
        let transforms = self.transforms(element, placement);
        let materials = self.materials(element, shape, placement, &primvars, &transforms);
        let names: Vec<(String, usize)> = primvars.iter().map(|value| (value.name.clone(), value.components)).collect();
        let group = self.light_group(element, placement, &materials);
        let links = self.links_of(element, shape, placement);
        let key = (shape.geometry, materials, names, group, role, links);
        let place = match self.places.get(&key) {
            Some(place) => *place,
            None => self.new_set(element, &key, placement),
        };
        let gathered = &mut self.gathered[place];
        for (values, primvar) in gathered.values.iter_mut().zip(&primvars) {
            let repeats = if primvar.is_varying { 1 } else { transforms.len() };
            (0..repeats).for_each(|_| values.extend_from_slice(&primvar.values));
        }
        let instances = &mut gathered.instances;
        let path = placement.path(&element.path);
        let instance = placement.renamed.as_ref().map(|(_, instance)| instance.as_str());
        instances.matte_names.push(matte_name::of(path, instance, instances.transforms.len(), &self.assets));
        instances.transforms.extend(transforms);
        Ok(())
    }

    /// What an element is in the render pass.
    fn role(&self, element: &Element, placement: &Placement) -> Role {
        let roles = &self.context.roles;
        if roles.are_plain() { Role::default() } else { placement.role.unwrap_or_else(|| roles.role(&placement.path(&element.path))) }
    }

    /// The links of a shape, as what is lit and as what shines.
    fn links_of(&self, element: &Element, shape: &Shape, placement: &Placement) -> Links {
        if self.links.is_empty() {
            return Links::default();
        }
        let path = placement.path(&element.path);
        let own = if shape.is_light { self.links.of_light(&path) } else { Collections::default() };
        (self.links.naming(placement.stand_in.as_ref().unwrap_or(&path)), own)
    }

    /// The light group that the prim names, for what shines.
    fn light_group(&mut self, element: &Element, placement: &Placement, materials: &[MaterialId]) -> String {
        let scene = &self.context.scene;
        if !materials.iter().filter_map(|id| scene.materials.get(id.index())).any(Material::shines) {
            return String::new();
        }
        let prim = self.context.prim_at(&placement.path(&element.path));
        prim.map(|prim| light::group(self.context, &prim)).unwrap_or_default()
    }

    fn new_set(&mut self, element: &Element, key: &Key, placement: &Placement) -> usize {
        let place = self.gathered.len();
        let origin = Origin::new(placement.path(&element.path));
        let instances = Instances {
            visibility: Visibility { camera: key.4.camera, ..Visibility::default() },
            holdout: key.4.matte,
            light_group: key.3.clone(),
            ..Instances::new(origin, key.0, key.1.clone(), Vec::new())
        };
        let values = vec![Vec::new(); key.2.len()];
        self.gathered.push(Gathered { instances, names: key.2.clone(), values, links: key.5.clone() });
        self.places.insert(key.clone(), place);
        place
    }

    fn materials(
        &mut self,
        element: &Element,
        shape: &Shape,
        placement: &Placement,
        primvars: &[Inherited],
        transforms: &[Transform],
    ) -> Vec<MaterialId> {
        let has_opacity = shape.has_opacity || primvars.iter().any(|value| value.name == "displayOpacity");
        let rebound = || shape.slot_prims.iter().map(|path| self.rebound.get(&placement.path(path)).copied()).collect::<Option<Vec<_>>>();
        let rebound = if placement.is_rebound && !shape.slot_prims.is_empty() { rebound() } else { None };
        let bound = rebound.or_else(|| shape.slots.get().cloned());
        let mut materials = bound.unwrap_or_else(|| vec![material::fallback(self.context, has_opacity); shape.slot_prims.len()]);
        if shape.is_light {
            let area = shape.geometry.mesh().zip(transforms.first()).map(|(mesh, transform)| self.area(mesh, transform));
            materials.iter_mut().for_each(|material| *material = self.glowing(&element.path, *material, area));
        }
        materials
    }

    fn glowing(&mut self, path: &str, material: MaterialId, area: Option<f64>) -> MaterialId {
        let key = (path.to_owned(), material);
        if let Some(known) = self.geometry_lights.get(&key) {
            return *known;
        }
        let Some(prim) = self.context.prim_at(path) else { return material };
        let glowing = mesh_light::material(self.context, &prim, material, area);
        self.geometry_lights.insert(key, glowing);
        glowing
    }

    /// The area of a placed mesh in square units of the stage.
    fn area(&self, mesh: MeshId, to_world: &Transform) -> f64 {
        let mesh = &self.context.scene.meshes[mesh.index()];
        let point = |index: u32| to_world.point(mesh.points[index as usize].map(f64::from));
        let doubled = |[a, b, c]: [u32; 3]| {
            let ([ax, ay, az], b, c) = (point(a), point(b), point(c));
            let (u, v) = ([b[0] - ax, b[1] - ay, b[2] - az], [c[0] - ax, c[1] - ay, c[2] - az]);
            let cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
            cross.iter().map(|x| x * x).sum::<f64>().sqrt()
        };
        let square_metres: f64 = mesh.triangles.iter().map(|&triangle| 0.5 * doubled(triangle)).sum();
        square_metres / (self.context.metres_per_unit * self.context.metres_per_unit)
    }

    fn lights(&mut self, element: &Element, placement: &Placement) {
        let path = placement.path(&element.path);
        let role = self.role(element, placement);
        let Some(prim) = self.context.prim_at(&path).filter(|_| role.rendered) else { return };
        if haze::is_haze(&prim) {
            haze::fill(self.context, &prim);
            if !daylight::is_daylight(&prim) && !light::is_light(&prim.type_name()) {
                return;
            }
        }
        let first = self.context.scene.lights.len();
        let filters = light_filter::read(self.context, &prim);
        for transform in self.transforms(element, placement) {
            if daylight::is_daylight(&prim) {
                daylight::add_lights(self.context, &prim, &transform);
            } else if let Some(light) = light::light(self.context, &prim, &transform) {
                let filtered = light_filter::apply(self.context, &filters, light);
                self.context.scene.lights.push(filtered);
            }
        }
        let (of_pass, of_all) = (!role.camera, self.context.options.hide_lights);
        let is_hidden = |light: &Light| of_pass || (of_all && !light.shape.is_at_infinity());
        let hidden = self.context.scene.lights[first..].iter_mut().filter(|light| is_hidden(light));
        hidden.for_each(|light| light.visibility.camera = false);
        let links = self.links.of_light(&path);
        if links != Collections::default() {
            self.linked_lights.extend((first..self.context.scene.lights.len()).map(|light| (light, links)));
        }
    }

    fn cameras(&mut self, element: &Element, placement: &Placement) {
        let path = placement.path(&element.path);
        let Some(prim) = self.context.prim_at(&path) else { return };
        for transform in self.transforms(element, placement) {
            let camera = camera::camera(self.context, &prim, &transform);
            self.context.scene.cameras.push(camera);
        }
    }

    fn meters(&mut self, element: &Element, mesh: Option<MeshId>, placement: &Placement) {
        let path = placement.path(&element.path);
        let Some(prim) = self.context.prim_at(&path).filter(|_| mesh.is_none_or(|mesh| !self.failed.contains(&mesh))) else { return };
        for transform in self.transforms(element, placement) {
            meter::add(self.context, &prim, mesh, &transform);
        }
    }

    fn finish(self) {
        let Self { context, failed, gathered, volumes, links, linked_lights, .. } = self;
        let naming: Vec<Vec<u32>> = gathered.iter().map(|set| set.links.0.clone()).chain(volume::naming(&volumes)).collect();
        for (light, own) in linked_lights {
            context.scene.lights[light].linking = links.linking(own, &naming);
        }
        let instances = gathered.into_iter().map(|Gathered { mut instances, names, values, links: (_, own) }| {
            instances.linking = links.linking(own, &naming);
            let primvars = names.iter().zip(values);
            instances.primvars = primvars.map(|((name, components), values)| gathered_primvar(name, *components, values)).collect();
            instances
        });
        context.scene.instances = instances.collect();
        drop_meshes(context, &failed);
        volume::add_all(context, volumes);
    }
}

/// Whether geometry has a primvar of a name itself.
fn has_primvar(scene: &Scene, geometry: Geometry, name: &str) -> bool {
    match geometry {
        Geometry::Mesh(mesh) => scene.meshes[mesh.index()].primvar(name).is_some(),
        Geometry::Curves { curves } => scene.curves[curves.index()].primvar(name).is_some(),
        Geometry::Points { points } => scene.points[points.index()].primvar(name).is_some(),
    }
}

/// The values of all placements; one value where they agree.
fn gathered_primvar(name: &str, components: usize, mut values: Vec<f32>) -> Primvar {
    let is_constant = values.chunks_exact(components).all(|value| value == &values[..components]);
    if is_constant {
        values.truncate(components);
    }
    Primvar {
        name: name.to_owned(),
        interpolation: if is_constant { PrimvarInterpolation::Constant } else { PrimvarInterpolation::Uniform },
        components: components as u8,
        values: values.into(),
        indices: None,
    }
}

/// Removes the meshes that could not be built.
fn drop_meshes(context: &mut Context<'_, '_>, failed: &HashSet<MeshId>) {
    if failed.is_empty() {
        return;
    }
    let mut kept = 0;
    let numbers: Vec<u32> = (0..context.scene.meshes.len() as u32)
        .map(|id| {
            let number = kept;
            kept += u32::from(!failed.contains(&MeshId(id)));
            number
        })
        .collect();
    let mut id = 0;
    context.scene.meshes.retain(|_| {
        id += 1;
        !failed.contains(&MeshId(id - 1))
    });
    for instances in &mut context.scene.instances {
        if let Geometry::Mesh(mesh) = &mut instances.geometry {
            *mesh = MeshId(numbers[mesh.index()]);
        }
    }
    for grid in &mut context.scene.grids {
        if let GridArea::Mesh { mesh, .. } = &mut grid.area {
            *mesh = MeshId(numbers[mesh.index()]);
        }
    }
}

/// A value of the outer placements for each of the `inner` placements in every one.
fn each_repeated(value: &Inherited, inner: usize) -> Inherited {
    if !value.is_varying {
        return value.clone();
    }
    let mut values = Vec::with_capacity(value.values.len() * inner);
    for one in value.values.chunks_exact(value.components) {
        (0..inner).for_each(|_| values.extend_from_slice(one));
    }
    Inherited { values: values.into(), ..value.clone() }
}

/// The values of the inner placements for each of the `outer` ones.
fn tiled(value: &Inherited, outer: usize) -> Inherited {
    if !value.is_varying || outer == 1 {
        return value.clone();
    }
    Inherited { values: value.values.repeat(outer).into(), ..value.clone() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn varying(values: &[f32]) -> Inherited {
        Inherited { name: "a".into(), components: 1, values: values.into(), is_varying: true }
    }

    #[test]
    fn values_follow_nested_placements() {
        assert_eq!(each_repeated(&varying(&[1.0, 2.0]), 3).values.as_ref(), [1.0, 1.0, 1.0, 2.0, 2.0, 2.0]);
        assert_eq!(tiled(&varying(&[1.0, 2.0]), 2).values.as_ref(), [1.0, 2.0, 1.0, 2.0]);
    }

    #[test]
    fn equal_values_become_one() {
        assert_eq!(gathered_primvar("a", 2, vec![1.0, 2.0, 1.0, 2.0]).interpolation, PrimvarInterpolation::Constant);
        assert_eq!(gathered_primvar("a", 2, vec![1.0, 2.0, 1.0, 3.0]).values.len(), 4);
    }
}
