//! Polarised `.pbsdf` files (Baek et al., Image-Based Acquisition and Modeling of Polarimetric Reflectance, 2020): what they say of
//! unpolarised light, the first element of each Mueller matrix.

use core::f64::consts::{FRAC_PI_2, PI};

use super::axis::{Axis, Mode};
use super::colour::Channels;
use super::coordinates::Coordinates;
use super::hemispheres::Hemispheres;
use super::table::{Layout, Table};
use super::tensor_file::{Field, TensorFile};
use crate::error::{FormatError, Result};

/// Elements of a Mueller matrix.
const MUELLER: usize = 16;

/// Reads `M` over φd, θd, θh and wavelength. Cells below the horizon and those that were not measured are not
/// numbers or exactly zero in the files; noise below zero is zero. Axes of no length are taken
/// for equal steps: φd from −π to π, θd and θh from 0 to π/2.
///
/// # Errors
/// When a field is absent, shapes do not fit each other, or axes do not increase.
pub(crate) fn from_tensor_file(file: &TensorFile<'_>) -> Result<Table> {
    let matrix = file.field("M")?;
    matrix.expect_shape(&[None, None, None, None, Some(4), Some(4)], 1)?;
    let [phi, difference, half, bands] = [0, 1, 2, 3].map(|i| matrix.shape[i]);
    let wavelengths = file.field("wvls")?.numbers();
    if wavelengths.len() != bands {
        return Err(FormatError::whole(format!("{} wavelengths, expected {bands} as in \"M\"", wavelengths.len())));
    }
    let axes = vec![
        axis(file.field("theta_h")?, half, 0.0, FRAC_PI_2)?,
        axis(file.field("theta_d")?, difference, 0.0, FRAC_PI_2)?,
        axis(file.field("phi_d")?, phi, -PI, PI)?,
    ];
    let layout = Layout {
        coordinates: Coordinates::HalfDifference,
        axes,
        channels: Channels::bands(wavelengths)?,
        hemispheres: Hemispheres::ReflectionFront,
        reciprocal: false,
        bilateral: false,
    };
    let numbers = matrix.numbers();
    let mut values = Vec::with_capacity(layout.value_count()?);
    for h in 0..half {
        for d in 0..difference {
            for p in 0..phi {
                let first = ((p * difference + d) * half + h) * bands;
                values.extend((first..first + bands).map(|cell| clean(numbers[cell * MUELLER])));
            }
        }
    }
    Table::new(layout, values)
}

fn clean(x: f64) -> f32 {
    let x = x as f32;
    if x.is_finite() && x != 0.0 { x.max(0.0) } else { f32::NAN }
}

/// An axis of `count` knots, radians.
fn axis(field: &Field<'_>, count: usize, first: f64, last: f64) -> Result<Axis> {
    match field.numbers() {
        knots if knots.is_empty() => Axis::uniform(first, last, count, Mode::Linear),
        knots if knots.len() == count => Axis::new(knots, Mode::Linear),
        knots => Err(FormatError::whole(format!("an axis of {} values, expected {count} as in \"M\"", knots.len()))),
    }
}
