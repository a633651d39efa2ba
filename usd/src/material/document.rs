//! MaterialX documents as USD layers: `pxr` does not read `.mtlx`, so references to it are given a converted layer in memory.
//!
//! Layers on disk stay as they are; those in memory get their asset paths back when the stage has been read.

mod include;
mod text;

use crate::material::Library;
use crate::material::stage_host::standard_library;
use crate::pxr::{self, Module};
use gonio::Diagnostic;
use gonio::scene::{Origin, open_file};
use pyo3::types::{PyCFunction, PyDict, PyTuple};
use pyo3::{intern, prelude::*};
use std::collections::HashMap;
use std::io::Read;
use std::path::Path;
use std::sync::Arc;
use text::{Converted, convert};

/// Largest document that is read.
const MAX_BYTES: u64 = 64 << 20;

/// Layers that stand in for documents while the stage is in use; when it is dropped, the stage's layers get their references back.
#[derive(Debug)]
pub struct Substitution {
    changed: Vec<Py<PyAny>>,
    layers: Vec<Py<PyAny>>,
    originals: HashMap<String, String>,
    definitions: Vec<Arc<Library>>,
}

/// Converts the MaterialX documents that the stage's layers refer to, and puts them in place of the references: to be called once the stage
/// is open, before its composition errors are asked for. Documents that cannot be converted are reported by name. `None` where there are no
/// documents.
pub fn substitute_documents(stage: &Bound<'_, PyAny>, diagnostics: &mut Vec<Diagnostic>) -> Option<Substitution> {
    let mut substitution = Substitution { changed: Vec::new(), layers: Vec::new(), originals: HashMap::new(), definitions: Vec::new() };
    if let Err(error) = substitution.fill(stage, diagnostics) {
        let message = format!("documents that layers refer to cannot be used: {}", pxr::message_of(stage.py(), &error));
        diagnostics.push(Diagnostic::warning(&Origin::new("MaterialX"), message));
    }
    (!substitution.changed.is_empty()).then_some(substitution)
}

impl Substitution {
    fn fill(&mut self, stage: &Bound<'_, PyAny>, diagnostics: &mut Vec<Diagnostic>) -> PyResult<()> {
        let py = stage.py();
        for (layer, documents) in references(stage)? {
            let mut replacements = HashMap::new();
            for (authored, resolved) in documents {
                let origin = Origin { name: authored.as_str().into(), file: resolved.as_str().into() };
                let Some((stand_in, library)) = stand_in(py, Path::new(&resolved), &origin, diagnostics) else { continue };
                self.definitions.push(Arc::new(library));
                let identifier: String = stand_in.getattr(intern!(py, "identifier"))?.extract()?;
                self.originals.insert(identifier.clone(), authored.clone());
                self.layers.push(stand_in.unbind());
                replacements.insert(authored, identifier);
            }
            if !replacements.is_empty() {
                replace_paths(&layer, replacements)?;
                self.changed.push(layer.unbind());
            }
        }
        Ok(())
    }

    /// Whether a message of `pxr` is about a document that it cannot read itself, and that is in use all the same.
    pub fn explains(&self, message: &str) -> bool {
        let names = |authored: &String| Path::new(authored).file_name().is_some_and(|name| message.contains(&*name.to_string_lossy()));
        message.contains("Cannot determine file format") && self.originals.values().any(names)
    }

    /// What the documents define.
    pub fn definitions(&self) -> &[Arc<Library>] {
        &self.definitions
    }

    /// Number of documents in use.
    pub fn len(&self) -> usize {
        self.layers.len()
    }

    /// Whether no document is in use.
    pub fn is_empty(&self) -> bool {
        self.layers.is_empty()
    }
}

impl Drop for Substitution {
    fn drop(&mut self) {
        let (changed, originals) = (std::mem::take(&mut self.changed), std::mem::take(&mut self.originals));
        Python::try_attach(|py| {
            for layer in &changed {
                // A layer that cannot be changed back is only held by the stage that goes away.
                let _ = replace_paths(layer.bind(py), originals.clone());
            }
        });
    }
}

/// A layer and the documents that it refers to, authored and resolved.
type LayerDocuments<'py> = (Bound<'py, PyAny>, Vec<(String, String)>);

fn references<'py>(stage: &Bound<'py, PyAny>) -> PyResult<Vec<LayerDocuments<'py>>> {
    let py = stage.py();
    let mut found = Vec::new();
    for layer in stage.call_method0(intern!(py, "GetUsedLayers"))?.try_iter()? {
        let layer = layer?;
        let mut documents = Vec::new();
        for path in layer.call_method0(intern!(py, "GetCompositionAssetDependencies"))?.try_iter()? {
            let authored: String = path?.extract()?;
            if authored.to_ascii_lowercase().ends_with(".mtlx") {
                let resolved = layer.call_method1(intern!(py, "ComputeAbsolutePath"), (&authored,))?.extract()?;
                documents.push((authored, resolved));
            }
        }
        if !documents.is_empty() {
            found.push((layer, documents));
        }
    }
    Ok(found)
}

fn replace_paths(layer: &Bound<'_, PyAny>, replacements: HashMap<String, String>) -> PyResult<()> {
    let py = layer.py();
    let replace = move |arguments: &Bound<'_, PyTuple>, _: Option<&Bound<'_, PyDict>>| -> PyResult<String> {
        let path: String = arguments.get_item(0)?.extract()?;
        Ok(replacements.get(&path).cloned().unwrap_or(path))
    };
    let function = PyCFunction::new_closure(py, None, None, replace)?;
    Module::UsdUtils.item(py, "ModifyAssetPaths")?.call1((layer, function)).map(|_| ())
}

/// A layer in memory with a document's materials.
fn stand_in<'py>(py: Python<'py>, file: &Path, origin: &Origin, diagnostics: &mut Vec<Diagnostic>) -> Option<(Bound<'py, PyAny>, Library)> {
    let mut warn = |message: String| diagnostics.push(Diagnostic::warning(origin, message));
    let (text, library) = match read(file).and_then(|text| convert(&text, file, standard_library(py))) {
        Ok(Converted { layer, problems, library }) => {
            problems.into_iter().for_each(&mut warn);
            (layer, library)
        }
        Err(problem) => {
            warn(format!("{problem}; its materials are missing"));
            return None;
        }
    };
    let import = || -> PyResult<Bound<'py, PyAny>> {
        let layer = Module::Sdf.item(py, "Layer")?.call_method1(intern!(py, "CreateAnonymous"), ("materialx.usda",))?;
        layer.call_method1(intern!(py, "ImportFromString"), (text,))?;
        Ok(layer)
    };
    match import() {
        Ok(layer) => Some((layer, library)),
        Err(error) => {
            warn(format!("the MaterialX document cannot be converted: {}", pxr::message_of(py, &error)));
            None
        }
    }
}

fn read(path: &Path) -> Result<String, String> {
    let unreadable = |error| format!("the MaterialX document cannot be read: {error}");
    let mut file = open_file(path).map_err(unreadable)?;
    let length = file.limit();
    if length > MAX_BYTES {
        return Err(format!("the MaterialX document has {length} bytes, more than {MAX_BYTES}"));
    }
    let mut text = String::new();
    file.read_to_string(&mut text).map_err(unreadable).map(|_| text)
}
