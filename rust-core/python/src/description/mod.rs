//! Elements of a scene described by dictionaries: the form that `Scene.to_dict` gives.
//!
//! It is JSON's: structures are dictionaries, sequences lists, a variant with content a dictionary of one entry.

mod reader;
mod writer;

use crate::error::setting;
use gonio::scene::{Texture, TextureSource, Tile, Transform, Visibility};
use pyo3::{prelude::*, pybacked::PyBackedBytes, types::PyDict};
use reader::Reader;
use serde::{Serialize, de, de::DeserializeOwned, ser};
use std::{
    collections::{BTreeMap, HashMap},
    fmt::{self, Display},
    sync::Arc,
};
use writer::Writer;

/// A dictionary as an element.
pub(crate) fn read<T: DeserializeOwned>(description: &Bound<'_, PyAny>, kind: &str) -> PyResult<T> {
    let element = T::deserialize(Reader::new(description));
    element.map_err(|problem| setting(kind, format!("the description is not understood: {problem}")))
}

/// An element as a dictionary.
pub(crate) fn to_python<'py>(py: Python<'py>, element: &impl Serialize) -> PyResult<Bound<'py, PyAny>> {
    element.serialize(Writer { py }).map_err(|problem| setting("description", problem.to_string()))
}

/// A map as a 4×4 matrix for column vectors.
pub(crate) fn matrix(map: &Transform) -> [[f64; 4]; 4] {
    let [x, y, z, t] = map.columns;
    let row = |axis: usize| [x[axis], y[axis], z[axis], t[axis]];
    [row(0), row(1), row(2), [0.0, 0.0, 0.0, 1.0]]
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
            None => Err(setting(kind, format!("number {index} was asked for, the scene has {}", list.len()))),
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
            "volume" => &mut visibility.volume,
            "shadow" => &mut visibility.shadow,
            "holdout" => &mut holdout,
            "shadow_catcher" => &mut shadow_catcher,
            other => {
                let expected = "camera, diffuse, glossy, transmission, volume, shadow, holdout or shadow_catcher";
                return Err(setting("visibility", format!("'{other}' was found, expected {expected}")));
            }
        };
        *place = seen;
    }
    Ok((visibility, [holdout, shadow_catcher]))
}

/// Encoded files given beside a texture's description: one, or UDIM tiles by number.
#[derive(FromPyObject)]
pub(crate) enum Data {
    File(PyBackedBytes),
    Tiles(BTreeMap<u32, PyBackedBytes>),
}

/// A texture whose source may be given beside the description.
pub(crate) fn texture(
    description: &Bound<'_, PyDict>,
    data: Option<(String, Data)>,
    pixels: Option<&Bound<'_, PyAny>>,
) -> PyResult<Texture> {
    let source = match (data, pixels) {
        (Some((name, Data::File(bytes))), _) => TextureSource::Encoded { name, bytes: Arc::from(&*bytes) },
        (Some((name, Data::Tiles(tiles))), _) => {
            let tile = |(number, bytes): (u32, PyBackedBytes)| Tile { number, bytes: Arc::from(&*bytes) };
            TextureSource::Tiles { name, tiles: tiles.into_iter().map(tile).collect() }
        }
        (None, Some(pixels)) => {
            let space = description.get_item("colour_space")?.map(|space| space.extract::<String>()).transpose()?;
            crate::pixels::source(pixels, &space.unwrap_or_default())?
        }
        (None, None) => return read(description, "texture"),
    };
    let description = description.copy()?;
    // The reader wants a source of some kind; the true one takes its place.
    description.set_item("source", [("File", "")].into_iter().collect::<HashMap<_, _>>())?;
    let texture: Texture = read(&description, "texture")?;
    Ok(Texture { source, ..texture })
}

/// What is wrong with a value, and where in it.
#[derive(Debug)]
struct Problem {
    text: String,
    /// Steps to the place, the last one first.
    path: Vec<String>,
}

impl Problem {
    fn within(mut self, step: String) -> Self {
        self.path.push(step);
        self
    }
}

impl Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let path: String = self.path.iter().rev().map(String::as_str).collect();
        match path.trim_start_matches('.') {
            "" => f.write_str(&self.text),
            path => write!(f, "{path}: {}", self.text),
        }
    }
}

impl std::error::Error for Problem {}

impl From<PyErr> for Problem {
    fn from(error: PyErr) -> Self {
        de::Error::custom(error)
    }
}

impl de::Error for Problem {
    fn custom<T: Display>(text: T) -> Self {
        Self { text: text.to_string(), path: Vec::new() }
    }
}

impl ser::Error for Problem {
    fn custom<T: Display>(text: T) -> Self {
        de::Error::custom(text)
    }
}
