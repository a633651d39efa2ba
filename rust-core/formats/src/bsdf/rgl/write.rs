//! The tensor file of a measurement.

use super::super::colour::Channels;
use super::super::tensor_file::{Data, Output, write};
use super::super::warp::Interpolant;
use super::Rgl;

impl Rgl {
    /// The `.bsdf` tensor file, as the EPFL database has them: readable by Mitsuba 3 and pbrt-v4.
    pub fn write(&self) -> Vec<u8> {
        let wavelengths: Vec<f32> = match &self.channels {
            Channels::Bands { wavelengths_nm } => wavelengths_nm.iter().map(|&w| w as f32).collect(),
            _ => Vec::new(),
        };
        let jacobian = [u8::from(self.jacobian)];
        let bytes = |name, data| Output { name, shape: vec![data_len(&data)], data };
        let mut outputs = vec![
            bytes("description", Data::Bytes(self.description.as_bytes())),
            bytes("jacobian", Data::Bytes(&jacobian)),
            bytes("phi_i", Data::Floats(self.phi_knots())),
            bytes("theta_i", Data::Floats(self.theta_knots())),
            array("ndf", &self.ndf),
            array("sigma", &self.sigma),
            array("vndf", &self.vndf.density),
            array("luminance", &self.luminance.density),
        ];
        if wavelengths.is_empty() {
            outputs.push(array("rgb", &self.spectra));
        } else {
            outputs.push(bytes("wavelengths", Data::Floats(&wavelengths)));
            outputs.push(array("spectra", &self.spectra));
        }
        write(&outputs)
    }
}

fn data_len(data: &Data<'_>) -> usize {
    match data {
        Data::Bytes(bytes) => bytes.len(),
        Data::Floats(floats) => floats.len(),
    }
}

/// An interpolant's parameters, rows and columns.
fn array<'a>(name: &'a str, interpolant: &'a Interpolant) -> Output<'a> {
    let parameters = interpolant.parameters.iter().map(Vec::len);
    let shape = parameters.chain([interpolant.rows, interpolant.columns]).collect();
    Output { name, shape, data: Data::Floats(&interpolant.data) }
}
