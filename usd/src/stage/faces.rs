//! A mesh's own faces, for layers that put values onto them.

use super::Stage;
use crate::pxr::Module;
use crate::vt::FromValue;
use gonio::map::FaceTable;
use pyo3::prelude::*;

impl Stage {
    /// The faces of a prim that is a mesh and may be written over; at a time, else the earliest.
    pub fn faces(&self, py: Python<'_>, prim: &str, time: Option<f64>) -> Option<FaceTable> {
        self.read_faces(py, prim, time).ok().flatten()
    }

    fn read_faces(&self, py: Python<'_>, prim: &str, time: Option<f64>) -> PyResult<Option<FaceTable>> {
        let found = self.object.bind(py).call_method1("GetPrimAtPath", (prim,))?;
        let is = |question: &str| found.call_method0(question)?.is_truthy();
        // What instances share cannot be written over.
        if !is("IsValid")? || is("IsInstanceProxy")? || found.call_method0("GetTypeName")?.extract::<String>()? != "Mesh" {
            return Ok(None);
        }
        let code = Module::Usd.item(py, "TimeCode")?;
        let code = match time {
            Some(time) => code.call1((time,))?,
            None => code.call_method0("EarliestTime")?,
        };
        let value = |name: &str| found.call_method1("GetAttribute", (name,))?.call_method1("Get", (&code,));
        let whole = |name: &str| -> PyResult<Option<Vec<u32>>> {
            let numbers: Option<Vec<i32>> = FromValue::from_value(&value(name)?);
            Ok(numbers.map(|numbers| numbers.into_iter().map(|number| number.max(0) as u32).collect()))
        };
        let (Some(counts), Some(indices)) = (whole("faceVertexCounts")?, whole("faceVertexIndices")?) else { return Ok(None) };
        let points = value("points")?.len().unwrap_or(0);
        Ok(Some(FaceTable { counts, indices, points }))
    }
}
