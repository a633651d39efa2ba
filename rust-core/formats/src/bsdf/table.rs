//! A table of BSDF values over angles, on any grid.

use super::axis::{Axis, Interval};
use super::colour::Channels;
use super::coordinates::{Coordinates, MOST_AXES};
use super::direction::Direction;
use super::hemispheres::Hemispheres;
use super::quadrature::{STRATA, quadrature};
use crate::error::{FormatError, Result};

/// Valid cells that weigh less than that together are an angle's rounding, not a neighbourhood.
const LEAST_WEIGHT: f64 = 1e-6;

/// What a table is, but for its values.
#[derive(Clone, Debug, PartialEq)]
pub struct Layout {
    /// What the axes stand for.
    pub coordinates: Coordinates,
    /// The axes, the slowest first.
    pub axes: Vec<Axis>,
    /// What the channels are.
    pub channels: Channels,
    /// Which sides light goes between. Of a back side the directions are mirrored in the surface: x and y stay.
    pub hemispheres: Hemispheres,
    /// Whether the values hold with light going the other way; a cell without a valid value is then taken from there.
    pub reciprocal: bool,
    /// Whether the material has a plane of symmetry, y = 0 or, where only the difference of azimuths counts, any through the normal.
    pub bilateral: bool,
}

/// A table of BSDF values in 1/sr, *without* the cosine.
///
/// Values are one flat array, axes in order, the last axis fastest, the channels of a cell side by side: what a lane kernel gathers as it
/// is. A cell that was not measured is NaN in all channels.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    layout: Layout,
    values: Vec<f32>,
}

impl Layout {
    /// Whether only the difference of azimuths counts.
    pub fn is_isotropic(&self) -> bool {
        match self.coordinates {
            Coordinates::Isotropic | Coordinates::HalfDifference => true,
            Coordinates::Anisotropic => false,
            Coordinates::Specular => self.axes.first().is_some_and(|rotation| rotation.knots().len() == 1),
        }
    }

    /// The directions (wi, wo) of a cell, both taken for the front's; one is below the surface where the coordinates reach there.
    pub(crate) fn directions(&self, cell: usize) -> (Direction, Direction) {
        self.coordinates.directions(&place(&self.axes, cell))
    }

    /// Cells times channels.
    ///
    /// # Errors
    /// When the axes are not as many as the coordinates say, or the product is not a size a machine has.
    pub fn value_count(&self) -> Result<usize> {
        let expected = self.coordinates.axis_names().len();
        if self.axes.len() != expected {
            return Err(FormatError::whole(format!("{} axes, expected {expected} for {}", self.axes.len(), self.coordinates.name())));
        }
        self.axes
            .iter()
            .map(|axis| axis.knots().len())
            .try_fold(self.channels.count(), usize::checked_mul)
            .filter(|&count| count <= isize::MAX as usize / 8)
            .ok_or_else(|| FormatError::whole("the product of the axes' lengths is too large"))
    }
}

impl Table {
    /// A table of values in 1/sr, without the cosine.
    ///
    /// # Errors
    /// When there are more or fewer values than cells times channels, or one is negative or infinite.
    pub fn new(layout: Layout, mut values: Vec<f32>) -> Result<Self> {
        let expected = layout.value_count()?;
        if values.len() != expected {
            return Err(FormatError::whole(format!("{} values, expected {expected}", values.len())));
        }
        if let Some(at) = values.iter().position(|v| *v < 0.0 || v.is_infinite()) {
            return Err(FormatError::whole(format!(
                "value {} is {}, expected zero or more, or NaN where not measured",
                at + 1,
                values[at]
            )));
        }
        for cell in values.chunks_exact_mut(layout.channels.count()) {
            if cell.iter().any(|v| v.is_nan()) {
                cell.fill(f32::NAN);
            }
        }
        Ok(Self { layout, values })
    }

