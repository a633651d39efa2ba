//! Elements of a scene described by dictionaries: the form that `Scene.to_dict` gives.

use crate::{buffer::floats, error::exception};
use gonio::scene::{Texture, TextureSource, Visibility};
use pyo3::{prelude::*, pybacked::PyBackedBytes, types::PyDict};
use serde::de::DeserializeOwned;
use std::{collections::HashMap, sync::Arc};

fn wrong(kind: &str, problem: String) -> PyErr {
    exception(gonio::Error::Setting { name: kind.into(), problem })
}

/// A dictionary as an element.
pub(crate) fn read<T: DeserializeOwned>(description: &Bound<'_, PyDict>, kind: &str) -> PyResult<T> {
    let text: String = description.py().import("json")?.call_method1("dumps", (description,))?.extract()?;
    serde_json::from_str(&text).map_err(|error| wrong(kind, format!("the description is not understood: {error}")))
}

/// An element as a dictionary.
pub(crate) fn to_python<'py>(py: Python<'py>, element: &impl serde::Serialize) -> PyResult<Bound<'py, PyAny>> {
    let text = serde_json::to_string(element).map_err(|error| wrong("description", error.to_string()))?;
    py.import("json")?.call_method1("loads", (text,))
}

/// Appends an element, or replaces one; gives its number.
pub(crate) fn put<T>(list: &mut Vec<T>, kind: &str, element: T, index: Option<u32>) -> PyResult<u32> {
    match index {
        None => {
            list.push(element);
            Ok((list.len() - 1) as u32)
        }
        Some(index) => match list.get_mut(index as usize) {
            Some(place) => {
                *place = element;
                Ok(index)
            }
            None => Err(wrong(kind, format!("number {index} was asked for, the scene has {}", list.len()))),
        },
    }
}

/// Which rays see an element, and whether it cuts a hole and whether it catches shadows.
pub(crate) fn visibility(asked: HashMap<String, bool>) -> PyResult<(Visibility, [bool; 2])> {
    let mut visibility = Visibility::default();
    let (mut holdout, mut shadow_catcher) = (false, false);
    for (name, seen) in asked {
        let place = match name.as_str() {
            "camera" => &mut visibility.camera,
            "diffuse" => &mut visibility.diffuse,
            "glossy" => &mut visibility.glossy,
            "transmission" => &mut visibility.transmission,
            "shadow" => &mut visibility.shadow,
            "holdout" => &mut holdout,
            "shadow_catcher" => &mut shadow_catcher,
            other => {
                let expected = "camera, diffuse, glossy, transmission, shadow, holdout or shadow_catcher";
                return Err(wrong("visibility", format!("'{other}' was found, expected {expected}")));
            }
        };
        *place = seen;
    }
    Ok((visibility, [holdout, shadow_catcher]))
}

/// A texture whose source may be given beside the description.
pub(crate) fn texture(
    description: &Bound<'_, PyDict>,
    data: Option<(String, PyBackedBytes)>,
    pixels: Option<&Bound<'_, PyAny>>,
) -> PyResult<Texture> {
    let source = match (data, pixels) {
        (Some((name, bytes)), _) => TextureSource::Encoded { name, bytes: Arc::from(&*bytes) },
        (None, Some(pixels)) => {
            let shape: [usize; 3] = pixels.getattr("shape")?.extract()?;
            let flat = pixels.call_method1("reshape", (-1,))?;
            let rgba: Arc<[f32]> = floats(&flat, "pixels", 4)?.values.into();
            TextureSource::Pixels { width: shape[1] as u32, height: shape[0] as u32, rgba }
        }
        (None, None) => return read(description, "texture"),
    };
    let description = description.copy()?;
    // The reader wants a source of some kind; the true one takes its place.
    description.set_item("source", [("File", "")].into_iter().collect::<HashMap<_, _>>())?;
    let texture: Texture = read(&description, "texture")?;
    Ok(Texture { source, ..texture })
}
