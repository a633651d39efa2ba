//! `.bsdf` files of the EPFL material database.

use super::super::colour::Channels;
use super::super::tensor_file::{Field, TensorFile};
use super::super::warp::{Interpolant, Warp};
use super::Rgl;
use crate::error::{FormatError, Result};

/// What all arrays of one file share.
struct Parameters {
    phi: Vec<f32>,
    theta: Vec<f32>,
}

impl Rgl {
    /// Reads a `.bsdf` tensor file.
    ///
    /// # Errors
    /// When a field is absent, has another shape than the others say, or holds a number that is not finite.
    pub fn read(bytes: &[u8]) -> Result<Self> {
        Self::from_tensor_file(&TensorFile::read(bytes)?)
    }

    pub(crate) fn from_tensor_file(file: &TensorFile<'_>) -> Result<Self> {
        let parameters = Parameters { phi: knots(file.field("phi_i")?)?, theta: knots(file.field("theta_i")?)? };
        let (channels, spectra) = match file.find("wavelengths") {
            Some(field) => (bands(field)?, file.field("spectra")?),
            None => (Channels::Rgb, file.field("rgb")?),
        };
        let luminance = parameters.warp(file.field("luminance")?)?;
        let resolution = (luminance.density.rows, luminance.density.columns);
        let flag = file.field("jacobian")?.numbers();
        let description = file.find("description").map_or(String::new(), |field| String::from_utf8_lossy(field.bytes()).into_owned());
        Ok(Self {
            description,
            jacobian: flag.first().is_some_and(|&x| x != 0.0),
            spectra: parameters.spectra(spectra, channels.count(), resolution)?,
            channels,
            ndf: plane(file.field("ndf")?)?,
            sigma: plane(file.field("sigma")?)?,
            vndf: parameters.warp(file.field("vndf")?)?,
            luminance,
        })
    }
}

impl Parameters {
    fn warp(&self, field: &Field<'_>) -> Result<Warp> {
        field.expect_shape(&[Some(self.phi.len()), Some(self.theta.len()), None, None], 2)?;
        let mut data = field.finite_floats()?;
        // A density below zero is noise of what wrote the file.
        data.iter_mut().for_each(|x| *x = x.max(0.0));
        let (rows, columns) = (field.shape[2], field.shape[3]);
        Ok(Warp::new(Interpolant { parameters: vec![self.phi.clone(), self.theta.clone()], columns, rows, data }))
    }

    fn spectra(&self, field: &Field<'_>, channels: usize, (rows, columns): (usize, usize)) -> Result<Interpolant> {
        field.expect_shape(&[Some(self.phi.len()), Some(self.theta.len()), Some(channels), Some(rows), Some(columns)], 2)?;
        let index = (0..channels).map(|c| c as f32).collect();
        Ok(Interpolant { parameters: vec![self.phi.clone(), self.theta.clone(), index], columns, rows, data: field.finite_floats()? })
    }
}

/// An array that depends on no parameter.
fn plane(field: &Field<'_>) -> Result<Interpolant> {
    field.expect_shape(&[None, None], 2)?;
    Ok(Interpolant { parameters: Vec::new(), columns: field.shape[1], rows: field.shape[0], data: field.finite_floats()? })
}

/// Parameters' knots, strictly increasing.
fn knots(field: &Field<'_>) -> Result<Vec<f32>> {
    field.expect_shape(&[None], 1)?;
    let knots = field.finite_floats()?;
    match knots.windows(2).find(|w| w[0] >= w[1]) {
        Some(w) => Err(FormatError::whole(format!("parameter {} after {}, expected strictly increasing ones", w[1], w[0]))),
        None => Ok(knots),
    }
}

fn bands(field: &Field<'_>) -> Result<Channels> {
    field.expect_shape(&[None], 1)?;
    Channels::bands(field.numbers())
}
