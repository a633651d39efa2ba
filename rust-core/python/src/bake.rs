//! Pixels that lie on surfaces, from Python's buffers.

use crate::{buffer::doubles, error::setting};
use gonio::{
    accel::NONE,
    bake::{BakeTarget, ViewFrom},
};
use pyo3::{buffer::PyBuffer, exceptions::PyValueError, prelude::*};

/// What is baked, as it was given.
pub(crate) struct BakedPlaces {
    pub(crate) target: BakeTarget,
}

impl BakedPlaces {
    /// `triangles` (height, width), `places` (height, width, 2), `steps` (height, width, 4); `view` is above or camera.
    pub(crate) fn new(
        [instance, placement]: [u32; 2],
        triangles: &Bound<'_, PyAny>,
        places: &Bound<'_, PyAny>,
        steps: Option<&Bound<'_, PyAny>>,
        view: &str,
    ) -> PyResult<Self> {
        let (size, triangles) = numbers(triangles)?;
        let floats = |object, name: &str| doubles(object, name).map(|values| values.into_iter().map(|x| x as f32).collect::<Vec<f32>>());
        let places = floats(places, "places")?.as_chunks::<2>().0.to_vec();
        let steps = match steps {
            Some(steps) => floats(steps, "steps")?.as_chunks::<4>().0.iter().map(|s| [[s[0], s[1]], [s[2], s[3]]]).collect(),
            None => Vec::new(),
        };
        let view = match view {
            "above" => ViewFrom::Above,
            "camera" => ViewFrom::Camera,
            _ => return Err(setting("view", format!("'{view}' was found, expected above or camera"))),
        };
        Ok(Self { target: BakeTarget { instance, placement, size, triangles, places, steps, view } })
    }
}

/// Width and height, and the triangles; negative ones are none.
fn numbers(object: &Bound<'_, PyAny>) -> PyResult<([u32; 2], Vec<u32>)> {
    let wrong = || PyValueError::new_err("triangles: expected int32 of shape (height, width)");
    let buffer = PyBuffer::<i32>::get(object).map_err(|_| wrong())?;
    let [height, width] = *buffer.shape() else { return Err(wrong()) };
    let size = [u32::try_from(width).map_err(|_| wrong())?, u32::try_from(height).map_err(|_| wrong())?];
    let values = buffer.to_vec(object.py())?;
    Ok((size, values.into_iter().map(|number| u32::try_from(number).unwrap_or(NONE)).collect()))
}