    /// A table whose cells are computed from the directions (wi, wo) of their knots; `value` fills the channels of one cell, in 1/sr and
    /// without the cosine. Where one of the directions is below the surface the cell is NaN.
    ///
    /// # Errors
    /// As [`Table::new`].
    pub fn from_function(layout: Layout, value: impl Fn(Direction, Direction, &mut [f32])) -> Result<Self> {
        let count = layout.value_count()?;
        let mut values = vec![f32::NAN; count];
        for (cell, channels) in values.chunks_exact_mut(layout.channels.count()).enumerate() {
            let (wi, wo) = layout.directions(cell);
            if wi[2] >= 0.0 && wo[2] >= 0.0 {
                value(wi, wo, channels);
            }
        }
        Self::new(layout, values)
    }

    /// What the table is.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// The values, in 1/sr.
    pub fn values(&self) -> &[f32] {
        &self.values
    }

    /// One channel's hemispherical reflectance or transmittance of light from `wi`; both directions are taken for the front's.
    pub(crate) fn total(&self, wi: Direction, channel: usize) -> f64 {
        let mut values = vec![0.0; self.layout.channels.count()];
        quadrature(wi, STRATA)
            .map(|node| {
                self.gather(wi, node.direction, &mut values);
                values[channel] * node.direction[2] * node.solid_angle
            })
            .sum()
    }

    /// How many cells have no value.
    pub fn invalid_cells(&self) -> usize {
        self.values.chunks_exact(self.layout.channels.count()).filter(|cell| cell[0].is_nan()).count()
    }

    /// The BSDF of two directions (light from `wi`, seen from `wo`) in 1/sr for each channel; multilinear between knots, invalid cells left
    /// out and the other weights scaled up. Zero if none is valid.
    pub(crate) fn value(&self, wi: Direction, wo: Direction, out: &mut [f64]) {
        let (wi, wo) = self.layout.hemispheres.to_front(wi, wo);
        if !self.gather(wi, wo, out) && self.layout.reciprocal {
            self.gather(wo, wi, out);
        }
    }

    /// As [`Table::value`] for directions at the front; false if no cell was valid.
    fn gather(&self, wi: Direction, wo: Direction, out: &mut [f64]) -> bool {
        let layout = &self.layout;
        let place = layout.coordinates.of(wi, wo, layout.bilateral);
        let mut intervals = [Interval { low: 0, high: 0, t: 0.0 }; MOST_AXES];
        for (i, axis) in layout.axes.iter().enumerate() {
            intervals[i] = axis.locate(place[i], layout.coordinates.is_azimuth(i));
        }
        let channels = layout.channels.count();
        let mut total = 0.0;
        out.fill(0.0);
        for corner in 0..1_usize << layout.axes.len() {
            let (cell, weight) = self.corner(corner, &intervals);
            let values = &self.values[cell * channels..][..channels];
            if weight > 0.0 && !values[0].is_nan() {
                total += weight;
                out.iter_mut().zip(values).for_each(|(sum, v)| *sum += weight * f64::from(*v));
            }
        }
        if total <= LEAST_WEIGHT {
            out.fill(0.0);
            return false;
        }
        out.iter_mut().for_each(|sum| *sum /= total);
        true
    }

    /// A corner's cell and weight: bit `i` of `corner` says whether it is at the upper knot of axis `i`.
    fn corner(&self, corner: usize, intervals: &[Interval; MOST_AXES]) -> (usize, f64) {
        let axes = self.layout.axes.iter().zip(intervals).enumerate();
        axes.fold((0, 1.0), |(cell, weight), (i, (axis, interval))| {
            let upper = corner >> i & 1 == 1;
            let index = if upper { interval.high } else { interval.low };
            (cell * axis.knots().len() + index, weight * if upper { interval.t } else { 1.0 - interval.t })
        })
    }
}

/// The knots of a cell.
fn place(axes: &[Axis], mut cell: usize) -> Vec<f64> {
    let mut place = vec![0.0; axes.len()];
    for (x, axis) in place.iter_mut().zip(axes).rev() {
        *x = axis.knots()[cell % axis.knots().len()];
        cell /= axis.knots().len();
    }
    place
}
