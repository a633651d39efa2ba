//! What prim types mean to the traversal.

use super::Walker;
use crate::prim::Prim;
use crate::pxr::Module;
use crate::{curves, light, light_filter, quadrics};
use pyo3::prelude::*;

/// What a prim type means to the traversal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PrimKind {
    Container,
    Mesh,
    /// A NURBS patch.
    Patch,
    Tetrahedra,
    Quadric,
    /// Curves of any kind.
    Curves,
    Points,
    Volume,
    Instancer,
    Light,
    Camera,
    /// Neither it nor what is below it can be seen.
    Leaf,
    /// A surface that gonio does not have.
    Unsupported,
}

impl PrimKind {
    /// Whether prims of the kind are surfaces, or would be.
    pub(super) fn is_surface(self) -> bool {
        matches!(self, Self::Mesh | Self::Patch | Self::Tetrahedra | Self::Quadric | Self::Curves | Self::Points | Self::Unsupported)
    }
}

impl<'py> Walker<'_, '_, 'py> {
    /// The kind of a prim; what is unsupported is reported.
    pub(super) fn kind(&mut self, type_name: &str, prim: &Prim<'py>) -> PrimKind {
        if let Some(kind) = self.kinds.get(type_name) {
            let kind = *kind;
            if kind == PrimKind::Unsupported {
                self.context.unsupported(type_name, &prim.origin());
            }
            return kind;
        }
        let kind = self.classify(type_name, prim);
        self.kinds.insert(type_name.to_owned(), kind);
        kind
    }

    fn classify(&mut self, type_name: &str, prim: &Prim<'py>) -> PrimKind {
        match type_name {
            "" | "Xform" | "Scope" | "SkelRoot" => PrimKind::Container,
            "Mesh" => PrimKind::Mesh,
            "NurbsPatch" => PrimKind::Patch,
            "TetMesh" => PrimKind::Tetrahedra,
            "Points" => PrimKind::Points,
            "Volume" => PrimKind::Volume,
            "PointInstancer" => PrimKind::Instancer,
            "Camera" => PrimKind::Camera,
            "Material" | "Shader" | "NodeGraph" | "GeomSubset" | "Skeleton" | "SkelAnimation" | "BlendShape" | "RenderSettings"
            | "RenderProduct" | "RenderVar" | "RenderPass" => PrimKind::Leaf,
            curves if curves::is_curves(curves) => PrimKind::Curves,
            quadric if quadrics::is_quadric(quadric) => PrimKind::Quadric,
            light if light::is_light(light) => PrimKind::Light,
            filter if light_filter::is_filter(filter) => PrimKind::Leaf,
            other => self.classify_by_schema(other, prim),
        }
    }

    fn classify_by_schema(&mut self, type_name: &str, prim: &Prim<'py>) -> PrimKind {
        let py = self.context.py;
        let is_gprim = Module::UsdGeom.item(py, "Gprim").is_ok_and(|class| prim.is_a(&class));
        let is_particle_field = type_name.starts_with("ParticleField");
        if is_gprim || is_particle_field {
            self.context.unsupported(type_name, &prim.origin());
            return PrimKind::Unsupported;
        }
        let is_known = || Module::Usd.item(py, "SchemaRegistry")?.call0()?.call_method1("IsConcrete", (type_name,))?.is_truthy();
        if !is_known().unwrap_or(true) {
            let message = || format!("the prim type '{type_name}' is unknown; only the prims below it are read");
            self.context.once("type", type_name, &prim.origin(), message);
        }
        PrimKind::Container
    }
}
