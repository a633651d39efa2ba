//! Volumes of UsdVol: prims of the type `Volume`, whose relationships `field:NAME` lead to prims that name the grids of files.
//!
//! A prim is read into a [`Volume`] without its files (`read`). Where it is placed, its material says which fields count (`fill`), and their grids
//! are read, each once (`grid`).

mod curves;
mod fill;
mod flow;
mod grid;
mod placed;
mod read;

pub(crate) use fill::{Filling, fill};
pub use flow::Flows;
pub(crate) use flow::{Exposure, put as put_flows};
pub(crate) use grid::GridCache;
pub(crate) use placed::{PlacedVolume, add_all, naming};
pub(crate) use read::read;

use crate::vt::AssetPath;
use gonio::scene::Transform;

/// What stands before the names of fields.
const PREFIX: &str = "field:";

/// A volume prim as it was read.
#[derive(Clone, Debug)]
pub struct Volume {
    /// Its fields, in the order of their names; one at least.
    pub fields: Vec<Field>,
}

impl Volume {
    /// The field that says how much there is: the one of that name, or the first.
    pub fn density(&self) -> &Field {
        self.field("density").unwrap_or(&self.fields[0])
    }

    /// The field of a name.
    pub fn field(&self, name: &str) -> Option<&Field> {
        self.fields.iter().find(|field| field.name == name)
    }
}

/// A field of a volume: where its numbers are.
#[derive(Clone, Debug)]
pub struct Field {
    /// What the volume calls it.
    pub name: String,
    /// Path of its prim.
    pub path: String,
    /// The file.
    pub file: AssetPath,
    /// The grid's name; empty where the number alone counts.
    pub grid: String,
    /// Which of the grids of that name, or of all of the file.
    pub index: usize,
    /// From the file's space to that of the volume prim.
    pub to_volume: Transform,
}
