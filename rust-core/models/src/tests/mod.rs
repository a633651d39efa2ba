//! What files become, and what is said of wrong ones.

mod hbjson;
mod outlines;
mod radiance;

use crate::{Model, Options};
use std::path::Path;

/// A model of a text with the ending of a name.
fn model(name: &str, text: &str) -> Model {
    try_model(name, text).expect("a model")
}

fn try_model(name: &str, text: &str) -> gonio_scene::Result<Model> {
    let path = Path::new("/nowhere").join(name);
    if name.ends_with("rad") {
        crate::rad::read(&path, text, &Options::default())
    } else {
        crate::hbjson::read(&path, text, &Options::default())
    }
}

/// The warnings and notes with their places.
fn told(model: &Model) -> Vec<String> {
    model.diagnostics.iter().map(ToString::to_string).collect()
}

/// Area of the mesh whose origin has a name, m².
fn area(model: &Model, name: &str) -> f64 {
    let mesh = model.scene.meshes.iter().find(|mesh| &*mesh.origin.name == name).expect("the mesh");
    let corner = |i: u32| mesh.points[i as usize].map(f64::from);
    let twice = |&[a, b, c]: &[u32; 3]| {
        let [a, b, c] = [a, b, c].map(corner);
        crate::vector::length(crate::vector::cross(crate::vector::sub(b, a), crate::vector::sub(c, a)))
    };
    mesh.triangles.iter().map(twice).sum::<f64>() / 2.0
}
