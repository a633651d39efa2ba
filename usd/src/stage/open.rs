//! Opening a stage: its layers, what of it is populated, and its variants.

use super::problem::{format_error, unreadable};
use super::{clips, multiplied};
use crate::memory_limit::MemoryLimit;
use crate::options::StageOptions;
use crate::prim::Prim;
use crate::pxr::{self, Module};
use crate::{material, nesting, skeleton};
use gonio::{Diagnostic, Error, Result, scene::Origin};
use pyo3::prelude::*;
use pyo3::types::PyList;
use std::collections::BTreeSet;
use std::path::Path;
use std::sync::Arc;

/// Bytes of the largest layer whose references and value clips are looked at before the stage is opened.
const MOST_SEARCHED: u64 = 4 << 20;

/// A stage with its layer for skinned points.
pub(super) struct Prepared<'py> {
    pub(super) stage: Bound<'py, PyAny>,
    pub(super) baked: Bound<'py, PyAny>,
    pub(super) documents: Option<material::Substitution>,
    pub(super) alike: Arc<skeleton::Alike>,
}

/// The stage with variants chosen and skeletons' instances taken apart, and the layer for skinned points, which is the edit target.
pub(super) fn open_prepared<'py>(
    py: Python<'py>,
    path: &Path,
    options: &StageOptions,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<Prepared<'py>> {
    let unreadable = |error: PyErr| unreadable(py, path, &error);
    let anonymous = |name: &str| Module::Sdf.item(py, "Layer")?.call_method1("CreateAnonymous", (name,));
    let session = anonymous("session.usda").map_err(unreadable)?;
    let baked = anonymous("skinned.usda").map_err(unreadable)?;
    let add = || session.getattr("subLayerPaths")?.call_method1("append", (baked.getattr("identifier")?,));
    add().map_err(unreadable)?;
    let stage = open_layers(py, path, options, &session, diagnostics)?;
    select_variants(&stage, options)?;
    expand_mask(&stage, options).map_err(unreadable)?;
    let documents = material::substitute_documents(&stage, diagnostics);
    if documents.is_some() {
        // What documents hold was not there before.
        expand_mask(&stage, options).map_err(unreadable)?;
    }
    for path in masked_nothing(&stage, options).map_err(unreadable)? {
        diagnostics.push(Diagnostic::warning(&Origin::new(&path), "the mask names a prim that is not there"));
    }
    let skeleton::Apart { apart, alike } = skeleton::take_instances_apart(&stage).map_err(unreadable)?;
    if let Some(first) = apart.first() {
        let shown = alike.iter().filter(|(instance, shown)| instance != shown).count();
        let others = if shown > 0 { format!(", {shown} more show what these are skinned to") } else { String::new() };
        diagnostics.push(Diagnostic::info(first, format!("{} instances hold skeletons and are read one by one{others}", apart.len())));
    }
    stage.call_method1("SetEditTarget", (&baked,)).map_err(unreadable)?;
    Ok(Prepared { stage, baked, documents, alike: Arc::new(alike) })
}

/// The stage, with the session layer as the edit target.
fn open_layers<'py>(
    py: Python<'py>,
    path: &Path,
    options: &StageOptions,
    session: &Bound<'py, PyAny>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<Bound<'py, PyAny>> {
    let _limit = MemoryLimit::new(py);
    detach_layers(py, options.detached).map_err(|error| unreadable(py, path, &error))?;
    let root = find_layer(py, path)?;
    // Large layers are not searched.
    if std::fs::metadata(path).is_ok_and(|found| found.len() <= MOST_SEARCHED) {
        check_references(path, &root).map_err(|error| unreadable(py, path, &error))??;
        clips::check(path, &root, diagnostics).map_err(|error| unreadable(py, path, &error))??;
        multiplied::check(path, &root).map_err(|error| unreadable(py, path, &error))??;
    }
    if let Some(layer) = &options.session_layer {
        check_file(layer)?;
        let found = find_layer(py, layer)?;
        let add = || session.getattr("subLayerPaths")?.call_method1("append", (found.getattr("identifier")?,));
        add().map_err(|error| unreadable(py, layer, &error))?;
    }
    let mask = population_mask(py, options)?;
    let open = || -> PyResult<Bound<'py, PyAny>> {
        let class = Module::Usd.item(py, "Stage")?;
        let load = class.getattr(if options.load_payloads { "LoadAll" } else { "LoadNone" })?;
        let stage = match mask {
            Some(mask) => class.call_method1("OpenMasked", (&root, session, mask, load))?,
            None => class.call_method1("Open", (&root, session, load))?,
        };
        stage.call_method1("SetEditTarget", (session,))?;
        Ok(stage)
    };
    open().map_err(|error| unreadable(py, path, &error))
}

