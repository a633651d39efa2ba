//! What of a stage stays from one reading to the next at another time: the prims with what is known of them, and shapes that time does not change.
//!
//! Composition does not depend on time, so the prims and the names of their properties are asked for once. Of their values those are kept that no
//! attribute may vary. Whether one may is asked when a stage is read again: a stage that is read once pays nothing for it.

use crate::options::{SampleTime, StageOptions};
use crate::prim::Prim;
use gonio::scene::{Curves, Mesh, Points, Transform};
use pyo3::intern;
use pyo3::prelude::*;
use std::collections::{HashMap, HashSet};
use std::sync::{Arc, OnceLock};

/// A prim that outlives a reading.
#[derive(Debug)]
pub(crate) struct KeptPrim {
    object: Py<PyAny>,
    known: Arc<Known>,
}

impl KeptPrim {
    /// The prim, for another reading.
    pub(crate) fn of(prim: &Prim<'_>) -> Self {
        Self { object: prim.object().clone().unbind(), known: prim.known().clone() }
    }

    /// The prim with what was known of it.
    pub(crate) fn prim<'py>(&self, py: Python<'py>) -> Prim<'py> {
        Prim::with(self.object.bind(py).clone(), self.known.clone())
    }
}

/// A prim's own transformation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LocalTransform {
    /// Local space to the parent's, or to the stage's where `resets`.
    pub transform: Transform,
    /// Whether the transformations of the ancestors do not count (`!resetXformStack!`).
    pub resets: bool,
}

/// What is known of a prim; each cell is filled when it is first asked for.
#[derive(Debug, Default)]
pub(crate) struct Known {
    pub(crate) authored: OnceLock<Vec<String>>,
    pub(crate) path: OnceLock<String>,
    pub(crate) type_name: OnceLock<String>,
    pub(crate) schemas: OnceLock<Vec<String>>,
    pub(crate) is_instance: OnceLock<bool>,
    /// The children that are displayed, and those that are loaded.
    pub(crate) children: [OnceLock<Vec<KeptPrim>>; 2],
    pub(crate) prototype: OnceLock<KeptPrim>,
    /// The prim of the material that is bound here.
    pub(crate) material: OnceLock<KeptPrim>,
    /// At the time of the first reading.
    pub(crate) local: OnceLock<LocalTransform>,
    /// At the time of the first reading.
    pub(crate) shape: OnceLock<KeptShape>,
    stillness: OnceLock<Stillness>,
}

impl Known {
    /// What the prim hands over where time does not change its place.
    pub(crate) fn still_local(&self, prim: &Prim<'_>) -> Option<LocalTransform> {
        self.local.get().copied().filter(|_| self.stillness(prim).place)
    }

    /// What the prim is where time does not change its shape.
    pub(crate) fn still_shape(&self, prim: &Prim<'_>) -> Option<&KeptShape> {
        self.shape.get().filter(|_| self.stillness(prim).shape)
    }

    fn stillness(&self, prim: &Prim<'_>) -> Stillness {
        *self.stillness.get_or_init(|| Stillness::of(prim).unwrap_or_default())
    }
}

/// A shape as it was read and built without anything to be told.
#[derive(Debug)]
pub(crate) enum KeptShape {
    Mesh(Mesh, MeshParts),
    Curves(Curves),
    Points(Points),
}

/// What goes with a mesh.
#[derive(Debug)]
pub(crate) struct MeshParts {
    /// Those of the slots behind the first, which is the mesh's own.
    pub(crate) subsets: Vec<KeptPrim>,
    pub(crate) has_opacity: bool,
    pub(crate) is_light: bool,
}

/// What of a prim time does not change.
#[derive(Clone, Copy, Debug, Default)]
struct Stillness {
    place: bool,
    shape: bool,
}

