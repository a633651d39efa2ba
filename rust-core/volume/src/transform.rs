//! From a grid's index space to the world.

use crate::Result;
use crate::stream::Stream;

/// An affine map from index space to world space.
///
/// Rows as in OpenVDB and USD: a point goes to `(x, y, z, 1) · M`, the fourth row is the translation and the fourth column 0, 0, 0, 1.
/// A voxel's value stands at its whole-numbered index point: voxel (i, j, k) is the cube of edge 1 about the *centre* (i, j, k).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transform(pub [[f64; 4]; 4]);

impl Transform {
    /// Voxels of one edge length, and the world position of the centre of voxel (0, 0, 0).
    pub fn uniform(voxel_size: f64, origin: [f64; 3]) -> Self {
        Self::scaled([voxel_size; 3], origin)
    }

    pub(crate) fn scaled(scale: [f64; 3], translation: [f64; 3]) -> Self {
        let [x, y, z] = scale;
        let [a, b, c] = translation;
        Self([[x, 0.0, 0.0, 0.0], [0.0, y, 0.0, 0.0], [0.0, 0.0, z, 0.0], [a, b, c, 1.0]])
    }

    /// Where an index point lies in the world.
    pub fn point(&self, index: [f64; 3]) -> [f64; 3] {
        let m = &self.0;
        std::array::from_fn(|c| index[0] * m[0][c] + index[1] * m[1][c] + index[2] * m[2][c] + m[3][c])
    }

    /// The lengths in the world of a voxel's three edges.
    pub fn voxel_size(&self) -> [f64; 3] {
        std::array::from_fn(|axis| self.0[axis][..3].iter().map(|part| part * part).sum::<f64>().sqrt())
    }

    pub(crate) fn determinant(&self) -> f64 {
        let [a, b, c, _] = self.0;
        a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])
    }

    /// What makes it useless, if anything.
    pub(crate) fn problem(&self) -> Option<String> {
        if self.0.iter().flatten().any(|part| !part.is_finite()) {
            return Some("the transform has numbers that are not finite".into());
        }
        if self.0.iter().zip([0.0, 0.0, 0.0, 1.0]).any(|(row, last)| (row[3] - last).abs() > 1e-9) {
            return Some("the transform is projective; only affine ones are read".into());
        }
        let determinant = self.determinant();
        (determinant == 0.0 || !determinant.is_finite()).then(|| "the transform is singular".into())
    }
}

/// A transform as a file tells it, or why it has no affine form.
pub(crate) fn read(stream: &mut Stream, version: u32) -> Result<std::result::Result<Transform, String>> {
    let start = stream.position();
    let name = stream.text()?;
    if name == "NonlinearFrustumMap" {
        // The box of whole numbers became one of real ones with version 221.
        let bounds = if version < 221 { 24 } else { 48 };
        stream.skip(bounds + 16)?;
        let second = stream.text()?;
        affine(stream, &second, start)?;
        return Ok(Err("the transform is a frustum; resample the grid to a box, by vdb_tool or in Houdini, before it is used here".into()));
    }
    let transform = affine(stream, &name, start)?;
    Ok(transform.problem().map_or(Ok(transform), Err))
}

fn affine(stream: &mut Stream, name: &str, start: u64) -> Result<Transform> {
    let vector = |stream: &mut Stream| Ok([stream.f64()?, stream.f64()?, stream.f64()?]);
    match name {
        "AffineMap" | "UnitaryMap" => {
            let mut rows = [[0.0; 4]; 4];
            for value in rows.iter_mut().flatten() {
                *value = stream.f64()?;
            }
            Ok(Transform(rows))
        }
        "TranslationMap" => Ok(Transform::scaled([1.0; 3], vector(stream)?)),
        "ScaleMap" | "UniformScaleMap" | "ScaleTranslateMap" | "UniformScaleTranslateMap" => {
            let translation = if name.ends_with("TranslateMap") { vector(stream)? } else { [0.0; 3] };
            let scale = vector(stream)?;
            // The voxel's size, and three vectors that follow from the scale.
            stream.skip(4 * 24)?;
            Ok(Transform::scaled(scale, translation))
        }
        _ => Err(stream.error_at(start, format!("a transform of type {name:.40}, which OpenVDB does not have"))),
    }
}
