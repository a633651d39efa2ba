//! Values of shader inputs as attributes hold them, and colours in other spaces than the renderer's.

use super::neutral::Value;
use crate::prim::Attribute;
use crate::pxr::Module;
use crate::vt::{AssetPath, FloatArray, FromValue};
use gonio::colour::{ColourSpace, apply};
use pyo3::{
    intern,
    prelude::*,
    types::{PyFloat, PyInt, PyString},
};

/// The unit matrix.
pub(in crate::material) const UNIT_MATRIX: [[f32; 4]; 4] =
    [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];

impl Value {
    /// The value behind a Python object; `None` for kinds that shading does not use.
    pub(crate) fn from_python(object: &Bound<'_, PyAny>) -> Option<Self> {
        if object.is_instance_of::<PyFloat>() || object.is_instance_of::<PyInt>() {
            return object.extract::<f64>().ok().map(|number| Self::Numbers([number as f32; 4], 1));
        }
        if object.is_instance_of::<PyString>() {
            return object.extract().ok().map(Self::Text);
        }
        // Vectors are buffers, which are read without an exception.
        if let Some(vector) = FloatArray::from_value(object).filter(|array| array.components == 1 && (1..=4).contains(&array.values.len()))
        {
            let mut values = [0.0, 0.0, 0.0, 1.0];
            values[..vector.values.len()].copy_from_slice(&vector.values);
            return Some(Self::Numbers(values, vector.values.len()));
        }
        if object.hasattr(intern!(object.py(), "resolvedPath")).unwrap_or(false) {
            return AssetPath::from_value(object).map(Self::Asset);
        }
        let mut values = [0.0, 0.0, 0.0, 1.0];
        let mut count = 0;
        if let Ok(size) = object.getattr(intern!(object.py(), "dimension")).and_then(|size| size.extract::<(usize, usize)>()) {
            return matrix(object, size.0).map(|rows| Self::Matrix(Box::new(rows), size.0));
        }
        for item in object.try_iter().ok()? {
            *values.get_mut(count)? = item.ok()?.extract::<f64>().ok()? as f32;
            count += 1;
        }
        (count > 0).then_some(Self::Numbers(values, count))
    }
}

/// The rows of a `Gf` matrix, filled up with those of the unit matrix.
fn matrix(object: &Bound<'_, PyAny>, size: usize) -> Option<[[f32; 4]; 4]> {
    let mut rows = UNIT_MATRIX;
    for (r, row) in rows.iter_mut().enumerate().take(size) {
        for (c, item) in row.iter_mut().enumerate().take(size) {
            *item = object.get_item((r, c)).ok()?.extract::<f64>().ok()? as f32;
        }
    }
    Some(rows)
}

/// The colour space that is said for an attribute, by itself or by the prims above; empty if none is.
pub(crate) fn stated_colour_space(attribute: &Attribute<'_>) -> String {
    let object = attribute.object();
    let py = object.py();
    let own = || -> PyResult<String> { object.call_method0(intern!(py, "GetColorSpace"))?.extract() };
    let inherited = || -> PyResult<String> {
        // The second argument is a cache, which there need not be.
        Module::Usd.item(py, "ColorSpaceAPI")?.call_method1(intern!(py, "ComputeColorSpaceName"), (object, py.None()))?.extract()
    };
    // Older versions of the package have no ColorSpaceAPI.
    own().ok().filter(|space| !space.is_empty()).or_else(|| inherited().ok()).unwrap_or_default()
}

/// Whether an attribute's type is a colour.
pub(in crate::material) fn is_colour(attribute: &Attribute<'_>) -> bool {
    attribute.type_name().starts_with("color")
}

/// Linear Rec.709 of a colour given in the space called `space`; `Err` gives the name back if it is not known.
pub(crate) fn to_linear_rec709(rgba: [f32; 4], space: &str) -> Result<[f32; 4], String> {
    match ColourSpace::parse(space) {
        Ok(ColourSpace::Auto | ColourSpace::Raw | ColourSpace::SrgbTimesAlpha(_)) => Ok(rgba),
        Ok(ColourSpace::Colour { transfer, gamut }) => {
            let linear = [rgba[0], rgba[1], rgba[2]].map(|x| transfer.decode(f64::from(x)));
            let [r, g, b] = gamut.to_rec709().map_or(linear, |matrix| apply(&matrix, linear));
            Ok([r as f32, g as f32, b as f32, rgba[3]])
        }
        Err(unknown) => Err(unknown.name),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn acescg_red_leaves_rec709() {
        let [r, g, b, a] = to_linear_rec709([0.5, 0.2, 0.1, 0.7], "lin_ap1_scene").expect("known space");
        for (found, expected) in [(r, 0.7198409), (g, 0.161_977_92), (b, 0.077_501_76), (a, 0.7)] {
            assert!((found - expected).abs() < 2e-3, "{found} {expected}");
        }
        assert_eq!(to_linear_rec709([0.5; 4], "no such space"), Err("no such space".to_owned()));
    }
}
