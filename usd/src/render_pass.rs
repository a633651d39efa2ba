//! UsdRender's passes: which prims of a stage are in the picture, and as what.

use crate::context::Context;
use crate::prim::Prim;
use crate::pxr::{Module, message_of};
use crate::roles::{Membership, Roles};
use gonio::{Error, Result};
use pyo3::{intern, prelude::*};

/// A `RenderPass` prim.
#[derive(Debug, Default)]
pub struct RenderPass<'py> {
    /// Path of the settings that it is rendered with.
    pub source: Option<String>,
    /// What is in it.
    pub roles: Roles<'py>,
}

/// The pass at a path.
///
/// # Errors
/// There is no pass at the path.
pub fn read<'py>(context: &mut Context<'_, 'py>, path: &str) -> Result<RenderPass<'py>> {
    let absent = || Error::setting("render-pass", format!("there is no RenderPass prim at '{path}'"));
    let prim = context.prim_at(path).filter(|prim| prim.type_name() == "RenderPass").ok_or_else(absent)?;
    for name in ["command", "inputPasses"] {
        if prim.has_authored(name) {
            context.unsupported(&format!("'{name}' of render passes"), &prim.origin());
        }
    }
    let membership = |name: &str| membership(&prim, name);
    Ok(RenderPass {
        source: prim.targets("renderSource").into_iter().next(),
        roles: Roles {
            rendered: membership("renderVisibility")?,
            camera: membership("cameraVisibility")?,
            matte: membership("matte")?,
            pruned: membership("prune")?,
        },
    })
}

/// A collection's query; `None` where nothing is authored, so that the schema's own answer counts for all prims.
fn membership<'py>(prim: &Prim<'py>, name: &str) -> Result<Membership<'py>> {
    if !prim.has_authored_prefix(&format!("collection:{name}")) {
        return Ok(None);
    }
    let py = prim.py();
    let query = || Module::Usd.item(py, "CollectionAPI")?.call1((prim.object(), name))?.call_method0(intern!(py, "ComputeMembershipQuery"));
    query()
        .map(Some)
        .map_err(|error| Error::scene(&prim.origin(), format!("the collection {name} cannot be read: {}", message_of(py, &error))))
}
