//! The surfaces that get maps: which instances, and how large their triangles are in the world.

use super::options::MapOptions;
use crate::{
    compile::{CompiledScene, is_diced},
    error::{Error, Result},
    scene::{MeshId, Origin, Scene, Transform},
};

/// An instance that gets a map.
#[derive(Clone, Debug)]
pub struct MappedSurface {
    /// The object, or the prim.
    pub origin: Origin,
    /// Its number in the compiled scene.
    pub instance: u32,
    /// Its number among the placements of its set, and how many these are.
    pub placement: [u32; 2],
    /// Its mesh.
    pub mesh: MeshId,
    /// From the mesh to the world.
    pub transform: Transform,
    /// Square metres of the triangles in the world.
    pub areas: Vec<f64>,
}

impl MappedSurface {
    /// Square metres of one side.
    pub fn area(&self) -> f64 {
        self.areas.iter().sum()
    }
}

/// The surfaces that are asked for, in the scene's order; those without an area have no map.
pub(super) fn chosen(scene: &Scene, compiled: &CompiledScene, options: &MapOptions) -> Result<Vec<MappedSurface>> {
    if let Some(unknown) = options.prims.iter().find(|prim| !scene.instances.iter().any(|set| set.origin.is_below(prim))) {
        return Err(Error::setting("prim", format!("'{unknown}' is no surface of the scene and has none below it")));
    }
    let rows = &compiled.tables.geometry.instances[..compiled.tables.first_light_instance as usize];
    let surface = |(instance, row): (usize, &crate::geometry::InstanceRow)| {
        let set = &scene.instances[row.set as usize];
        if !options.prims.is_empty() && !options.prims.iter().any(|prim| set.origin.is_below(prim)) {
            return None;
        }
        let transform = set.transforms[row.number as usize];
        let number = set.geometry.mesh()?;
        // Its triangles are others when it is rendered.
        if is_diced(scene, set.geometry) {
            return None;
        }
        let mesh = &scene.meshes[number.index()];
        let areas: Vec<f64> = mesh.triangles.iter().map(|corners| area(&mesh.points, *corners, &transform)).collect();
        let surface = MappedSurface {
            origin: set.origin.clone(),
            instance: instance as u32,
            placement: [row.number, set.transforms.len() as u32],
            mesh: number,
            transform,
            areas,
        };
        (surface.area() > 0.0).then_some(surface)
    };
    let surfaces: Vec<MappedSurface> = rows.iter().enumerate().filter_map(surface).collect();
    if surfaces.is_empty() {
        return Err(Error::setting("prim", "there is no surface with an area to keep light on"));
    }
    Ok(surfaces)
}

/// Square metres of a triangle in the world; 0 of one that has none.
fn area(points: &[[f32; 3]], corners: [u32; 3], transform: &Transform) -> f64 {
    let [Some(a), Some(b), Some(c)] = corners.map(|corner| points.get(corner as usize).map(|point| point.map(f64::from))) else {
        return 0.0;
    };
    let edge = |end: [f64; 3]| transform.vector([0, 1, 2].map(|k| end[k] - a[k]));
    let (u, v) = (edge(b), edge(c));
    let cross = [0, 1, 2].map(|k| u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3]);
    let area = 0.5 * cross.iter().map(|x| x * x).sum::<f64>().sqrt();
    if area.is_finite() { area } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn areas_are_those_of_the_world() {
        let points = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let stretched = Transform { columns: [[2.0, 0.0, 0.0], [0.0, 0.0, 3.0], [0.0, 1.0, 0.0], [5.0; 3]] };
        assert!((area(&points, [0, 1, 2], &stretched) - 3.0).abs() < 1e-12);
        assert_eq!(area(&points, [0, 1, 7], &stretched), 0.0);
        assert_eq!(area(&points, [0, 1, 2], &Transform::scale(f64::NAN)), 0.0);
    }
}
