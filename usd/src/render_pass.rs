//! UsdRender's passes: which prims of a stage are in the picture, and as what.

use crate::context::Context;
use crate::prim::Prim;
use crate::pxr::{Module, message_of};
use gonio::{Error, Result};
use pyo3::{intern, prelude::*};

/// A collection's membership, where the pass says anything about it.
type Membership<'py> = Option<Bound<'py, PyAny>>;

/// The collections of a `RenderPass` prim.
#[derive(Debug, Default)]
pub struct Roles<'py> {
    rendered: Membership<'py>,
    camera: Membership<'py>,
    matte: Membership<'py>,
    pruned: Membership<'py>,
}

/// What a prim is in a pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Role {
    /// Seen and lit by something.
    pub rendered: bool,
    /// Seen by the camera.
    pub camera: bool,
    /// Cuts a hole into what the camera sees.
    pub matte: bool,
}

impl Default for Role {
    fn default() -> Self {
        Self { rendered: true, camera: true, matte: false }
    }
}

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

impl Roles<'_> {
    /// Whether all prims are alike.
    pub fn are_plain(&self) -> bool {
        [&self.rendered, &self.camera, &self.matte, &self.pruned].into_iter().all(Option::is_none)
    }

    /// Whether a prim is left out with all below it.
    pub fn prunes(&self, path: &str) -> bool {
        has(&self.pruned, path, false)
    }

    /// What a prim is.
    pub fn role(&self, path: &str) -> Role {
        if self.are_plain() {
            return Role::default();
        }
        Role {
            rendered: has(&self.rendered, path, true) && !self.prunes(path),
            camera: has(&self.camera, path, true),
            matte: has(&self.matte, path, false),
        }
    }
}

fn has(membership: &Membership<'_>, path: &str, unsaid: bool) -> bool {
    let Some(query) = membership else { return unsaid };
    let py = query.py();
    let ask = || query.call_method1(intern!(py, "IsPathIncluded"), (path,))?.is_truthy();
    ask().unwrap_or(unsaid)
}
