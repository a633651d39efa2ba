//! Connections that lead nowhere.

use crate::pxr::Module;
use pyo3::{intern, prelude::*};
use std::collections::HashSet;

/// Where a connection leads that ends at nothing or in a circle, and that it does, followed through the interfaces of graphs and materials.
pub(super) fn dangling(attribute: &Bound<'_, PyAny>) -> PyResult<Option<String>> {
    let py = attribute.py();
    let mut attribute = attribute.clone();
    let mut passed = HashSet::new();
    loop {
        let here: String = attribute.call_method0(intern!(py, "GetPath"))?.str()?.extract()?;
        if passed.contains(&here) {
            return Ok(Some(format!("<{here}>, which leads back to itself")));
        }
        passed.insert(here);
        let found = Module::UsdShade.item(py, "ConnectableAPI")?.call_method1(intern!(py, "GetConnectedSources"), (&attribute,))?;
        if let Some(path) = found.get_item(1)?.try_iter()?.next() {
            return Ok(Some(format!("<{}>, which is not there", path?.str()?)));
        }
        let Some(source) = found.get_item(0)?.try_iter()?.next().transpose()? else { return Ok(None) };
        let name: String = source.getattr(intern!(py, "sourceName"))?.extract()?;
        let graph = source.getattr(intern!(py, "source"))?;
        let input = graph.call_method1(intern!(py, "GetInput"), (&name,))?;
        let port = if input.is_truthy()? { input } else { graph.call_method1(intern!(py, "GetOutput"), (&name,))? };
        attribute = port.call_method0(intern!(py, "GetAttr"))?;
        if !attribute.is_truthy()? {
            return Ok(None);
        }
    }
}
