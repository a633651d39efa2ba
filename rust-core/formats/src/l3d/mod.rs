//! L3D: the model of a luminaire, an archive of OBJ meshes and of how they hang together (`structure.xml`,
//! <https://github.com/globallightingdata/l3d>). Lengths are metres; the luminaire's frame is that of its photometry, nadir at −Z.

mod place;
mod read;
mod write;

use crate::archive::Archive;
use crate::error::{FormatError, Result};
use crate::photometry::text::{number, quote};
use crate::polygons::{self, Polygons};

pub use place::Place;
pub use write::{NewModel, NewPart};

/// The name of the file of an archive that holds the structure.
const STRUCTURE: &str = "structure.xml";

/// A turn below this, as the sine of its angle, is rounding.
const TURNED: f64 = 1e-4;

/// A model with its archive. Meshes are read when they are asked for.
#[derive(Debug)]
pub struct L3d<'a> {
    archive: Archive<'a>,
    /// The model's name; often empty.
    pub name: String,
    /// The files of meshes.
    pub meshes: Vec<L3dMesh>,
    /// Meshes at their places.
    pub parts: Vec<L3dPart>,
    /// What shines.
    pub lights: Vec<L3dLight>,
    /// What is doubtful, with the file inside the archive and its line.
    pub warnings: Vec<FormatError>,
}

/// A file of a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct L3dMesh {
    /// Its path in the archive.
    pub path: String,
    /// Metres in its unit.
    pub metres: f64,
}

/// A mesh at a place.
#[derive(Clone, Debug, PartialEq)]
pub struct L3dPart {
    /// Its name.
    pub name: String,
    /// Its place in [`L3d::meshes`].
    pub mesh: usize,
    /// From the mesh's metres to the luminaire's.
    pub place: Place,
    /// Faces that shine.
    pub shining: Vec<ShiningFaces>,
}

/// Faces of a part that belong to a light.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ShiningFaces {
    /// The light emitting object's name.
    pub light: String,
    /// Which of the mesh's groups the faces are counted in, if any.
    pub group: Option<u32>,
    /// The first and the last face, from 0.
    pub faces: [u32; 2],
}

/// A light emitting object: where a photometry has its place.
#[derive(Clone, Debug, PartialEq)]
pub struct L3dLight {
    /// Its name.
    pub name: String,
    /// From the photometry's frame to the luminaire's.
    pub place: Place,
    /// Its shape, in its own plane z = 0.
    pub shape: L3dShape,
    /// Luminous heights towards C0, C90, C180 and C270 in metres.
    pub heights: [f64; 4],
}

/// The shape of a light emitting object, in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum L3dShape {
    /// None is stated.
    Point,
    /// A disk of a diameter.
    Circle(f64),
    /// A rectangle along x and y.
    Rectangle([f64; 2]),
}

impl L3d<'_> {
    /// A mesh, as its file has it: in the file's unit.
    ///
    /// # Errors
    /// What is wrong with the file, with its name inside the archive.
    pub fn polygons(&self, mesh: &L3dMesh) -> Result<Polygons> {
        let bytes = self.archive.read(&mesh.path)?;
        polygons::read(&bytes).map_err(|error| crate::archive::inside(&mesh.path, &error))
    }

    /// Of light emitting objects by their names: which are missing, and which are turned from the luminaire's frame.
    pub(crate) fn problems_of(&self, names: &[&str]) -> Vec<FormatError> {
        /// Of more nobody wants to read.
        const MOST: usize = 8;
        let problem = |name: &&str| match self.lights.iter().find(|light| light.name == **name) {
            None => Some(format!("the model has no light emitting object {}", quote(name))),
            Some(light) if light.place.turn() > TURNED => {
                Some(format!("the model turns light emitting object {}: {}; the light stays as measured", quote(name), turn(&light.place)))
            }
            Some(_) => None,
        };
        let mut problems: Vec<String> = Vec::new();
        for found in names.iter().take(1000).filter_map(problem) {
            if problems.len() < MOST && !problems.contains(&found) {
                problems.push(found);
            }
        }
        problems.into_iter().map(FormatError::whole).collect()
    }
}

/// Where a light points that a place turns.
fn turn(place: &Place) -> String {
    let rounded = |x: f64| number((x * 1e3).round() / 1e3);
    let down = place.direction([0.0, 0.0, -1.0]);
    if down[2] < TURNED - 1.0 {
        let [x, y, _] = place.direction([1.0, 0.0, 0.0]);
        return format!("its C0 is at C{}", rounded(y.atan2(x).to_degrees().rem_euclid(360.0)));
    }
    format!("its nadir points along ({})", down.map(rounded).join(", "))
}