/// Says for all layers that are opened from now on whether they are read into memory as a whole; without it binary layers stay views of their
/// files, which end the process where a file is cut short meanwhile.
fn detach_layers(py: Python<'_>, all: bool) -> PyResult<()> {
    let layer = Module::Sdf.item(py, "Layer")?;
    // Not all versions of the package have them.
    let Some(rules) = layer.getattr_opt("DetachedLayerRules")? else { return Ok(()) };
    let rules = rules.call0()?;
    let rules = if all { rules.call_method0("IncludeAll")? } else { rules };
    layer.call_method1("SetDetachedLayerRules", (rules,)).map(|_| ())
}

/// Refuses a layer that refers to pipes and devices, which opening the stage would wait for.
fn check_references(path: &Path, layer: &Bound<'_, PyAny>) -> PyResult<Result<()>> {
    for reference in layer.call_method0("GetCompositionAssetDependencies")?.try_iter()? {
        let reference = reference?;
        let place: String = layer.call_method1("ComputeAbsolutePath", (&reference,))?.extract()?;
        if std::fs::metadata(&place).is_ok_and(|found| !found.is_file() && !found.is_dir()) {
            return Ok(Err(format_error(path, format!("it refers to {reference}, a pipe or device"))));
        }
    }
    Ok(Ok(()))
}

fn find_layer<'py>(py: Python<'py>, path: &Path) -> Result<Bound<'py, PyAny>> {
    let find = || Module::Sdf.item(py, "Layer")?.call_method1("FindOrOpen", (path.to_string_lossy().as_ref(),));
    let layer = find().map_err(|error| unreadable(py, path, &error))?;
    if layer.is_none() { Err(format_error(path, "the file cannot be read as a USD layer")) } else { Ok(layer) }
}

fn population_mask<'py>(py: Python<'py>, options: &StageOptions) -> Result<Option<Bound<'py, PyAny>>> {
    if options.population_mask.is_empty() {
        return Ok(None);
    }
    let failed = |problem: String| Error::Setting { name: "mask".into(), problem };
    for path in &options.population_mask {
        let is_valid = Module::Sdf.item(py, "Path").and_then(|class| class.call_method1("IsValidPathString", (path,))?.is_truthy());
        if !path.starts_with('/') || !is_valid.unwrap_or(false) {
            return Err(failed(format!("'{path}' was found, expected a prim path such as /World/Chair")));
        }
    }
    let mask = || Module::Usd.item(py, "StagePopulationMask")?.call1((PyList::new(py, &options.population_mask)?,));
    mask().map(Some).map_err(|error| failed(pxr::message_of(py, &error)))
}

/// How often a mask is widened by what instances name, which may hold instances in turn.
const MOST_ROUNDS: usize = 16;

/// Takes into a mask what its prims refer to, as usdrecord does: bound materials, prototypes, what lights are linked to; and what is looked
/// through and followed.
fn expand_mask(stage: &Bound<'_, PyAny>, options: &StageOptions) -> PyResult<()> {
    if options.population_mask.is_empty() {
        return Ok(());
    }
    let stated: String = stage.call_method1("GetMetadata", ("renderSettingsPrimPath",))?.extract().unwrap_or_default();
    let named = [&options.camera, &options.render_settings, &options.render_pass].into_iter().flatten().cloned();
    let mask = stage.call_method0("GetPopulationMask")?;
    for path in named.chain([stated]).filter(|path| path.starts_with('/')) {
        mask.call_method1("Add", (path,))?;
    }
    stage.call_method1("SetPopulationMask", (mask,))?;
    stage.call_method0("ExpandPopulationMask")?;
    // What instances name is not asked for by the library: it sees none of their prims.
    let mut tried = BTreeSet::new();
    for _ in 0..MOST_ROUNDS {
        let missing = named_by_instances(stage)?;
        let new: Vec<&String> = missing.difference(&tried).collect();
        if new.is_empty() {
            break;
        }
        let mask = stage.call_method0("GetPopulationMask")?;
        new.iter().try_for_each(|path| mask.call_method1("Add", (path,)).map(|_| ()))?;
        stage.call_method1("SetPopulationMask", (mask,))?;
        stage.call_method0("ExpandPopulationMask")?;
        tried = missing;
    }
    Ok(())
}

