//! How the road's surface sends light to a driver's eye.

mod figures;
mod material;
mod read;
mod table;

pub use material::Material;
pub use table::Table;

use crate::{results::SurfaceFigures, standard::Standard};
use std::f64::consts::PI;

/// A surface seen at 1° by a driver.
#[derive(Clone, Debug)]
pub struct Surface {
    /// What it is called: `lambert`, or its file.
    pub name: String,
    /// Its reduced luminance coefficient.
    pub kind: Kind,
    /// Its mean luminance coefficient and specular factor.
    pub figures: SurfaceFigures,
}

/// Where the reduced luminance coefficient comes from.
#[derive(Clone, Debug)]
pub enum Kind {
    /// The same luminance in all directions: q = ρ/π.
    Lambert {
        /// The share ρ of the light that is reflected.
        reflectance: f64,
    },
    /// A table by the directions of light.
    Table(Table),
    /// A measured material.
    Material(Material),
}

impl Surface {
    /// A diffuse surface; the reflectance is between 0 and 1.
    pub fn lambert(reflectance: f64) -> Self {
        Self::new("lambert", Kind::Lambert { reflectance })
    }

    /// A surface with a table.
    pub fn table(name: &str, table: Table) -> Self {
        Self::new(name, Kind::Table(table))
    }

    /// A measured surface.
    pub fn material(name: &str, material: Material) -> Self {
        Self::new(name, Kind::Material(material))
    }

    fn new(name: &str, kind: Kind) -> Self {
        let figures = figures::figures(&kind, name);
        Self { name: name.to_owned(), kind, figures }
    }

    /// The reduced luminance coefficient r = q cos³γ in 1/sr, for light from β degrees off the driver's way and tan γ off the vertical.
    pub fn reduced(&self, beta: f64, tangent: f64, standard: Standard) -> f64 {
        self.kind.reduced(beta, tangent, standard)
    }

    /// The largest tan γ for which it is known.
    pub fn farthest(&self) -> f64 {
        match &self.kind {
            Kind::Lambert { .. } | Kind::Material(_) => f64::INFINITY,
            Kind::Table(table) => table.farthest(),
        }
    }
}

impl Kind {
    fn reduced(&self, beta: f64, tangent: f64, standard: Standard) -> f64 {
        match self {
            Self::Lambert { reflectance } => reflectance / PI * (1.0 + tangent * tangent).powf(-1.5),
            Self::Table(table) => table.reduced(beta, tangent, standard),
            Self::Material(material) => material.reduced(beta, tangent),
        }
    }
}
