//! Where prims stand that are asked for from outside.

use super::{Stage, time_code, unreadable};
use crate::options::SampleTime;
use crate::prim::Prim;
use crate::pxr::Module;
use crate::vt::FromValue;
use gonio::scene::Transform;
use gonio::{Error, Result};
use pyo3::prelude::*;

impl Stage {
    /// A prim's local space in the world, in metres, at a time. `option` is what has named the prim.
    ///
    /// # Errors
    /// There is no such prim, it is part of an instance, or its transformation cannot be had.
    pub fn placed(&self, py: Python<'_>, prim: &str, time: SampleTime, option: &str) -> Result<Transform> {
        let failed = |problem: String| Error::setting(option, problem);
        let find = || self.object.bind(py).call_method1("GetPrimAtPath", (prim,));
        let found = find().map(Prim::new).ok().filter(|found| prim.starts_with('/') && found.is_valid());
        let found = found.ok_or_else(|| failed(format!("there is no prim {prim}")))?;
        let read = || -> PyResult<(bool, Option<Transform>)> {
            let in_instance = found.object().call_method0("IsInstanceProxy")?.is_truthy()?;
            let time = time_code(py, self.info.time_range, time)?;
            let cache = Module::UsdGeom.item(py, "XformCache")?.call1((time,))?;
            let matrix = cache.call_method1("GetLocalToWorldTransform", (found.object(),))?;
            Ok((in_instance, Transform::from_value(&matrix)))
        };
        let (in_instance, local) = read().map_err(|error| unreadable(py, &self.path, &error))?;
        if in_instance {
            return Err(failed(format!("{prim} is part of an instance; name the prim that is the instance")));
        }
        let local = local.filter(Transform::is_finite).ok_or_else(|| failed(format!("the transformation of {prim} is not finite")))?;
        Ok(Transform::scale(self.info.metres_per_unit).after(&local))
    }
}
