//! Calculation grids that are asked for from outside.

use super::Stage;
use crate::prim::Prim;
use crate::pxr::{self, Module};
use gonio::{Error, Result};
use pyo3::prelude::*;

impl Stage {
    /// Makes a prim a calculation grid, in the session layer; lengths are spacing, margin and height in metres. What is not given stays as the prim has it.
    ///
    /// # Errors
    /// There is no such prim, or its attributes cannot be written.
    pub fn author_grid(&self, py: Python<'_>, prim: &str, quantity: Option<&str>, lengths: [Option<f64>; 3]) -> Result<()> {
        let problem = |text: String| Error::Setting { name: "grid".into(), problem: text };
        let author = || -> PyResult<bool> {
            let stage = self.object.bind(py);
            let found = Prim::new(stage.call_method1("GetPrimAtPath", (prim,))?);
            if !found.is_valid() {
                return Ok(false);
            }
            let types = Module::Sdf.item(py, "ValueTypeNames")?;
            let set = |name: &str, kind: &str, value: Bound<'_, PyAny>| -> PyResult<()> {
                let attribute = found.object().call_method1("CreateAttribute", (format!("gonio:grid:{name}"), types.getattr(kind)?))?;
                attribute.call_method1("Set", (value,)).map(drop)
            };
            // The quantity alone makes a prim a grid.
            let own = found.has_authored("gonio:grid:quantity");
            if let Some(quantity) = quantity.or((!own).then_some("illuminance")) {
                set("quantity", "Token", quantity.into_pyobject(py)?.into_any())?;
            }
            for (name, length) in ["spacing", "margin", "height"].into_iter().zip(lengths) {
                if let Some(length) = length {
                    set(name, "Double", (length / self.info.metres_per_unit).into_pyobject(py)?.into_any())?;
                }
            }
            Ok(true)
        };
        // Opinions go where a reading does not clear them.
        let stage = self.object.bind(py);
        let edit = |layer: Bound<'_, PyAny>| stage.call_method1("SetEditTarget", (layer,)).map(drop);
        let target = |name: &str| stage.call_method0(name);
        self.forget();
        let written = target("GetSessionLayer").and_then(edit).and_then(|()| author());
        let restored = edit(self.baked.bind(py).clone().into_any());
        match written.and_then(|found| restored.map(|()| found)) {
            Ok(true) => Ok(()),
            Ok(false) => Err(problem(format!("there is no prim {prim}"))),
            Err(error) => Err(problem(pxr::message_of(py, &error))),
        }
    }
}