/// Paths of prims outside of the mask that relationships within instances name.
fn named_by_instances(stage: &Bound<'_, PyAny>) -> PyResult<BTreeSet<String>> {
    let proxies = Module::Usd.item(stage.py(), "TraverseInstanceProxies")?.call0()?;
    let mut missing = BTreeSet::new();
    for prim in stage.call_method1("Traverse", (proxies,))?.try_iter()? {
        let prim = prim?;
        if !prim.call_method0("IsInstanceProxy")?.is_truthy()? {
            continue;
        }
        for relationship in prim.call_method0("GetRelationships")?.try_iter()? {
            for target in relationship?.call_method0("GetForwardedTargets")?.try_iter()? {
                let path: String = target?.call_method0("GetPrimPath")?.str()?.extract()?;
                if path.starts_with('/') && !Prim::new(stage.call_method1("GetPrimAtPath", (&path,))?).is_valid() {
                    missing.insert(path);
                }
            }
        }
    }
    Ok(missing)
}

/// Paths of a mask that name no prim.
fn masked_nothing(stage: &Bound<'_, PyAny>, options: &StageOptions) -> PyResult<Vec<String>> {
    let mut missing = Vec::new();
    for path in &options.population_mask {
        if !Prim::new(stage.call_method1("GetPrimAtPath", (path,))?).is_valid() {
            missing.push(path.clone());
        }
    }
    Ok(missing)
}

fn select_variants(stage: &Bound<'_, PyAny>, options: &StageOptions) -> Result<()> {
    let py = stage.py();
    for selection in &options.variants {
        let failed = |problem: String| Error::Setting { name: "variant".into(), problem };
        let names = || -> PyResult<Option<Vec<String>>> {
            let prim = Prim::new(stage.call_method1("GetPrimAtPath", (&selection.prim,))?);
            if !prim.is_valid() {
                return Ok(None);
            }
            let set = prim.object().call_method1("GetVariantSet", (&selection.set,))?;
            let names: Vec<String> = set.call_method0("GetVariantNames")?.extract()?;
            if names.contains(&selection.variant) {
                set.call_method1("SetVariantSelection", (&selection.variant,))?;
            }
            Ok(Some(names))
        };
        match names().map_err(|error| failed(pxr::message_of(py, &error)))? {
            None => return Err(failed(format!("there is no prim {}", selection.prim))),
            Some(names) if names.is_empty() => return Err(failed(format!("{} has no variant set '{}'", selection.prim, selection.set))),
            Some(names) if !names.contains(&selection.variant) => {
                let (prim, set, variant) = (&selection.prim, &selection.set, &selection.variant);
                return Err(failed(format!("{prim}{{{set}}} has no variant '{variant}'; it has {}", names.join(", "))));
            }
            Some(_) => {}
        }
    }
    Ok(())
}

/// What can be said about the file without `pxr`.
pub(super) fn check_file(path: &Path) -> Result<()> {
    let text = path.to_string_lossy();
    // Addresses of other asset systems, and files inside packages, are the resolver's business.
    if text.contains("://") || text.ends_with(']') {
        return Ok(());
    }
    let metadata = std::fs::metadata(path).map_err(|error| Error::io(path, error))?;
    if metadata.is_dir() {
        return Err(format_error(path, "a folder was found, expected a USD file"));
    }
    if !metadata.is_file() {
        return Err(format_error(path, "a pipe or device was found, expected a USD file"));
    }
    let extension = path.extension().map(|extension| extension.to_string_lossy().to_lowercase()).unwrap_or_default();
    if !matches!(extension.as_str(), "usd" | "usda" | "usdc" | "usdz") {
        return Err(format_error(path, format!("the file's ending is '{extension}', expected usd, usda, usdc or usdz")));
    }
    if metadata.len() == 0 {
        return Err(format_error(path, "the file is empty"));
    }
    match nesting::too_deep_at(path) {
        Some(line) => {
            Err(Error::Format { path: path.to_owned(), line: Some(line), problem: "brackets are nested too deep to be read".into() })
        }
        None => Ok(()),
    }
}
