//! What placements are called in cryptomattes: the prim's path, and the path of the asset that it is a part of.

use crate::context::Context;
use crate::prim::Prim;
use crate::pxr::Module;
use gonio::scene::MatteName;
use pyo3::{intern, prelude::*};
use std::{collections::HashSet, sync::Arc};

/// Kinds of prims that are assets.
const KINDS: [&str; 2] = ["component", "assembly"];

/// Paths of the prims whose kind is that of assets; groups alone stand above them.
pub(super) fn assets(context: &Context<'_, '_>) -> HashSet<String> {
    let py = context.py;
    let models = || {
        let predicate = Module::Usd.item(py, "PrimIsModel")?;
        let models = context.stage.call_method1(intern!(py, "Traverse"), (predicate,))?;
        models.try_iter()?.map(|prim| Ok(Prim::new(prim?))).collect::<PyResult<Vec<_>>>()
    };
    let models = models().unwrap_or_default();
    models.iter().filter(|prim| KINDS.contains(&prim.kind().as_str())).map(Prim::path).collect()
}

/// What the placements from `first` on are called, which are of the prim at a path; `instance` is the native instance that it is in.
pub(super) fn of(path: String, instance: Option<&str>, first: usize, assets: &HashSet<String>) -> MatteName {
    let ends = path.match_indices('/').map(|(at, _)| at).filter(|at| *at > 0).collect::<Vec<_>>();
    let mut above = ends.iter().rev().map(|end| &path[..*end]);
    let asset: Option<Arc<str>> = above.find(|above| instance == Some(*above) || assets.contains(*above)).map(Arc::from);
    let object: Arc<str> = path.into();
    MatteName { first: first as u32, asset: asset.unwrap_or_else(|| object.clone()), object }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_asset_counts() {
        let assets = HashSet::from(["/Set/Chair".to_owned()]);
        let asset = |path: &str, instance| of(path.to_owned(), instance, 0, &assets).asset.to_string();
        assert_eq!(asset("/Set/Chair/Seat/Mesh", None), "/Set/Chair");
        assert_eq!(asset("/Set/Chair/Bolt/Mesh", Some("/Set/Chair/Bolt")), "/Set/Chair/Bolt");
        assert_eq!(asset("/Set/Lamp/Mesh", None), "/Set/Lamp/Mesh");
        assert_eq!(asset("/Mesh", None), "/Mesh");
    }
}
