//! What materials ask of the prims that they shade.

use crate::prim::Prim;

/// What is asked of the prim that is shaded.
#[derive(Debug, Default)]
pub struct Shaded<'py> {
    /// The prim.
    pub(super) prim: Option<Prim<'py>>,
    /// Names of its primvars that the material under way has asked for.
    pub(super) asked: Vec<String>,
}
