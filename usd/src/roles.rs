//! What prims are in a render pass.

use pyo3::{intern, prelude::*};

/// A collection's membership, where the pass says anything about it.
pub(crate) type Membership<'py> = Option<Bound<'py, PyAny>>;

/// The collections of a `RenderPass` prim.
#[derive(Debug, Default)]
pub struct Roles<'py> {
    pub(crate) rendered: Membership<'py>,
    pub(crate) camera: Membership<'py>,
    pub(crate) matte: Membership<'py>,
    pub(crate) pruned: Membership<'py>,
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
