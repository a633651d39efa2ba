//! Construction of trees: division into parts, a binary tree for each, the collapse to eight children.

mod clusters;
pub(crate) mod collapse;
pub(crate) mod division;
pub(crate) mod effort;
mod emit;
mod emit_all;
mod flat_tree;
mod part;
pub(crate) mod split;
mod top;
pub(crate) mod wide_tree;
