//! What a prim of a stage has become, and why, in words.

mod binding;
mod shape;

use crate::context::Context;
use crate::options::{Purpose, StageOptions};
use crate::prim::Prim;
use crate::stage::{Loaded, Stage};
use crate::{render_pass, settings};
use gonio::{Error, Result};
use pyo3::prelude::*;
use std::sync::atomic::AtomicBool;

/// A line for everything that decided what became of the prim at `path`; `loaded` is the stage read with the same options.
///
/// # Errors
/// There is no such prim; the message tells how far the path goes.
pub fn explain(py: Python<'_>, stage: &Stage, options: &StageOptions, loaded: &Loaded, path: &str) -> Result<Vec<String>> {
    let cancel = AtomicBool::new(false);
    let time = stage.time(py, options.time)?;
    let mut context = Context::new(stage.object(py).clone(), time.clone(), options, &cancel);
    let pass = options.render_pass.as_deref().map(|path| render_pass::read(&mut context, path)).transpose()?.unwrap_or_default();
    let of_settings = options.render_settings.as_deref().or(pass.source.as_deref());
    let settings = settings::render_settings(&mut context, of_settings)?;
    let options = options.with_settings(settings.as_ref());
    let mut context = Context::new(stage.object(py).clone(), time, &options, &cancel);
    context.roles = pass.roles;
    let prim = context.prim_at(path).ok_or_else(|| absent(&context, path))?;
    let above = lineage(&prim);
    let mut lines = vec![heading(&prim)];
    lines.extend(visibility(&mut context, &above));
    lines.extend(purpose(&mut context, &above));
    lines.extend(role(&context, &prim));
    lines.extend(shape::lines(&mut context, loaded, &prim));
    lines.extend(binding::lines(&mut context, loaded, &prim));
    lines.extend(links(&prim));
    let below = format!("{path}/");
    let is_about = |name: &str| name == path || name.starts_with(&below) || name.starts_with(&format!("{path}."));
    lines.extend(loaded.diagnostics.iter().filter(|found| is_about(&found.origin.name)).map(|found| format!("told: {found}")));
    Ok(lines)
}

/// The prim and all above it, the nearest first.
fn lineage<'py>(prim: &Prim<'py>) -> Vec<Prim<'py>> {
    let mut all = vec![Prim::new(prim.object().clone())];
    while let Some(parent) = all.last().and_then(Prim::parent).filter(|parent| parent.path() != "/") {
        all.push(parent);
    }
    all
}

fn absent(context: &Context<'_, '_>, path: &str) -> Error {
    let mut known = path;
    let place = loop {
        known = known.rfind('/').map_or("", |at| &known[..at]);
        if known.is_empty() {
            break "/".to_owned();
        }
        if context.prim_at(known).is_some() {
            break known.to_owned();
        }
    };
    let object = context.stage.call_method1("GetPrimAtPath", (&place,));
    let names = object.and_then(|prim| prim.call_method0("GetAllChildrenNames")?.extract::<Vec<String>>()).unwrap_or_default();
    let names = if names.is_empty() { "nothing".to_owned() } else { names.join(", ") };
    Error::setting("explain", format!("there is no prim '{path}' in what is read of the stage; below {place} there is {names}"))
}

fn heading(prim: &Prim<'_>) -> String {
    let is = |method: &str| prim.object().call_method0(method).and_then(|flag| flag.is_truthy()).unwrap_or(false);
    let type_name = prim.type_name();
    let mut line = format!("{}: {}", prim.path(), if type_name.is_empty() { "no type" } else { &type_name });
    let schemas = prim.applied_schemas();
    if !schemas.is_empty() {
        line += &format!(" with {}", schemas.join(", "));
    }
    for (is_so, words) in [
        (!is("IsActive"), "inactive: left out"),
        (is("IsActive") && !is("IsLoaded"), "its payload is not loaded: left out"),
        (is("IsAbstract"), "a class: left out, but for what takes from it"),
        (!is("IsDefined"), "only an 'over', nothing defines it: left out"),
        (is("IsInstance"), "an instance of a prototype"),
        (is("IsInstanceProxy"), "inside an instance: its prototype is read once for all"),
    ] {
        if is_so {
            line += &format!("; {words}");
        }
    }
    line
}

fn visibility<'py>(context: &mut Context<'_, 'py>, above: &[Prim<'py>]) -> Vec<String> {
    for prim in above {
        if context.get_authored::<String>(prim, "visibility").is_some_and(|token| token == "invisible") {
            return vec![format!("visibility: invisible, by {}: left out with all below it", prim.path())];
        }
    }
    vec!["visibility: visible".to_owned()]
}

fn purpose<'py>(context: &mut Context<'_, 'py>, above: &[Prim<'py>]) -> Vec<String> {
    let mut found = (Purpose::Default, "nothing says otherwise".to_owned());
    for prim in above {
        if let Some(purpose) = context.get_authored::<String>(prim, "purpose").and_then(|token| Purpose::from_token(&token)) {
            found = (purpose, format!("by {}", prim.path()));
            break;
        }
    }
    let is_shown = if context.options.shows(found.0) { "shown" } else { "not among those shown: left out" };
    let name = format!("{:?}", found.0).to_lowercase();
    vec![format!("purpose: {name} ({}), {is_shown}", found.1)]
}

fn role(context: &Context<'_, '_>, prim: &Prim<'_>) -> Vec<String> {
    if context.roles.are_plain() {
        return Vec::new();
    }
    let path = prim.path();
    let role = context.roles.role(&path);
    let words = match (context.roles.prunes(&path), role.rendered, role.camera, role.matte) {
        (true, ..) => "pruned",
        (_, false, ..) => "not in renderVisibility: left out",
        (_, _, false, true) => "matte, and unseen by the camera",
        (_, _, false, false) => "unseen by the camera, seen in mirrors and shadows",
        (_, _, true, true) => "matte: it cuts a hole into what the camera sees",
        _ => "as it is",
    };
    vec![format!("render pass: {words}")]
}

/// What is linked to a light, or filters it.
fn links(prim: &Prim<'_>) -> Vec<String> {
    let mut lines = Vec::new();
    for collection in ["lightLink", "shadowLink", "filterLink"] {
        for list in ["includes", "excludes"] {
            let name = format!("collection:{collection}:{list}");
            let targets = if prim.has_authored(&name) { prim.targets(&name) } else { Vec::new() };
            if !targets.is_empty() {
                lines.push(format!("{collection} {list}: {}", targets.join(", ")));
            }
        }
    }
    if prim.has_authored("light:filters") {
        lines.push(format!("light filters: {}", prim.targets("light:filters").join(", ")));
    }
    lines
}
