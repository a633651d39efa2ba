//! Lamps that stand in glass, resin or water: seen through its surface their radiance is less by the squared index.

use crate::{
    error::Diagnostic,
    geometry::NONE,
    scene::{Instances, Mesh, Scene},
    transport::{Tables, squared_indices_at},
};
use std::{collections::BTreeMap, sync::Arc};

/// How far a place is off a triangle, over the triangle's size, and over the size of its coordinates at least.
const OFF: [f64; 2] = [1e-4, 4e-6];

/// What shines: a lamp by its number in the table, or all surfaces of a mesh instance that emit.
#[derive(Clone, Copy)]
enum Shining {
    Light(u32),
    Instance(u32),
}

/// Notes in the tables what each lamp and each instance that emits shines into; `of_lamp` gives the scene's lights.
pub(super) fn find(scene: &Scene, tables: &mut Tables, of_lamp: &[u32], diagnostics: &mut Vec<Diagnostic>) {
    if tables.bodies.refracting.is_empty() {
        return;
    }
    let first_triangle = tables.light_instances.0;
    let lamps = (0..first_triangle).filter_map(|light| Some((Shining::Light(light), tables.lights.front(light)?)));
    let glowing = places_that_emit(scene, tables).into_iter().map(|(instance, place)| (Shining::Instance(instance), place));
    let (shining, places): (Vec<Shining>, Vec<[f32; 3]>) = lamps.chain(glowing).unzip();
    let squared = squared_indices_at(tables, &places);
    let within: Vec<(Shining, f32)> = shining.into_iter().zip(squared).filter(|(_, squared)| (squared - 1.0).abs() > 0.0).collect();
    if within.is_empty() {
        return;
    }
    let mut of_light = vec![1.0; tables.lights.len()];
    let mut of_instance = vec![1.0; tables.first_light_instance as usize];
    for (shining, squared) in &within {
        match shining {
            Shining::Light(light) => of_light[*light as usize] = 1.0 / squared,
            Shining::Instance(instance) => of_instance[*instance as usize] = 1.0 / squared,
        }
    }
    for (factor, instance) in of_light[first_triangle as usize..].iter_mut().zip(&tables.light_instances.1) {
        *factor = of_instance[*instance as usize];
    }
    Arc::make_mut(&mut tables.lights).set_media(of_light);
    if within.iter().any(|(shining, _)| matches!(shining, Shining::Instance(_))) {
        tables.emission_in_media = of_instance;
    }
    let set = |instance: u32| scene.instances.get(tables.geometry.instances[instance as usize].set as usize).map(|set| &set.origin);
    let lamp = |light: u32| scene.lights.get(of_lamp[light as usize] as usize).map(|light| &light.origin);
    let origin = |shining| match shining {
        Shining::Light(light) => lamp(light),
        Shining::Instance(instance) => set(instance),
    };
    if let Some((origin, squared)) = within.iter().find_map(|(shining, squared)| Some((origin(*shining)?, squared))) {
        diagnostics.push(Diagnostic::info(origin, message(squared.sqrt(), within.len())));
    }
}

/// Says what the picture shows of the first of so many lamps.
fn message(index: f32, count: usize) -> String {
    let others = if count > 1 { format!(", as do {} others", count - 1) } else { String::new() };
    format!(
        "it stands in a solid of index {index:.3}{others}: seen from outside its luminance is less by the index squared; glass with air inside wants an \
         inner surface or thin walls"
    )
}

/// By instance, a place just before a triangle of it that emits.
fn places_that_emit(scene: &Scene, tables: &Tables) -> BTreeMap<u32, [f32; 3]> {
    let (first_triangle, instances) = &tables.light_instances;
    let mut places = BTreeMap::new();
    for (light, instance) in (*first_triangle..).zip(instances) {
        if let (false, Some(place)) = (places.contains_key(instance), tables.lights.front(light)) {
            places.insert(*instance, place);
        }
    }
    // Those of which light sampling does not know.
    let may_emit = |set: &Instances| set.materials.iter().any(|id| id.index() < scene.materials.len() && emits(tables, id.index()));
    let sets: Vec<bool> = scene.instances.iter().map(may_emit).collect();
    for (instance, row) in (0..tables.first_light_instance).zip(&tables.geometry.instances) {
        let unsampled = tables.triangle_lights.get(instance as usize).is_none_or(|first| *first == NONE);
        if let (true, true, Some(mesh)) = (unsampled, sets[row.set as usize], scene.meshes.get(row.mesh as usize)) {
            let glows = |triangle: &usize| tables.materials.emits(tables.geometry.material(instance, *triangle as u32));
            let placed = |triangle| before(mesh, triangle, &scene.instances[row.set as usize], row.number as usize, tables.origin);
            places.extend((0..mesh.triangles.len()).find(glows).and_then(placed).map(|place| (instance, place)));
        }
    }
    places
}

/// Whether a material of the scene may emit.
fn emits(tables: &Tables, material: usize) -> bool {
    tables.materials.emits(tables.materials.number(material))
}

/// A place just before the middle of a triangle of a placed mesh, rebased world space.
fn before(mesh: &Mesh, triangle: usize, set: &Instances, number: usize, origin: [f64; 3]) -> Option<[f32; 3]> {
    let transform = set.transforms.get(number)?;
    let corner = |index: u32| Some(transform.point(mesh.points.get(index as usize)?.map(f64::from)));
    let [a, b, c] = mesh.triangles[triangle].map(corner);
    let (a, b, c) = (a?, b?, c?);
    let edge = |to: [f64; 3]| [0, 1, 2].map(|axis| to[axis] - a[axis]);
    let (x, y) = (edge(b), edge(c));
    let normal = [x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]];
    let area = normal.iter().map(|n| n * n).sum::<f64>().sqrt().max(f64::MIN_POSITIVE);
    let middle = [0, 1, 2].map(|axis| (a[axis] + b[axis] + c[axis]) / 3.0 - origin[axis]);
    let off = (OFF[0] * area.sqrt()).max(OFF[1] * middle.iter().fold(0.0, |most: f64, x| most.max(x.abs())));
    Some([0, 1, 2].map(|axis| (middle[axis] + normal[axis] / area * off) as f32))
}
