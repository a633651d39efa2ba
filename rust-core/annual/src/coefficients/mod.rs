//! Daylight coefficients: lx at a point for 1 cd/m² of a patch of the sky, or of a sun's disc.

mod npy;
mod radiance;

pub use npy::to_npy;

use crate::error::{AnnualError, Result};
use gonio_formats::FormatError;
use std::path::{Path, PathBuf};

/// Photopic weights of Radiance's red, green and blue (`color.h`); they make one.
const PHOTOPIC: [f64; 3] = [0.265_074_126, 0.670_114_631, 0.064_811_243];

/// Coefficients of points, in one or several independent estimates.
#[derive(Clone, Debug, PartialEq)]
pub struct Coefficients {
    /// The file they came from; empty for those that came from none.
    pub path: PathBuf,
    /// Rows.
    pub points: usize,
    /// Columns: patches with the ground first, or suns.
    pub columns: usize,
    /// Estimates of the whole, row after row each.
    pub blocks: Vec<Vec<f32>>,
}

impl Coefficients {
    /// Reads the bytes of a Radiance matrix (`rfluxmtx`, `rcontrib`: text, float or double, one or three components) or a NumPy array of points × columns, or
    /// of blocks × points × columns. The content decides, not the name.
    ///
    /// # Errors
    /// What is no matrix, and numbers that are negative or none, with their place.
    pub fn read(path: &Path, bytes: &[u8]) -> Result<Self> {
        let read = if bytes.starts_with(npy::MAGIC) { npy::read(bytes) } else { radiance::read(bytes) };
        read.map(|read| Self { path: path.into(), ..read }).map_err(|error| AnnualError::content(path, error))
    }

    /// Coefficients of a list, row after row.
    ///
    /// # Errors
    /// A length that is not `points` times `columns`, negative numbers and those that are none.
    pub fn new(points: usize, columns: usize, blocks: Vec<Vec<f32>>) -> std::result::Result<Self, FormatError> {
        if points == 0 || columns == 0 || blocks.is_empty() {
            return Err(FormatError::whole("the matrix is empty, expected points × patches"));
        }
        for block in &blocks {
            if Some(block.len()) != points.checked_mul(columns) {
                return Err(FormatError::whole(format!("{} numbers were found, expected {points} × {columns}", block.len())));
            }
            if let Some(place) = block.iter().position(|value| !(value.is_finite() && *value >= 0.0)) {
                let (row, column) = (place / columns + 1, place % columns + 1);
                return Err(FormatError::whole(format!(
                    "{} in row {row}, column {column}, expected a coefficient, 0 or more",
                    block[place]
                )));
            }
        }
        Ok(Self { path: PathBuf::new(), points, columns, blocks })
    }

    /// An error of the file.
    pub(crate) fn wrong(&self, problem: String) -> AnnualError {
        AnnualError::content(&self.path, FormatError::whole(problem))
    }

    /// The mean of the blocks, row after row; without one of them, if that is asked for.
    pub fn mean(&self, without: Option<usize>) -> Vec<f32> {
        let used: Vec<&Vec<f32>> =
            self.blocks.iter().enumerate().filter(|(index, _)| Some(*index) != without).map(|(_, block)| block).collect();
        if let [only] = used[..] {
            return only.clone();
        }
        let share = 1.0 / used.len() as f64;
        (0..self.points * self.columns)
            .map(|place| (used.iter().map(|block| f64::from(block[place])).sum::<f64>() * share) as f32)
            .collect()
    }
}

/// Luminous weight of a number of components: one, or red, green and blue.
fn luminous(components: &[f64]) -> f32 {
    match components {
        [only] => *only as f32,
        _ => components.iter().zip(PHOTOPIC).map(|(value, weight)| value * weight).sum::<f64>() as f32,
    }
}
