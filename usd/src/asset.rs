//! Files that asset-valued attributes name, wherever the asset system has them.

use crate::pxr::{self, Module};
use crate::vt::AssetPath;
use gonio::Error;
use gonio_formats::FormatError;
use pyo3::{intern, prelude::*};

/// The bytes behind a resolved path: a file, or a part of a package. The message says what is wrong without naming the place.
pub fn bytes(py: Python<'_>, place: &str) -> Result<Vec<u8>, String> {
    // A pipe or a device would be waited for; what lies in packages and elsewhere is the resolver's business.
    if std::fs::metadata(place).is_ok_and(|found| !found.is_file() || found.len() == 0) {
        return Err("is empty or no file".to_owned());
    }
    let read = || -> PyResult<Option<Vec<u8>>> {
        let resolved = Module::Ar.item(py, "ResolvedPath")?.call1((place,))?;
        let asset = Module::Ar.item(py, "GetResolver")?.call0()?.call_method1(intern!(py, "OpenAsset"), (resolved,))?;
        if asset.is_none() {
            return Ok(None);
        }
        asset.call_method0(intern!(py, "GetBuffer"))?.extract().map(Some)
    };
    match read() {
        Ok(Some(bytes)) => Ok(bytes),
        Ok(None) => Err("cannot be opened".to_owned()),
        Err(error) => Err(format!("cannot be opened: {}", pxr::message_of(py, &error))),
    }
}

/// The bytes of the file of a name that lies beside a resolved one, in its package if it is in one. The message says what is wrong without naming
/// the place.
pub fn beside(py: Python<'_>, place: &str, name: &str) -> Result<Vec<u8>, String> {
    bytes(py, &place_beside(place, name))
}

/// A resolved path with another last part: `folder/a.ies` gives `folder/NAME`, `package.usdz[folder/a.ies]` gives `package.usdz[folder/NAME]`.
fn place_beside(place: &str, name: &str) -> String {
    let path = place.trim_end_matches(']');
    let folder = path.rfind(['/', '\\', '[']).map_or("", |end| &path[..=end]);
    format!("{folder}{name}{}", &place[path.len()..])
}

/// What a reader makes of the file that an attribute names. The message names the file and says what it is, and what is wrong with it.
pub fn read<T>(
    py: Python<'_>,
    path: &AssetPath,
    what: &str,
    reader: impl FnOnce(&[u8], &str) -> Result<T, FormatError>,
) -> Result<T, String> {
    let AssetPath { authored, resolved } = path;
    if resolved.is_empty() {
        return Err(format!("the {what} '{authored}' does not exist"));
    }
    let bytes = bytes(py, resolved).map_err(|problem| format!("the {what} '{resolved}' {problem}"))?;
    reader(&bytes, resolved).map_err(|error| Error::in_file(resolved, &error).to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_lie_beside_one_another_in_folders_and_packages() {
        for (place, expected) in [
            ("/stages/a.ies", "/stages/lamp.tlt"),
            ("a.ies", "lamp.tlt"),
            ("/stages/b.usdz[lamps/a.ies]", "/stages/b.usdz[lamps/lamp.tlt]"),
            ("/stages/b.usdz[c.usdz[a.ies]]", "/stages/b.usdz[c.usdz[lamp.tlt]]"),
        ] {
            assert_eq!(place_beside(place, "lamp.tlt"), expected);
        }
    }
}
