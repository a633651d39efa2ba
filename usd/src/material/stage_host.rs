//! A stage's reader as the host of the networks that are translated for it.

use super::definition::Definition;
use super::host::Host;
use super::library::Library;
use super::neutral::{Said, Value};
use super::shaded::named_text;
use super::textures::{LATEST, resolve_text, resolve_tiles, texture_at};
use super::value::stated_colour_space;
use crate::asset;
use crate::context::Context;
use crate::vt::AssetPath;
use gonio::scene::{MeasuredBsdf, MeasuredId, Origin, TextureId};
use gonio_formats::bsdf;
use pyo3::{intern, prelude::*, sync::PyOnceLock};
use std::path::PathBuf;
use std::sync::Arc;

impl Host for Context<'_, '_> {
    fn warn(&mut self, path: &str, message: String) {
        Context::warn(self, &Origin::new(path), message);
    }

    fn once(&mut self, kind: &'static str, name: &str, path: &str, message: String) {
        Context::once(self, kind, name, &Origin::new(path), || message);
    }

    fn unsupported(&mut self, feature: &str, path: &str) {
        Context::unsupported(self, feature, &Origin::new(path));
    }

    fn metres_per_unit(&self) -> f64 {
        self.metres_per_unit
    }

    fn frame(&self) -> [f64; 2] {
        let py = self.py;
        let time = || -> PyResult<f64> {
            let is_default: bool = self.time.call_method0(intern!(py, "IsDefault"))?.extract()?;
            if is_default { Ok(1.0) } else { self.time.call_method0(intern!(py, "GetValue"))?.extract() }
        };
        let rate = || -> PyResult<f64> { self.stage.call_method0(intern!(py, "GetTimeCodesPerSecond"))?.extract() };
        let sound = |value: PyResult<f64>, otherwise: f64| value.ok().filter(|value| value.abs() < LATEST).unwrap_or(otherwise);
        [sound(time(), 1.0), sound(rate(), 24.0)]
    }

    fn texture(&mut self, path: &str, file: &AssetPath, space: &str) -> Option<TextureId> {
        texture_at(self, &Origin::new(path), &file.authored, &file.resolved, space)
    }

    fn measured(&mut self, path: &str, file: &AssetPath) -> Option<MeasuredId> {
        let key = if file.resolved.is_empty() { &file.authored } else { &file.resolved };
        if let Some(known) = self.measured_ids.get(key) {
            return *known;
        }
        let id = match asset::read(self.py, file, "measured BSDF", bsdf::read) {
            Ok(data) => Some(self.scene.add_measured(MeasuredBsdf::new(Origin::new(&file.resolved), data))),
            Err(problem) => {
                Context::warn(self, &Origin::new(path), format!("{problem}; the surface is grey"));
                None
            }
        };
        self.measured_ids.insert(key.clone(), id);
        id
    }

    fn text_of_primvar(&mut self, name: &str) -> Option<(Value, Said)> {
        let (mut value, attribute) = named_text(self, name)?;
        let mut said = Said { space: stated_colour_space(&attribute), ..Said::default() };
        match &mut value {
            Value::Asset(path) if path.resolved.is_empty() => path.resolved = resolve_tiles(&attribute, &path.authored),
            Value::Text(text) => {
                said.resolved = resolve_tiles(&attribute, text);
                if said.resolved.is_empty() {
                    said.resolved = resolve_text(&attribute, text);
                }
            }
            _ => {}
        }
        Some((value, said))
    }

    fn definition(&mut self, name: &str) -> Option<Arc<Definition>> {
        let own = self.material_definitions.iter().find_map(|library| library.definition(name));
        own.or_else(|| standard_library(self.py)?.definition(name))
    }

    fn lacks_library(&mut self) -> bool {
        standard_library(self.py).is_none()
    }
}

/// Where USD's own reader of MaterialX finds a studio's definitions.
const SEARCH_PATHS: &str = "PXR_MTLX_PLUGIN_SEARCH_PATHS";

/// MaterialX's standard library, if its package is installed, and what the search paths hold; read once.
pub(super) fn standard_library(py: Python<'_>) -> Option<&'static Library> {
    static LIBRARY: PyOnceLock<Option<Library>> = PyOnceLock::new();
    let folders = || -> Vec<PathBuf> {
        let searched = std::env::var_os(SEARCH_PATHS).unwrap_or_default();
        package_folder(py).into_iter().chain(std::env::split_paths(&searched).filter(|folder| folder.is_dir())).collect()
    };
    LIBRARY.get_or_init(py, || Library::read(&folders())).as_ref()
}

/// Where the package `MaterialX` keeps its library's documents; the package itself is not loaded.
fn package_folder(py: Python<'_>) -> Option<PathBuf> {
    let find = || -> PyResult<Option<String>> {
        let spec = py.import("importlib.util")?.call_method1("find_spec", ("MaterialX",))?;
        if spec.is_none() { Ok(None) } else { spec.getattr("origin")?.extract() }
    };
    let folder = PathBuf::from(find().ok()??).parent()?.join("libraries");
    folder.is_dir().then_some(folder)
}
