//! Textures from arrays of numbers.

use crate::{buffer::check_order, error::setting};
use gonio::{
    colour::{ColourSpace, Stated},
    scene::TextureSource,
    texture::{Image, MipMap, Texels, TextureError},
};
use pyo3::{
    buffer::{Element, PyBuffer},
    exceptions::{PyTypeError, PyValueError},
    prelude::*,
};
use std::sync::{Arc, atomic::AtomicBool};

/// An array (height, width) or (height, width, channels), rows from the top: bytes and 16-bit numbers are fractions of their largest, floats are as
/// they stand. The colour space says what they mean, as of a file.
pub(crate) fn source(pixels: &Bound<'_, PyAny>, colour_space: &str) -> PyResult<TextureSource> {
    let space = ColourSpace::parse(colour_space).map_err(|error| setting("colour_space", error.to_string()))?;
    let image = image(pixels)?;
    let (width, height) = (image.width, image.height);
    if let (4, ColourSpace::Raw, Texels::Float(values)) = (image.channels, space, &image.texels) {
        return Ok(TextureSource::Pixels { width, height, rgba: values.as_slice().into() });
    }
    let rgba = pixels.py().detach(|| -> Result<Arc<[f32]>, TextureError> {
        let map = MipMap::build(&image, space, &AtomicBool::new(false))?;
        let places = (0..height as usize).flat_map(|y| (0..width as usize).map(move |x| [x, y]));
        Ok(places.flat_map(|[x, y]| map.texel(0, x, y).unwrap_or_default()).collect())
    });
    let rgba = rgba.map_err(|error| setting("pixels", error.to_string()))?;
    Ok(TextureSource::Pixels { width, height, rgba })
}

fn image(pixels: &Bound<'_, PyAny>) -> PyResult<Image> {
    if let Some((size, values)) = values::<f32>(pixels)? {
        return Ok(made(size, Texels::Float(values)));
    }
    if let Some((size, values)) = values::<f64>(pixels)? {
        return Ok(made(size, Texels::Float(values.into_iter().map(|x| x as f32).collect())));
    }
    if let Some((size, values)) = values::<u8>(pixels)? {
        return Ok(made(size, Texels::Byte(values)));
    }
    if let Some((size, values)) = values::<u16>(pixels)? {
        return Ok(made(size, Texels::Short(values)));
    }
    let found = pixels.get_type().name()?;
    Err(PyTypeError::new_err(format!("pixels: expected an array of uint8, uint16, float32 or float64, found {found}")))
}

fn made([width, height, channels]: [u32; 3], texels: Texels) -> Image {
    Image { width, height, channels, texels, stated: Stated::Nothing }
}

/// Width, height, channels and the numbers of a buffer of this type.
fn values<T: Element>(pixels: &Bound<'_, PyAny>) -> PyResult<Option<([u32; 3], Vec<T>)>> {
    let Ok(buffer) = PyBuffer::<T>::get(pixels) else { return Ok(None) };
    check_order(&buffer, "pixels")?;
    let size = match *buffer.shape() {
        [height, width] => [width, height, 1],
        [height, width, channels] if (1..=4).contains(&channels) => [width, height, channels],
        _ => [0; 3],
    };
    if size.contains(&0) {
        let problem = format!("pixels: the shape is {:?}, expected (height, width) or (height, width, 1 to 4)", buffer.shape());
        return Err(PyValueError::new_err(problem));
    }
    let mut sides = [0; 3];
    for (side, found) in sides.iter_mut().zip(size) {
        *side = u32::try_from(found).map_err(|_| PyValueError::new_err(format!("pixels: a side of {found} is too long")))?;
    }
    Ok(Some((sides, buffer.to_vec(pixels.py())?)))
}