impl Stillness {
    fn of(prim: &Prim<'_>) -> PyResult<Self> {
        let py = prim.py();
        let mut still = Self { place: true, shape: true };
        for attribute in prim.object().call_method0(intern!(py, "GetAuthoredAttributes"))?.try_iter()? {
            let attribute = attribute?;
            if attribute.call_method0(intern!(py, "ValueMightBeTimeVarying"))?.is_truthy()? {
                let name: String = attribute.call_method0(intern!(py, "GetName"))?.extract()?;
                let is_place = name.starts_with("xformOp");
                still.place &= !is_place;
                // Visibility is asked for each time.
                still.shape &= is_place || name == "visibility";
            }
        }
        // Points with velocities move without samples.
        still.shape &= !["velocities", "accelerations"].iter().any(|name| prim.has_authored(name));
        if prim.type_name() == "Mesh" {
            let subsets = prim.displayed_children().filter(|child| child.type_name() == "GeomSubset");
            still.shape &= subsets.map(|subset| Self::of(&subset)).collect::<PyResult<Vec<_>>>()?.iter().all(|subset| subset.shape);
        }
        Ok(still)
    }
}

/// What a reading leaves for the next.
#[derive(Debug, Default)]
pub(crate) struct Kept {
    /// What it was read with; none where nothing is kept.
    options: Option<StageOptions>,
    /// Paths of prims whose meshes are skinned, which writes over them for each reading, and has the stage composed anew.
    skinned: HashSet<String>,
    /// How many shapes were taken over from other readings.
    pub(crate) shapes: usize,
    roots: HashMap<String, KeptPrim>,
    /// Quadrics of this reading and of the last, by their keys.
    quadrics: [HashMap<String, Mesh>; 2],
}

impl Kept {
    /// For a reading with options; takes over what one with the same options left. Default values are other values than those at a time.
    pub(crate) fn for_reading(last: Option<Self>, options: &StageOptions, skinned: &[String]) -> Self {
        let skinned = skinned.iter().cloned().collect();
        let time = if options.time == SampleTime::Default { SampleTime::Default } else { SampleTime::Start };
        let options = Some(StageOptions { time, ..options.clone() });
        match last {
            Some(Self { options: known, roots, quadrics: [quadrics, _], .. }) if known == options => {
                Self { options, skinned, shapes: 0, roots, quadrics: [HashMap::new(), quadrics] }
            }
            _ => Self { options, skinned, ..Self::default() },
        }
    }

    /// Whether anything is kept.
    pub(crate) fn is_on(&self) -> bool {
        self.options.is_some()
    }

    /// The prim from which a walk starts, by a name of its own.
    pub(crate) fn root<'py>(&self, py: Python<'py>, name: &str) -> Option<Prim<'py>> {
        self.roots.get(name).map(|root| root.prim(py)).filter(|root| self.is_there(root))
    }

    /// Keeps the prim from which a walk starts.
    pub(crate) fn keep_root(&mut self, name: &str, root: &Prim<'_>) {
        if self.is_on() {
            self.roots.insert(name.to_owned(), KeptPrim::of(root));
        }
    }

    /// Whether a kept prim is still one of the stage's.
    pub(crate) fn is_there(&self, prim: &Prim<'_>) -> bool {
        self.skinned.is_empty() || prim.is_valid()
    }

    /// Whether what is below a prim is written over for each reading.
    pub(crate) fn is_skinned(&self, prim: &Prim<'_>) -> bool {
        !self.skinned.is_empty() && self.skinned.contains(&prim.path())
    }

    /// The mesh of a quadric that the last reading had.
    pub(crate) fn quadric(&self, key: &str) -> Option<&Mesh> {
        self.quadrics.iter().find_map(|known| known.get(key))
    }

    /// Keeps the mesh of a quadric.
    pub(crate) fn keep_quadric(&mut self, key: &str, mesh: &Mesh) {
        if self.is_on() {
            self.quadrics[0].insert(key.to_owned(), mesh.clone());
        }
    }
}
