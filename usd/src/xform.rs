//! Local transformations at the time that is read.

use crate::context::Context;
use crate::kept::LocalTransform;
use crate::prim::Prim;
use crate::pxr::Module;
use crate::vt::FromValue;
use gonio::scene::Transform;
use pyo3::intern;
use pyo3::prelude::*;

/// Reads local transformations; `UsdGeom.XformCache` is the fastest of the ways that `pxr` has (measured: 3.5 µs a prim).
#[derive(Debug)]
pub struct Xforms<'py> {
    cache: Bound<'py, PyAny>,
}

impl<'py> Xforms<'py> {
    /// For the context's time.
    ///
    /// # Errors
    /// What `pxr` raises.
    pub fn new(context: &Context<'_, 'py>) -> PyResult<Self> {
        Ok(Self { cache: Module::UsdGeom.item(context.py, "XformCache")?.call1((&context.time,))? })
    }

    /// The prim's local transformation; `None` with a report where it cannot be read or is not finite.
    pub fn local(&self, context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> Option<LocalTransform> {
        if !prim.has_authored("xformOpOrder") {
            return Some(LocalTransform { transform: Transform::IDENTITY, resets: false });
        }
        if let Some(still) = prim.known().still_local(prim) {
            return Some(still);
        }
        let read = || -> PyResult<(Option<Transform>, bool)> {
            let pair = self.cache.call_method1(intern!(context.py, "GetLocalTransformation"), (prim.object(),))?;
            Ok((Transform::from_value(&pair.get_item(0)?), pair.get_item(1)?.is_truthy()?))
        };
        let result = read();
        let (transform, resets) = context.attempt_at(prim, "the transformation cannot be read, the prim is left out", result)?;
        match transform.filter(Transform::is_finite) {
            Some(transform) => {
                let local = LocalTransform { transform, resets };
                // Full where the place changes with time.
                let _ = prim.known().local.set(local);
                Some(local)
            }
            None => {
                context.warn(&prim.origin(), "the transformation has numbers that are not finite, the prim is left out");
                None
            }
        }
    }
}
