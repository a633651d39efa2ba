//! Sphere, Cube, Cylinder, Cone, Capsule and Plane prims as meshes; equal ones share a mesh.

use crate::build::{MeshSource, Surface};
use crate::context::Context;
use crate::options::Complexity;
use crate::prim::Prim;
use gonio::mesh::PolygonMesh;
use gonio::mesh::quadrics::{Axis, capsule, cone, cube, cylinder, plane, sphere};
use gonio::scene::Origin;

/// A shape, and whether its inside is its front.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Oriented {
    /// The shape.
    pub quadric: Quadric,
    /// `orientation` is `leftHanded`.
    pub left_handed: bool,
}

/// A shape with its sizes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Quadric {
    /// About the origin.
    Sphere {
        /** Local units. */
        radius: f32,
    },
    /// About the origin.
    Cube {
        /** Edge length. */
        size: f32,
    },
    /// Closed by flat caps.
    Cylinder {
        /** Along the axis. */
        height: f32,
        /** At the bottom and the top. */
        radii: [f32; 2],
        /** Along which it stands. */
        axis: Axis,
    },
    /// The tip up.
    Cone {
        /** Along the axis. */
        height: f32,
        /** Of the base. */
        radius: f32,
        /** Along which it stands. */
        axis: Axis,
    },
    /// A cylinder between half spheres.
    Capsule {
        /** Between the half spheres. */
        height: f32,
        /** At the bottom and the top. */
        radii: [f32; 2],
        /** Along which it stands. */
        axis: Axis,
    },
    /// A rectangle.
    Plane {
        /** Across. */
        width: f32,
        /** Along. */
        length: f32,
        /** The normal. */
        axis: Axis,
    },
}

/// Whether prims of this type are quadrics.
pub fn is_quadric(type_name: &str) -> bool {
    matches!(type_name, "Sphere" | "Cube" | "Cylinder" | "Cylinder_1" | "Cone" | "Capsule" | "Capsule_1" | "Plane")
}

/// Reads the shape of a prim; `None`, with a report, where a size is not finite.
pub fn read<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, type_name: &str) -> Option<Oriented> {
    let mut size = |name: &str, otherwise: f32| {
        let found = context.get_or::<f64>(prim, name, f64::from(otherwise)) as f32;
        if !found.is_finite() {
            context.warn(&prim.origin(), format!("{name} is {found}, expected a finite length; the shape is left out"));
        } else if found < 0.0 {
            context.warn(&prim.origin(), format!("{name} is {found}, expected no negative length; its absolute value is taken"));
        }
        found.abs()
    };
    let quadric = match type_name {
        "Sphere" => Quadric::Sphere { radius: size("radius", 1.0) },
        "Cube" => Quadric::Cube { size: size("size", 2.0) },
        "Cylinder" => Quadric::Cylinder { height: size("height", 2.0), radii: [size("radius", 1.0); 2], axis: Axis::Z },
        "Cylinder_1" => {
            Quadric::Cylinder { height: size("height", 2.0), radii: [size("radiusBottom", 1.0), size("radiusTop", 1.0)], axis: Axis::Z }
        }
        "Cone" => Quadric::Cone { height: size("height", 2.0), radius: size("radius", 1.0), axis: Axis::Z },
        "Capsule" => Quadric::Capsule { height: size("height", 1.0), radii: [size("radius", 0.5); 2], axis: Axis::Z },
        "Capsule_1" => {
            Quadric::Capsule { height: size("height", 1.0), radii: [size("radiusBottom", 0.5), size("radiusTop", 0.5)], axis: Axis::Z }
        }
        _ => Quadric::Plane { width: size("width", 2.0), length: size("length", 2.0), axis: Axis::Z },
    };
    let quadric = quadric.standing_on(axis(context, prim));
    let left_handed = context.left_handed(prim);
    quadric.is_finite().then_some(Oriented { quadric, left_handed })
}

fn axis<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> Axis {
    match context.get_authored::<String>(prim, "axis").as_deref() {
        Some("X") => Axis::X,
        Some("Y") => Axis::Y,
        _ => Axis::Z,
    }
}

impl Oriented {
    /// A key that equal shapes share.
    pub fn key(&self) -> String {
        format!("{self:?}")
    }

    /// The polygons, with exact normals on the front.
    pub fn source(&self, origin: Origin, complexity: Complexity) -> MeshSource {
        let mut polygons = self.quadric.polygons(segments(complexity));
        polygons.left_handed = self.left_handed;
        if self.left_handed {
            let normals = polygons.primvars.iter_mut().filter(|primvar| primvar.name == "normals");
            normals.flat_map(|primvar| &mut primvar.values).for_each(|value| *value = -*value);
        }
        MeshSource { origin, polygons, surface: Surface::Polygons, face_slots: None }
    }
}

impl Quadric {
    fn standing_on(mut self, stand: Axis) -> Self {
        match &mut self {
            Self::Cylinder { axis, .. } | Self::Cone { axis, .. } | Self::Capsule { axis, .. } | Self::Plane { axis, .. } => *axis = stand,
            Self::Sphere { .. } | Self::Cube { .. } => {}
        }
        self
    }

    fn is_finite(&self) -> bool {
        match *self {
            Self::Sphere { radius } => radius.is_finite(),
            Self::Cube { size } => size.is_finite(),
            Self::Cylinder { height, radii: [a, b], .. } | Self::Capsule { height, radii: [a, b], .. } => (height + a + b).is_finite(),
            Self::Cone { height, radius, .. } => (height + radius).is_finite(),
            Self::Plane { width, length, .. } => (width + length).is_finite(),
        }
    }

    fn polygons(&self, segments: u32) -> PolygonMesh {
        match *self {
            Self::Sphere { radius } => sphere(radius, segments),
            Self::Cube { size } => cube(size),
            Self::Cylinder { height, radii: [bottom, top], axis } => cylinder(height, bottom, top, axis, segments),
            Self::Cone { height, radius, axis } => cone(height, radius, axis, segments),
            Self::Capsule { height, radii: [bottom, top], axis } => capsule(height, bottom, top, axis, segments),
            Self::Plane { width, length, axis } => plane(width, length, axis),
        }
    }
}

/// Faces around an axis.
fn segments(complexity: Complexity) -> u32 {
    match complexity {
        Complexity::Low => 32,
        Complexity::Medium => 64,
        Complexity::High | Complexity::Auto => 96,
        Complexity::VeryHigh => 192,
    }
}
