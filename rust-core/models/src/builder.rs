//! The scene while it is filled.

use crate::Model;
use crate::modifier::{Look, Modifier};
use crate::outline::Cut;
use crate::vector::{Vec3, cross, dot, unit};
use gonio_scene::{Diagnostic, Instances, Light, LightShape, MaterialId, Mesh, Origin, Primvar, PrimvarInterpolation, Transform};
use std::collections::HashMap;
use std::sync::Arc;

/// A surface's look in the scene.
#[derive(Clone, Debug)]
pub(crate) struct Paint {
    pub(crate) material: MaterialId,
    /// What points up in a measured material's sample.
    pub(crate) up: Option<Vec3>,
}

/// A triangle mesh in metres.
#[derive(Debug, Default)]
pub(crate) struct Triangles {
    pub(crate) points: Vec<Vec3>,
    pub(crate) triangles: Vec<[u32; 3]>,
    /// One a point where it is smooth.
    pub(crate) normals: Option<Vec<Vec3>>,
}

impl Triangles {
    pub(crate) fn of_cut(cut: &Cut, metres: f64) -> Self {
        let points = cut.points.iter().map(|p| p.map(|x| x * metres)).collect();
        Self { points, triangles: cut.triangles.clone(), normals: None }
    }
}

/// A scene that objects are added to.
#[derive(Debug, Default)]
pub(crate) struct Builder {
    pub(crate) model: Model,
    paints: HashMap<String, Option<Paint>>,
}

impl Builder {
    pub(crate) fn warn(&mut self, origin: &Origin, message: impl Into<String>) {
        self.model.diagnostics.push(Diagnostic::warning(origin, message));
    }

    pub(crate) fn note(&mut self, origin: &Origin, message: impl Into<String>) {
        self.model.diagnostics.push(Diagnostic::info(origin, message));
    }

    pub(crate) fn count(&mut self, what: &str) {
        *self.model.counts.entry(what.to_owned()).or_default() += 1;
    }

    /// The material of a modifier, made once for each `key`; `None` where nothing is to be seen of surfaces that have it.
    pub(crate) fn paint(&mut self, key: &str, origin: &Origin, modifier: &Modifier) -> Option<Paint> {
        if let Some(known) = self.paints.get(key) {
            return known.clone();
        }
        let look = modifier.look(&mut self.model.scene, origin);
        let paint = look.map(|Look { material, up }| Paint { material: self.model.scene.add_material(material), up });
        self.paints.insert(key.to_owned(), paint.clone());
        paint
    }

    /// Adds a mesh in one material.
    pub(crate) fn add(&mut self, origin: &Origin, shape: Triangles, paint: &Paint) {
        let st = paint.up.and_then(|up| coordinates(&shape, up));
        let narrow = |points: &[Vec3]| -> Arc<[[f32; 3]]> { points.iter().map(|p| p.map(|x| x as f32)).collect() };
        let normals = shape.normals.as_ref().map(|normals| Primvar {
            name: "normals".into(),
            interpolation: PrimvarInterpolation::Vertex,
            components: 3,
            values: narrow(normals).as_flattened().into(),
            indices: None,
        });
        // Far from the origin single precision is coarse: the mesh lies about its own first point.
        let place = shape.points.first().copied().unwrap_or_default();
        let local: Vec<Vec3> = shape.points.iter().map(|&p| crate::vector::sub(p, place)).collect();
        let mesh = Mesh {
            origin: origin.clone(),
            points: narrow(&local),
            triangles: shape.triangles.into(),
            normals,
            primvars: st.into_iter().collect(),
            ..Mesh::default()
        };
        let scene = &mut self.model.scene;
        let mesh = scene.add_mesh(mesh);
        scene.instances.push(Instances::new(origin.clone(), mesh, vec![paint.material], vec![Transform::translation(place)]));
    }

    /// Adds a lamp of a radiance whose luminance is in cd/m².
    pub(crate) fn add_lamp(&mut self, origin: &Origin, shape: LightShape, transform: Transform, radiance: [f32; 3]) {
        let mut light = Light::new(origin.clone(), shape, transform);
        light.emission.radiance = radiance;
        self.model.scene.lights.push(light);
    }
}

/// Texture coordinates whose first one runs along up × normal, as BSDF files have their x axis in Radiance.
fn coordinates(shape: &Triangles, up: Vec3) -> Option<Primvar> {
    let [a, b, c] = shape.triangles.first()?.map(|i| shape.points[i as usize]);
    let normal = unit(cross(crate::vector::sub(b, a), crate::vector::sub(c, a)))?;
    let x = unit(cross(up, normal))?;
    let y = cross(normal, x);
    let values = shape.points.iter().flat_map(|&p| [dot(p, x) as f32, dot(p, y) as f32]).collect();
    Some(Primvar { name: "st".into(), interpolation: PrimvarInterpolation::Vertex, components: 2, values, indices: None })
}
