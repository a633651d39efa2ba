//! A layer over a stage that dims its lights.

use super::Stage;
use crate::options::SampleTime;
use crate::prim::Prim;
use crate::pxr::{self, Module};
use gonio::{Error, Result};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::path::Path;

/// What is multiplied.
const DIMMING: &str = "gonio:photometry:dimming";
/// What a layer says of its own place among others.
const OWN_TO_LAYERS: [&str; 4] = ["subLayers", "subLayerOffsets", "documentation", "comment"];

impl Stage {
    /// The text of a USD layer with the stage's root as its sublayer, in which `gonio:photometry:dimming` of these lights, each with its prim's path,
    /// is what it is at a time, times a factor. `output` is where the text is to stand.
    ///
    /// # Errors
    /// A light that no opinion reaches, as it is within an instance; an output that is the stage itself; what `pxr` says.
    pub fn dimmed(&self, py: Python<'_>, lights: &[(String, f64)], time: SampleTime, output: &Path) -> Result<String> {
        let problem = |text: String| Error::Setting { name: "output".into(), problem: text };
        if output.canonicalize().is_ok_and(|output| self.path.canonicalize().is_ok_and(|stage| stage == output)) {
            return Err(problem(format!("{} is the stage itself; name another file", output.display())));
        }
        let mut unreached = None;
        let written = self.written(py, lights, time, output, &mut unreached);
        match unreached {
            Some(light) => {
                Err(problem(format!("{light} is within an instance, where no layer reaches it; take instanceable off the instance")))
            }
            None => written.map_err(|error| problem(pxr::message_of(py, &error))),
        }
    }

    fn written(
        &self,
        py: Python<'_>,
        lights: &[(String, f64)],
        time: SampleTime,
        output: &Path,
        unreached: &mut Option<String>,
    ) -> PyResult<String> {
        let stage = self.object.bind(py);
        let (create, attribute) = (Module::Sdf.item(py, "CreatePrimInLayer")?, Module::Sdf.item(py, "AttributeSpec")?);
        let kind = Module::Sdf.item(py, "ValueTypeNames")?.getattr("Float")?;
        let time = self.time(py, time).map_err(|error| PyValueError::new_err(error.to_string()))?;
        let layer = Module::Sdf.item(py, "Layer")?.call_method1("CreateAnonymous", ("dimmed.usda",))?;
        copy_metadata(&stage.call_method0("GetRootLayer")?, &layer)?;
        layer.getattr("subLayerPaths")?.call_method1("append", (relative(py, &self.path, output)?,))?;
        for (path, factor) in lights {
            let prim = Prim::new(stage.call_method1("GetPrimAtPath", (path,))?);
            let is = |method: &str| prim.object().call_method0(method)?.is_truthy();
            if !prim.is_valid() || is("IsInstanceProxy")? || is("IsInPrototype")? {
                *unreached = Some(path.clone());
                return Ok(String::new());
            }
            let before = match prim.attribute(DIMMING) {
                Some(attribute) => attribute.get(&time)?.map_or(Ok(1.0), |value| value.extract::<f64>())?,
                None => 1.0,
            };
            let spec = attribute.call1((create.call1((&layer, path))?, DIMMING, &kind))?;
            spec.setattr("default", before * factor)?;
        }
        layer.call_method0("ExportToString")?.extract()
    }
}

/// What the root says of the whole stage, such as its unit and its upper axis, which sublayers have no say in.
fn copy_metadata(root: &Bound<'_, PyAny>, layer: &Bound<'_, PyAny>) -> PyResult<()> {
    let (from, to) = (root.getattr("pseudoRoot")?, layer.getattr("pseudoRoot")?);
    for key in from.call_method0("ListInfoKeys")?.try_iter()? {
        let key: String = key?.extract()?;
        if !OWN_TO_LAYERS.contains(&key.as_str()) {
            to.call_method1("SetInfo", (&key, from.call_method1("GetInfo", (&key,))?))?;
        }
    }
    Ok(())
}

/// The stage's path as seen from the output's folder; whole where there is no way, as between drives.
fn relative(py: Python<'_>, stage: &Path, output: &Path) -> PyResult<String> {
    let os = py.import("os.path")?;
    let absolute = |path: &Path| os.call_method1("abspath", (path,));
    let folder = os.call_method1("dirname", (absolute(output)?,))?;
    let whole = absolute(stage)?;
    let found = match os.call_method1("relpath", (&whole, folder)) {
        Ok(path) => format!("./{}", path.extract::<String>()?),
        Err(_) => whole.extract()?,
    };
    Ok(found.replace('\\', "/"))
}
