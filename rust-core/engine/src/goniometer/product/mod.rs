//! What a product's file has of a luminaire beside its photometry: its surfaces, its opening, and its lamps' colour.

mod lamps;
mod surfaces;

use super::{Reading, colour};
use crate::{
    error::Diagnostic,
    scene::{Origin, Scene, Transform},
};
use gonio_formats::{
    l3d::{L3dLight, L3dShape, NewModel, Place},
    photometry::{
        OpeningShape,
        measured::{ProductParts, Reduced},
    },
};
use lamps::Lamps;
use surfaces::Surface;

/// The name of the place where light leaves.
const LIGHT: &str = "light";

/// What is kept of a luminaire's description.
#[derive(Clone, Debug, Default)]
pub struct Product {
    surfaces: Vec<Surface>,
    lamps: Lamps,
    /// What a model does not hold.
    left_out: Vec<Diagnostic>,
}

impl Product {
    /// Of the luminaire's scene, with the map from the world to the luminaire's frame.
    pub(super) fn of(scene: &Scene, from_world: &Transform) -> Self {
        let (surfaces, left_out) = surfaces::all(scene, from_world);
        Self { surfaces, lamps: Lamps::of(scene), left_out }
    }
}

impl Reading {
    /// The bytes of a GLDF file: photometry, model, colour and spectrum; and what it cannot hold. `reduced` is this reading's measurement with a symmetry.
    ///
    /// # Errors
    /// A mesh that is too long for any reader.
    pub fn to_gldf(&self, reduced: &Reduced) -> crate::Result<(Vec<u8>, Vec<Diagnostic>)> {
        let mut told = self.product.left_out.clone();
        let origin = Origin::new("gldf");
        let mut tell = |message: String| told.push(Diagnostic::warning(&origin, message));
        let (colour, spectrum) = self.product.lamps.found(self, &mut tell);
        let parts = self.product.surfaces.iter().flat_map(Surface::parts).collect::<Vec<_>>();
        let model = if parts.is_empty() {
            tell("the luminaire has no meshes: no model is written".into());
            None
        } else {
            Some(NewModel { name: String::new(), program: String::new(), time: String::new(), parts, light: self.light(&mut tell) })
        };
        if reduced.goniogram.lamps().is_none_or(|lamps| lamps.watts <= 0.0) {
            tell("the file wants a power, and 0 W stands there for one that is not known: name the watts".into());
        }
        let parts = ProductParts { colour, spectrum, model };
        let bytes = reduced.to_gldf(&parts).map_err(|error| crate::Error::setting("gldf", error.problem))?;
        Ok((bytes, told))
    }

    /// Where light leaves: the opening as EULUMDAT has it, at its true place. Luminous heights rise from its lower end.
    fn light(&self, tell: &mut impl FnMut(String)) -> L3dLight {
        let (shape, [x, y, z]) = (self.opening.shape, self.opening.centre());
        let size = shape.size;
        let in_file = match shape.shape {
            OpeningShape::Point => L3dShape::Point,
            _ if self.opening.is_round() => L3dShape::Circle(size[0]),
            OpeningShape::Disk | OpeningShape::VerticalCylinder | OpeningShape::Ellipsoid => {
                tell("the opening is an ellipse, and a rectangle of its area in the model".into());
                L3dShape::Rectangle([0, 1].map(|k| size[k] * std::f64::consts::FRAC_PI_4.sqrt()))
            }
            _ if size[0] > 0.0 && size[1] > 0.0 => L3dShape::Rectangle([size[0], size[1]]),
            _ => {
                tell("the opening stands upright, and is a line of 1 mm in the model".into());
                L3dShape::Rectangle([size[0].max(1e-3), size[1].max(1e-3)])
            }
        };
        if in_file == L3dShape::Point {
            tell("the light leaves at a point, and from a disk of 1 mm in the model".into());
        }
        let lower = if shape.heights.iter().any(|height| *height > 0.0) { self.opening.bounds[0][2] } else { z };
        L3dLight { name: LIGHT.into(), place: Place::new([x, y, lower], [0.0; 3]), shape: in_file, heights: shape.heights }
    }
}

/// Chromaticity of what left, where it is no white.
fn chromaticity(reading: &Reading) -> Option<[f64; 2]> {
    Some(reading.escaped_rgb).filter(|rgb| colour::is_coloured(*rgb)).and_then(colour::chromaticity)
}
