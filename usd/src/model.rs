//! What the traversal makes of a part of a stage: a list of elements in the part's own frame, which groups place many times.
//!
//! The world is a model, and so is each prototype of native instances and of point instancers: read once, placed often.

use crate::options::Purpose;
use crate::volume::Volume;
use gonio::scene::{Geometry, MaterialId, MeshId, Transform};
use std::cell::OnceCell;
use std::rc::Rc;

/// A named value that things inherit from the prims above them or from their placement.
#[derive(Clone, Debug, PartialEq)]
pub struct Inherited {
    /// The name without prefix.
    pub name: String,
    /// Floats a value, 1 to 4.
    pub components: usize,
    /// One value, or one a placement.
    pub values: Rc<[f32]>,
    /// Whether there is one value a placement.
    pub is_varying: bool,
}

/// Materials that are filled in when they are known.
pub type Slots = Rc<OnceCell<Vec<MaterialId>>>;

/// A mesh, curves or points with their materials.
#[derive(Clone, Debug)]
pub struct Shape {
    /// What is shown.
    pub geometry: Geometry,
    /// The material of each slot, known when the whole stage has been walked; empty where no binding is authored at or above the prim.
    pub slots: Slots,
    /// The prim that each slot's binding is looked up at: the mesh, then its subsets. Empty where no binding counts.
    pub slot_prims: Vec<String>,
    /// Whether it has displayOpacity itself.
    pub has_opacity: bool,
    /// Whether MeshLightAPI or its like makes it a light.
    pub is_light: bool,
}

/// A model placed once or many times.
#[derive(Clone, Debug)]
pub struct Group {
    /// What is placed.
    pub model: Rc<Model>,
    /// From the model's frame to that of the element.
    pub transforms: Vec<Transform>,
    /// Values of the placements.
    pub primvars: Vec<Inherited>,
    /// For native instances, the prim that stands for the model's root; material bindings from there count inside.
    pub instance: Option<String>,
}

/// What an element is.
#[derive(Clone, Debug)]
pub enum Kind {
    /// A surface.
    Shape(Shape),
    /// A light prim.
    Light,
    /// A camera prim.
    Camera,
    /// A prim at which light is measured, with its surface if it is one.
    Measured(Option<MeshId>),
    /// A volume with its fields.
    Volume(Rc<Volume>),
    /// Other models.
    Group(Group),
}

/// Something that is placed with its model.
#[derive(Clone, Debug)]
pub struct Element {
    /// Path of the prim.
    pub path: String,
    /// What it is.
    pub kind: Kind,
    /// Local space to the model's frame, in stage units; to the stage's where `is_detached`.
    pub to_model: Transform,
    /// Whether a reset of the transformation stack takes the element out of the model's frame.
    pub is_detached: bool,
    /// Purpose authored inside the model; otherwise the placement's counts.
    pub purpose: Option<Purpose>,
    /// Values from the prims above, nearest first.
    pub primvars: Rc<[Inherited]>,
    /// Whether a material binding may be authored at or above the prim, inside the model.
    pub is_bound: bool,
}

/// A part of a stage.
#[derive(Clone, Debug, Default)]
pub struct Model {
    /// Path of its root prim.
    pub root: String,
    /// What is in it.
    pub elements: Vec<Element>,
}
